#pragma once
// A plant: one rigid transform of the whole foot for the length of a stance, and the search for where it goes.
//
// A lock plus an offset would flatten the heel-toe roll that makes a step look like one. Moving the whole foot rigidly
// keeps it, and on flat ground the transform is the identity.

#include <surefoot/ground/ground.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

/// T(p) = foothold + (v - v_c) + tilt v_c with v = p - centre. |v_c| is |v| near the plant and saturates smoothly, so
/// that a foot swinging far from its plant is not turned about it on a long lever.
struct Plant {
    Vec3 centre;    ///< [m] world, y = 0: middle of heel and ball in the clip on flat ground
    Vec3 foothold;  ///< [m] world: where that point goes
    Quat tilt;      ///< takes flat ground to the ground there
    /// Share by which the foot is taken out of the ground where the clip itself sinks it: 0 on level ground that goes
    /// on level (there the clip is not to be changed), more on any other.
    float uneven = 0;
    double passing = 0;  ///< [s] on the state's clock: when the root passes over it
    /// The foot stays at `foothold`, turned as `heading` says, whatever the clip's foot does meanwhile: a host moves
    /// the root of a clip that stands.
    bool held = false;
    Vec3 heading{0, 0, 1};  ///< unit, level: heel to ball in the clip when it was planted; `tilt` comes on top
};

/// Where a plant puts a point. The lever is free up to about 0.3 of `leg_length` and ends at 0.47 of it.
Vec3 planted(const Plant& plant, Vec3 point, float leg_length) noexcept;

/// The transform of a plant while the clip's foot has these sole points: itself, but for a held one.
Plant plant_for(const Plant& plant, Vec3 heel, Vec3 ball) noexcept;

/// True where the foothold is not where the clip steps.
inline bool is_sought_out(const Plant& plant) noexcept {
    constexpr float k_same = 0.003f;  // [m]
    return planar_length(plant.foothold - plant.centre) > k_same;
}

/// Looks down at the ground from a given level; where there is none it answers with that level.
struct GroundProbe {
    const Ground& ground;
    float level, up, down;  ///< [m]
    float fallback;         ///< [m]

    float height(float x, float z) const noexcept;
    /// What is under several places; y of the points is ignored. [Limit: at most k_batch]
    void look(std::span<const Vec3> places, std::span<GroundHit> out) const noexcept;
    /// Its height, or where there is nothing `fallback`. [Limit: as look]
    void heights(std::span<const Vec3> places, std::span<float> out) const noexcept;
    static constexpr std::size_t k_batch = 64;
};

/// The outline of a foot standing flat in the clip, as the search needs it.
struct Footprint {
    Vec3 centre;               ///< [m] world, y = 0: middle of heel and ball
    Vec3 forward{0, 0, 1};     ///< unit, level: heel to ball
    float half_length = 0.1f;  ///< [m] half the way from heel to ball
    float tip = 0.16f;         ///< [m] from the centre to the toe tip
    float half_width = 0.04f;  ///< [m]
};
/// `leg_length` gives the width, which no skeleton tells.
Footprint make_footprint(Vec3 heel, Vec3 ball, Vec3 toe_tip, float leg_length) noexcept;

/// Finds firm ground near the footprint: within `along` and `across` of where the clip steps, the place that costs
/// least: the sole's unevenness over a 9 x 3 grid with an overhang behind the heel, distance moved, ground that stands
/// up just ahead of the toe or behind the heel, steep pitch. Plain ground is accepted where the clip steps.
Plant find_foothold(const Footprint& foot, const GroundProbe& probe, float along, float across) noexcept;

}  // namespace surefoot
