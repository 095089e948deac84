#include <surefoot/ik/lean.h>
#include <surefoot/math/trig.h>
#include <surefoot/rig/roles.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

float slope_lean(float slope) noexcept {
    constexpr float k_uphill = 0.33f, k_downhill = 0.14f, k_steepest = 35 * k_radians_per_degree;
    constexpr float k_nearly_level = 3 * k_radians_per_degree;
    const float steep = std::min(std::fabs(slope), k_steepest), felt = steep * steep / (steep + k_nearly_level);
    return slope > 0 ? k_uphill * felt : -k_downhill * felt;
}

float slope_along(const std::array<Quat, 2>& tilts, float yaw) noexcept {
    const Vec3 normal = normalized(rotate(tilts[0], k_up) + rotate(tilts[1], k_up));
    return -asin(dot(normal, rotate(from_yaw(yaw), Vec3{0, 0, 1})));
}

LeanJoints find_lean_joints(const Skeleton& skeleton, std::span<const Transform> standing) {
    const RoleMap roles = find_roles(skeleton, standing).roles;
    const auto joint = [&](Role role) { return static_cast<std::int16_t>(roles[role]); };
    return {{joint(Role::spine), joint(Role::chest), joint(Role::upper_chest)},
            joint(Role::neck),
            {joint(Role::left_upper_arm), joint(Role::right_upper_arm)}};
}

void lean(const LeanJoints& joints, std::span<const std::int16_t> parents, float angle,
          std::span<const Transform> models, std::span<Transform> locals) noexcept {
    const auto count = std::count_if(joints.spine.begin(), joints.spine.end(), [](int j) { return j != k_no_joint; });
    if (angle == 0 || count == 0) return;
    const auto forward = [](float by) { return axis_angle({1, 0, 0}, by); };
    // Its rotation in model space shall be `turn` before what it was, where that of its parent has become `before`
    // times what it was.
    const auto set = [&](int joint, Quat before, Quat turn) {
        if (joint == k_no_joint) return;
        const auto j = static_cast<std::size_t>(joint);
        const Quat parent = parents[j] == k_no_joint ? Quat{} : models[static_cast<std::size_t>(parents[j])].rotation;
        locals[j].rotation = normalized(conjugate(before * parent) * (turn * models[j].rotation));
    };
    float leant = 0;
    for (const int joint : joints.spine) {
        if (joint == k_no_joint) continue;
        const float next = leant + angle / static_cast<float>(count);
        set(joint, forward(leant), forward(next));
        leant = next;
    }
    set(joints.neck, forward(angle), forward(0.5f * angle));
    for (const int arm : joints.upper_arm) set(arm, forward(angle), {});
}

}  // namespace surefoot
