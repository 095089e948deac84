#include <surefoot/rig/limits.h>

#include <algorithm>
#include <cassert>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr Vec3 k_along_x{1, 0, 0}, k_along_y{0, 1, 0}, k_along_z{0, 0, 1};

struct Row {
    Role role;
    Vec3 low_deg, high_deg;
    Vec3 bone = k_along_y;
};

// Left side and middle. Where the Academy's figures differ between "passive" and "active" these are the active ones; 5
// degrees are added to knees and elbows that many people, and most captured motion, stretch beyond straight.
constexpr Row k_human[] = {
    {Role::spine, {-25, -45, -35}, {80, 45, 35}},
    {Role::neck, {-45, -60, -45}, {45, 60, 45}},
    {Role::left_shoulder, {-30, -30, -10}, {10, 25, 40}, k_along_x},
    // Swings of more than half a turn have no nearest way back: 175 degrees are as good as 180.
    {Role::left_upper_arm, {-175, -70, -45}, {60, 90, 175}},
    {Role::left_lower_arm, {-150, -80, -5}, {5, 80, 5}},
    {Role::left_hand, {-20, -10, -80}, {30, 10, 70}},
    {Role::left_upper_leg, {-120, -45, -30}, {30, 45, 45}},
    {Role::left_lower_leg, {-5, -10, -5}, {150, 10, 5}},
    {Role::left_foot, {-20, -20, -35}, {50, 20, 15}, k_along_z},
    {Role::left_toes, {-70, -5, -5}, {45, 5, 5}, k_along_z},
    {Role::left_thumb_metacarpal, {-60, -30, -50}, {30, 30, 50}},
    {Role::left_thumb_proximal, {-60, -10, -60}, {10, 10, 30}},
    {Role::left_thumb_distal, {-80, -5, -80}, {15, 5, 15}},
    {Role::left_index_proximal, {-20, -5, -90}, {20, 5, 30}},
    {Role::left_index_intermediate, {-5, -5, -100}, {5, 5, 5}},
    {Role::left_index_distal, {-5, -5, -80}, {5, 5, 10}},
    {Role::left_middle_proximal, {-20, -5, -90}, {20, 5, 30}},
    {Role::left_middle_intermediate, {-5, -5, -100}, {5, 5, 5}},
    {Role::left_middle_distal, {-5, -5, -80}, {5, 5, 10}},
    {Role::left_ring_proximal, {-20, -5, -90}, {20, 5, 30}},
    {Role::left_ring_intermediate, {-5, -5, -100}, {5, 5, 5}},
    {Role::left_ring_distal, {-5, -5, -80}, {5, 5, 10}},
    {Role::left_little_proximal, {-20, -5, -90}, {20, 5, 30}},
    {Role::left_little_intermediate, {-5, -5, -100}, {5, 5, 5}},
    {Role::left_little_distal, {-5, -5, -80}, {5, 5, 10}},
};

RoleLimits make_human() noexcept {
    RoleLimits limits;
    for (const Row& row : k_human)
        limits.set_both(row.role, {row.low_deg * k_radians_per_degree, row.high_deg * k_radians_per_degree, row.bone});
    return limits;
}

JointLimit share(const JointLimit& whole, std::size_t joints) noexcept {
    if (whole.free()) return whole;
    const float part = 1.0f / static_cast<float>(joints);
    return {whole.low * part, whole.high * part, whole.bone};
}

/// Joints of the chain that ends at `last`, from `first` on; empty where that is not above it.
std::vector<int> chain(const Skeleton& skeleton, int first, int last) {
    std::vector<int> joints;
    for (int j = last; j != k_no_joint; j = skeleton.parents[at(j)]) {
        joints.push_back(j);
        if (j == first) return joints;
    }
    return {};
}

int first_of(const RoleMap& roles, std::initializer_list<Role> wanted) noexcept {
    for (const Role role : wanted)
        if (roles.has(role)) return roles[role];
    return k_no_joint;
}

}  // namespace

bool JointLimit::free() const noexcept {
    const float half_turn = static_cast<float>(k_pi);
    return std::max({low.x, low.y, low.z}) < -half_turn && std::min({high.x, high.y, high.z}) > half_turn;
}

Vec3 turn_angles(Quat turn, Vec3 bone) noexcept {
    const float along = turn.x * bone.x + turn.y * bone.y + turn.z * bone.z;
    // Where the swing is half a turn the twist is anything: none, then.
    const Quat twist = normalized(Quat{bone.x * along, bone.y * along, bone.z * along, turn.w});
    return to_rotation_vector(turn * conjugate(twist)) + to_rotation_vector(twist);
}

Quat turn_from_angles(Vec3 angles, Vec3 bone) noexcept {
    const Vec3 twist = bone * dot(angles, bone);
    return normalized(from_rotation_vector(angles - twist) * from_rotation_vector(twist));
}

Quat clamped(const JointLimit& limit, Quat turn) noexcept {
    const Vec3 angles = turn_angles(turn, limit.bone);
    const Vec3 within{std::clamp(angles.x, limit.low.x, limit.high.x), std::clamp(angles.y, limit.low.y, limit.high.y),
                      std::clamp(angles.z, limit.low.z, limit.high.z)};
    return within == angles ? turn : turn_from_angles(within, limit.bone);
}

void RoleLimits::set_both(Role role, const JointLimit& limit) noexcept {
    (*this)[role] = limit;
    const Role other = mirrored(role);
    if (other == role) return;
    (*this)[other] = {
        {limit.low.x, -limit.high.y, -limit.high.z}, {limit.high.x, -limit.low.y, -limit.low.z}, limit.bone};
}

const RoleLimits& human_limits() noexcept {
    static const RoleLimits limits = make_human();
    return limits;
}

BodyLimits::BodyLimits(const Skeleton& skeleton, const RoleMap& roles, std::span<const Quat> stance,
                       const RoleLimits& limits)
    : limits_(skeleton.parents.size()), zero_(stance.begin(), stance.end()) {
    assert(stance.size() == skeleton.parents.size());
    for (int r = 0; r < k_role_count; ++r) {
        const auto role = static_cast<Role>(r);
        const bool of_trunk = role == Role::spine || role == Role::chest || role == Role::upper_chest;
        const bool of_neck = role == Role::neck || role == Role::head;
        if (roles.has(role) && !of_trunk && !of_neck) limits_[at(roles[role])] = limits[role];
    }
    const int neck = first_of(roles, {Role::neck, Role::head});
    const int top = neck == k_no_joint ? first_of(roles, {Role::upper_chest, Role::chest, Role::spine})
                                       : skeleton.parents[at(neck)];
    const std::vector<int> trunk = chain(skeleton, first_of(roles, {Role::spine, Role::chest, Role::upper_chest}), top);
    for (const int j : trunk) limits_[at(j)] = share(limits[Role::spine], trunk.size());
    const std::vector<int> cervical = chain(skeleton, neck, first_of(roles, {Role::head, Role::neck}));
    for (const int j : cervical) limits_[at(j)] = share(limits[Role::neck], cervical.size());

    for (int j = 0; j < skeleton.joint_count(); ++j) {
        for (const bool left : {true, false}) {
            const int arm = roles[left ? Role::left_upper_arm : Role::right_upper_arm];
            if (arm == k_no_joint || !is_within(skeleton, j, arm)) continue;
            const Quat lowered = axis_angle(k_along_z, static_cast<float>(left ? -k_pi / 2 : k_pi / 2));
            zero_[at(j)] = normalized(lowered * zero_[at(j)]);
        }
    }
    for (const std::int16_t parent : skeleton.parents)
        parent_zero_.push_back(parent == k_no_joint ? Quat{} : zero_[at(parent)]);
}

Quat BodyLimits::turn(int joint, Quat local) const noexcept {
    return normalized(parent_zero_[at(joint)] * local * conjugate(zero_[at(joint)]));
}

Quat BodyLimits::local(int joint, Quat turn) const noexcept {
    return normalized(conjugate(parent_zero_[at(joint)]) * turn * zero_[at(joint)]);
}

Quat BodyLimits::clamped(int joint, Quat local) const noexcept {
    const Quat now = turn(joint, local);
    const Quat within = surefoot::clamped(limits_[at(joint)], now);
    return within == now ? local : this->local(joint, within);
}

}  // namespace surefoot
