#include "fitted_clips.h"

#include "actor.h"
#include "clip_files.h"

#include <surefoot/analysis/leg_track.h>
#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/author/personalities.h>
#include <surefoot/author/project.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/host/files.h>
#include <surefoot/motion/edit.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace surefoot::cli {
namespace {

void describe(const HarmonicGait& gait, const NamedGait* named, bool json) {
    const GaitBasis& basis = gait.basis;
    const std::string help = named ? named->help : "a fitted gait";
    if (json) {
        nlohmann::ordered_json out = {{"name", named ? named->name : gait.name.c_str()},
                                      {"help", help},
                                      {"joints", gait.mean.size()},
                                      {"harmonics", gait.harmonics},
                                      {"foot_harmonics", gait.foot_harmonics},
                                      {"cycles", gait.cycles.size()}};
        if (gait.family())
            out.update({{"travel_deg", basis.travel_deg},
                        {"least_speed_mps", basis.least_speed},
                        {"most_speed_mps", basis.most_speed},
                        {"most_turn_deg_s", basis.most_turn}});
        fmt::print("{}\n", out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        return;
    }
    fmt::print("{}: {}\n  {} joints, {} harmonics each, {} a foot; fitted to {} cycles\n",
               named ? named->name : gait.name, help, gait.mean.size(), gait.harmonics, gait.foot_harmonics,
               gait.cycles.size());
    if (gait.family())
        fmt::print("  {:g} to {:g} m/s, turns up to {:g} deg/s\n", basis.least_speed, basis.most_speed,
                   basis.most_turn);
}

const Personality& pick(const std::vector<Personality>& all, const std::string& name, const std::string& where) {
    std::string names;
    for (const Personality& personality : all) {
        if (personality.name == name) return personality;
        names += (names.empty() ? "" : ", ") + personality.name;
    }
    throw Error("there is no personality '" + name + "'", where, "there are " + names);
}

/// Files go first.
const NamedGait* named_of(const std::string& gait) {
    return std::filesystem::exists(gait) ? nullptr : find_fitted_gait(gait);
}

HarmonicGait read_fitted(const std::string& name) {
    const NamedGait* named = named_of(name);
    HarmonicGait gait = std::filesystem::exists(name) ? gait_from_json(read_file(name), name) : fitted_gait(name);
    if (named) gait.name = named->name;
    return gait;
}

}  // namespace

double skate_of(const AnalyzedClip& clip) {
    const Motion motion = concatenate(std::vector<Motion>(3, clip.motion));
    const WalkTrack track = make_track(motion, clip.legs);
    const auto frames = static_cast<std::size_t>(clip.motion.frame_count() - 1);
    return measure_skate(track, track, {frames, 2 * frames}).mean_cm_s;
}

std::string skate_text(double cm_s) {
    return std::isnan(cm_s) ? "no foot stands long enough to be measured"
                            : fmt::format("planted feet slide at {:.1f} cm/s", cm_s);
}

LoadedClip noted(AnalyzedClip clip, const std::string& file, const std::string& source, const std::string& origin) {
    ProjectClip notes;
    notes.facts = clip.facts;
    notes.source = source;
    notes.provenance = {origin};
    LoadedClip loaded;
    loaded.file = file;
    loaded.extras = clip_extras_json(notes);
    loaded.motion = std::move(clip.motion);
    return loaded;
}

LoadedClip as_clip(AnalyzedClip baked) {
    const std::string name = baked.facts.name, source = baked.source;
    const std::string origin = fmt::format("the fitted gait \"{}\" at {:.2f} m/s and {:.1f} deg/s", source,
                                           baked.facts.speed, baked.facts.turn);
    return noted(std::move(baked), name, source, origin);
}

bool is_fitted(const std::string& gait) {
    return std::filesystem::path(gait).extension() == ".json" || has_fitted_gait(gait);
}

GaitStyle fitted_style(const std::string& personality, std::span<const std::string> sliders,
                       const StyleOptions& options) {
    GaitStyle style;
    const std::size_t hash = personality.rfind('#');
    if (hash != std::string::npos) {
        const std::string file = personality.substr(0, hash);
        style = pick(read_personalities(read_file(file), file), personality.substr(hash + 1), file).style;
    } else if (!personality.empty()) {
        style = pick(bundled_personalities(), personality, options.personality).style;
    }
    for (const std::string& text : sliders) {
        const std::size_t equals = text.find('=');
        const char *first = text.data() + (equals == std::string::npos ? text.size() : equals + 1),
                   *end = text.data() + text.size();
        float value = 0;
        if (first == end || fast_float::from_chars(first, end, value).ptr != end)
            throw Error("'" + text + "' sets no slider", options.slider, "write name=number, as spine.lean_deg=10");
        set_slider(style, text.substr(0, equals), value, options.slider);
    }
    return style;
}

AnalyzedClip bake_fitted(const std::string& name, std::optional<float> speed, std::optional<float> turn,
                         const GaitBakeOptions& options) {
    const NamedGait* named = named_of(name);
    const HarmonicGait gait = read_fitted(name);
    if (!gait.family() && (speed || turn))
        throw Error("it is the gait of one clip and has a speed and turn of its own", name,
                    "leave --speed and --turn out");
    if (gait.family() && !named && !speed)
        throw Error("a family has no speed of its own", name, "ask for one: --speed 1.4");
    return bake_gait(gait, speed.value_or(named ? named->speed : 0), turn.value_or(named ? named->turn_deg : 0),
                     options);
}

namespace {

/// The gait itself, for all speeds, as its personality and sliders have it.
int write_styled(const PlayFitted& play) {
    if (play.speed || play.turn || play.slope != 0 || !play.rig.empty() || play.as_fitted)
        throw Error("a gait is written for every speed, on the body and ground that it was fitted on", play.out,
                    "leave out --speed, --turn, --slope, --rig and --as-fitted, or write a clip: -o walk.glb");
    HarmonicGait gait = with_style(read_fitted(play.gait), fitted_style(play.personality, play.set));
    gait.name = std::filesystem::path(play.out).stem().string();
    write_file(play.out, gait_to_json(gait));
    return 0;
}

int write_baked(const PlayFitted& play) {
    check_clip_output(play.out);
    AnalyzedClip baked = bake_fitted(play.gait, play.speed, play.turn,
                                     {fitted_style(play.personality, play.set), play.slope, play.fps, !play.as_fitted});
    if (!play.personality.empty())
        baked.motion.name = baked.facts.name += "_" + play.personality.substr(play.personality.rfind('#') + 1);
    fmt::print(stderr, "{}: {:.3f} m/s, {:.1f} deg/s, {}\n", baked.facts.name, baked.facts.speed, baked.facts.turn,
               skate_text(skate_of(baked)));
    if (!play.rig.empty()) {
        Actor source;
        source.body = {baked.motion.skeleton, baked.roles.roles, baked.legs, {}};
        source.roles = baked.roles;
        source.name = play.gait;
        baked = retargeted(baked, source, read_actor(play.rig, parse_roles(play.roles, "--roles")));
    }
    if (play.cycles > 1)
        baked.motion = concatenate(std::vector<Motion>(static_cast<std::size_t>(play.cycles), baked.motion));
    const Legs legs = baked.legs;
    write_clip_file({as_clip(std::move(baked))}, play.out, {{}, true, legs});
    return 0;
}

}  // namespace

int play_fitted(const PlayFitted& play) {
    if (play.out.empty()) {
        describe(read_fitted(play.gait), named_of(play.gait), play.json);
        return 0;
    }
    return std::filesystem::path(play.out).extension() == ".json" ? write_styled(play) : write_baked(play);
}

}  // namespace surefoot::cli
