// The rules in spaces of one, three and four dimensions.
#include "support.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_space;
using test::names_both;
using test::of_rule;
using test::pin_clip;

const Axis k_speed{"speed", "m/s", 0, 10, false}, k_turn{"turn", "deg/s", -50, 50, false},
    k_slope{"slope", "deg", -50, 50, false}, k_lateral{"lateral", "m/s", -50, 50, false};

/// Four corners of a flat cell: an equilateral base of 40 % a side, and a tip `height` percent over its middle.
std::vector<ProjectClip> flat_tetrahedron(float height) {
    return {pin_clip("base_a", "facing", {3, 0, 0}), pin_clip("base_b", "facing", {7, 0, 0}),
            pin_clip("base_c", "facing", {5, 34.641f, 0}), pin_clip("tip", "facing", {5, 11.547f, height})};
}

/// Five corners: a regular tetrahedron of 40 % a side and a tip over its middle.
std::vector<ProjectClip> flat_cell_of_four_dimensions(float height) {
    return {pin_clip("base_a", "lateral", {7, 0, -14.142f, 0}), pin_clip("base_b", "lateral", {3, 0, -14.142f, 0}),
            pin_clip("base_c", "lateral", {5, 20, 14.142f, 0}), pin_clip("base_d", "lateral", {5, -20, 14.142f, 0}),
            pin_clip("tip", "lateral", {5, 0, 0, height})};
}

TEST(lint_dimensions, a_sliver_tetrahedron_is_told_by_its_dihedral_angle) {
    // Its sides meet the base at atan(height / 11.547): 15.5 and 14.6 deg.
    for (const auto& [height, acute] : {std::pair{3.2f, false}, std::pair{3.0f, true}}) {
        const auto found =
            of_rule(lint(make_space(flat_tetrahedron(height), {k_speed, k_turn, k_slope})), "acute-triangle");
        ASSERT_EQ(found.size(), acute ? 1u : 0u) << height;
        if (!acute) continue;
        EXPECT_EQ(found[0].clips.size(), 4u);
        EXPECT_NE(found[0].message.find("\"tip\" is so near"), std::string::npos) << found[0].message;
        EXPECT_NE(found[0].message.find("14.6 deg"), std::string::npos) << found[0].message;
        ASSERT_TRUE(found[0].fix);
    }
}

TEST(lint_dimensions, a_sliver_of_four_dimensions_is_told_in_the_same_way) {
    // atan(height / 8.165): 15.7 and 14.4 deg.
    for (const auto& [height, acute] : {std::pair{2.3f, false}, std::pair{2.1f, true}}) {
        const auto found =
            of_rule(lint(make_space(flat_cell_of_four_dimensions(height), {k_speed, k_turn, k_slope, k_lateral})),
                    "acute-triangle");
        ASSERT_EQ(found.size(), acute ? 1u : 0u) << height;
        if (!acute) continue;
        EXPECT_EQ(found[0].clips.size(), 5u);
        EXPECT_NE(found[0].message.find("14.4 deg"), std::string::npos) << found[0].message;
    }
}

TEST(lint_dimensions, slivers_around_one_clip_are_one_finding) {
    // A tip that nearly lies in the face of two large cells makes several flat ones.
    std::vector<ProjectClip> clips;
    for (const float speed : {0.0f, 10.0f})
        for (const float turn : {-50.0f, 50.0f})
            for (const float slope : {-50.0f, 50.0f})
                clips.push_back(pin_clip("corner" + std::to_string(clips.size()), "facing", {speed, turn, slope}));
    clips.push_back(pin_clip("tip", "facing", {4, 10, 47}));
    const auto found = of_rule(lint(make_space(clips, {k_speed, k_turn, k_slope})), "acute-triangle");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].message.find("flat cells"), std::string::npos) << found[0].message;
}

TEST(lint_dimensions, an_edge_across_level_ground_needs_a_clip_that_walks_on_the_level) {
    const auto walk = [](const char* name, float speed, float turn, float slope) {
        return pin_clip(name, "facing", {speed, turn, slope});
    };
    std::vector<ProjectClip> clips{walk("idle", 0, 0, 0), walk("up", 2, 0, 20), walk("down", 2, 0, -20),
                                   walk("left", 2, 30, 0), walk("right", 2, -30, 0)};
    const auto crossing = [&](const std::vector<ProjectClip>& set) {
        return of_rule(lint(make_space(set, {{"speed", "m/s", 0, 2, false}, k_turn, k_slope})), "crossing-axis");
    };
    const auto found = crossing(clips);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(names_both(found[0], "up", "down") || names_both(found[0], "left", "right"));
    EXPECT_EQ(found[0].at, (std::vector<float>{2, 0, 0}));
    clips.push_back(walk("walk", 2, 0, 0));
    EXPECT_TRUE(crossing(clips).empty());
}

TEST(lint_dimensions, a_slope_slightly_off_the_level_is_misaligned) {
    for (const auto& [slope, misaligned] :
         {std::pair{0.4f, false}, std::pair{0.6f, true}, std::pair{4.9f, true}, std::pair{5.1f, false}}) {
        const auto found =
            of_rule(lint(make_space({pin_clip("idle", "facing", {0, 0, 0}), pin_clip("up", "facing", {5, 0, 40}),
                                     pin_clip("left", "facing", {5, 40, 0}), pin_clip("walk", "facing", {8, 0, slope})},
                                    {k_speed, k_turn, k_slope})),
                    "misaligned");
        ASSERT_EQ(found.size(), misaligned ? 1u : 0u) << slope;
        if (misaligned) {
            EXPECT_EQ(found[0].fix->target, (std::vector<float>{8, 0, 0}));
        }
    }
}

TEST(lint_dimensions, distances_count_every_axis) {
    // 4.6 % along three axes is 7.97 % in all, 4.7 % is 8.14 %.
    for (const auto& [step, close] : {std::pair{4.6f, true}, std::pair{4.7f, false}}) {
        const auto found =
            of_rule(lint(make_space({pin_clip("idle", "facing", {0, 0, 0}), pin_clip("up", "facing", {5, 0, 40}),
                                     pin_clip("left", "facing", {5, 40, 0}), pin_clip("one", "facing", {7, 10, 10}),
                                     pin_clip("two", "facing", {7 + step / 10, 10 + step, 10 + step})},
                                    {k_speed, k_turn, k_slope})),
                    "too-close");
        EXPECT_EQ(found.size(), close ? 1u : 0u) << step;
    }
}

TEST(lint_dimensions, an_idle_on_a_slope_is_an_idle) {
    const std::vector<Axis> axes{k_speed, k_turn, k_slope};
    std::vector<ProjectClip> clips{pin_clip("stand_uphill", "facing", {0, 0, 20}),
                                   pin_clip("walk", "facing", {5, 0, 0}), pin_clip("left", "facing", {5, 40, 0}),
                                   pin_clip("up", "facing", {5, 0, 20})};
    EXPECT_TRUE(of_rule(lint(make_space(clips, axes)), "missing-idle").empty());
    clips[0] = pin_clip("turn", "facing", {0, 20, 0});
    EXPECT_EQ(of_rule(lint(make_space(clips, axes)), "missing-idle").size(), 1u);
}

TEST(lint_dimensions, samples_in_one_plane_of_a_space_of_three_are_told_which_axis_is_flat) {
    std::vector<ProjectClip> clips{pin_clip("idle", "facing", {0, 0, 0}), pin_clip("walk", "facing", {5, 0, 0}),
                                   pin_clip("left", "facing", {5, 40, 0}), pin_clip("right", "facing", {5, -40, 0})};
    const std::vector<Axis> axes{k_speed, k_turn, k_slope};
    const auto found = of_rule(lint(make_space(clips, axes)), "degenerate-space");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_NE(found[0].message.find("one plane (no two of them differ in slope)"), std::string::npos)
        << found[0].message;
    clips[2].pins[0].values[2] = 1;
    EXPECT_TRUE(of_rule(lint(make_space(clips, axes)), "degenerate-space").empty());
}

TEST(lint_dimensions, corners_of_a_space_of_three_are_looked_at) {
    // A box that reaches 10 % below the highest slope, or a little less.
    for (const auto& [highest, uncovered] : {std::pair{40.1f, 0u}, std::pair{39.9f, 4u}}) {
        std::vector<ProjectClip> clips;
        for (const float speed : {0.0f, 10.0f})
            for (const float turn : {-50.0f, 50.0f})
                for (const float slope : {-50.0f, highest})
                    clips.push_back(pin_clip("clip" + std::to_string(clips.size()), "facing", {speed, turn, slope}));
        const auto found = of_rule(lint(make_space(clips, {k_speed, k_turn, k_slope})), "uncovered");
        EXPECT_EQ(found.size(), uncovered);
        for (const Finding& finding : found) EXPECT_EQ(finding.at[2], 50);
    }
}

TEST(lint_dimensions, the_end_of_a_line_is_uncovered_beyond_ten_percent) {
    for (const auto& [fastest, uncovered] : {std::pair{9.05f, 0u}, std::pair{8.95f, 1u}}) {
        const auto found =
            of_rule(lint(make_space({make_clip("idle", 0, 0), make_clip("run", fastest, 0)}, {k_speed})), "uncovered");
        ASSERT_EQ(found.size(), uncovered) << fastest;
        if (uncovered) {
            EXPECT_EQ(found[0].at, std::vector<float>{10});
        }
    }
}

TEST(lint_dimensions, a_line_crosses_its_axis_where_nothing_stands_between) {
    const std::vector<Axis> axes{{"speed", "m/s", -2, 2, false}};
    std::vector<ProjectClip> clips{make_clip("walk", 1.4f, 0), make_clip("back", -1.4f, 0)};
    const auto found = of_rule(lint(make_space(clips, axes)), "crossing-axis");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].at, std::vector<float>{0});
    clips.push_back(make_clip("idle", 0, 0));
    EXPECT_TRUE(of_rule(lint(make_space(clips, axes)), "crossing-axis").empty());
}

TEST(lint_dimensions, sideways_clips_alone_need_straight_ahead_too) {
    const std::vector<Axis> axes{{"forward", "m/s", -1, 2, false}, {"lateral", "m/s", -1, 1, false}};
    std::vector<ProjectClip> clips{make_clip("idle", 0, 0), make_clip("left", 1, 0, 0.9f),
                                   make_clip("right", 1, 0, -0.9f), make_clip("back", -1, 0)};
    const auto ends = [&] { return of_rule(lint(make_space(clips, axes)), "missing-axis-end"); };
    ASSERT_EQ(ends().size(), 3u);  // ahead, and straight to either side
    EXPECT_EQ(ends()[0].at, (std::vector<float>{1, 0}));
    clips.push_back(make_clip("walk", 1, 0));
    EXPECT_EQ(ends().size(), 2u);
}

}  // namespace
}  // namespace surefoot
