#pragma once
// The body that the generated clips are made for: the bundled template `adult` (templates/adult.rig), a T-pose skeleton
// with the humanoid names of VRM and Unity, sized by published proportions.

#include <surefoot/rig_text/rig_template.h>

namespace surefoot {

inline constexpr float k_default_stature = 1.75f;  ///< [m] the template's own

/// Sizes of a leg, which the gait generator rolls over the ground. All in metres, foot standing flat.
struct LegSize {
    float thigh = 0, shank = 0;
    float hip_half_width = 0;  ///< from the middle of the pelvis to a hip joint
    float hip_drop = 0;        ///< hip joints below the hips joint
    float ankle_height = 0;    ///< ankle above the sole
    float heel_back = 0;       ///< heel behind the ankle
    float ball_ahead = 0;      ///< ball, which is the toe joint, ahead of the ankle
    float toe_length = 0;      ///< ball to tip

    float length() const noexcept { return thigh + shank; }
};

/// `stature` in metres, within the template's range; throws Error otherwise.
Rig make_biped(float stature = k_default_stature);
/// The left leg's, of a rig whose axes are the body's (as every rig of a template is).
LegSize leg_size(const Rig& rig) noexcept;

}  // namespace surefoot
