#pragma once
// What plays on the gait desk: parameters that have values, and the cycle that they make of a body. There are gaits of
// expressions (docs/gaits.md) and gaits fitted to motion, whose parameters are the sliders of their personalities.

#include "parameter_json.h"
#include "stage_body.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/gait_clip/gait_clip.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::wasm {

inline constexpr int k_curve_points = 97;  ///< over a cycle; the last is one period after the first

class GaitSource {
  public:
    virtual ~GaitSource() = default;
    virtual std::span<const GaitParameter> parameters() const noexcept = 0;
    /// What it is, but for its parameters (surefoot.d.mts: GaitFacts). What it can be asked for depends on the body.
    virtual Json describe(const StageBody& body) const = 0;
    /// The cycle, and its facts if it is `measured`, which takes most of the time. Throws Error where it has no period.
    virtual AnalyzedClip play(std::span<const double> values, const GaitPlay& asked, const StageBody& body,
                              bool measured) const = 0;
    /// [{"name", "unit"}] of the curves that tell what it does.
    virtual Json curve_names() const = 0;
    /// These, k_curve_points each, one after the other; NaN where there is no value. `cycle` is what `play` gave.
    virtual std::vector<float> curves(std::span<const double> values, const GaitPlay& asked,
                                      const AnalyzedClip& cycle) const = 0;
    /// Rise a metre along +Z of the ground on which it goes.
    virtual float rise(const GaitPlay& asked, const AnalyzedClip& cycle) const = 0;
};

/// A gait of a text. Throws Error with line, column and a caret.
std::unique_ptr<GaitSource> expressed_gait(std::string_view text);

/// A bundled gait that was fitted to motion. Throws Error.
std::unique_ptr<GaitSource> fitted_gait_source(const std::string& name);

/// The values of the sliders of a personality, the last of a file's text. Throws Error that says where it was unhappy.
std::vector<double> personality_values(std::string_view text);

}  // namespace surefoot::wasm
