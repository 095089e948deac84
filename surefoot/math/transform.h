#pragma once
// Rigid transforms. Joints have no scale in Surefoot: importers turn scale into joint positions (docs/architecture.md).

#include <surefoot/math/quat.h>

namespace surefoot {

/// p -> rotation * p + translation (metres).
struct Transform {
    Quat rotation;
    Vec3 translation;

    friend constexpr Transform operator*(const Transform& a, const Transform& b) noexcept {
        return {a.rotation * b.rotation, a.translation + rotate(a.rotation, b.translation)};
    }
    friend constexpr bool operator==(const Transform&, const Transform&) noexcept = default;
};

constexpr Vec3 transform_point(const Transform& t, Vec3 p) noexcept { return t.translation + rotate(t.rotation, p); }
constexpr Transform inverse(const Transform& t) noexcept {
    const Quat r = conjugate(t.rotation);
    return {r, -rotate(r, t.translation)};
}

/// 3x4 affine matrix, row-major rows of (rotation | translation), acting on columns: what renderers take.
struct Matrix34 {
    float m[12];
};
constexpr Matrix34 to_matrix(const Transform& t) noexcept {
    const Quat q = t.rotation;
    const float x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
    const float xx = q.x * x2, yy = q.y * y2, zz = q.z * z2, xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
    const float wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
    return {{1 - (yy + zz), xy - wz, xz + wy, t.translation.x, xy + wz, 1 - (xx + zz), yz - wx, t.translation.y,
             xz - wy, yz + wx, 1 - (xx + yy), t.translation.z}};
}

/// A frame standing on the ground: position and heading. Root motion is made of these.
struct RootFrame {
    Vec3 position;  ///< [m]
    float yaw = 0;  ///< [rad] about +Y, positive to the character's left; not wrapped, so that it can count turns

    friend constexpr bool operator==(const RootFrame&, const RootFrame&) noexcept = default;
};
inline Transform to_transform(const RootFrame& r) noexcept { return {from_yaw(r.yaw), r.position}; }
/// a, then b as seen from a.
inline RootFrame operator*(const RootFrame& a, const RootFrame& b) noexcept {
    return {a.position + rotate(from_yaw(a.yaw), b.position), a.yaw + b.yaw};
}
/// The step that leads from a to b, as seen from a: a * between(a, b) == b.
inline RootFrame between(const RootFrame& a, const RootFrame& b) noexcept {
    return {rotate(from_yaw(-a.yaw), b.position - a.position), b.yaw - a.yaw};
}

}  // namespace surefoot
