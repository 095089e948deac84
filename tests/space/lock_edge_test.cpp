#include <surefoot/base/random.h>
#include <surefoot/space/lock_edge.h>
#include <surefoot/space/predicates.h>
#include <surefoot/space/triangulate.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

BlendSpace random_plane(Random& random, int count) {
    BlendSpace space;
    space.axes = {{"x", "", 0, 1, false}, {"y", "", 0, 1, false}};
    for (int i = 0; i < count; ++i) space.samples.push_back({random.unit(), random.unit()});
    triangulate(space);
    return space;
}

Wide total_area(const BlendSpace& space) {
    Wide sum = 0;
    for (const Simplex& simplex : space.simplices) {
        LatticePoint corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = to_lattice(space.axes, space.samples[simplex[k]]);
        const Wide area = orientation(2, corners);
        EXPECT_GT(area, 0);
        sum += area;
    }
    return sum;
}

TEST(lock_edge, any_two_samples_of_a_plane_space_can_be_joined) {
    Random random(3);
    int flipped = 0;
    for (int round = 0; round < 300; ++round) {
        BlendSpace space = random_plane(random, 14);
        const Wide area = total_area(space);
        const auto a = static_cast<std::int32_t>(random.below(14)), b = static_cast<std::int32_t>(random.below(14));
        if (a == b) continue;
        flipped += !has_edge(space, a, b);
        ASSERT_TRUE(lock_edge(space, a, b));
        ASSERT_TRUE(has_edge(space, a, b));
        ASSERT_EQ(problem(space), "");
        ASSERT_TRUE(total_area(space) == area);
    }
    EXPECT_GT(flipped, 100);
}

TEST(lock_edge, an_edge_locked_earlier_is_not_crossed) {
    BlendSpace space;
    space.axes = {{"x", "", 0, 1, false}, {"y", "", 0, 1, false}};
    space.samples = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    triangulate(space);
    const std::array<std::int32_t, 2> first[] = {{0, 2}};
    ASSERT_TRUE(lock_edge(space, 0, 2));
    EXPECT_FALSE(lock_edge(space, 1, 3, first));
    EXPECT_TRUE(has_edge(space, 0, 2));
    EXPECT_TRUE(lock_edge(space, 1, 3));
}

TEST(lock_edge, an_edge_through_a_third_sample_is_refused) {
    BlendSpace space;
    space.axes = {{"x", "", 0, 1, false}, {"y", "", 0, 1, false}};
    space.samples = {{0, 0}, {0.5f, 0.5f}, {1, 1}, {0, 1}, {1, 0}};
    triangulate(space);
    EXPECT_FALSE(lock_edge(space, 0, 2));
    EXPECT_FALSE(lock_edge(space, 0, 9));
}

}  // namespace
}  // namespace surefoot
