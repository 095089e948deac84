#include "gait_source.h"

#include <surefoot/analysis/leg_track.h>
#include <surefoot/analysis/measure.h>
#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/json_node.h>
#include <surefoot/author/personalities.h>
#include <surefoot/author/retarget_clips.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/math/trig.h>
#include <surefoot/motion/edit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace surefoot::wasm {
namespace {

constexpr const char* k_whole = "whole body";

/// "spine.lean_deg" is a slider of the group "spine", in degrees.
GaitParameter parameter_of(const Slider& slider, double initial) {
    const std::size_t dot = slider.name.find('.');
    const auto ends = [&](std::string_view tail) { return slider.name.ends_with(tail); };
    GaitParameter parameter;
    parameter.name = slider.name;
    parameter.value = initial;
    parameter.low = short_number(slider.least).get<double>();
    parameter.high = short_number(slider.most).get<double>();
    parameter.unit = ends("_deg") ? "deg" : ends("_m") ? "m" : ends("lag") ? "cycles" : "1";
    parameter.group = dot == std::string::npos ? k_whole : slider.name.substr(0, dot);
    return parameter;
}

std::vector<double> values_of(const GaitStyle& style) {
    std::vector<double> values;
    for (const Slider& slider : sliders())
        values.push_back(short_number(slider_value(style, slider.name)).get<double>());
    return values;
}

/// What one looks at in a stride; in this order.
constexpr std::array<const char*, 7> k_curves{"left_foot.tY", "right_foot.tY", "left_foot.tZ", "right_foot.tZ",
                                              "hips.tY",      "left_knee",     "right_knee"};
constexpr std::size_t k_first_angle = 5;

std::array<float, k_curves.size()> curve_values(const TrackFrame& frame, float rise) {
    const auto lowest = [&](const LegTrack& leg) {
        float low = std::numeric_limits<float>::max();
        for (const Vec3& point : leg.sole) low = std::min(low, point.y - rise * point.z);
        return low;
    };
    const LegTrack &left = frame.legs[0], &right = frame.legs[1];
    return {lowest(left),
            lowest(right),
            left.ankle.z,
            right.ankle.z,
            frame.hips.y,
            static_cast<float>(180 - knee_angle(left)),
            static_cast<float>(180 - knee_angle(right))};
}

class FittedGait final : public GaitSource {
  public:
    explicit FittedGait(const std::string& name) : named_(find_fitted_gait(name)) {
        if (!named_) throw Error("there is no fitted gait of that name", name, "choose one of the list");
        gait_ = fitted_gait(name);
        gait_.name = name;
        const std::vector<double> initial = values_of({});
        const std::vector<Slider> all = sliders();
        for (std::size_t s = 0; s < all.size(); ++s) parameters_.push_back(parameter_of(all[s], initial[s]));
    }

    std::span<const GaitParameter> parameters() const noexcept override { return parameters_; }

    Json describe(const StageBody& body) const override {
        Json presets = Json::array();
        for (const Personality& each : bundled_personalities())
            presets.push_back({{"name", each.name}, {"help", each.help}, {"values", values_of(each.style)}});
        const GaitBasis& basis = gait_.basis;
        const float pace = pace_of(body);
        Json out = {{"name", gait_.name},
                    {"help", named_->help},
                    {"fitted", true},
                    {"presets", std::move(presets)},
                    {"speed", nullptr},
                    {"turn", nullptr},
                    {"slopes", basis.climb == 0},
                    {"warnings", Json::array()}};
        if (gait_.family() && basis.most_speed > 0)
            out["speed"] = {{"own", short_number(named_->speed * pace)},
                            {"low", short_number(basis.least_speed * pace)},
                            {"high", short_number(basis.most_speed * pace)}};
        if (gait_.family())
            out["turn"] = {{"own", named_->turn_deg}, {"low", -basis.most_turn}, {"high", basis.most_turn}};
        return out;
    }

    /// On another body it goes as a body of that size does: speeds with the root of the legs' length, times likewise,
    /// so that what is asked for holds in the world (as of gaits of expressions: gait_clip/gait_clip.h).
    AnalyzedClip play(std::span<const double> values, const GaitPlay& asked, const StageBody& body,
                      bool measured) const override {
        GaitStyle style;
        for (std::size_t p = 0; p < values.size(); ++p)
            set_slider(style, parameters_[p].name, static_cast<float>(values[p]), gait_.name);
        const GaitBasis& basis = gait_.basis;
        const float pace = pace_of(body);
        const float speed = static_cast<float>(asked.speed_mps) / pace;
        const float turn = static_cast<float>(asked.turn_deg_s) * pace;
        const GaitBakeOptions options{style, static_cast<float>(asked.slope_deg), static_cast<float>(asked.fps), true};
        AnalyzedClip own = bake_gait(gait_, std::clamp(speed, basis.least_speed, basis.most_speed),
                                     std::clamp(turn, -basis.most_turn, basis.most_turn), options);
        if (*own.motion.skeleton == *body.skeleton) return own;
        const RetargetBody source{own.motion.skeleton, own.roles.roles, own.legs, {}};
        const RetargetBody target{body.skeleton, body.roles, body.legs, body.standing};
        own.motion = retarget(own.motion, source, target);
        own.motion.fps /= pace;
        own.roles = {body.roles, "", {}};
        own.legs = body.legs;
        own.facts.duration = own.motion.duration();
        own.facts.fps = own.motion.fps;
        if (measured) measure(own.motion, body.roles, body.legs, own.facts);
        return own;
    }

    Json curve_names() const override {
        Json names = Json::array();
        for (std::size_t c = 0; c < k_curves.size(); ++c)
            names.push_back({{"name", k_curves[c]}, {"unit", c < k_first_angle ? "m" : "deg"}});
        return names;
    }

    std::vector<float> curves(std::span<const double>, const GaitPlay& asked,
                              const AnalyzedClip& cycle) const override {
        std::vector<float> curves(k_curves.size() * k_curve_points);
        std::vector<Transform> models(cycle.motion.skeleton->rest.size()), locals(models.size());
        for (std::size_t i = 0; i < k_curve_points; ++i) {
            RootFrame root;
            const float share = static_cast<float>(i) / (k_curve_points - 1);
            surefoot::sample(cycle.motion, share * cycle.motion.duration(), root, locals);
            local_to_model(*cycle.motion.skeleton, locals, models);
            const auto now = curve_values(track_frame({}, models, cycle.legs), rise(asked, cycle));
            for (std::size_t c = 0; c < now.size(); ++c) curves[c * k_curve_points + i] = now[c];
        }
        return curves;
    }

    float rise(const GaitPlay& asked, const AnalyzedClip&) const override {
        if (gait_.basis.climb != 0) return gait_.basis.climb;
        return tan(static_cast<float>(asked.slope_deg) * k_radians_per_degree);
    }

  private:
    float pace_of(const StageBody& body) const {
        const auto leg = [](const Legs& legs) { return legs[Side::left].length() + legs[Side::right].length(); };
        return sqrt(leg(body.legs) / leg(gait_.soles));
    }

    const NamedGait* named_;
    HarmonicGait gait_;
    std::vector<GaitParameter> parameters_;
};

}  // namespace

std::unique_ptr<GaitSource> fitted_gait_source(const std::string& name) { return std::make_unique<FittedGait>(name); }

std::vector<double> personality_values(std::string_view text) {
    const std::vector<Personality> all = read_personalities(text, "text");
    if (all.empty()) throw Error("it names no personality", "text", "write {\"mine\": {\"stride\": 0.9}}");
    return values_of(all.back().style);
}

}  // namespace surefoot::wasm
