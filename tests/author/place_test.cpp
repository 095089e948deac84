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

std::string fmt_name(float speed, float turn, float style) {
    return std::to_string(static_cast<int>(10 * speed)) + "_" + std::to_string(static_cast<int>(turn)) + "_" +
           std::to_string(static_cast<int>(10 * style));
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
    EXPECT_THROW(make_project({make_clip("a", 0, 0)}, {"speed,"}), Error);
    EXPECT_THROW(make_project({make_clip("a", 0, 0)}, {"speed,speed"}), Error);
    EXPECT_THROW(make_project({make_clip("a", 0, 0)}, {"speed,turn,slope,lateral,forward"}), Error);
}

/// A clip with a number of the user's own.
ProjectClip styled(const std::string& name, float speed, float turn, float style) {
    ProjectClip clip = make_clip(name, speed, turn);
    clip.facts.custom["style"] = style;
    return clip;
}

std::vector<ProjectClip> styled_set() {
    std::vector<ProjectClip> clips;
    for (const float style : {0.0f, 0.7f})
        for (const float turn : {-60.0f, 0.0f, 60.0f})
            for (const float speed : {0.0f, 1.4f, 3.0f})
                clips.push_back(styled(fmt_name(speed, turn, style), speed, turn, style));
    return clips;
}

TEST(place, a_number_from_the_sidecars_is_an_axis_like_any_other) {
    const Project project = make_project(styled_set(), {"speed,turn,style"});
    const ProjectSpace& space = project.spaces.at(0);
    EXPECT_EQ(space.name, "facing");
    ASSERT_EQ(space.space.dimensions(), 3);
    EXPECT_EQ(space.space.axes[2].name, "style");
    EXPECT_EQ(space.space.axes[2].low, 0.0f);
    EXPECT_EQ(space.space.axes[2].high, 0.7f);
    EXPECT_EQ(problem(space.space), "");
    ASSERT_FALSE(space.space.simplices.empty());
    EXPECT_GE(space.space.simplices[0][3], 0);  // really three-dimensional
    // An idle stands at the origin of speed and turn, but in its own style.
    int idles = 0;
    for (std::size_t i = 0; i < space.clips.size(); ++i)
        if (is_idle(project.clips[space.clips[i]].facts)) {
            ++idles;
            EXPECT_EQ(space.space.samples[i][2], project.clips[space.clips[i]].facts.custom.at("style"));
        }
    EXPECT_EQ(idles, 2);
    const Project four = make_project(styled_set(), {"speed,turn,slope,style"});
    EXPECT_EQ(four.spaces.at(0).space.dimensions(), 4);
}

TEST(place, clips_without_the_number_are_named_and_a_number_that_no_clip_has_is_refused) {
    std::vector<ProjectClip> clips = styled_set();
    clips[1].facts.custom.clear();
    Project project;
    project.clips = clips;
    std::vector<std::string> warnings;
    const std::string axes[] = {"speed,style"};
    place_clips(project, axes, nullptr, warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("1 of 18 clips have no number \"style\" and count as 0: \"" + clips[1].name),
              std::string::npos)
        << warnings[0];
    try {
        make_project(clips, {"speed,stile"});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no clip has a number \"stile\""), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("travel, style"), std::string::npos) << error.what();
    }
}

TEST(place, limits_of_the_users_own_axes_are_round) {
    EXPECT_EQ(limits_of("style", {0, 0.7f}).high, 0.7f);
    EXPECT_EQ(limits_of("style", {0.33f}).high, 0.35f);
    EXPECT_EQ(limits_of("load", {-3.1f, 41}).high, 45.0f);
    EXPECT_EQ(limits_of("load", {-3.1f, 41}).low, -5.0f);
    EXPECT_EQ(limits_of("load", {0, 0}).high, 1.0f);
    EXPECT_EQ(limits_of("mass", {0, 81234}).high, 90000.0f);
}

TEST(place, direction_and_pace_make_a_ring_on_which_the_idle_stands_everywhere) {
    const Project project =
        make_project({make_clip("idle", 0, 0), make_clip("walk", 1.2f, 0), make_clip("back", -1.2f, 0),
                      make_clip("left", 0, 0, 1.2f), make_clip("right", 0, 0, -1.2f)},
                     {"travel,pace"});
    const ProjectSpace& space = project.spaces.at(0);
    EXPECT_EQ(space.name, "lateral");
    EXPECT_TRUE(space.space.axes[0].wraps);
    EXPECT_EQ(problem(space.space), "");
    EXPECT_EQ(space.space.original_count(), 8);
    EXPECT_EQ(space.clips.size(), 24u);
    for (const float heading : {-179.0f, -91.0f, 45.0f, 179.0f}) {
        const BlendWeights w = blend_weights(space.space, {heading, 0.6f});
        EXPECT_FALSE(w.clamped);
        float idle = 0;
        for (int n = 0; n < w.count; ++n) idle += space.clips[w.samples[n]] == 0 ? w.weights[n] : 0;
        EXPECT_NEAR(idle, 0.5f, 1e-3) << heading;
    }
}

TEST(place, weighting_extrapolation_and_locked_triangles_survive) {
    const std::vector<ProjectClip> clips{make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0),
                                         make_clip("left", 1.4f, 60), make_clip("right", 1.4f, -60),
                                         make_clip("run", 4, 0)};
    Project before = make_project(clips);
    before.spaces[0].space.weighting = Weighting::gradient_band;
    before.spaces[0].space.outside = Outside::extrapolate;
    before.spaces[0].space.extrapolation_bound = 0.1f;
    before.spaces[0].locked_simplices = {{1, 2, 4}, {0, 2, 3}};
    Project after;
    after.clips = clips;
    std::vector<std::string> warnings;
    place_clips(after, {}, &before, warnings);
    const ProjectSpace& space = after.spaces[0];
    EXPECT_EQ(space.space.weighting, Weighting::gradient_band);
    EXPECT_EQ(space.space.outside, Outside::extrapolate);
    EXPECT_EQ(space.space.extrapolation_bound, 0.1f);
    EXPECT_TRUE(has_simplex(space.space, std::array{1, 2, 4}));
    EXPECT_EQ(space.locked_simplices, (std::vector<std::vector<int>>{{1, 2, 4}}));
    ASSERT_EQ(warnings.size(), 1u);  // the walk lies inside
    EXPECT_NE(warnings[0].find("the locked simplex between \"idle\", \"left\", \"right\""), std::string::npos);
    EXPECT_NE(warnings[0].find("a sample lies in it"), std::string::npos);
}

TEST(place, a_locked_simplex_of_three_dimensions_is_kept_where_it_is_there) {
    Project before = make_project(styled_set(), {"speed,turn,style"});
    const Simplex& first = before.spaces[0].space.simplices[0];
    before.spaces[0].locked_simplices = {{first[0], first[1], first[2], first[3]}, {0, 1, 2, 3}};
    ASSERT_FALSE(has_simplex(before.spaces[0].space, before.spaces[0].locked_simplices[1]));
    Project after;
    after.clips = before.clips;
    std::vector<std::string> warnings;
    const std::string axes[] = {"speed,turn,style"};
    place_clips(after, axes, &before, warnings);
    EXPECT_EQ(after.spaces[0].locked_simplices.size(), 1u);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("none can be forced"), std::string::npos);
}

TEST(place, places_are_told_in_words) {
    const Axis axes[] = {make_axis("speed"), make_axis("turn")};
    EXPECT_EQ(describe_place(axes, std::vector<float>{1.4f, -90}), "1.40 m/s forward, turning 90 deg/s to its right");
    EXPECT_EQ(describe_place(axes, std::vector<float>{0, 0}), "on the spot, without turning");
    EXPECT_EQ(describe_place(axes, std::vector<float>{-1, 30}), "1.00 m/s backward, turning 30 deg/s to its left");
    const Axis wide[] = {make_axis("travel"), make_axis("pace"), make_axis("slope"), make_axis("style")};
    EXPECT_EQ(describe_place(wide, std::vector<float>{-90, 1.2f, -8, 0.3f}),
              "90 deg to its right, at 1.20 m/s, 8 deg downhill, style 0.30");
}

}  // namespace
}  // namespace surefoot
