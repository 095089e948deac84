#include <surefoot/rig/role_search.h>

#include <algorithm>
#include <array>

namespace surefoot {

namespace {

// Order of the enum.
constexpr std::array<std::string_view, k_role_count> k_names = {
    "hips",
    "spine",
    "chest",
    "upper_chest",
    "neck",
    "head",
    "jaw",
    "left_eye",
    "right_eye",
    "left_shoulder",
    "left_upper_arm",
    "left_lower_arm",
    "left_hand",
    "right_shoulder",
    "right_upper_arm",
    "right_lower_arm",
    "right_hand",
    "left_upper_leg",
    "left_lower_leg",
    "left_foot",
    "left_toes",
    "right_upper_leg",
    "right_lower_leg",
    "right_foot",
    "right_toes",
    "left_thumb_metacarpal",
    "left_thumb_proximal",
    "left_thumb_distal",
    "left_index_proximal",
    "left_index_intermediate",
    "left_index_distal",
    "left_middle_proximal",
    "left_middle_intermediate",
    "left_middle_distal",
    "left_ring_proximal",
    "left_ring_intermediate",
    "left_ring_distal",
    "left_little_proximal",
    "left_little_intermediate",
    "left_little_distal",
    "right_thumb_metacarpal",
    "right_thumb_proximal",
    "right_thumb_distal",
    "right_index_proximal",
    "right_index_intermediate",
    "right_index_distal",
    "right_middle_proximal",
    "right_middle_intermediate",
    "right_middle_distal",
    "right_ring_proximal",
    "right_ring_intermediate",
    "right_ring_distal",
    "right_little_proximal",
    "right_little_intermediate",
    "right_little_distal",
};

}  // namespace

std::string_view role_name(Role role) noexcept {
    return role < Role::count ? k_names[static_cast<std::size_t>(role)] : std::string_view{};
}

Role role_from_name(std::string_view name) noexcept {
    const auto at = std::find(k_names.begin(), k_names.end(), name);
    return static_cast<Role>(at - k_names.begin());  // Role::count where not found
}

Role mirrored(Role role) noexcept {
    static const std::array<Role, k_role_count> k_mirror = [] {
        std::array<Role, k_role_count> table{};
        for (int i = 0; i < k_role_count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            std::string other(k_names[k]);
            if (other.starts_with("left_"))
                other.replace(0, 5, "right_");
            else if (other.starts_with("right_"))
                other.replace(0, 6, "left_");
            table[k] = role_from_name(other);
        }
        return table;
    }();
    return role < Role::count ? k_mirror[static_cast<std::size_t>(role)] : role;
}

bool RoleMap::has_legs() const noexcept {
    for (const Role role : {Role::hips, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot,
                            Role::right_upper_leg, Role::right_lower_leg, Role::right_foot})
        if (!has(role)) return false;
    return true;
}

}  // namespace surefoot
