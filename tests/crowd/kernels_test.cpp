#include <surefoot/crowd/kernels.h>

#include <surefoot/base/random.h>
#include <surefoot/math/processor.h>

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace surefoot {
namespace {

/// Every build of the kernels that this machine can run.
std::vector<const GroundKernels*> builds() {
    std::vector<const GroundKernels*> list{&k_baseline_ground_kernels};
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
    if (processor_level() >= ProcessorLevel::v3) list.push_back(&k_v3_ground_kernels);
    if (processor_level() >= ProcessorLevel::v4) list.push_back(&k_v4_ground_kernels);
#endif
    return list;
}

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
        const GroundLanes wanted = laid(k_scalar_ground_kernels, seed);
        for (const GroundKernels* kernels : builds()) {
            const GroundLanes got = laid(*kernels, seed);
            EXPECT_EQ(std::memcmp(&got, &wanted, sizeof got), 0) << kernels->name;
        }
    }
}

}  // namespace
}  // namespace surefoot
