#pragma once
// Generated clips as walkers, for tests of this room.

#include <surefoot/course/sweep.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

namespace surefoot {

inline const ClipSet& generated_set() {
    static const ClipSet set = make_synthetic_set();
    return set;
}
inline const Motion& generated_clip(const std::string& name) {
    for (const Motion& clip : generated_set().clips)
        if (clip.name == name) return clip;
    throw std::runtime_error("no generated clip " + name);
}
inline Legs generated_legs() {
    const ClipSet& set = generated_set();
    std::vector<Transform> standing(set.skeleton->rest.size());
    local_to_model(*set.skeleton, set.skeleton->rest, standing);
    return make_legs(*set.skeleton, set.roles, standing, 0);
}
inline std::unique_ptr<Walker> generated_walker(const std::string& name = "walk") {
    return make_clip_walker(generated_clip(name), generated_legs());
}
/// Straight ahead, whatever the path.
inline std::unique_ptr<Walker> walk_generated(const WalkInfo&) { return generated_walker(); }

}  // namespace surefoot
