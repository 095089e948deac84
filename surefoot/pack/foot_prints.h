#pragma once
// The foot tracks of a clip (clip/foot_prints.h), measured from its poses.

#include <surefoot/analysis/clip_facts.h>
#include <surefoot/clip/packed_clip.h>
#include <surefoot/rig/leg.h>
#include <surefoot/rig/skeleton.h>

#include <span>

namespace surefoot {

/// Gives `clip` the tracks of both feet. It has its velocity, turn rate and phase map already; `locals` [frame * joints
/// + joint] are its poses as seen from its steady root; `facts` tells when feet leave the ground (where it does not:
/// after `facts.duty`, or 60 %, of a step). Clips without cycles get tracks of age 0.
void add_foot_prints(PackedClip& clip, const Skeleton& skeleton, const Legs& legs, std::span<const Transform> locals,
                     const ClipFacts& facts);

}  // namespace surefoot
