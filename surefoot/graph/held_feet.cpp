#include <surefoot/graph/held_feet.h>
#include <surefoot/ik/two_bone.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_rise_from = 0.99f;      // of a leg's length: knees of 164 degrees
constexpr float k_longest_leg = 0.9985f;  // of its length: knees of 174 degrees
constexpr float k_most_rise = 60 * k_radians_per_degree;

/// [rad] by which to turn `ankle` about the ball, both as seen from there in the plane of the sole's direction and up,
/// so that it comes within `reach` of the hip, which is `aside` of that plane.
float rise_angle(Vec3 ankle, Vec3 hip, Vec3 along, float aside, float reach) noexcept {
    const auto square_of = [](float x) noexcept { return x * x; };
    const float ankle_along = dot(ankle, along), hip_along = dot(hip, along);
    const float ankle_square = square_of(ankle_along) + square_of(ankle.y),
                hip_square = square_of(hip_along) + square_of(hip.y), product = std::sqrt(ankle_square * hip_square);
    if (!(product > 0)) return 0;
    const float between = atan2(hip_along, hip.y) - atan2(ankle_along, ankle.y);
    const float cosine = (ankle_square + hip_square + square_of(aside) - square_of(reach)) / (2 * product);
    return std::clamp(between - acos(std::clamp(cosine, -1.0f, 1.0f)), 0.0f, k_most_rise);
}

}  // namespace

float step_height(const LegPaths::Side& leg, float done) noexcept {
    constexpr float k_of_sole = 0.3f;
    const float bump = 4 * done * (1 - done);
    return bump * bump * k_of_sole * length(leg.ball - leg.heel);
}

void hold_at(const LegPaths::Side& leg, const FootOffset& hold, FootGoal& goal) noexcept {
    if (hold == FootOffset{}) return;
    goal.foot.translation += Vec3{hold.x, step_height(leg, hold.step), hold.z};
    goal.foot.rotation = from_yaw(hold.yaw) * goal.foot.rotation;
}

void hold_plan(const LegPaths::Side& leg, const FootOffset& hold, FootPlan& plan) noexcept {
    if (hold.step > 0) {
        plan.next = plan.now;
        plan.steps = true;
        plan.share = hold.step;
        plan.stance = 0;
    }
    hold_at(leg, hold, plan.now);
}

void rise_on_ball(const LegPaths::Side& leg, const BlendedLeg& pose, FootGoal& goal) noexcept {
    if (leg.toes == k_no_joint) return;
    const float full = distance(pose.hip, pose.knee) + distance(pose.knee, pose.ankle);
    const float far = distance(pose.hip, goal.foot.translation);
    const float reach = soft_limit(far, k_longest_leg * full, k_rise_from, distance(pose.hip, pose.ankle));
    if (!(reach < far)) return;
    const Vec3 ball = transform_point(goal.foot, leg.ball), sole = ball - transform_point(goal.foot, leg.heel);
    const Vec3 along = normalized(Vec3{sole.x, 0, sole.z}), across = cross(k_up, along);
    const Vec3 ankle = goal.foot.translation - ball, hip = pose.hip - ball;
    const Quat roll = axis_angle(across, rise_angle(ankle, hip, along, dot(hip - ankle, across), reach));
    const Quat toes = goal.foot.rotation * goal.toes;
    goal.foot = {normalized(roll * goal.foot.rotation), ball + rotate(roll, ankle)};
    goal.toes = normalized(conjugate(goal.foot.rotation) * toes);
}

}  // namespace surefoot
