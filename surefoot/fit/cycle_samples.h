#pragma once
// Clips at even steps of their phase, and the series of what they do. Private to the room.

#include <surefoot/fit/fit_gait.h>
#include <surefoot/pack/pack_clip.h>

namespace surefoot {

/// The clip as its gait is fitted to: seen from a steady root, along its travel where that is nearly ahead.
/// Throws Error where it has no phase, unless it stands, or no legs.
PackedClip pack_for_fit(const AnalyzedClip& clip);

/// Someone who stands: no steps, and no way to go.
bool is_standing(const PackedClip& clip);

/// A foot at a moment, seen from the middle of its stance.
struct FootSample {
    Quat rotation, toes;
    Vec3 heel, ball;
};

/// k_samples a cycle, even in phase.
struct CycleSamples {
    std::vector<std::vector<Transform>> poses;
    std::array<std::vector<FootSample>, 2> feet;
    GaitRhythm rhythm;
};

/// `gait` has its skeleton, legs and foot_lift.
CycleSamples sample_cycles(const PackedClip& clip, const HarmonicGait& gait);

/// The gait without coefficients: skeleton, legs, what moves and mean rotations, for all of `samples`.
void set_means(HarmonicGait& gait, std::span<const CycleSamples> samples);

/// The numbers of the gait that does as `samples` do (HarmonicGait::coefficients, one term).
std::vector<float> values_of(const CycleSamples& samples, const HarmonicGait& gait);

/// Fits the joints' rotations anew so that the mean of the angles that they are off is least, where Fourier's sums have
/// the least mean square: a glitch of the capture then bends the rest of the cycle less. Iteratively reweighted least
/// squares (Weiszfeld's way to a geometric median). Joints that carry a foot stay: their errors add up to the ankle's,
/// whose largest counts.
void fit_mean_angles(const CycleSamples& samples, const HarmonicGait& gait, std::span<float> values);

/// To the nearest whole hundred-thousandth: a hundredth of a millimetre, and of a milliradian. What is finer is noise,
/// and half of a file.
void round_coefficients(HarmonicGait& gait);

/// The frame of a character's skeleton and legs: what all gaits of it begin with.
HarmonicGait gait_of_body(const AnalyzedClip& clip, const FitOptions& options);

/// Mean share of the steps that the feet stand.
float mean_lift(const PackedClip& clip);

}  // namespace surefoot
