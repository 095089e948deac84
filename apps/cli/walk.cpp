// surefoot walk PROJECT|CLIP|GAIT: walks a character over a course in three modes and says how its feet stand.

#include "command.h"
#include "live_gait.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/project.h>
#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/course/live_play.h>
#include <surefoot/course/transitions.h>
#include <surefoot/course/walk_report.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/host/files.h>
#include <surefoot/io/load.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::cli {

namespace {

struct Options {
    std::string project, course = "hills", path = "straight", ik = "surefoot";
    std::string out, metrics, filmstrip, style;
    std::vector<std::string> set;
    float grade = 15, speed = 1.4f, seconds = 10;
    bool json = false, all = false, transitions = false, reverse = false, keep_pace = false;
    CLI::Option* given_speed = nullptr;
};

/// What walks: the character of a project, the steady cycle of a clip, or gaits played live.
struct Walking {
    std::string name;
    Character character;
    GraphCharacter graph;
    LiveGait live;
    RoleMap roles;
    std::unique_ptr<Walker> walker;
};

/// Throws Error where something is asked for that only gaits played live can do.
void needs_no_live_gait(const Options& options) {
    if (options.transitions)
        throw Error("clips do not change their gait", "--transitions", "gaits played live do: surefoot walk human");
}

/// The cycle of a clip file whose speed is nearest to the one asked for.
void load_clip(const Options& options, Walking& walking) {
    needs_no_live_gait(options);
    if (options.path != "straight")
        throw Error("a clip goes the way it was made", "--path",
                    "a project of several ('surefoot author') and live gaits ('surefoot walk human') are steered");
    if (!options.set.empty())
        throw Error("a clip has no axes to set", "--set", "walk a project made by 'surefoot author'");
    const std::string paths[] = {options.project};
    const LoadResult loaded = load_clips(paths);
    if (!loaded.failed.empty()) throw Error(loaded.failed.front().error, "", "");
    std::vector<AnalyzedClip> cycles;
    for (const LoadedClip& clip : loaded.clips) {
        AnalyzedClip whole = analyze_clip(clip.motion, clip.file, clip.unit_scale);
        if (whole.facts.cyclic) {
            cycles.push_back(std::move(whole));
            continue;
        }
        for (AnalyzedClip& cycle : find_cycles(whole)) cycles.push_back(std::move(cycle));
    }
    const auto off = [&](const AnalyzedClip& clip) { return std::fabs(clip.facts.speed - options.speed); };
    const auto best =
        std::min_element(cycles.begin(), cycles.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
    if (best == cycles.end())
        throw Error("no steady cycle was found", options.project, "walk a project made by 'surefoot author'");
    walking.name = best->facts.name;
    walking.roles = best->roles.roles;
    walking.walker = make_clip_walker(best->motion, best->legs);
}

/// "drunk=0.5", or "drunk" for all of it.
void set_style(const std::string& text, const LocomotionGraph& graph, LocomotionRequest& request) {
    if (text.empty()) return;
    const std::size_t at = text.find('=');
    const std::string name = text.substr(0, at);
    std::string known;
    for (std::size_t i = 0; i < graph.styles.size(); ++i) {
        if (graph.styles[i].name == name) request.style = static_cast<std::int32_t>(i);
        known += (i > 0 ? ", " : "") + graph.styles[i].name;
    }
    if (request.style < 0)
        throw Error("the project has no style \"" + name + "\"", "--style",
                    known.empty() ? "make one with `surefoot author --style NAME=PATTERN`" : "it has " + known);
    request.style_weight = 1;
    if (at == std::string::npos) return;
    const std::string number = text.substr(at + 1);
    if (!CLI::detail::lexical_cast(number, request.style_weight) ||
        !(request.style_weight >= 0 && request.style_weight <= 1))
        throw Error("\"" + number + "\" is no weight", "--style", "give a number from 0 to 1");
}

struct Setting {
    std::string name;
    float value = 0;
};
/// "NAME=VALUE".
Setting setting_of(const std::string& text) {
    const std::size_t equals = text.find('=');
    Setting setting{text.substr(0, equals), 0};
    const char* end = text.data() + text.size();
    const bool number = equals != std::string::npos &&
                        fast_float::from_chars(text.data() + equals + 1, end, setting.value).ptr == end &&
                        equals + 1 < text.size() && std::isfinite(setting.value);
    if (!number) throw Error("'" + text + "' sets nothing", "--set", "write it as style=0.5");
    return setting;
}

/// "style=0.5" and the like, on axes that the character's spaces have.
LocomotionRequest request_of(const Options& options, const LocomotionGraph& graph) {
    LocomotionRequest request;
    request.speed = options.speed;
    set_style(options.style, graph, request);
    for (const std::string& text : options.set) {
        const auto [name, value] = setting_of(text);
        const int slot = graph.custom_slot(name);
        if (slot < 0 && name != "slope") {
            std::string names = "slope";
            for (const std::string& own : graph.custom_names) names += ", " + own;
            throw Error("the character's spaces have no axis '" + name + "'", "--set", "what can be set: " + names);
        }
        (slot < 0 ? request.slope : request.custom[static_cast<std::size_t>(slot)]) = value;
    }
    return request;
}

void load_project_character(const Options& options, Walking& walking) {
    needs_no_live_gait(options);
    std::filesystem::path file = options.project;
    if (std::filesystem::is_directory(file)) file /= "project.json";
    std::vector<std::string> warnings;
    const Project project = load_project(file, &warnings);
    walking.character = bake_character(project, file.parent_path());
    for (const std::string& warning : warnings) fmt::print(stderr, "{}\n", warning);
    for (const std::string& warning : walking.character.warnings) fmt::print(stderr, "{}\n", warning);
    walking.name = walking.character.name.empty() ? options.project : walking.character.name;
    walking.roles = walking.character.roles;
    const LocomotionRequest request = request_of(options, walking.character.graph);
    walking.walker = make_character_walker(walking.character, request, walk_path(options.path, options.seconds));
    LocomotionState state;
    if (update(walking.character.graph, state, request, 0).clamped)
        fmt::print(stderr,
                   "{:g} m/s straight ahead lies outside the clips of {}: it walks as near to that as they go\n",
                   options.speed, walking.name);
}

bool is_graph(const std::string& file) {
    const std::filesystem::path path = file;
    return path.extension() == ".json" && std::filesystem::is_regular_file(path) && is_graph_text(read_file(path));
}

void load_graph_character(const Options& options, Walking& walking) {
    needs_no_live_gait(options);
    if (!options.style.empty())
        throw Error("a graph has styles where its nodes say so", "--style", "set a parameter: --set NAME=VALUE");
    std::vector<std::string> warnings;
    walking.graph = load_graph(options.project, &warnings);
    for (const std::string& warning : warnings) fmt::print(stderr, "{}\n", warning);
    const Program& program = walking.graph.program;
    walking.name = program.name;
    walking.roles = walking.graph.roles;
    std::string names;
    for (const Parameter& parameter : program.parameters) names += (names.empty() ? "" : ", ") + parameter.name;
    std::vector<ParameterValue> values;
    for (const std::string& text : options.set) {
        const auto [name, value] = setting_of(text);
        const int parameter = program.parameter(name);
        if (parameter < 0) throw Error("the graph has no parameter '" + name + "'", "--set", "it has " + names);
        values.push_back({parameter, value});
    }
    if (program.parameter("speed") < 0)
        fmt::print(stderr, "{} has no parameter \"speed\": it goes as fast as its nodes say\n", walking.name);
    walking.walker = make_graph_walker(walking.graph, std::move(values), walk_path(options.path, options.seconds));
}

void load_gait(Options& options, Walking& walking) {
    if (!options.set.empty() || !options.style.empty())
        throw Error("a gait has neither axes nor styles to set", "--set, --style", "leave them out");
    walking.live = read_live_gait(options.project);
    const LiveGait& gait = walking.live;
    walking.name = gait.name;
    walking.roles = gait.roles;
    if (options.given_speed->count() == 0) options.speed = gait.speed;
    if (!(options.speed >= gait.least_speed && options.speed <= gait.most_speed))
        throw Error(fmt::format("{:g} m/s is not a speed of this gait", options.speed), options.project,
                    fmt::format("ask for {:g} to {:g} m/s", gait.least_speed, gait.most_speed));
    walking.walker = make_live_walker(gait.rig, {}, walk_path(options.path, options.seconds, gait.turn_deg));
}

FootMode mode_from(const std::string& text) {
    return text == "none" ? FootMode::none : text == "colvin2013" ? FootMode::colvin2013 : FootMode::surefoot;
}

/// A viewer goes by the name, and what is inside is always the same.
void check_extension(const char* option, const std::string& file, const std::string& extension) {
    if (!file.empty() && std::filesystem::path(file).extension() != extension)
        throw Error("'" + file + "' is not named " + extension, option, "only " + extension + " can be written here");
}

void check(const Options& options) {
    if (options.all && !(options.out.empty() && options.filmstrip.empty()))
        throw Error("--all walks every course, a scene or filmstrip shows one", "--all", "name one --course");
    check_extension("--output", options.out, ".glb");
    check_extension("--filmstrip", options.filmstrip, ".svg");
}

WalkInfo info_of(const Options& options, const std::string& name, const std::string& course) {
    return {name, course, options.path, options.grade, options.speed, options.reverse};
}

/// Every course, table after table, or one JSON object with all of them.
void walk_all(const Options& options, Walking& walking) {
    std::string json = "{\"walks\": [\n";
    for (const std::string& name : course_names()) {
        const WalkInfo info = info_of(options, walking.name, name);
        const Course course = make_course(name, options.grade, options.reverse);
        const WalkComparison walks =
            compare_modes(*walking.walker, *course.ground, options.speed, options.seconds, !options.keep_pace);
        json += (name == course_names().front() ? "" : ",\n") + metrics_json(info, walks);
        if (!options.json) fmt::print("{}\n", metrics_table(info, walks));
    }
    json += "]}\n";
    if (options.json) fmt::print("{}", json);
    if (!options.metrics.empty()) write_file(options.metrics, json);
}

/// Exit code 1 where some change of gait is rougher than it may be.
int judge_transitions(const Options& options, const Walking& walking) {
    const TransitionReport report = measure_transitions(walking.live.rig, usual_tasks(walking.live.rig));
    fmt::print("{}", options.json ? transitions_json(report) : transitions_table(report));
    if (!options.metrics.empty()) write_file(options.metrics, transitions_json(report));
    return report.smooth() ? 0 : 1;
}

int run(Options options) {
    check(options);
    const Course course =
        make_course(options.course, options.grade, options.reverse);  // before long work: names are easily mistyped
    Walking walking;
    if (is_live_gait(options.project))
        load_gait(options, walking);
    else if (is_clip_file(options.project) || options.project.find('#') != std::string::npos)
        load_clip(options, walking);
    else if (is_graph(options.project))
        load_graph_character(options, walking);
    else
        load_project_character(options, walking);
    if (options.transitions) return judge_transitions(options, walking);
    if (options.all) {
        walk_all(options, walking);
        return 0;
    }
    const WalkInfo info = info_of(options, walking.name, options.course);
    const WalkComparison walks =
        compare_modes(*walking.walker, *course.ground, options.speed, options.seconds, !options.keep_pace);
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
        auto options = std::make_shared<Options>();
        app.add_option("PROJECT", options->project,
                       "A project made by 'surefoot author' (its folder or file), a graph (docs/graphs.md), a clip, or "
                       "a fitted gait to be played live: "
                       "its file, or the name of a bundled one (human)")
            ->required();
        app.add_option("--course", options->course, "What to walk over")
            ->check(CLI::IsMember(course_names()))
            ->capture_default_str();
        app.add_option("--grade", options->grade, "Steepness of slope_up and slope_down, degrees")
            ->check(CLI::Range(0.0, 45.0))
            ->check(is_number)
            ->capture_default_str();
        app.add_flag("--reverse", options->reverse, "Walk the course from its far end");
        app.add_option("--path", options->path, "What is steered")
            ->check(CLI::IsMember(path_names()))
            ->capture_default_str();
        options->given_speed =
            app.add_option("--speed", options->speed, "Metres a second, negative backward; gaits have one of their own")
                ->check(CLI::Range(-10.0, 10.0))
                ->check(is_number)
                ->capture_default_str();
        app.add_option("--set", options->set,
                       "NAME=VALUE of the slope, of an axis of your own, or of a graph's parameter (repeatable)")
            ->allow_extra_args(false);
        app.add_option("--seconds", options->seconds, "How long")
            ->check(CLI::Range(0.5, 3600.0))
            ->check(is_number)
            ->capture_default_str();
        app.add_flag("--keep-pace", options->keep_pace,
                     "Keep the speed asked for even where the ground is too steep for such steps");
        app.add_option("--style", options->style, "NAME or NAME=WEIGHT (0 to 1): a style of the project");
        app.add_option("--ik", options->ik, "Foot placement of the written scene and filmstrip")
            ->check(CLI::IsMember({"none", "colvin2013", "surefoot"}))
            ->capture_default_str();
        app.add_option("-o,--output", options->out, "Write the walk as a .glb: character, terrain, contacts");
        app.add_option("--metrics", options->metrics, "Write the metrics as JSON");
        app.add_option("--filmstrip", options->filmstrip, "Draw the walk as an .svg, without and with foot placement");
        app.add_flag("--json", options->json, "Print the metrics as JSON");
        app.add_flag("--all", options->all, "Walk every course");
        app.add_flag(
            "--transitions", options->transitions,
            "Of a live gait: how smoothly it goes from each way of going to each other, at any moment; exit code "
            "1 where it does not");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
