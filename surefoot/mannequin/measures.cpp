#include <surefoot/mannequin/measures.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

constexpr float k_leg_share = 0.491f, k_trunk_share = 0.302f;
constexpr float k_shoulder_half_width = 0.107f;
// Chin to crown over joint to crown, where the joint is the base of the skull.
constexpr float k_head_per_joint = 0.130f / 0.120f;

}  // namespace

Measures::Measures(const Skeleton& skeleton_, const RoleMap& roles_, const Legs& legs_,
                   std::span<const Transform> bind_)
    : skeleton(skeleton_), roles(roles_), legs(legs_), bind(bind_) {
    const Leg &left_leg = legs[Side::left], &right_leg = legs[Side::right];
    stature = std::max(0.5f * (left_leg.length() + right_leg.length()) / k_leg_share, 1e-3f);
    const Vec3 hip_left = at(Role::left_upper_leg), hip_right = at(Role::right_upper_leg);
    hips = 0.5f * (hip_left + hip_right);
    left = normalized(hip_left - hip_right, {1, 0, 0});
    if (has(Role::neck) || has(Role::head)) {
        const float by_trunk = distance(neck_base(), hips) / k_trunk_share;
        stature = 0.5f * (stature + std::clamp(by_trunk, 0.5f * stature, 2.0f * stature));
    }
    const Vec3 knees = 0.5f * (at(Role::left_lower_leg) + at(Role::right_lower_leg));
    const Vec3 rise = normalized(neck_base() - hips, normalized(hips - knees, k_up));
    up = normalized(rise - left * dot(rise, left), k_up);
    front = cross(left, up);
    hip_half_width = std::max(0.5f * distance(hip_left, hip_right), size(0.02f));
    shoulder_half_width = size(k_shoulder_half_width);
    if (has(Role::left_upper_arm) && has(Role::right_upper_arm))
        shoulder_half_width = std::clamp(
            0.5f * std::fabs(dot(at(Role::left_upper_arm) - at(Role::right_upper_arm), left)), size(0.06f), size(0.2f));
}

int Measures::chest_joint() const {
    for (Role role : {Role::upper_chest, Role::chest, Role::spine})
        if (has(role)) return roles[role];
    return roles[Role::hips];
}

Vec3 Measures::neck_base() const {
    if (has(Role::neck)) return at(Role::neck);
    if (has(Role::head)) {
        const Vec3 head = at(Role::head);
        return head + (hips - head) * 0.14f;
    }
    for (Role role : {Role::upper_chest, Role::chest, Role::spine})
        if (has(role)) return at(role) + (at(role) - hips) * 0.5f + Vec3{0, size(0.05f), 0};
    return hips + Vec3{0, size(0.3f), 0};
}

float Measures::head_height() const {
    const float above = dot(tip_of(roles[Role::head], up, 0.12f) - at(Role::head), up);
    return std::clamp(above * k_head_per_joint, size(0.1f), size(0.28f));
}

Vec3 Measures::head_base() const {
    const Vec3 joint = at(Role::head);
    const float above = dot(tip_of(roles[Role::head], up, 0.12f) - joint, up);
    return joint + up * (above - head_height());
}

Vec3 Measures::tip_of(int joint, Vec3 direction, float usual) const {
    const Vec3 from = pose(joint).translation;
    float farthest = size(0.3f * usual);
    Vec3 tip = from + direction * size(usual);
    for (int k = joint; k < skeleton.joint_count(); ++k) {
        if (!is_within(skeleton, k, joint)) continue;
        const Vec3 end = transform_point(pose(k), skeleton.tips[static_cast<std::size_t>(k)]);
        const float along = dot(end - from, direction);
        if (along <= farthest || along > size(2.5f * usual)) continue;
        farthest = along;
        tip = from + direction * along;
    }
    return tip;
}

}  // namespace surefoot
