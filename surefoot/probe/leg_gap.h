#pragma once
// How near the two legs come to each other. Private to the room.

#include <surefoot/analysis/leg_track.h>

namespace surefoot {

/// Distance of two line segments [m].
float segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) noexcept;

/// Smallest distance [m] over the frames between the shank or foot of one leg and those of the other, each a capsule
/// about as thick as a leg of `leg_length` is; negative where they intersect, by how deep.
float smallest_leg_gap(const WalkTrack& track, FrameRange range, float leg_length);

}  // namespace surefoot
