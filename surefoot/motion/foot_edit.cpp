#include <surefoot/ik/two_bone.h>
#include <surefoot/motion/foot_edit.h>

#include <algorithm>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<Stance> stances_of(const std::vector<char>& down, const Motion& motion) {
    std::vector<Stance> stances;
    const int frames = motion.frame_count();
    const bool cyclic = motion.cyclic;
    const int last = frames - 1;
    if (static_cast<int>(down.size()) < frames) return stances;
    const auto stands = [&](int f) { return down[at(cyclic ? ((f % last) + last) % last : f)] != 0; };
    int from = 0;
    if (cyclic) {
        while (from < last && stands(from)) ++from;
        if (from == last) return stances;
    }
    const int to = cyclic ? from + last : frames;
    for (int f = from; f < to; ++f) {
        if (!stands(f)) continue;
        const int first = f;
        while (f + 1 < to && stands(f + 1)) ++f;
        stances.push_back({static_cast<double>(first), static_cast<double>(f)});
    }
    if (!cyclic || stances.empty()) return stances;
    std::vector<Stance> all;
    for (const double shift : {-2.0, -1.0, 0.0, 1.0})
        for (const Stance& s : stances) all.push_back({s.first + shift * last, s.last + shift * last});
    return all;
}

LegJoints leg_joints(const RoleMap& roles, std::size_t side) {
    if (side == 0) return {roles[Role::left_upper_leg], roles[Role::left_lower_leg], roles[Role::left_foot]};
    return {roles[Role::right_upper_leg], roles[Role::right_lower_leg], roles[Role::right_foot]};
}

float move_foot(const Skeleton& skeleton, const LegJoints& leg, const RootFrame& change, std::span<Transform> locals) {
    std::vector<Transform> models(locals.size());
    local_to_model(skeleton, locals, models);
    const auto parent_rotation = [&](int joint) {
        const int parent = skeleton.parents[at(joint)];
        return parent == k_no_joint ? Quat{} : models[at(parent)].rotation;
    };
    const Transform upper = models[at(leg.upper)], lower = models[at(leg.lower)], foot = models[at(leg.foot)];
    const Quat in_hip = from_yaw(change.yaw);
    TwoBone bones;
    bones.hip = upper.translation;
    bones.knee = bones.hip + rotate(in_hip, lower.translation - bones.hip);
    bones.ankle = bones.hip + rotate(in_hip, foot.translation - bones.hip);
    bones.target = transform_point(to_transform(change), foot.translation);
    bones.knee_forward = rotate(in_hip, {0, 0, 1});
    const TwoBoneResult solved = solve_two_bone(bones);
    // Each joint's new local rotation, seen from its parent, whose own rotation has changed like the bone above it.
    const Quat turn_upper = solved.upper * in_hip, turn_lower = solved.lower * in_hip;
    const auto set = [&](int joint, Quat parent_turn, Quat turn, Quat model) {
        locals[at(joint)].rotation = normalized(conjugate(parent_turn * parent_rotation(joint)) * turn * model);
    };
    set(leg.upper, {}, turn_upper, upper.rotation);
    set(leg.lower, turn_upper, turn_lower, lower.rotation);
    set(leg.foot, turn_lower, in_hip, foot.rotation);
    return distance(solved.ankle, bones.target);
}

void join_ends(Motion& motion) {
    if (!motion.cyclic || motion.frame_count() < 2) return;
    const auto first = motion.frame(0), last = motion.frame(motion.frame_count() - 1);
    std::copy(first.begin(), first.end(), last.begin());
}

}  // namespace surefoot
