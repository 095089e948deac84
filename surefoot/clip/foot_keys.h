#pragma once
// A clip's foot at a time as the two keys that it lies between, for who takes means of many in lanes (graph/kernels.h).

#include <surefoot/clip/packed_clip.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

struct FootKeyPlace {
    const FootKey* from = nullptr;
    const FootKey* to = nullptr;
    float share = 0;  ///< of the later key
};

/// foot_key_at (sample.h) is the mean of these. A clip that keeps curves has its key made in `made`, which must outlive
/// the answer.
FootKeyPlace foot_key_place(const PackedClip& clip, Side side, float time, FootKey& made) noexcept;

}  // namespace surefoot
