#include <surefoot/crowd/kernels.h>

#include <surefoot/base/random.h>

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace surefoot {
namespace {

using Builds = KernelBuilds<GroundKernels>;

/// Feet that stand, swing, are new, are dragged and find no ground, side by side.
GroundLanes laid(const GroundKernels& kernels, std::uint64_t seed) {
    Random random(seed);
    GroundLanes lanes{};
    const auto fill = [&](auto& rows, float size) {
        for (auto& row : rows)
            for (float& x : row) x = random.between(-size, size);
    };
    fill(lanes.root, 5);
    fill(lanes.heel, 0.1f);
    fill(lanes.ball, 0.1f);
    fill(lanes.now, 1);
    fill(lanes.next, 1);
    fill(lanes.foot, 3);
    fill(lanes.normal, 1);
    for (int lane = 0; lane < k_ground_lanes; ++lane) {
        lanes.yaw[lane] = random.between(-9, 9);
        lanes.share[lane] = random.unit();
        lanes.stance[lane] = random.between(0.4f, 0.8f);
        lanes.is_stepping[lane] = random.below(4) != 0;
        lanes.is_new[lane] = random.below(4) == 0;
        lanes.is_hit[lane] = random.below(4) != 0;
        lanes.height[lane] = random.between(-1, 1);
    }
    kernels.ask(lanes);
    kernels.lay(lanes, 0.7f);
    return lanes;
}

TEST(GroundKernels, every_build_lays_feet_to_the_scalar_twins_bits) {
    for (std::uint64_t seed = 1; seed < 40; ++seed) {
        const GroundLanes wanted = laid(Builds::scalar, seed);
        for (const GroundKernels* kernels : Builds::here()) {
            const GroundLanes got = laid(*kernels, seed);
            EXPECT_EQ(std::memcmp(&got, &wanted, sizeof got), 0) << kernels->name;
        }
    }
}

}  // namespace
}  // namespace surefoot
