#pragma once
// Vectors and rotations of eight characters at once.
//
// The operations of math/vec.h and math/quat.h in the same order, so that eight characters at once get the very bits
// that one alone gets.

#include <surefoot/math/lanes.h>
#include <surefoot/math/quat.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

template <class T>
struct Quat8 {
    Float8<T> x, y, z, w;

    SUREFOOT_INLINE static Quat8 splat(Quat q) noexcept {
        return {Float8<T>::splat(q.x), Float8<T>::splat(q.y), Float8<T>::splat(q.z), Float8<T>::splat(q.w)};
    }
};
template <class T>
struct Vec8 {
    Float8<T> x, y, z;

    SUREFOOT_INLINE static Vec8 splat(Vec3 v) noexcept {
        return {Float8<T>::splat(v.x), Float8<T>::splat(v.y), Float8<T>::splat(v.z)};
    }
    friend SUREFOOT_INLINE Vec8 operator+(const Vec8& a, const Vec8& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend SUREFOOT_INLINE Vec8 operator-(const Vec8& a, const Vec8& b) noexcept {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend SUREFOOT_INLINE Vec8 operator*(const Vec8& a, Float8<T> s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
};

template <class T>
SUREFOOT_INLINE Float8<T> dot(const Vec8<T>& a, const Vec8<T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
SUREFOOT_INLINE Vec8<T> cross(const Vec8<T>& a, const Vec8<T>& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
SUREFOOT_INLINE Quat8<T> multiply(const Quat8<T>& a, const Quat8<T>& b) noexcept {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
template <class T>
SUREFOOT_INLINE Quat8<T> conjugate(const Quat8<T>& q) noexcept {
    return {-q.x, -q.y, -q.z, q.w};
}
template <class T>
SUREFOOT_INLINE Vec8<T> rotate(const Quat8<T>& q, const Vec8<T>& v) noexcept {
    const Vec8<T> t{2.0f * (q.y * v.z - q.z * v.y), 2.0f * (q.z * v.x - q.x * v.z), 2.0f * (q.x * v.y - q.y * v.x)};
    return {(v.x + q.w * t.x) + (q.y * t.z - q.z * t.y), (v.y + q.w * t.y) + (q.z * t.x - q.x * t.z),
            (v.z + q.w * t.z) + (q.x * t.y - q.y * t.x)};
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
