#pragma once
// Where a foot is at any moment of a gait's cycle: rolling over a foothold that is fixed in the world, or on its way to
// the next one.

#include <surefoot/synthetic/biped.h>
#include <surefoot/synthetic/gait_cycle.h>

namespace surefoot {

/// A foot as seen from the moving root frame.
struct FootPose {
    Vec3 ankle;          ///< [m]
    float yaw = 0;       ///< [rad]
    float pitch = 0;     ///< [rad] toes up positive
    float toe_bend = 0;  ///< [rad] toes up against the foot
    bool stands = false;
};

/// The root's motion over `seconds` at the gait's constant velocity and yaw rate: an arc, exactly.
RootFrame gait_travel(const GaitParameters& gait, float seconds) noexcept;

class FootPath {
  public:
    /// `foothold` is the flat foot's ankle on the ground as seen from the root at mid-stance.
    FootPath(const GaitParameters& gait, const LegSize& size, RootFrame foothold);

    /// `phase` 0 is this foot's strike.
    FootPose at(float phase) const;

  private:
    float pitch(float phase) const;
    float toe_bend(float phase) const;
    Vec3 rolled(float phase) const;
    float sole_reach(float phase, float softness) const;
    Vec3 rolled_velocity(float phase, float step) const;
    FootPose standing(float phase) const;
    FootPose swinging(float phase) const;

    GaitParameters gait_;
    LegSize size_;
    RootFrame foothold_;
    float cycle_;  // seconds
    PeriodicCurve pitch_, toe_share_;
};

}  // namespace surefoot
