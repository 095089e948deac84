#include "gait_desk.h"

#include <surefoot/base/error.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/mannequin/mannequin.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace surefoot::wasm {
namespace {

using Json = nlohmann::ordered_json;

Json parameter_json(const GaitParameter& parameter) {
    return {{"name", parameter.name}, {"initial", parameter.value}, {"low", parameter.low},  {"high", parameter.high},
            {"unit", parameter.unit}, {"group", parameter.group},   {"help", parameter.help}};
}

Json preset_json(const Gait& gait, const GaitPreset& preset) {
    Json values = Json::array();
    for (const double value : gait_values(gait, preset.name, {})) values.push_back(value);
    return {{"name", preset.name}, {"help", preset.help}, {"values", std::move(values)}};
}

}  // namespace

std::string gaits_json() {
    Json out = Json::array();
    const std::string_view all = bundled_gait_names();
    for (std::size_t at = 0; at < all.size();) {
        const std::string_view name = all.substr(at, all.find('\n', at) - at);
        at += name.size() + 1;
        out.push_back({{"name", name}, {"help", read_gait(bundled_gait(name), std::string(name)).help}});
    }
    return out.dump();
}

GaitDesk::GaitDesk(const Character& character)
    : actor_(make_gait_actor(character.skeleton, {character.roles, "", {}}, character.legs, character.standing,
                             character.name)) {}

void GaitDesk::read(std::string_view text) {
    Gait gait = read_gait(text, "line", GaitOutputs::everything);
    take(gait_values(gait, "", {}), {}, gait);
    gait_ = std::move(gait);
}

void GaitDesk::play(std::span<const double> values, double speed_mps, double turn_deg_s) {
    if (values.size() != gait_.parameters.size())
        throw Error("a gait takes one value a parameter", gait_.name, "read the gait first");
    std::vector<double> wanted(values.begin(), values.end());
    for (std::size_t p = 0; p < wanted.size(); ++p)
        wanted[p] = std::clamp(wanted[p], gait_.parameters[p].low, gait_.parameters[p].high);
    GaitPlay asked;
    asked.speed_mps = speed_mps;
    asked.turn_deg_s = turn_deg_s;
    take(std::move(wanted), asked, gait_);
}

/// All of it, or, where that throws, nothing.
void GaitDesk::take(std::vector<double> values, const GaitPlay& asked, const Gait& gait) {
    GaitMoments moments;
    moments.speed_mps = asked.speed_mps;
    moments.turn_deg_s = asked.turn_deg_s;
    moments.steps = k_curve_points - 1;
    const GaitTable table = sample_gait(gait, values, moments);
    const std::size_t outputs = gait.outputs.size();
    std::vector<float> curves;
    for (std::size_t output = 0; output < outputs; ++output) {
        if (!gait.outputs[output].control) continue;
        for (std::size_t row = 0; row < table.times_s.size(); ++row) {
            const double value = table.values[row * outputs + output];
            curves.push_back(std::isfinite(value) ? static_cast<float>(value)
                                                  : std::numeric_limits<float>::quiet_NaN());
        }
    }
    motion_ = gait_motion(gait, values, actor_, asked);
    curves_ = std::move(curves);
    values_ = std::move(values);
    asked_ = asked;
}

std::string GaitDesk::describe() const {
    Json out = {{"name", gait_.name},
                {"help", gait_.help},
                {"parameters", Json::array()},
                {"presets", Json::array()},
                {"warnings", gait_.warnings}};
    for (const GaitParameter& parameter : gait_.parameters) out["parameters"].push_back(parameter_json(parameter));
    for (const GaitPreset& preset : gait_.presets) out["presets"].push_back(preset_json(gait_, preset));
    for (const std::string& control : bind_gait(gait_).unknown)
        out["warnings"].push_back("the control '" + control + "' moves nothing");
    return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string GaitDesk::played() const {
    const ClipFacts facts = play_gait(gait_, values_, actor_, asked_).facts;
    Json out = {{"duration", facts.duration}, {"speed", facts.speed}, {"turn", facts.turn},
                {"stride", facts.stride},     {"skate", facts.skate}, {"curves", Json::array()}};
    for (const GaitOutput& output : gait_.outputs)
        if (output.control) out["curves"].push_back({{"name", output.name}, {"unit", output.unit}});
    return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string GaitDesk::bvh() const { return write_bvh(motion_); }

std::string GaitDesk::glb() const {
    GltfScene scene;
    scene.motions.push_back(motion_);
    scene.mesh = make_mannequin(motion_, actor_.roles.roles, actor_.legs);
    return write_glb(scene);
}

}  // namespace surefoot::wasm
