#include <surefoot/rig/leg.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Proportions of a human foot of length 1 from heel to toe tip.
constexpr float k_heel_to_ankle = 0.25f;
constexpr float k_heel_to_ball = 0.7f;
// Toes are half as long as the foot from heel to ball, where nothing says how long they are.
constexpr float k_toes_per_sole = 0.5f;
// Toe tip ahead of the ankle, in ankle-to-ball distances (1.8 by the proportions above).
constexpr float k_shortest_tip = 1.3f, k_longest_tip = 2.4f;
// Foot length over leg length (hip to ankle), 0.152 / 0.491 of stature (Drillis and Contini 1966).
constexpr float k_foot_per_leg = 0.31f;

// Walking on toes: the ankle stands this many times as high above the sole as it lies behind the ball, or behind the
// tip where nothing says where the ball is. A human foot of which the heel is raised by 35 degrees has 2; flat, about
// half.
constexpr float k_raised_over_ball = 2.0f, k_raised_over_tip = 1.5f;
// What such a foot stands on reaches this far behind the ball, in lengths of the toes.
constexpr float k_pad_behind_ball = 0.4f;

Vec3 level(Vec3 v) { return {v.x, 0, v.z}; }

// Farthest end of what hangs from a joint: its tip, or that of unnamed end joints below it ("ball_leaf_l").
Vec3 far_end(const Skeleton& skeleton, std::span<const Transform> standing, int joint) {
    const Vec3 from = standing[at(joint)].translation;
    Vec3 farthest = from;
    for (int j = joint; j < skeleton.joint_count(); ++j) {
        if (!is_within(skeleton, j, joint)) continue;
        const Vec3 end = transform_point(standing[at(j)], skeleton.tips[at(j)]);
        if (planar_length(end - from) > planar_length(farthest - from)) farthest = end;
    }
    return farthest;
}

// Where the body looks in this pose: the hips' left is where the left thigh is.
Vec3 facing(const RoleMap& roles, std::span<const Transform> standing) {
    const Vec3 left =
        standing[at(roles[Role::left_upper_leg])].translation - standing[at(roles[Role::right_upper_leg])].translation;
    return normalized(cross(level(left), k_up));
}

// Horizontal distances ahead of the ankle along the foot.
struct Sole {
    Vec3 forward;
    float ball = 0, tip = 0, heel = 0;  // heel: behind the ankle
};

/// The sole of one who walks on its toes (a digitigrade): under the toes alone. Needs the foot to be such a one.
Sole toe_sole(Vec3 facing, Vec3 to_ball, Vec3 to_end, float least, float usual) {
    Sole sole;
    sole.forward = length(to_end - to_ball) > least ? normalized(to_end - to_ball) : facing;
    const bool ends = dot(to_end - to_ball, sole.forward) > least;
    sole.ball = dot(to_ball, sole.forward);
    sole.tip = ends ? dot(to_end, sole.forward) : sole.ball + 0.5f * usual;
    sole.heel = k_pad_behind_ball * (sole.tip - sole.ball) - sole.ball;
    return sole;
}

Sole measure_sole(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing, const Leg& leg,
                  float floor) {
    const Vec3 ankle = standing[at(leg.foot)].translation;
    const float usual = k_foot_per_leg * leg.length();
    // Shorter than this, an offset says nothing about direction or length.
    const float least = 0.1f * usual;
    const bool toes = leg.toes != k_no_joint;
    Sole sole;
    const Vec3 end = far_end(skeleton, standing, toes ? leg.toes : leg.foot);
    const Vec3 to_ball = toes ? level(standing[at(leg.toes)].translation - ankle) : Vec3{};
    const Vec3 to_end = level(end - ankle);
    const float height = ankle.y - floor;
    if (toes && height > k_raised_over_ball * std::max(length(to_ball), least))
        return toe_sole(facing(roles, standing), to_ball, to_end, least, usual);
    if (!toes && length(to_end) > least && height > k_raised_over_tip * length(to_end))
        return toe_sole(facing(roles, standing), 0.5f * to_end, to_end, least, usual);
    sole.forward = length(to_ball) > least  ? normalized(to_ball)
                   : length(to_end) > least ? normalized(to_end)
                                            : facing(roles, standing);
    if (length(to_ball) > least) {
        sole.ball = dot(to_ball, sole.forward);
        const float tip = dot(to_end, sole.forward);
        if (tip > sole.ball + 0.05f * usual) {
            // Exporters give end joints and tips any length they like: hold them within what toes can be.
            sole.tip = std::clamp(tip, k_shortest_tip * sole.ball, k_longest_tip * sole.ball);
            sole.heel = sole.tip * k_heel_to_ankle / (1 - k_heel_to_ankle);
        } else {
            // Heel h behind, ball b ahead, toes (b + h) / 2: h is a quarter of the whole for h = 0.6 b.
            constexpr float k_quarter = k_heel_to_ankle * (1 + k_toes_per_sole);
            sole.heel = sole.ball * k_quarter / (1 - k_quarter);
            sole.tip = sole.ball + k_toes_per_sole * (sole.ball + sole.heel);
        }
        return sole;
    }
    float whole = usual;
    if (const float reach = dot(to_end, sole.forward); reach > least) {
        // One end point only: the toe tip, or the ball where it is nearer to where a ball would be.
        const float to_tip = (1 - k_heel_to_ankle), ball = (k_heel_to_ball - k_heel_to_ankle);
        whole = reach > 0.5f * (to_tip + ball) * usual ? reach / to_tip : reach / ball;
        whole = std::clamp(whole, 0.75f * usual, 1.5f * usual);  // cartoon feet are long, none is a point
    }
    sole.heel = k_heel_to_ankle * whole;
    sole.ball = (k_heel_to_ball - k_heel_to_ankle) * whole;
    sole.tip = (1 - k_heel_to_ankle) * whole;
    return sole;
}

}  // namespace

std::string problem(const Legs& legs, const Skeleton& skeleton) {
    const int joints = skeleton.joint_count();
    const auto is_joint = [&](int joint) { return joint >= 0 && joint < joints; };
    if (!is_joint(legs.hips)) return "the hips of the legs are no joint";
    for (const Leg& leg : legs.side) {
        if (!is_joint(leg.upper) || !is_joint(leg.lower) || !is_joint(leg.foot) ||
            (leg.toes != k_no_joint && !is_joint(leg.toes)))
            return "a leg names a joint that is not there";
        if (leg.upper == leg.lower || leg.lower == leg.foot || !is_within(skeleton, leg.upper, legs.hips) ||
            !is_within(skeleton, leg.lower, leg.upper) || !is_within(skeleton, leg.foot, leg.lower) ||
            (leg.toes != k_no_joint && !is_within(skeleton, leg.toes, leg.foot)))
            return "the joints of a leg do not follow one another from the hips to the foot";
        for (const float bone : {leg.upper_length, leg.lower_length})
            if (!(bone > 0 && std::isfinite(bone))) return "a bone of a leg has no length";
        for (const Vec3 v : {leg.heel, leg.mid, leg.ball, leg.toe_tip, leg.up, leg.forward})
            if (!is_finite(v)) return "a sole has no finite place";
        for (const Vec3 direction : {leg.up, leg.forward})
            if (std::fabs(length_squared(direction) - 1) > 1e-2f) return "a foot does not know which way it points";
    }
    return {};
}

SolePoints sole_points(const Leg& leg, const Transform& foot, const Transform& toes) noexcept {
    const Transform& front = leg.toes == k_no_joint ? foot : toes;
    return {transform_point(foot, leg.heel), transform_point(foot, leg.mid), transform_point(foot, leg.ball),
            transform_point(front, leg.toe_tip)};
}

Leg make_leg(const Skeleton& skeleton, const RoleMap& roles, Side side, std::span<const Transform> standing,
             float floor) {
    assert(roles.has_legs() && standing.size() >= skeleton.parents.size());
    const auto joint = [&](Role left) { return roles[side == Side::left ? left : mirrored(left)]; };
    Leg leg;
    leg.upper = joint(Role::left_upper_leg);
    leg.lower = joint(Role::left_lower_leg);
    leg.foot = joint(Role::left_foot);
    leg.toes = joint(Role::left_toes);
    std::vector<Transform> rest(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, rest);
    leg.upper_length = distance(rest[at(leg.upper)].translation, rest[at(leg.lower)].translation);
    leg.lower_length = distance(rest[at(leg.lower)].translation, rest[at(leg.foot)].translation);

    const Sole sole = measure_sole(skeleton, roles, standing, leg, floor);
    const Transform& foot = standing[at(leg.foot)];
    const Vec3 under = {foot.translation.x, floor, foot.translation.z};
    const auto on_floor = [&](float ahead) { return under + sole.forward * ahead; };
    const Transform to_foot = inverse(foot);
    leg.heel = transform_point(to_foot, on_floor(-sole.heel));
    leg.ball = transform_point(to_foot, on_floor(sole.ball));
    leg.mid = transform_point(to_foot, on_floor(0.5f * (sole.ball - sole.heel)));
    const Transform to_front = leg.toes == k_no_joint ? to_foot : inverse(standing[at(leg.toes)]);
    leg.toe_tip = transform_point(to_front, on_floor(sole.tip));
    leg.up = normalized(rotate(to_foot.rotation, k_up), k_up);
    leg.forward = normalized(rotate(to_foot.rotation, sole.forward));
    return leg;
}

Legs make_legs(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing, float floor) {
    Legs legs;
    legs[Side::left] = make_leg(skeleton, roles, Side::left, standing, floor);
    legs[Side::right] = make_leg(skeleton, roles, Side::right, standing, floor);
    legs.hips = roles[Role::hips];
    return legs;
}

}  // namespace surefoot
