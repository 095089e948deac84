#pragma once
// A clip on another path: its residual turn or drift taken out, or a turn, drift or pace given to it.
//
// The root path is rebuilt from the same velocities in the body's frame plus what is missing to the wanted means, so
// the body's own sway, surge and timing stay. Bending the path alone would drag the standing feet round with the body
// (at 30 deg/s by some 15 cm/s). So each foot follows the bend as it was at the middle of its stance, and between two
// stances goes over from the one to the other: a standing foot stands, and the legs turn in the hip as they do in a
// real curve. (Gleicher 2001, "Motion path editing", with his constraints put back by construction.)

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

#include <array>
#include <optional>

namespace surefoot {

/// When each foot stands: one flag a frame, left foot first.
using StanceFlags = std::array<std::vector<char>, 2>;

/// Means over the clip, of the root in its own frame. What is absent stays as it is.
struct PathTarget {
    std::optional<float> turn;     ///< [rad/s] positive to the left
    std::optional<float> lateral;  ///< [m/s] to the left
    std::optional<float> forward;  ///< [m/s] the steps grow longer or shorter at the same rhythm
};

struct SteerReport {
    float turn_before = 0;     ///< [rad/s] mean of the root
    float lateral_before = 0;  ///< [m/s]
    float forward_before = 0;  ///< [m/s]
    float foot_moved = 0;      ///< [m] farthest that a foot was moved against the body
    float foot_turned = 0;     ///< [rad] farthest that a foot was turned against the body
    float missed = 0;          ///< [m] farthest that a leg was too short for its foot's place; 0: none was
};

/// Brings the clip's mean turn and drift to `target`. Needs extracted root motion and roles.has_legs(); `stances` may
/// be empty, and then the feet turn with the body. Frame count, frame rate, heights and the pose above the hips stay.
/// Cyclic clips stay cyclic. Cost: linear in frames and joints.
Motion steer(const Motion& motion, const RoleMap& roles, const StanceFlags& stances, const PathTarget& target,
             SteerReport* report = nullptr);

}  // namespace surefoot
