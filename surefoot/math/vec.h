#pragma once
// Vectors of three floats, metres unless said otherwise. Right-handed, Y up; a character faces +Z and its left is +X.

#include <algorithm>
#include <cmath>

namespace surefoot {

struct Vec3 {
    float x = 0, y = 0, z = 0;

    constexpr Vec3& operator+=(Vec3 b) noexcept { return *this = {x + b.x, y + b.y, z + b.z}; }
    constexpr Vec3& operator-=(Vec3 b) noexcept { return *this = {x - b.x, y - b.y, z - b.z}; }
    constexpr Vec3& operator*=(float s) noexcept { return *this = {x * s, y * s, z * s}; }
    friend constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vec3 operator-(Vec3 a) noexcept { return {-a.x, -a.y, -a.z}; }
    friend constexpr Vec3 operator*(Vec3 a, float s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3 operator*(float s, Vec3 a) noexcept { return a * s; }
    friend constexpr Vec3 operator/(Vec3 a, float s) noexcept { return {a.x / s, a.y / s, a.z / s}; }
    friend constexpr bool operator==(Vec3 a, Vec3 b) noexcept = default;
};

inline constexpr Vec3 k_up{0, 1, 0};

constexpr float dot(Vec3 a, Vec3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr Vec3 lerp(Vec3 a, Vec3 b, float t) noexcept { return a + (b - a) * t; }
/// From 0 to 1 with no slope at either end; `t` beyond [0, 1] stays at the nearer one.
inline float smooth_step(float t) noexcept {
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}
constexpr float length_squared(Vec3 a) noexcept { return dot(a, a); }
inline float length(Vec3 a) noexcept { return std::sqrt(dot(a, a)); }
inline float distance(Vec3 a, Vec3 b) noexcept { return length(a - b); }
/// Length of the ground-plane part.
inline float planar_length(Vec3 a) noexcept { return std::sqrt(a.x * a.x + a.z * a.z); }
/// Unit vector, or `fallback` where `a` is too short to have a direction.
inline Vec3 normalized(Vec3 a, Vec3 fallback = {0, 0, 1}) noexcept {
    const float square = dot(a, a);
    return square > 1e-24f ? a / std::sqrt(square) : fallback;
}
inline bool is_finite(Vec3 a) noexcept { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

}  // namespace surefoot
