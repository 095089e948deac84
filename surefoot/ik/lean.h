#pragma once
// How the upper body answers a slope: the trunk leans into it, the head half as much, and the arms hang as they did.
// A little: what is asked for is balance, and the clip's own way of moving shows through.

#include <surefoot/rig/skeleton.h>

#include <array>
#include <span>

namespace surefoot {

/// How far a trunk leans on a slope [rad], forward positive; `slope` likewise positive uphill. A third of it uphill, a
/// seventh downhill, 35 degrees of slope at most; nothing of what is nearly level, and no kink anywhere.
float slope_lean(float slope) noexcept;

/// The slope [rad] that is felt under two feet along a heading, positive uphill; `tilts` take flat ground to the ground
/// under each foot.
float slope_along(const std::array<Quat, 2>& tilts, float yaw) noexcept;

/// The joints that lean, each k_no_joint where there is none.
struct LeanJoints {
    std::array<std::int16_t, 3> spine{k_no_joint, k_no_joint, k_no_joint};  ///< spine, chest, upper chest
    std::int16_t neck = k_no_joint;
    std::array<std::int16_t, 2> upper_arm{k_no_joint, k_no_joint};  ///< by Side
};
/// By role; `standing` is a pose in model space in which it stands (find_roles).
LeanJoints find_lean_joints(const Skeleton& skeleton, std::span<const Transform> standing);

/// Leans a pose forward by `angle` [rad], in its own frame. `models` is that pose in model space.
void lean(const LeanJoints& joints, std::span<const std::int16_t> parents, float angle,
          std::span<const Transform> models, std::span<Transform> locals) noexcept;

}  // namespace surefoot
