#pragma once
// Mode colvin2013 step by step, for pictures and tests: what `place_feet` and `solve_colvin` work with, nothing
// computed twice. Colvin & Kajala 2013, §IV.B and figures 7 to 10.

#include <surefoot/ik/foot_placement.h>
#include <surefoot/ik/two_bone.h>

#include <array>

namespace surefoot {

/// After steps 1 and 2; solve_colvin does the rest of each leg.
struct ColvinFrame {
    float ground = 0;                 ///< [m] under the root
    float lowered = 0;                ///< [m] <= 0: by how much the root sinks
    std::array<ColvinInput, 2> legs;  ///< by Side; world, the hips sunk
};
ColvinFrame colvin_frame(const FootRig& rig, const FootInput& input, const Ground& ground) noexcept;

/// Positions are relative to the hip.
struct ColvinTrace {
    ColvinLeg posed;  ///< step 3: with the knee's angle, the thigh at 90 degrees
    Quat swing;       ///< step 4
    ColvinLeg swung;  ///< after it: the foot is there, the knee anywhere
    float twist = 0;  ///< [rad] step 5, about hip -> target
};
/// As solve_colvin; a leg or target of no length leaves `trace` as it is.
TwoBoneResult solve_colvin(const ColvinInput& leg, ColvinTrace& trace) noexcept;

}  // namespace surefoot
