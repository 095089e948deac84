#include "gait_desk.h"

#include <surefoot/author/fitted_gaits.h>
#include <surefoot/base/error.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/mannequin/mannequin.h>

#include <utility>

namespace surefoot::wasm {

std::string gaits_json() {
    Json out = Json::array();
    const std::string_view all = bundled_gait_names();
    for (std::size_t at = 0; at < all.size();) {
        const std::string_view name = all.substr(at, all.find('\n', at) - at);
        at += name.size() + 1;
        const Gait gait = read_gait(bundled_gait(name), std::string(name));
        out.push_back({{"name", name}, {"help", gait.help}, {"fitted", false}});
    }
    for (const NamedGait& gait : fitted_gaits())
        out.push_back({{"name", gait.name}, {"help", gait.help}, {"fitted", true}});
    return out.dump();
}

void GaitDesk::read(std::string_view text) { begin(expressed_gait(text)); }

void GaitDesk::read_fitted(const std::string& name) { begin(fitted_gait_source(name)); }

/// All of it, or, where that throws, nothing.
void GaitDesk::begin(std::unique_ptr<GaitSource> source) {
    std::vector<double> initial;
    for (const GaitParameter& parameter : source->parameters()) initial.push_back(parameter.value);
    take(*source, initial, {});
    source_ = std::move(source);
}

const GaitSource& GaitDesk::source() const {
    if (!source_) throw Error("there is no gait yet", "", "read one first");
    return *source_;
}

void GaitDesk::play(std::span<const double> values, const GaitPlay& asked) { take(source(), values, asked); }

void GaitDesk::take(const GaitSource& source, std::span<const double> values, const GaitPlay& asked) {
    std::vector<double> wanted = within_ranges(source.parameters(), values, "the gait");
    AnalyzedClip cycle = source.play(wanted, asked, body_, false);
    curves_ = source.curves(wanted, asked, cycle);
    cycle_ = std::move(cycle);
    values_ = std::move(wanted);
    asked_ = asked;
}

void GaitDesk::put_on(StageBody body) {
    if (source_) cycle_ = source_->play(values_, asked_, body, false);
    body_ = std::move(body);
    if (source_) curves_ = source_->curves(values_, asked_, cycle_);
}

std::string GaitDesk::describe() const {
    Json out = source().describe(body_);
    out["parameters"] = Json::array();
    for (const GaitParameter& parameter : source_->parameters()) out["parameters"].push_back(parameter_json(parameter));
    return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string GaitDesk::played() const {
    const ClipFacts facts = source().play(values_, asked_, body_, true).facts;
    const Json out = {{"duration", facts.duration}, {"speed", facts.speed}, {"turn", facts.turn},
                      {"stride", facts.stride},     {"skate", facts.skate}, {"curves", source_->curve_names()}};
    return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string GaitDesk::bvh() const { return write_bvh(motion()); }

std::string GaitDesk::glb() const {
    GltfScene scene;
    scene.motions.push_back(motion());
    scene.mesh = make_mannequin(motion(), body_.roles, body_.legs);
    return write_glb(scene);
}

}  // namespace surefoot::wasm
