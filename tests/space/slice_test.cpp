#include <surefoot/base/random.h>
#include <surefoot/space/slice.h>
#include <surefoot/space/triangulate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot {
namespace {

BlendSpace random_space(Random& random, int d, int count) {
    BlendSpace space;
    for (int k = 0; k < d; ++k) space.axes.push_back({"axis", "", -1.0f - k, 1.0f + k, false});
    for (int i = 0; i < count; ++i) {
        SpacePoint& p = space.samples.emplace_back();
        for (int k = 0; k < d; ++k) p[k] = random.between(-1.0f - k, 1.0f + k);
    }
    triangulate(space);
    return space;
}

double area_of(const SliceCell& cell) {
    double twice = 0;
    for (std::size_t i = 0; i < cell.polygon.size(); ++i) {
        const PlanePoint &p = cell.polygon[i], &q = cell.polygon[(i + 1) % cell.polygon.size()];
        twice += p[0] * q[1] - q[0] * p[1];
    }
    return 0.5 * twice;
}

/// Smallest distance, with sign, of a point to the edges of a convex counter-clockwise polygon: > 0 inside.
double depth_in(const SliceCell& cell, const PlanePoint& x) {
    double least = 1e300;
    for (std::size_t i = 0; i < cell.polygon.size(); ++i) {
        const PlanePoint &p = cell.polygon[i], &q = cell.polygon[(i + 1) % cell.polygon.size()];
        const double dx = q[0] - p[0], dy = q[1] - p[1];
        least = std::min(least, (dx * (x[1] - p[1]) - dy * (x[0] - p[0])) / std::sqrt(dx * dx + dy * dy));
    }
    return least;
}

TEST(slice, a_plane_space_is_its_own_slice) {
    Random random(1);
    const BlendSpace space = random_space(random, 2, 14);
    const SpaceSlice cut = slice(space, {0.1f, 0.2f}, 0, 1);
    ASSERT_EQ(cut.cells.size(), space.simplices.size());
    for (std::size_t c = 0; c < cut.cells.size(); ++c) {
        EXPECT_EQ(cut.cells[c].simplex, static_cast<std::int32_t>(c));
        ASSERT_EQ(cut.cells[c].polygon.size(), 3u);
        for (int k = 0; k < 3; ++k) {
            const SpacePoint& corner = space.samples[space.simplices[c][k]];
            double nearest = 1e9;
            for (const PlanePoint& p : cut.cells[c].polygon)
                nearest = std::min(nearest, std::hypot(p[0] - corner[0], p[1] - corner[1]));
            EXPECT_LT(nearest, 1e-5);
        }
    }
}

TEST(slice, every_point_of_the_plane_lies_in_the_cell_of_the_simplex_that_the_lookup_finds) {
    for (int d = 2; d <= 4; ++d) {
        Random random(20 + d);
        int inside = 0;
        for (int round = 0; round < 12; ++round) {
            const BlendSpace space = random_space(random, d, 16);
            SpacePoint at{};
            for (int k = 0; k < d; ++k) at[k] = random.between(-0.4f, 0.4f);
            const int right = static_cast<int>(random.below(static_cast<std::uint32_t>(d)));
            const int up = (right + 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(d) - 1))) % d;
            const SpaceSlice cut = slice(space, at, right, up);
            for (const SliceCell& cell : cut.cells) ASSERT_GT(area_of(cell), 0);
            for (int n = 0; n < 100; ++n) {
                SpacePoint p = at;
                p[right] = random.between(-1.2f - right, 1.2f + right);
                p[up] = random.between(-1.2f - up, 1.2f + up);
                const BlendWeights found = blend_weights(space, p);
                int holding = 0, strictly = 0;
                bool right_one = false;
                for (const SliceCell& cell : cut.cells) {
                    const double depth = depth_in(cell, {p[right], p[up]});
                    holding += depth > -1e-6;
                    strictly += depth > 1e-6;
                    right_one |= depth > -1e-6 && cell.simplex == found.simplex;
                }
                EXPECT_LE(strictly, 1);  // cells do not overlap
                EXPECT_EQ(strictly > 0 && found.clamped, false);
                if (found.clamped) continue;
                ++inside;
                EXPECT_GE(holding, 1) << d;
                EXPECT_TRUE(right_one) << d;
            }
        }
        EXPECT_GT(inside, 100) << d;
    }
}

TEST(slice, the_live_cell_and_weights_are_those_of_the_point) {
    for (int d = 2; d <= 4; ++d) {
        Random random(40 + d);
        const BlendSpace space = random_space(random, d, 18);
        const SpacePoint at{0.1f, -0.2f, d > 2 ? 0.15f : 0.0f, d > 3 ? 0.3f : 0.0f};
        std::set<std::int32_t> live;
        for (int right = 0; right < d; ++right)
            for (int up = 0; up < d; ++up) {
                if (right == up) continue;
                const SpaceSlice cut = slice(space, at, right, up);
                ASSERT_GE(cut.live_cell, 0);
                EXPECT_EQ(cut.cells[cut.live_cell].simplex, cut.live.simplex);
                EXPECT_GT(depth_in(cut.cells[cut.live_cell], {at[right], at[up]}), -1e-6);
                EXPECT_EQ(cut.live.weights, blend_weights(space, at).weights);
                live.insert(cut.live.simplex);
            }
        EXPECT_EQ(live.size(), 1u);  // whatever plane one looks at, the same simplex plays
    }
}

TEST(slice, a_point_on_a_face_has_a_live_cell_in_every_plane) {
    BlendSpace space;
    for (int k = 0; k < 3; ++k) space.axes.push_back({"axis", "", 0, 2, false});
    for (int i = 0; i < 27; ++i)
        space.samples.push_back({static_cast<float>(i % 3), static_cast<float>(i / 3 % 3), static_cast<float>(i / 9)});
    triangulate(space);
    for (const SpacePoint& at : {SpacePoint{1, 1, 1}, SpacePoint{1, 0.4f, 0.7f}, SpacePoint{0.5f, 0.5f, 1}})
        for (int right = 0; right < 3; ++right)
            for (int up = 0; up < 3; ++up)
                if (right != up) {
                    EXPECT_GE(slice(space, at, right, up).live_cell, 0) << right << up;
                }
}

TEST(slice, a_plane_beside_the_hull_cuts_nothing_and_still_says_what_plays) {
    Random random(9);
    const BlendSpace space = random_space(random, 4, 12);
    const SpaceSlice cut = slice(space, {0, 0, 90, 90}, 0, 1);
    EXPECT_TRUE(cut.cells.empty());
    EXPECT_EQ(cut.live_cell, -1);
    EXPECT_TRUE(cut.live.clamped);
    EXPECT_GT(cut.live.count, 0);
}

TEST(slice, samples_on_a_line_have_no_cells) {
    Random random(2);
    BlendSpace space = random_space(random, 3, 0);
    space.samples = {{-1, -1, -1}, {0, 0, 0}, {1, 1, 1}};
    triangulate(space);
    const SpaceSlice cut = slice(space, {0.2f, 0.2f, 0.2f}, 0, 2);
    EXPECT_TRUE(cut.cells.empty());
    EXPECT_EQ(cut.live.count, 2);
}

}  // namespace
}  // namespace surefoot
