#include <surefoot/course/sweep.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/host/parallel.h>
#include <surefoot/host/progress.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_seconds = 16, k_seconds_eight = 60, k_seconds_turns = 30;
constexpr float k_fastest_on_steps = 1.4f, k_fastest_before_turns = 1.4f;  // [m/s]
constexpr float k_cm = 100;

/// A circle over stairs, a ledge or a kerb goes along their edges and over their ends: no way that people walk.
bool has_lone_edges(const std::string& course) { return is_stepped(course) && course != "rubble"; }

/// Neither speed nor path was asked for by name: only what makes sense.
bool makes_sense(const SweepRequest& request, const std::string& course, const std::string& path, float speed) {
    if (request.speeds_mps.empty() && is_stepped(course) && speed > k_fastest_on_steps) return false;
    if (request.speeds_mps.empty() && (path == "turns" || path == "host-turns") && speed > k_fastest_before_turns)
        return false;
    return !request.paths.empty() || path != "eight" || !has_lone_edges(course);
}

std::vector<bool> directions(const SweepRequest& request, const std::string& course) {
    if (!request.reverse.empty()) return request.reverse;
    if (course == "flat") return {false};  // the same ground
    return {false, true};
}

WalkTraces traces_of(const WalkTrack& track, const Ground& ground) {
    WalkTraces traces;
    for (std::size_t i = 0; i < track.frames.size(); i += k_trace_stride) {
        const TrackFrame& frame = track.frames[i];
        traces.hips_cm.push_back(frame.hips.y * k_cm);
        for (std::size_t side = 0; side < 2; ++side) {
            const LegTrack& leg = frame.legs[side];
            float lowest = 1e6f;
            for (const Vec3 p : leg.sole) lowest = std::min(lowest, p.y - height_at(ground, p.x, p.z));
            traces.foot_cm[side].push_back(lowest * k_cm);
            traces.knee_deg[side].push_back(static_cast<float>(knee_angle(leg)));
        }
    }
    return traces;
}

SweptWalk walk_once(const WalkInfo& info, const MakeWalker& make, std::span<const FootMode> modes) {
    const Course course = make_course(info.course, info.grade_deg, info.reverse);
    const std::unique_ptr<Walker> walker = make(info);
    const WalkComparison walks =
        compare_modes(*walker, *course.ground, info.speed_mps, info.seconds, info.limit_pace, modes);
    SweptWalk swept;
    swept.info = info;
    swept.rows = measured_walks(info, walks, modes);
    for (const FootMode mode : modes)
        swept.traces.push_back(traces_of(walks.tracks[static_cast<std::size_t>(mode)], *course.ground));
    swept.twin = traces_of(walks.twin_track, Plane());
    for (std::size_t i = 0; i < walks.twin.motion.root.size(); i += k_trace_stride) {
        const Vec3 p = walks.twin.motion.root[i].position;
        swept.ground_cm.push_back(height_at(*course.ground, p.x, p.z) * k_cm);
    }
    return swept;
}

}  // namespace

std::vector<WalkInfo> plan_sweep(const SweepRequest& request) {
    const auto& courses = request.courses.empty() ? course_names() : request.courses;
    const auto& paths = request.paths.empty() ? path_names() : request.paths;
    const auto& speeds = request.speeds_mps.empty() ? request.usual_speeds_mps : request.speeds_mps;
    std::vector<WalkInfo> walks;
    for (const std::string& course : courses)
        for (const std::string& path : paths)
            for (const float speed : speeds)
                for (const bool reverse : directions(request, course)) {
                    if (!makes_sense(request, course, path, speed)) continue;
                    const float usual = path == "eight"                           ? k_seconds_eight
                                        : path == "turns" || path == "host-turns" ? k_seconds_turns
                                                                                  : k_seconds;
                    walks.push_back({request.character, course, path, request.grade_deg, speed, reverse,
                                     request.seconds > 0 ? request.seconds : usual, request.limit_pace});
                }
    return walks;
}

std::vector<SweptWalk> sweep(const std::vector<WalkInfo>& walks, const MakeWalker& make,
                             std::span<const FootMode> modes) {
    std::vector<SweptWalk> swept(walks.size());
    Progress progress("walk", walks.size());
    parallel_for(walks.size(), [&](std::size_t i) {
        swept[i] = walk_once(walks[i], make, modes);
        progress.advance();
    });
    return swept;
}

std::vector<MeasuredWalk> all_rows(std::span<const SweptWalk> walks) {
    std::vector<MeasuredWalk> rows;
    for (const SweptWalk& walk : walks) rows.insert(rows.end(), walk.rows.begin(), walk.rows.end());
    return rows;
}

bool meets_all_marks(std::span<const SweptWalk> walks) {
    const std::vector<MeasuredWalk> rows = all_rows(walks);
    const auto judged = [](const MeasuredWalk& row) { return row.judged; };
    return std::any_of(rows.begin(), rows.end(), judged) &&
           std::none_of(rows.begin(), rows.end(),
                        [&](const MeasuredWalk& row) { return row.judged && missed_marks(row) > 0; });
}

}  // namespace surefoot
