#pragma once
// What the measurements look at: the paths of a few joints and sole points of one motion, in world space.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>

#include <array>
#include <vector>

namespace surefoot {

struct FootTrack {
    std::vector<Transform> foot, toes;       ///< joints; toes = foot where there is no toe joint
    std::vector<Vec3> heel, mid, ball, tip;  ///< sole points; empty until add_soles
    std::vector<float> yaw;                  ///< [rad] direction of the foot's forward, unwrapped; with the soles
    std::vector<float> lowest;               ///< [m] lowest joint or bone end of the foot
};

/// One sample a frame of the motion.
struct Tracks {
    float fps = 30;
    std::vector<Transform> hips;
    std::vector<Vec3> head;                 ///< head, or the highest joint of the spine there is
    std::vector<float> crown;               ///< [m] height of the highest point at or above the head joint
    std::array<std::vector<Vec3>, 2> hand;  ///< empty without hands
    std::array<std::vector<Vec3>, 2> upper_arm;
    std::vector<float> heading;     ///< [rad] torso's facing, unwrapped
    std::vector<float> tilt;        ///< [rad] of hips-to-head against the vertical
    std::array<FootTrack, 2> foot;  ///< by Side

    int frame_count() const noexcept { return static_cast<int>(hips.size()); }
};

/// Needs roles.has_legs(). Joint paths only.
Tracks make_tracks(const Motion& motion, const RoleMap& roles);

/// Fills sole points and foot headings.
void add_soles(Tracks& tracks, const Legs& legs);

/// Three cycles of a cyclic clip's tracks in a row (2 * (n - 1) more frames): what is measured in the middle one has no
/// ends. Each cycle continues from where the one before ended, as the first and last of `root` say.
Tracks repeated(const Tracks& tracks, const RootFrame& first, const RootFrame& last);

/// All tracks moved by one rigid transform a frame (of the ground plane).
void move_tracks(Tracks& tracks, const std::vector<RootFrame>& by);

}  // namespace surefoot
