#include <surefoot/course/metrics.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

constexpr int k_frames = 241;
constexpr float k_fps = 60;

/// A figure that steps on the spot: each foot stands for a second, then swings up to 20 cm high for a second.
WalkTrack stepping() {
    WalkTrack track;
    track.fps = k_fps;
    for (int f = 0; f < k_frames; ++f) {
        const float t = static_cast<float>(f) / k_fps;
        TrackFrame frame;
        frame.hips = {0, 0.9f + 0.02f * sin(6.0f * t), 0};
        for (std::size_t side = 0; side < 2; ++side) {
            const float x = side ? -0.1f : 0.1f, in_cycle = t + (side ? 1.0f : 0.0f);
            const float share = in_cycle - 2 * std::floor(in_cycle / 2);
            const float s = share > 1 ? sin(static_cast<float>(k_pi) * (share - 1)) : 0;
            const Vec3 up{0, 0.2f * s * s, 0};
            LegTrack& leg = frame.legs[side];
            leg.hip = {x, 0.9f, 0};
            leg.knee = {x, 0.5f, 0.1f};
            leg.ankle = Vec3{x, 0.08f, 0} + up;
            leg.sole = {Vec3{x, 0, -0.05f} + up, Vec3{x, 0, 0.04f} + up, Vec3{x, 0, 0.13f} + up, Vec3{x, 0, 0.2f} + up};
        }
        track.frames.push_back(frame);
    }
    return track;
}

/// The track moved by a function of time (seconds).
template <typename Move>
WalkTrack moved(WalkTrack track, const Move& move) {
    for (std::size_t f = 0; f < track.frames.size(); ++f) {
        const Vec3 by = move(static_cast<float>(f) / k_fps);
        for (LegTrack& leg : track.frames[f].legs) {
            leg.ankle += by;
            for (Vec3& p : leg.sole) p += by;
        }
    }
    return track;
}

const Plane k_flat;

TEST(Metrics, a_twin_measured_against_itself_is_clean) {
    const WalkTrack twin = stepping();
    const WalkMetrics m = measure_walk(twin, twin, k_flat, {});
    EXPECT_GT(m.planted_samples, 300);
    EXPECT_LT(m.skate_cm_s, 1e-3);
    EXPECT_EQ(m.skate_share, 0);
    EXPECT_EQ(m.penetration_max_cm, 0);
    EXPECT_NEAR(m.float_max_cm, 0, 1e-4);
    EXPECT_NEAR(m.sole_angle_worst_deg, 0, 1e-3);
    EXPECT_DOUBLE_EQ(m.knee_peak_ratio, 1);
    EXPECT_DOUBLE_EQ(m.hip_jerk_ratio, 1);
    EXPECT_EQ(m.over_extensions, 0);
}

TEST(Metrics, a_foot_sliding_at_10_cm_a_second_gives_10) {
    const WalkTrack twin = stepping();
    const WalkTrack sliding = moved(twin, [](float t) { return Vec3{0.06f * t, 0, 0.08f * t}; });
    const WalkMetrics m = measure_walk(sliding, twin, k_flat, {});
    EXPECT_NEAR(m.skate_cm_s, 10, 0.05);
    const WalkTrack faster = moved(twin, [](float t) { return Vec3{0, 0, 0.15f * t}; });
    EXPECT_EQ(measure_walk(faster, twin, k_flat, {}).skate_share, 1);
}

TEST(Metrics, a_foot_that_comes_off_a_slope_along_its_normal_does_not_skate_and_one_that_slides_along_it_does) {
    const float grade = tan(30 * k_radians_per_degree);
    const Plane slope(0, grade);
    GroundHit hit;
    const GroundQuery query{{}, 1, 1};
    slope.query({&query, 1}, {&hit, 1});
    WalkTrack twin = stepping();
    for (TrackFrame& frame : twin.frames) frame = twin.frames.front();
    const auto going = [&](Vec3 way) {
        return measure_walk(moved(twin, [&](float t) { return way * (0.1f * t); }), twin, slope, {});
    };
    const WalkMetrics off = going(hit.normal), along = going(normalized(cross(hit.normal, {1, 0, 0})));
    EXPECT_NEAR(off.skate_cm_s, 0, 0.05);
    EXPECT_NEAR(off.skate_level_cm_s, 5, 0.05);
    EXPECT_NEAR(along.skate_cm_s, 10, 0.05);
    EXPECT_NEAR(along.skate_level_cm_s, 8.66, 0.05);
}

TEST(Metrics, a_heel_just_over_an_edge_stands_with_its_foot_and_one_that_is_out_in_the_air_does_not) {
    const WalkTrack twin = stepping();  // heels at z = -0.05
    const auto over = [&](float edge) {
        const Stairs step(0.17f, 1, edge, 1);
        return measure_walk(moved(twin, [](float) { return Vec3{0, 0.17f, 0}; }), twin, step, {});
    };
    const WalkMetrics just = over(-0.04f), far = over(-0.02f);
    EXPECT_NEAR(just.sole_angle_worst_deg, 0, 0.01);
    EXPECT_NEAR(just.float_max_cm, 0, 0.01);
    EXPECT_GT(far.sole_angle_worst_deg, 30);
    EXPECT_NEAR(far.float_max_cm, 17, 0.1);
}

TEST(Metrics, a_heel_that_peels_off_as_in_the_clip_is_not_on_the_higher_tile_beside_it) {
    // Heels are 1.2 cm up, and 1 cm from a band 2.1 cm high.
    WalkTrack twin = stepping();
    for (TrackFrame& frame : twin.frames)
        for (LegTrack& leg : frame.legs) leg.sole[0].y += 0.012f;
    const Bands beside(0.021f, 0, {{-9, -0.06f}});
    const WalkMetrics m = measure_walk(twin, twin, beside, {});
    EXPECT_NEAR(m.sole_angle_worst_deg, 0, 1e-3);
    EXPECT_NEAR(m.float_max_cm, 0, 1e-3);
}

TEST(Metrics, a_heel_in_a_riser_and_a_hair_deep_in_its_tread_is_as_deep_as_the_riser_is_near) {
    const Stairs stairs(0.17f, 0.28f, 0, 3);
    EXPECT_NEAR(depth_in_ground(stairs, {0, 0.169f, 0.29f}), 0.01f, 2e-3f);
    EXPECT_NEAR(depth_in_ground(stairs, {0, 0.169f, 0.1f}), 0.001f, 1e-4f);
}

TEST(Metrics, weighted_skate_is_displacement_times_two_minus_two_to_the_height) {
    const WalkTrack twin = stepping();
    const WalkTrack low = moved(twin, [](float t) { return Vec3{0, 0, 0.12f * t}; });
    EXPECT_NEAR(measure_walk(low, twin, k_flat, {}).skate_weighted_cm, 0.2, 0.01);  // 12 cm/s at 60 Hz, on the ground
    const WalkTrack high = moved(twin, [](float t) { return Vec3{0, 0.025f, 0.12f * t}; });
    EXPECT_NEAR(measure_walk(high, twin, k_flat, {}).skate_weighted_cm, 0, 0.005);  // 2.5 cm up: no longer counted
}

TEST(Metrics, a_foot_2_cm_under_the_ground_gives_2_and_one_above_floats) {
    const WalkTrack twin = stepping();
    const WalkMetrics sunk = measure_walk(moved(twin, [](float) { return Vec3{0, -0.02f, 0}; }), twin, k_flat, {});
    EXPECT_NEAR(sunk.penetration_max_cm, 2, 0.01);
    EXPECT_GT(sunk.penetration_mean_cm, 0.9);  // half of the time each foot swings
    EXPECT_EQ(sunk.float_max_cm, 0);
    const WalkMetrics up = measure_walk(moved(twin, [](float) { return Vec3{0, 0.03f, 0}; }), twin, k_flat, {});
    EXPECT_NEAR(up.float_max_cm, 3, 0.01);
    EXPECT_NEAR(up.float_mean_cm, 3, 0.01);
    EXPECT_EQ(up.penetration_max_cm, 0);
}

TEST(Metrics, heel_and_ball_sink_apart_from_toe_tip_and_mid_sole) {
    const WalkTrack twin = stepping();
    const auto sink = [&](std::size_t point) {
        WalkTrack track = twin;
        for (TrackFrame& frame : track.frames) frame.legs[0].sole[point].y -= 0.03f;
        return measure_walk(track, twin, k_flat, {});
    };
    for (const std::size_t point : {std::size_t{0}, std::size_t{2}}) {
        EXPECT_NEAR(sink(point).penetration_heel_ball_cm, 3, 0.01) << point;
        EXPECT_LT(sink(point).penetration_toe_mid_cm, 0.01) << point;
    }
    for (const std::size_t point : {std::size_t{1}, std::size_t{3}}) {
        EXPECT_LT(sink(point).penetration_heel_ball_cm, 0.01) << point;
        EXPECT_NEAR(sink(point).penetration_toe_mid_cm, 3, 0.01) << point;
        EXPECT_NEAR(sink(point).penetration_max_cm, 3, 0.01) << point;
    }
}

TEST(Metrics, the_twin_tells_how_long_the_way_was) {
    WalkTrack track = stepping();
    for (std::size_t f = 0; f < track.frames.size(); ++f)
        track.frames[f].root.position.z = 0.02f * static_cast<float>(f);
    EXPECT_NEAR(measure_twin(track).path_m, 0.02 * (k_frames - 1), 1e-3);
}

TEST(Metrics, a_sole_against_a_slope_is_off_by_the_slope) {
    const WalkTrack twin = stepping();
    const float grade = tan(15 * k_radians_per_degree);
    EXPECT_NEAR(measure_walk(twin, twin, Plane(0, grade), {}).sole_angle_deg, 15, 0.01);
    EXPECT_NEAR(measure_walk(twin, twin, Plane(grade, 0), {}).sole_angle_deg, 15, 0.01);
}

TEST(Metrics, a_stretched_knee_counts_where_the_twins_is_not) {
    const WalkTrack twin = stepping();
    WalkTrack straight = twin;
    for (std::size_t f = 100; f < 110; ++f) {
        LegTrack& leg = straight.frames[f].legs[0];
        leg.knee = (leg.hip + leg.ankle) * 0.5f;
    }
    EXPECT_EQ(measure_walk(straight, twin, k_flat, {}).over_extensions, 10);
    EXPECT_EQ(measure_walk(straight, straight, k_flat, {}).over_extensions, 0);
    EXPECT_GT(measure_walk(straight, twin, k_flat, {}).knee_peak_ratio, 1.5);
}

TEST(Metrics, hips_that_shake_twice_as_far_jerk_twice_as_much) {
    const WalkTrack twin = stepping();
    WalkTrack shaken = twin;
    for (TrackFrame& frame : shaken.frames) frame.hips.y = 0.9f + 2 * (frame.hips.y - 0.9f);
    EXPECT_NEAR(measure_walk(shaken, twin, k_flat, {}).hip_jerk_ratio, 2, 0.01);
}

TEST(Metrics, drift_is_what_the_root_misses) {
    WalkTrack walked = stepping();
    walked.frames.back().root = {{3, 0.2f, 4}, 0.1f};
    const WalkMetrics m = measure_walk(walked, stepping(), k_flat, {{0, 0, 0}, 0});
    EXPECT_NEAR(m.drift_m, 5, 1e-5);
    EXPECT_NEAR(m.drift_deg, 5.7296, 1e-3);
}

TEST(Metrics, a_walk_that_never_stands_has_no_samples) {
    const WalkTrack flying = moved(stepping(), [](float t) { return Vec3{0, 0, 3 * t}; });
    const WalkMetrics nothing = measure_walk(flying, flying, k_flat, {});
    EXPECT_EQ(nothing.planted_samples, 0);
    EXPECT_TRUE(std::isnan(nothing.skate_cm_s) && std::isnan(nothing.float_max_cm) &&
                std::isnan(nothing.sole_angle_deg));
}

TEST(Depth, is_the_way_to_free_space) {
    EXPECT_EQ(depth_in_ground(k_flat, {0, 0.01f, 0}), 0);
    EXPECT_NEAR(depth_in_ground(k_flat, {0, -0.02f, 0}), 0.02f, 1e-5f);
    // 1 cm behind a riser, 10 cm under the tread: 1 cm out.
    const Stairs stairs(0.17f, 0.28f, 0, 5);
    EXPECT_NEAR(depth_in_ground(stairs, {0, 0.07f, 0.01f}), 0.01f, 0.003f);
    // In a slope: along its normal.
    const float grade = tan(30 * k_radians_per_degree);
    EXPECT_NEAR(depth_in_ground(Plane(0, grade), {0, -0.1f, 0}), 0.1f * cos(30 * k_radians_per_degree), 0.003f);
}

}  // namespace
}  // namespace surefoot
