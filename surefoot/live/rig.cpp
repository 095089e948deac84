#include <surefoot/live/mixture.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

Limb limb_of(const Skeleton& skeleton, const Legs& legs, int joint) noexcept {
    for (std::size_t side = 0; side < 2; ++side)
        if (is_within(skeleton, joint, legs.side[side].upper)) return static_cast<Limb>(side);
    return Limb::trunk;
}

/// Arms are found by their roles; what hangs on them belongs to them.
void find_limbs(LiveRig& rig) {
    const Skeleton& skeleton = *rig.skeleton;
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, rig.stand, models);
    const RoleMap roles = find_roles(skeleton, models).roles;
    const std::array<int, 2> arms{roles[Role::left_upper_arm], roles[Role::right_upper_arm]};
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        Limb limb = limb_of(skeleton, rig.soles, j);
        for (std::size_t side = 0; side < 2; ++side)
            if (arms[side] != k_no_joint && is_within(skeleton, j, arms[side]))
                limb = side == 0 ? Limb::left_arm : Limb::right_arm;
        rig.limb.push_back(static_cast<std::uint8_t>(limb));
    }
}

/// The mean posture of a gait's slowest: its series without their waves.
std::vector<Transform> mean_posture(const HarmonicGait& gait, std::vector<float> values) {
    const auto series = static_cast<std::size_t>(1 + 2 * gait.harmonics);
    const std::size_t joints = 3 * (gait.mean.size() + gait.moving.size());
    for (std::size_t i = 0; i < joints; ++i)
        std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(i * series + 1), series - 1, 0.0f);
    std::vector<Transform> locals(gait.mean.size());
    const float phase = 0;
    joint_pose(gait, values, {}, {&phase, 1}, locals);
    return locals;
}

/// How much higher the hips may be with both feet under them: legs as straight as people stand.
float rise_of(const LiveRig& rig, const std::vector<Transform>& locals, const std::array<FootGoal, 2>& feet) {
    constexpr float k_straight = 0.975f;  // share of a leg's length: a knee bent by 26 degrees
    std::vector<Transform> models(locals.size());
    local_to_model(*rig.skeleton, locals, models);
    float rise = 1;
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = rig.soles.side[side];
        const Vec3 hip = models[static_cast<std::size_t>(leg.upper)].translation, ankle = feet[side].foot.translation;
        const float aside = planar_length(hip - ankle), reach = k_straight * leg.length();
        rise = std::min(rise, ankle.y + std::sqrt(std::max(0.0f, reach * reach - aside * aside)) - hip.y);
    }
    return rise;
}

std::array<FootGoal, 2> goals_of(const LiveRig& rig) {
    std::array<FootGoal, 2> goals;
    for (std::size_t side = 0; side < 2; ++side) {
        const FootPrint& print = rig.stand_print[side];
        goals[side] = {stand_on(rig.legs.side[side], print.rotation, print.heel, print.ball), print.toes};
    }
    return goals;
}

/// Flat on the ground: the rotation that its heel and ball ask for when both are at the sole's height.
void level(FootPrint& print, const LegPaths::Side& leg) {
    const Vec3 sole = rotate(print.rotation, leg.ball - leg.heel);
    const Vec3 flat = normalized(Vec3{sole.x, 0, sole.z}, {0, 0, 1}) * length(sole);
    print.rotation = normalized(rotation_between(sole, flat) * print.rotation);
    const Vec3 middle = (print.heel + print.ball) * 0.5f;
    print.heel = Vec3{middle.x, 0, middle.z} - flat * 0.5f;
    print.ball = Vec3{middle.x, 0, middle.z} + flat * 0.5f;
}

/// The stand's own posture stays: only what the idle does about its mean is taken from it.
void add_idle(LiveRig& rig) {
    const HarmonicGait& idle = *rig.idle;
    std::vector<float> values(static_cast<std::size_t>(value_count(idle)));
    values_at(idle, 0, 0, values);
    rig.idle_hz = rhythm_of(idle, values).frequency;
    const std::vector<Transform> mean = mean_posture(idle, values);
    for (std::size_t j = 0; j < mean.size(); ++j)
        rig.idle_to_stand.push_back(
            {rig.stand[j].rotation * conjugate(mean[j].rotation), rig.stand[j].translation - mean[j].translation});
    rig.idle_lanes = HarmonicLanes(idle, {});
    rig.idle_values.resize(rig.idle_lanes.value_count());
    rig.idle_lanes.values_at(0, 0, rig.idle_values);
}

/// The angle of the joint that has farthest to go [deg].
float farthest(const std::vector<Transform>& from, const std::vector<Transform>& to) {
    float most = 0;
    for (std::size_t j = 0; j < std::min(from.size(), to.size()); ++j)
        most = std::max(most, length(to_rotation_vector(conjugate(from[j].rotation) * to[j].rotation)));
    return most / k_radians_per_degree;
}

/// A cubic glide through an angle A accelerates by 6 A / T^2 at most.
void find_changes(LiveRig& rig) {
    constexpr float k_near_deg = 20, k_most_deg_s2 = 40;
    std::vector<Transform> first;
    for (std::size_t m = 0; m < std::min<std::size_t>(rig.manners.size(), k_most_manners); ++m) {
        const std::shared_ptr<const HarmonicGait>& gait = rig.manners[m].gait;
        if (!gait || !problem(*gait).empty()) continue;
        std::vector<float> values(static_cast<std::size_t>(value_count(*gait)));
        values_at(*gait, gait->family() ? gait->basis.least_speed : 0, 0, values);
        const std::vector<Transform> posture = mean_posture(*gait, values);
        if (m == 0) first = posture;
        const float angle = farthest(first, posture);
        rig.change_seconds[m] = angle < k_near_deg ? 0 : std::sqrt(6 * angle / k_most_deg_s2);
    }
}

Vec3 direction_of(const HarmonicGait& gait) noexcept {
    const Vec3 velocity = rhythm_at(gait, 1, 0).velocity;
    return normalized(Vec3{velocity.x, 0, velocity.z}, {0, 0, 1});
}

std::string problem_of(const LiveRig& rig, const HarmonicGait& gait) {
    if (const std::string text = problem(gait); !text.empty()) return ": " + text;
    if (gait.skeleton != rig.skeleton && !(*gait.skeleton == *rig.skeleton)) return " is of another skeleton";
    return {};
}

}  // namespace

LiveRig make_live_rig(std::vector<LiveManner> manners, std::shared_ptr<const HarmonicGait> idle) {
    LiveRig rig;
    rig.manners = std::move(manners);
    rig.idle = std::move(idle);
    if (rig.manners.empty() || !rig.manners.front().gait || !problem(*rig.manners.front().gait).empty()) return rig;
    const HarmonicGait& first = *rig.manners.front().gait;
    rig.skeleton = first.skeleton;
    rig.soles = first.soles;
    rig.legs = first.legs;
    if (rig.legs.count == 0) return rig;
    std::vector<float> values(static_cast<std::size_t>(value_count(first)));
    values_at(first, first.family() ? first.basis.least_speed : 0, 0, values);
    rig.stand = mean_posture(first, values);
    for (std::size_t side = 0; side < 2; ++side) {
        rig.stand_print[side] = foot_print(first, values, side, 0.5f * first.foot_lift);
        level(rig.stand_print[side], rig.legs.side[side]);
        rig.stand_place[side] = place_of(rig.stand_print[side].heel, rig.stand_print[side].ball);
    }
    std::array<FootGoal, 2> goals = goals_of(rig);
    rig.stand[static_cast<std::size_t>(rig.soles.hips)].translation.y += rise_of(rig, rig.stand, goals);
    settle_on_feet(*rig.skeleton, rig.soles, rig.legs, goals, rig.stand);
    find_limbs(rig);
    find_changes(rig);
    if (!problem(rig).empty()) return rig;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        rig.lanes.emplace_back(*rig.manners[m].gait, rig.limb);
        rig.direction[m] = direction_of(*rig.manners[m].gait);
    }
    if (rig.idle) add_idle(rig);
    return rig;
}

std::string problem(const LiveRig& rig) {
    if (rig.manners.empty()) return "there is no gait";
    if (rig.manners.size() > k_most_manners)
        return "there are more than " + std::to_string(k_most_manners) + " manners";
    for (const LiveManner& manner : rig.manners) {
        if (!manner.gait) return "the manner '" + manner.name + "' has no gait";
        if (const std::string text = problem_of(rig, *manner.gait); !text.empty())
            return "the gait '" + manner.name + "'" + text;
        if (manner.gait->legs.count == 0) return "the gait '" + manner.name + "' knows no legs";
    }
    if (rig.idle)
        if (const std::string text = problem_of(rig, *rig.idle); !text.empty()) return "the idle" + text;
    return {};
}

LiveScratch::LiveScratch(const LiveRig& rig) : manners(rig.lanes.size()), locals(rig.stand.size()) {
    for (std::size_t m = 0; m < manners.size(); ++m) manners[m].values.resize(rig.lanes[m].value_count());
}

}  // namespace surefoot
