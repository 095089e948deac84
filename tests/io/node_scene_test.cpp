// What nodes and tracks become: curves, scale, matrices, nodes above and between joints. Numbers worked out by hand.

#include "glb_bytes.h"

#include <surefoot/io/gltf.h>
#include <surefoot/io/node_scene.h>
#include <surefoot/io/node_track.h>

#include <gtest/gtest.h>

#include <cstring>

namespace surefoot {
namespace {

std::shared_ptr<const std::vector<float>> floats(std::vector<float> values) {
    return std::make_shared<const std::vector<float>>(std::move(values));
}

NodeTrack translation(int node, NodeTrack::Curve curve, std::vector<float> times, std::vector<float> values) {
    return {node, NodeTrack::Path::translation, curve, floats(std::move(times)), floats(std::move(values))};
}

SceneNode node(const char* name, Vec3 at, std::vector<int> children = {}) {
    SceneNode n;
    n.name = name;
    n.translation = at;
    n.children = std::move(children);
    return n;
}

std::vector<Vec3> world(const Motion& motion, int frame) {
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count()));
    world_pose(motion, frame, models);
    std::vector<Vec3> positions;
    for (const Transform& model : models) positions.push_back(model.translation);
    return positions;
}

constexpr LoadOptions k_metres{1};

TEST(NodeTrack, curves_follow_the_specification) {
    const std::vector<float> times = {0, 1};
    NodeTrack track = translation(0, NodeTrack::Curve::linear, times, {0, 0, 0, 4, 0, 0});
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(0.25).x, 1);
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(-1).x, 0);
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(2).x, 4);
    track.curve = NodeTrack::Curve::step;
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(0.99).x, 0);
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(1).x, 4);
    // In-tangent, value, out-tangent; from 0 with slope 2 to 4 with slope 0: p(1/2) = 2 + 2/8.
    track = translation(0, NodeTrack::Curve::cubic, times, {9, 9, 9, 0, 0, 0, 2, 0, 0, 0, 0, 0, 4, 0, 0, 9, 9, 9});
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(0.5).x, 2.25f);
    EXPECT_FLOAT_EQ(TrackPlayer(track).vector_at(1).x, 4);
}

TEST(NodeTrack, a_player_may_go_back_in_time) {
    const NodeTrack track =
        translation(0, NodeTrack::Curve::linear, {0, 1, 2, 3}, {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0});
    TrackPlayer player(track);
    for (const double time : {2.5, 0.5, 3.0, 1.0, 0.0})
        EXPECT_FLOAT_EQ(player.vector_at(time).x, static_cast<float>(time));
}

TEST(NodeTrack, the_grid_is_that_of_the_keys) {
    const auto grid = [](double rate, int keys, float start) {
        std::vector<float> times;
        for (int k = 0; k < keys; ++k) times.push_back(start + static_cast<float>(k / rate));
        return fit_time_grid(times, 100000);
    };
    for (const double rate : {24.0, 25.0, 29.97, 30.0, 48.0, 60.0, 120.0}) {
        EXPECT_NEAR(grid(rate, 100, 0.04f).fps, rate, 1e-3 * rate);
        EXPECT_EQ(grid(rate, 100, 0.04f).frames, 100);
    }
    EXPECT_EQ(grid(30, 3000, 0).fps, 30);
    EXPECT_EQ(grid(2, 3, 0).fps, 30);  // keys far apart: read finely
    EXPECT_EQ(grid(2, 3, 0).frames, 31);
    EXPECT_EQ(fit_time_grid(std::vector<float>{0, 0.0123f, 0.5f, 1}, 1000).frames, 31);
    EXPECT_EQ(fit_time_grid(std::vector<float>{1}, 1000).frames, 1);
    EXPECT_EQ(fit_time_grid(std::vector<float>{0, 1e6f}, 1000).frames, 0);
}

NodeScene chain() {
    // Armature (scaled to 1 %, lying on its back) > hips > spine; the hips move along the file's +Z.
    NodeScene scene;
    scene.nodes = {node("Armature", {0, 0, 1}, {1}), node("hips", {0, 0, 100}, {2}), node("spine", {0, 0, 50})};
    scene.nodes[0].rotation = axis_angle({1, 0, 0}, static_cast<float>(-k_pi / 2));
    scene.nodes[0].scale = {0.01f, 0.01f, 0.01f};
    scene.skins = {{1, 2}};
    scene.clips.resize(1);
    scene.clips[0].name = "walk";
    scene.clips[0].tracks = {translation(1, NodeTrack::Curve::linear, {0, 1.0f / 30}, {0, 0, 100, 0, -50, 100})};
    return scene;
}

TEST(NodeScene, nodes_above_the_root_and_their_scale_are_multiplied_in) {
    const auto clips = clips_from_nodes(chain(), "x", k_metres);
    const Motion& motion = clips.at(0).motion;
    EXPECT_EQ(motion.skeleton->names, (std::vector<std::string>{"hips", "spine"}));
    EXPECT_EQ(motion.frame_count(), 2);
    EXPECT_LT(distance(world(motion, 0)[0], Vec3{0, 1, 1}), 1e-6f);
    EXPECT_LT(distance(world(motion, 1)[0], Vec3{0, 1, 1.5f}), 1e-6f);
    EXPECT_LT(distance(world(motion, 1)[1], Vec3{0, 1.5f, 1.5f}), 1e-6f);
    EXPECT_TRUE(clips[0].warnings.empty());  // one even scale is lost to nobody
}

TEST(NodeScene, uneven_and_animated_scale_keeps_positions_and_says_what_is_lost) {
    NodeScene scene = chain();
    scene.clips[0].tracks.push_back(
        {1, NodeTrack::Path::scale, NodeTrack::Curve::linear, floats({0, 1.0f / 30}), floats({1, 1, 1, 1, 1, 2})});
    const auto clips = clips_from_nodes(scene, "x", k_metres);
    EXPECT_LT(distance(world(clips[0].motion, 1)[1], Vec3{0, 2, 1.5f}), 1e-6f);  // twice as far from the hips
    ASSERT_EQ(clips[0].warnings.size(), 1u);
    EXPECT_EQ(clips[0].warnings[0].find("node 'hips' is scaled unevenly or over time"), 0u);
}

TEST(NodeScene, matrices_and_mirrored_frames_keep_positions) {
    NodeScene scene = chain();
    scene.nodes[0].matrix = Affine{-2, 0, 0, 5, 0, 2, 0, 0, 0, 0, 2, 0};  // mirrored in x, doubled, moved by 5
    scene.nodes[1].translation = {1, 0, 0};
    scene.nodes[2].rotation = axis_angle({0, 0, 1}, 1);
    scene.clips[0].tracks = {translation(2, NodeTrack::Curve::step, {0, 1.0f / 30}, {0, 1, 0, 3, 1, 0})};
    const Motion motion = clips_from_nodes(scene, "x", k_metres).at(0).motion;
    EXPECT_LT(distance(world(motion, 0)[1], Vec3{3, 2, 0}), 1e-6f);
    EXPECT_LT(distance(world(motion, 1)[1], Vec3{-3, 2, 0}), 1e-6f);
    for (const Transform& local : motion.locals) EXPECT_NEAR(dot(local.rotation, local.rotation), 1, 1e-6f);
}

TEST(NodeScene, a_joint_scaled_to_nothing_is_no_nan) {
    NodeScene scene = chain();
    scene.nodes[1].scale = {0, 0, 0};
    const auto clips = clips_from_nodes(scene, "x", k_metres);
    EXPECT_LT(distance(world(clips[0].motion, 0)[1], Vec3{0, 1, 1}), 1e-6f);
}

TEST(NodeScene, what_connects_the_joints_of_a_skin_is_a_joint_too) {
    NodeScene scene = chain();
    scene.nodes = {node("scene", {}, {1}), node("pelvis", {0, 1, 0}, {2, 3}), node("leg", {1, 0, 0}),
                   node("twist", {-1, 0, 0}, {4}), node("arm", {0, 1, 0})};
    scene.skins = {{4, 2}};
    scene.clips[0].tracks = {translation(2, NodeTrack::Curve::linear, {0, 1}, {1, 0, 0, 2, 0, 0})};
    const Motion motion = clips_from_nodes(scene, "x", k_metres).at(0).motion;
    EXPECT_EQ(motion.skeleton->names, (std::vector<std::string>{"pelvis", "twist", "arm", "leg"}));
    EXPECT_EQ(motion.skeleton->parents, (std::vector<std::int16_t>{-1, 0, 1, 0}));
}

TEST(NodeScene, a_lone_node_at_the_end_of_a_leaf_is_its_tip) {
    NodeScene scene = chain();
    scene.nodes[2].children = {3};
    scene.nodes.push_back(node("spine_end", {0, 0, 7}));
    const Motion motion = clips_from_nodes(scene, "x", k_metres).at(0).motion;
    EXPECT_EQ(motion.joint_count(), 2);
    EXPECT_GT(length(motion.skeleton->tips[1]), 0.0f);
}

TEST(Gltf, sparse_and_normalised_accessors_are_decoded) {
    // Three keys of a rotation: int8-normalised and all zero, with two of them replaced sparsely.
    const std::string json =
        R"({"asset":{"version":"2.0"},"nodes":[{"name":"a"}],"buffers":[{"byteLength":24}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":3},{"buffer":0,"byteOffset":16,"byteLength":8}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},)"
        R"({"componentType":5120,"normalized":true,"count":3,"type":"VEC4","sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}}],)"
        R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}}],"samplers":[{"input":0,"output":1,"interpolation":"STEP"}]}]})";
    std::vector<float> data = {0, 1.0f / 30, 2.0f / 30, 0, 0, 0};
    const unsigned char bytes[12] = {0, 2, 0, 0, 127, 0, 0, 0, 0, 0x81, 0, 0};  // keys 0 and 2: x = 1; y = -1
    std::memcpy(data.data() + 3, bytes, sizeof(bytes));
    const auto clips = read_gltf(test::glb_bytes(json, data), "x.glb");
    const Motion& motion = clips.at(0).motion;
    ASSERT_EQ(motion.frame_count(), 3);
    EXPECT_EQ(motion.frame(0)[0].rotation, (Quat{1, 0, 0, 0}));
    EXPECT_EQ(motion.frame(1)[0].rotation, Quat{});  // no rotation at all becomes the identity
    EXPECT_EQ(motion.frame(2)[0].rotation, (Quat{0, -1, 0, 0}));
}

}  // namespace
}  // namespace surefoot
