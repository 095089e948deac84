#pragma once
// Random skeletons and packed clips, for tests that want many of every shape.

#include <surefoot/base/random.h>
#include <surefoot/clip/packed_clip.h>
#include <surefoot/rig/skeleton.h>

#include <cmath>
#include <string>

namespace surefoot::test {

inline Quat random_rotation(Random& random, float most_angle) {
    const Vec3 axis = normalized(Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    return axis_angle(axis, random.between(-most_angle, most_angle));
}

inline Skeleton random_skeleton(Random& random, int joints) {
    Skeleton s;
    for (int j = 0; j < joints; ++j) {
        const int parent = j == 0 ? k_no_joint : j - 1 - static_cast<int>(random.below(j < 4 ? 1u : 4u));
        s.add("joint" + std::to_string(j), parent,
              {random_rotation(random, 3.0f),
               {random.between(-0.3f, 0.3f), random.between(-0.3f, 0.3f), random.between(-0.3f, 0.3f)}});
    }
    return s;
}

inline void set_rotation(std::vector<std::int16_t>& rotations, const PackedClip& clip, int frame, int joint, Quat q) {
    const int block = joint / k_lanes, lane = joint % k_lanes;
    std::int16_t* to = rotations.data() + (frame * clip.block_count() + block) * 4 * k_lanes + lane;
    const float values[4] = {q.x, q.y, q.z, q.w};
    for (int k = 0; k < 4; ++k) to[k * k_lanes] = static_cast<std::int16_t>(std::lround(values[k] * 32767.0f));
}
inline void set_rotation(PackedClip& clip, int frame, int joint, Quat q) {
    clip.rotations.edit([&](std::vector<std::int16_t>& rotations) { set_rotation(rotations, clip, frame, joint, q); });
}
inline Quat get_rotation(const PackedClip& clip, int frame, int joint) {
    const int block = joint / k_lanes, lane = joint % k_lanes;
    const std::int16_t* from = clip.rotations.data() + (frame * clip.block_count() + block) * 4 * k_lanes + lane;
    return normalized(Quat{static_cast<float>(from[0]), static_cast<float>(from[k_lanes]),
                           static_cast<float>(from[2 * k_lanes]), static_cast<float>(from[3 * k_lanes])});
}

/// Rotations within `swing` of rest, one or two moving joints, an irregular phase map, a steady root.
inline PackedClip random_clip(Random& random, const Skeleton& skeleton, int frames, float swing = 1.2f) {
    PackedClip clip;
    clip.name = "random";
    clip.fps = 30;
    clip.frame_count = frames;
    clip.joint_count = skeleton.joint_count();
    clip.cyclic = true;
    std::vector<std::int16_t> rotations(static_cast<std::size_t>(frames * clip.block_count() * 4 * k_lanes));
    std::vector<Vec3> translations;
    std::vector<RootFrame> root;
    clip.moving.push_back(0);
    if (skeleton.joint_count() > 5) clip.moving.push_back(5);
    for (int f = 0; f < frames; ++f) {
        for (int j = 0; j < clip.block_count() * k_lanes; ++j) {
            if (j >= clip.joint_count) {
                set_rotation(rotations, clip, f, j, {});
                continue;
            }
            const Quat rest = skeleton.rest[static_cast<std::size_t>(j)].rotation;
            set_rotation(rotations, clip, f, j, aligned(rest * random_rotation(random, swing), rest));
        }
        for (const std::int16_t j : clip.moving)
            translations.push_back(
                skeleton.rest[static_cast<std::size_t>(j)].translation +
                Vec3{random.between(-0.1f, 0.1f), random.between(-0.1f, 0.1f), random.between(-0.1f, 0.1f)});
        root.push_back({{0, 0, static_cast<float>(f) / clip.fps}, 0});
    }
    clip.rotations = std::move(rotations);
    clip.translations = std::move(translations);
    clip.root = std::move(root);
    clip.velocity = {0, 0, 1};
    clip.travel = clip.root.back();
    clip.cycles = 1;
    clip.phase_map = {{0.0f, 0.25f}, {0.3f, 0.5f}, {0.7f, 1.0f}, {1.0f, 1.25f}};
    return clip;
}

}  // namespace surefoot::test
