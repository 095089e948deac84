#pragma once
// Random skeletons and motions, and how far two motions lie apart.

#include <surefoot/base/random.h>
#include <surefoot/motion/motion.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::test {

inline Quat random_rotation(Random& random) {
    Quat q{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    return normalized(q);
}
inline Vec3 random_vector(Random& random, float size) {
    return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

/// Joints in depth-first order (the order every format keeps), some with moving translations, some with tips, with
/// root motion of its own.
inline Motion random_motion(Random& random, int joints, int frames) {
    auto skeleton = std::make_shared<Skeleton>();
    std::vector<int> open;
    for (int j = 0; j < joints; ++j) {
        while (open.size() > 1 && random.unit() < 0.4f) open.pop_back();
        const int joint = skeleton->add("joint" + std::to_string(j), open.empty() ? k_no_joint : open.back(),
                                        {random_rotation(random), random_vector(random, 0.3f)},
                                        random.unit() < 0.3f ? random_vector(random, 0.1f) : Vec3{});
        open.push_back(joint);
    }
    const float rates[] = {30, 60, 120, 24};
    Motion motion = make_motion(skeleton, "random", frames, rates[random.below(4)]);
    std::vector<bool> moves;
    for (int j = 0; j < joints; ++j) moves.push_back(j == 0 || random.unit() < 0.2f);
    for (int f = 0; f < frames; ++f) {
        motion.root[static_cast<std::size_t>(f)] = {random_vector(random, 2), random.between(-4, 4)};
        for (std::size_t j = 0; j < static_cast<std::size_t>(joints); ++j) {
            motion.frame(f)[j].rotation = random_rotation(random);
            if (moves[j]) motion.frame(f)[j].translation = random_vector(random, 0.5f);
        }
    }
    return motion;
}

/// Largest distance between equally named joints of two motions in world space, over all frames; 1e9 where frames or
/// joints do not match.
inline float worst_world_distance(const Motion& a, const Motion& b) {
    if (a.frame_count() != b.frame_count() || a.joint_count() != b.joint_count()) return 1e9f;
    std::vector<Transform> world_a(static_cast<std::size_t>(a.joint_count())), world_b(world_a.size());
    float worst = 0;
    for (int f = 0; f < a.frame_count(); ++f) {
        world_pose(a, f, world_a);
        world_pose(b, f, world_b);
        for (std::size_t j = 0; j < world_a.size(); ++j) {
            const int other = b.skeleton->find(a.skeleton->names[j]);
            if (other == k_no_joint) return 1e9f;
            worst =
                std::max(worst, distance(world_a[j].translation, world_b[static_cast<std::size_t>(other)].translation));
        }
    }
    return worst;
}

}  // namespace surefoot::test
