// surefoot gait GAIT: what a gait is made of, its controls as a table and as a picture, and clips of it.

#include "actor.h"
#include "clip_files.h"
#include "command.h"
#include "fitted_clips.h"
#include "gait_clips.h"
#include "parameters.h"

#include <surefoot/author/fitted_gaits.h>
#include <surefoot/base/error.h>
#include <surefoot/gait_clip/gait_clip.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace surefoot::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string gait, preset, plot, table, out, rig = "default", personality;
    std::vector<std::string> set, roles;
    GaitMoments moments;
    GaitPlay play;
    bool check = false, as_fitted = false, json = false;
    CLI::Option *speed = nullptr, *turn = nullptr;  // whether they were given
};

int list(bool json) {
    Json all = Json::array();
    for (const std::string& name : k_gaits.list()) {
        const Gait gait = read_gait(bundled_gait(name), name + ".gait");
        all.push_back({{"name", name}, {"help", gait.help}});
        if (!json) print(fmt::format("{:<24} {}\n", name, gait.help));
    }
    for (const NamedGait& gait : fitted_gaits()) {
        all.push_back({{"name", gait.name}, {"help", gait.help}});
        if (!json) print(fmt::format("{:<24} {}\n", gait.name, gait.help));
    }
    if (json) print_json(Json{{"gaits", all}});
    return 0;
}

Json described(const Gait& gait, const std::vector<double>& values) {
    Json json{{"name", gait.name},
              {"help", gait.help},
              {"parameters", parameters_json(gait.parameters, values)},
              {"outputs", Json::array()}};
    for (const GaitOutput& output : gait.outputs)
        json["outputs"].push_back(
            {{"name", output.name}, {"control", output.control}, {"unit", output.unit}, {"help", output.help}});
    json["presets"] = presets_json(gait.presets, gait.parameters);
    json["instructions"] = gait.program.instructions.size();
    json["registers"] = gait.program.registers;
    json["warnings"] = gait.warnings;
    return json;
}

void describe(const Gait& gait, const std::vector<double>& values) {
    print(fmt::format("{}{}{}\n\n", gait.name, gait.help.empty() ? "" : ": ", gait.help));
    print_parameters(gait.parameters, values);
    print("\ncontrols\n");
    for (const GaitOutput& output : gait.outputs)
        if (output.control) print(fmt::format("  {:<20} {:<6} {}\n", output.name, output.unit, output.help));
    print_presets(gait.presets);
    print(fmt::format("\n{} instructions on {} registers\n", gait.program.instructions.size(), gait.program.registers));
}

/// Writes the gait as a clip of the character asked for, and says what it does.
void bake(const Gait& gait, const std::vector<double>& values, const Options& options) {
    const GaitActor actor = gait_actor(read_actor(options.rig, parse_roles(options.roles, "--roles")));
    for (const std::string& control : bind_gait(gait).unknown)
        std::fprintf(stderr, "%s: the control '%s' moves nothing; docs/gaits.md lists those that do\n",
                     options.gait.c_str(), control.c_str());
    GaitPlay play = options.play;
    play.speed_mps = options.moments.speed_mps;
    play.turn_deg_s = options.moments.turn_deg_s;
    play.slope_deg = options.moments.slope_deg;
    AnalyzedClip clip = play_gait(gait, values, actor, play);
    if (!options.preset.empty()) clip.motion.name = clip.facts.name = options.preset;
    const ClipFacts& facts = clip.facts;
    if (!options.json)
        print(
            fmt::format("{}: {:.3f} s, {:.3f} m/s, {:.1f} deg/s, stride {:.3f} m, planted feet slide at {:.2f} cm/s\n",
                        facts.name, facts.duration, facts.speed, facts.turn, facts.stride, 100 * facts.skate));
    const Legs legs = clip.legs;
    const std::string source = options.gait + (options.preset.empty() ? "" : "#" + options.preset);
    write_clip_file({as_loaded(std::move(clip), source)}, options.out, {{}, true, legs});
}

int run_fitted(const Options& options) {
    PlayFitted play;
    play.gait = options.gait, play.out = options.out, play.json = options.json;
    play.as_fitted = options.as_fitted;
    play.fps = static_cast<float>(options.play.fps), play.cycles = options.play.cycles;
    if (options.rig != "default") play.rig = options.rig;
    play.roles = options.roles;
    play.slope = static_cast<float>(options.moments.slope_deg);
    play.personality = options.personality, play.set = options.set;
    if (options.speed->count() > 0) play.speed = static_cast<float>(options.moments.speed_mps);
    if (options.turn->count() > 0) play.turn = static_cast<float>(options.moments.turn_deg_s);
    return play_fitted(play);
}

int run(const Options& options) {
    if (options.gait == "list") return list(options.json);
    if (is_fitted(options.gait)) return run_fitted(options);
    const std::string extension = std::filesystem::path(options.table).extension().string();
    if (!options.table.empty() && extension != ".csv" && extension != ".json")
        throw Error("a table is written as .csv or .json", options.table, "name such a file");
    if (!options.out.empty()) check_clip_output(options.out);
    const Gait gait = read_gait_named(options.gait, GaitOutputs::everything);
    const std::vector<double> values = gait_values(gait, options.preset, options.set);
    for (const std::string& warning : gait.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
    if (!options.table.empty() || !options.plot.empty()) {
        const GaitTable table = sample_gait(gait, values, options.moments);
        if (!options.table.empty())
            write_file(options.table, extension == ".csv" ? gait_table_csv(gait, table) : gait_table_json(gait, table));
        if (!options.plot.empty()) write_file(options.plot, gait_table_svg(gait, table));
    }
    if (!options.out.empty()) bake(gait, values, options);
    if (options.json) {
        print_json(described(gait, values));
    } else if (options.check || (options.table.empty() && options.plot.empty() && options.out.empty())) {
        describe(gait, values);
    }
    return options.check && !gait.warnings.empty() ? 1 : 0;
}

}  // namespace

extern const Command k_gait;
const Command k_gait{
    "gait", "gaits as expressions and as fits to motion: check one, its controls as a table or a picture, clips of it",
    [](CLI::App& app) {
        auto options = std::make_shared<Options>();
        app.add_option("GAIT", options->gait,
                       "A .gait file, a fitted gait (.json), the name of a bundled one, or 'list'")
            ->required();
        app.add_flag("--check", options->check, "List parameters, controls and presets; exit code 1 with warnings");
        app.add_option("--preset", options->preset, "Begin with the values of this preset");
        app.add_option(
            "--personality", options->personality,
            "Of a fitted gait: tired, proud, sneaky, drunk, elderly, or FILE.json#NAME; -p sets its sliders");
        app.add_flag("--as-fitted", options->as_fitted,
                     "Of a fitted gait: feet as its series have them, not held to the floor");
        app.add_option("-p,--set", options->set, "Set a parameter, name=value (may be repeated)")
            ->type_name("NAME=VALUE")
            ->allow_extra_args(false);
        app.add_option(
            "-o,--output", options->out,
            "Write it as a clip with root motion, .glb or .bvh; a fitted gait with its sliders set as .json");
        app.add_option("--rig", options->rig, "Whose clip: a file with a character, or 'default'");
        app.add_option("--roles", options->roles, "Joints of the rig by hand, as left_foot=Foot_L (repeatable)")
            ->allow_extra_args(false);
        app.add_option("--fps", options->play.fps, "Frames a second of the clip (default 60)")
            ->check(CLI::Range(10.0, 240.0))
            ->check(is_number);
        app.add_option("--cycles", options->play.cycles, "Cycles in the clip (default 1)")->check(CLI::Range(1, 1000));
        app.add_option("--plot", options->plot, "Draw every control over a period, .svg");
        app.add_option("--table,--controls", options->table, "Write every control over a period, .csv or .json");
        app.add_option("--frames", options->moments.frames, "Rows at 24 a second instead of one period in 96 steps")
            ->check(CLI::Range(1, 1000000));
        options->speed = app.add_option("--speed", options->moments.speed_mps, "m/s, for gaits that ask for it")
                             ->check(CLI::Range(-20.0, 20.0))
                             ->check(is_number);
        options->turn = app.add_option("--turn", options->moments.turn_deg_s, "deg/s to the left")
                            ->check(CLI::Range(-720.0, 720.0))
                            ->check(is_number);
        app.add_option("--slope", options->moments.slope_deg, "Degrees uphill")
            ->check(CLI::Range(-60.0, 60.0))
            ->check(is_number);
        app.add_flag("--json", options->json, "Describe the gait as JSON on standard output");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
