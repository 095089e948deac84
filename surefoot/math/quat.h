#pragma once
// Unit quaternions (x, y, z, w) as rotations; q * p applies p first.

#include <surefoot/math/trig.h>
#include <surefoot/math/vec.h>

namespace surefoot {

struct Quat {
    float x = 0, y = 0, z = 0, w = 1;

    friend constexpr Quat operator*(Quat a, Quat b) noexcept {
        return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    }
    friend constexpr Quat operator-(Quat q) noexcept { return {-q.x, -q.y, -q.z, -q.w}; }
    friend constexpr bool operator==(Quat a, Quat b) noexcept = default;
};

constexpr float dot(Quat a, Quat b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
constexpr Quat conjugate(Quat q) noexcept { return {-q.x, -q.y, -q.z, q.w}; }

inline Quat normalized(Quat q) noexcept {
    const float square = dot(q, q);
    if (!(square > 1e-24f)) return {};
    const float s = 1.0f / std::sqrt(square);
    return {q.x * s, q.y * s, q.z * s, q.w * s};
}

constexpr Vec3 rotate(Quat q, Vec3 v) noexcept {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0f * cross(u, v);
    return v + q.w * t + cross(u, t);
}

/// The one of q and -q on the side of `reference`.
constexpr Quat aligned(Quat q, Quat reference) noexcept { return dot(q, reference) < 0 ? -q : q; }

inline Quat axis_angle(Vec3 unit_axis, float radians) noexcept {
    const SinCos half = sin_cos(static_cast<double>(0.5f * radians));
    const auto s = static_cast<float>(half.sin);
    return {unit_axis.x * s, unit_axis.y * s, unit_axis.z * s, static_cast<float>(half.cos)};
}

/// Rotation vector (axis times angle, |angle| <= pi) to rotation and back.
inline Quat from_rotation_vector(Vec3 v) noexcept {
    const float angle = length(v);
    return angle > 1e-9f ? axis_angle(v / angle, angle) : normalized(Quat{0.5f * v.x, 0.5f * v.y, 0.5f * v.z, 1});
}
inline Vec3 to_rotation_vector(Quat q) noexcept {
    if (q.w < 0) q = -q;
    const Vec3 v{q.x, q.y, q.z};
    const float s = length(v);
    return s > 1e-9f ? v * (2.0f * atan2(s, q.w) / s) : 2.0f * v;
}
inline float rotation_angle(Quat q) noexcept { return length(to_rotation_vector(q)); }

/// Shortest rotation that takes direction `from` to direction `to` (any lengths above zero).
/// Opposite directions turn about an arbitrary perpendicular axis.
inline Quat rotation_between(Vec3 from, Vec3 to) noexcept {
    const Vec3 a = normalized(from), b = normalized(to);
    const float c = dot(a, b);
    if (c < -0.999999f) {
        const Vec3 helper = std::fabs(a.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 axis = normalized(cross(a, helper));
        return {axis.x, axis.y, axis.z, 0};
    }
    const Vec3 n = cross(a, b);
    return normalized(Quat{n.x, n.y, n.z, 1.0f + c});
}

/// Normalised linear interpolation on the shorter side: the blend the runtime uses.
inline Quat nlerp(Quat a, Quat b, float t) noexcept {
    b = aligned(b, a);
    return normalized(Quat{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t});
}
/// Spherical interpolation at constant angular velocity, for tools.
inline Quat slerp(Quat a, Quat b, float t) noexcept {
    return normalized(a * from_rotation_vector(to_rotation_vector(conjugate(a) * b) * t));
}

/// Rotation about +Y by `yaw` (positive: to the character's left).
inline Quat from_yaw(float yaw) noexcept {
    const SinCos half = sin_cos(static_cast<double>(0.5f * yaw));
    return {0, static_cast<float>(half.sin), 0, static_cast<float>(half.cos)};
}
/// Heading of the direction that `q` gives to +Z, in (-pi, pi].
inline float yaw_of(Quat q) noexcept {
    const Vec3 f = rotate(q, {0, 0, 1});
    return atan2(f.x, f.z);
}
inline bool is_finite(Quat q) noexcept {
    return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

}  // namespace surefoot
