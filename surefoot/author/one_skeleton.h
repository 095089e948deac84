#pragma once
// Clips of mixed skeletons brought to one, which a blend space needs. Private to the room.

#include <surefoot/author/gather.h>

namespace surefoot {

/// Leaves candidates of one skeleton: `options.actor`'s, or else the one that most clips share, the first of
/// equals. The others are retargeted to it, which their provenance and one warning in `gathered` say; without
/// `options.retarget`, or where a clip cannot be, they are left out with the reason.
void keep_one_skeleton(Gathered& gathered, const GatherOptions& options);

}  // namespace surefoot
