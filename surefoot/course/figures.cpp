#include <surefoot/course/figures.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot {
namespace {

using Walk = MeasuredWalk;

/// Knees may be jerked more where there are edges to step over. Raw clips hit straight knees and inflate any ratio:
/// ratio or absolute bound.
bool knee_met(const Walk& w) {
    const bool steps = is_stepped(w.info.course);
    return w.metrics.knee_peak_ratio <= (steps ? 3.0 : 1.8) || w.metrics.knee_peak_deg_s2 <= (steps ? 30000 : 22000);
}

/// The flat twin of a walk whose host turns it is placed as well: what it must not do itself is drag.
bool skate_met(const Walk& w) {
    constexpr double k_most_more = 0.5, k_most_by_host = 1.5;  // [cm/s]
    return w.metrics.skate_cm_s - w.twin.skate_cm_s <= k_most_more &&
           (w.info.path != "host-turns" || w.metrics.skate_cm_s <= k_most_by_host);
}

/// Some clips drag their own feet.
bool drag_met(const Walk& w) {
    constexpr double k_most = 3, k_most_more = 1;  // [cm]
    return w.metrics.drag_cm <= k_most || w.metrics.drag_cm <= w.own.drag_cm + k_most_more;
}

constexpr double k_percent = 100;

// A mark compares so that a value that is no number misses it.
constexpr WalkFigure k_figures[] = {
    {"skate_cm_s", "skate", "cm/s", 2, 1, [](const Walk& w) { return w.metrics.skate_cm_s; },
     "at most 0.5 above the flat twin's own; where the host turns it, at most 1.5", skate_met},
    {"skate_level_cm_s", "level", "cm/s", 2, 1, [](const Walk& w) { return w.metrics.skate_level_cm_s; }, nullptr,
     nullptr},
    {"twin_skate_cm_s", "twin skate", "cm/s", 2, 1, [](const Walk& w) { return w.twin.skate_cm_s; }, nullptr, nullptr},
    {"skate_share", "skating", "%", 1, k_percent, [](const Walk& w) { return w.metrics.skate_share; }, nullptr,
     nullptr},
    {"skate_weighted_cm", "weighted", "cm", 3, 1, [](const Walk& w) { return w.metrics.skate_weighted_cm; }, nullptr,
     nullptr},
    {"drag_cm", "drag", "cm", 1, 1, [](const Walk& w) { return w.metrics.drag_cm; },
     "at most 3, or 1 above the flat twin's own", drag_met},
    {"penetration_heel_ball_cm", "heel, ball sunk", "cm", 2, 1,
     [](const Walk& w) { return w.metrics.penetration_heel_ball_cm; }, "at most 1.5",
     [](const Walk& w) { return w.metrics.penetration_heel_ball_cm <= 1.5; }},
    {"penetration_toe_mid_cm", "toe, mid sunk", "cm", 2, 1,
     [](const Walk& w) { return w.metrics.penetration_toe_mid_cm; }, "at most 2.5",
     [](const Walk& w) { return w.metrics.penetration_toe_mid_cm <= 2.5; }},
    {"penetration_mean_cm", "mean sunk", "cm", 3, 1, [](const Walk& w) { return w.metrics.penetration_mean_cm; },
     "at most 0.2", [](const Walk& w) { return w.metrics.penetration_mean_cm <= 0.2; }},
    {"float_max_cm", "float max", "cm", 1, 1, [](const Walk& w) { return w.metrics.float_max_cm; }, nullptr, nullptr},
    {"float_mean_cm", "float mean", "cm", 2, 1, [](const Walk& w) { return w.metrics.float_mean_cm; }, "at most 0.5",
     [](const Walk& w) { return w.metrics.float_mean_cm <= 0.5; }},
    {"sole_angle_deg", "sole mean", "°", 2, 1, [](const Walk& w) { return w.metrics.sole_angle_deg; }, "at most 1",
     [](const Walk& w) { return w.metrics.sole_angle_deg <= 1; }},
    {"sole_angle_worst_deg", "sole worst", "°", 2, 1, [](const Walk& w) { return w.metrics.sole_angle_worst_deg; },
     "at most 6", [](const Walk& w) { return w.metrics.sole_angle_worst_deg <= 6; }},
    {"over_extensions", "over-ext.", "", 0, 1, [](const Walk& w) { return double(w.metrics.over_extensions); }, "none",
     [](const Walk& w) { return w.metrics.over_extensions == 0; }},
    {"knee_peak_ratio", "knee peak", "× flat", 2, 1, [](const Walk& w) { return w.metrics.knee_peak_ratio; },
     "at most 1.8 or 22,000 °/s²; 3 or 30,000 on steps", knee_met},
    {"knee_peak_deg_s2", "knee peak", "1000 °/s²", 1, 0.001, [](const Walk& w) { return w.metrics.knee_peak_deg_s2; },
     nullptr, nullptr},
    {"knee_min_deg", "knee least", "°", 1, 1, [](const Walk& w) { return w.metrics.knee_min_deg; }, "at least 40",
     [](const Walk& w) { return w.metrics.knee_min_deg >= 40; }},
    {"hip_jerk_ratio", "hip jerk", "× flat", 2, 1, [](const Walk& w) { return w.metrics.hip_jerk_ratio; }, "at most 2",
     [](const Walk& w) { return w.metrics.hip_jerk_ratio <= 2; }},
    {"drift_m", "drift", "m", 2, 1, [](const Walk& w) { return w.metrics.drift_m; }, "on an eight: 1 % of the path",
     [](const Walk& w) { return w.info.path != "eight" || w.metrics.drift_m <= 0.01 * w.twin.path_m; }},
    {"drift_deg", "turned off", "°", 1, 1, [](const Walk& w) { return w.metrics.drift_deg; }, "on an eight: at most 2",
     [](const Walk& w) { return w.info.path != "eight" || w.metrics.drift_deg <= 2; }},
    {"flat_change_mm", "change", "mm", 2, 1, [](const Walk& w) { return w.flat_change_mm; },
     "on flat ground: at most 1", [](const Walk& w) { return w.info.course != "flat" || w.flat_change_mm <= 1; }},
    {"planted_samples", "samples", "", 0, 1, [](const Walk& w) { return double(w.metrics.planted_samples); },
     "some: an empty set is no pass", [](const Walk& w) { return w.metrics.planted_samples > 0; }},
};

}  // namespace

bool is_stepped(const std::string& course) {
    static const std::array<std::string, 5> stepped{"stairs_up", "stairs_down", "ledge", "rubble", "curb_oblique"};
    return std::find(stepped.begin(), stepped.end(), course) != stepped.end();
}

std::string walk_title(const WalkInfo& info) {
    const bool graded = info.course == "slope_up" || info.course == "slope_down";
    return (graded ? fmt::format("{} {:g}°", info.course, info.grade_deg) : info.course) +
           fmt::format(", {} at {:g} m/s", info.path, info.speed_mps) + (info.reverse ? " from the far end" : "");
}

std::string WalkFigure::text(const MeasuredWalk& walk) const {
    const double shown = value(walk) * scale;
    return std::isfinite(shown) ? fmt::format("{:.{}f}", shown, decimals) : "–";
}

bool WalkFigure::missed_by_clip(const MeasuredWalk& walk) const {
    MeasuredWalk clip = walk;
    clip.metrics = walk.own;
    clip.flat_change_mm = 0;
    return missed(clip);
}

std::span<const WalkFigure> walk_figures() { return k_figures; }

int missed_marks(const MeasuredWalk& walk) {
    return static_cast<int>(std::count_if(std::begin(k_figures), std::end(k_figures),
                                          [&](const WalkFigure& figure) { return figure.missed(walk); }));
}

std::vector<CourseMisses> misses_by_course(std::span<const MeasuredWalk> rows) {
    const std::vector<int> none(std::size(k_figures));
    std::vector<CourseMisses> courses;
    for (const MeasuredWalk& row : rows) {
        if (!row.judged) continue;
        auto at = std::find_if(courses.begin(), courses.end(),
                               [&](const CourseMisses& each) { return each.course == row.info.course; });
        if (at == courses.end()) at = courses.insert(at, {row.info.course, 0, 0, 0, none, none});
        ++at->walks;
        int own = 0;
        for (std::size_t i = 0; i < std::size(k_figures); ++i) {
            const bool missed = k_figures[i].missed(row), by_clip = missed && k_figures[i].missed_by_clip(row);
            at->misses[i] += missed;
            at->clips[i] += by_clip;
            own += by_clip;
        }
        at->perfect += missed_marks(row) == 0;
        at->as_clip += missed_marks(row) == own;
    }
    return courses;
}

std::vector<MeasuredWalk> measured_walks(const WalkInfo& info, const WalkComparison& walks,
                                         std::span<const FootMode> modes) {
    const bool surefoot_walked = std::find(modes.begin(), modes.end(), FootMode::surefoot) != modes.end();
    std::vector<MeasuredWalk> rows;
    for (const FootMode mode : modes) {
        const auto i = static_cast<std::size_t>(mode);
        MeasuredWalk row;
        row.info = info;
        row.mode = mode;
        row.metrics = walks.metrics[i];
        row.twin = walks.twin_figures;
        row.own = walks.twin_metrics;
        row.judged = mode == FootMode::surefoot || !surefoot_walked;
        if (info.course == "flat")
            row.flat_change_mm =
                1000 * static_cast<double>(largest_distance(walks.walked[i].motion, walks.twin.motion));
        rows.push_back(row);
    }
    return rows;
}

}  // namespace surefoot
