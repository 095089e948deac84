#include "random_motion.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>

#include <tests/support/motion_data.h>

#include <gtest/gtest.h>

#include <cstring>

namespace surefoot {
namespace {

using test::worst_world_distance;

TEST(Gltf, our_own_files_come_back_exactly) {
    Random random(3);
    for (int i = 0; i < 10; ++i) {
        GltfScene scene;
        scene.motions.push_back(test::random_motion(random, 1 + static_cast<int>(random.below(50)), 20));
        scene.motions.push_back(make_motion(scene.motions[0].skeleton, "still", 7, 24));
        scene.motions.push_back(make_motion(scene.motions[0].skeleton, "one frame", 1, 30));
        scene.motions[1].cyclic = true;
        scene.motion_extras = {R"({"phase_events":[{"foot":"left","time_s":0.25,"note":null}],"parts":[]})", "", ""};
        const auto back = read_gltf(write_glb(scene), "own.glb");
        ASSERT_EQ(back.size(), 3u);
        for (std::size_t m = 0; m < 3; ++m) {
            EXPECT_EQ(*back[m].motion.skeleton, *scene.motions[m].skeleton);
            EXPECT_EQ(back[m].motion.name, scene.motions[m].name);
            EXPECT_EQ(back[m].motion.fps, scene.motions[m].fps);
            EXPECT_EQ(back[m].motion.cyclic, scene.motions[m].cyclic);
            EXPECT_EQ(back[m].motion.root, scene.motions[m].root);
            EXPECT_EQ(back[m].motion.locals, scene.motions[m].locals);
            EXPECT_EQ(back[m].extras,
                      scene.motion_extras[m].empty()
                          ? ""
                          : R"({"parts":[],"phase_events":[{"foot":"left","note":null,"time_s":0.25}]})");
        }
    }
}

TEST(Gltf, the_same_scene_gives_the_same_bytes) {
    Random random(4);
    GltfScene scene;
    scene.motions.push_back(test::random_motion(random, 20, 10));
    EXPECT_EQ(write_glb(scene), write_glb(scene));
}

TEST(Gltf, bvh_to_glb_to_bvh_keeps_every_joint_in_place) {
    Random random(5);
    for (int i = 0; i < 10; ++i) {
        const Motion motion = test::random_motion(random, 2 + static_cast<int>(random.below(60)), 15);
        const LoadedClip first = read_bvh(write_bvh(motion), "x.bvh", {.unit_scale = 0.01});
        GltfScene scene;
        scene.motions.push_back(first.motion);
        const LoadedClip second = read_gltf(write_glb(scene), "x.glb").at(0);
        const LoadedClip third = read_bvh(write_bvh(second.motion), "x.bvh", {.unit_scale = 0.01});
        EXPECT_LT(worst_world_distance(motion, third.motion), 1e-5f);
        EXPECT_EQ(third.motion.skeleton->tips.size(), motion.skeleton->tips.size());
        for (std::size_t j = 0; j < motion.skeleton->tips.size(); ++j)
            EXPECT_LT(distance(third.motion.skeleton->tips[j], motion.skeleton->tips[j]), 1e-6f);
    }
}

TEST(Gltf, real_clips_keep_every_joint_in_place_through_all_formats) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const char* name : {"cmu_bvh/07_01.bvh", "cmu_bvh/06_10_iclone.bvh", "o3de_mocap_bvh/Run1.bvh"}) {
        const std::string path = (folder / name).string();
        const LoadedClip first = read_bvh(read_file(path), path);
        GltfScene scene;
        scene.motions.push_back(first.motion);
        const LoadedClip second = read_gltf(write_glb(scene), "x.glb").at(0);
        const LoadedClip third = read_bvh(write_bvh(second.motion), "x.bvh", {.unit_scale = 0.01});
        EXPECT_LT(worst_world_distance(first.motion, third.motion), 1e-4f) << name;
    }
    const std::string path = (folder / "ual1_locomotion_glb/UAL1_50clips_mannequin.glb").string();
    for (const LoadedClip& clip : read_gltf(read_file(path), path)) {
        const LoadedClip back = read_bvh(write_bvh(clip.motion), "x.bvh", {.unit_scale = 0.01});
        EXPECT_LT(worst_world_distance(clip.motion, back.motion), 1e-4f) << clip.motion.name;
    }
}

TEST(Gltf, a_skinned_mesh_is_written_and_its_node_points_at_it) {
    Random random(6);
    GltfScene scene;
    scene.motions.push_back(test::random_motion(random, 3, 2));
    scene.mesh.emplace();
    scene.mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.mesh->normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    scene.mesh->joints.resize(3);
    scene.mesh->weights = {{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
    scene.mesh->indices = {0, 1, 2};
    scene.statics.push_back({.name = "terrain",
                             .positions = scene.mesh->positions,
                             .normals = {},
                             .indices = {0, 1, 2},
                             .color = {},
                             .vertex_colors = {}});
    const std::string glb = write_glb(scene);
    EXPECT_NE(glb.find("\"mesh\":0,\"skin\":0"), std::string::npos);
    EXPECT_NE(glb.find("\"mesh\":1"), std::string::npos);
    EXPECT_NE(glb.find("\"meshes\":["), std::string::npos);
}

TEST(Gltf, a_scene_that_is_not_sound_is_refused) {
    Random random(6);
    GltfScene scene;
    EXPECT_THROW(write_glb(scene), Error);
    scene.motions.push_back(test::random_motion(random, 3, 2));
    scene.motions.push_back(test::random_motion(random, 4, 2));
    EXPECT_THROW(write_glb(scene), Error);
    scene.motions.pop_back();
    scene.extras = "[1]";
    EXPECT_THROW(write_glb(scene), Error);
    scene.extras.clear();
    scene.mesh.emplace();
    EXPECT_THROW(write_glb(scene), Error);
}

}  // namespace
}  // namespace surefoot
