#include <surefoot/crowd/crowd_feet.h>
#include <surefoot/ik/hips.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

constexpr float k_plane = 0.25f;  // [m] a plane is trusted so far from its place

Vec3 sole_centre(const LegPaths::Side& leg, const Transform& foot) noexcept {
    return transform_point(foot, 0.5f * (leg.heel + leg.ball));
}

float height_at(const GroundPlane& plane, Vec3 place) noexcept {
    const auto near = [](float x) { return std::clamp(x, -k_plane, k_plane); };
    return plane.height + plane.slope_x * near(place.x - plane.x) + plane.slope_z * near(place.z - plane.z);
}

GroundPlane plane_of(const GroundHit& hit, Vec3 place, float otherwise, float steepest) noexcept {
    if (!hit.hit) return {place.x, place.z, otherwise, 0, 0};
    const float up = std::max(hit.normal.y, 1e-3f), x = -hit.normal.x / up, z = -hit.normal.z / up;
    const float slope = std::sqrt(x * x + z * z), share = slope > steepest ? steepest / slope : 1.0f;
    return {place.x, place.z, hit.height, share * x, share * z};
}

float smooth(float t) noexcept {
    t = std::clamp(t, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// The ground as a foot sees it just now.
GroundPlane ground_under(const CrowdFoot& foot, const FootPlan& plan, Vec3 place) noexcept {
    GroundPlane ground = foot.to;
    ground.height = height_at(foot.to, place);
    if (plan.swings()) {
        // Over an edge first up, and only then down.
        constexpr float k_over = 0.7f;  // share of the swing that it takes
        const float from = height_at(foot.from, place), u = (plan.share - plan.stance) / (1 - plan.stance);
        const float rises = ground.height > from ? u / k_over : (u - 1) / k_over + 1, turned = smooth(u);
        ground.height = from + (ground.height - from) * smooth(rises);
        ground.slope_x = foot.from.slope_x + (foot.to.slope_x - foot.from.slope_x) * turned;
        ground.slope_z = foot.from.slope_z + (foot.to.slope_z - foot.from.slope_z) * turned;
    }
    ground.x = place.x;
    ground.z = place.z;
    return ground;
}

/// Lays a foot onto the ground, both as seen from a root of that rotation at height 0.
Transform laid(const LegPaths::Side& leg, const Transform& foot, const GroundPlane& ground, Quat root) noexcept {
    const Vec3 slope = rotate(conjugate(root), {ground.slope_x, 0, ground.slope_z});
    const Vec3 centre = sole_centre(leg, foot);
    const auto lifted = [&](Vec3 p) {
        const Vec3 off = p - centre;
        p.y += ground.height + slope.x * off.x + slope.z * off.z;
        return p;
    };
    const Vec3 heel = lifted(transform_point(foot, leg.heel)), ball = lifted(transform_point(foot, leg.ball));
    const Quat tilt = rotation_between({0, 1, 0}, {-slope.x, 1, -slope.z});
    return stand_on(leg, normalized(tilt * foot.rotation), heel, ball);
}

}  // namespace

int CrowdFeetStep::ask(const LegPaths& paths, const FootPlans& plans, CrowdFeet& feet, const RootFrame& root,
                       const CrowdFeetSettings& settings, std::span<GroundQuery> queries) noexcept {
    constexpr float k_dragged = 0.1f;  // [m] farther from its place a standing foot stands elsewhere
    const Transform frame = to_transform(root);
    int count = 0;
    is_new_ = feet.foot[0].share < 0;
    for (std::size_t side = 0; side < 2; ++side) {
        CrowdFoot& foot = feet.foot[side];
        const FootPlan& plan = plans.side[side];
        centre_[side] = transform_point(frame, sole_centre(paths.side[side], plan.now.foot));
        const bool strikes = !plan.steps || plan.share < foot.share;
        if (strikes) foot.from = foot.to;
        foot.share = plan.share;
        const Vec3 off = centre_[side] - Vec3{foot.to.x, centre_[side].y, foot.to.z};
        const bool dragged = !plan.swings() && planar_length(off) > k_dragged;
        lands_[side] = is_new_ || dragged;
        asks_[side] = lands_[side] || plan.swings();
        if (!asks_[side]) continue;
        asked_[side] = plan.swings() && !is_new_ ? transform_point(frame, sole_centre(paths.side[side], plan.next.foot))
                                                 : centre_[side];
        queries[static_cast<std::size_t>(count++)] = {
            {asked_[side].x, root.position.y, asked_[side].z}, settings.up, settings.down};
    }
    return count;
}

void CrowdFeetStep::place(const LegPaths& paths, const FootPlans& plans, CrowdFeet& feet, RootFrame& root,
                          std::span<const GroundHit> hits, float dt, const CrowdFeetSettings& settings, LegLanes& legs,
                          int pose) noexcept {
    std::array<GroundPlane, 2> ground;
    std::size_t answer = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        CrowdFoot& foot = feet.foot[side];
        if (asks_[side]) {
            const float otherwise = is_new_ ? root.position.y : foot.from.height;
            foot.to = plane_of(hits[answer++], asked_[side], otherwise, settings.steepest);
            if (lands_[side]) foot.from = foot.to;
        }
        ground[side] = ground_under(foot, plans.side[side], centre_[side]);
    }
    const Quat heading = from_yaw(root.yaw);
    const float middle = 0.5f * (ground[0].height + ground[1].height);
    std::array<FootGoal, 2> goals;
    for (std::size_t side = 0; side < 2; ++side) {
        goals[side] = {laid(paths.side[side], plans.side[side].now.foot, ground[side], heading),
                       plans.side[side].now.toes};
        goals[side].foot.translation.y -= middle;
    }
    constexpr float k_reach = 0.99f;
    const float target = middle - legs.sink_to_reach(pose, goals, k_reach);
    HeightSpring height{is_new_ ? target : root.position.y, feet.rise};
    if (!is_new_) height.step(target, 2 / settings.rise, dt);
    root.position.y = height.value;
    feet.rise = height.rate;
    for (FootGoal& goal : goals) goal.foot.translation.y += middle - root.position.y;
    legs.set_goals(pose, goals);
}

}  // namespace surefoot
