#include <surefoot/rig/role_search.h>
#include <surefoot/rig/roles.h>

#include <algorithm>

namespace surefoot {

namespace {

struct Group {
    std::string_view title;
    Role first, last;
};
constexpr Group k_groups[] = {
    {"trunk", Role::hips, Role::head},
    {"face", Role::jaw, Role::right_eye},
    {"left leg", Role::left_upper_leg, Role::left_toes},
    {"right leg", Role::right_upper_leg, Role::right_toes},
    {"left arm", Role::left_shoulder, Role::left_hand},
    {"right arm", Role::right_shoulder, Role::right_hand},
    {"left fingers", Role::left_thumb_metacarpal, Role::left_little_distal},
    {"right fingers", Role::right_thumb_metacarpal, Role::right_little_distal},
};

enum class Means : std::uint8_t { none, name, shape, hand };
constexpr std::string_view k_means_text[] = {"", "by name", "by shape", "by hand"};

Role next(Role role) { return static_cast<Role>(static_cast<int>(role) + 1); }

// "left leg: left_upper_leg = thigh_l, … (by name)", one line for each means within a group.
void describe(const Skeleton& skeleton, const RoleMap& roles, const std::array<Means, k_role_count>& means,
              std::vector<std::string>& lines) {
    for (const Group& group : k_groups)
        for (const Means how : {Means::name, Means::shape, Means::hand}) {
            std::string line;
            for (Role role = group.first; role <= group.last; role = next(role)) {
                if (!roles.has(role) || means[static_cast<std::size_t>(role)] != how) continue;
                line += line.empty() ? std::string(group.title) + ": " : ", ";
                line += std::string(role_name(role)) + " = " + skeleton.names[static_cast<std::size_t>(roles[role])];
            }
            if (!line.empty()) lines.push_back(line + " (" + std::string(k_means_text[static_cast<int>(how)]) + ")");
        }
}

void describe_missing(const RoleMap& roles, std::vector<std::string>& lines) {
    std::string needed, optional;
    for (Role role = Role::hips; role <= Role::right_toes; role = next(role)) {
        if (roles.has(role) || (role >= Role::jaw && role <= Role::right_eye)) continue;
        const bool leg = role >= Role::left_upper_leg && role != Role::left_toes && role != Role::right_toes;
        std::string& text = role == Role::hips || leg ? needed : optional;
        text += (text.empty() ? "" : ", ") + std::string(role_name(role));
    }
    if (!needed.empty())
        lines.push_back("missing and needed for locomotion: " + needed + "; name the joints by hand (role overrides)");
    if (!optional.empty()) lines.push_back("missing, can be done without: " + optional);
}

// Left is on the left of where the toes point; names that say otherwise are worth a word. Only an upright pose with
// both feet down can tell.
void check_sides(const RoleMap& roles, std::span<const Transform> models, std::vector<std::string>& lines) {
    if (!roles.has_legs() || !roles.has(Role::left_toes) || !roles.has(Role::right_toes) || !roles.has(Role::head))
        return;
    const auto at = [&](Role role) { return models[static_cast<std::size_t>(roles[role])].translation; };
    const float left_drop = at(Role::hips).y - at(Role::left_foot).y;
    const float right_drop = at(Role::hips).y - at(Role::right_foot).y;
    const Vec3 up = at(Role::head) - at(Role::hips);
    if (std::fabs(left_drop - right_drop) > 0.05f * length(up) || left_drop < 0.8f * length(up)) return;
    const Vec3 forward = at(Role::left_toes) - at(Role::left_foot) + at(Role::right_toes) - at(Role::right_foot);
    const Vec3 left = at(Role::left_upper_leg) - at(Role::right_upper_leg);
    const Vec3 expected = cross(up, forward);
    if (dot(expected, left) < -0.5f * length(expected) * length(left))
        lines.push_back(
            "left and right, as named, are exchanged against the direction of the toes; check the rest pose");
}

void apply_overrides(const Skeleton& skeleton, const RoleOverrides& overrides, RoleMap& roles,
                     std::array<Means, k_role_count>& means, std::vector<std::string>& lines) {
    for (const auto& [role_text, joint_text] : overrides) {
        const Role role = role_from_name(role_text);
        const int joint = skeleton.find(joint_text);
        if (role == Role::count)
            lines.push_back("override skipped: there is no role '" + role_text + "'");
        else if (joint == k_no_joint && !joint_text.empty())
            lines.push_back("override skipped: there is no joint '" + joint_text + "' for role " + role_text);
        else {
            // The joint loses any other role it was given.
            for (std::int16_t& other : roles.joints)
                if (joint != k_no_joint && other == joint) other = k_no_joint;
            roles.set(role, joint);
            means[static_cast<std::size_t>(role)] = Means::hand;
        }
    }
}

}  // namespace

RoleReport find_roles(const Skeleton& skeleton, std::span<const Transform> rest_models,
                      const RoleOverrides& overrides) {
    RoleReport report;
    report.roles = roles_by_name(skeleton);
    std::array<Means, k_role_count> means{};
    for (std::size_t r = 0; r < means.size(); ++r)
        if (report.roles.joints[r] != k_no_joint) means[r] = Means::name;
    const bool named = report.roles.has_legs();
    for (const Role role : add_roles_by_shape(skeleton, rest_models, report.roles))
        means[static_cast<std::size_t>(role)] = Means::shape;
    report.convention = named ? naming_convention(skeleton, report.roles) : "shape";
    report.lines.push_back("joint names: " + report.convention);
    apply_overrides(skeleton, overrides, report.roles, means, report.lines);
    describe(skeleton, report.roles, means, report.lines);
    describe_missing(report.roles, report.lines);
    check_sides(report.roles, rest_models, report.lines);
    return report;
}

}  // namespace surefoot
