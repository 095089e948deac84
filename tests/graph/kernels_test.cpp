#include <surefoot/graph/kernels.h>

#include <surefoot/base/random.h>
#include <surefoot/graph/foot_lanes.h>
#include <surefoot/ik/two_bone.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace surefoot {
namespace {

using Builds = KernelBuilds<FootKernels>;

Quat rotation(Random& random) {
    return normalized(Quat{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
}

struct Feet {
    static constexpr int k_leaves = 5;
    std::vector<FootKey> keys;
    FootLeafLanes leaves[k_leaves];
    FootLanes feet{};

    explicit Feet(std::uint64_t seed) {
        Random random(seed);
        const auto vec = [&](float size) {
            return Vec3{random.between(-size, size), random.between(-size, size), random.between(-size, size)};
        };
        for (int i = 0; i < 2 * k_leaves * k_foot_lanes; ++i)
            keys.push_back({{rotation(random), vec(1)}, rotation(random), random.between(-1, 1)});
        const FootKey* next = keys.data();
        for (int i = 0; i < k_leaves; ++i)
            for (int lane = 0; lane < k_foot_lanes; ++lane) {
                FootLeafLanes& leaf = leaves[i];
                leaf.from[lane] = &next++->print.rotation.x;
                leaf.to[lane] = &next++->print.rotation.x;
                leaf.share[lane] = random.unit();
                leaf.weight[lane] = i == 4 ? -0.1f : random.unit();
                leaf.stepping[lane] = lane % 3 == 0 ? leaf.weight[lane] : 0;
                leaf.say[lane] = random.unit();
            }
        for (int lane = 0; lane < k_foot_lanes; ++lane) {
            for (int k = 0; k < 3; ++k) {
                feet.heel[k][lane] = random.between(-0.1f, 0.1f);
                feet.ball[k][lane] = random.between(-0.1f, 0.1f);
                feet.velocity[k][lane] = random.between(-3, 3);
            }
            feet.turn[lane] = lane % 2 == 0 ? 0 : random.between(-3, 3);
            feet.pace[lane] = random.between(0.3f, 3);
            feet.ahead[lane] = lane % 2 == 0 ? 0 : random.unit();
        }
    }
};

TEST(FootKernels, every_build_finds_feet_to_the_scalar_twins_bits) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        Feet wanted(seed);
        Builds::scalar.mean_feet(wanted.leaves, Feet::k_leaves, wanted.feet);
        for (const FootKernels* kernels : Builds::here()) {
            Feet got(seed);
            kernels->mean_feet(got.leaves, Feet::k_leaves, got.feet);
            EXPECT_EQ(std::memcmp(&got.feet, &wanted.feet, sizeof got.feet), 0) << kernels->name;
        }
    }
}

/// Four poses of a skeleton whose legs are not made alike: the left one has a twist joint, the last joint is a foot.
struct Poses {
    static constexpr int k_joints = 9;
    LegPaths paths;
    std::vector<Transform> poses;
    std::vector<std::array<FootGoal, 2>> goals;

    explicit Poses(std::uint64_t seed) {
        paths.count = k_joints;
        constexpr std::int16_t parents[k_joints] = {-1, 0, 1, 2, 3, 4, 1, 6, 7};
        for (int i = 0; i < k_joints; ++i) {
            paths.joint[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(i);
            paths.parent[static_cast<std::size_t>(i)] = parents[i];
        }
        paths.side[0] = {1, 2, 3, 4, 4, 5, k_no_joint, {0, 0, 1}, {0, -0.1f, -0.1f}, {0, -0.1f, 0.1f}};
        paths.side[1] = {1, 6, 6, 7, 7, 8, k_no_joint, {0, 0, 1}, {0, -0.1f, -0.1f}, {0, -0.1f, 0.1f}};
        Random random(seed);
        for (int pose = 0; pose < LegLanes::k_poses; ++pose) {
            const bool straight = pose == 3;
            for (int j = 0; j < k_joints; ++j)
                poses.push_back({straight ? Quat{} : rotation(random), {0, j < 2 ? 0.5f : -0.4f, 0.05f}});
            std::array<FootGoal, 2> feet;
            for (FootGoal& foot : feet)
                foot = {{rotation(random), {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}}, {}};
            goals.push_back(feet);
        }
    }
    std::span<Transform> pose(int i) {
        return std::span(poses).subspan(static_cast<std::size_t>(i) * k_joints, k_joints);
    }
};

std::vector<Transform> reached(const FootKernels& kernels, std::uint64_t seed) {
    Poses p(seed);
    const LegChains chains = make_leg_chains(p.paths);
    LegGoalLanes goals;
    float* locals[k_foot_lanes];
    std::vector<float> models(k_leg_joints * k_model_floats);
    for (int lane = 0; lane < k_foot_lanes; ++lane) {
        const FootGoal& goal = p.goals[static_cast<std::size_t>(lane / 2)][static_cast<std::size_t>(lane % 2)];
        locals[lane] = &p.pose(lane / 2)[0].rotation.x;
        for (int k = 0; k < 7; ++k) goals.foot[k][lane] = (&goal.foot.rotation.x)[k];
        for (int k = 0; k < 4; ++k) goals.toes[k][lane] = (&goal.toes.x)[k];
    }
    kernels.run_forward(chains, locals, Poses::k_joints, models.data());
    float sinks[k_foot_lanes];
    kernels.sink(chains, models.data(), goals, 0.99f, sinks);
    for (int lane = 0; lane < k_foot_lanes; ++lane) goals.foot[5][lane] += sinks[lane];
    kernels.reach(chains, models.data(), goals, locals);
    return p.poses;
}

TEST(FootKernels, every_build_reaches_to_the_scalar_twins_bits) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        const std::vector<Transform> wanted = reached(Builds::scalar, seed);
        for (const FootKernels* kernels : Builds::here()) {
            const std::vector<Transform> got = reached(*kernels, seed);
            EXPECT_EQ(std::memcmp(got.data(), wanted.data(), got.size() * sizeof(Transform)), 0) << kernels->name;
        }
    }
}

TEST(LegLanes, take_both_feet_there_though_the_legs_are_not_made_alike) {
    for (int count = 1; count <= LegLanes::k_poses; ++count) {
        Poses p(7), alone(7);
        const LegChains chains = make_leg_chains(p.paths);
        LegLanes legs(chains);
        for (int i = 0; i < count; ++i) legs.set_goals(legs.add(p.pose(i)), p.goals[static_cast<std::size_t>(i)]);
        legs.run_forward();
        legs.reach();
        for (int i = 0; i < count; ++i) {
            const auto& goals = p.goals[static_cast<std::size_t>(i)];
            reach_feet(p.paths, goals, alone.pose(i));
            EXPECT_EQ(std::memcmp(p.pose(i).data(), alone.pose(i).data(), p.pose(i).size_bytes()), 0);
            std::vector<Transform> models(Poses::k_joints);
            for (std::size_t j = 0; j < models.size(); ++j)
                models[j] = p.paths.parent[j] < 0 ? p.pose(i)[j]
                                                  : models[static_cast<std::size_t>(p.paths.parent[j])] * p.pose(i)[j];
            for (std::size_t side = 0; side < 2; ++side) {
                const Transform foot = models[side == 0 ? 5 : 8], hip = models[side == 0 ? 2 : 6];
                const Vec3 wanted = goals[side].foot.translation;
                const float shorter = distance(hip.translation, wanted) - distance(hip.translation, foot.translation);
                EXPECT_NEAR(distance(foot.translation, wanted), std::fabs(shorter), 1e-4f) << "on the way there";
                EXPECT_NEAR(std::fabs(dot(foot.rotation, goals[side].foot.rotation)), 1, 1e-5f);
            }
        }
    }
}

}  // namespace
}  // namespace surefoot
