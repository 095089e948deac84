#pragma once
// Coupled phase oscillators: one a limb, so that legs and arms keep their order while a gait changes.
//
//     phase_i' = rate_i + sum over j of (K / 2 pi) sin 2 pi (phase_j - phase_i - delta_ij)          DESIGN §7
//
// in cycles; delta_ij is what the footfall pattern asks of two limbs (below). Limbs that stand as asked feel nothing,
// so a steady gait keeps its rate exactly and does not drift; limbs that do not are drawn together, the slower the
// farther. The state is a handful of floats: copy it to save it. Nothing allocates, fails or calls libm.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace surefoot {

/// The parts of a body that keep time by themselves.
enum class Limb : std::uint8_t { left_leg, right_leg, left_arm, right_arm, trunk };
inline constexpr int k_limbs = 5;

/// Which limb is when, and for how long a foot stands.
struct FootfallPattern {
    std::string_view name, help;
    /// [0, 1) by Limb: how much later than the left foot's strike the limb's own cycle begins: a leg's at its foot's
    /// strike, an arm's at the moment that belongs to the strike of the other side's foot. (0.5, 0.5, 0) with arms that
    /// swing against the legs.
    std::array<float, k_limbs> offset{0, 0.5f, 0.5f, 0, 0};
    std::array<float, 2> duty{0, 0};  ///< (0, 1) share of its cycle that each foot stands; 0: as the gait has it
};

/// walk, run, crouch_walk, hop, skip, amble: what is known of them, as data.
std::span<const FootfallPattern> footfall_patterns() noexcept;
/// Null where there is none of that name.
const FootfallPattern* find_footfall_pattern(std::string_view name) noexcept;

/// The pattern between two: offsets go the shorter way round (half a cycle: forward), duties straight. A duty that one
/// of the two leaves to the gait is the other's.
FootfallPattern mix(const FootfallPattern& a, const FootfallPattern& b, float share) noexcept;

struct Oscillators {
    std::array<float, k_limbs> phase{};  ///< [0, 1) by Limb: 0 where the limb's own cycle begins

    friend bool operator==(const Oscillators&, const Oscillators&) = default;
};
static_assert(std::is_trivially_copyable_v<Oscillators>);

/// [1/s] How strongly two limbs pull at each other: with five, what is off falls to a third in a seventh of a second.
inline constexpr float k_limb_coupling = 1.5f;

/// All limbs where the pattern has them when the left foot is at `phase`.
Oscillators in_step(const std::array<float, k_limbs>& offset, float phase) noexcept;

/// A step of `dt` >= 0 seconds; `rate` [cycles/s, >= 0] is the gait's. Steps of any length are taken in parts of at
/// most 1/120 s, so that what comes out hardly depends on the frame rate.
void advance(Oscillators& limbs, const std::array<float, k_limbs>& offset, float rate, float dt,
             float coupling = k_limb_coupling) noexcept;

/// The farthest [cycles, 0 to 0.5] that two limbs are from what the pattern asks of them.
float disorder(const Oscillators& limbs, const std::array<float, k_limbs>& offset) noexcept;

/// In [0, 1), and the signed way round in [-0.5, 0.5).
float wrap_phase(float phase) noexcept;
float phase_difference(float to, float from) noexcept;

}  // namespace surefoot
