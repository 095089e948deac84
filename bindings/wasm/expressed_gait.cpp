#include "gait_source.h"

#include <surefoot/analysis/measure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace surefoot::wasm {
namespace {

constexpr double k_most_speed = 5, k_most_turn = 90;  // [m/s], [deg/s] that any of them can be asked for

class ExpressedGait final : public GaitSource {
  public:
    explicit ExpressedGait(std::string_view text) : gait_(read_gait(text, "line", GaitOutputs::everything)) {}

    std::span<const GaitParameter> parameters() const noexcept override { return gait_.parameters; }

    Json describe(const StageBody&) const override {
        Json presets = Json::array(), warnings = gait_.warnings;
        for (const GaitPreset& preset : gait_.presets)
            presets.push_back(
                {{"name", preset.name}, {"help", preset.help}, {"values", gait_values(gait_, preset.name, {})}});
        for (const std::string& control : bind_gait(gait_).unknown)
            warnings.push_back("the control '" + control + "' moves nothing");
        return {{"name", gait_.name},
                {"help", gait_.help},
                {"fitted", false},
                {"presets", std::move(presets)},
                {"speed", {{"own", 0}, {"low", 0}, {"high", k_most_speed}}},
                {"turn", {{"own", 0}, {"low", -k_most_turn}, {"high", k_most_turn}}},
                {"slopes", true},
                {"warnings", std::move(warnings)}};
    }

    AnalyzedClip play(std::span<const double> values, const GaitPlay& asked, const StageBody& body,
                      bool measured) const override {
        const GaitActor& actor = actor_of(body);
        if (measured) return play_gait(gait_, values, actor, asked);
        AnalyzedClip clip;
        clip.motion = gait_motion(gait_, values, actor, asked);
        clip.roles = actor.roles;
        clip.legs = actor.legs;
        return clip;
    }

    Json curve_names() const override {
        Json names = Json::array();
        for (const GaitOutput& output : gait_.outputs)
            if (output.control) names.push_back({{"name", output.name}, {"unit", output.unit}});
        return names;
    }

    std::vector<float> curves(std::span<const double> values, const GaitPlay& asked,
                              const AnalyzedClip&) const override {
        GaitMoments moments;
        moments.speed_mps = asked.speed_mps;
        moments.turn_deg_s = asked.turn_deg_s;
        moments.slope_deg = asked.slope_deg;
        moments.steps = k_curve_points - 1;
        const GaitTable table = sample_gait(gait_, values, moments);
        const std::size_t outputs = gait_.outputs.size();
        std::vector<float> curves;
        for (std::size_t output = 0; output < outputs; ++output) {
            if (!gait_.outputs[output].control) continue;
            for (std::size_t row = 0; row < table.times_s.size(); ++row) {
                const double value = table.values[row * outputs + output];
                curves.push_back(std::isfinite(value) ? static_cast<float>(value)
                                                      : std::numeric_limits<float>::quiet_NaN());
            }
        }
        return curves;
    }

    /// As its root climbs: level where it hardly goes anywhere, as on a ladder.
    float rise(const GaitPlay&, const AnalyzedClip& cycle) const override {
        constexpr float k_steepest = 1, k_least = 0.05f;  // [m]
        const Vec3 gone = cycle.motion.root.back().position - cycle.motion.root.front().position;
        const float rise = std::fabs(gone.z) > k_least ? gone.y / gone.z : 0;
        return std::fabs(rise) <= k_steepest ? rise : 0;
    }

  private:
    /// Made once for a body: the last one is kept.
    const GaitActor& actor_of(const StageBody& body) const {
        if (!actor_.skeleton || actor_.skeleton != body.skeleton)
            actor_ = make_gait_actor(body.skeleton, {body.roles, "", {}}, body.legs, body.standing, body.name);
        return actor_;
    }

    Gait gait_;
    mutable GaitActor actor_;
};

}  // namespace

std::unique_ptr<GaitSource> expressed_gait(std::string_view text) { return std::make_unique<ExpressedGait>(text); }

}  // namespace surefoot::wasm
