#include <surefoot/motion/retarget_turns.h>
#include <surefoot/motion/stance.h>
#include <surefoot/rig/role_search.h>

#include <algorithm>

namespace surefoot {
namespace {

// [rad] Joints that are named alike but rest farther apart than this do not mean the same by their local rotations.
constexpr float k_same_axes = 30 * k_radians_per_degree;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Quat local_rotation(const Skeleton& skeleton, std::span<const Transform> models, int joint) {
    const int parent = skeleton.parents[at(joint)];
    const Quat own = models[at(joint)].rotation;
    return parent == k_no_joint ? own : normalized(conjugate(models[at(parent)].rotation) * own);
}

bool is_trunk(Role role) { return role == Role::hips || (role >= Role::spine && role <= Role::head); }

/// The joints from the hips to where the arms branch off, and on to the head.
struct Trunk {
    std::vector<int> joints;  // hips first
    std::size_t top = 0;      // index of the last one below the neck
};

/// Where the arms branch off, or the highest spine joint of a body without arms.
int top_of_spine(const RetargetBody& body) {
    const RoleMap& roles = body.roles;
    const int hips = roles[Role::hips];
    if (roles.has(Role::left_upper_arm) && roles.has(Role::right_upper_arm)) {
        const int top = common_ancestor(*body.skeleton, roles[Role::left_upper_arm], roles[Role::right_upper_arm]);
        if (top != k_no_joint && is_within(*body.skeleton, top, hips)) return top;
    }
    for (const Role role : {Role::upper_chest, Role::chest, Role::spine})
        if (roles.has(role)) return roles[role];
    return hips;
}

Trunk find_trunk(const RetargetBody& body) {
    const int hips = body.roles[Role::hips], top = top_of_spine(body);
    int end = top;
    for (const Role role : {Role::head, Role::neck})
        if (body.roles.has(role) && is_within(*body.skeleton, body.roles[role], top)) {
            end = body.roles[role];
            break;
        }
    Trunk trunk;
    for (int j = end; j != k_no_joint; j = body.skeleton->parents[at(j)]) {
        trunk.joints.push_back(j);
        if (j == hips) break;
    }
    std::reverse(trunk.joints.begin(), trunk.joints.end());
    const auto found = std::find(trunk.joints.begin(), trunk.joints.end(), top);
    trunk.top = static_cast<std::size_t>(found - trunk.joints.begin());
    return trunk;
}

}  // namespace

std::vector<Transform> shape_pose(const RetargetBody& body) {
    if (!body.shape.empty()) return body.shape;
    std::vector<Transform> models(body.skeleton->rest.size());
    local_to_model(*body.skeleton, body.skeleton->rest, models);
    return models;
}

RetargetTurns::RetargetTurns(const RetargetBody& source, const RetargetBody& target)
    : skeleton_(target.skeleton),
      source_stance_(t_stance(*source.skeleton, source.roles, source.legs, shape_pose(source))),
      target_stance_(t_stance(*target.skeleton, target.roles, target.legs, shape_pose(target))),
      follow_(target.skeleton->rest.size()) {
    const std::vector<Transform> shape = shape_pose(target);
    for (int j = 0; j < skeleton_->joint_count(); ++j)
        follow_[at(j)].rest = is_within(*skeleton_, target.roles[Role::hips], j) && j != target.roles[Role::hips]
                                  ? skeleton_->rest[at(j)].rotation
                                  : local_rotation(*skeleton_, shape, j);
    follow_names(source, target);
    follow_roles(source, target);
    follow_trunk(source, target);
}

void RetargetTurns::follow_names(const RetargetBody& source, const RetargetBody& target) {
    const Skeleton &from = *source.skeleton, &to = *target.skeleton;
    const std::vector<Transform> shape = shape_pose(source);
    const auto parent_name = [](const Skeleton& s, int j) {
        return s.parents[at(j)] == k_no_joint ? std::string() : s.names[at(s.parents[at(j)])];
    };
    for (int j = 0; j < to.joint_count(); ++j) {
        const int same = from.find(to.names[at(j)]);
        if (same == k_no_joint || parent_name(from, same) != parent_name(to, j)) continue;
        if (is_within(to, target.roles[Role::hips], j)) continue;  // what is above the hips stays
        Follow& follow = follow_[at(j)];
        const Quat rest = local_rotation(from, shape, same);
        if (rotation_angle(conjugate(rest) * follow.rest) > k_same_axes) continue;
        follow.kind = Follow::Kind::local;
        follow.from = same;
        follow.source_rest = rest;
    }
}

void RetargetTurns::follow_roles(const RetargetBody& source, const RetargetBody& target) {
    for (int r = 0; r < k_role_count; ++r) {
        const Role role = static_cast<Role>(r);
        if (!target.roles.has(role)) continue;
        Follow& follow = follow_[at(target.roles[role])];
        follow.kind = source.roles.has(role) && !is_trunk(role) ? Follow::Kind::turn : Follow::Kind::parent;
        follow.from = follow.to = source.roles[role];
    }
}

void RetargetTurns::follow_trunk(const RetargetBody& source, const RetargetBody& target) {
    const Trunk theirs = find_trunk(source), ours = find_trunk(target);
    // Joint k of n follows the place k * their_n / n of the source's chain.
    const auto share_out = [&](std::size_t first, std::size_t last, std::size_t their_first, std::size_t their_last) {
        for (std::size_t k = first; k <= last && last > first; ++k) {
            const std::size_t steps = last - first, place = (k - first) * (their_last - their_first);
            Follow& follow = follow_[at(ours.joints[k])];
            follow.kind = Follow::Kind::turn;
            follow.from = theirs.joints[their_first + place / steps];
            follow.to = theirs.joints[std::min(their_first + place / steps + 1, their_last)];
            follow.share = static_cast<float>(place % steps) / static_cast<float>(steps);
        }
    };
    Follow& hips = follow_[at(ours.joints.front())];
    hips.kind = Follow::Kind::turn;
    hips.from = hips.to = theirs.joints.front();
    share_out(0, ours.top, 0, theirs.top);
    if (theirs.joints.size() - 1 > theirs.top)
        share_out(ours.top, ours.joints.size() - 1, theirs.top, theirs.joints.size() - 1);
}

void RetargetTurns::turn(std::span<const Transform> locals, std::span<const Transform> models,
                         std::span<Quat> result) const {
    for (int j = 0; j < skeleton_->joint_count(); ++j) {
        const Follow& follow = follow_[at(j)];
        if (follow.kind == Follow::Kind::turn) {
            Quat turn = source_turn(follow.from, models);
            if (follow.share > 0) turn = slerp(turn, source_turn(follow.to, models), follow.share);
            result[at(j)] = normalized(turn * target_stance_[at(j)]);
            continue;
        }
        Quat local = follow.rest;
        if (follow.kind == Follow::Kind::local)
            local = local * conjugate(follow.source_rest) * locals[at(follow.from)].rotation;
        const int parent = skeleton_->parents[at(j)];
        result[at(j)] = normalized(parent == k_no_joint ? local : result[at(parent)] * local);
    }
}

}  // namespace surefoot
