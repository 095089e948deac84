#include "support.h"

#include <surefoot/author/probe_forecast.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_plane;

std::vector<ProjectClip> clips_with(const std::vector<ProjectClip>& more) {
    std::vector<ProjectClip> clips{make_clip("idle", 0, 0), make_clip("left", 0, 90), make_clip("right", 0, -90),
                                   make_clip("walk", 1.5f, 0)};
    clips.insert(clips.end(), more.begin(), more.end());
    return clips;
}

Project plane(const std::vector<ProjectClip>& more = {}) { return make_plane(clips_with(more), 0, 2, 90); }

/// Every blend that turns left is as wrong as lint minds, the others are right.
Project probed() {
    Project project = plane();
    ProbeSpace space;
    space.name = "facing";
    space.axes = {{"speed", "m/s", 0, 2, 9}, {"turn", "deg/s", -90, 90, 9}};
    space.clips = {"idle", "left", "right", "walk"};
    std::vector<int> index(2);
    do {
        ProbeCell cell;
        cell.grid = index;
        cell.at = {grid_value(space.axes[0], index[0]), grid_value(space.axes[1], index[1])};
        cell.standing = 1;
        cell.shares = {{0, 1}};
        if (cell.at[1] > 0) cell.blend[ProbeFigure::speed] = 10;
        if (!blend_weights(project.spaces[0].space, {cell.at[0], cell.at[1]}).clamped) space.cells.push_back(cell);
    } while (next_grid_point(index, space.axes));
    project.probe.spaces = {space};
    return project;
}

TEST(probe_forecast, a_space_left_as_it_is_has_the_errors_that_were_measured_and_its_bare_places) {
    const Project project = probed();
    double wrong = 0;
    for (const ProbeCell& cell : project.probe.spaces[0].cells) wrong += cell.at[1] > 0 ? 1 : 0;
    const double bare = 81 - static_cast<double>(project.probe.spaces[0].cells.size());
    EXPECT_GT(wrong, 5);
    EXPECT_NEAR(forecast_error(project, project), wrong + bare, 1e-6);
}

TEST(probe_forecast, a_clip_among_wrong_blends_is_worth_more_than_one_among_right_ones) {
    const Project project = probed();
    const double as_is = forecast_error(project, project);
    const double among_wrong = forecast_error(project, plane({make_clip("walk_left", 0.7f, 40)}));
    const double among_right = forecast_error(project, plane({make_clip("walk_right", 0.7f, -40)}));
    EXPECT_LT(among_wrong, as_is - 2);
    EXPECT_NEAR(among_right, as_is, 1e-6);
}

TEST(probe_forecast, a_clip_beyond_the_hull_is_worth_the_places_it_covers) {
    const Project project = probed();
    const double as_is = forecast_error(project, project);
    const double corner = forecast_error(project, plane({make_clip("jog_right", 2, -90)}));
    const double tip = forecast_error(project, plane({make_clip("jog", 2, 0)}));
    EXPECT_LT(tip, as_is);
    EXPECT_LT(corner, tip) << "the corner opens more than the tip";
}

TEST(probe_forecast, of_other_axes_nothing_is_told_and_without_a_probe_nothing_at_all) {
    Project project = probed();
    Project other = plane({make_clip("walk_left", 0.7f, 40)});
    other.spaces[0].space.axes[1].name = "lateral";
    EXPECT_EQ(forecast_error(project, other), forecast_error(project, project));
    project.probe = {};
    EXPECT_EQ(forecast_error(project, project), 0);
}

}  // namespace
}  // namespace surefoot
