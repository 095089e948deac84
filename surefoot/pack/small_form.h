#pragma once
// A packed clip in its small form (clip/packed_clip.h): as few keys as an error allows.

#include <surefoot/clip/packed_clip.h>
#include <surefoot/rig/skeleton.h>

#include <functional>
#include <optional>
#include <span>

namespace surefoot {

/// How far a clip is from the motion that it was made from [m].
using MeasureClip = std::function<float(const PackedClip& clip)>;

/// The smallest form of a clip whose error is within `limit` [m]. `clip` keeps every frame; `locals` [frame * joints +
/// joint] are what it was packed from. Nothing where there is none: a joint turns more than 120 degrees to a side of
/// its middle, the clip is shorter than four frames or has more than 512 joints, or the limit cannot be met.
std::optional<PackedClip> small_form(const PackedClip& clip, const Skeleton& skeleton,
                                     std::span<const Transform> locals, float limit, const MeasureClip& measure);

}  // namespace surefoot
