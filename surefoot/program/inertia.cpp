#include <surefoot/program/inertia.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_rotation_range = 3.2f;  // [rad] of the 16-bit numbers; a rotation vector is at most pi long
constexpr float k_rate_range = 8;         // [rad] of rate times duration: a faster one counts as that

/// From value x with slope v (per unit of share) to rest at 0 when the share is 1: quintics with no curvature at
/// either end.
float from_value(float s) noexcept { return 1 - s * s * s * (10 - s * (15 - 6 * s)); }
float from_slope(float s) noexcept { return s - s * s * s * (6 - s * (8 - 3 * s)); }

std::int16_t packed(float value, float range) noexcept {
    return static_cast<std::int16_t>(std::lround(std::clamp(value / range, -1.0f, 1.0f) * 32767.0f));
}
float unpacked(std::int16_t value, float range) noexcept { return static_cast<float>(value) * (range / 32767.0f); }

/// Where the two arrays behind an InertiaMemory begin.
std::size_t translations_at(const Program& program) noexcept { return program.inertia_memory + sizeof(InertiaMemory); }
std::size_t rotations_at(const Program& program) noexcept {
    return translations_at(program) + program.drifting.size() * 6 * sizeof(float);
}

struct Rotations {
    std::int16_t value[3], rate[3];
};
struct Translations {
    Vec3 value, rate;
};

Vec3 difference(Quat a, Quat b) noexcept { return to_rotation_vector(a * conjugate(b)); }

}  // namespace

void carry(const Program& program, std::span<std::byte> state, float seconds, float dt,
           const PosePair& poses) noexcept {
    memory_at<InertiaMemory>(state, program.inertia_memory) = {0, seconds, poses.velocity, poses.turn};
    if (!(seconds > 0)) return;
    const float per_share = dt > 0 ? seconds / dt : 0.0f;
    for (std::size_t j = 0; j < poses.to.size(); ++j) {
        auto& out = memory_at<Rotations>(state, rotations_at(program) + j * sizeof(Rotations));
        const Vec3 ahead = difference(poses.from[j].rotation, poses.to[j].rotation);
        const Vec3 old_rate = difference(poses.from[j].rotation, poses.from_before[j].rotation);
        const Vec3 new_rate = difference(poses.to_after[j].rotation, poses.to[j].rotation);
        const Vec3 rate = (old_rate - new_rate) * per_share;
        const float values[3] = {ahead.x, ahead.y, ahead.z}, rates[3] = {rate.x, rate.y, rate.z};
        for (int k = 0; k < 3; ++k) {
            out.value[k] = packed(values[k], k_rotation_range);
            out.rate[k] = packed(rates[k], k_rate_range);
        }
    }
    for (std::size_t i = 0; i < program.drifting.size(); ++i) {
        const auto j = static_cast<std::size_t>(program.drifting[i]);
        auto& out = memory_at<Translations>(state, translations_at(program) + i * sizeof(Translations));
        out.value = poses.from[j].translation - poses.to[j].translation;
        out.rate = (poses.from[j].translation - poses.from_before[j].translation - poses.to_after[j].translation +
                    poses.to[j].translation) *
                   per_share;
    }
}

float carried_share(const InertiaMemory& inertia) noexcept {
    return inertia.seconds > 0 && inertia.elapsed < inertia.seconds ? from_value(inertia.elapsed / inertia.seconds)
                                                                    : 0.0f;
}

void apply_inertia(const Program& program, std::span<const std::byte> state, std::span<Transform> locals) noexcept {
    const auto& inertia = memory_at<InertiaMemory>(state, program.inertia_memory);
    if (!(inertia.seconds > 0 && inertia.elapsed < inertia.seconds)) return;
    const float share = inertia.elapsed / inertia.seconds, x = from_value(share), v = from_slope(share);
    for (std::size_t j = 0; j < program.body.skeleton->rest.size(); ++j) {
        const auto& carried = memory_at<Rotations>(state, rotations_at(program) + j * sizeof(Rotations));
        const auto at = [&](int k) noexcept {
            return x * unpacked(carried.value[k], k_rotation_range) + v * unpacked(carried.rate[k], k_rate_range);
        };
        locals[j].rotation = normalized(from_rotation_vector({at(0), at(1), at(2)}) * locals[j].rotation);
    }
    for (std::size_t i = 0; i < program.drifting.size(); ++i) {
        const auto& carried = memory_at<Translations>(state, translations_at(program) + i * sizeof(Translations));
        locals[static_cast<std::size_t>(program.drifting[i])].translation += carried.value * x + carried.rate * v;
    }
}

}  // namespace surefoot
