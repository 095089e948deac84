#pragma once
// A standing foot stays where it is while a blend's weights change.
//
// Blended feet stand still as long as the weights do (graph/foot_blend.h). When these change, from a wide idle to a
// walk, or from straight ahead into a curve, the mean of the prints moves, and a standing foot with it. So what is
// shown is held: a blend remembers what it was, and each step finds both feet twice for the same moment, as that blend
// had them and as the new one does. By the difference a standing foot is held back from then on; on its next swing it
// goes to where the blend has it. Nothing is computed, and nobody held, while nothing changes.

#include <surefoot/graph/foot_blend.h>

namespace surefoot {

/// What a blend remembers of its last step. All zero: it has not been yet, and the first step holds nothing.
struct FootMemory {
    /// [Limit: leaves] Blends of more are not held. Two spaces of four axes and a style have fewer.
    static constexpr std::size_t k_most = 12;
    /// [m/s] at which changing weights move a foot's place, as seen from the root; smoothed.
    struct Drift {
        float x = 0, z = 0;

        friend bool operator==(const Drift&, const Drift&) = default;
    };
    std::array<FootOffset, 2> hold{};  ///< by Side: now
    std::array<Drift, 2> drift{};
    std::array<Leaf, k_most> leaf{};
    std::uint32_t count = 0;
    Vec3 velocity;
    float turn = 0;
    float phase_rate = 0;
    float phase_before = 0;
    std::uint32_t cycle_before = 0;

    friend bool operator==(const FootMemory&, const FootMemory&) = default;
};
static_assert(sizeof(FootMemory) == 224, "no padding: states may be compared and hashed as bytes");

/// A step of a blend, during which the root went by `root_delta`; `blend.hold` is not read. Where one of the clips has
/// no foot track nothing is held.
void hold_feet(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
               const RootFrame& root_delta, float dt, FootMemory& memory) noexcept;

/// Whether nothing stepped in the last step: no clip that was seen has a phase, and what begins may begin anywhere.
bool stood(std::span<const PackedClip> clips, const FootMemory& memory) noexcept;
/// The phase [0, 1) in which to begin: a foot is about to lift. The one that trails on the way to go; of feet side by
/// side the one whose turn comes sooner; turning on the spot the one on that side.
float starting_phase(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
                     const FootMemory& memory) noexcept;

}  // namespace surefoot
