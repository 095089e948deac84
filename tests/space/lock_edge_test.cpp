#include <surefoot/base/random.h>
#include <surefoot/space/lock_edge.h>
#include <surefoot/space/predicates.h>
#include <surefoot/space/triangulate.h>

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(lock_edge, with_a_wrapping_axis_edges_are_found_across_the_seam_but_none_is_forced) {
    Random random(8);
    int there = 0, refused = 0;
    for (int round = 0; round < 60; ++round) {
        BlendSpace space;
        space.axes = {{"heading", "deg", -180, 180, true}, {"speed", "m/s", 0, 1, false}};
        for (int i = 0; i < 8; ++i) space.samples.push_back({random.between(-180, 180), random.unit()});
        space.samples[0][0] = -175;
        space.samples[1][0] = 175;
        add_wrap_copies(space);
        triangulate(space);
        const BlendSpace before = space;
        (lock_edge(space, 0, 1) ? there : refused) += 1;
        EXPECT_EQ(space.simplices, before.simplices);
    }
    EXPECT_GT(there, 20);
    EXPECT_GT(refused, 3);
}

TEST(lock_simplex, a_triangle_is_drawn_with_all_its_edges_or_not_at_all) {
    Random random(4);
    int drawn = 0, refused = 0, there = 0;
    for (int round = 0; round < 300; ++round) {
        BlendSpace space = random_plane(random, 8);
        const BlendSpace before = space;
        std::array<std::int32_t, 3> corners{};
        for (std::int32_t& c : corners) c = static_cast<std::int32_t>(random.below(8));
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2]) {
            EXPECT_FALSE(lock_simplex(space, corners));
            continue;
        }
        const bool had = has_simplex(space, corners);
        if (lock_simplex(space, corners)) {
            (had ? there : drawn) += 1;
            EXPECT_TRUE(has_simplex(space, corners));
            EXPECT_EQ(problem(space), "");
            EXPECT_TRUE(total_area(space) == total_area(before));
        } else {
            ++refused;
            EXPECT_FALSE(had);
            EXPECT_EQ(space.simplices, before.simplices);
        }
    }
    EXPECT_GT(drawn, 20);
    EXPECT_GT(refused, 20);
    EXPECT_GT(there, 20);
}

TEST(lock_simplex, in_three_and_four_dimensions_it_says_whether_the_simplex_is_there) {
    Random random(6);
    for (const int d : {3, 4}) {
        BlendSpace space;
        for (int k = 0; k < d; ++k) space.axes.push_back({"axis", "", 0, 1, false});
        for (int i = 0; i < 12; ++i) {
            SpacePoint& p = space.samples.emplace_back();
            for (int k = 0; k < d; ++k) p[k] = random.unit();
        }
        triangulate(space);
        const auto n = static_cast<std::size_t>(d) + 1;
        std::vector<std::int32_t> corners(space.simplices[3].begin(), space.simplices[3].begin() + d + 1);
        std::reverse(corners.begin(), corners.end());
        EXPECT_TRUE(lock_simplex(space, corners));
        EXPECT_FALSE(lock_simplex(space, std::span(corners).first(n - 1)));
        int missing = 0;
        for (std::int32_t other = 0; other < 12; ++other) {
            if (std::find(corners.begin(), corners.end(), other) != corners.end()) continue;
            auto changed = corners;
            changed[0] = other;
            missing += !lock_simplex(space, changed);
        }
        EXPECT_GT(missing, 3);
    }
}

}  // namespace
}  // namespace surefoot
