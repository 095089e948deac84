#pragma once
// Facts of a motion whose root motion is extracted and whose ground is at y = 0.

#include <surefoot/analysis/contacts.h>
#include <surefoot/motion/steer.h>

namespace surefoot {

/// Everything measured at once, so that the steps after it (classification, cycle search) need no second pass.
struct Measured {
    Tracks tracks;      ///< in world space, with soles, one cycle
    Contacts contacts;  ///< likewise
};

/// Fills velocities, events, contacts, cadence, skate, slope, heights and the seam of `facts` (not names, in_place,
/// locomotion, warnings). A motion marked cyclic is measured in the middle of three cycles, so that it has no ends.
Measured measure(const Motion& motion, const RoleMap& roles, const Legs& legs, ClipFacts& facts);

/// When the feet stand, as motion/steer.h takes it.
StanceFlags stance_flags(const ClipFacts& facts);

/// The clip's speed (signed) and travel direction from forward and lateral.
void set_travel(ClipFacts& facts, float forward, float lateral);

}  // namespace surefoot
