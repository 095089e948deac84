#include "written_scenes.h"

#include <surefoot/base/error.h>
#include <surefoot/io/assimp_import.h>
#include <surefoot/io/load.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using namespace test;

/// Every joint of every frame where the file's numbers put it, by name.
void expect_in_place(const LoadedClip& clip, const std::vector<WrittenJoint>& joints, bool z_up) {
    ASSERT_EQ(clip.motion.frame_count(), static_cast<int>(joints[0].rotations.size()));
    EXPECT_NEAR(clip.motion.fps, 30, 0.01);
    EXPECT_EQ(clip.motion.joint_count(), static_cast<int>(joints.size()));
    std::vector<Transform> world(static_cast<std::size_t>(clip.motion.joint_count()));
    for (int f = 0; f < clip.motion.frame_count(); ++f) {
        world_pose(clip.motion, f, world);
        const std::vector<Vec3> expected = written_positions(joints, static_cast<std::size_t>(f), z_up);
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const int joint = clip.motion.skeleton->find(joints[j].name);
            ASSERT_NE(joint, k_no_joint) << joints[j].name;
            EXPECT_LT(distance(world[static_cast<std::size_t>(joint)].translation, expected[j]), 1e-4f)
                << joints[j].name << " frame " << f;
        }
    }
}

TEST(Fbx, joints_stand_where_the_file_puts_them) {
    for (const bool pivots : {false, true})
        for (const bool z_up : {false, true}) {
            SCOPED_TRACE(testing::Message() << "pivots " << pivots << ", z up " << z_up);
            const auto joints = written_joints(pivots);
            const auto clips = read_clips(write_fbx(joints, z_up), "arm.fbx");
            ASSERT_EQ(clips.size(), 1u);
            EXPECT_EQ(clips[0].motion.name, "arm");  // its own name is "mixamo.com"
            EXPECT_FLOAT_EQ(clips[0].unit_scale, 0.01f);
            expect_in_place(clips[0], joints, z_up);
        }
}

TEST(Collada, joints_stand_where_the_file_puts_them) {
    for (const bool z_up : {false, true}) {
        SCOPED_TRACE(testing::Message() << "z up " << z_up);
        const auto joints = written_joints(false);
        const auto clips = read_clips(write_collada(joints, z_up), "arm.dae");
        ASSERT_EQ(clips.size(), 1u);
        expect_in_place(clips[0], joints, z_up);
    }
}

}  // namespace
}  // namespace surefoot
