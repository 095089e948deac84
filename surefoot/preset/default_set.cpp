#include <surefoot/preset/biped.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/preset/gait_cycle.h>

namespace surefoot {

DefaultSet make_default_set() {
    const Rig biped = make_biped();
    DefaultSet set{biped.skeleton, biped.roles, {}};
    for (const GaitParameters& gait : default_gaits()) set.clips.push_back(make_gait_cycle(biped, gait));
    return set;
}

}  // namespace surefoot
