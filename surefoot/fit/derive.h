#pragma once
// Gaits derived from fitted ones, where nobody was recorded: one clip's gait at other speeds, a standing one that
// shifts its weight, stairs.

#include <surefoot/harmonic/harmonic_gait.h>

namespace surefoot {

/// The gait of one clip as a family that may be asked for other speeds. Half of a change of speed (its square root)
/// comes from longer strides, with swings of all joints in proportion, half from quicker ones, as people do. Turns
/// change the feet's paths only. Throws Error where the gait goes nowhere, is a family already, or the range is empty.
HarmonicGait stretched(const HarmonicGait& gait, float least_speed, float most_speed);

struct WeightShift {
    int breaths = 4;      ///< cycles of the standing gait while the weight goes to the left foot and back
    float sway = 0.022f;  ///< [m] of the hips to either side
    float drop_deg = 2;   ///< of the pelvis on the side without weight; the trunk stays upright
};

/// A standing gait that shifts its weight from foot to foot. Its cycle is `breaths` times as long.
HarmonicGait shifting_weight(const HarmonicGait& standing, const WeightShift& shift = {});

struct StairSteps {
    float riser = 0.17f;                          ///< [m] negative: down
    float tread = 0.28f;                          ///< [m] a step each
    float walk_speed = 1;                         ///< [m/s] of the walk whose body is used
    float least_speed = 0.3f, most_speed = 0.9f;  ///< [m/s] along the ground
};

/// A walking family's body on stairs: feet land flat on every tread and clear its edge, the trunk leans into the climb.
/// Each step covers one tread at any speed. Throws Error where the gait is no family that goes ahead.
HarmonicGait on_stairs(const HarmonicGait& family, const StairSteps& stairs = {});

/// The same gait with the series of its feet fitted anew to feet that hold the ground exactly (fit/grounded_cycle.h):
/// means over many strides slide and sink by centimetres, and few harmonics of a foot that stands still stand nearly
/// still. Of a family at speeds and turns over the range of its strides. Throws Error where there are no feet, or
/// stairs.
HarmonicGait holding_feet(const HarmonicGait& gait);

}  // namespace surefoot
