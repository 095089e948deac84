#pragma once
// A gait of expressions for somebody to shape: its text, its parameters, its curves and the clip that it makes of the
// character on the stage. What the studio's Gait workspace shows.

#include <surefoot/bake/character.h>
#include <surefoot/gait_clip/gait_clip.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::wasm {

/// The bundled gaits, [{"name", "help"}].
std::string gaits_json();

inline constexpr int k_curve_points = 97;  ///< the last is one period after the first

class GaitDesk {
  public:
    /// Throws Error where the character has no legs that a gait could move.
    explicit GaitDesk(const Character& character);

    /// Another gait, with its own values. Throws Error with line, column and a caret; then the gait is as it was.
    void read(std::string_view text);
    /// Other values, one a parameter; values that are out of range are brought into it. Speeds as GaitPlay has them;
    /// 0: the gait's own. Throws Error where the gait then has no period, and nothing has changed.
    void play(std::span<const double> values, double speed_mps, double turn_deg_s);

    /// Parameters, presets, controls and warnings: one JSON object (surefoot.d.mts: GaitFacts).
    std::string describe() const;
    /// What the clip does (surefoot.d.mts: GaitPlayed): it is measured here, which takes longer than to play it.
    std::string played() const;
    /// The curves of its controls over a cycle, one after the other, k_curve_points each; NaN where there is no value.
    std::span<const float> curves() const noexcept { return curves_; }

    const Motion& motion() const noexcept { return motion_; }
    const Legs& legs() const noexcept { return actor_.legs; }
    /// The clip as the bytes of a file.
    std::string bvh() const;
    std::string glb() const;

  private:
    void take(std::vector<double> values, const GaitPlay& asked, const Gait& gait);

    GaitActor actor_;
    Gait gait_;
    std::vector<double> values_;
    GaitPlay asked_;
    Motion motion_;
    std::vector<float> curves_;
};

}  // namespace surefoot::wasm
