#include <surefoot/gait/oscillators.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr std::array<FootfallPattern, 6> k_patterns{{
    {"walk", "one foot after the other, and always one that stands", {0, 0.5f, 0.5f, 0, 0}, {0.62f, 0.62f}},
    {"run", "one foot after the other, with a flight between", {0, 0.5f, 0.5f, 0, 0}, {0.36f, 0.36f}},
    {"crouch_walk", "a walk that stands longer on both feet", {0, 0.5f, 0.5f, 0, 0}, {0.68f, 0.68f}},
    {"hop", "both feet at once, arms together", {0, 0, 0, 0, 0}, {0.45f, 0.45f}},
    {"skip", "the right foot soon after the left, then a flight", {0, 0.3f, 0.3f, 0, 0}, {0.42f, 0.42f}},
    {"amble", "slow, arms with the leg of their own side", {0, 0.5f, 0, 0.5f, 0}, {0.68f, 0.68f}},
}};

constexpr float k_longest_part = 1.0f / 120;  // [s]
/// Two limbs exactly half a cycle off would pull nowhere: they count as a little less, the first ahead.
constexpr float k_most_apart = 0.49f;

/// [rad] Up to here the sine is the angle itself, to a float's last bit; limbs in step are no farther apart.
constexpr float k_small = 3e-4f;

/// Sum of the pulls of all limbs on each; what two limbs do to each other adds up to nothing.
std::array<float, k_limbs> pulls(const Oscillators& limbs, const std::array<float, k_limbs>& offset) noexcept {
    std::array<float, k_limbs> pull{};
    for (std::size_t i = 0; i < k_limbs; ++i)
        for (std::size_t j = i + 1; j < k_limbs; ++j) {
            const float apart = phase_difference(limbs.phase[j] + offset[j], limbs.phase[i] + offset[i]);
            const float felt = apart < -k_most_apart ? k_most_apart : std::min(apart, k_most_apart);
            const float angle = 2 * static_cast<float>(k_pi) * felt;
            const float force = std::fabs(angle) < k_small ? angle : sin(angle);
            pull[i] += force;
            pull[j] -= force;
        }
    return pull;
}

}  // namespace

std::span<const FootfallPattern> footfall_patterns() noexcept { return k_patterns; }

const FootfallPattern* find_footfall_pattern(std::string_view name) noexcept {
    for (const FootfallPattern& pattern : k_patterns)
        if (pattern.name == name) return &pattern;
    return nullptr;
}

FootfallPattern mix(const FootfallPattern& a, const FootfallPattern& b, float share) noexcept {
    FootfallPattern between = share < 0.5f ? a : b;
    for (std::size_t i = 0; i < k_limbs; ++i) {
        float way = phase_difference(b.offset[i], a.offset[i]);
        if (way == -0.5f) way = 0.5f;
        between.offset[i] = share == 1 ? b.offset[i] : wrap_phase(a.offset[i] + share * way);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        const float from = a.duty[side] > 0 ? a.duty[side] : b.duty[side];
        const float to = b.duty[side] > 0 ? b.duty[side] : a.duty[side];
        between.duty[side] = from + share * (to - from);
    }
    return between;
}

Oscillators in_step(const std::array<float, k_limbs>& offset, float phase) noexcept {
    Oscillators limbs;
    for (std::size_t i = 0; i < k_limbs; ++i) limbs.phase[i] = wrap_phase(phase - offset[i]);
    return limbs;
}

void advance(Oscillators& limbs, const std::array<float, k_limbs>& offset, float rate, float dt,
             float coupling) noexcept {
    const int parts = std::clamp(static_cast<int>(std::ceil(dt / k_longest_part)), 1, 1200);
    const float part = dt / static_cast<float>(parts), pull_in_cycles = coupling / (2 * static_cast<float>(k_pi));
    for (int p = 0; p < parts; ++p) {
        const std::array<float, k_limbs> pull = pulls(limbs, offset);
        for (std::size_t i = 0; i < k_limbs; ++i) {
            const float pulled = std::max(0.0f, rate + pull_in_cycles * pull[i]);  // no limb goes backwards
            limbs.phase[i] = wrap_phase(limbs.phase[i] + pulled * part);
        }
    }
}

float disorder(const Oscillators& limbs, const std::array<float, k_limbs>& offset) noexcept {
    float most = 0;
    for (std::size_t i = 0; i < k_limbs; ++i)
        for (std::size_t j = i + 1; j < k_limbs; ++j)
            most = std::max(most, std::fabs(phase_difference(limbs.phase[j] + offset[j], limbs.phase[i] + offset[i])));
    return most;
}

float wrap_phase(float phase) noexcept {
    const float in = phase - std::floor(phase);
    return in < 1 ? in : 0.0f;  // a tiny negative number rounds up to 1
}

float phase_difference(float to, float from) noexcept {
    const float apart = to - from;
    return apart - std::floor(apart + 0.5f);
}

}  // namespace surefoot
