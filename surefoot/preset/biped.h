#pragma once
// The generated biped: a T-pose skeleton with the humanoid names of VRM and Unity, sized by published proportions.
//
// Model space: soles on y = 0, facing +Z, left hand on +X, every rest rotation identity. Segment lengths are fractions
// of stature from R. Drillis and R. Contini, "Body Segment Parameters", NYU report 1166-03, 1966, as drawn in
// D. Winter, "Biomechanics and Motor Control of Human Movement", fig. 4.1.

#include <surefoot/rig/roles.h>

#include <memory>

namespace surefoot {

inline constexpr float k_default_stature = 1.75f;  ///< [m]

struct Biped {
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;
    float stature = k_default_stature;  ///< [m]
};

/// Sizes of a leg, which the gait generator rolls over the ground. All in metres, foot standing flat.
struct LegSize {
    float thigh = 0, shank = 0;
    float hip_half_width = 0;  ///< from the middle of the pelvis to a hip joint
    float hip_drop = 0;        ///< hip joints below the hips joint
    float ankle_height = 0;    ///< ankle above the sole
    float heel_back = 0;       ///< heel behind the ankle
    float ball_ahead = 0;      ///< ball, which is the toe joint, ahead of the ankle
    float toe_length = 0;      ///< ball to tip
    float half_breadth = 0;    ///< of the sole

    float length() const noexcept { return thigh + shank; }
};

/// `stature` > 0, metres.
Biped make_biped(float stature = k_default_stature);
LegSize leg_size(float stature) noexcept;

}  // namespace surefoot
