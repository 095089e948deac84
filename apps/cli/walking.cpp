// Loads what walks: a project's character, a graph, a clip's steady cycle, or gaits played live.

#include "walking.h"

#include "fitted_clips.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/base/error.h>
#include <surefoot/course/live_play.h>
#include <surefoot/io/load.h>

#include <CLI/CLI.hpp>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot::cli {

namespace {

/// Throws Error where something is asked for that only gaits played live can do.
void needs_no_live_gait(const WalkOptions& options) {
    if (options.transitions)
        throw Error("clips do not change their gait", "--transitions", "gaits played live do: surefoot walk human");
}

/// The cycle of a clip file whose speed is nearest to the one asked for.
void load_clip(const WalkOptions& options, Walking& walking) {
    needs_no_live_gait(options);
    if (options.path() != "straight" || options.paths.size() > 1)
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
    const auto off = [&](const AnalyzedClip& clip) { return std::fabs(clip.facts.speed - options.speed()); };
    const auto best =
        std::min_element(cycles.begin(), cycles.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
    if (best == cycles.end())
        throw Error("no steady cycle was found", options.project, "walk a project made by 'surefoot author'");
    walking.name = best->facts.name;
    walking.roles = best->roles.roles;
    walking.steered = false;
    walking.goes_at = [own = best->facts.speed](float speed) {
        constexpr float k_stretch = 1.5f;  // faster or slower, and the cycle is no longer what was captured
        return speed <= own * k_stretch && speed >= own / k_stretch;
    };
    walking.make = [motion = best->motion, legs = best->legs](const WalkInfo&) {
        return make_clip_walker(motion, legs);
    };
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
LocomotionRequest request_of(const WalkOptions& options, const LocomotionGraph& graph) {
    LocomotionRequest request;
    request.speed = options.speed();
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

void load_project_character(const WalkOptions& options, Walking& walking) {
    walking.character = to_character(walking.file.pack);
    walking.name = walking.character.name.empty() ? options.project : walking.character.name;
    walking.roles = walking.character.roles;
    const LocomotionRequest request = request_of(options, walking.character.graph);
    walking.make = [&walking, request](const WalkInfo& info) {
        return make_character_walker(walking.character, request, walk_path(info.path, info.seconds));
    };
    walking.goes_at = [&walking, request](float speed) {
        LocomotionState state;
        LocomotionRequest asked = request;
        asked.speed = speed;
        return !update(walking.character.graph, state, asked, 0).clamped;
    };
    for (const float speed : options.all ? options.speeds : std::vector<float>{options.speed()})
        if (!walking.goes_at(speed))
            fmt::print(stderr,
                       "{:g} m/s straight ahead lies outside the clips of {}: it walks as near to that as they go\n",
                       speed, walking.name);
}

void load_graph_character(const WalkOptions& options, Walking& walking) {
    if (!options.style.empty())
        throw Error("a graph has styles where its nodes say so", "--style", "set a parameter: --set NAME=VALUE");
    const Program& program = walking.file.pack.program;
    walking.name = program.name;
    walking.roles = walking.file.pack.roles;
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
    walking.make = [&walking, values = std::move(values)](const WalkInfo& info) {
        return make_graph_walker(walking.file.pack, values, walk_path(info.path, info.seconds));
    };
}

/// A project, a graph, or a pack of either.
void load_character(const WalkOptions& options, Walking& walking) {
    needs_no_live_gait(options);
    walking.file = read_character_file(options.project);
    walking.file.pack.has_program() ? load_graph_character(options, walking) : load_project_character(options, walking);
}

void load_gait(WalkOptions& options, Walking& walking) {
    walking.live = read_live_gait(options.project, fitted_style(options.style, options.set, {"--style", "--set"}));
    const LiveGait& gait = walking.live;
    walking.name = gait.name;
    walking.roles = gait.roles;
    if (options.speeds.empty() && !options.all) options.speeds = {gait.speed};
    walking.goes_at = [&gait](float speed) { return speed >= gait.least_speed && speed <= gait.most_speed; };
    for (const float speed : options.speeds)
        if (!walking.goes_at(speed))
            throw Error(fmt::format("{:g} m/s is not a speed of this gait", speed), options.project,
                        fmt::format("ask for {:g} to {:g} m/s", gait.least_speed, gait.most_speed));
    walking.make = [&gait](const WalkInfo& info) {
        return make_live_walker(gait.rig, {}, walk_path(info.path, info.seconds, gait.turn_deg));
    };
}

}  // namespace

void load_walking(WalkOptions& options, Walking& walking) {
    if (is_live_gait(options.project))
        load_gait(options, walking);
    else if (is_clip_file(options.project) || options.project.find('#') != std::string::npos)
        load_clip(options, walking);
    else
        load_character(options, walking);
}

}  // namespace surefoot::cli
