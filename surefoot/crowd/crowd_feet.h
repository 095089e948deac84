#pragma once
// Feet of crowds on uneven ground, for a few tenths of a microsecond each: a foot's height comes from the plane of the
// ground where it stands, and while it swings goes over to the plane where it will stand next. Where that is follows
// from the blend alone (graph/foot_blend.h: a foot's print is one frame for as long as it stands), so nothing is played
// ahead, and the ground is asked once a frame for each foot that swings.
//
// Who is looked at closely is placed by ik/foot_placement.h, which goes around edges, rolls soles over them and limits
// paces; here soles may cut a stair's edge.

#include <surefoot/crowd/kernels.h>
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

/// The feet of up to four characters in one frame, their plans known: all of `add`, then `ask`, the ground's answers,
/// and `place`.
class CrowdFeetStep {
  public:
    CrowdFeetStep(const LegPaths& paths, const LegChains& chains, const CrowdFeetSettings& settings) noexcept;
    bool full() const noexcept { return legs_.full(); }
    int count() const noexcept { return legs_.count(); }
    /// A character: its feet and root, moved by `place`, and its pose without feet. `dt`: [s] since its last frame.
    void add(const FootPlans& plans, CrowdFeet& feet, RootFrame& root, float dt, std::span<Transform> locals) noexcept;
    /// Appends what has to be asked to `queries`, two a character at most, and returns how many.
    std::size_t ask(std::span<GroundQuery> queries) noexcept;
    /// Moves roots up or down, and the legs of poses onto the ground. `hits` answer what was asked.
    void place(std::span<const GroundHit> hits) noexcept;

  private:
    static constexpr std::size_t k_most = LegLanes::k_poses;
    struct Character {
        CrowdFeet* feet;
        RootFrame* root;
        float dt;
        bool is_new;
    };
    void take(std::span<const GroundHit> hits) noexcept;
    void follow_ground() noexcept;

    const CrowdFeetSettings& settings_;
    LegLanes legs_;
    GroundLanes lanes_;
    Character character_[k_most];
    float decay_ = 1, decay_dt_ = 0;  ///< of the bodies' spring over a time
};

}  // namespace surefoot
