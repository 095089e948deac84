#pragma once
// The generated set as clips to bake, without the cost of measuring them.

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/project.h>
#include <surefoot/space/triangulate.h>
#include <surefoot/synthetic/gait_cycle.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <cmath>
#include <vector>

namespace surefoot::test {

/// The generated set, its facts taken from the root motion it was made with.
inline std::vector<AnalyzedClip> synthetic_clips() {
    const ClipSet set = make_synthetic_set();
    std::vector<Transform> rest(set.skeleton->rest.size());
    local_to_model(*set.skeleton, set.skeleton->rest, rest);
    const Legs legs = make_legs(*set.skeleton, set.roles, rest, 0);
    std::vector<AnalyzedClip> clips;
    const std::vector<GaitParameters> gaits = synthetic_gaits();
    for (const Motion& motion : set.clips) {
        AnalyzedClip clip;
        clip.motion = motion;
        clip.roles.roles = set.roles;
        clip.legs = legs;
        ClipFacts& facts = clip.facts;
        facts.name = motion.name;
        const RootFrame step = between(motion.root[0], motion.root[1]);
        const Vec3 velocity = rotate(from_yaw(-0.5f * step.yaw), step.position) * motion.fps;
        facts.forward = velocity.z;
        facts.lateral = velocity.x;
        facts.speed = velocity.z < -1e-3f ? -planar_length(velocity) : planar_length(velocity);
        facts.travel = planar_length(velocity) > 0.01f ? atan2(velocity.x, velocity.z) * k_degrees_per_radian : 0;
        facts.turn = step.yaw * motion.fps * k_degrees_per_radian;
        facts.cyclic = true;
        facts.duty = gaits[clips.size()].duty;
        if (motion.name != "idle")
            facts.events = {{Side::left, StrideEvent::strike, 0},
                            {Side::right, StrideEvent::strike, 0.5f * motion.duration()}};
        clips.push_back(std::move(clip));
    }
    return clips;
}

inline std::vector<ProjectSpace> spaces_for(const std::vector<AnalyzedClip>& clips) {
    ProjectSpace facing, lateral;
    facing.name = "facing";
    facing.space.axes = {{"speed", "m/s", -2, 5}, {"turn", "deg/s", -120, 120}};
    lateral.name = "lateral";
    lateral.space.axes = {{"forward", "m/s", -2, 2}, {"lateral", "m/s", -2, 2}};
    for (std::size_t i = 0; i < clips.size(); ++i) {
        const ClipFacts& f = clips[i].facts;
        const bool sideways = std::fabs(f.lateral) > std::fabs(f.forward) && std::fabs(f.lateral) > 0.1f;
        if (!sideways) {
            facing.space.samples.push_back({f.speed, f.turn});
            facing.clips.push_back(static_cast<int>(i));
        }
        if (sideways || f.name == "idle") {
            lateral.space.samples.push_back({f.forward, f.lateral});
            lateral.clips.push_back(static_cast<int>(i));
        }
    }
    triangulate(facing.space);
    triangulate(lateral.space);
    return {facing, lateral};
}

}  // namespace surefoot::test
