// How smoothly a live character changes its gait, and that the measure can tell.

#include <surefoot/course/transitions.h>
#include <tests/live/bundled_gait.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

TEST(Transitions, peaks_are_those_of_a_known_oscillation) {
    const LiveRig& rig = test::bundled_rig();
    Motion motion = make_motion(rig.skeleton, "nod", 241, 60);
    const int joint = rig.soles.side[0].upper;
    constexpr double k_swing = 0.3, k_rate = 6;  // [rad], [rad/s]
    for (int f = 0; f < motion.frame_count(); ++f) {
        std::copy(rig.stand.begin(), rig.stand.end(), motion.frame(f).begin());
        motion.frame(f)[static_cast<std::size_t>(joint)].rotation =
            axis_angle({1, 0, 0}, static_cast<float>(k_swing * sin(k_rate * f / 60)));
        motion.root[static_cast<std::size_t>(f)] = {{0, 0, 2.0f * static_cast<float>(f) / 60}, 0};
    }
    const MotionPeaks peaks = measure_peaks(motion, rig.soles, 12, 228);
    EXPECT_NEAR(peaks.joint_deg_s2[static_cast<std::size_t>(joint)], k_swing * k_rate * k_rate * 180 / k_pi, 12);
    EXPECT_NEAR(peaks.joint_deg_s2[static_cast<std::size_t>(rig.soles.side[1].upper)], 0, 1e-3);
    EXPECT_GT(peaks.foot_mps, 2.5) << "the root's 2 m/s and the swing of a leg";
    EXPECT_LT(peaks.foot_mps, 2 + k_swing * k_rate * 1.1);
}

TEST(Transitions, every_change_of_gait_at_every_moment_stays_within_one_and_a_half_times_the_two_gaits) {
    const LiveRig& rig = test::bundled_rig();
    const TransitionReport report = measure_transitions(rig, usual_tasks(rig));
    EXPECT_EQ(report.pairs.size(), 20u);
    EXPECT_EQ(report.runs, 480);
    for (const TransitionFigure& pair : report.pairs) {
        EXPECT_LE(pair.foot_ratio, k_most_transition_ratio) << pair.from << " to " << pair.to;
        EXPECT_LE(pair.joint_ratio, k_most_transition_ratio) << pair.from << " to " << pair.to << ", " << pair.joint;
        EXPECT_LE(pair.slide_cm_s, 1.25 * pair.steady_slide_cm_s + 1) << pair.from << " to " << pair.to;
    }
    EXPECT_TRUE(report.smooth());
}

TEST(Transitions, so_it_stays_with_a_crouch_and_a_stand_that_breathes) {
    const LiveRig& rig = test::bundled_crouching_rig();
    const TransitionReport report = measure_transitions(rig, usual_tasks(rig));
    EXPECT_EQ(report.runs, 1344);
    for (const TransitionFigure& pair : report.pairs)
        EXPECT_LE(pair.worst(), k_most_transition_ratio) << pair.from << " to " << pair.to << ", " << pair.joint;
}

TEST(Transitions, a_plain_cut_is_refused_for_every_pair_even_at_its_mildest_moment) {
    const LiveRig& rig = test::bundled_rig();
    const TransitionReport report = measure_transitions(rig, usual_tasks(rig), {.phases = 4, .durations_s = {0.8f}});
    for (const TransitionFigure& pair : report.pairs)
        EXPECT_GT(pair.cut_joint_ratio, k_most_transition_ratio) << pair.from << " to " << pair.to;
}

TEST(Transitions, the_report_is_the_same_twice_and_names_the_worst) {
    const LiveRig& rig = test::bundled_rig();
    const std::vector<LiveTask> tasks{{"stand", {}}, {"walk", {1.4f, 0}}};
    const TransitionOptions few{.phases = 2, .durations_s = {0.8f}};
    const TransitionReport one = measure_transitions(rig, tasks, few), other = measure_transitions(rig, tasks, few);
    EXPECT_EQ(transitions_json(one), transitions_json(other));
    EXPECT_NE(transitions_table(one).find("worst of 4 runs: " + one.worst().from), std::string::npos);
}

TEST(LiveWalker, walks_over_hills_and_stops_and_starts_there) {
    const LiveRig& rig = test::bundled_rig();
    const Course hills = make_course("hills");
    const auto walker = make_live_walker(rig, {}, walk_path("start-stop", 10));
    const WalkComparison c = compare_modes(*walker, *hills.ground, 1.4f, 10);
    const WalkMetrics &none = c.metrics[0], &ours = c.metrics[2];
    EXPECT_GT(none.penetration_max_cm, 5);
    EXPECT_LT(ours.penetration_max_cm, 4);
    EXPECT_LT(ours.penetration_mean_cm, 0.15);
    EXPECT_LT(ours.float_mean_cm, 0.3);
    EXPECT_LT(ours.skate_cm_s, none.skate_cm_s + 0.6);
    EXPECT_EQ(ours.over_extensions, 0);
    EXPECT_GT(c.twin.motion.root.back().position.z, 3) << "it went";
}

}  // namespace
}  // namespace surefoot
