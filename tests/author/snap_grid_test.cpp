#include "support.h"

#include <surefoot/author/snap_grid.h>
#include <surefoot/base/error.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_plane;

TEST(snap_grid, samples_go_to_the_nearest_point_and_say_how_far) {
    // Speed from 0 to 2 in steps of 0.5; turn from -90 to 90 in steps of 45.
    Project project = make_plane(
        {make_clip("idle", 0, 0), make_clip("jog", 1.95f, 30), make_clip("left", 0, 85), make_clip("walk", 1.4f, 2)}, 0,
        2, 90);
    std::vector<std::string> warnings;
    const GridSnap snap = snap_to_grid(project, 4, warnings);
    ASSERT_EQ(snap.samples.size(), 4u);
    EXPECT_EQ(snap.samples[0].percent, 0);
    EXPECT_EQ(snap.samples[1].to, (std::vector<float>{2, 45}));
    EXPECT_EQ(snap.samples[3].clip, "walk");
    EXPECT_EQ(snap.samples[3].from, (std::vector<float>{1.4f, 2}));
    EXPECT_EQ(snap.samples[3].to, (std::vector<float>{1.5f, 0}));
    EXPECT_NEAR(snap.samples[3].percent, std::hypot(5.0f, 100 * 2 / 180.0f), 1e-3f);
    EXPECT_EQ(project.spaces[0].space.samples[3], (SpacePoint{1.5f, 0}));
    EXPECT_TRUE(snap.collisions.empty());
    EXPECT_EQ(problem(project.spaces[0].space), "");
    const std::string table = snap_table(project, snap);
    EXPECT_LT(table.find("jog"), table.find("idle")) << "the farthest first\n" << table;
}

TEST(snap_grid, clips_on_one_grid_point_are_named_and_the_space_stays_sound) {
    Project project = make_plane({make_clip("idle", 0, 0), make_clip("left", 0, 90), make_clip("walk", 1.4f, 0),
                                  make_clip("walk_slow", 1.6f, 4)},
                                 0, 2, 90);
    std::vector<std::string> warnings;
    const GridSnap snap = snap_to_grid(project, 4, warnings);
    ASSERT_EQ(snap.collisions.size(), 1u);
    EXPECT_EQ(snap.collisions[0], (std::vector<std::string>{"walk", "walk_slow"}));
    EXPECT_NE(snap_table(project, snap).find("\"walk_slow\" (never played)"), std::string::npos);
    EXPECT_EQ(problem(project.spaces[0].space), "");
    const BlendWeights weights = blend_weights(project.spaces[0].space, {1.5f, 0});
    ASSERT_EQ(weights.count, 1);
    EXPECT_EQ(weights.samples[0], 2);
}

TEST(snap_grid, snapping_twice_is_snapping_once_and_a_fine_grid_moves_little) {
    std::vector<ProjectClip> clips{make_clip("idle", 0, 0), make_clip("a", 1.37f, 41), make_clip("b", 1.13f, -77),
                                   make_clip("c", 0.03f, 60), make_clip("d", 1.99f, 3)};
    for (const int divisions : {k_coarsest_grid, 7, 10, k_finest_grid}) {
        Project project = make_plane(clips, 0, 2, 90);
        std::vector<std::string> warnings;
        const GridSnap once = snap_to_grid(project, divisions, warnings);
        const Project after = project;
        const GridSnap twice = snap_to_grid(project, divisions, warnings);
        for (const SnappedSample& sample : once.samples)
            EXPECT_LE(sample.percent, 0.5f * std::sqrt(2.0f) * 100 / static_cast<float>(divisions) + 1e-3f);
        for (const SnappedSample& sample : twice.samples) EXPECT_EQ(sample.percent, 0) << divisions;
        EXPECT_TRUE(project == after);
    }
}

TEST(snap_grid, a_grid_no_engine_has_is_refused) {
    Project project = make_plane({make_clip("idle", 0, 0), make_clip("walk", 1, 0)}, 0, 2, 90);
    std::vector<std::string> warnings;
    EXPECT_THROW(snap_to_grid(project, k_coarsest_grid - 1, warnings), Error);
    EXPECT_THROW(snap_to_grid(project, k_finest_grid + 1, warnings), Error);
}

}  // namespace
}  // namespace surefoot
