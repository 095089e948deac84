// Steering along a path: the root does as it is asked, and nobody knows what is asked for next.

#include <surefoot/analysis/analyze.h>
#include <surefoot/bake/character.h>
#include <surefoot/course/placed_walker.h>
#include <surefoot/course/walk.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/space/triangulate.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

/// The generated clips in a space over speed and turn.
const Character& character() {
    static const Character made = [] {
        const ClipSet set = make_synthetic_set();
        std::vector<AnalyzedClip> clips;
        ProjectSpace facing;
        facing.name = "facing";
        facing.space.axes = {{"speed", "m/s", -2, 6, false}, {"turn", "deg/s", -180, 180, false}};
        for (const char* name : {"idle", "walk", "walk_left", "walk_right", "jog", "run", "back"})
            for (const Motion& clip : set.clips)
                if (clip.name == name) {
                    clips.push_back(analyze_clip(clip, name));
                    facing.space.samples.push_back({clips.back().facts.speed, clips.back().facts.turn});
                    facing.clips.push_back(static_cast<int>(clips.size()) - 1);
                }
        triangulate(facing.space);
        return bake_character(clips, {&facing, 1}, "steered");
    }();
    return made;
}

TEST(Path, names_are_known) {
    EXPECT_EQ(walk_path("straight", 10).size(), 1u);
    EXPECT_GE(walk_path("eight", 30).size(), 4u);
    EXPECT_ANY_THROW(walk_path("zigzag", 10));
    for (const std::string& name : path_names()) EXPECT_FALSE(walk_path(name, 10).empty()) << name;
}

TEST(Path, turns_on_the_spot_end_where_they_began) {
    float yaw = 0, most = 0;
    for (const PathLeg& leg : walk_path("turns", 10)) {
        if (leg.goes) {
            EXPECT_EQ(leg.turn, 0);
        }
        yaw += leg.turn * leg.seconds;
        most = std::max(most, std::fabs(yaw));
    }
    EXPECT_EQ(most, 180);
    EXPECT_EQ(yaw, 0);
}

TEST(Path, a_minute_of_figures_of_eight_through_the_blend_space_misses_less_than_a_percent_and_2_degrees) {
    for (const float speed : {1.0f, 1.4f}) {
        const auto walker = make_character_walker(character(), {}, walk_path("eight", 60));
        const Walked walked = walk(*walker, Plane(), {speed, 60, FootMode::none});
        float gone = 0, off = 0, turned = 0, widest = 0;
        for (std::size_t f = 1; f < walked.requested.size(); ++f) {
            const RootFrame &is = walked.motion.root[f], &asked = walked.requested[f];
            gone += planar_length(asked.position - walked.requested[f - 1].position);
            off = std::max(off, planar_length(is.position - asked.position));
            turned = std::max(turned, std::fabs(wrap_angle(is.yaw - asked.yaw)));
            widest = std::max(widest, planar_length(is.position));
        }
        EXPECT_NEAR(gone, speed * 60, 0.1);
        EXPECT_GT(widest, 2) << "it went round";
        EXPECT_LT(off, 0.01f * gone) << speed;
        EXPECT_LT(turned * k_degrees_per_radian, 2) << speed;
    }
}

TEST(Path, what_comes_is_foreseen_from_the_present_request_alone) {
    const auto going = make_character_walker(character(), {}, walk_path("start-stop", 10));
    const auto straight = make_character_walker(character());
    std::vector<Transform> pose(character().skeleton->rest.size()), again = pose;
    RootFrame soon, now;
    going->start(1.4f);
    // Until the first second has passed it is asked to stand, so it foresees that it stands.
    for (int f = 0; f < 55; ++f) going->advance(1 / k_walk_fps);
    going->look(1, soon, pose);
    EXPECT_LT(planar_length(soon.position), 0.01f);
    // And while the request stays, what it foresaw is what comes.
    for (int f = 0; f < 30; ++f) going->advance(1 / k_walk_fps);
    going->look(0.5f, soon, pose);
    going->look(0.1f, now, again);
    for (int f = 0; f < 30; ++f) going->advance(1 / k_walk_fps);
    going->look(0, now, again);
    EXPECT_LT(distance(soon.position, now.position), 1e-4f);
    EXPECT_GT(now.position.z, 0.3f);
    for (std::size_t j = 0; j < pose.size(); ++j)
        EXPECT_LT(distance(pose[j].translation, again[j].translation), 1e-4f) << j;
}

TEST(Path, a_character_walks_backward_where_its_clips_do) {
    const auto walker = make_character_walker(character(), {}, walk_path("straight", 6));
    const Walked walked = walk(*walker, *make_course("hills").ground, {-0.8f, 6, FootMode::surefoot});
    EXPECT_NEAR(walked.motion.root.back().position.z, -4.8f, 0.05f);
}

TEST(Path, feet_notice_at_once_that_a_standing_character_goes_and_a_going_one_stops) {
    for (const char* name : {"hills", "cross_slope"}) {
        const auto walker = make_character_walker(character(), {}, walk_path("start-stop", 16));
        const WalkComparison c = compare_modes(*walker, *make_course(name).ground, 1.4f, 16);
        const WalkMetrics& ours = c.metrics[static_cast<std::size_t>(FootMode::surefoot)];
        EXPECT_LT(ours.penetration_max_cm, 1.5) << name;
        EXPECT_LT(ours.float_mean_cm, 0.1) << name;
        EXPECT_LT(ours.sole_angle_worst_deg, 6) << name;
        EXPECT_LT(ours.hip_jerk_ratio, 2) << name;
        EXPECT_GT(ours.knee_min_deg, 60) << name;
    }
}

TEST(Path, curving_over_hills_feet_stand_as_they_do_going_straight) {
    const auto walker = make_character_walker(character(), {}, walk_path("curve", 16));
    const WalkComparison c = compare_modes(*walker, *make_course("hills").ground, 1.4f, 16);
    const WalkMetrics& ours = c.metrics[static_cast<std::size_t>(FootMode::surefoot)];
    EXPECT_GT(c.twin.motion.root.back().position.z, 15) << "it gets ahead";
    EXPECT_LT(ours.penetration_max_cm, 1.5);
    EXPECT_LT(ours.float_mean_cm, 0.1);
    EXPECT_LT(ours.knee_peak_ratio, 1.8);
    EXPECT_LT(ours.hip_jerk_ratio, 2);
    EXPECT_LT(ours.skate_cm_s, c.metrics[0].skate_cm_s + 0.5);
}

TEST(Path, a_foot_that_stirs_though_it_was_to_rest_is_planned_anew_in_that_frame) {
    constexpr float k_stirs = 0.35f / k_walk_fps;  // [m] about the root, in a frame
    for (int late = 0; late < 8; ++late) {         // against the rhythm in which plans are looked at anyway
        const float rest = 2 + static_cast<float>(late) / k_walk_fps;
        const auto walker = make_character_walker(character(), {}, {{false, 0, rest}, {true, 0, 2}});
        const Plane flat;
        PlacedWalker placed(*walker, flat);
        placed.start(1.4f);
        int plans = 0;
        bool stirs = false;
        std::vector<Transform> before;
        for (int f = 1; f < 180 && !stirs; ++f) {
            before.assign(placed.unplaced().begin(), placed.unplaced().end());
            placed.advance(1 / k_walk_fps);
            if (static_cast<float>(f) / k_walk_fps < rest) plans = placed.state().plans;
            for (const Leg& leg : walker->legs().side) {
                const auto foot = static_cast<std::size_t>(leg.foot);
                const Vec3 middle = lerp(leg.heel, leg.ball, 0.5f);  // a heel that rises moves the joint, not the foot
                stirs |= planar_length(transform_point(placed.unplaced()[foot], middle) -
                                       transform_point(before[foot], middle)) > k_stirs;
            }
        }
        EXPECT_TRUE(stirs);
        EXPECT_GT(placed.state().plans, plans) << late;
    }
}

TEST(Path, feet_of_a_standing_character_that_its_host_turns_and_slides_do_not_drag) {
    for (const char* name : {"flat", "hills"}) {
        const auto walker = make_character_walker(character(), {}, walk_path("host-turns", 30));
        const WalkComparison c = compare_modes(*walker, *make_course(name).ground, 1.4f, 30);
        const WalkMetrics &none = c.metrics[0], &ours = c.metrics[2];
        EXPECT_GT(none.skate_cm_s, 6) << name;
        EXPECT_LT(ours.skate_cm_s, 1) << name;
        EXPECT_LT(ours.penetration_max_cm, 1) << name;
        EXPECT_LT(ours.float_mean_cm, 0.1) << name;
        EXPECT_LT(ours.sole_angle_worst_deg, 6) << name;
        EXPECT_LT(ours.knee_peak_deg_s2, 22000) << name;
        EXPECT_LT(ours.hip_jerk_ratio, 2) << name;
        EXPECT_EQ(ours.over_extensions, 0) << name;
    }
}

TEST(Path, where_steering_stops_and_starts_on_a_slope_the_hips_stay_calm) {
    for (const char* name : {"slope_up", "slope_down", "ledge", "hills"}) {
        const auto walker = make_character_walker(character(), {}, walk_path("start-stop", 16));
        const WalkMetrics ours = compare_modes(*walker, *make_course(name).ground, 1.4f, 16).metrics[2];
        EXPECT_LT(ours.hip_jerk_ratio, 2) << name;
        EXPECT_EQ(ours.over_extensions, 0) << name;
    }
}

TEST(Pace, stairs_are_taken_in_steps_that_fit_them_and_without_the_limit_feet_go_into_risers) {
    for (const char* name : {"stairs_up", "stairs_down"}) {
        const Course stairs = make_course(name);
        const auto walker = make_character_walker(character());
        const WalkComparison limited = compare_modes(*walker, *stairs.ground, 1.4f, 16);
        const WalkComparison unlimited = compare_modes(*walker, *stairs.ground, 1.4f, 16, false);
        const std::vector<float>& limits = limited.walked[2].speed_limit;
        EXPECT_EQ(limits.front(), k_no_speed_limit);
        EXPECT_LT(*std::min_element(limits.begin(), limits.end()), 0.9f) << name;
        EXPECT_EQ(limits.back(), k_no_speed_limit) << "the stairs are behind";
        EXPECT_GT(limited.metrics[2].knee_min_deg, 40) << name;
        EXPECT_LT(limited.metrics[2].float_mean_cm, 0.1) << name;
        EXPECT_LT(limited.metrics[2].penetration_max_cm, 1) << name;
        EXPECT_GT(unlimited.metrics[2].penetration_max_cm, 1.5) << name;
        EXPECT_LT(unlimited.metrics[2].knee_min_deg, limited.metrics[2].knee_min_deg) << name;
        EXPECT_EQ(unlimited.walked[2].speed_limit, std::vector<float>(limits.size(), k_no_speed_limit));
        // Every row goes the same way at the same time.
        for (const WalkComparison* walks : {&limited, &unlimited})
            for (const Walked& row : walks->walked)
                EXPECT_EQ(row.motion.root.back().position.z, walks->twin.motion.root.back().position.z);
        EXPECT_LT(limited.metrics[2].drift_m, 0.01) << "what is asked for is what steering was told";
    }
}

TEST(Pace, stopping_and_starting_on_stairs_feet_stand_on_the_treads_and_no_foot_leaps) {
    for (const char* name : {"stairs_up", "stairs_down"}) {
        const Course stairs = make_course(name);
        const auto walker = make_character_walker(character(), {}, walk_path("start-stop", 16));
        const WalkMetrics ours = compare_modes(*walker, *stairs.ground, 1.4f, 16).metrics[2];
        EXPECT_GT(ours.knee_min_deg, 40) << name;
        EXPECT_LT(ours.sole_angle_deg, 1) << name;
        EXPECT_LT(ours.float_mean_cm, 0.3) << name;
        EXPECT_LT(ours.penetration_mean_cm, 0.1) << name;
    }
}

TEST(Pace, where_steering_stops_and_turns_on_stairs_without_notice_heels_keep_out_of_risers) {
    for (const char* name : {"stairs_up", "stairs_down"})
        for (const bool reverse : {false, true}) {
            const Course stairs = make_course(name, 15, reverse);
            const auto walker = make_character_walker(character(), {}, walk_path("turns", 30));
            const WalkMetrics ours = compare_modes(*walker, *stairs.ground, 1.4f, 30).metrics[2];
            EXPECT_LT(ours.penetration_max_cm, 6) << name << reverse;  // 7.5 where it is noticed late
        }
}

TEST(Pace, ground_that_bears_long_steps_holds_nobody_back) {
    for (const char* name :
         {"flat", "hills", "slope_up", "slope_down", "cross_slope", "ledge", "rubble", "curb_oblique"})
        for (const float speed : {0.8f, 1.4f, 2.5f}) {
            const auto walker = make_character_walker(character());
            const Walked walked = walk(*walker, *make_course(name).ground, {speed, 8, FootMode::surefoot});
            EXPECT_EQ(walked.speed_limit, std::vector<float>(walked.speed_limit.size(), k_no_speed_limit))
                << name << " at " << speed;
        }
}

TEST(Course, reversed_it_is_the_same_ground_from_its_far_end) {
    for (const std::string& name : course_names()) {
        const Course there = make_course(name), back = make_course(name, 15, true);
        const auto height = [](const Course& c, float x, float z) { return height_at(*c.ground, x, z); };
        float length = 0;
        // The far end is where the mesh was turned about.
        ASSERT_EQ(there.mesh.positions.size(), back.mesh.positions.size());
        length = there.mesh.positions.front().z + back.mesh.positions.front().z;
        for (float z = 0; z < 12; z += 0.37f)
            EXPECT_NEAR(height(back, 0.4f, z), height(there, -0.4f, length - z), 1e-5f) << name << ' ' << z;
    }
    const auto rise = [](const Course& c) { return height_at(*c.ground, 0, 8) - height_at(*c.ground, 0, 0); };
    EXPECT_GT(rise(make_course("stairs_up")), 1);
    EXPECT_LT(rise(make_course("stairs_up", 15, true)), -1);
}

}  // namespace
}  // namespace surefoot
