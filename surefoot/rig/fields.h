#pragma once
// What skeletons and bodies consist of, for archives (base/field_archive.h).

#include <surefoot/base/field_archive.h>
#include <surefoot/rig/leg.h>
#include <surefoot/rig/mirror.h>

namespace surefoot {

SUREFOOT_FIELDS(Skeleton, names, parents, rest, tips)
SUREFOOT_FIELDS(RoleMap, joints)
SUREFOOT_FIELDS(Leg, upper, lower, foot, toes, upper_length, lower_length, heel, mid, ball, toe_tip, up, forward)
SUREFOOT_FIELDS(Legs, side, hips)
SUREFOOT_FIELDS(MirrorMap, partner, correction, carries)

}  // namespace surefoot
