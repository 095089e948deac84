#include <surefoot/synthetic/biped.h>
#include <surefoot/synthetic/gait_cycle.h>
#include <surefoot/synthetic/synthetic_set.h>

namespace surefoot {

ClipSet make_synthetic_set() {
    const Rig biped = make_biped();
    ClipSet set{biped.skeleton, biped.roles, {}};
    for (const GaitParameters& gait : synthetic_gaits()) set.clips.push_back(make_gait_cycle(biped, gait));
    return set;
}

}  // namespace surefoot
