#include <surefoot/ik/colvin_trace.h>
#include <surefoot/ik/two_bone.h>
#include <surefoot/ik/two_bone_lanes.h>

#include <algorithm>

namespace surefoot {
namespace {

/// The part of v perpendicular to the unit vector u.
Vec3 perpendicular(Vec3 v, Vec3 u) noexcept { return v - u * dot(v, u); }

Vec3 any_perpendicular(Vec3 u) noexcept {
    return normalized(perpendicular(std::fabs(u.z) < 0.9f ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, u));
}

}  // namespace

float soft_limit(float distance, float length, float share, float free) noexcept {
    const auto one = [](float x) noexcept { return Float8<Single>::splat(x); };
    return soft_limit(one(distance), one(length), one(share), one(free)).part[0];
}

float soft_floor(float distance, float least, float soft, float free) noexcept {
    const float start = std::min(soft, free), room = start - least;
    if (distance >= start || !(room > 0)) return distance;
    const float x = (start - distance) / room;
    return start - room * x / (1 + x);
}

Vec3 unfolded_target(const TwoBone& leg, float share) noexcept {
    const float upper = distance(leg.hip, leg.knee), lower = distance(leg.knee, leg.ankle);
    const float wanted = distance(leg.hip, leg.target);
    if (!(wanted > k_short)) return leg.target;  // no direction
    const auto folded = [&](float angle) {
        return std::sqrt(upper * upper + lower * lower - 2 * upper * lower * cos(angle));
    };
    const float unfolded = soft_floor(wanted, folded(k_least_fold), folded(k_soft_fold), distance(leg.hip, leg.ankle));
    return leg.target + (leg.target - leg.hip) * ((unfolded - wanted) * share / wanted);
}

Quat carry_swing(Vec3 hip, Vec3 ankle, Vec3 target) noexcept {
    const Vec3 from = ankle - hip, to = target - hip;
    if (length(from) < k_short || length(to) < k_short) return {};
    return rotation_between(from, to);
}

TwoBoneResult solve_two_bone(const TwoBone& leg) noexcept {
    using V = Vec8<Single>;
    const auto vec = [](const V& v) noexcept { return Vec3{v.x.part[0], v.y.part[0], v.z.part[0]}; };
    const auto quat = [](const Quat8<Single>& q) noexcept {
        return Quat{q.x.part[0], q.y.part[0], q.z.part[0], q.w.part[0]};
    };
    const TwoBoneLanesResult<Single> solved = solve_two_bone(
        TwoBoneLanes<Single>{V::splat(leg.hip), V::splat(leg.knee), V::splat(leg.ankle), V::splat(leg.target),
                             V::splat(leg.knee_forward), Float8<Single>::splat(leg.soft_extension)});
    return {quat(solved.upper), quat(solved.lower), vec(solved.knee), vec(solved.ankle), solved.pulled_in.part[0] != 0};
}

// --- Colvin & Kajala 2013, §IV.B

float colvin_step2_lower_root(Vec3 hip, Vec3 target, float length) noexcept {
    if (distance(hip, target) <= length) return 0;
    const float across = planar_length(target - hip);
    const float rise = across < length ? std::sqrt(length * length - across * across) : 0.0f;
    return std::min(0.0f, target.y + rise - hip.y);
}

float colvin_step3_knee_angle(float upper, float lower, float distance) noexcept {
    const float below = 2 * upper * lower;
    return below > 0 ? acos((upper * upper + lower * lower - distance * distance) / below) : 0.0f;
}

ColvinLeg colvin_step3_preset(float upper, float lower, float knee_angle, Vec3 forward) noexcept {
    const Vec3 ahead = normalized(forward);
    const Vec3 down = normalized(perpendicular({0, -1, 0}, ahead), any_perpendicular(ahead));
    ColvinLeg leg;
    leg.knee = ahead * upper;
    // The calf turns back from the thigh's own line by pi - angle, downwards.
    leg.ankle = leg.knee + (ahead * -cos(knee_angle) + down * sin(knee_angle)) * lower;
    return leg;
}

Quat colvin_step4_swing(Vec3 posed, Vec3 target) noexcept {
    const Vec3 from = normalized(posed), to = normalized(target);
    const Vec3 axis = cross(from, to);
    if (length_squared(axis) < 1e-14f)  // parallel: nothing to turn; opposite: any axis (what the 90 degrees prevent)
        return dot(from, to) > 0 ? Quat{} : axis_angle(any_perpendicular(from), static_cast<float>(k_pi));
    return axis_angle(normalized(axis), acos(std::clamp(dot(from, to), -1.0f, 1.0f)));
}

float colvin_step5_twist(Vec3 n, Vec3 c, Vec3 a) noexcept {
    return atan2(dot(n, cross(c, a)), dot(c, a) - dot(n, c) * dot(n, a));
}

TwoBoneResult solve_colvin(const ColvinInput& leg) noexcept {
    ColvinTrace trace;
    return solve_colvin(leg, trace);
}

TwoBoneResult solve_colvin(const ColvinInput& leg, ColvinTrace& trace) noexcept {
    TwoBoneResult result;
    result.knee = leg.knee;
    result.ankle = leg.ankle;
    const float upper = distance(leg.hip, leg.knee), lower = distance(leg.knee, leg.ankle);
    const float wanted = distance(leg.hip, leg.target);
    if (upper < k_short || lower < k_short || wanted < k_short || !is_finite(leg.target)) return result;
    result.pulled_in = wanted > upper + lower;

    const float angle = colvin_step3_knee_angle(upper, lower, wanted);
    const ColvinLeg posed = colvin_step3_preset(upper, lower, angle, leg.forward);
    const Vec3 line = leg.target - leg.hip;
    const Quat swing = colvin_step4_swing(posed.ankle, line);
    const Vec3 axis = line / wanted;

    // The posed thigh's perpendicular: in the plane of the leg, on the side to which the knee bends, which is up.
    const Vec3 thigh = normalized(posed.knee);
    const Vec3 posed_forward = normalized(perpendicular(k_up, thigh), any_perpendicular(thigh));
    const float twist = colvin_step5_twist(axis, rotate(swing, posed_forward), leg.upper_forward);
    const Quat turn = axis_angle(axis, twist) * swing;
    trace = {posed, swing, {rotate(swing, posed.knee), rotate(swing, posed.ankle)}, twist};
    result.knee = leg.hip + rotate(turn, posed.knee);
    result.ankle = leg.hip + rotate(turn, posed.ankle);

    // World rotations that take the animated bones there: the thigh with its knee's side, the calf with the thigh and
    // then about the knee.
    const Vec3 new_thigh = result.knee - leg.hip, old_thigh = leg.knee - leg.hip;
    const Quat carry = rotation_between(old_thigh, new_thigh);
    const Vec3 new_axis = normalized(new_thigh);
    const float roll = colvin_step5_twist(new_axis, rotate(carry, leg.upper_forward), rotate(turn, posed_forward));
    result.upper = axis_angle(new_axis, roll) * carry;
    const Vec3 calf = rotate(result.upper, leg.ankle - leg.knee);
    result.lower = rotation_between(calf, result.ankle - result.knee) * result.upper;
    return result;
}

}  // namespace surefoot
