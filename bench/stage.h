#pragma once
// A synthetic character of the size of a game hero, so that the benchmarks need no file.

#include <surefoot/base/random.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/space/triangulate.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::bench {

inline constexpr int k_joints = 67;  ///< a hero with fingers

inline Quat turned(Random& random, float most) {
    const Vec3 axis = normalized(Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    return axis_angle(axis, random.between(-most, most));
}

/// A spine of six, then chains of five from it: as deep as a body with fingers is.
inline std::shared_ptr<const Skeleton> make_skeleton(int joints = k_joints) {
    Random random(1);
    auto skeleton = std::make_shared<Skeleton>();
    for (int j = 0; j < joints; ++j) {
        int parent = j - 1;
        if (j >= 6 && j % 5 == 1) parent = static_cast<int>(random.below(6));
        skeleton->add("joint" + std::to_string(j), j == 0 ? k_no_joint : parent,
                      {turned(random, 0.5f), {random.between(-0.1f, 0.1f), 0.1f, random.between(-0.1f, 0.1f)}});
    }
    return skeleton;
}

/// A cycle of smooth swings about rest; the hips move, nothing else does.
inline PackedClip make_clip(const Skeleton& skeleton, std::uint64_t seed, Vec3 velocity, float turn, float seconds) {
    Random random(seed);
    PackedClip clip;
    clip.name = "clip" + std::to_string(seed);
    clip.fps = 60;
    clip.frame_count = static_cast<int>(seconds * 60) + 1;
    clip.joint_count = skeleton.joint_count();
    clip.cyclic = true;
    clip.velocity = velocity;
    clip.turn_rate = turn;
    clip.moving = {0};
    const auto frames = static_cast<std::size_t>(clip.frame_count),
               blocks = static_cast<std::size_t>(clip.block_count());
    std::vector<std::int16_t> rotations(frames * blocks * 4 * k_lanes);
    std::vector<Vec3> translations;
    std::vector<RootFrame> root;
    for (int j = 0; j < clip.joint_count; ++j) {
        const Quat a = turned(random, 0.6f), rest = skeleton.rest[static_cast<std::size_t>(j)].rotation;
        const float shift = random.between(0, 6);
        for (std::size_t f = 0; f < frames; ++f) {
            const float t = static_cast<float>(f) / static_cast<float>(frames - 1) * 6.2831853f + shift;
            const Quat q = aligned(rest * slerp({}, a, sin(t)), rest);
            const std::size_t block = f * blocks + static_cast<std::size_t>(j / k_lanes);
            std::int16_t* to = rotations.data() + block * 4 * k_lanes + j % k_lanes;
            const float values[4] = {q.x, q.y, q.z, q.w};
            for (int k = 0; k < 4; ++k) to[k * k_lanes] = static_cast<std::int16_t>(std::lround(values[k] * 32767.0f));
        }
    }
    for (std::size_t f = 0; f < frames; ++f) {
        translations.push_back({0, 1, 0.02f * sin(0.1f * static_cast<float>(f))});
        root.push_back(integrate(velocity, turn, static_cast<float>(f) / 60));
    }
    clip.rotations = std::move(rotations);
    clip.translations = std::move(translations);
    clip.root = std::move(root);
    clip.travel = clip.root.back();
    clip.cycles = 1;
    clip.phase_map = {{0.0f, 0.0f}, {0.49f, 0.5f}, {1.0f, 1.0f}};
    return clip;
}

/// A space over speed and turn, and with more dimensions over axes of the user's own: twelve clips, and twice as many
/// with each axis more.
inline LocomotionGraph make_graph(int joints = k_joints, int dimensions = 2) {
    const auto skeleton = make_skeleton(joints);
    std::vector<PackedClip> clips;
    SpaceDefinition facing;
    facing.space.axes = {{"speed", "m/s", -1, 4}, {"turn", "deg/s", -90, 90}};
    for (int d = 2; d < dimensions; ++d) facing.space.axes.push_back({"own" + std::to_string(d), "", 0, 1});
    for (int corner = 0; corner < 1 << (dimensions - 2); ++corner)
        for (const float turn : {-90.0f, 0.0f, 90.0f})
            for (const float speed : {-0.8f, 0.0f, 1.4f, 3.5f}) {
                SpacePoint at{speed, turn};
                for (int d = 2; d < dimensions; ++d)
                    at[static_cast<std::size_t>(d)] = static_cast<float>(corner >> (d - 2) & 1);
                facing.space.samples.push_back(at);
                facing.clips.push_back(static_cast<std::int32_t>(clips.size()));
                clips.push_back(make_clip(*skeleton, clips.size() + 1, {0, 0, speed}, turn * k_radians_per_degree, 1));
            }
    triangulate(facing.space);
    return make_locomotion_graph(skeleton, std::move(clips), std::move(facing), {});
}

/// Steering that never rests, and stays within the space.
inline LocomotionRequest wish(std::size_t character, int frame) {
    const float t = 0.01f * static_cast<float>(frame) + 0.13f * static_cast<float>(character % 97);
    const float saw = t - std::floor(t), slow_saw = 0.3f * t - std::floor(0.3f * t);
    LocomotionRequest request{1.2f + 1.5f * saw, 70.0f * (0.5f - slow_saw), 0};
    request.custom = {saw, slow_saw, 1 - saw, 1 - slow_saw};
    return request;
}

}  // namespace surefoot::bench
