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

/// straight; curve (30 deg/s to the left); eight (two such circles, one to either side); start-stop (stand, go, stop
/// and go again, over and over). Throws Error for another name.
std::vector<LiveLeg> live_path(const std::string& name, const LiveRequest& going, float seconds);

/// Asks `legs` one after the other, the last for good. `rig` must outlive the walker. Where the speed at which a walk
/// is to start is not that of a leg, all legs that go are asked for it.
std::unique_ptr<Walker> make_live_walker(const LiveRig& rig, std::vector<LiveLeg> legs);

}  // namespace surefoot
