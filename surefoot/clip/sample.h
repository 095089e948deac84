#pragma once
// Playing packed clips: a pose as one weighted sum over the keyframes of all leaves and one normalisation, and the map
// between a clip's time and its phase.
//
// Nothing here allocates or fails; what it receives was checked when it was built (`problem` of the clip). Every
// function gives the same bits on every build, and the scalar twin (math/lanes.h) gives them too.

#include <surefoot/clip/packed_clip.h>
#include <surefoot/rig/leg.h>
#include <surefoot/rig/skeleton.h>

#include <span>

namespace surefoot {

inline constexpr int k_max_leaves = 27;  ///< of one pose: two blend spaces and a style, each with all it may answer

/// One clip that takes part in a pose.
struct Leaf {
    std::int32_t clip = 0;  ///< index into the clips
    float time = 0;         ///< [s] in [0, duration]; outside, the nearest end
    float weight = 0;       ///< relative to the other leaves'; negative where a space extrapolates; the sum is > 0

    friend bool operator==(const Leaf&, const Leaf&) = default;
};

/// The blended local pose: `locals` receives joint_count() transforms. All clips are of this skeleton; at least one
/// leaf and at most k_max_leaves. About 0.2 µs for three clips of 67 joints.
void sample_pose(const Skeleton& skeleton, std::span<const PackedClip> clips, std::span<const Leaf> leaves,
                 std::span<Transform> locals) noexcept;
/// The scalar twin of sample_pose: same bits, a third of the speed. For tests and for machines without vectors.
void sample_pose_scalar(const Skeleton& skeleton, std::span<const PackedClip> clips, std::span<const Leaf> leaves,
                        std::span<Transform> locals) noexcept;

/// Which build of the kernels this machine runs: "baseline" (what the library was built for), "x86-64-v3" or
/// "x86-64-v4".
const char* kernels_name() noexcept;

/// Eight characters of one skeleton at once, lane = character: local poses to 3x4 matrices in model space. Each of the
/// eight pointers leads to joint_count() elements; idle lanes may repeat a character's input and need an output of
/// their own. `scratch` holds model_scratch_floats(joint count) floats, aligned to 64 bytes.
void local_to_model_8(const Skeleton& skeleton, const Transform* const (&locals)[k_lanes],
                      Matrix34* const (&models)[k_lanes], float* scratch) noexcept;
void local_to_model_8_scalar(const Skeleton& skeleton, const Transform* const (&locals)[k_lanes],
                             Matrix34* const (&models)[k_lanes], float* scratch) noexcept;
constexpr std::size_t model_scratch_floats(int joint_count) noexcept {
    return static_cast<std::size_t>(joint_count) * 7 * k_lanes;
}

/// Steady motion for a time: the root frame reached from the origin by a constant velocity in the root's own frame and
/// a constant turn rate [rad/s].
RootFrame integrate(Vec3 velocity, float turn_rate, float seconds) noexcept;

/// Root motion within one pass, seen from the first frame: outside [0, duration] the nearest end.
RootFrame root_within(const PackedClip& clip, float time) noexcept;
/// Root motion of a clip at a time, seen from its first frame; beyond the ends of a cyclic clip it goes on.
RootFrame clip_root(const PackedClip& clip, float time) noexcept;

/// Phase at a time of a clip with steps: cycles since the left strike at or before its first frame, in
/// [first phase, first phase + cycles].
float phase_at(const PackedClip& clip, float time) noexcept;
/// The phase to ask a clip of several cycles for when the shared phase is `phase` after `cycle` full cycles.
inline float phase_in(const PackedClip& clip, float phase, std::uint32_t cycle) noexcept {
    return phase + static_cast<float>(cycle % static_cast<std::uint32_t>(clip.cycles));
}
/// Time in [0, duration] at a phase, which counts cycles and may be any number.
float time_at(const PackedClip& clip, float phase) noexcept;
/// The same counted on over the ends of the clip, which has steps.
float unwrapped_time(const PackedClip& clip, float phase) noexcept;
/// Phase at which a side's step begins.
constexpr float strike_phase(Side side) noexcept { return side == Side::left ? 0.0f : 0.5f; }
/// Time and how fast it runs there: d(time)/d(phase) in seconds a cycle.
struct PhaseTime {
    float time = 0;
    float slope = 0;
};
PhaseTime phase_time(const PackedClip& clip, float phase) noexcept;

/// A foot of the clip, which knows them. Outside [0, duration] the nearest end.
FootKey foot_key_at(const PackedClip& clip, Side side, float time) noexcept;
/// Its age alone (foot_prints.h); 0 for a clip without steps.
float foot_age_at(const PackedClip& clip, Side side, float time) noexcept;

}  // namespace surefoot
