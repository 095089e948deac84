#include "support.h"

#include <gtest/gtest.h>

#include <set>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_plane;
using test::make_project;
using test::names_both;
using test::of_rule;

/// A clean set: nothing to complain about but uncovered corners.
std::vector<ProjectClip> clean_clips() {
    return {make_clip("idle", 0, 0),
            make_clip("turn_left", 0, 90),
            make_clip("turn_right", 0, -90),
            make_clip("walk", 1.4f, 0),
            make_clip("run", 3, 0),
            make_clip("back", -1.4f, 0),
            make_clip("walk_left", 1.4f, 90),
            make_clip("walk_right", 1.4f, -90),
            make_clip("run_left", 3, 90),
            make_clip("run_right", 3, -90),
            make_clip("back_left", -1.4f, 90),
            make_clip("back_right", -1.4f, -90)};
}

std::vector<ProjectClip> without(std::vector<ProjectClip> clips, const std::set<std::string>& names) {
    std::erase_if(clips, [&](const ProjectClip& clip) { return names.count(clip.name) > 0; });
    return clips;
}

std::vector<ProjectClip> with(std::vector<ProjectClip> clips, ProjectClip clip) {
    clips.push_back(std::move(clip));
    return clips;
}

LintResult lint_clips(std::vector<ProjectClip> clips) { return lint(make_plane(std::move(clips), -1.5f, 3, 90)); }

bool has_placeholder(const LintResult& result, PlaceholderKind kind, float speed, float turn) {
    for (const Placeholder& p : result.placeholders)
        if (p.kind == kind && p.target.size() == 2 && std::fabs(p.target[0] - speed) < 0.02f &&
            std::fabs(p.target[1] - turn) < 0.5f)
            return true;
    return false;
}

TEST(lint, a_clean_set_has_no_findings_at_all) {
    const LintResult result = lint_clips(clean_clips());
    for (const Finding& finding : result.findings) ADD_FAILURE() << finding.rule << ": " << finding.message;
    EXPECT_TRUE(result.placeholders.empty());
}

TEST(lint, an_edge_across_an_axis_is_found_and_the_crossing_is_asked_for) {
    // Without a run straight ahead, running left and running right are blended across turn = 0.
    const LintResult result = lint_clips(without(clean_clips(), {"run"}));
    const auto found = of_rule(result, "crossing-axis");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(names_both(found[0], "run_left", "run_right"));
    EXPECT_EQ(found[0].severity, Severity::error);
    ASSERT_EQ(found[0].at.size(), 2u);
    EXPECT_NEAR(found[0].at[0], 3, 1e-5);
    EXPECT_NEAR(found[0].at[1], 0, 1e-5);
    ASSERT_TRUE(found[0].fix);
    EXPECT_EQ(found[0].fix->target, found[0].at);
    EXPECT_TRUE(has_placeholder(result, PlaceholderKind::needed, 3, 0));
}

TEST(lint, an_edge_whose_end_is_within_five_percent_of_the_axis_does_not_cross_it) {
    // 5 % of 180 deg/s is 9 deg/s: an end at 8 is on the axis for all that a player sees, one at 11 is not.
    for (const auto& [turn, crossing] : {std::pair{8.0f, false}, std::pair{11.0f, true}}) {
        const LintResult result =
            lint_clips({make_clip("idle", 0, 0), make_clip("left", 2, 60), make_clip("right", 2, -turn)});
        EXPECT_EQ(of_rule(result, "crossing-axis").size(), crossing ? 1u : 0u) << turn;
    }
}

TEST(lint, missing_axis_ends_are_asked_for_one_by_one) {
    struct Case {
        const char* missing;
        float speed, turn;
    };
    for (const Case& c :
         {Case{"turn_left", 0, 90}, Case{"turn_right", 0, -90}, Case{"run", 3, 0}, Case{"back", -1.4f, 0}}) {
        const LintResult result = lint_clips(without(clean_clips(), {c.missing}));
        const auto found = of_rule(result, "missing-axis-end");
        ASSERT_EQ(found.size(), 1u) << c.missing;
        EXPECT_NEAR(found[0].at[0], c.speed, 1e-5) << c.missing;
        EXPECT_NEAR(found[0].at[1], c.turn, 1e-5) << c.missing;
        EXPECT_TRUE(has_placeholder(result, PlaceholderKind::needed, c.speed, c.turn)) << c.missing;
    }
}

TEST(lint, an_axis_end_within_five_percent_counts) {
    auto clips = without(clean_clips(), {"turn_left"});
    EXPECT_TRUE(of_rule(lint_clips(with(clips, make_clip("turn", 0, 82))), "missing-axis-end").empty());
    EXPECT_FALSE(of_rule(lint_clips(with(clips, make_clip("turn", 0, 78))), "missing-axis-end").empty());
}

TEST(lint, a_set_that_never_goes_backward_is_told_so) {
    const LintResult result = lint(make_project(without(clean_clips(), {"back", "back_left", "back_right"})));
    const auto found = of_rule(result, "missing-axis-end");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].message.find("backward"), std::string::npos);
}

TEST(lint, a_sliver_is_found_and_the_clip_that_widens_it_is_tried_out_before_it_is_asked_for) {
    auto clips = clean_clips();
    clips.push_back(make_clip("jog_wide", 2.2f, 86));  // almost on the edge of walk_left and run_left
    const LintResult result = lint_clips(clips);
    const auto found = of_rule(result, "acute-triangle");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(names_both(found[0], "jog_wide", "walk_left"));
    EXPECT_TRUE(names_both(found[0], "jog_wide", "run_left"));
    ASSERT_TRUE(found[0].fix);
}

TEST(lint, an_angle_just_above_the_limit_is_no_sliver) {
    // Isosceles over a base of 40 % of both axes' scale: height 5.5 % gives 15.4 deg, 5.2 % gives 14.6 deg.
    for (const auto& [height, acute] : {std::pair{5.5f, false}, std::pair{5.2f, true}}) {
        const Project project =
            make_plane({make_clip("a", 0, 0), make_clip("b", 0, 40), make_clip("c", height / 20, 20)}, 0, 5, 50);
        EXPECT_EQ(!of_rule(lint(project), "acute-triangle").empty(), acute) << height;
    }
}

TEST(lint, a_clip_slightly_off_an_axis_is_misaligned) {
    auto clips = without(clean_clips(), {"run"});
    for (const auto& [turn, misaligned] :
         {std::pair{0.8f, false}, std::pair{1.0f, true}, std::pair{8.9f, true}, std::pair{9.1f, false}}) {
        const LintResult result = lint_clips(with(clips, make_clip("run", 3, turn)));
        const auto found = of_rule(result, "misaligned");
        EXPECT_EQ(found.size(), misaligned ? 1u : 0u) << turn;
        if (misaligned) {
            EXPECT_TRUE(has_placeholder(result, PlaceholderKind::needed, 3, 0)) << turn;
        }
    }
}

TEST(lint, a_strafe_that_turns_by_itself_is_misaligned_where_no_axis_knows_turns) {
    for (const auto& [turn, misaligned] : {std::pair{4.9f, false}, std::pair{-5.1f, true}}) {
        std::vector<ProjectClip> clips{make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0),
                                       make_clip("strafe_left", 0, 0, 1), make_clip("strafe_right", 0, turn, -1)};
        const auto found = of_rule(lint(make_project(clips, {"forward,lateral"}), {}), "misaligned");
        ASSERT_EQ(found.size(), misaligned ? 1u : 0u) << turn;
        if (misaligned) {
            EXPECT_EQ(found[0].clips, std::vector<std::string>{"strafe_right"});
            EXPECT_EQ(found[0].fix->target, found[0].at) << "it stays where it is";
        }
    }
}

TEST(lint, samples_nearer_than_eight_percent_are_too_close) {
    for (const auto& [turn, close] : {std::pair{76.0f, true}, std::pair{75.0f, false}}) {  // 8 % of 180 is 14.4
        const LintResult result = lint_clips(with(clean_clips(), make_clip("walk_left_2", 1.4f, turn)));
        const auto found = of_rule(result, "too-close");
        ASSERT_EQ(found.size(), close ? 1u : 0u) << turn;
        if (close) {
            EXPECT_TRUE(names_both(found[0], "walk_left", "walk_left_2"));
        }
    }
}

TEST(lint, close_clips_are_redundant_or_conflicting_by_their_poses) {
    const Project project = make_plane(with(clean_clips(), make_clip("walk_left_2", 1.4f, 80)), -1.5f, 3, 90);
    const auto lint_with = [&](float metres) {
        std::vector<PoseTable> poses(project.clips.size());
        for (PoseTable& table : poses) {
            table.joints = 1;
            table.stepping = true;
            table.positions.assign(k_pose_phases, Vec3{});
        }
        poses.back().positions.assign(k_pose_phases, Vec3{metres, 0, 0});
        return lint(project, poses);
    };
    const auto redundant = of_rule(lint_with(0.14f), "too-close"), conflicting = of_rule(lint_with(0.16f), "too-close");
    ASSERT_EQ(redundant.size(), 1u);
    ASSERT_EQ(conflicting.size(), 1u);
    EXPECT_NE(redundant[0].message.find("redundant"), std::string::npos);
    EXPECT_EQ(redundant[0].severity, Severity::warning);
    EXPECT_NE(conflicting[0].message.find("conflicting"), std::string::npos);
    EXPECT_EQ(conflicting[0].severity, Severity::error);
    EXPECT_TRUE(of_rule(lint_with(0.24f), "dissimilar-neighbours").empty());
    EXPECT_FALSE(of_rule(lint_with(0.26f), "dissimilar-neighbours").empty());
}

TEST(lint, the_same_clip_twice_is_a_duplicate) {
    const Project project = make_plane(with(clean_clips(), make_clip("walk_again", 1.4f, 0.2f)), -1.5f, 3, 90);
    std::vector<PoseTable> poses(project.clips.size());
    for (PoseTable& table : poses) {
        table.joints = 1;
        table.positions.assign(k_pose_phases, Vec3{});
    }
    EXPECT_EQ(of_rule(lint(project, poses), "duplicate").size(), 1u);
    EXPECT_TRUE(of_rule(lint(project, poses), "too-close").empty());  // one finding a pair
    for (const auto& [metres, same] : {std::pair{0.019f, true}, std::pair{0.021f, false}}) {
        poses.back().positions.assign(k_pose_phases, Vec3{0, metres, 0});
        EXPECT_EQ(of_rule(lint(project, poses), "duplicate").size(), same ? 1u : 0u) << metres;
        EXPECT_EQ(of_rule(lint(project, poses), "too-close").size(), same ? 0u : 1u) << metres;
    }
    poses.back().positions.assign(k_pose_phases, Vec3{});
    for (const auto& [turn, same] : {std::pair{0.89f, true}, std::pair{0.91f, false}}) {  // 0.5 % of 180 is 0.9
        const Project near = make_plane(with(clean_clips(), make_clip("walk_again", 1.4f, turn)), -1.5f, 3, 90);
        EXPECT_EQ(of_rule(lint(near, poses), "duplicate").size(), same ? 1u : 0u) << turn;
    }
}

TEST(lint, corners_beyond_ten_percent_of_the_hull_are_uncovered) {
    const LintResult result = lint(make_plane(clean_clips(), -1.5f, 4, 90));  // nothing between 3 and 4 m/s
    const auto found = of_rule(result, "uncovered");
    ASSERT_EQ(found.size(), 3u);  // both corners and the end of the axis: 1 m/s of 5.5 is 18 %
    for (const Finding& finding : found) {
        EXPECT_EQ(finding.severity, Severity::info);
        EXPECT_NEAR(finding.at[0], 4, 1e-5);
    }
    EXPECT_TRUE(has_placeholder(result, PlaceholderKind::suggested, 4, 90));
    // 10 % of the range: 0.5 of 5 m/s.
    EXPECT_TRUE(of_rule(lint(make_plane(clean_clips(), -1.5f, 3.49f, 90)), "uncovered").empty());
    EXPECT_FALSE(of_rule(lint(make_plane(clean_clips(), -1.5f, 3.51f, 90)), "uncovered").empty());
}

TEST(lint, limits_that_were_only_rounded_out_have_no_uncovered_ends) {
    // 1.65 m/s is rounded out to 2, a sixth of the range away.
    Project project = make_project({make_clip("idle", 0, 0), make_clip("walk", 1.65f, 0)});
    EXPECT_TRUE(of_rule(lint(project), "uncovered").empty());
    project.spaces[0].axes_pinned = true;
    EXPECT_EQ(of_rule(lint(project), "uncovered").size(), 1u);
}

TEST(lint, blending_opposite_travel_is_an_error) {
    const LintResult result =
        lint_clips({make_clip("walk", 1.4f, 30), make_clip("back", -1.4f, 30), make_clip("turn", 0, -90)});
    const auto found = of_rule(result, "opposite-directions");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(names_both(found[0], "walk", "back"));
    const LintResult fine =
        lint_clips({make_clip("walk", 1.4f, 30), make_clip("turn", 0, 30), make_clip("idle", 0, 0)});
    EXPECT_TRUE(of_rule(fine, "opposite-directions").empty());
}

TEST(lint, strafes_are_told_apart_by_their_direction_of_travel) {
    const LintResult result =
        lint(make_project({make_clip("strafe_left", 0, 0, 1), make_clip("strafe_right", 0, 0, -1)}));
    EXPECT_EQ(of_rule(result, "opposite-directions").size(), 1u);  // no idle between them
    const LintResult fine = lint(make_project(
        {make_clip("idle", 0, 0), make_clip("strafe_left", 0, 0, 1), make_clip("strafe_right", 0, 0, -1)}));
    EXPECT_TRUE(of_rule(fine, "opposite-directions").empty());
    EXPECT_TRUE(of_rule(fine, "missing-axis-end").empty());
    const LintResult one = lint(make_project({make_clip("idle", 0, 0), make_clip("strafe_left", 0, 0, 1)}));
    EXPECT_EQ(of_rule(one, "missing-axis-end").size(), 1u);
}

TEST(lint, travels_just_less_than_a_hundred_and_twenty_degrees_apart_are_not_opposite) {
    for (const auto& [apart, opposite] : {std::pair{119.0f, false}, std::pair{121.0f, true}}) {
        const float half = apart / 2 / k_degrees_per_radian;
        const LintResult result = lint(make_project(
            {make_clip("to_left", cos(half), 0, sin(half)), make_clip("to_right", cos(half), 0, -sin(half))}));
        EXPECT_EQ(of_rule(result, "opposite-directions").size(), opposite ? 1u : 0u) << apart;
    }
}

TEST(lint, an_idle_within_five_percent_of_the_origin_counts) {
    // 5 % of 4.5 m/s is 0.225.
    for (const auto& [speed, missing] : {std::pair{0.22f, false}, std::pair{0.23f, true}}) {
        const LintResult result = lint_clips(with(without(clean_clips(), {"idle"}), make_clip("sway", speed, 0)));
        EXPECT_EQ(of_rule(result, "missing-idle").size(), missing ? 1u : 0u) << speed;
    }
}

TEST(lint, a_missing_idle_is_asked_for) {
    const LintResult result = lint_clips(without(clean_clips(), {"idle"}));
    ASSERT_EQ(of_rule(result, "missing-idle").size(), 1u);
    EXPECT_TRUE(has_placeholder(result, PlaceholderKind::needed, 0, 0));
    EXPECT_TRUE(of_rule(lint_clips(clean_clips()), "missing-idle").empty());
}

TEST(lint, samples_on_a_line_are_told_which_clip_opens_the_second_dimension) {
    const LintResult result =
        lint(make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 2), make_clip("run", 4, -1)}));
    const auto found = of_rule(result, "degenerate-space");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_NE(found[0].fix->text.find("turning 45 deg/s"), std::string::npos) << found[0].fix->text;
    int openings = 0;
    for (const Placeholder& p : result.placeholders)
        openings += p.rule == "degenerate-space" && p.axes == std::vector<std::string>{"speed", "turn"};
    EXPECT_EQ(openings, 2);
}

TEST(lint, clips_that_all_do_the_same_are_an_error) {
    const LintResult result = lint(make_project({make_clip("a", 1, 0), make_clip("b", 1, 0)}));
    const auto found = of_rule(result, "degenerate-space");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].severity, Severity::error);
    EXPECT_NE(found[0].message.find("All 2 clips"), std::string::npos);
}

TEST(lint, what_single_clips_bring_along_is_found_at_its_threshold) {
    struct Case {
        const char* rule;
        void (*spoil)(ClipFacts&, bool too_much);
    };
    const Case cases[] = {
        {"loop-pop", [](ClipFacts& f, bool much) { f.loop_error = much ? 0.031f : 0.029f; }},
        {"loop-pop", [](ClipFacts& f, bool much) { f.loop_error = 0.01f, f.seam_speed = much ? 0.31f : 0.29f; }},
        {"skating-clip", [](ClipFacts& f, bool much) { f.skate = much ? 0.11f : 0.09f; }},
        {"root-disagrees", [](ClipFacts& f, bool much) { f.root_disagreement_speed = much ? 0.15f : 0.13f; }},
        {"root-disagrees", [](ClipFacts& f, bool much) { f.root_disagreement_turn = much ? -11.0f : -9.0f; }},
        {"unit-suspect", [](ClipFacts& f, bool much) { f.hip_height = much ? 2.1f : 1.9f; }},
        {"unit-suspect", [](ClipFacts& f, bool much) { f.hip_height = much ? 0.29f : 0.31f; }},
        {"phase-mismatch",
         [](ClipFacts& f, bool much) {
             if (much) f.events.clear();
         }},
        {"phase-mismatch",  // three steps a loop; four are two strides
         [](ClipFacts& f, bool much) {
             f.events = {{Side::left, StrideEvent::strike, 0},
                         {Side::right, StrideEvent::strike, 0.3f},
                         {Side::left, StrideEvent::strike, 0.6f}};
             if (!much) f.events.push_back({Side::right, StrideEvent::strike, 0.8f});
         }},
        {"phase-mismatch",  // as many of either foot, and yet not in turn
         [](ClipFacts& f, bool much) {
             const Side second = much ? Side::left : Side::right, third = much ? Side::right : Side::left;
             f.events = {{Side::left, StrideEvent::strike, 0},
                         {second, StrideEvent::strike, 0.3f},
                         {third, StrideEvent::strike, 0.6f},
                         {Side::right, StrideEvent::strike, 0.8f}};
         }},
        {"phase-mismatch",  // on the spot
         [](ClipFacts& f, bool much) {
             f.speed = f.forward = 0, f.turn = much ? 45 : 0;
             f.events.clear();
         }},
        {"root-disagrees",
         [](ClipFacts& f, bool much) {
             f.speed = f.forward = 0, f.turn = 90;
             f.root_disagreement_turn = much ? 11.0f : 9.0f;
         }},
        {"root-disagrees",  // in place: the root was made from the feet
         [](ClipFacts& f, bool much) {
             f.root_disagreement_speed = 0.5f;
             f.in_place = !much;
         }},
    };
    for (const Case& c : cases)
        for (const bool much : {false, true}) {
            auto clips = clean_clips();
            c.spoil(clips[3].facts, much);
            const auto found = of_rule(lint_clips(clips), c.rule);
            ASSERT_EQ(found.size(), much ? 1u : 0u) << c.rule;
            if (much) {
                EXPECT_EQ(found[0].clips, std::vector<std::string>{"walk"});
            }
        }
}

TEST(lint, the_project_changes_thresholds_and_severities_and_turns_rules_off) {
    Project project = make_plane(without(clean_clips(), {"run", "idle"}), -1.5f, 3, 90);
    ASSERT_FALSE(of_rule(lint(project), "missing-idle").empty());
    project.lint["missing-idle"].enabled = false;
    project.lint["crossing-axis"].severity = Severity::info;
    project.lint["missing-axis-end"].thresholds["distance"] = 60;
    const LintResult result = lint(project);
    EXPECT_TRUE(of_rule(result, "missing-idle").empty());
    ASSERT_FALSE(of_rule(result, "crossing-axis").empty());
    EXPECT_EQ(of_rule(result, "crossing-axis")[0].severity, Severity::info);
    EXPECT_TRUE(of_rule(result, "missing-axis-end").empty());
    for (const Placeholder& p : result.placeholders) EXPECT_NE(p.rule, "missing-idle");
    project.lint["no-such-rule"].enabled = true;
    project.lint["uncovered"].thresholds["distnace"] = 1;
    EXPECT_EQ(lint(project).warnings.size(), 2u);
}

TEST(lint, a_motion_that_a_missing_axis_end_asks_for_is_not_uncovered_as_well) {
    Project project =
        make_plane(without(clean_clips(), {"turn_left", "walk_left", "run_left", "back_left"}), -1.5f, 3, 90);
    const auto at_turn = [&](const LintResult& result) {
        int count = 0;
        for (const Finding& finding : of_rule(result, "uncovered")) count += finding.at[0] == 0;
        return count;
    };
    EXPECT_EQ(at_turn(lint(project)), 0);
    project.lint["missing-axis-end"].enabled = false;
    EXPECT_EQ(at_turn(lint(project)), 1);
}

// Figure 1 of the paper: 16 clips with each of its five problems at a known place.
TEST(lint, the_layout_of_the_papers_first_figure_shows_each_problem_where_it_was_put) {
    const Project project =
        make_plane({make_clip("idle", 0, 0), make_clip("turn_left", 0, 150), make_clip("turn_right", 0, -150),
                    make_clip("walk", 1.6f, 0), make_clip("walk_left", 1.6f, 60), make_clip("walk_right", 1.6f, -60),
                    make_clip("back", -1.6f, 0), make_clip("back_left", -1.6f, 60), make_clip("back_right", -1.6f, -60),
                    make_clip("jog", 3.2f, 0), make_clip("run_astray", 5.4f, 6),  // (c) misaligned
                    make_clip("run_left", 4.4f, 90), make_clip("run_right", 4.4f, -90),
                    make_clip("jog_wide", 2.3f, 118),  // (b) almost on a long edge
                    make_clip("jog_right", 3.2f, -54), make_clip("trot_right", 3.6f, -45)},  // (d) too close
                   -2, 6, 180);
    const LintResult result = lint(project);

    const auto crossing = of_rule(result, "crossing-axis");  // (a) both sides of speed = 0
    ASSERT_EQ(crossing.size(), 2u);
    for (const Finding& finding : crossing) {
        EXPECT_TRUE(names_both(finding, "walk_left", "back_left") || names_both(finding, "walk_right", "back_right"));
        EXPECT_NEAR(finding.at[0], 0, 1e-5);
        EXPECT_NEAR(std::fabs(finding.at[1]), 60, 1e-3);
    }
    const auto acute = of_rule(result, "acute-triangle");
    ASSERT_EQ(acute.size(), 1u) << acute.back().message;
    EXPECT_TRUE(names_both(acute[0], "jog_wide", "turn_left") && names_both(acute[0], "jog_wide", "run_left"));
    const auto misaligned = of_rule(result, "misaligned");
    ASSERT_EQ(misaligned.size(), 1u);
    EXPECT_EQ(misaligned[0].clips, std::vector<std::string>{"run_astray"});
    EXPECT_TRUE(has_placeholder(result, PlaceholderKind::needed, 5.4f, 0));
    const auto close = of_rule(result, "too-close");
    ASSERT_EQ(close.size(), 1u);
    EXPECT_TRUE(names_both(close[0], "jog_right", "trot_right"));
    const auto uncovered = of_rule(result, "uncovered");
    std::set<std::pair<float, float>> places;
    for (const Finding& finding : uncovered) places.insert({finding.at[0], finding.at[1]});
    for (const float side : {-180.0f, 180.0f}) {
        EXPECT_TRUE(places.count({6, side}));
        EXPECT_TRUE(places.count({-2, side}));
        EXPECT_TRUE(has_placeholder(result, PlaceholderKind::suggested, 6, side));
    }
    EXPECT_FALSE(places.count({6, 0}));
    EXPECT_FALSE(places.count({-2, 0}));
    EXPECT_TRUE(of_rule(result, "missing-idle").empty());
}

}  // namespace
}  // namespace surefoot
