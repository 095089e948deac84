#pragma once
// The generated walk as a walker, for tests of this room.

#include <surefoot/course/sweep.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <algorithm>
#include <memory>

namespace surefoot {

/// Straight ahead, whatever the path.
inline std::unique_ptr<Walker> generated_walker(const WalkInfo&) {
    static const ClipSet set = make_synthetic_set();
    static const auto walk =
        std::find_if(set.clips.begin(), set.clips.end(), [](const Motion& clip) { return clip.name == "walk"; });
    std::vector<Transform> standing(static_cast<std::size_t>(walk->joint_count()));
    local_to_model(*set.skeleton, set.skeleton->rest, standing);
    return make_clip_walker(*walk, make_legs(*set.skeleton, set.roles, standing, 0));
}

}  // namespace surefoot
