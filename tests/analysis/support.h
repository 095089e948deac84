#pragma once
// What the tests of analysis share: real clips, the hips' own way, and clips made in place as exporters make them.

#include <surefoot/analysis/analyze.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>

#include "tests/support/motion_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace surefoot::test {

inline std::vector<LoadedClip> load(const std::filesystem::path& path) {
    const std::string paths[] = {path.string()};
    LoadResult result = load_clips(paths);
    for (const LoadFailure& failure : result.failed) ADD_FAILURE() << failure.file << ": " << failure.error;
    EXPECT_FALSE(result.clips.empty()) << path;
    return std::move(result.clips);
}

inline AnalyzedClip analyzed(const LoadedClip& clip) { return analyze_clip(clip.motion, clip.file, clip.unit_scale); }

/// [m] planar displacement of one joint from the first to the last frame, in the world.
inline Vec3 displacement(const Motion& motion, int joint) {
    std::vector<Transform> first(static_cast<std::size_t>(motion.joint_count())), last = first;
    world_pose(motion, 0, first);
    world_pose(motion, motion.frame_count() - 1, last);
    const std::size_t j = static_cast<std::size_t>(joint);
    const Vec3 moved = last[j].translation - first[j].translation;
    return {moved.x, 0, moved.z};
}

/// The clip with `velocity` [m/s] taken out of its joints without parents: what exporters call "in place".
inline Motion treadmill(Motion motion, Vec3 velocity) {
    for (int f = 0; f < motion.frame_count(); ++f) {
        const Vec3 moved = velocity * (static_cast<float>(f) / motion.fps);
        for (int j = 0; j < motion.joint_count(); ++j)
            if (motion.skeleton->parents[static_cast<std::size_t>(j)] == k_no_joint)
                motion.frame(f)[static_cast<std::size_t>(j)].translation -= moved;
    }
    return motion;
}

inline float median(std::vector<float> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace surefoot::test
