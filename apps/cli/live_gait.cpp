#include "live_gait.h"

#include "actor.h"
#include "gait_clips.h"

#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/gait_clip/gait_clip.h>
#include <surefoot/gait_text/gait.h>
#include <surefoot/host/files.h>

#include <algorithm>
#include <filesystem>

namespace surefoot::cli {

namespace {

bool has_extension(const std::string& path, const char* extension) {
    return std::filesystem::path(path).extension() == extension;
}

/// Projects are .json as well; of a gait this is the first key.
bool is_gait_json(const std::string& text) { return text.find("\"surefoot_gait\"") < 100; }

/// Its series are the gait's own waves, so many harmonics miss next to nothing.
HarmonicGait fit_expressions(const std::string& name) {
    const Gait gait = read_gait_named(name);
    const AnalyzedClip clip = play_gait(gait, gait_values(gait, "", {}), gait_actor(read_actor("default")));
    HarmonicGait fitted = fit_clip(clip, {8, 16});
    fitted.name = gait.name;
    return fitted;
}

HarmonicGait read_any(const std::string& name) {
    if (std::filesystem::exists(name))
        return has_extension(name, ".gait") ? fit_expressions(name) : gait_from_json(read_file(name), name);
    return has_fitted_gait(name) ? fitted_gait(name) : fit_expressions(name);
}

}  // namespace

bool is_live_gait(const std::string& name) {
    if (!std::filesystem::exists(name)) return has_fitted_gait(name) || !bundled_gait(name).empty();
    return has_extension(name, ".gait") || (has_extension(name, ".json") && is_gait_json(read_file(name)));
}

LiveGait read_live_gait(const std::string& name, const GaitStyle& style) {
    LiveGait live;
    const HarmonicGait gait = read_any(name);
    live.name = gait.name;
    const bool bundled = !std::filesystem::exists(name) && !fitted_gait_text(gait.name).empty();
    live.rig = live_rig_of(gait, bundled ? GaitCompany::bundled : GaitCompany::alone, name, style);
    std::vector<Transform> models(live.rig.stand.size());
    local_to_model(*gait.skeleton, live.rig.stand, models);
    live.roles = find_roles(*gait.skeleton, models).roles;
    if (gait.family()) {
        live.least_speed = gait.basis.least_speed;
        live.most_speed = gait.basis.most_speed;
        live.speed = std::clamp(live.speed, live.least_speed, live.most_speed);
    } else {
        live.speed = planar_length(rhythm_at(gait, 0, 0).velocity);
    }
    if (const NamedGait* named = std::filesystem::exists(name) ? nullptr : find_fitted_gait(name)) {
        live.name = named->name;
        live.speed = named->speed;
        live.turn_deg = named->turn_deg;
    }
    return live;
}

}  // namespace surefoot::cli
