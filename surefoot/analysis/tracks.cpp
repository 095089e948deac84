#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/tracks.h>
#include <surefoot/motion/root_motion.h>

#include <algorithm>

namespace surefoot {
namespace {

/// The highest spine joint that the rig names.
int top_joint(const RoleMap& roles) {
    for (const Role role : {Role::head, Role::neck, Role::upper_chest, Role::chest, Role::spine})
        if (roles.has(role)) return roles[role];
    return k_no_joint;
}

/// A joint and what hangs from it.
std::vector<int> joints_below(const Skeleton& skeleton, int top) {
    std::vector<int> joints;
    for (int j = std::max(top, 0); j < skeleton.joint_count(); ++j)
        if (is_within(skeleton, j, top)) joints.push_back(j);
    return joints;
}

float highest_point(const Skeleton& skeleton, const std::vector<int>& joints, const std::vector<Transform>& world) {
    float high = -1e30f;
    for (const int j : joints) {
        const std::size_t i = static_cast<std::size_t>(j);
        high = std::max({high, world[i].translation.y, transform_point(world[i], skeleton.tips[i]).y});
    }
    return high;
}

float lowest_point(const Skeleton& skeleton, const std::vector<int>& joints, const std::vector<Transform>& world) {
    float low = world[static_cast<std::size_t>(joints.front())].translation.y;
    for (const int j : joints) {
        const std::size_t i = static_cast<std::size_t>(j);
        low = std::min({low, world[i].translation.y, transform_point(world[i], skeleton.tips[i]).y});
    }
    return low;
}

template <typename T>
void append_moved(std::vector<T>& track, std::size_t count, const Transform& by) {
    for (std::size_t f = track.size() - count, end = track.size(); f < end; ++f) {
        if constexpr (std::is_same_v<T, Vec3>)
            track.push_back(transform_point(by, track[f]));
        else if constexpr (std::is_same_v<T, Transform>)
            track.push_back(by * track[f]);
    }
}
void append_shifted(std::vector<float>& track, std::size_t count, float by) {
    for (std::size_t f = track.size() - count, end = track.size(); f < end; ++f) track.push_back(track[f] + by);
}

void move_points(std::vector<Vec3>& points, const std::vector<RootFrame>& by) {
    for (std::size_t f = 0; f < points.size(); ++f) points[f] = transform_point(to_transform(by[f]), points[f]);
}
void move_frames(std::vector<Transform>& frames, const std::vector<RootFrame>& by) {
    for (std::size_t f = 0; f < frames.size(); ++f) frames[f] = to_transform(by[f]) * frames[f];
}

}  // namespace

Tracks make_tracks(const Motion& motion, const RoleMap& roles) {
    Tracks tracks;
    tracks.fps = motion.fps;
    const Skeleton& skeleton = *motion.skeleton;
    const int top = top_joint(roles);
    const Role feet[2] = {Role::left_foot, Role::right_foot}, toes[2] = {Role::left_toes, Role::right_toes};
    const Role hands[2] = {Role::left_hand, Role::right_hand};
    const Role arms[2] = {Role::left_upper_arm, Role::right_upper_arm};
    const std::vector<int> below[2] = {joints_below(skeleton, roles[feet[0]]), joints_below(skeleton, roles[feet[1]])};
    const std::vector<int> skull = top == k_no_joint ? std::vector<int>{} : joints_below(skeleton, top);
    std::vector<Transform> world(skeleton.rest.size());
    const auto at = [&](int joint) { return world[static_cast<std::size_t>(joint)]; };
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        tracks.hips.push_back(at(roles[Role::hips]));
        const Vec3 hips =
            (at(roles[Role::left_upper_leg]).translation + at(roles[Role::right_upper_leg]).translation) / 2;
        const Vec3 head = top == k_no_joint ? hips + k_up : at(top).translation;
        tracks.head.push_back(head);
        tracks.crown.push_back(skull.empty() ? head.y : highest_point(skeleton, skull, world));
        tracks.tilt.push_back(acos(normalized(head - hips, k_up).y));
        tracks.heading.push_back(torso_yaw(roles, world));
        for (std::size_t s = 0; s < 2; ++s) {
            FootTrack& foot = tracks.foot[s];
            foot.foot.push_back(at(roles[feet[s]]));
            foot.toes.push_back(roles.has(toes[s]) ? at(roles[toes[s]]) : foot.foot.back());
            foot.lowest.push_back(lowest_point(skeleton, below[s], world));
            if (roles.has(hands[s])) tracks.hand[s].push_back(at(roles[hands[s]]).translation);
            if (roles.has(arms[s])) tracks.upper_arm[s].push_back(at(roles[arms[s]]).translation);
        }
    }
    unwrap_angles(tracks.heading);
    return tracks;
}

void add_soles(Tracks& tracks, const Legs& legs) {
    for (std::size_t s = 0; s < 2; ++s) {
        FootTrack& track = tracks.foot[s];
        for (std::vector<Vec3>* points : {&track.heel, &track.mid, &track.ball, &track.tip}) points->clear();
        track.yaw.clear();
        for (std::size_t f = 0; f < track.foot.size(); ++f) {
            const SolePoints sole = sole_points(legs.side[s], track.foot[f], track.toes[f]);
            track.heel.push_back(sole.heel);
            track.mid.push_back(sole.mid);
            track.ball.push_back(sole.ball);
            track.tip.push_back(sole.toe_tip);
            const Vec3 forward = rotate(track.foot[f].rotation, legs.side[s].forward);
            track.yaw.push_back(atan2(forward.x, forward.z));
        }
        unwrap_angles(track.yaw);
    }
}

Tracks repeated(const Tracks& tracks, const RootFrame& first, const RootFrame& last) {
    Tracks result = tracks;
    const std::size_t count = tracks.hips.size() - 1;  // the last frame is the first of the next cycle
    const float turn = last.yaw - first.yaw;
    const Transform step = to_transform(last) * inverse(to_transform(first));
    for (int cycle = 1; cycle < 3; ++cycle) {
        append_moved(result.hips, count, step);
        append_moved(result.head, count, step);
        append_shifted(result.heading, count, turn);
        append_shifted(result.tilt, count, 0);
        append_shifted(result.crown, count, last.position.y - first.position.y);
        for (std::size_t s = 0; s < 2; ++s) {
            for (std::vector<Vec3>* points : {&result.hand[s], &result.upper_arm[s]})
                if (!points->empty()) append_moved(*points, count, step);
            FootTrack& foot = result.foot[s];
            append_moved(foot.foot, count, step);
            append_moved(foot.toes, count, step);
            append_shifted(foot.lowest, count, last.position.y - first.position.y);
            if (foot.heel.empty()) continue;
            for (std::vector<Vec3>* points : {&foot.heel, &foot.mid, &foot.ball, &foot.tip})
                append_moved(*points, count, step);
            append_shifted(foot.yaw, count, turn);
        }
    }
    return result;
}

void move_tracks(Tracks& tracks, const std::vector<RootFrame>& by) {
    move_frames(tracks.hips, by);
    move_points(tracks.head, by);
    for (std::size_t f = 0; f < by.size(); ++f) {
        tracks.heading[f] += by[f].yaw;
        tracks.crown[f] += by[f].position.y;
    }
    for (std::size_t s = 0; s < 2; ++s) {
        move_points(tracks.hand[s], by);
        move_points(tracks.upper_arm[s], by);
        FootTrack& foot = tracks.foot[s];
        move_frames(foot.foot, by);
        move_frames(foot.toes, by);
        for (std::size_t f = 0; f < by.size(); ++f) foot.lowest[f] += by[f].position.y;
        for (std::vector<Vec3>* points : {&foot.heel, &foot.mid, &foot.ball, &foot.tip}) move_points(*points, by);
        for (std::size_t f = 0; f < foot.yaw.size(); ++f) foot.yaw[f] += by[f].yaw;
    }
}

}  // namespace surefoot
