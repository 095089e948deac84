#pragma once
// The runtime form of a clip: 16-bit rotations in blocks of eight joints, the few translations that move, root motion
// and phase apart. Immutable, shared by all characters. Made by pack/pack_clip.h, which also measures the error. What
// grows with its frames lies in tables, which a copy of the clip shares.
//
// It has one of two forms. The fast one keeps every frame. The small one keeps curves (curves.h): a fifth of the
// memory, while a pose costs about twice as much. Both blend with one another.

#include <surefoot/clip/curves.h>
#include <surefoot/clip/foot_prints.h>
#include <surefoot/math/transform.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr int k_lanes = 8;                ///< joints a block
inline constexpr int k_most_curve_joints = 512;  ///< of a clip in its small form

/// Poses in the small form.
struct PoseCurves {
    /// [block][x8 y8 z8 w8], value = q * 32767: the rotation that each joint turns about, on the hemisphere of rest.
    Table<std::int16_t> middle;
    std::vector<Vec3> moving_middle;  ///< [moving joint] metres
    /// Numbers: [block][x8 y8 z8], where middle * (x, y, z, sqrt(1 - x^2 - y^2 - z^2)) is the rotation; then
    /// [moving joint][x y z], metres from the middle.
    Curves curves;

    bool empty() const noexcept { return curves.empty(); }
};

struct PackedClip {
    std::string name;
    float fps = 30;
    int frame_count =
        0;  ///< [Limit: >= 2; a pose is two equal frames] the last one is the first one cycle later if cyclic
    int joint_count = 0;
    bool cyclic = false;

    /// [frame][block][x8 y8 z8 w8], value = q * 32767. Each joint is continuous over the clip and, as long as it stays
    /// within half a revolution of it, on the hemisphere of the skeleton's rest rotation.
    Table<std::int16_t> rotations;
    /// One flag a block (empty: none is set): some joint in it turns more than half a revolution from rest, so that
    /// its signs have to be tested when it is blended with another clip.
    std::vector<std::uint8_t> turning_blocks;
    /// Joints whose translation differs from rest somewhere in the clip, ascending; the others are at rest.
    std::vector<std::int16_t> moving;
    /// [frame][moving joint] metres.
    Table<Vec3> translations;
    /// The small form: then rotations, translations and the feet's keys are empty, and so is the root if it is steady.
    PoseCurves small;

    /// [frame] relative to the first frame; within the clip continuous, over the cycle it accumulates `travel`. Clips
    /// packed for blending move steadily: root[f] is `velocity` and `turn_rate` integrated over f / fps, exactly, and
    /// what the actor did beside that (a breath of speed within the step) is in the pose.
    Table<RootFrame> root;
    RootFrame start;      ///< the source's first root frame seen from root[0] (a steady root starts where it fits best)
    RootFrame travel;     ///< root of the last frame seen from the first: what one pass adds
    Vec3 velocity;        ///< [m/s] of the root, in the root's own frame
    float turn_rate = 0;  ///< [rad/s] of the root, positive to the left

    /// Foot strikes: pairs of (time share in [0, 1], phase), both ascending, that map time to phase piecewise linearly.
    /// Phase counts cycles of two steps and is 0 (mod 1) at a left strike and 0.5 at a right one; the first pair is
    /// (0, phase of the first frame, in [0, 1)), the last (1, that plus `cycles`). Empty where there are no steps.
    std::vector<std::array<float, 2>> phase_map;
    int cycles = 0;  ///< cycles of two steps in the clip, 0 without a phase map

    /// By Side. Both have keys or neither; steps where there are cycles.
    std::array<FootPrints, 2> feet;

    int block_count() const noexcept { return (joint_count + k_lanes - 1) / k_lanes; }
    float duration() const noexcept { return static_cast<float>(frame_count - 1) / fps; }
};

/// Index of a joint's x among the numbers of PoseCurves; y and z are k_lanes and 2 * k_lanes further.
constexpr std::size_t turn_number(int joint) noexcept {
    return static_cast<std::size_t>(joint / k_lanes * 3 * k_lanes + joint % k_lanes);
}
/// Index of a moving joint's x; y and z follow.
inline std::size_t shift_number(const PackedClip& clip, std::size_t moving) noexcept {
    return static_cast<std::size_t>(clip.block_count()) * 3 * k_lanes + 3 * moving;
}

/// [bytes] of memory that poses, root and feet take.
std::size_t memory_size(const PackedClip& clip) noexcept;

/// What is wrong with a packed clip (empty: nothing): array lengths, limits, order of the phase map.
std::string problem(const PackedClip& clip);

}  // namespace surefoot
