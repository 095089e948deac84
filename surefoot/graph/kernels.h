#pragma once
// The kernels of this room, as raw as they are (clip/kernels.h says why). Lanes are feet, or the legs of four
// characters, left and right in turns. Private to graph/; the face is foot_lanes.h. Every kernel has a scalar twin with
// the same bits.

#include <surefoot/math/kernel_builds.h>

#include <cstdint>

namespace surefoot {

inline constexpr int k_foot_lanes = 8;
inline constexpr int k_leg_joints = 48;             ///< from the root to a foot: LegPaths::k_most
inline constexpr int k_model_floats = 56;           ///< of a joint in eight lanes: qx8 qy8 qz8 qw8 tx8 ty8 tz8
inline constexpr float k_soft_extension = 0.9975f;  ///< TwoBone::soft_extension

/// One leaf of each of eight feet. Keys are FootKeys: print (qx qy qz qw tx ty tz), toes (qx qy qz qw), age.
struct FootLeafLanes {
    const float* from[k_foot_lanes];
    const float* to[k_foot_lanes];
    float share[k_foot_lanes];     ///< of the later key
    float weight[k_foot_lanes];    ///< of the leaf; 0 where a foot has fewer leaves
    float stepping[k_foot_lanes];  ///< its weight, or 0 if it does not step
    float say[k_foot_lanes];       ///< what it has to say about age
};

/// Eight feet. Heel and ball [m] are on the sole, in the foot's frame.
struct FootLanes {
    float heel[3][k_foot_lanes], ball[3][k_foot_lanes];
    float velocity[3][k_foot_lanes], turn[k_foot_lanes];  ///< [m/s], [rad/s] of the blended root
    float pace[k_foot_lanes];                             ///< by which age is divided
    float ahead[k_foot_lanes];                            ///< [s] in which the foot is there
    float foot[7][k_foot_lanes], toes[4][k_foot_lanes];   ///< out: as seen from the root
};

/// The joints of a left and a right leg from the root down, made alike: where one has fewer, -1 stands in for a joint
/// that does nothing. The last one is the foot.
struct LegChains {
    int count = 0, upper = 0, lower = 0;  ///< places in it
    std::int16_t joint[2][k_leg_joints];
    std::int16_t toes[2];  ///< or -1
    float knee_forward[3][2];
};

struct LegGoalLanes {
    float foot[7][k_foot_lanes];
    float toes[4][k_foot_lanes];
};

struct FootKernels {
    const char* name;
    /// The weighted mean of the leaves' keys, seen from the root, which is as old as they are in `ahead` seconds.
    void (*mean_feet)(const FootLeafLanes* leaves, int count, FootLanes& feet);
    /// Model space of the legs' joints, [place][k_model_floats], from local poses of `joints` joints [qx qy qz qw tx ty
    /// tz].
    void (*run_forward)(const LegChains& chains, const float* const* locals, int joints, float* models);
    /// How far the hips [m] >= 0 would have to sink for each foot to be within `share` of its leg's length.
    void (*sink)(const LegChains& chains, const float* models, const LegGoalLanes& goals, float share, float* sinks);
    /// Two-bone solving: the rotations of both legs' joints into the local poses.
    void (*reach)(const LegChains& chains, const float* models, const LegGoalLanes& goals, float* const* locals);
};

SUREFOOT_DECLARE_KERNELS(FootKernels);

}  // namespace surefoot
