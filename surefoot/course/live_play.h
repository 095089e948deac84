#pragma once
// Live gaits as motions and as walkers: what a character does that is asked for one thing after the other.

#include <surefoot/course/walk.h>
#include <surefoot/live/live.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot {

/// Something to ask for, and for how long.
struct LiveLeg {
    LiveRequest request;
    float seconds = 1;
};

/// The motion from the origin on; it begins as one that has long been doing the first.
Motion play(const LiveRig& rig, const std::vector<LiveLeg>& legs, float fps = 60, float phase = 0);

/// Goes along `path` as `going` says, its turn that of the path; the speed is that of `start`. `rig` must outlive the
/// walker.
std::unique_ptr<Walker> make_live_walker(const LiveRig& rig, const LiveRequest& going, std::vector<PathLeg> path);

}  // namespace surefoot
