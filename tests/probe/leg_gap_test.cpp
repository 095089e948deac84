#include <surefoot/base/random.h>
#include <surefoot/probe/leg_gap.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(leg_gap, distances_of_segments_are_those_known_by_hand) {
    const Vec3 o{0, 0, 0}, x{1, 0, 0};
    EXPECT_FLOAT_EQ(segment_distance(o, x, {0, 1, 0}, {1, 1, 0}), 1) << "parallel";
    EXPECT_FLOAT_EQ(segment_distance(o, x, {0.5f, 1, -1}, {0.5f, 1, 1}), 1) << "crossing";
    EXPECT_FLOAT_EQ(segment_distance(o, x, {0.5f, 0, -1}, {0.5f, 0, 1}), 0) << "meeting";
    EXPECT_FLOAT_EQ(segment_distance(o, x, {4, 4, 0}, {4, 8, 0}), 5) << "end to end";
    EXPECT_FLOAT_EQ(segment_distance(o, x, {3, 0, 0}, {5, 0, 0}), 2) << "in one line";
    EXPECT_FLOAT_EQ(segment_distance(o, o, {3, 4, 0}, {3, 4, 0}), 5) << "points";
    EXPECT_FLOAT_EQ(segment_distance(o, o, {-1, 2, 0}, {1, 2, 0}), 2) << "a point and a segment";
    EXPECT_FLOAT_EQ(segment_distance({-1, 2, 0}, {1, 2, 0}, o, o), 2);
}

TEST(leg_gap, no_pair_of_points_is_nearer_than_the_distance_of_random_segments) {
    Random random(7);
    const auto point = [&] { return Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}; };
    for (int i = 0; i < 200; ++i) {
        const Vec3 a0 = point(), a1 = point(), b0 = point(), b1 = point();
        const float found = segment_distance(a0, a1, b0, b1);
        float least = 1e9f;
        constexpr int k_steps = 100;
        for (int s = 0; s <= k_steps; ++s)
            for (int t = 0; t <= k_steps; ++t)
                least = std::min(least, distance(a0 + (a1 - a0) * (static_cast<float>(s) / k_steps),
                                                 b0 + (b1 - b0) * (static_cast<float>(t) / k_steps)));
        EXPECT_LE(found, least + 1e-5f);
        EXPECT_GE(found, least - 0.03f) << "the samples are that far apart";
    }
}

TEST(leg_gap, crossed_shanks_read_negative_and_feet_side_by_side_their_distance) {
    WalkTrack track;
    TrackFrame frame;
    for (std::size_t side = 0; side < 2; ++side) {
        const float x = side == 0 ? 0.1f : -0.1f;
        LegTrack& leg = frame.legs[side];
        leg.hip = {x, 0.95f, 0}, leg.knee = {x, 0.5f, 0}, leg.ankle = {x, 0.08f, 0};
        leg.sole = {Vec3{x, 0, -0.06f}, {x, 0, 0.03f}, {x, 0, 0.12f}, {x, 0, 0.2f}};
    }
    track.frames = {frame, frame};
    EXPECT_NEAR(smallest_leg_gap(track, {0, 2}, 0.9f), 0.12f, 1e-4f) << "20 cm apart, 4 cm of radius each";
    std::swap(track.frames[1].legs[0].ankle.x, track.frames[1].legs[1].ankle.x);
    EXPECT_NEAR(smallest_leg_gap(track, {0, 2}, 0.9f), -0.08f, 1e-4f) << "axes that meet are two radii deep";
    EXPECT_NEAR(smallest_leg_gap(track, {0, 1}, 0.9f), 0.12f, 1e-4f) << "only the frames asked for count";
}

}  // namespace
}  // namespace surefoot
