#include <surefoot/course/colvin_study.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_degrees = static_cast<float>(180 / k_pi);
constexpr float k_bent = 150 * k_radians_per_degree;

/// Two walks of the same way, and what is needed to see how one became the other.
struct TwoWalks {
    Motion animated, placed;
    FootRig rig;
};

ColvinMoment moment_at(const TwoWalks& walks, const Ground& ground, int frame) {
    ColvinMoment moment;
    const auto joints = static_cast<std::size_t>(walks.animated.joint_count());
    moment.time_s = static_cast<float>(frame) / k_walk_fps;
    moment.root = walks.animated.root[static_cast<std::size_t>(frame)];
    moment.animated.resize(joints);
    moment.placed.resize(joints);
    std::vector<Transform> models(joints);
    local_to_model(*walks.animated.skeleton, walks.animated.frame(frame), models);
    FootInput input;
    input.root = moment.root;
    input.legs = read_legs(walks.rig, models);
    moment.steps = colvin_frame(walks.rig, input, ground);
    for (std::size_t side = 0; side < 2; ++side) solve_colvin(moment.steps.legs[side], moment.traces[side]);
    world_pose(walks.animated, frame, moment.animated);
    world_pose(walks.placed, frame, moment.placed);
    return moment;
}

/// The leg that needs the sinking: the one whose target is farthest from the hip.
std::size_t stretched_side(const ColvinFrame& steps) {
    const auto far = [&](std::size_t side) { return distance(steps.legs[side].hip, steps.legs[side].target); };
    return far(0) >= far(1) ? 0 : 1;
}

/// Straight legs hardly show the plane of their knee: bent it must be, as animated and as it comes out.
bool shows_plane(const ColvinInput& leg) {
    const float upper = distance(leg.hip, leg.knee), lower = distance(leg.knee, leg.ankle);
    return colvin_step3_knee_angle(upper, lower, distance(leg.hip, leg.ankle)) < k_bent &&
           colvin_step3_knee_angle(upper, lower, distance(leg.hip, leg.target)) < k_bent;
}

}  // namespace

float knee_plane_deg(const ColvinInput& leg, Vec3 knee) noexcept {
    const Vec3 axis = normalized(leg.target - leg.hip);
    const auto off_axis = [&](Vec3 v) { return normalized(v - axis * dot(v, axis), {0, 0, 0}); };
    const Vec3 a = off_axis(knee), b = off_axis(leg.knee - leg.hip);
    return atan2(length(cross(a, b)), dot(a, b)) * k_degrees;
}

ColvinStudy study_colvin(Walker& walker, const WalkInfo& info) {
    const Course course = make_course(info.course, info.grade_deg, info.reverse);
    const auto walked = [&](FootMode mode) {
        return walk(walker, *course.ground, {info.speed_mps, info.seconds, mode, false}).motion;
    };
    FootSettings settings;
    settings.mode = FootMode::colvin2013;
    const TwoWalks walks{walked(FootMode::none), walked(FootMode::colvin2013),
                         make_foot_rig(*walker.skeleton(), walker.legs(), walker.standing(), settings)};
    ColvinStudy study;
    study.info = info;
    study.ground = course.ground;
    study.legs = walker.legs();
    float farthest_off = -1;
    for (int f = 0; f < walks.animated.frame_count(); ++f) {
        ColvinMoment moment = moment_at(walks, *course.ground, f);
        for (std::size_t side = 0; side < 2; ++side) {
            const float off = knee_plane_deg(moment.steps.legs[side], moment.traces[side].swung.knee);
            if (off <= farthest_off || !shows_plane(moment.steps.legs[side])) continue;
            farthest_off = off;
            study.turned = moment;
            study.turned.side = side;
        }
        if (f == 0 || moment.steps.lowered < study.sunk.steps.lowered) {
            moment.side = stretched_side(moment.steps);
            study.sunk = std::move(moment);
        }
    }
    if (study.turned.placed.empty()) study.turned = study.sunk;  // legs that never bend
    return study;
}

std::optional<ColvinStudy> study_colvin(std::span<const SweptWalk> walks, const MakeWalker& make) {
    const auto shows = [](const SweptWalk& walk) {
        return walk.info.course == "hills" &&
               std::any_of(walk.rows.begin(), walk.rows.end(),
                           [](const MeasuredWalk& row) { return row.mode == FootMode::colvin2013; });
    };
    constexpr float k_usual = 1.4f, k_turns = 100;  // [m/s]
    const auto unusual = [](const SweptWalk& walk) {
        return std::fabs(walk.info.speed_mps - k_usual) + (walk.info.path == "straight" ? 0 : k_turns);
    };
    const SweptWalk* chosen = nullptr;
    for (const SweptWalk& walk : walks)
        if (shows(walk) && (!chosen || unusual(walk) < unusual(*chosen))) chosen = &walk;
    if (!chosen) return {};
    return study_colvin(*make(chosen->info), chosen->info);
}

}  // namespace surefoot
