#include <surefoot/ground/shapes.h>
#include <surefoot/ik/plant.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

GroundProbe probe_of(const Ground& ground) { return {ground, 0, 5, 5, 0}; }
Footprint foot_at(float x, float z) {
    return make_footprint({x, 0.01f, z - 0.1f}, {x, 0, z + 0.08f}, {x, 0, z + 0.14f}, 0.85f);
}

TEST(Plant, on_flat_ground_it_is_the_identity) {
    const Plane flat;
    const Plant plant = find_foothold(foot_at(0.1f, 3), probe_of(flat), 0.16f, 0.06f);
    for (const Vec3 p : {Vec3{0.1f, 0.08f, 2.9f}, Vec3{0.3f, 0.5f, 4}, Vec3{-2, 1, 0}})
        EXPECT_LT(distance(planted(plant, p, 0.85f), p), 1e-6f);
}

TEST(Plant, on_a_slope_the_sole_lies_on_it_and_the_foot_stays_where_it_steps) {
    const Plane slope(0.1f, 0.3f, 0.2f);
    const Footprint foot = foot_at(0.1f, 3);
    const Plant plant = find_foothold(foot, probe_of(slope), 0.16f, 0.06f);
    EXPECT_NEAR(plant.foothold.x, foot.centre.x, 1e-5f);
    EXPECT_NEAR(plant.foothold.z, foot.centre.z, 1e-5f);
    for (const Vec3 p : {Vec3{0.1f, 0, 2.9f}, Vec3{0.1f, 0, 3.08f}, Vec3{0.14f, 0, 3.14f}, Vec3{0.05f, 0, 2.9f}}) {
        const Vec3 q = planted(plant, p, 0.85f);
        EXPECT_NEAR(q.y, 0.2f + 0.1f * q.x + 0.3f * q.z, 1e-4f);
    }
    const Vec3 up = rotate(plant.tilt, k_up);
    EXPECT_LT(distance(up, normalized(Vec3{-0.1f, 1, -0.3f})), 1e-4f);
}

TEST(Plant, the_lever_saturates) {
    Plant plant;
    plant.tilt = axis_angle({1, 0, 0}, 0.5f);
    const float near = distance(planted(plant, {0, 0, 0.2f}, 0.85f), {0, 0, 0.2f});
    const float far = distance(planted(plant, {0, 0, 5}, 0.85f), {0, 0, 5});
    EXPECT_GT(far, near);
    EXPECT_LT(far, 0.5f * 0.41f);
}

TEST(Foothold, an_edge_is_stepped_away_from) {
    const Bands ledge(0.3f, 0, {{3.05f, 9}});  // the ball would stand on it, the heel below
    const Plant plant = find_foothold(foot_at(0, 3.06f), probe_of(ledge), 0.16f, 0.06f);
    const float moved = plant.foothold.z - plant.centre.z;
    EXPECT_GT(std::fabs(moved), 0.03f);
    EXPECT_LE(std::fabs(moved), 0.161f);
    EXPECT_GT(rotate(plant.tilt, k_up).y, 0.99f);  // and stands level
}

TEST(Foothold, on_tiles_of_all_heights_soles_lie_on_what_is_under_heel_and_ball_and_beside_them) {
    const Tiles rubble(0.3f, 0.08f, -100, 1);
    const GroundProbe probe = probe_of(rubble);
    double sum = 0;
    int feet = 0, crooked = 0;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j) {
            const Vec3 middle{0.23f * static_cast<float>(i), 0, 0.29f * static_cast<float>(j)};
            const Vec3 forward = rotate(from_yaw(0.37f * static_cast<float>(i - j)), {0, 0, 1});
            const Vec3 side{forward.z, 0, -forward.x}, heel = middle - forward * 0.1f, ball = middle + forward * 0.09f;
            const Footprint foot = make_footprint(heel, ball, middle + forward * 0.15f, 0.85f);
            const Plant plant = find_foothold(foot, probe, 0.16f, 0.06f);
            const auto height = [&](float along, float across) {
                const Vec3 p = plant.foothold + forward * (along * foot.half_length) + side * across;
                return probe.height(p.x, p.z);
            };
            constexpr float k_beside = 0.03f;  // [m]
            const float rise = (height(1, 0) - height(-1, 0)) / (2 * foot.half_length);
            const float roll =
                (height(1, k_beside) - height(1, -k_beside) + height(-1, k_beside) - height(-1, -k_beside)) /
                (4 * k_beside);
            const Vec3 normal = normalized(cross(forward + k_up * rise, side + k_up * roll));
            const double off = std::asin(std::min(1.0f, length(cross(normal, rotate(plant.tilt, k_up))))) * 57.3;
            sum += off;
            crooked += off > 6;
            ++feet;
        }
    // Without the sides: 0.34, and 5.
    EXPECT_LT(sum / feet, 0.25);
    EXPECT_LE(crooked, 3);
}

TEST(Foothold, an_edge_under_one_corner_is_no_slope_to_roll_with) {
    // The band's edge cuts off the right corner of the ball: 3 cm there, nothing under heel, ball and the other three.
    const Bands corner(0.03f, 1, {{0.1f, 9}});
    const Footprint foot = foot_at(0, 0);
    const Plant plant = find_foothold(foot, probe_of(corner), 0, 0);
    EXPECT_NEAR(plant.foothold.y, 0, 1e-6f);
    EXPECT_GT(rotate(plant.tilt, k_up).y, 1 - 1e-6f);
    const Plane slope(0.2f, 0, 0);  // what both ends have is
    EXPECT_NEAR(rotate(find_foothold(foot, probe_of(slope), 0, 0).tilt, k_up).y, 1 / std::sqrt(1.04f), 1e-4f);
}

TEST(Foothold, below_a_high_edge_there_is_room_behind_the_heel_to_come_down_in) {
    constexpr float k_edge = 3;
    const auto behind = [&](float drop, float heel) {
        const Bands ledge(drop, 0, {{-9, k_edge}});
        const Footprint foot = foot_at(0, heel + 0.1f);
        return find_foothold(foot, probe_of(ledge), 0.16f, 0.06f).foothold.z - foot.half_length - k_edge;
    };
    EXPECT_GT(behind(0.3f, k_edge + 0.07f), 0.095f);
    EXPECT_NEAR(behind(0.3f, k_edge + 0.2f), 0.2f, 1e-3f);    // far enough as it is
    EXPECT_NEAR(behind(0.1f, k_edge + 0.07f), 0.07f, 1e-3f);  // a low one is nothing to go out of the way of
}

TEST(Foothold, a_foot_comes_down_whole_on_a_tread_wherever_the_clip_steps) {
    for (const float riser : {0.17f, -0.17f}) {
        const Stairs stairs(riser, 0.28f, 3, 20);
        for (float z = 4; z < 4.28f; z += 0.013f) {
            const Footprint foot = foot_at(0, z);
            const Plant plant = find_foothold(foot, probe_of(stairs), 0.16f, 0.06f);
            const float heel = plant.foothold.z - foot.half_length, tip = plant.foothold.z + foot.tip;
            EXPECT_EQ(std::floor((heel - 3) / 0.28f), std::floor((tip - 3) / 0.28f)) << riser << " at " << z;
            EXPECT_GT(rotate(plant.tilt, k_up).y, 0.999f) << riser << " at " << z;
        }
    }
}

TEST(GroundProbe, a_hole_answers_with_the_fallback) {
    const Plane deep(0, 0, -40);
    const GroundProbe probe{deep, 0, 1, 1, 0.25f};
    EXPECT_EQ(probe.height(0, 0), 0.25f);
}

}  // namespace
}  // namespace surefoot
