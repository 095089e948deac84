#include <surefoot/graph/foot_lanes.h>
#include <surefoot/ik/foot_placement.h>

#include <algorithm>

namespace surefoot {
namespace {

int parent_of(const LegPaths& paths, int slot) noexcept { return paths.parent[static_cast<std::size_t>(slot)]; }

/// Parents come first, so that this ends.
bool is_above(const LegPaths& paths, int above, int slot) noexcept {
    while (slot > above) slot = parent_of(paths, slot);
    return slot == above;
}

/// The joints from a slot's to `last`, without the one of `above`; returns how many.
int joints_between(const LegPaths& paths, int above, int last, std::int16_t (&joints)[LegPaths::k_most]) noexcept {
    int count = 0;
    for (int slot = last; slot != above; slot = parent_of(paths, slot))
        joints[count++] = paths.joint[static_cast<std::size_t>(slot)];
    std::reverse(joints, joints + count);
    return count;
}

}  // namespace

LegPaths make_leg_paths(const Skeleton& skeleton, const Legs& legs, std::span<const Transform> standing) {
    LegPaths paths;
    std::vector<int> slot(skeleton.parents.size(), -1);
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        if (!is_within(skeleton, legs.side[0].foot, j) && !is_within(skeleton, legs.side[1].foot, j)) continue;
        if (paths.count == LegPaths::k_most) return {};
        const auto at = static_cast<std::size_t>(paths.count);
        const int parent = skeleton.parents[static_cast<std::size_t>(j)];
        paths.joint[at] = static_cast<std::int16_t>(j);
        paths.parent[at] = static_cast<std::int16_t>(parent < 0 ? -1 : slot[static_cast<std::size_t>(parent)]);
        slot[static_cast<std::size_t>(j)] = paths.count++;
    }
    const auto slot_of = [&](int joint) { return joint < 0 ? -1 : slot[static_cast<std::size_t>(joint)]; };
    const auto parent_of = [&](int joint) { return slot_of(skeleton.parents[static_cast<std::size_t>(joint)]); };
    for (std::size_t s = 0; s < 2; ++s) {
        const Leg& leg = legs.side[s];
        paths.side[s] = {parent_of(leg.upper),
                         slot_of(leg.upper),
                         parent_of(leg.lower),
                         slot_of(leg.lower),
                         parent_of(leg.foot),
                         slot_of(leg.foot),
                         leg.toes,
                         knee_forward(leg, standing),
                         leg.heel,
                         leg.ball};
    }
    return paths;
}

std::string problem(const LegPaths& paths, const Skeleton& skeleton) {
    if (paths.count == 0) return {};
    if (paths.count < 0 || paths.count > LegPaths::k_most) return "the paths of the legs have a wrong number of joints";
    const auto in = [](int value, int least, int end) { return value >= least && value < end; };
    for (int i = 0; i < paths.count; ++i) {
        const auto slot = static_cast<std::size_t>(i);
        if (!in(paths.joint[slot], 0, skeleton.joint_count()) || !in(paths.parent[slot], -1, i))
            return "the paths of the legs name a joint that is not there";
    }
    for (const LegPaths::Side& leg : paths.side) {
        for (const int slot : {leg.upper, leg.lower, leg.foot})
            if (!in(slot, 0, paths.count)) return "a leg is not among the paths of the legs";
        if (leg.upper_parent != parent_of(paths, leg.upper) || leg.lower_parent != parent_of(paths, leg.lower) ||
            leg.foot_parent != parent_of(paths, leg.foot))
            return "a leg hangs on nothing";
        if (!is_above(paths, leg.upper, leg.lower) || !is_above(paths, leg.lower, leg.foot))
            return "the joints of a leg do not follow one another";
        if (!in(leg.toes, k_no_joint, skeleton.joint_count())) return "the toes are no joint";
        for (const Vec3 v : {leg.knee_forward, leg.heel, leg.ball})
            if (!is_finite(v)) return "a knee or sole has no finite place";
    }
    return {};
}

LegChains make_leg_chains(const LegPaths& paths) noexcept {
    LegChains chains;
    if (paths.count == 0) return chains;
    const auto append = [&](const std::array<int, 2>& above, const std::array<int, 2>& last) noexcept {
        std::int16_t joints[2][LegPaths::k_most];
        int count[2];
        for (std::size_t side = 0; side < 2; ++side)
            count[side] = joints_between(paths, above[side], last[side], joints[side]);
        const int most = std::max(count[0], count[1]);
        for (std::size_t side = 0; side < 2; ++side)
            for (int i = 0; i < most; ++i) {
                const int own = i - (most - count[side]);  // what does nothing goes first
                chains.joint[side][chains.count + i] = own < 0 ? std::int16_t{-1} : joints[side][own];
            }
        chains.count += most;
    };
    const std::array<LegPaths::Side, 2>& leg = paths.side;
    append({-1, -1}, {leg[0].upper_parent, leg[1].upper_parent});
    chains.upper = chains.count;
    append({leg[0].upper_parent, leg[1].upper_parent}, {leg[0].upper, leg[1].upper});
    append({leg[0].upper, leg[1].upper}, {leg[0].lower_parent, leg[1].lower_parent});
    chains.lower = chains.count;
    append({leg[0].lower_parent, leg[1].lower_parent}, {leg[0].lower, leg[1].lower});
    append({leg[0].lower, leg[1].lower}, {leg[0].foot_parent, leg[1].foot_parent});
    append({leg[0].foot_parent, leg[1].foot_parent}, {leg[0].foot, leg[1].foot});
    for (std::size_t side = 0; side < 2; ++side) {
        const Vec3 forward = leg[side].knee_forward;
        chains.toes[side] = static_cast<std::int16_t>(leg[side].toes);
        chains.knee_forward[0][side] = forward.x;
        chains.knee_forward[1][side] = forward.y;
        chains.knee_forward[2][side] = forward.z;
    }
    return chains;
}

}  // namespace surefoot
