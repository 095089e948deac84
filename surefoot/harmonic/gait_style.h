#pragma once
// Sliders on top of a fitted gait: how large, how late and how sharp each part of the body moves, how it is held, and
// what a slope does to all of it.
//
//     const StyleBody body = make_style_body(gait);              // once; may allocate
//     values_at(gait, 1.2f, 0, values);
//     apply_style(gait, body, style, values);                    // as often as values_at; never allocates
//     pose(gait, values, phase, locals);
//
// All of it changes the numbers of the series (harmonic/series.h), so a styled gait costs nothing more to play. Feet
// have series of their own that hold the ground at any speed: the root goes as asked, whatever the sliders say.

#include <surefoot/harmonic/harmonic_gait.h>

#include <array>
#include <span>
#include <vector>

namespace surefoot {

enum class BodyPart : std::uint8_t { legs, pelvis, spine, head, arms, count };
inline constexpr std::size_t k_body_parts = static_cast<std::size_t>(BodyPart::count);

/// Angles in degrees, shared out over the joints of the part. Defaults change nothing.
struct PartStyle {
    float amplitude = 1;  ///< [0, 3] of the swings; of the legs: height and roll of the steps
    float lag = 0;        ///< [-0.5, 0.5] cycles that the part comes later; of the legs: the right foot's strike
    float sharpness = 1;  ///< [0.3, 2] above 1 snappier, below rounder; of the legs: swings are that much shorter
    float lean = 0;       ///< [-60, 60] deg forward; of the arms: swung forward
    float side = 0;       ///< [-45, 45] deg to its left; not of the legs and arms
    float turn = 0;       ///< [-45, 45] deg to its left; not of the legs and arms
    float out = 0;        ///< [-45, 60] deg away from the body: arms abducted, toes turned out
    float bend = 0;       ///< [-30, 120] deg of the elbows; of the legs nothing: `crouch` bends the knees

    bool operator==(const PartStyle&) const = default;
};

struct GaitStyle {
    std::array<PartStyle, k_body_parts> parts;
    float stride = 1;  ///< [0.5, 1.5] length of the strides at one speed; cadence makes up for it
    float width = 0;   ///< [-0.1, 0.3] m that the feet are farther apart
    float crouch = 0;  ///< [-0.05, 0.4] m that the hips are lower
    float sway = 1;    ///< [0, 4] of the hips, sideways
    float bounce = 1;  ///< [0, 4] of the hips, up and down

    bool operator==(const GaitStyle&) const = default;
    PartStyle& operator[](BodyPart part) noexcept { return parts[static_cast<std::size_t>(part)]; }
    const PartStyle& operator[](BodyPart part) const noexcept { return parts[static_cast<std::size_t>(part)]; }
};

/// Which joint belongs to which part, and which way it is turned in the mean pose.
struct StyleBody {
    std::vector<BodyPart> part;  ///< [joint]; count: none
    std::vector<Quat> model;     ///< [joint] model rotation where all joints are at their means
    std::array<int, 3> spine{k_no_joint, k_no_joint, k_no_joint}, head{k_no_joint, k_no_joint, k_no_joint};
    std::array<int, 2> upper_arm{k_no_joint, k_no_joint}, lower_arm{k_no_joint, k_no_joint};  ///< by Side
};

/// Joints by their roles, those without one with their parents. Allocates.
StyleBody make_style_body(const HarmonicGait& gait);

/// Changes `values` (values_at) as the sliders say. Sliders beyond their ranges are clamped.
void apply_style(const HarmonicGait& gait, const StyleBody& body, const GaitStyle& style,
                 std::span<float> values) noexcept;

/// The same gait with the sliders set for good, at every speed and turn: to be written to a file, played live, put into
/// graphs and packs. It is apply_style's work on each term of the basis, which gives the same but for rhythms that
/// sliders take beyond their bounds. Allocates.
HarmonicGait with_style(const HarmonicGait& gait, const GaitStyle& style);

/// Puts the gait on a slope [deg, positive uphill where it faces; clamped to +-35]: root and feet follow the ground,
/// feet lie along it, the trunk leans into the climb and steps grow shorter. Lean: about a third of the slope uphill, a
/// seventh back downhill (Leroux, Fung & Barbeau, "Postural adaptation to walking on inclined surfaces", Gait & Posture
/// 15, 2002, find trunk and pelvis to tilt so). For gaits that do not climb already.
void apply_slope(const HarmonicGait& gait, const StyleBody& body, float slope_deg, std::span<float> values) noexcept;

}  // namespace surefoot
