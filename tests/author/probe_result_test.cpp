#include "support.h"

#include <surefoot/base/error.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

ProbeCell make_cell(std::vector<int> grid, std::vector<float> at, float speed_error, float skate, float source_skate) {
    ProbeCell cell;
    cell.grid = std::move(grid);
    cell.at = std::move(at);
    cell.shares = {{0, 0.75f}, {1, 0.25f}};
    cell.standing = 0.9f;
    cell.forward = 1.25f, cell.lateral = 0.0125f, cell.turn = -3.5f;
    cell.blend[ProbeFigure::speed] = speed_error;
    cell.blend[ProbeFigure::skate] = skate;
    cell.blend[ProbeFigure::leg_gap] = skate - 2;
    cell.sources[ProbeFigure::skate] = source_skate;
    return cell;
}

ProbeResult make_result() {
    ProbeSpace space;
    space.name = "facing";
    space.axes = {{"speed", "m/s", 0, 2, 3}, {"turn", "deg/s", -90, 90, 3}};
    space.clips = {"idle", "walk"};
    space.cells = {make_cell({0, 1}, {0, 0}, 1.5f, 1, 2), make_cell({1, 1}, {1, 0}, -2.5f, 5, 2)};
    return {{space}};
}

TEST(probe_result, mean_and_worst_are_of_sizes_and_name_the_cell) {
    const ProbeResult result = make_result();
    const ProbeStat speed = probe_stat(result.spaces, ProbeFigure::speed);
    EXPECT_DOUBLE_EQ(speed.mean, 2);
    EXPECT_DOUBLE_EQ(speed.worst, -2.5);
    EXPECT_EQ(speed.cell, 1);
    EXPECT_DOUBLE_EQ(probe_stat(result.spaces, ProbeFigure::skate).added, 2);
    const ProbeStat gap = probe_stat(result.spaces, ProbeFigure::leg_gap);
    EXPECT_DOUBLE_EQ(gap.mean, 1);
    EXPECT_DOUBLE_EQ(gap.worst, -1) << "the narrowest gap is the worst";
    EXPECT_EQ(gap.cell, 0);
    EXPECT_DOUBLE_EQ(skate_ratio(result.spaces), 1.5);
}

TEST(probe_result, a_cell_where_no_foot_stands_is_counted_as_unmeasured_and_not_as_perfect) {
    ProbeResult result = make_result();
    result.spaces[0].cells[0].standing = 0;
    EXPECT_EQ(unmeasured_cells(result.spaces), 1);
    EXPECT_DOUBLE_EQ(probe_stat(result.spaces, ProbeFigure::speed).mean, 2.5);
    EXPECT_NE(probe_json(result).find("\"speed_error_pct\": null"), std::string::npos);
    EXPECT_NE(probe_table(result).find("in 1 blends no foot ever stands"), std::string::npos);
}

TEST(probe_result, nothing_probed_is_an_empty_object_and_no_worst_cell) {
    EXPECT_EQ(probe_json({}), "{}\n");
    EXPECT_EQ(probe_stat({}, ProbeFigure::skate).cell, -1);
    EXPECT_EQ(skate_ratio({}), 0);
    EXPECT_NE(findings_json({}).find("\"probe\": {}"), std::string::npos);
}

TEST(probe_result, before_and_after_come_back_from_the_project_file) {
    Project project = test::make_project({test::make_clip("idle", 0, 0), test::make_clip("walk", 1.4f, 0)});
    EXPECT_EQ(project_json(project).find("\"probe\""), std::string::npos);
    project.probe = make_result();
    project.probe_before = make_result();
    project.probe_before->spaces[0].cells[1].blend[ProbeFigure::turn] = 12.3f;
    const std::string text = project_json(project);
    std::vector<std::string> warnings;
    const Project again = parse_project(text, "p.json", &warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_TRUE(again == project);
    EXPECT_EQ(project_json(again), text);
}

TEST(probe_result, a_file_with_a_wrong_cell_is_refused_at_its_place) {
    Project project = test::make_project({test::make_clip("idle", 0, 0), test::make_clip("walk", 1.4f, 0)});
    project.probe = make_result();
    std::string text = project_json(project);
    const std::string good = "\"standing_share\": 0.9";
    text.replace(text.find(good), good.size(), "\"standing_share\": \"all\"");
    try {
        parse_project(text, "p.json");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("/probe/spaces/0/cells/0/standing_share"), std::string::npos)
            << error.what();
    }
}

TEST(probe_result, the_table_names_the_worst_blend_with_its_clips_and_compares_before_with_after) {
    const ProbeResult result = make_result();
    const std::string alone = probe_table(result);
    EXPECT_NE(alone.find("-2.5 % at facing: 1.00 m/s, 0.00 deg/s (idle 75 %, walk 25 %)"), std::string::npos) << alone;
    EXPECT_EQ(alone.find("before"), std::string::npos);
    ProbeResult before = result;
    before.spaces[0].cells[1].blend[ProbeFigure::speed] = -40;
    const std::string both = probe_table(result, &before);
    EXPECT_NE(both.find("-40.0"), std::string::npos) << both;
    EXPECT_NE(both.find("-2.5"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
