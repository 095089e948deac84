#pragma once
// From cyclic clips to fitted gaits (harmonic/harmonic_gait.h), with the error of every number of harmonics.
//
// A clip is looked at from its steady root and at even steps of its phase (foot strike to foot strike, pack/), so that
// the series are plain Fourier sums of what it does, and both half cycles line up from clip to clip. DESIGN §7.
//
// A family is made of the strides of one actor at many speeds and turns: each coefficient of each series is a low
// polynomial of speed and turn, one for walking and one for running, by ridge regression over all strides and their
// mirror images. Where strides are dense the ridge does nothing; beyond them the polynomial goes on as straight as it
// can.

#include <surefoot/analysis/analyze.h>
#include <surefoot/harmonic/gait_style.h>

#include <span>
#include <string>
#include <vector>

namespace surefoot {

struct FitOptions {
    int harmonics = 5;        ///< [Limit: 1 to k_most_harmonics] of joints
    int foot_harmonics = 10;  ///< [Limit: 1 to k_most_harmonics] of the feet that hold the ground
};

/// The gait of one clip: a cycle of alternating steps, or someone who stands, whose feet then hold still throughout.
/// Throws Error where it is neither (which says why) or has no legs.
HarmonicGait fit_clip(const AnalyzedClip& clip, const FitOptions& options = {});

/// How far a gait is from a clip, over the clip's frames, before the legs are solved for the feet.
struct FitError {
    int harmonics = 0;
    float joint_deg = 0;        ///< mean over frames and the joints that move of the angle between the local rotations
    float all_joints_deg = 0;   ///< the same over all joints, those included that hold still throughout
    float worst_joint_deg = 0;  ///< the same of the joint that fits worst
    std::string worst_joint;
    float ankle_cm = 0;      ///< mean over frames and both ankles, seen from the steady root
    float ankle_max_cm = 0;  ///< the largest
};
/// The gait's values must be those of the clip's own speed and turn.
FitError measure_fit(const AnalyzedClip& clip, const HarmonicGait& gait, std::span<const float> values);

/// The errors of fits with 1 to `most` harmonics.
std::vector<FitError> errors_by_harmonics(const AnalyzedClip& clip, int most = 8);

struct FamilyOptions {
    FitOptions fit;
    /// Which way its strides go, seen from where they face: 0 ahead, 90 to the left, 180 back; other strides are left
    /// out. A family that goes ahead walks and runs, one that does not has one mode.
    float travel_deg = 0;
    /// Strides that turn without going anywhere: a family of turns, at the speed 0.
    bool on_the_spot = false;
    float least_speed = 0.3f, most_speed = 5;  ///< [m/s] of the range over which it is defined
    float most_turn = 120;                     ///< [deg/s]
    int degree = 2;                            ///< of the polynomials
    float walk_until = 1.2f, run_from = 3.2f;  ///< [m/s] between them walking goes over into running
    double ridge = 0.02;  ///< what a term of degree 2 costs, as a share of what the strides have to say
};

/// How well a family does what one of its strides does, at the stride's own speed and turn.
struct StrideError {
    std::string name;
    GaitMode mode = GaitMode::walk;
    float speed = 0, turn_deg = 0;
    FitError error;
};

struct FamilyReport {
    std::vector<StrideError> strides;   ///< that were fitted, without their mirror images
    std::vector<std::string> left_out;  ///< clips and why
};

/// The family of the cycles among `clips` (find_strides, find_cycles), which share a skeleton: those that step and go
/// where it goes, within 30 degrees. Cycles in which the feet stand for more than 55 % of the time walk, the others
/// run. One that closing has bent counts less. Mirror images are added where the family goes ahead, back or nowhere.
/// Throws Error where fewer than eight walk (of those that turn on the spot, three).
HarmonicGait fit_family(std::span<const AnalyzedClip> clips, const FamilyOptions& options = {},
                        FamilyReport* report = nullptr);

/// Throws Error where a family is asked for what lies beyond its range, or the frame rate is not 10 to 240.
void check_request(const HarmonicGait& gait, float speed, float turn_deg, float fps);

/// One cycle as a clip, from the left foot's strike on, at `fps` frames a second or little off it: a whole number of
/// frames fills the cycle. Root motion is steady and exactly as asked; `facts` are measured from the motion, but its
/// foot strikes are those of the gait. Throws Error where a family is asked for what lies beyond its range.
AnalyzedClip bake_gait(const HarmonicGait& gait, float speed, float turn_deg, float fps = 60);

/// The same with sliders and on a slope [deg, positive uphill] (harmonic/gait_style.h).
struct GaitBakeOptions {
    GaitStyle style;
    float slope_deg = 0;
    float fps = 60;
    /// Feet are held to the floor exactly, as grounded_cycle.h does, instead of as near as the series keep them. Means
    /// nothing on slopes and stairs, and of a gait without feet.
    bool grounded = false;
};
AnalyzedClip bake_gait(const HarmonicGait& gait, float speed, float turn_deg, const GaitBakeOptions& options);

}  // namespace surefoot
