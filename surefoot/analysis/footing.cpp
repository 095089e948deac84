#include <surefoot/analysis/footing.h>
#include <surefoot/analysis/signal.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_floor_band = 0.015f;     // [m] soles on one floor scatter by about this in motion capture
constexpr float k_shin_slant = 0.16f;      // sine of 9 degrees: CMU's rest pose splays the legs by 20, a T-pose by none
constexpr float k_lowest_layer = 0.12f;    // of the leg's length: a toe tip dips that far below the floor at push-off
constexpr float k_own_ground = 0.05f;      // [m] soles of a skinned rig this near to y = 0 stand on y = 0
constexpr float k_sole_thickness = 0.05f;  // [m] toe joints of skinned rigs stand up to this above the floor at y = 0

constexpr float k_toes_up = 0.17f;        // sine of 10 degrees: a foot that comes down on its heel
constexpr float k_clearly_long = 0.8f;    // of a heel ends outside the ground
constexpr float k_shortest_heel = 0.25f;  // of the way from ankle to ball; skinned characters have 0.17 to 0.27

constexpr float k_feet_alike = 1.5f;  // one foot's ankle stands at most this much higher than the other's

std::vector<Transform> rest_models(const Skeleton& skeleton) {
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    return models;
}

float lowest_of_foot(const Skeleton& skeleton, const std::vector<Transform>& models, int foot) {
    float low = models[static_cast<std::size_t>(foot)].translation.y;
    for (int j = foot; j < skeleton.joint_count(); ++j) {
        if (!is_within(skeleton, j, foot)) continue;
        const std::size_t i = static_cast<std::size_t>(j);
        low = std::min({low, models[i].translation.y, transform_point(models[i], skeleton.tips[i]).y});
    }
    return low;
}

/// Does this pose show a character standing on two flat feet with upright shins?
bool stands(const Skeleton& skeleton, const RoleMap& roles, const std::vector<Transform>& models, float& floor) {
    const Role lower[2] = {Role::left_lower_leg, Role::right_lower_leg}, foot[2] = {Role::left_foot, Role::right_foot};
    const Role upper[2] = {Role::left_upper_leg, Role::right_upper_leg}, toes[2] = {Role::left_toes, Role::right_toes};
    const auto at = [&](Role role) { return models[static_cast<std::size_t>(roles[role])].translation; };
    float low[2], leg = 0;
    for (int s = 0; s < 2; ++s) {
        const Vec3 shin = at(lower[s]) - at(foot[s]), thigh = at(upper[s]) - at(lower[s]);
        leg = length(shin) + length(thigh);
        if (!(leg > 0.05f) || planar_length(shin) > k_shin_slant * length(shin) || shin.y < 0 || thigh.y < 0)
            return false;
        if (!roles.has(toes[s])) return false;  // without a toe the rest pose does not show which way the foot points
        const Vec3 instep = at(toes[s]) - at(foot[s]);
        if (planar_length(instep) < 0.5f * length(instep) || instep.y > 0) return false;
        low[s] = lowest_of_foot(skeleton, models, roles[foot[s]]);
    }
    if (std::fabs(low[0] - low[1]) > 0.02f * leg) return false;
    floor = std::min(low[0], low[1]);
    if (floor > -0.01f * leg && floor < k_sole_thickness * leg) floor = 0;
    return true;
}

/// The frame in which a foot lies flattest: ankle and toes at the heights where they spend their standing time, and
/// still. `rest_height` receives the height of the foot's lowest point there.
int flattest_frame(const FootTrack& foot, float fps) {
    const std::size_t n = foot.foot.size();
    const float low = densest(foot.lowest, k_floor_band);
    std::vector<float> ankle, toes, standing;
    for (std::size_t f = 0; f < n; ++f) {
        ankle.push_back(foot.foot[f].translation.y);
        toes.push_back(foot.toes[f].translation.y);
        if (std::fabs(foot.lowest[f] - low) < k_floor_band) standing.push_back(ankle.back());
    }
    // In a run the ankle stands highest at push-off; the flat foot is in the lower part of what it does on the ground.
    const float ankle_height = percentile(standing, 0.25f);
    const std::vector<float> ankle_speed = derivative(ankle, fps), toe_speed = derivative(toes, fps);
    std::size_t best = 0;
    float best_cost = 1e30f;
    for (std::size_t f = 0; f < n; ++f) {
        const float height = std::fabs(foot.lowest[f] - low) + 0.5f * std::fabs(ankle[f] - ankle_height);
        const float cost = height + 0.05f * (std::fabs(ankle_speed[f]) + std::fabs(toe_speed[f]));
        if (cost < best_cost) best = f, best_cost = cost;
    }
    return static_cast<int>(best);
}

/// What share of the heel, from below the ankle backwards, is out of the ground: one number for each frame in which the
/// toes are up, the heel is in it, and the rest is not.
void add_shares_outside(const Leg& leg, const FootTrack& track, std::vector<float>& shares) {
    const Vec3 under_ankle = leg.heel - leg.forward * dot(leg.heel, leg.forward);
    for (const Transform& foot : track.foot) {
        if (rotate(foot.rotation, leg.forward).y < k_toes_up) continue;
        const float front = transform_point(foot, under_ankle).y, back = transform_point(foot, leg.heel).y;
        if (front > 0 && back < 0) shares.push_back(front / (front - back));
    }
}

/// The level on which soles spend most of their time, sought in the lowest layer so that a run, whose feet are longer
/// in the air than on the ground, has its ground there, too.
float floor_level(const std::vector<float>& heights, float leg_length) {
    const float layer = percentile(heights, 0.02f) + k_lowest_layer * leg_length;
    std::vector<float> low;
    for (const float height : heights)
        if (height <= layer) low.push_back(height);
    return densest(low, k_floor_band);
}

std::vector<float> lowest_sole(const FootTrack& foot) {
    std::vector<float> low;
    for (std::size_t f = 0; f < foot.heel.size(); ++f)
        low.push_back(std::min({foot.heel[f].y, foot.ball[f].y, foot.tip[f].y}));
    return low;
}

std::vector<float> sole_heights(const Tracks& tracks) {
    std::vector<float> heights;
    for (const FootTrack& foot : tracks.foot) {
        const std::vector<float> low = lowest_sole(foot);
        heights.insert(heights.end(), low.begin(), low.end());
    }
    return heights;
}

}  // namespace

float floor_under(const Motion& motion, const RoleMap& roles, const Legs& legs) {
    Tracks tracks = make_tracks(motion, roles);
    add_soles(tracks, legs);
    const float floor = floor_level(sole_heights(tracks), legs.side[0].length());
    return std::fabs(floor) < k_floor_band ? 0 : floor;
}

Footing find_footing(const Motion& motion, const RoleMap& roles, const Tracks& tracks) {
    Footing footing;
    const Skeleton& skeleton = *motion.skeleton;
    std::vector<Transform> models = rest_models(skeleton);
    float rest_floor = 0;
    if (stands(skeleton, roles, models, rest_floor)) {
        footing.from_rest = true;
        footing.legs = make_legs(skeleton, roles, models, rest_floor);
        Tracks soles = tracks;
        add_soles(soles, footing.legs);
        const std::vector<float> heights = sole_heights(soles);
        footing.floor = floor_level(heights, footing.legs.side[0].length());
        if (std::fabs(percentile(heights, 0.03f)) < k_own_ground) footing.floor = 0;
    } else {
        std::vector<float> heights;
        for (const FootTrack& foot : tracks.foot) heights.insert(heights.end(), foot.lowest.begin(), foot.lowest.end());
        for (std::size_t s = 0; s < 2; ++s) {
            const int frame = flattest_frame(tracks.foot[s], tracks.fps);
            world_pose(motion, frame, models);
            const float own_floor = tracks.foot[s].lowest[static_cast<std::size_t>(frame)];
            const Legs legs = make_legs(skeleton, roles, models, own_floor);
            footing.legs.hips = legs.hips;
            footing.legs.side[s] = legs.side[s];
        }
        footing.floor = floor_level(heights, footing.legs.side[0].length());
    }
    if (std::fabs(footing.floor) < k_floor_band) footing.floor = 0;
    return footing;
}

Legs matched_soles(const Motion& motion, const RoleMap& roles, const Legs& legs) {
    const auto ankle = [](const Leg& leg) { return -dot(leg.ball, leg.up); };
    const std::size_t good = ankle(legs.side[0]) <= ankle(legs.side[1]) ? 0 : 1, other = 1 - good;
    const Leg& flat = legs.side[good];
    if (ankle(legs.side[other]) <= k_feet_alike * ankle(flat) + 0.01f * flat.length()) return legs;
    const Tracks tracks = make_tracks(motion, roles);
    // Where the good foot lies as flat as it was when it was measured, it is on the ground.
    float ground = 0, most_upright = -2;
    for (std::size_t f = 0; f < tracks.foot[good].foot.size(); ++f) {
        const float upright = rotate(tracks.foot[good].foot[f].rotation, flat.up).y;
        if (upright > most_upright) most_upright = upright, ground = tracks.foot[good].lowest[f];
    }
    const FootTrack& foot = tracks.foot[other];
    std::size_t best = 0;
    float best_cost = 1e30f;
    for (std::size_t f = 0; f < foot.foot.size(); ++f) {
        const float above = foot.foot[f].translation.y - foot.lowest[f];
        const float cost = std::fabs(foot.lowest[f] - ground) + std::fabs(above - ankle(flat));
        if (cost < best_cost) best = f, best_cost = cost;
    }
    std::vector<Transform> models(motion.skeleton->rest.size());
    world_pose(motion, static_cast<int>(best), models);
    Legs matched = legs;
    matched.side[other] = make_leg(*motion.skeleton, roles, static_cast<Side>(other), models, foot.lowest[best]);
    return matched;
}

Legs rounded_heels(const Legs& legs, std::span<const Tracks> clips) {
    std::vector<float> outside;
    for (const Tracks& clip : clips)
        for (std::size_t side = 0; side < 2; ++side) add_shares_outside(legs.side[side], clip.foot[side], outside);
    const float share = percentile(outside, 0.25f);
    if (outside.empty() || share > k_clearly_long) return legs;
    Legs rounded = legs;
    for (Leg& leg : rounded.side) {
        const float heel = -dot(leg.heel, leg.forward), least = k_shortest_heel * dot(leg.ball, leg.forward);
        const float shorter = std::max(heel - std::max(share * heel, least), 0.0f);
        leg.heel += leg.forward * shorter;
        leg.mid += leg.forward * (0.5f * shorter);
    }
    return rounded;
}

}  // namespace surefoot
