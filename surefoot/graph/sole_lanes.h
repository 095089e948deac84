#pragma once
// What kernels of feet share, here and in the crowd's room.

#include <surefoot/ik/two_bone_lanes.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

template <class T>
SUREFOOT_INLINE Vec8<T> load_vec(const float (*from)[8]) noexcept {
    return {Float8<T>::load(from[0]), Float8<T>::load(from[1]), Float8<T>::load(from[2])};
}
template <class T>
SUREFOOT_INLINE Quat8<T> load_quat(const float (*from)[8]) noexcept {
    return {Float8<T>::load(from[0]), Float8<T>::load(from[1]), Float8<T>::load(from[2]), Float8<T>::load(from[3])};
}
template <class T>
SUREFOOT_INLINE void store(const Quat8<T>& q, float (*to)[8]) noexcept {
    q.x.store(to[0]);
    q.y.store(to[1]);
    q.z.store(to[2]);
    q.w.store(to[3]);
}
template <class T>
SUREFOOT_INLINE void store(const Vec8<T>& v, float (*to)[8]) noexcept {
    v.x.store(to[0]);
    v.y.store(to[1]);
    v.z.store(to[2]);
}

/// As in foot_blend.h.
template <class T>
SUREFOOT_INLINE Vec8<T> stand_on(const Quat8<T>& rotation, const Vec8<T>& own_heel, const Vec8<T>& own_ball,
                                 const Vec8<T>& heel, const Vec8<T>& ball) noexcept {
    constexpr float k_level = 0.02f;  // [m] the two differ by less: it stands on both
    const Float8<T> t = clamp(0.5f + 0.5f * (heel.y - ball.y) / k_level, 0.0f, 1.0f);
    return lanes::lerp(heel - rotate(rotation, own_heel), ball - rotate(rotation, own_ball), t * t * (3.0f - 2.0f * t));
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
