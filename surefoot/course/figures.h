#pragma once
// The figures of a walk by name, and the mark that each has to meet: one table, which every printed table, file and
// page is made from.

#include <surefoot/course/walk.h>

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// What was walked, for titles and files.
struct WalkInfo {
    std::string character, course = "flat", path = "straight";
    float grade_deg = 15, speed_mps = 1.4f;
    bool reverse = false;  ///< from the course's far end
    float seconds = 10;
    bool limit_pace = true;  ///< it goes no faster than foot placement says
};

/// True of courses with edges to step up or down: stairs, ledge, rubble, curb.
bool is_stepped(const std::string& course);

/// "slope_up 15°, curve at 1.4 m/s from the far end".
std::string walk_title(const WalkInfo& info);

/// One walk in one mode, measured.
struct MeasuredWalk {
    WalkInfo info;
    FootMode mode = FootMode::surefoot;
    WalkMetrics metrics;
    TwinFigures twin;
    bool judged = true;  ///< false: shown to compare, its misses are its own
    /// On course flat: how far any joint is from where the twin has it [mm]; elsewhere not a number.
    double flat_change_mm = std::numeric_limits<double>::quiet_NaN();
    WalkMetrics own;  ///< of the flat twin, as a walk: what it misses is the clip's, not foot placement's
};

/// A column of the table.
struct WalkFigure {
    const char* key;   ///< in JSON, with its unit
    const char* head;  ///< of the column, short
    const char* unit;  ///< as shown
    int decimals;
    double scale;  ///< shown is the value times this
    double (*value)(const MeasuredWalk&);
    const char* mark;  ///< what is to be met, for people; null where nothing is
    /// False where the mark is missed, also where the value is no number: what was not measured is no pass. Null as
    /// `mark` is.
    bool (*met)(const MeasuredWalk&);

    bool missed(const MeasuredWalk& walk) const { return met != nullptr && !met(walk); }
    /// The un-placed twin misses it, too, on flat ground.
    bool missed_by_clip(const MeasuredWalk& walk) const;
    /// The value as shown; "–" for what is no number.
    std::string text(const MeasuredWalk& walk) const;
};

/// All of them, in the order of the table.
std::span<const WalkFigure> walk_figures();

/// How many marks a walk misses.
int missed_marks(const MeasuredWalk& walk);

/// How many judged walks over a course miss each mark.
struct CourseMisses {
    std::string course;
    int walks = 0, perfect = 0;  ///< judged, and those of them that meet every mark
    int as_clip = 0;             ///< those that miss none but what the clip itself misses on flat ground
    std::vector<int> misses;     ///< by walk_figures()
    std::vector<int> clips;      ///< those of them that the clip itself misses
};
/// Courses in the order in which they come.
std::vector<CourseMisses> misses_by_course(std::span<const MeasuredWalk> rows);

/// The rows of a comparison, one a mode. Where mode `surefoot` is among them, it alone is judged.
std::vector<MeasuredWalk> measured_walks(const WalkInfo& info, const WalkComparison& walks,
                                         std::span<const FootMode> modes = k_foot_modes);

}  // namespace surefoot
