#pragma once
// solve_two_bone (two_bone.h) for as many legs as there are lanes: its one text, of which `Single` makes the function
// for one leg alone. All ways through it are computed and one is chosen, so a lane gets the bits that it gets alone.

#include <surefoot/math/lanes_rigid.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {
namespace lanes {

// What math/vec.h and math/quat.h do, in the same order.

template <class T>
SUREFOOT_INLINE Vec8<T> select(Mask8<T> m, const Vec8<T>& a, const Vec8<T>& b) noexcept {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <class T>
SUREFOOT_INLINE Quat8<T> select(Mask8<T> m, const Quat8<T>& a, const Quat8<T>& b) noexcept {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
template <class T>
SUREFOOT_INLINE Vec8<T> divided(const Vec8<T>& a, Float8<T> s) noexcept {
    return {a.x / s, a.y / s, a.z / s};
}
template <class T>
SUREFOOT_INLINE Float8<T> length(const Vec8<T>& a) noexcept {
    return sqrt(dot(a, a));
}
template <class T>
SUREFOOT_INLINE Float8<T> planar_length(const Vec8<T>& a) noexcept {
    return sqrt(a.x * a.x + a.z * a.z);
}
template <class T>
SUREFOOT_INLINE Vec8<T> lerp(const Vec8<T>& a, const Vec8<T>& b, Float8<T> t) noexcept {
    return a + (b - a) * t;
}
template <class T>
SUREFOOT_INLINE Vec8<T> normalized(const Vec8<T>& a, const Vec8<T>& otherwise) noexcept {
    const Float8<T> square = dot(a, a);
    const Mask8<T> has_direction = square > Float8<T>::splat(1e-24f);
    return select(has_direction, divided(a, sqrt(select(has_direction, square, Float8<T>::splat(1)))), otherwise);
}
template <class T>
SUREFOOT_INLINE Float8<T> dot(const Quat8<T>& a, const Quat8<T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
template <class T>
SUREFOOT_INLINE Quat8<T> normalized(const Quat8<T>& q) noexcept {
    const Float8<T> square = dot(q, q), one = Float8<T>::splat(1);
    const Mask8<T> is_rotation = square > Float8<T>::splat(1e-24f);
    const Float8<T> s = rsqrt(select(is_rotation, square, one));
    return select(is_rotation, {q.x * s, q.y * s, q.z * s, q.w * s}, Quat8<T>::splat({}));
}
template <class T>
SUREFOOT_INLINE Quat8<T> aligned(const Quat8<T>& q, const Quat8<T>& reference) noexcept {
    return select(dot(q, reference) < Float8<T>::splat(0), {-q.x, -q.y, -q.z, -q.w}, q);
}
template <class T>
SUREFOOT_INLINE Quat8<T> rotation_between(const Vec8<T>& from, const Vec8<T>& to) noexcept {
    using F = Float8<T>;
    const F zero = F::splat(0), one = F::splat(1);
    const Vec8<T> ahead{zero, zero, one};
    const Vec8<T> a = normalized(from, ahead), b = normalized(to, ahead);
    const F c = dot(a, b);
    const Mask8<T> aside = abs(a.x) < F::splat(0.9f), opposite = c < F::splat(-0.999999f);
    const Vec8<T> helper{select(aside, one, zero), select(aside, zero, one), zero};
    const Vec8<T> axis = normalized(cross(a, helper), ahead), n = cross(a, b);
    return select(opposite, {axis.x, axis.y, axis.z, zero}, normalized(Quat8<T>{n.x, n.y, n.z, 1.0f + c}));
}

/// The part of v perpendicular to the unit vector u.
template <class T>
SUREFOOT_INLINE Vec8<T> perpendicular(const Vec8<T>& v, const Vec8<T>& u) noexcept {
    return v - u * dot(v, u);
}
template <class T>
SUREFOOT_INLINE Vec8<T> any_perpendicular(const Vec8<T>& u) noexcept {
    using F = Float8<T>;
    const F zero = F::splat(0), one = F::splat(1);
    const Mask8<T> ahead = abs(u.z) < F::splat(0.9f);
    return normalized(perpendicular({select(ahead, zero, one), zero, select(ahead, one, zero)}, u), {zero, zero, one});
}

}  // namespace lanes

/// As in two_bone.h.
template <class T>
struct TwoBoneLanes {
    Vec8<T> hip, knee, ankle, target, knee_forward;
    Float8<T> soft_extension;
};
template <class T>
struct TwoBoneLanesResult {
    Quat8<T> upper, lower;
    Vec8<T> knee, ankle;
    Mask8<T> pulled_in;
};

inline constexpr float k_short = 1e-6f;       // [m] below this, two points count as one
inline constexpr float k_fold_share = 0.05f;  // a leg folds no further than to this share of its length

template <class T>
SUREFOOT_INLINE Float8<T> soft_limit(Float8<T> distance, Float8<T> length, Float8<T> share, Float8<T> free) noexcept {
    using F = Float8<T>;
    const F start = max(length * share, min(free, length)), room = length - start;
    const Mask8<T> beyond = distance > start, has_room = room > 1e-7f * length;
    // start + room * x / (1 + x): slope 1 at the start, never reaching the length
    const F x = (distance - start) / select(has_room, room, F::splat(1));
    const F limited = start + room * x / (1.0f + select(beyond, x, F::splat(0)));
    return select(beyond, select(has_room, limited, start), distance);
}

/// Where the knee stands off the line hip -> ankle. The animated knee's offset is kept as far as it goes; what the knee
/// bends beyond that it bends towards `knee_forward`, which says more than the noise of a nearly straight leg.
template <class T>
SUREFOOT_INLINE Vec8<T> knee_direction(const TwoBoneLanes<T>& leg, const Quat8<T>& swing, const Vec8<T>& along,
                                       Float8<T> offset) noexcept {
    using namespace lanes;
    using F = Float8<T>;
    const F zero = F::splat(0);
    const Vec8<T> line = lanes::normalized(leg.ankle - leg.hip, {zero, zero, F::splat(1)});
    const Vec8<T> animated = perpendicular(leg.knee - leg.hip, line);
    const F animated_offset = lanes::length(animated);
    const Vec8<T> own = perpendicular(rotate(swing, animated), along);
    const Vec8<T> forward = perpendicular(rotate(swing, leg.knee_forward), along);
    const Vec8<T> sum = own + lanes::normalized(forward, {zero, zero, zero}) * (offset - animated_offset);
    const Mask8<T> kept = (offset <= animated_offset) & (animated_offset > F::splat(k_short));
    return lanes::normalized(lanes::select(kept, own, sum), any_perpendicular(along));
}

template <class T>
SUREFOOT_INLINE TwoBoneLanesResult<T> solve_two_bone(const TwoBoneLanes<T>& leg) noexcept {
    using F = Float8<T>;
    using Q = Quat8<T>;
    const F zero = F::splat(0), one = F::splat(1), shortest_line = F::splat(k_short);
    const Q none = Q::splat({});
    const F upper = lanes::length(leg.hip - leg.knee), lower = lanes::length(leg.knee - leg.ankle);
    const F length = upper + lower;
    const F most = F::splat(3.4e38f);  // finite, and a number
    Mask8<T> moves = (length > shortest_line) & (abs(leg.target.x) <= most) & (abs(leg.target.y) <= most) &
                     (abs(leg.target.z) <= most);
    const F animated = lanes::length(leg.hip - leg.ankle), wanted = lanes::length(leg.hip - leg.target);
    moves = moves & ~(lanes::length(leg.ankle - leg.target) <= 1e-7f * length);

    const F shortest = max(abs(upper - lower), k_fold_share * length);
    const F limited = soft_limit(wanted, length, leg.soft_extension, animated);
    const F reach = min(max(limited, min(shortest, max(animated, shortest_line))), length);
    // A target on the hip itself gives no direction: keep the animated one.
    const Vec8<T> line = lanes::normalized(leg.ankle - leg.hip, {zero, F::splat(-1), zero});
    const Mask8<T> away = wanted > shortest_line;
    const Vec8<T> along = lanes::select(away, lanes::divided(leg.target - leg.hip, select(away, wanted, one)), line);
    const Q swing = lanes::select(animated > shortest_line, lanes::rotation_between(line, along), none);

    // Cosine at the hip, by the law of cosines.
    const F below = 2.0f * upper * reach;
    const Mask8<T> triangle = below > F::splat(1e-12f);
    const F at_hip = (upper * upper + reach * reach - lower * lower) / select(triangle, below, one);
    const F cosine = select(triangle, clamp(at_hip, -1.0f, 1.0f), one);
    const F offset = upper * sqrt(max(zero, 1.0f - cosine * cosine));
    const Vec8<T> aside = knee_direction(leg, swing, along, offset);
    const Vec8<T> knee = leg.hip + along * (upper * cosine) + aside * offset, ankle = leg.hip + along * reach;

    const Vec8<T> thigh = rotate(swing, leg.knee - leg.hip), calf = rotate(swing, leg.ankle - leg.knee);
    const Q turned_upper = multiply(lanes::rotation_between(thigh, knee - leg.hip), swing);
    const Q turned_lower = multiply(lanes::rotation_between(calf, ankle - knee), swing);
    return {lanes::select(moves, lanes::select(upper > shortest_line, turned_upper, swing), none),
            lanes::select(moves, lanes::select(lower > shortest_line, turned_lower, swing), none),
            lanes::select(moves, knee, leg.knee), lanes::select(moves, ankle, leg.ankle), moves & (wanted > length)};
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
