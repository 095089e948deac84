#pragma once
// What a gait may move: the channels of a body, and the names of controls that drive them.
//
// A gait's controls are bound by name to channels once; then each frame
//
//     apply(binding, scale, outputs, channels);      // eight lanes of controls to eight lanes of channels
//     solve(body, channels, pose);                   // body/body.h
//
// All channels at 0 is a body that stands upright with its arms hanging. Controls are in metres, radians (degrees where
// their unit says "deg"), metres a second and, for `root.turn`, degrees a second, in the character's frame: X to its
// left, Y up from the ground under its root, Z forward. Rotations are right-handed about these axes: rX leans forward
// or points toes down, rY turns left, rZ lifts the left side.
//
// Names, sides by `left_` and `right_`; docs/gaits.md has the table for users.
//
//     root.speed root.lateral root.climb root.turn      how the root moves: it never jumps
//     ground.slope                                      the plane that feet stand on, uphill positive
//     hips.tX .tY .tZ .rX .rY .rZ                       tY: height of the hip joints; tX, tZ: offsets
//     left_hip.tY .tZ           (LeftUpLeg.*)           height, and forward: both sides together turn and tilt the
//     pelvis chest.tX .tY .tZ .rX .rY .rZ                      offsets of the spine's top from where the hips carry it
//     StY StZ CtY CtZ                                   the paper's: top and base of the spine, offsets from rest
//     head.rX .rY .rZ                                   where the head looks; 0 is level and ahead
//     left_shoulder.tY .tZ      (LeftShoulder.*)        opposite on both sides they turn the chest, alike the girdle
//     left_hand.tX .tY .tZ      (LeftArm.*)             the wrist: tY its height when the body stands upright
//     left_hand.rX .rY .rZ                              against the forearm, as seen with the arm hanging
//     left_hand.hold                                    0: carried along by the shoulder; 1: held in the root's frame
//     left_elbow.out left_knee.out                      how far they point outward
//     left_foot.tX .tY .tZ      (LeftFoot.*)            the foot lying flat, from where it stands at rest
//     left_foot.rX .rY .rZ                              rX > 0 rolls over the ball, rX < 0 over the heel
//     left_foot.turned                                  the place itself turned about the root: for feet on a curve
//     left_foot.floor                                   height below which this sole never goes (0)
//     left_toe.tY (LeftToe.tY), left_toe.rX             the tip over the sole; the toes' own bend
//
// Lengths are those of a gait's own body, an adult of 1.75 m whose hip joints are k_gait_hip_height over the ground; a
// body of other size makes them its own (BodyScale).

#include <surefoot/rig/leg.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

enum class BodyChannel : std::uint8_t {
    root_lateral,
    root_climb,
    root_speed,
    root_turn,
    ground_slope,
    hips_x,
    hips_rx,
    hips_ry,
    hips_rz,
    chest_x,
    chest_y,
    chest_z,
    chest_rx,
    chest_ry,
    chest_rz,
    head_rx,
    head_ry,
    head_rz,
    // Of the left side; `of_side` gives the right side's.
    hip_y,
    hip_z,
    shoulder_y,
    shoulder_z,
    hand_x,
    hand_y,
    hand_z,
    hand_rx,
    hand_ry,
    hand_rz,
    hand_hold,
    elbow_out,
    knee_out,
    foot_x,
    foot_y,
    foot_z,
    foot_rx,
    foot_ry,
    foot_rz,
    foot_turned,
    foot_floor,
    toe_y,
    toe_rx,
    count_of_left
};
inline constexpr int k_first_sided_channel = static_cast<int>(BodyChannel::hip_y);
inline constexpr int k_sided_channels = static_cast<int>(BodyChannel::count_of_left) - k_first_sided_channel;
inline constexpr int k_body_channels = k_first_sided_channel + 2 * k_sided_channels;

/// Index of a channel; `left` is one of the left side.
constexpr int of_side(BodyChannel left, Side side) noexcept {
    return static_cast<int>(left) + (side == Side::right ? k_sided_channels : 0);
}

// The body that gaits are written for: an adult of 1.75 m (R. Drillis and R. Contini, "Body Segment Parameters", 1966).
inline constexpr float k_gait_hip_height = 0.9275f;       ///< [m] hip joints over the soles: thigh, shank and ankle
inline constexpr float k_gait_shoulder_height = 1.4105f;  ///< [m] shoulder joints
inline constexpr float k_gait_wrist_height = 0.84f;       ///< [m] of hanging arms, elbows all but straight
inline constexpr float k_gait_arm_length = 0.581f;        ///< [m] shoulder to wrist
inline constexpr float k_degrees = 0.01745329252f;        ///< [rad] a degree

/// What lengths and times of a gait are multiplied by for a body. Bodies of different size move alike where speed
/// squared over leg length is the same (R. McN. Alexander, "The gaits of bipedal and quadrupedal animals", 1984), so
/// times go with the root of lengths: a child's steps are shorter and quicker.
struct BodyScale {
    float leg = 1, arm = 1;  ///< of lengths
    float time = 1;          ///< sqrt(leg)

    float speed() const noexcept { return leg / time; }
};

/// One control drives a channel: channel += (control - reference) * weight, scaled for the body.
struct BodyTerm {
    std::uint16_t control = 0;  ///< index among the gait's outputs
    std::uint16_t channel = 0;
    float weight = 1, reference = 0;
};

struct BodyBinding {
    std::vector<BodyTerm> terms;
    std::vector<std::string> unknown;  ///< controls that nothing here is called like
};

struct ControlName {
    std::string_view name, unit;
};

/// Binds controls by name, in the order of a gait's outputs. Names that stand for a part of the paper's calculation
/// (f_pelvis, ty, AtauR, …) and for where the root is (root.tX, root.tY, root.tZ) drive nothing and are not unknown.
BodyBinding bind_controls(std::span<const ControlName> controls);

/// outputs[control * 8 + lane] to channels[channel * 8 + lane], k_body_channels * 8 of them, each held within +-1000.
void apply(const BodyBinding& binding, const BodyScale& scale, std::span<const float> outputs,
           std::span<float> channels) noexcept;

}  // namespace surefoot
