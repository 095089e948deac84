#pragma once
// A gait for somebody to shape: its text or its personality, its parameters, its curves and the cycle that it makes of
// a body. What the studio's Gait workspace shows.

#include "gait_source.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::wasm {

/// The bundled gaits, [{"name", "help", "fitted"}].
std::string gaits_json();

class GaitDesk {
  public:
    explicit GaitDesk(StageBody body) : body_(std::move(body)) {}

    /// A gait of a text, with its own values. Throws Error with line, column and a caret; then the gait is as it was.
    void read(std::string_view text);
    /// A bundled gait that was fitted to motion.
    void read_fitted(const std::string& name);
    /// Other values, one a parameter; values that are out of range are brought into it. Speeds as GaitPlay has them;
    /// 0: the gait's own. Throws Error where the gait then has no period, and nothing has changed.
    void play(std::span<const double> values, const GaitPlay& asked);
    /// The same on another body. Throws Error where it cannot go, and then nothing has changed.
    void put_on(StageBody body);

    /// Parameters, presets and what can be asked for: one JSON object (surefoot.d.mts: GaitFacts).
    std::string describe() const;
    /// What the clip does (surefoot.d.mts: GaitPlayed): it is measured here, which takes longer than to play it.
    std::string played() const;
    /// The curves of what it does over a cycle, one after the other, k_curve_points each; NaN where there is no value.
    std::span<const float> curves() const noexcept { return curves_; }

    const Motion& motion() const noexcept { return cycle_.motion; }
    const StageBody& body() const noexcept { return body_; }
    /// Rise a metre along +Z of the ground on which it goes.
    float rise() const { return source_->rise(asked_, cycle_); }
    /// The clip as the bytes of a file.
    std::string bvh() const;
    std::string glb() const;

  private:
    void begin(std::unique_ptr<GaitSource> source);
    void take(const GaitSource& source, std::span<const double> values, const GaitPlay& asked);
    const GaitSource& source() const;

    StageBody body_;
    std::unique_ptr<GaitSource> source_;
    std::vector<double> values_;
    GaitPlay asked_;
    AnalyzedClip cycle_;
    std::vector<float> curves_;
};

}  // namespace surefoot::wasm
