#pragma once
// The kernels of this room, as raw as they are (clip/kernels.h says why): feet on the ground, lanes are the left and
// right feet of four characters in turns. Private to crowd/. Every kernel has a scalar twin with the same bits.

#include <surefoot/math/kernel_builds.h>

#include <cstdint>

namespace surefoot {

inline constexpr int k_ground_lanes = 8;
inline constexpr int k_foot_floats = 11;  ///< of a CrowdFoot: two planes (x, z, height, slope_x, slope_z) and its share

/// Eight feet. Numbers named `is_…` are 1 or 0.
struct GroundLanes {
    using Row = float[k_ground_lanes];
    using Flags = std::int32_t[k_ground_lanes];

    // What is known: the root, and feet as the blend has them, seen from it.
    Row root[3], yaw;
    Row heel[3], ball[3];  ///< [m] on the sole, in the foot's frame
    Row now[7], next[7];   ///< qx qy qz qw tx ty tz; next of those that swing
    Row share, stance;     ///< of the step
    Flags is_stepping, is_new;
    Row foot[k_foot_floats];  ///< what is remembered; changed

    // For the ground: where it is asked, and which feet need it.
    Row asked[3];
    Flags is_asking;

    // Its answers.
    Flags is_hit;
    Row height, normal[3];

    // Where feet shall be, as seen from a root of that heading at height 0; and how high the ground is there.
    Row goal[7], ground;

    // Between the two kernels.
    Row sine, cosine;  ///< of the heading
    Row centre[3];     ///< of the sole, world
    Flags is_laid;     ///< stands on what is asked for from now on
};

struct GroundKernels {
    const char* name;
    /// Up to the questions.
    void (*ask)(GroundLanes& lanes);
    /// From the answers to the goals; no sole lies steeper than the slope `steepest`.
    void (*lay)(GroundLanes& lanes, float steepest);
};

SUREFOOT_DECLARE_KERNELS(GroundKernels);

}  // namespace surefoot
