#include "support.h"

#include <surefoot/base/error.h>
#include <surefoot/space/lock_edge.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_project;

Axis limits_of(const char* name, std::vector<float> values) {
    Axis axis = make_axis(name);
    set_limits(axis, values);
    return axis;
}

TEST(place, limits_are_rounded_out_to_steps_a_person_would_choose) {
    EXPECT_EQ(limits_of("speed", {0, 1.37f}).high, 1.5f);
    EXPECT_EQ(limits_of("speed", {0, 1.37f}).low, 0.0f);
    EXPECT_EQ(limits_of("speed", {1.5f}).high, 1.5f);
    EXPECT_EQ(limits_of("speed", {-0.8f, 5.98f}).low, -1.0f);
    EXPECT_EQ(limits_of("turn", {10}).high, 90.0f);
    EXPECT_EQ(limits_of("turn", {-100}).low, -120.0f);
    EXPECT_EQ(limits_of("turn", {-100}).high, 120.0f);
    EXPECT_EQ(limits_of("lateral", {0.9f}).low, -1.0f);
}

TEST(place, clips_that_face_where_they_go_and_strafes_go_to_spaces_of_their_own) {
    const Project project =
        make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0), make_clip("slant", 1.4f, 0, 0.7f),
                      make_clip("left", 1.2f, 60), make_clip("back", -1, 0), make_clip("strafe", 0, 0, 1),
                      make_clip("diagonal", 0.9f, 0, 0.8f), make_clip("turn", 0, 90)});
    ASSERT_EQ(project.spaces.size(), 2u);
    const ProjectSpace &facing = project.spaces[0], &lateral = project.spaces[1];
    EXPECT_EQ(facing.name, "facing");
    EXPECT_EQ(facing.clips, (std::vector<int>{0, 1, 2, 3, 4, 7}));  // 27 degrees off is still facing
    EXPECT_EQ(lateral.name, "lateral");
    EXPECT_EQ(lateral.clips, (std::vector<int>{0, 5, 6}));  // the idle is shared
    EXPECT_EQ(lateral.space.dimensions(), 2);
    EXPECT_EQ(problem(facing.space), "");
    EXPECT_EQ(problem(lateral.space), "");
}

TEST(place, clips_that_do_not_turn_span_one_dimension) {
    const Project project =
        make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 3), make_clip("run", 4, -6)});
    ASSERT_EQ(project.spaces.size(), 1u);
    ASSERT_EQ(project.spaces[0].space.dimensions(), 1);
    EXPECT_EQ(project.spaces[0].space.axes[0].name, "speed");
    EXPECT_EQ(project.spaces[0].space.simplices.size(), 2u);
    const Project turned =
        make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 3), make_clip("run", 4, -12)});
    EXPECT_EQ(turned.spaces[0].space.dimensions(), 2);
}

TEST(place, a_running_treadmill_clips_turn_is_doubted) {
    auto clips = std::vector{make_clip("idle", 0, 0), make_clip("walk", 1.4f, 3), make_clip("run", 5, -20)};
    clips[2].facts.in_place = true;
    EXPECT_EQ(make_project(clips).spaces[0].space.dimensions(), 1);
    clips[2].facts.in_place = false;
    EXPECT_EQ(make_project(clips).spaces[0].space.dimensions(), 2);
}

TEST(place, strafes_alone_make_a_lateral_line) {
    const Project project =
        make_project({make_clip("idle", 0, 0), make_clip("l", 0.1f, 0, 1), make_clip("r", 0.05f, 0, -1)});
    ASSERT_EQ(project.spaces.size(), 1u);
    EXPECT_EQ(project.spaces[0].name, "lateral");
    ASSERT_EQ(project.spaces[0].space.dimensions(), 1);
    EXPECT_EQ(project.spaces[0].space.axes[0].name, "lateral");
}

TEST(place, an_idle_stands_exactly_at_the_origin_however_it_drifts) {
    const Project project = make_project({make_clip("idle", 0.03f, 2), make_clip("walk", 1.4f, 60)});
    EXPECT_EQ(project.spaces[0].space.samples[0], SpacePoint{});
}

TEST(place, what_the_user_pinned_is_kept) {
    std::vector<ProjectClip> clips{make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0), make_clip("left", 1.4f, 60),
                                   make_clip("right", 1.4f, -60), make_clip("run", 4, 0)};
    Project before = make_project(clips);
    before.spaces[0].axes_pinned = true;
    before.spaces[0].space.axes[0].high = 7;
    ASSERT_FALSE(has_edge(before.spaces[0].space, 0, 4));
    before.spaces[0].locked_edges = {{2, 4}, {0, 1}};
    Project after;
    after.clips = clips;
    after.clips[4].pins = {{"facing", {5, 0}}, {"lateral", {1}}};
    std::vector<std::string> warnings;
    place_clips(after, {}, &before, warnings);
    EXPECT_EQ(after.spaces[0].space.axes[0].high, 7);
    EXPECT_TRUE(after.spaces[0].axes_pinned);
    EXPECT_EQ(after.spaces[0].space.samples[4][0], 5);
    EXPECT_EQ(after.spaces[0].locked_edges.size(), 2u);
    EXPECT_TRUE(has_edge(after.spaces[0].space, 2, 4));
    EXPECT_TRUE(warnings.empty());
    after.clips.pop_back();  // the clip at the end of a locked edge is gone
    place_clips(after, {}, &before, warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("could not be kept"), std::string::npos);
}

TEST(place, axes_can_be_asked_for_by_name) {
    const Project project = make_project({make_clip("a", 0, 0), make_clip("b", 1, 30), make_clip("c", 1, -30),
                                          make_clip("d", 1, 0, 1), make_clip("e", 2, 0, 0)},
                                         {"speed,turn,lateral"});
    ASSERT_EQ(project.spaces.size(), 1u);
    EXPECT_EQ(project.spaces[0].space.dimensions(), 3);
    EXPECT_EQ(problem(project.spaces[0].space), "");
    EXPECT_THROW(make_project({make_clip("a", 0, 0)}, {"speed,wobble"}), Error);
    EXPECT_THROW(make_project({make_clip("a", 0, 0)}, {"speed,speed"}), Error);
    EXPECT_THROW(make_project({make_clip("a", 0, 0)}, {"speed,turn,slope,lateral,forward"}), Error);
}

TEST(place, places_are_told_in_words) {
    const Axis axes[] = {make_axis("speed"), make_axis("turn")};
    EXPECT_EQ(describe_place(axes, std::vector<float>{1.4f, -90}), "1.40 m/s forward, turning 90 deg/s to its right");
    EXPECT_EQ(describe_place(axes, std::vector<float>{0, 0}), "on the spot, without turning");
    EXPECT_EQ(describe_place(axes, std::vector<float>{-1, 30}), "1.00 m/s backward, turning 30 deg/s to its left");
}

}  // namespace
}  // namespace surefoot
