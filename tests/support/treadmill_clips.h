#pragma once
// Clips of a body that is nothing but hips and two feet, which stand still on the ground exactly while they stand: any
// skate that shows in a blend is the blend's.

#include <surefoot/base/random.h>
#include <surefoot/clip/packed_clip.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/rig/skeleton.h>

#include <memory>
#include <string>

namespace surefoot::test {

inline std::shared_ptr<const Skeleton> feet_skeleton() {
    auto s = std::make_shared<Skeleton>();
    s->add("hips", k_no_joint, {{}, {0, 0.9f, 0}});
    s->add("left_foot", 0, {{}, {0.1f, -0.9f, 0}});
    s->add("right_foot", 0, {{}, {-0.1f, -0.9f, 0}});
    return s;
}

struct Gait {
    Vec3 velocity;       ///< [m/s]
    float turn = 0;      ///< [rad/s]
    float seconds = 1;   ///< of a cycle
    float duty = 0.6f;   ///< share of the cycle that a foot stands
    float right = 0.5f;  ///< time share of the right foot's strike; the left one's is 0
    float start = 0;     ///< time share at which the clip begins
    int frames = 241;
};

/// Where a foot is, seen from the root, `share` of a cycle after its strike.
inline Vec3 foot_place(const Gait& gait, float share, float side) {
    const Vec3 home{side, 0, 0};
    const float stance = gait.duty * gait.seconds;
    // Mid-stance is at home; on the ground the foot goes against the root's motion.
    const auto standing = [&](float t) {
        const RootFrame moved = integrate(gait.velocity, gait.turn, t - 0.5f * stance);
        return transform_point(inverse(to_transform(moved)), home);
    };
    if (share <= gait.duty) return standing(share * gait.seconds);
    const float u = (share - gait.duty) / (1 - gait.duty), eased = u * u * (3 - 2 * u);
    Vec3 p = lerp(standing(stance), standing(0), eased);
    p.y = 0.2f * u * (1 - u);
    return p;
}

inline PackedClip gait_clip(const Skeleton& skeleton, const Gait& gait, const std::string& name = "gait") {
    PackedClip clip;
    clip.name = name;
    clip.frame_count = gait.frames;
    clip.fps = static_cast<float>(gait.frames - 1) / gait.seconds;
    clip.joint_count = 3;
    clip.cyclic = true;
    clip.moving = {1, 2};
    clip.velocity = gait.velocity;
    clip.turn_rate = gait.turn;
    std::vector<std::int16_t> rotations;
    std::vector<Vec3> translations;
    std::vector<RootFrame> root;
    for (int f = 0; f < gait.frames; ++f) {
        for (int k = 0; k < 4 * k_lanes; ++k) rotations.push_back(k / k_lanes == 3 ? 32767 : 0);
        const float t = static_cast<float>(f) / static_cast<float>(gait.frames - 1) + gait.start;
        const auto after = [&](float strike) { return t - strike - std::floor(t - strike); };
        // The right foot's cycle begins at its strike.
        for (const auto& [share, side] : {std::pair{after(0), 0.1f}, std::pair{after(gait.right), -0.1f}})
            translations.push_back(foot_place(gait, share, side) - skeleton.rest[0].translation);
        root.push_back(integrate(gait.velocity, gait.turn, static_cast<float>(f) / clip.fps));
    }
    clip.rotations = std::move(rotations);
    clip.translations = std::move(translations);
    clip.root = std::move(root);
    clip.travel = clip.root.back();
    clip.cycles = 1;
    if (gait.start == 0) {
        clip.phase_map = {{0.0f, 0.0f}, {gait.right, 0.5f}, {1.0f, 1.0f}};
    } else {  // begins between the left and the right strike
        const float first = 0.5f * gait.start / gait.right;
        clip.phase_map = {{0.0f, first}, {gait.right - gait.start, 0.5f}, {1 - gait.start, 1.0f}, {1.0f, first + 1}};
    }
    return clip;
}

/// Stands, swaying; `cyclic` or not.
inline PackedClip idle_clip(const Skeleton& skeleton, float seconds = 2, bool cyclic = true) {
    Gait still;
    still.seconds = seconds;
    still.duty = 1;
    PackedClip clip = gait_clip(skeleton, still, "idle");
    clip.cyclic = cyclic;
    clip.cycles = 0;
    clip.phase_map.clear();
    return clip;
}

}  // namespace surefoot::test
