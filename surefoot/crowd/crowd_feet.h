#pragma once
// Feet of crowds on uneven ground, for a few tenths of a microsecond each: a foot's height comes from the plane of the
// ground where it stands, and while it swings goes over to the plane where it will stand next. Where that is follows
// from the blend alone (graph/foot_blend.h: a foot's print is one frame for as long as it stands), so nothing is played
// ahead, and the ground is asked once a frame for each foot that swings.
//
// Who is looked at closely is placed by ik/foot_placement.h, which goes around edges, rolls soles over them and limits
// paces; here soles may cut a stair's edge.

#include <surefoot/graph/foot_lanes.h>
#include <surefoot/ground/ground.h>

namespace surefoot {

/// The plane of the ground about a place, world.
struct GroundPlane {
    float x = 0, z = 0;              ///< [m] the place
    float height = 0;                ///< [m] there
    float slope_x = 0, slope_z = 0;  ///< rise a metre
};

struct CrowdFoot {
    GroundPlane from, to;  ///< where it stood, and where it stands or will stand
    float share = -1;      ///< of its step when it was last seen; below 0: not yet
};

/// All that a character remembers of its feet: saved, restored and compared as bytes. A new one stands on what it
/// finds.
struct CrowdFeet {
    std::array<CrowdFoot, 2> foot;
    float rise = 0;  ///< [m/s] of the body
};
static_assert(sizeof(CrowdFeet) == 92, "no padding");

struct CrowdFeetSettings {
    float up = 0.6f;        ///< [m] [Limit: >= 0] how far above the root ground is looked for
    float down = 1.0f;      ///< [m] [Limit: >= 0] and below
    float steepest = 0.7f;  ///< [Limit: >= 0] slope beyond which soles lie no steeper
    float rise = 0.12f;     ///< [s] [Limit: > 0] in which the body follows the ground under its feet
};

/// One character's feet in one frame, its plans known: `ask`, then the ground's answers, then `place` with its legs run
/// forward.
class CrowdFeetStep {
  public:
    /// Appends what has to be asked to `queries`, two at most, and returns how many.
    int ask(const LegPaths& paths, const FootPlans& plans, CrowdFeet& feet, const RootFrame& root,
            const CrowdFeetSettings& settings, std::span<GroundQuery> queries) noexcept;
    /// Moves the root up or down, for `dt` seconds since the last time, and says where the feet of that pose of `legs`
    /// shall be.
    void place(const LegPaths& paths, const FootPlans& plans, CrowdFeet& feet, RootFrame& root,
               std::span<const GroundHit> hits, float dt, const CrowdFeetSettings& settings, LegLanes& legs,
               int pose) noexcept;

  private:
    std::array<Vec3, 2> centre_;  // of each sole, world
    std::array<Vec3, 2> asked_;   // where the ground is asked for
    std::array<bool, 2> asks_{}, lands_{};
    bool is_new_ = false;
};

}  // namespace surefoot
