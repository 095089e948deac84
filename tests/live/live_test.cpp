#include <surefoot/base/random.h>
#include <surefoot/graph/locomotion.h>
#include <tests/live/bundled_gait.h>
#include <tests/support/allocations.h>
#include <tests/support/drag.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace surefoot {
namespace {

using test::bundled_family;
using test::bundled_rig;

constexpr float k_dt = 1.0f / 60;

/// Plays a rig and keeps the world.
struct Player {
    explicit Player(const LiveRig& live, const LiveRequest& request, float phase = 0)
        : rig(live), state(start(live, request, phase)), scratch(live), locals(live.stand.size()), models(locals) {
        pose_now();
    }
    void go(const LiveRequest& request, float dt = k_dt) {
        frame = update(rig, state, request, dt);
        root = root * frame.root_delta;
        pose_now();
    }
    void pose_now() {
        pose(rig, state, scratch, locals);
        local_to_model(*rig.skeleton, locals, models);
    }
    Transform world(int joint) const { return to_transform(root) * models[static_cast<std::size_t>(joint)]; }
    SolePoints sole(std::size_t side) const {
        const Leg& leg = rig.soles.side[side];
        return sole_points(leg, world(leg.foot), leg.toes == k_no_joint ? Transform{} : world(leg.toes));
    }
    RootFrame place(std::size_t side) const { return root * state.feet[side].plant; }

    const LiveRig& rig;
    LiveState state;
    LiveScratch scratch;
    std::vector<Transform> locals, models;
    RootFrame root;
    LiveFrame frame;
};

/// What a restless player asks for: something else every now and then, and often nothing.
LiveRequest whim(Random& random) {
    LiveRequest request;
    request.glide = random.between(0.2f, 1.5f);
    if (random.between(0, 1) < 0.3f) return request;
    request.speed = random.between(0.3f, 4);
    if (random.between(0, 1) < 0.5f) request.turn = random.between(-80, 80);
    return request;
}

TEST(Live, the_bundled_rig_is_sound_and_broken_ones_are_named) {
    EXPECT_EQ(problem(bundled_rig()), "");
    EXPECT_NE(problem(LiveRig{}), "");
    LiveRig none = bundled_rig();
    none.manners.push_back({"nothing", nullptr, nullptr});
    EXPECT_NE(problem(none).find("'nothing' has no gait"), std::string::npos);
    auto legless = std::make_shared<HarmonicGait>(*bundled_family());
    legless->legs.count = 0;
    EXPECT_NE(problem(make_live_rig({{"legless", legless, nullptr}})).find("knows no legs"), std::string::npos);
    auto strange = std::make_shared<HarmonicGait>(*bundled_family());
    auto skeleton = std::make_shared<Skeleton>(*strange->skeleton);
    skeleton->names.front() += "?";
    strange->skeleton = skeleton;
    EXPECT_EQ(problem(make_live_rig({{"human", bundled_family(), nullptr}}, strange)),
              "the idle is of another skeleton");
}

/// [m] The farthest that a joint of four steady seconds is from where the fitted gait has it.
float off_from_fitted(const LiveRig& rig, const LiveRequest& request) {
    const HarmonicGait& gait = *rig.manners[static_cast<std::size_t>(request.manner)].gait;
    std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
    std::vector<Transform> locals(gait.mean.size()), models(locals);
    Player player(rig, request, 0.83f);
    values_at(gait, request.speed, request.turn, values);
    const GaitRhythm rhythm = rhythm_of(gait, values);
    double share = static_cast<double>(time_share(rhythm, 0.83f));
    float worst = 0;
    for (int f = 0; f < 240; ++f) {
        player.go(request);
        share += static_cast<double>(rhythm.frequency * k_dt);
        pose(gait, values, phase_of(rhythm, static_cast<float>(share - std::floor(share))), locals);
        local_to_model(*gait.skeleton, locals, models);
        for (std::size_t j = 0; j < models.size(); ++j)
            worst = std::max(worst, distance(models[j].translation, player.models[j].translation));
    }
    return worst;
}

TEST(Live, steady_it_is_the_fitted_gait_to_a_millimetre) {
    for (const auto& [speed, turn] : {std::pair{0.8f, 0.0f}, {1.4f, 0.0f}, {1.3f, 70.0f}, {2.2f, -40.0f}, {4.0f, 0.0f}})
        EXPECT_LT(off_from_fitted(bundled_rig(), {speed, turn}), 1e-3f) << speed << " m/s, " << turn << " deg/s";
}

TEST(Live, so_it_is_crouching_though_it_stands_in_another_posture) {
    for (const auto& [speed, turn] : {std::pair{0.4f, 0.0f}, {0.74f, 0.0f}, {1.3f, 0.0f}, {0.8f, 60.0f}})
        EXPECT_LT(off_from_fitted(test::bundled_crouching_rig(), {speed, turn, 1}), 1e-3f)
            << speed << " m/s, " << turn << " deg/s";
}

TEST(Live, into_a_crouch_and_out_of_it_takes_its_time_and_stops_in_a_stand) {
    const LiveRig& rig = test::bundled_crouching_rig();
    ASSERT_EQ(rig.change_seconds[0], 0);
    ASSERT_GT(rig.change_seconds[1], 2);
    Player player(rig, {2.5f, 0});
    const auto head = static_cast<std::size_t>(rig.skeleton->find("Head"));
    const float up = player.models[head].translation.y;
    for (int f = 0; f < 60 * 6; ++f) player.go({0.8f, 0, 1});
    EXPECT_LT(player.models[head].translation.y, up - 0.2f);
    EXPECT_EQ(player.frame.velocity.z, 0.8f);
    int frames = 0;
    for (; frames < 60 * 8 && !player.frame.rests; ++frames) player.go({});
    EXPECT_TRUE(player.frame.rests);
    EXPECT_GT(player.models[head].translation.y, up - 0.05f);
}

TEST(Live, the_root_does_exactly_as_asked_once_it_has_glided_there) {
    Player player(bundled_rig(), {1.0f, 0});
    const LiveRequest other{2.7f, -35, 0, 0.5f};
    for (int i = 0; i < 180; ++i) player.go(other);
    EXPECT_EQ(player.frame.velocity.z, 2.7f);
    EXPECT_EQ(player.frame.turn, -35.0f);
    const RootFrame whole = integrate({0, 0, 2.7f}, -35 * k_radians_per_degree, k_dt);
    EXPECT_NEAR(player.frame.root_delta.position.z, whole.position.z, 1e-6f);
    EXPECT_NEAR(player.frame.root_delta.yaw, whole.yaw, 1e-6f);
}

TEST(Live, a_planted_foot_keeps_its_place_in_the_world_whatever_is_asked_for) {
    Random random(11);
    Player player(bundled_rig(), {1.4f, 0});
    LiveRequest request;
    std::array<RootFrame, 2> stood;
    std::array<bool, 2> stands{};
    for (int f = 0; f < 60 * 60; ++f) {
        if (f % 37 == 0) request = whim(random);
        player.go(request);
        for (std::size_t side = 0; side < 2; ++side) {
            const RootFrame now = player.place(side);
            if (stands[side] && player.frame.planted[side]) {
                ASSERT_LT(planar_length(now.position - stood[side].position), 1e-4f) << f;
                ASSERT_LT(std::fabs(now.yaw - stood[side].yaw), 1e-4f) << f;
            }
            stands[side] = player.frame.planted[side];
            stood[side] = now;
        }
    }
}

TEST(Live, what_touches_the_ground_under_a_planted_foot_hardly_moves_while_everything_changes) {
    Random random(12);
    Player player(bundled_rig(), {1.2f, 0});
    LiveRequest request;
    double moved = 0, seconds = 0;
    std::array<SolePoints, 2> before;
    std::array<bool, 2> stood{};
    for (int f = 0; f < 60 * 60; ++f) {
        if (f % 41 == 0) request = whim(random);
        player.go(request);
        for (std::size_t side = 0; side < 2; ++side) {
            const SolePoints now = player.sole(side);
            const auto both_down = [](const SolePoints& s) { return s.heel.y < 0.02f && s.ball.y < 0.02f; };
            if (stood[side] && player.frame.planted[side] && both_down(now) && both_down(before[side])) {
                moved += static_cast<double>(planar_length(now.ball - before[side].ball));
                seconds += static_cast<double>(k_dt);
            }
            before[side] = now;
            stood[side] = player.frame.planted[side];
        }
    }
    ASSERT_GT(seconds, 15);
    EXPECT_LT(moved / seconds, 0.05) << "m/s; the fitted gait by itself has 0.04";
}

TEST(Live, a_foot_that_lies_is_not_dragged_into_a_stand_out_of_it_or_while_turning) {
    for (const auto& [speed, turn, most] : {std::tuple{0.8f, 0.0f, 0.02f},
                                            {1.4f, 0.0f, 0.02f},
                                            {3.0f, 0.0f, 0.03f},
                                            {0.0f, 60.0f, 0.02f},
                                            {0.0f, -90.0f, 0.04f}}) {
        Player player(bundled_rig(), {});
        test::DragMeter drag;
        for (int f = 0; f < 480; ++f) {
            player.go(f > 30 && f < 240 ? LiveRequest{speed, turn} : LiveRequest{});
            drag.see(player.rig.soles, to_transform(player.root), player.models);
        }
        EXPECT_LT(drag.longest(), most) << speed << " m/s, " << turn << " deg/s";
    }
}

TEST(Live, feet_leave_the_ground_in_turn) {
    Random random(13);
    Player player(bundled_rig(), {1.4f, 0});
    LiveRequest request;
    int last = -1, lifts = 0, hops = 0;
    std::array<bool, 2> stood = {true, true};
    for (int f = 0; f < 120 * 60; ++f) {
        if (f % 43 == 0) request = whim(random);
        player.go(request);
        for (int side = 0; side < 2; ++side) {
            const bool stands = player.frame.planted[static_cast<std::size_t>(side)];
            if (stood[static_cast<std::size_t>(side)] && !stands) {
                ++lifts;
                hops += side == last;
                last = side;
            }
            stood[static_cast<std::size_t>(side)] = stands;
        }
    }
    EXPECT_GT(lifts, 150);
    // From a stand either foot may be the first, the one that closed the last step too.
    EXPECT_LT(hops, lifts / 8) << lifts;
}

TEST(Live, asked_to_stop_at_any_moment_it_ends_in_a_stand_with_both_feet_where_they_belong) {
    for (const float speed : {0.6f, 1.4f, 3.0f})
        for (const float turn : {0.0f, 40.0f})
            for (int p = 0; p < 8; ++p) {
                Player player(bundled_rig(), {speed, turn}, static_cast<float>(p) / 8);
                int frames = 0;
                for (; frames < 360 && !player.frame.rests; ++frames) player.go({});
                ASSERT_TRUE(player.frame.rests) << speed << " m/s, phase " << p;
                EXPECT_LT(static_cast<float>(frames) * k_dt, 3.5f);
                for (std::size_t side = 0; side < 2; ++side) {
                    EXPECT_TRUE(player.frame.planted[side]);
                    const RootFrame off = between(player.rig.stand_place[side], player.state.feet[side].plant);
                    EXPECT_LT(planar_length(off.position), 0.05f);
                    EXPECT_LT(std::fabs(off.yaw), 0.13f);
                    const SolePoints sole = player.sole(side);
                    EXPECT_NEAR(sole.heel.y, 0, 0.005f);
                    EXPECT_NEAR(sole.ball.y, 0, 0.005f);
                }
                const std::vector<Transform> pose_at_rest = player.models;
                player.go({});
                for (std::size_t j = 0; j < pose_at_rest.size(); ++j)
                    EXPECT_LT(distance(pose_at_rest[j].translation, player.models[j].translation), 1e-5f);
            }
}

TEST(Live, stopped_it_breathes_and_its_feet_stay_where_they_are) {
    const LiveRig& rig = test::bundled_breathing_rig();
    ASSERT_EQ(problem(rig), "");
    Player player(rig, {1.4f, 0}, 0.3f);
    for (int f = 0; f < 360 && !player.frame.rests; ++f) player.go({});
    ASSERT_TRUE(player.frame.rests);
    const std::array<SolePoints, 2> stood{player.sole(0), player.sole(1)};
    const std::vector<Transform> before = player.models;
    const auto head = static_cast<std::size_t>(rig.skeleton->find("Head"));
    float moved = 0, quickest = 0;
    for (int f = 0; f < 15 * 60; ++f) {
        const Vec3 last = player.models[head].translation;
        player.go({});
        ASSERT_TRUE(player.frame.rests);
        moved = std::max(moved, distance(player.models[head].translation, before[head].translation));
        quickest = std::max(quickest, distance(player.models[head].translation, last) / k_dt);
        for (std::size_t side = 0; side < 2; ++side) {
            const SolePoints now = player.sole(side);
            ASSERT_LT(distance(now.heel, stood[side].heel), 5e-4f) << f;
            ASSERT_LT(distance(now.ball, stood[side].ball), 5e-4f) << f;
        }
    }
    EXPECT_GT(moved, 0.003f);
    EXPECT_LT(quickest, 0.1f) << "m/s";
}

TEST(Live, an_idle_changes_nothing_of_what_goes_steadily) {
    Player plain(bundled_rig(), {1.4f, 0}, 0.3f), breathing(test::bundled_breathing_rig(), {1.4f, 0}, 0.3f);
    for (int f = 0; f < 120; ++f) {
        plain.go({1.4f, 0});
        breathing.go({1.4f, 0});
        ASSERT_EQ(plain.locals, breathing.locals) << f;
    }
}

TEST(Live, from_a_stand_the_foot_on_the_side_of_the_turn_steps_off_at_once) {
    for (const float turn : {50.0f, -50.0f}) {
        Player player(bundled_rig(), {});
        EXPECT_TRUE(player.frame.rests || player.state.rests == 1);
        int frames = 0;
        while (frames < 60 && player.state.feet[0].swings == player.state.feet[1].swings) {
            player.go({1.2f, turn});
            ++frames;
        }
        EXPECT_LT(frames, 15);
        EXPECT_EQ(player.state.feet[turn > 0 ? 0 : 1].swings, true);
    }
}

TEST(Live, turning_on_the_spot_takes_steps_and_stays_there) {
    Player player(bundled_rig(), {});
    int lifts = 0;
    bool stood = true;
    for (int f = 0; f < 240; ++f) {
        player.go({0, 60});
        lifts += stood && !player.frame.planted[0];
        stood = player.frame.planted[0];
    }
    EXPECT_GE(lifts, 2);
    EXPECT_LT(planar_length(player.root.position), 0.01f);
    EXPECT_NEAR(player.root.yaw, 60 * k_radians_per_degree * 3.6f, 0.2f);
}

TEST(Live, the_frame_rate_hardly_matters) {
    Player fine(bundled_rig(), {1.4f, 0}, 0.3f), coarse(bundled_rig(), {1.4f, 0}, 0.3f);
    const LiveRequest other{2.6f, 30, 0, 0.8f};
    for (int i = 0; i < 30; ++i) {
        for (int k = 0; k < 16; ++k) fine.go(other, 1.0f / 240);
        coarse.go(other, 1.0f / 15);
    }
    EXPECT_LT(distance(fine.root.position, coarse.root.position), 0.01f);
    for (std::size_t j = 0; j < fine.models.size(); ++j)
        EXPECT_LT(distance(fine.models[j].translation, coarse.models[j].translation), 0.08f) << j;
}

TEST(Live, saving_is_copying_bytes_and_a_frame_allocates_nothing) {
    Random random(5);
    Player player(test::bundled_breathing_rig(), {1.4f, 0});
    for (int i = 0; i < 100; ++i) player.go({2, 10});
    LiveState saved;
    std::memcpy(&saved, &player.state, sizeof saved);
    std::vector<LiveRequest> asked;
    for (int i = 0; i < 10; ++i) asked.push_back(whim(random));
    const auto run = [&] {
        for (int i = 0; i < 300; ++i) player.go(asked[static_cast<std::size_t>(i / 30)]);
        return player.models;
    };
    run();
    std::memcpy(&player.state, &saved, sizeof saved);
    const long before = test::allocation_count();
    for (int i = 0; i < 300; ++i) player.go(asked[static_cast<std::size_t>(i / 30)]);
    EXPECT_EQ(test::allocation_count(), before);
    const std::vector<Transform> again = player.models;
    std::memcpy(&player.state, &saved, sizeof saved);
    EXPECT_EQ(run(), again);
}

TEST(Live, whatever_is_asked_for_only_numbers_come_out) {
    Random random(6);
    Player player(bundled_rig(), {std::nanf(""), 1e30f, 77, -1});
    for (int f = 0; f < 2000; ++f) {
        LiveRequest request{random.between(-1e3f, 1e3f), random.between(-1e4f, 1e4f), static_cast<int>(f % 5) - 2,
                            random.between(-1, 3)};
        if (f % 7 == 0) request.speed = std::nanf("");
        if (f % 11 == 0) request.glide = INFINITY;
        player.go(request, random.between(0, 0.3f));
        for (const Transform& t : player.models) ASSERT_TRUE(is_finite(t.translation) && is_finite(t.rotation)) << f;
    }
}

TEST(Live, another_manner_and_another_order_of_feet_are_glided_to) {
    const FootfallPattern* hop = find_footfall_pattern("hop");
    const LiveRig rig = make_live_rig({{"walk", bundled_family(), nullptr}, {"hop", bundled_family(), hop}});
    ASSERT_EQ(problem(rig), "");
    Player player(rig, {1.2f, 0});
    float quickest = 0;
    Vec3 before = player.world(rig.soles.side[1].foot).translation;
    for (int f = 0; f < 300; ++f) {
        player.go({1.2f, 0, 1});
        const Vec3 now = player.world(rig.soles.side[1].foot).translation;
        quickest = std::max(quickest, distance(now, before) / k_dt);
        before = now;
    }
    EXPECT_LT(quickest, 8) << "no jump on the way";
    int apart = 0;
    for (int f = 0; f < 120; ++f) {
        player.go({1.2f, 0, 1});
        apart += player.frame.planted[0] != player.frame.planted[1];
    }
    EXPECT_LT(apart, 6) << "both feet stand and fly together";
}

}  // namespace
}  // namespace surefoot
