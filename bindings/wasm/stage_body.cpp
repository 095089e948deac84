#include "stage_body.h"

#include "parameter_json.h"

#include <surefoot/base/error.h>

#include <algorithm>

namespace surefoot::wasm {
namespace {

RigTemplate template_named(std::string_view name) {
    const std::string_view text = bundled_rig(name);
    if (text.empty()) throw Error("there is no template of that name", std::string(name), "choose one of the list");
    return read_rig_template(text, std::string(name) + ".rig");
}

}  // namespace

StageBody body_of(const Character& character) {
    return {character.name.empty() ? "Character" : character.name,
            character.skeleton,
            character.roles,
            character.legs,
            character.standing,
            character.hip_height};
}

StageBody body_of(const Rig& rig) {
    std::vector<Transform> standing(rig.skeleton->rest.size());
    local_to_model(*rig.skeleton, rig.skeleton->rest, standing);
    const float hips = standing[static_cast<std::size_t>(rig.legs.hips)].translation.y;
    return {rig.name, rig.skeleton, rig.roles, rig.legs, std::move(standing), hips};
}

std::string rigs_json() {
    Json out = Json::array();
    const std::string_view all = bundled_rig_names();
    for (std::size_t at = 0; at < all.size();) {
        const std::string_view name = all.substr(at, all.find('\n', at) - at);
        at += name.size() + 1;
        const RigTemplate rig = template_named(name);
        Json parameters = Json::array();
        for (const GaitParameter& parameter : rig.parameters) parameters.push_back(parameter_json(parameter));
        out.push_back({{"name", name}, {"help", rig.help}, {"parameters", std::move(parameters)}});
    }
    return out.dump();
}

StageBody rigged_body(const std::string& name, std::span<const double> values) {
    const RigTemplate rig = template_named(name);
    return body_of(make_rig(rig, within_ranges(rig.parameters, values, name)));
}

}  // namespace surefoot::wasm
