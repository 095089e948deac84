// surefoot fit CLIPS -o GAIT.json: clips as a few harmonics. surefoot fit GAIT.json -o CLIP.glb: and back.

#include "actor.h"
#include "clip_files.h"
#include "command.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/author/project.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::vector<std::string> in, roles;
    std::string out;
    int harmonics = 5, foot_harmonics = 10;
    bool family = false, json = false;
    std::vector<float> speeds, turns;
    float fps = 60;
};

bool is_gait_file(const std::string& path) { return std::filesystem::path(path).extension() == ".json"; }

std::vector<LoadedClip> load(const Options& options) {
    LoadResult loaded = load_clips(options.in);
    for (const LoadFailure& failure : loaded.failed) fmt::print(stderr, "surefoot: {}\n", failure.error);
    if (loaded.clips.empty()) throw Error("there are no clips to fit", "fit", "give .bvh, .glb, .gltf or .fbx files");
    return std::move(loaded.clips);
}

/// What `find` finds in each clip, in order; clips that cannot be measured are told and left out.
std::vector<AnalyzedClip> cycles_of(const Options& options,
                                    const std::function<std::vector<AnalyzedClip>(const AnalyzedClip&)>& find) {
    std::vector<LoadedClip> clips = load(options);
    const RoleOverrides roles = parse_roles(options.roles, "--roles");
    std::vector<std::vector<AnalyzedClip>> found(clips.size());
    std::vector<std::string> failed(clips.size());
    parallel_for(clips.size(), [&](std::size_t i) {
        try {
            found[i] = find(analyze_clip(std::move(clips[i].motion), clips[i].file, clips[i].unit_scale, roles));
        } catch (const Error& error) {
            failed[i] = error.what();
        }
    });
    std::vector<AnalyzedClip> cycles;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (!failed[i].empty()) fmt::print(stderr, "surefoot: {}\n", failed[i]);
        for (AnalyzedClip& clip : found[i])
            if (clip.facts.cyclic && clip.facts.cadence > 0) cycles.push_back(std::move(clip));
    }
    if (cycles.empty())
        throw Error("no cycle of steps was found", options.in.front(), "see what the clips hold: surefoot analyze");
    return cycles;
}

/// Mean speed of planted sole points [cm/s] of a cycle played three times, taken in the middle one.
double skate_of(const AnalyzedClip& clip) {
    const Motion motion = concatenate(std::vector<Motion>(3, clip.motion));
    const WalkTrack track = make_track(motion, clip.legs);
    const auto frames = static_cast<std::size_t>(clip.motion.frame_count() - 1);
    return measure_skate(track, track, {frames, 2 * frames}).mean_cm_s;
}

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

std::string skate_text(double cm_s) {
    return std::isnan(cm_s) ? "no measurable speed" : fmt::format("{:.1f} cm/s", cm_s);
}

void print_fit(const CycleFit& fit) {
    const ClipFacts& facts = fit.clip->facts;
    fmt::print("{}: {:.2f} m/s, {:.1f} deg/s, {:.2f} s\n", facts.name, facts.speed, facts.turn, facts.duration);
    fmt::print("  harmonics   joints: moving     all           worst                   ankles: mean    most\n");
    for (const FitError& error : fit.errors)
        fmt::print("  {:>9}     {:>6.2f} deg {:>6.2f} deg  {:>6.2f} deg {:<20} {:>4.2f} cm {:>4.2f} cm\n",
                   error.harmonics, error.joint_deg, error.all_joints_deg, error.worst_joint_deg, error.worst_joint,
                   error.ankle_cm, error.ankle_max_cm);
    fmt::print("  planted feet slide at {}, the clip's at {}\n", skate_text(fit.skate), skate_text(fit.clip_skate));
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

LoadedClip as_clip(AnalyzedClip baked) {
    ProjectClip notes;
    notes.facts = baked.facts;
    notes.source = baked.source;
    notes.provenance = {fmt::format("the fitted gait \"{}\" at {:.2f} m/s and {:.1f} deg/s", baked.source,
                                    baked.facts.speed, baked.facts.turn)};
    LoadedClip clip;
    clip.file = baked.facts.name;
    clip.extras = clip_extras_json(notes);
    clip.motion = std::move(baked.motion);
    return clip;
}

int bake(const Options& options) {
    if (options.in.size() != 1) throw Error("one gait at a time", "fit", "name one .json file");
    if (options.out.empty()) throw Error("there is no file to write", "fit", "name one: -o walk.glb");
    check_clip_output(options.out);
    const HarmonicGait gait = gait_from_json(read_file(options.in.front()), options.in.front());
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
                       std::isnan(skate) ? "no foot stands long enough to be measured"
                                         : fmt::format("planted feet slide at {:.1f} cm/s", skate));
            clips.push_back(as_clip(std::move(baked)));
        }
    write_clip_file(clips, options.out);
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
        return fit_all(cycles_of(options, [](const AnalyzedClip& take) { return find_strides(take); }), options);
    return fit_each(cycles_of(options, find_cycles), options);
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
