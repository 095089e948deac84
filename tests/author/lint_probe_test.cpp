#include "support.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::make_clip;
using test::of_rule;

/// A sound project with one probed space of three cells between two clips, all figures at rest.
Project probed() {
    Project project = test::make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0)});
    ProbeSpace space;
    space.name = "facing";
    space.axes = {{"speed", "m/s", 0, 1.5f, 3}};
    space.clips = {"idle", "walk"};
    for (int i = 0; i < 3; ++i) {
        ProbeCell cell;
        cell.grid = {i};
        cell.at = {0.75f * static_cast<float>(i)};
        cell.shares = i == 0 ? std::vector<ProbeShare>{{0, 1}} : std::vector<ProbeShare>{{1, 0.75f}, {0, 0.25f}};
        cell.standing = 1;
        cell.blend[ProbeFigure::skate] = cell.sources[ProbeFigure::skate] = 10;
        cell.blend[ProbeFigure::knee_peak] = cell.sources[ProbeFigure::knee_peak] = 4000;
        cell.blend[ProbeFigure::leg_gap] = cell.sources[ProbeFigure::leg_gap] = 5;
        space.cells.push_back(cell);
    }
    project.probe.spaces = {space};
    return project;
}

/// Findings of a rule where one figure of the middle cell is `value`.
std::vector<Finding> with(const char* rule, ProbeFigure figure, float value) {
    Project project = probed();
    project.probe.spaces[0].cells[1].blend[figure] = value;
    return of_rule(lint(project), rule);
}

TEST(lint_probe, figures_at_rest_give_no_finding) {
    for (const Finding& finding : lint(probed()).findings) EXPECT_NE(finding.rule.rfind("probe-", 0), 0u);
}

TEST(lint_probe, every_rule_speaks_just_beyond_its_threshold_and_not_just_below) {
    struct Case {
        const char* rule;
        ProbeFigure figure;
        float below, beyond;
    };
    const Case cases[] = {
        {"probe-speed", ProbeFigure::speed, 9.9f, 10.1f},
        {"probe-speed", ProbeFigure::speed, -9.9f, -10.1f},
        {"probe-speed", ProbeFigure::lateral, -9.9f, -10.1f},
        {"probe-turn", ProbeFigure::turn, 9.9f, 10.1f},
        {"probe-turn", ProbeFigure::turn, -9.9f, -10.1f},
        {"probe-skate", ProbeFigure::skate, 14.9f, 15.1f},
        {"probe-knee", ProbeFigure::knee_peak, 7990.0f, 8010.0f},
        {"probe-legs-cross", ProbeFigure::leg_gap, -0.9f, -1.1f},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.rule);
        EXPECT_TRUE(with(c.rule, c.figure, c.below).empty());
        const auto found = with(c.rule, c.figure, c.beyond);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].severity, Severity::warning);
        EXPECT_EQ(found[0].space, "facing");
        EXPECT_EQ(found[0].at, std::vector<float>{0.75f});
        EXPECT_EQ(found[0].clips, (std::vector<std::string>{"walk", "idle"})) << "the heaviest first";
        ASSERT_TRUE(found[0].fix);
        EXPECT_EQ(found[0].fix->target, found[0].at);
        EXPECT_NE(found[0].message.find("At speed 0.75 m/s"), std::string::npos) << found[0].message;
    }
}

TEST(lint_probe, what_the_clips_do_themselves_is_not_blamed_on_the_blend) {
    Project project = probed();
    ProbeCell& cell = project.probe.spaces[0].cells[1];
    cell.blend[ProbeFigure::leg_gap] = -4, cell.sources[ProbeFigure::leg_gap] = -3.5f;
    cell.blend[ProbeFigure::speed] = -14, cell.sources[ProbeFigure::speed] = -5;
    cell.blend[ProbeFigure::turn] = 19, cell.sources[ProbeFigure::turn] = 12;
    cell.blend[ProbeFigure::skate] = 2, cell.sources[ProbeFigure::skate] = 0.5f;  // four times, and nobody sees it
    cell.blend[ProbeFigure::knee_peak] = 900, cell.sources[ProbeFigure::knee_peak] = 100;
    for (const Finding& finding : lint(project).findings) EXPECT_NE(finding.rule.rfind("probe-", 0), 0u);
}

TEST(lint_probe, cells_of_the_same_clips_are_one_finding_at_the_worst_of_them) {
    Project project = probed();
    project.probe.spaces[0].cells[0].blend[ProbeFigure::speed] = 30;
    project.probe.spaces[0].cells[1].blend[ProbeFigure::speed] = 12;
    project.probe.spaces[0].cells[2].blend[ProbeFigure::speed] = -25;
    const auto found = of_rule(lint(project), "probe-speed");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].clips, std::vector<std::string>{"idle"});
    EXPECT_EQ(found[1].at, std::vector<float>{1.5f});
    EXPECT_NE(found[1].message.find("25 % slower"), std::string::npos) << found[1].message;
    EXPECT_NE(found[1].message.find("2 of 3 blends"), std::string::npos) << found[1].message;
}

TEST(lint_probe, a_blend_in_which_no_foot_stands_is_a_finding) {
    Project project = probed();
    ProbeCell& cell = project.probe.spaces[0].cells[1];
    cell.standing = 0;
    cell.blend = cell.sources = {};
    const auto found = of_rule(lint(project), "probe-skate");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].message.find("no foot ever stands"), std::string::npos) << found[0].message;
}

}  // namespace
}  // namespace surefoot
