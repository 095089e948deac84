#pragma once
// Clips of fitted gaits, as files and in words; and `surefoot gait` of one.

#include <surefoot/analysis/analyze.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/harmonic/harmonic_gait.h>
#include <surefoot/io/load.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot::cli {

/// Mean speed of planted sole points [cm/s] of a cycle played three times, taken in the middle one. NaN where no foot
/// stands long enough.
double skate_of(const AnalyzedClip& clip);
std::string skate_text(double cm_s);

/// A clip to write or to author, with its facts and where it comes from as extras.
LoadedClip noted(AnalyzedClip clip, const std::string& file, const std::string& source, const std::string& origin);

/// A baked gait with its facts as extras.
LoadedClip as_clip(AnalyzedClip baked);

/// What the options are called that name a personality and set sliders, for errors.
struct StyleOptions {
    std::string personality = "--personality", slider = "-p";
};
/// A personality (a bundled one, FILE.json#NAME, or none) and sliders as "spine.lean_deg=10" on top. Throws Error.
GaitStyle fitted_style(const std::string& personality, std::span<const std::string> sliders,
                       const StyleOptions& options = {});

/// A cycle of a fitted gait, at a speed and turn that are its own where none are given. Throws Error.
AnalyzedClip bake_fitted(const std::string& gait, std::optional<float> speed, std::optional<float> turn,
                         const GaitBakeOptions& options);

/// What `surefoot gait` is asked for of a fitted gait.
struct PlayFitted {
    std::string gait, out;
    std::optional<float> speed, turn;  ///< else the gait's own
    float slope = 0;                   ///< [deg] positive uphill
    std::string personality;           ///< a bundled one, FILE.json#NAME, or empty
    std::vector<std::string> set;      ///< sliders, as spine.lean_deg=10
    std::string rig;                   ///< character to put it onto; empty: the gait's own
    std::vector<std::string> roles;    ///< of the rig's joints, by hand
    float fps = 60;
    int cycles = 1;
    bool as_fitted = false;  ///< feet as the series have them, sliding where they do
    bool json = false;
};

/// A bundled fitted gait, or a file of one (.json).
bool is_fitted(const std::string& gait);

/// Writes it as a clip where `out` is named, else says what it is. Throws Error.
int play_fitted(const PlayFitted& play);

}  // namespace surefoot::cli
