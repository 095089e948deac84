#pragma once
// What a joint is: humanoid roles, the VRM 1.0 / Unity humanoid names in snake_case.
//
// A role map is found by name for the rigs in common use, and by shape where names fail (legs are the two long chains
// that end low). Toes, upper chest, shoulders and fingers are optional: a foot without a toe joint works everywhere.

#include <surefoot/rig/skeleton.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot {

enum class Role : std::uint8_t {
    hips,
    spine,
    chest,
    upper_chest,
    neck,
    head,
    jaw,
    left_eye,
    right_eye,
    left_shoulder,
    left_upper_arm,
    left_lower_arm,
    left_hand,
    right_shoulder,
    right_upper_arm,
    right_lower_arm,
    right_hand,
    left_upper_leg,
    left_lower_leg,
    left_foot,
    left_toes,
    right_upper_leg,
    right_lower_leg,
    right_foot,
    right_toes,
    left_thumb_metacarpal,
    left_thumb_proximal,
    left_thumb_distal,
    left_index_proximal,
    left_index_intermediate,
    left_index_distal,
    left_middle_proximal,
    left_middle_intermediate,
    left_middle_distal,
    left_ring_proximal,
    left_ring_intermediate,
    left_ring_distal,
    left_little_proximal,
    left_little_intermediate,
    left_little_distal,
    right_thumb_metacarpal,
    right_thumb_proximal,
    right_thumb_distal,
    right_index_proximal,
    right_index_intermediate,
    right_index_distal,
    right_middle_proximal,
    right_middle_intermediate,
    right_middle_distal,
    right_ring_proximal,
    right_ring_intermediate,
    right_ring_distal,
    right_little_proximal,
    right_little_intermediate,
    right_little_distal,
    count
};
inline constexpr int k_role_count = static_cast<int>(Role::count);

/// "left_upper_leg"; the order is that of the enum.
std::string_view role_name(Role role) noexcept;
/// Role::count where the text names no role.
Role role_from_name(std::string_view name) noexcept;
/// left_foot <-> right_foot; a role without sides is its own mirror.
Role mirrored(Role role) noexcept;

struct RoleMap {
    std::array<std::int16_t, k_role_count> joints;  ///< joint of each role, or k_no_joint

    RoleMap() noexcept { joints.fill(k_no_joint); }
    int operator[](Role role) const noexcept { return joints[static_cast<std::size_t>(role)]; }
    void set(Role role, int joint) noexcept {
        joints[static_cast<std::size_t>(role)] = static_cast<std::int16_t>(joint);
    }
    bool has(Role role) const noexcept { return (*this)[role] != k_no_joint; }
    /// Hips and both legs down to the feet: the least that locomotion needs.
    bool has_legs() const noexcept;

    friend bool operator==(const RoleMap&, const RoleMap&) = default;
};

struct RoleReport {
    RoleMap roles;
    std::string convention;          ///< "Mixamo", "CMU", …, or "shape" where names failed
    std::vector<std::string> lines;  ///< a readable explanation: what was mapped, how, and what is missing
};

/// Joint names by hand, one pair (role name, joint name) each; they win over everything found.
using RoleOverrides = std::vector<std::pair<std::string, std::string>>;

/// Finds the roles of a skeleton. `rest_models` is a pose in model space that shows its shape (the rest pose, or the
/// first frame of a clip where the rest pose has no shape), joint_count() long. Overrides that name no joint or role
/// are reported in `lines` and skipped.
RoleReport find_roles(const Skeleton& skeleton, std::span<const Transform> rest_models,
                      const RoleOverrides& overrides = {});

}  // namespace surefoot
