#include "support.h"

#include <surefoot/author/space_slice_svg.h>

#include <gtest/gtest.h>

#include <set>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_project;
using test::pin_clip;

/// Two speeds, two turns, two slopes, two styles, and a clip in the middle of them.
Project wide_project(const std::string& axes) {
    std::vector<ProjectClip> clips;
    const auto add = [&](float speed, float turn, float slope, float style) {
        ProjectClip clip = make_clip("clip" + std::to_string(clips.size()), speed, turn);
        clip.facts.slope = slope;
        clip.facts.custom["style"] = style;
        clips.push_back(clip);
    };
    for (const float speed : {0.5f, 3.0f})
        for (const float turn : {-60.0f, 60.0f})
            for (const float slope : {-10.0f, 10.0f})
                for (const float style : {0.0f, 1.0f}) add(speed, turn, slope, style);
    add(1.6f, 5, 1, 0.45f);
    return make_project(clips, {axes});
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(space_slice_svg, three_and_four_dimensions_are_shown_along_every_pair_of_axes) {
    for (const auto& [axes, views] :
         {std::pair{"speed,turn", 1}, {"speed,turn,style", 5}, {"speed,turn,slope,style", 8}}) {
        const Project project = wide_project(axes);
        const BlendSpace& space = project.spaces[0].space;
        const std::vector<SliceView> slices = default_slices(space);
        EXPECT_EQ(static_cast<int>(slices.size()), views) << axes;
        std::set<std::pair<int, int>> pairs;
        for (const SliceView& view : slices) {
            EXPECT_NE(view.across, view.up);
            pairs.insert(std::minmax(view.across, view.up));
            EXPECT_FALSE(slice(space, view.at, view.across, view.up).cells.empty());
        }
        const auto d = static_cast<std::size_t>(space.dimensions());
        EXPECT_EQ(pairs.size(), d * (d - 1) / 2);
    }
    EXPECT_TRUE(default_slices(wide_project("speed").spaces[0].space).empty());
}

TEST(space_slice_svg, slices_go_through_the_clips_where_the_middle_is_empty) {
    // One corner of a box: its middle is outside.
    const Project project =
        test::make_space({pin_clip("a", "facing", {0, 0, 0}), pin_clip("b", "facing", {2, 0, 0}),
                          pin_clip("c", "facing", {0, 90, 0}), pin_clip("d", "facing", {0, 0, 10})},
                         {{"speed", "m/s", 0, 2}, {"turn", "deg/s", 0, 90}, {"slope", "deg", 0, 10}});
    const BlendSpace& space = project.spaces[0].space;
    EXPECT_TRUE(blend_weights(space, {1, 45, 5}).clamped);
    for (const SliceView& view : default_slices(space)) {
        EXPECT_FALSE(blend_weights(space, view.at).clamped);
        EXPECT_GE(slice(space, view.at, view.across, view.up).live_cell, 0);
    }
}

TEST(space_slice_svg, cells_live_cell_and_weights_are_drawn_as_the_slice_says) {
    const Project project = wide_project("speed,turn,slope,style");
    const ProjectSpace& space = project.spaces[0];
    for (const SliceView& view : default_slices(space.space)) {
        const SpaceSlice cut = slice(space.space, view.at, view.across, view.up);
        const std::string svg = space_slice_svg(project, space, view);
        EXPECT_EQ(count_of(svg, "class=\"live-cell\""), cut.live_cell >= 0 ? 1u : 0u);
        EXPECT_EQ(count_of(svg, "class=\"triangle\"") + count_of(svg, "class=\"live-cell\""), cut.cells.size());
        EXPECT_EQ(count_of(svg, "class=\"live-line"), static_cast<std::size_t>(cut.live.count));
        EXPECT_EQ(count_of(svg, "<circle class=\"sample"), space.clips.size());
        for (int n = 0; n < cut.live.count; ++n)
            EXPECT_NE(svg.find(" %  " + project.clips[space.clips[cut.live.samples[n]]].name), std::string::npos);
        EXPECT_NE(svg.find(">held<"), std::string::npos);
        EXPECT_EQ(svg, space_slice_svg(project, space, view));
    }
}

TEST(space_slice_svg, names_are_escaped_and_places_outside_still_drawn) {
    Project project = wide_project("speed,turn,style");
    for (ProjectClip& clip : project.clips) clip.name = "<" + clip.name + "&";
    const std::string svg = space_slice_svg(project, project.spaces[0], {{9, 300, 5}, 1, 0});
    EXPECT_EQ(svg.find("<clip"), std::string::npos);
    EXPECT_NE(svg.find("&lt;clip"), std::string::npos);
    EXPECT_NE(svg.find("outside: nearest"), std::string::npos);
    EXPECT_EQ(count_of(svg, "live-cell"), 0u);
}

TEST(space_slice_svg, what_is_held_is_told_in_words) {
    const Project project = wide_project("speed,turn,slope,style");
    EXPECT_EQ(describe_slice(project.spaces[0].space, {{1, 0, 5, 0.25f}, 1, 0}), "5 deg uphill, style 0.25");
}

TEST(space_slice_svg, an_axis_held_at_zero_is_named) {
    const Project project = make_project({make_clip("walk", 1, 0), make_clip("run", 3, 0), make_clip("left", 1, 60),
                                          make_clip("aside", 1, 10, 0.6f), make_clip("away", 1, 10, -0.6f)},
                                         {"speed,turn,lateral"});
    const SliceView view{{1.5f, 5, 0}, 1, 0};
    EXPECT_EQ(describe_slice(project.spaces[0].space, view), "lateral 0");
    EXPECT_NE(space_slice_svg(project, project.spaces[0], view).find("lateral 0"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
