// surefoot fit CLIPS -o GAIT.json: clips as a few harmonics. surefoot fit GAIT.json -o CLIP.glb: and back.

#include "clip_files.h"
#include "command.h"
#include "fit_clips.h"
#include "fitted_clips.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/derive.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : FitInput {
    std::string out;
    int harmonics = 5, foot_harmonics = 10;
    bool family = false, on_the_spot = false, json = false;
    float travel_deg = 0;
    std::vector<float> speeds, turns, range, stretch, stairs;
    bool shift_weight = false, hold_feet = false;
    float fps = 60;
};

bool is_gait_file(const std::string& path) { return std::filesystem::path(path).extension() == ".json"; }

/// What fitting one cycle gives.
struct CycleFit {
    const AnalyzedClip* clip = nullptr;
    HarmonicGait gait;
    std::vector<FitError> errors;
    double skate = 0, clip_skate = 0;  // [cm/s]; NaN where no foot stands long enough
};

CycleFit fit_cycle(const AnalyzedClip& clip, const Options& options) {
    CycleFit fit{&clip, fit_clip(clip, {options.harmonics, options.foot_harmonics}), errors_by_harmonics(clip)};
    fit.skate = skate_of(bake_gait(fit.gait, clip.facts.speed, clip.facts.turn, clip.motion.fps));
    fit.clip_skate = skate_of(clip);
    return fit;
}

void print_fit(const CycleFit& fit) {
    const ClipFacts& facts = fit.clip->facts;
    fmt::print("{}: {:.2f} m/s, {:.1f} deg/s, {:.2f} s\n", facts.name, facts.speed, facts.turn, facts.duration);
    fmt::print("  harmonics   joints: moving     all           worst                   ankles: mean    most\n");
    for (const FitError& error : fit.errors)
        fmt::print("  {:>9}     {:>6.2f} deg {:>6.2f} deg  {:>6.2f} deg {:<20} {:>4.2f} cm {:>4.2f} cm\n",
                   error.harmonics, error.joint_deg, error.all_joints_deg, error.worst_joint_deg, error.worst_joint,
                   error.ankle_cm, error.ankle_max_cm);
    fmt::print("  the gait: {}; the clip: {}\n", skate_text(fit.skate), skate_text(fit.clip_skate));
}

Json to_json(const FitError& error) {
    return {{"joint_deg", error.joint_deg},     {"all_joints_deg", error.all_joints_deg},
            {"worst_joint", error.worst_joint}, {"worst_joint_deg", error.worst_joint_deg},
            {"ankle_cm", error.ankle_cm},       {"ankle_max_cm", error.ankle_max_cm}};
}

Json to_json(const CycleFit& fit) {
    const auto number = [](double value) { return std::isnan(value) ? Json() : Json(value); };
    const ClipFacts& facts = fit.clip->facts;
    Json json = {{"name", facts.name},
                 {"speed_mps", facts.speed},
                 {"turn_deg_s", facts.turn},
                 {"skate_cm_s", number(fit.skate)},
                 {"clip_skate_cm_s", number(fit.clip_skate)},
                 {"errors", Json::array()}};
    for (const FitError& error : fit.errors) {
        json["errors"].push_back({{"harmonics", error.harmonics}});
        json["errors"].back().update(to_json(error));
    }
    return json;
}

Json to_json(const FamilyReport& report) {
    Json json = {{"strides", Json::array()}, {"left_out", report.left_out}};
    for (const StrideError& stride : report.strides) {
        json["strides"].push_back({{"name", stride.name},
                                   {"mode", stride.mode == GaitMode::walk ? "walk" : "run"},
                                   {"speed_mps", stride.speed},
                                   {"turn_deg_s", stride.turn_deg}});
        json["strides"].back().update(to_json(stride.error));
    }
    return json;
}

void print_json(const Json& json) { fmt::print("{}\n", json.dump(1, ' ', false, Json::error_handler_t::replace)); }

int fit_each(const std::vector<AnalyzedClip>& cycles, const Options& options) {
    std::vector<CycleFit> fits;
    for (const AnalyzedClip& clip : cycles) {
        try {
            fits.push_back(fit_cycle(clip, options));
        } catch (const Error& error) {
            if (cycles.size() == 1) throw;
            fmt::print(stderr, "surefoot: {}\n", error.what());
        }
    }
    if (fits.empty())
        throw Error("no cycle can be fitted", options.in.front(), "see what the clips hold: surefoot analyze");
    if (options.json) {
        Json json = {{"cycles", Json::array()}};
        for (const CycleFit& fit : fits) json["cycles"].push_back(to_json(fit));
        print_json(json);
    } else {
        for (const CycleFit& fit : fits) print_fit(fit);
    }
    if (options.out.empty()) return 0;
    const auto cost = [](const CycleFit& fit) { return fit.clip->facts.seam + 0.02f * fit.clip->facts.seam_speed; };
    const auto best = std::min_element(fits.begin(), fits.end(),
                                       [&](const CycleFit& a, const CycleFit& b) { return cost(a) < cost(b); });
    write_file(options.out, gait_to_json(best->gait));
    if (fits.size() > 1)
        fmt::print(stderr, "{} cycles were found; written is {}, which loops best (--family fits all)\n", fits.size(),
                   best->clip->facts.name);
    return 0;
}

void print_family(const HarmonicGait& gait, const FamilyReport& report) {
    fmt::print("{:<24} {:>5} {:>6} {:>8} {:>8} {:>8}\n", "stride", "", "m/s", "deg/s", "joints", "ankles");
    for (const StrideError& s : report.strides)
        fmt::print("{:<24} {:>5} {:>6.2f} {:>8.1f} {:>4.1f} deg {:>5.1f} cm\n", s.name,
                   s.mode == GaitMode::walk ? "walk" : "run", s.speed, s.turn_deg, s.error.joint_deg, s.error.ankle_cm);
    for (const std::string& line : report.left_out) fmt::print("left out: {}\n", line);
    fmt::print("{} strides and their mirror images\n", report.strides.size());
    const GaitBasis& basis = gait.basis;
    for (std::size_t m = 0; m < static_cast<std::size_t>(basis.modes); ++m)
        fmt::print("{} at {:.2f} to {:.2f} m/s, turns up to {:.0f} deg/s; beyond, the body does as at the end\n",
                   m == 0 ? "walking" : "running", basis.fitted_speeds[m][0], basis.fitted_speeds[m][1],
                   basis.fitted_turn[m]);
}

int fit_all(const std::vector<AnalyzedClip>& strides, const Options& options) {
    FamilyOptions family;
    family.fit = {options.harmonics, options.foot_harmonics};
    family.travel_deg = options.travel_deg;
    family.on_the_spot = options.on_the_spot;
    if (!options.range.empty()) family.least_speed = options.range[0], family.most_speed = options.range[1];
    FamilyReport report;
    HarmonicGait gait = fit_family(strides, family, &report);
    if (options.json)
        print_json(to_json(report));
    else
        print_family(gait, report);
    if (options.out.empty()) return 0;
    gait.name = std::filesystem::path(options.out).stem().string();
    write_file(options.out, gait_to_json(gait));
    return 0;
}

int derive(HarmonicGait gait, const Options& options) {
    if (!options.stretch.empty()) gait = stretched(gait, options.stretch[0], options.stretch[1]);
    if (options.hold_feet) gait = holding_feet(gait);
    if (options.shift_weight) gait = shifting_weight(gait);
    if (!options.stairs.empty()) {
        StairSteps stairs;
        stairs.riser = options.stairs[0], stairs.tread = options.stairs[1];
        gait = on_stairs(gait, stairs);
    }
    gait.name = std::filesystem::path(options.out).stem().string();
    write_file(options.out, gait_to_json(gait));
    return 0;
}

int bake(const Options& options) {
    if (options.in.size() != 1) throw Error("one gait at a time", "fit", "name one .json file");
    if (options.out.empty()) throw Error("there is no file to write", "fit", "name one: -o walk.glb");
    HarmonicGait gait = gait_from_json(read_file(options.in.front()), options.in.front());
    if (is_gait_file(options.out)) return derive(std::move(gait), options);
    check_clip_output(options.out);
    std::vector<LoadedClip> clips;
    const std::vector<float> none{0.0f};
    if (!gait.family() && !(options.speeds.empty() && options.turns.empty()))
        throw Error("it is the gait of one clip and has a speed and turn of its own", options.in.front(),
                    "leave --speed and --turn out, or fit a family: --family");
    if (gait.family() && options.speeds.empty())
        throw Error("a family has no speed of its own", options.in.front(), "ask for one or more: --speed 1.4");
    for (const float speed : gait.family() ? options.speeds : none)
        for (const float turn : gait.family() && !options.turns.empty() ? options.turns : none) {
            AnalyzedClip baked = bake_gait(gait, speed, turn, options.fps);
            const double skate = skate_of(baked);
            fmt::print("{}: {:.3f} m/s, {:.1f} deg/s, {}\n", baked.facts.name, baked.facts.speed, baked.facts.turn,
                       skate_text(skate));
            clips.push_back(as_clip(std::move(baked)));
        }
    write_clip_file(clips, options.out, {{}, true, gait.soles});
    return 0;
}

int run(const Options& options) {
    if (is_gait_file(options.in.front())) return bake(options);
    if (!options.speeds.empty() || !options.turns.empty())
        throw Error("clips have speeds and turns of their own", options.in.front(),
                    "fit a family first (--family -o gait.json), then ask it: surefoot fit gait.json --speed 1.4");
    if (!options.out.empty() && !is_gait_file(options.out))
        throw Error("a gait is written as .json", options.out, "name it so: -o gait.json");
    if (options.family)
        return fit_all(cycles_to_fit(options, [](const AnalyzedClip& take) { return find_strides(take); }), options);
    return fit_each(cycles_to_fit(options, find_cycles), options);
}

}  // namespace

extern const Command k_fit;
const Command k_fit{
    "fit", "clips as a few sines and cosines of the phase, and clips of such gaits",
    [](CLI::App& app) -> std::function<int()> {
        auto options = std::make_shared<Options>();
        const CLI::Range harmonics(1, k_most_harmonics);
        app.add_option("IN", options->in,
                       "clips to fit (files or folders), or one fitted gait (.json) to make clips of")
            ->required();
        app.add_option("-o,--output", options->out, "file to write: the gait as .json, or of a gait its clips as .glb");
        app.add_flag("--family", options->family,
                     "one gait for all speeds and turns, from all cycles of one character");
        app.add_option("--travel", options->travel_deg,
                       "which way a family goes, against where it faces: 0 ahead, 90 left, 180 back (default 0)")
            ->check(CLI::Range(-180.0, 180.0));
        app.add_option("--range", options->range, "slowest and fastest speed of a family, m/s (default 0.3,5)")
            ->delimiter(',')
            ->expected(2)
            ->check(is_number);
        app.add_flag("--on-the-spot", options->on_the_spot, "a family of turns on the spot");
        app.add_flag("--reverse", options->reverse, "the cycles played backwards: walking back from walking ahead");
        app.add_option("--to", options->to, "character to put the cycles onto: a file, or `default`");
        app.add_option("--stretch", options->stretch,
                       "of the gait of one clip a family from this to that speed, m/s (0.3,1.2)")
            ->delimiter(',')
            ->expected(2)
            ->check(is_number);
        app.add_flag("--hold-feet", options->hold_feet,
                     "of a gait: one whose feet are fitted anew to feet that stand still on the floor");
        app.add_flag("--shift-weight", options->shift_weight,
                     "of someone standing: from foot to foot every few breaths");
        app.add_option("--stairs", options->stairs, "of a family one on stairs: riser (negative: down) and tread, m")
            ->delimiter(',')
            ->expected(2)
            ->check(is_number);
        app.add_flag("--json", options->json, "print the errors as JSON");
        app.add_option("--harmonics", options->harmonics, "of each joint (default 5)")->check(harmonics);
        app.add_option("--foot-harmonics", options->foot_harmonics, "of the feet on the ground (default 10)")
            ->check(harmonics);
        app.add_option("--speed", options->speeds, "of a family's clips, m/s (several: 1,1.5,2)")
            ->delimiter(',')
            ->check(is_number);
        app.add_option("--turn", options->turns, "of a family's clips, deg/s, + to the left (several: 0,45,90)")
            ->delimiter(',')
            ->check(is_number);
        app.add_option("--fps", options->fps, "frames a second of clips (default 60)")->check(is_number);
        app.add_option("--roles", options->roles, "joints by hand, as left_foot=Foot_L (repeatable)")
            ->allow_extra_args(false);
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
