#pragma once
// One cycle of a generated gait: feet that stand exactly still, and a body carried over them.
//
// The paper's scheme (Bhatti et al. 2017: every part moved by sines of one phase) with two repairs that make it walk:
// the feet are placed in the world, so that nothing slides, and everything else follows from where they are.

#include <surefoot/motion/motion.h>
#include <surefoot/synthetic/biped.h>
#include <surefoot/synthetic/periodic_curve.h>

#include <string>
#include <vector>

namespace surefoot {

/// Angles in degrees, lengths in metres, for a body of 1.75 m. Mirroring a gait negates `lateral` and `turn`.
struct GaitParameters {
    std::string name;
    float forward = 0, lateral = 0;  ///< [m/s] in the body's frame
    float turn = 0;                  ///< [deg/s] positive to the left
    int intervals = 60;              ///< [even] frame intervals a cycle, at k_gait_fps
    float duty = 0.6f;               ///< share of the cycle a foot stands; 1: it never leaves the ground

    // Feet. Pitch is of the foot, toes up positive, over the share of stance and then of swing; the last swing key is
    // the strike's pitch again. Ascending, stance from 0 to 1, swing above 0 and below 1.
    std::vector<PeriodicCurve::Key> stance_pitch{{0, 0}};
    std::vector<PeriodicCurve::Key> swing_pitch;
    float toes_flat_until = 0.8f;  ///< share of stance after which the toes peel off the ground, tip last
    float toe_share = 0.55f;       ///< of the foot's pitch that the toes still make up for when they leave
    float step_width = 0.10f;      ///< [m] between the ankles
    float toe_out = 6;             ///< [deg]
    float clearance = 0.03f;       ///< [m] of the sole in mid-swing
    float kick = 0;                ///< [m] more of it in early swing, the heel rising behind
    float ahead = 0;               ///< [m] footholds shifted forward of where they carry the body highest

    // Pelvis.
    float bob = 0.02f;           ///< [m] rise and fall, twice a cycle
    float bob_low = 0.06f;       ///< [phase] where it is lowest
    float sway = 0.02f;          ///< [m] over the standing foot
    float list = 4;              ///< [deg] drop of the swinging side
    float pelvis_yaw = 5;        ///< [deg] forward with the leading leg
    float pelvis_pitch = 3;      ///< [deg] forward tilt
    float sidestep_bob = 0;      ///< [m] once a cycle: lower where sideways steps are wide
    float straightest_knee = 6;  ///< [deg] flexion that no leg goes below: sets the height of the hips

    // Trunk, head, arms.
    float lean = 3;          ///< [deg] of the trunk, forward
    float bank = 0.5f;       ///< share of the balanced lean into a turn, atan(speed * yaw rate / g)
    float trunk_yaw = 6;     ///< [deg] against the pelvis
    float look = 0.25f;      ///< [s] how far the head looks ahead into a turn
    float arm_swing = 20;    ///< [deg] either way
    float arm_bias = -4;     ///< [deg] forward
    float arm_out = 7;       ///< [deg] abduction
    float elbow = 18;        ///< [deg]
    float elbow_swing = 10;  ///< [deg] more when the arm is in front
    float arm_twist = 10;    ///< [deg] inward, so that bent forearms do not point straight ahead
    float breath = 0;        ///< [deg] of the chest, once a cycle
};

inline constexpr float k_gait_fps = 60;

/// The parameters of the embedded set, in its order.
std::vector<GaitParameters> synthetic_gaits();

/// The same gait to the other side under another name.
GaitParameters mirrored_gait(GaitParameters gait, std::string name);

/// intervals + 1 frames; cyclic; starts at the left foot's strike; root frames start at identity.
Motion make_gait_cycle(const Rig& biped, const GaitParameters& gait);

}  // namespace surefoot
