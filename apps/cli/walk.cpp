// surefoot walk PROJECT|CLIP|GAIT: walks a character over one course or all, in three modes, and says how its feet
// stand.

#include "command.h"
#include "walking.h"

#include <surefoot/base/error.h>
#include <surefoot/course/transitions.h>
#include <surefoot/course/walk_page.h>
#include <surefoot/course/walk_report.h>
#include <surefoot/course/walk_table.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::cli {

namespace {

FootMode mode_from(const std::string& text) {
    return text == "none" ? FootMode::none : text == "colvin2013" ? FootMode::colvin2013 : FootMode::surefoot;
}

/// A viewer goes by the name, and what is inside is always the same.
void check_extension(const char* option, const std::string& file, const std::string& extension) {
    if (!file.empty() && std::filesystem::path(file).extension() != extension)
        throw Error("'" + file + "' is not named " + extension, option, "only " + extension + " can be written here");
}

void check(const WalkOptions& options) {
    if (options.all && !options.filmstrip.empty())
        throw Error("--all walks every course, a filmstrip shows one", "--all", "name one --course");
    if (!options.all && (options.courses.size() > 1 || options.paths.size() > 1 || options.speeds.size() > 1))
        throw Error("one walk has one course, path and speed", "--course, --path, --speed",
                    "add --all to walk each with each");
    if (!options.all && options.markdown) throw Error("only --all has a table for documents", "--markdown", "");
    check_extension("--output", options.out, options.all ? ".html" : ".glb");
    check_extension("--filmstrip", options.filmstrip, ".svg");
}

WalkInfo info_of(const WalkOptions& options, const std::string& name) {
    return {name,
            options.course(),
            options.path(),
            options.grade,
            options.speed(),
            options.reverse,
            options.length(),
            !options.keep_pace};
}

/// Speeds to sweep where none are named: all usual ones that the character can go at.
std::vector<float> usual_speeds(const Walking& walking) {
    std::vector<float> speeds;
    for (const float speed : k_sweep_speeds)
        if (walking.goes_at(speed))
            speeds.push_back(speed);
        else
            fmt::print(stderr, "{:g} m/s is left out: {} does not go at that\n", speed, walking.name);
    if (speeds.empty()) throw Error("no usual speed is one of its own", walking.name, "name one with --speed");
    return speeds;
}

std::string sweep_json(const std::vector<SweptWalk>& walks) {
    std::string json = "{\"walks\": [\n";
    for (const SweptWalk& walk : walks) json += (&walk == &walks.front() ? "" : ",\n") + walk_json(walk.rows);
    return json + "]}\n";
}

SweepRequest request_of(const WalkOptions& options, const Walking& walking) {
    SweepRequest request;
    request.courses = options.courses;
    request.paths = walking.steered ? options.paths : std::vector<std::string>{"straight"};
    request.speeds_mps = options.speeds;
    if (request.speeds_mps.empty()) request.usual_speeds_mps = usual_speeds(walking);
    if (options.reverse) request.reverse = {true};
    request.character = walking.name;
    request.grade_deg = options.grade;
    request.seconds = options.seconds;
    request.limit_pace = !options.keep_pace;
    return request;
}

/// Every course, every way, in one table. Exit code 1 where a judged walk misses a mark.
int walk_all(const WalkOptions& options, const Walking& walking) {
    std::vector<FootMode> modes(k_foot_modes.begin(), k_foot_modes.end());
    if (!options.ik.empty()) modes = {mode_from(options.ik)};
    const std::vector<SweptWalk> walks = sweep(plan_sweep(request_of(options, walking)), walking.make, modes);
    const std::vector<MeasuredWalk> rows = all_rows(walks);
    const std::string json = sweep_json(walks);
    if (options.json)
        fmt::print("{}", json);
    else
        fmt::print("{}\nHow many walks miss each mark:\n\n{}",
                   options.markdown ? walk_markdown(rows) : walk_table(rows, TableLayout::many),
                   misses_table(rows, options.markdown));
    if (!options.metrics.empty()) write_file(options.metrics, json);
    if (!options.out.empty()) {
        const std::optional<ColvinStudy> study = study_colvin(walks, walking.make);
        write_file(options.out, walk_page(walking.name, walks, study ? &*study : nullptr, walking.roles));
    }
    const auto judged = [](const MeasuredWalk& row) { return row.judged; };
    const auto meets = [](const MeasuredWalk& row) { return row.judged && missed_marks(row) == 0; };
    fmt::print(stderr, "{} of {} walks meet every mark\n", std::count_if(rows.begin(), rows.end(), meets),
               std::count_if(rows.begin(), rows.end(), judged));
    return meets_all_marks(walks) ? 0 : 1;
}

/// Exit code 1 where some change of gait is rougher than it may be.
int judge_transitions(const WalkOptions& options, const Walking& walking) {
    const TransitionReport report = measure_transitions(walking.live.rig, usual_tasks(walking.live.rig));
    fmt::print("{}", options.json ? transitions_json(report) : transitions_table(report));
    if (!options.metrics.empty()) write_file(options.metrics, transitions_json(report));
    return report.smooth() ? 0 : 1;
}

int run(WalkOptions options) {
    check(options);
    const Course course =
        make_course(options.course(), options.grade, options.reverse);  // before long work: names are easily mistyped
    Walking walking;
    load_walking(options, walking);
    if (options.transitions) return judge_transitions(options, walking);
    if (options.all) return walk_all(options, walking);
    const WalkInfo info = info_of(options, walking.name);
    const WalkComparison walks =
        compare_modes(*walking.make(info), *course.ground, info.speed_mps, info.seconds, info.limit_pace);
    const std::string json = metrics_json(info, walks);
    if (options.json)
        fmt::print("{}", json);
    else
        fmt::print("{}", metrics_table(info, walks));
    const FootMode mode = mode_from(options.ik);
    if (!options.metrics.empty()) write_file(options.metrics, json);
    if (!options.filmstrip.empty())
        write_file(options.filmstrip, walk_filmstrip(info, course, walks, mode, walking.roles));
    if (!options.out.empty()) write_file(options.out, walk_glb(info, course, walks, mode, walking.roles));
    return 0;
}

}  // namespace

extern const Command k_walk;
const Command k_walk{
    "walk", "Walk a character over a course and measure how its feet stand", [](CLI::App& app) {
        auto options = std::make_shared<WalkOptions>();
        app.add_option("PROJECT", options->project,
                       "A project made by 'surefoot author' (its folder or file), a graph (docs/graphs.md), a pack of "
                       "either, a clip, or a fitted gait to be played live: "
                       "its file, or the name of a bundled one (human)")
            ->required();
        app.add_option("--course", options->courses, "What to walk over; hills, or with --all every one (repeatable)")
            ->delimiter(',')
            ->allow_extra_args(false)
            ->check(CLI::IsMember(course_names()));
        app.add_option("--grade", options->grade, "Steepness of slope_up and slope_down, degrees")
            ->check(CLI::Range(0.0, 45.0))
            ->check(is_number)
            ->capture_default_str();
        app.add_flag("--reverse", options->reverse, "Walk the course from its far end");
        app.add_option("--path", options->paths, "What is steered; straight, or with --all every one (repeatable)")
            ->delimiter(',')
            ->allow_extra_args(false)
            ->check(CLI::IsMember(path_names()));
        app.add_option("--speed", options->speeds,
                       "Metres a second, negative backward; 1.4, gaits have one of their own, with --all 0.8 to 4 "
                       "(repeatable)")
            ->delimiter(',')
            ->allow_extra_args(false)
            ->check(CLI::Range(-10.0, 10.0))
            ->check(is_number);
        app.add_option("--set", options->set,
                       "NAME=VALUE of the slope, of an axis of your own, of a graph's parameter, or of a fitted "
                       "gait's slider (repeatable)")
            ->allow_extra_args(false);
        app.add_option("--seconds", options->seconds, "How long; 10, with --all 16, with turns 30, on an eight 60")
            ->check(CLI::Range(0.5, 3600.0))
            ->check(is_number);
        app.add_flag("--keep-pace", options->keep_pace,
                     "Keep the speed asked for even where the ground is too steep for such steps");
        app.add_option("--style", options->style,
                       "NAME or NAME=WEIGHT (0 to 1): a style of the project; of a fitted gait a personality, tired, "
                       "proud, sneaky, drunk, elderly or FILE.json#NAME");
        app.add_option("--ik", options->ik,
                       "Foot placement of the written scene and filmstrip (surefoot); with --all, the only one walked")
            ->check(CLI::IsMember({"none", "colvin2013", "surefoot"}));
        app.add_option(
            "-o,--output", options->out,
            "Write the walk as a .glb: character, terrain, contacts; with --all an .html page of every walk");
        app.add_option("--metrics", options->metrics, "Write the metrics as JSON");
        app.add_option("--filmstrip", options->filmstrip, "Draw the walk as an .svg, without and with foot placement");
        app.add_flag("--json", options->json, "Print the metrics as JSON");
        app.add_flag("--all", options->all,
                     "Walk every course on every path at every speed from both ends, as far as it makes sense; "
                     "--course, --path, --speed, --reverse and --ik narrow it. Exit code 1 where a mark is missed (!)");
        app.add_flag("--markdown", options->markdown, "With --all: print the table for documents");
        app.add_flag(
            "--transitions", options->transitions,
            "Of a live gait: how smoothly it goes from each way of going to each other, at any moment; exit code "
            "1 where it does not");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
