#pragma once
// Gaits played live: no clips, and at any moment another speed, turn or manner of going, or a stop.
//
//     LiveState state = start(rig, {.speed = 1.4f});
//     LiveFrame f = update(rig, state, {.speed = 3.5f, .manner = 0}, dt);
//     world_root = world_root * f.root_delta;
//     pose(rig, state, scratch, locals);                    // then foot placement, then local_to_model
//
// What is asked for is glided to (glide.h). Limbs keep time by coupled oscillators (gait/oscillators.h), so feet leave
// the ground in order. A foot that stands has a place in the world and keeps it, whatever root, speed and manner do
// meanwhile; a foot on its way goes from there to where the root will be in the middle of its next stance, foreseen
// from the glides, along the arc between, and its place is found anew each frame until it is there. Where nothing
// changes, all of this is what the fitted gait does by itself (harmonic/harmonic_gait.h), to rounding.
//
// To stop, steps go on until both feet stand where they belong under the root as it comes to rest: one step, or two.
// To start, the body leaves first and the foot whose turn it is follows.
//
// A character is one LiveState: saving and rolling back is memcpy. update costs no pose; nothing allocates or fails.

#include <surefoot/gait/oscillators.h>
#include <surefoot/harmonic/harmonic_lanes.h>
#include <surefoot/live/glide.h>

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace surefoot {

inline constexpr int k_most_manners = 6;

/// One manner of going: a family of gaits (walking and running), or the gait of a single clip.
struct LiveManner {
    std::string name;
    std::shared_ptr<const HarmonicGait> gait;
    /// When each limb's turn is; without (null): as the gait has it.
    const FootfallPattern* pattern = nullptr;
};

/// What all characters of a kind share. Immutable; made by make_live_rig.
struct LiveRig {
    std::shared_ptr<const Skeleton> skeleton;
    Legs soles;
    LegPaths legs;
    std::vector<LiveManner> manners;   ///< the first is how it starts
    std::vector<HarmonicLanes> lanes;  ///< of the manners' gaits
    std::vector<std::uint8_t> limb;    ///< by joint: the Limb it belongs to
    std::vector<Transform> stand;      ///< local pose of standing still
    /// By manner: [s] the least in which a body gets into it or out of it; 0 where its mean posture is near the
    /// first's.
    std::array<float, k_most_manners> change_seconds{};
    std::array<Vec3, k_most_manners> direction{};  ///< by manner: which way it goes, seen from its root; unit
    std::array<FootPrint, 2> stand_print;          ///< by Side: flat on the ground, seen from the root
    std::array<RootFrame, 2> stand_place;          ///< by Side: the same as a place on the ground

    std::shared_ptr<const HarmonicGait> idle;  ///< what it does while it stands; null: nothing
    HarmonicLanes idle_lanes;                  ///< all joints follow one phase
    std::vector<float> idle_values;
    std::vector<Transform> idle_to_stand;  ///< by joint: what takes the idle's mean posture to `stand`
    float idle_hz = 0;                     ///< [cycles/s]
};

/// `manners` are of one skeleton, with legs; at most k_most_manners. It stands in the first manner's mean posture, with
/// its feet side by side; what `idle` (of the same skeleton) does about its own mean posture is laid over that, and the
/// feet stay. Throws nothing; check `problem` before use.
LiveRig make_live_rig(std::vector<LiveManner> manners, std::shared_ptr<const HarmonicGait> idle = nullptr);
/// What is wrong with it, as a sentence; empty: nothing, and then update and pose cannot fail.
std::string problem(const LiveRig& rig);

struct LiveRequest {
    float speed = 0;  ///< [m/s] in the direction in which the manner goes (a family: along its facing)
    float turn = 0;   ///< [deg/s] positive to its left; both 0: stand
    int manner = 0;   ///< index into LiveRig::manners
    /// [s] in which to get there; changes that no body makes so quickly take longer: from a run to a walk a second,
    /// into a crouch and out of it nearly four.
    float glide = 0.8f;
};

/// One foot. Frames are planar: places on the ground with a heading.
struct LiveFoot {
    RootFrame plant;        ///< where it stands, or stood last, seen from the root as it is now
    RootFrame coming;       ///< the root in the middle of the next stance, seen from `plant`; used in the swing
    RootFrame coming_rate;  ///< [1/s] how that changes
    float lift = 0;         ///< (0, 1) own phase at which it left the ground; while it stands, has to leave it at last
    float flat = 0;         ///< [0, 1] how flat it stood when it left
    bool swings = false;
};

/// All that a character remembers.
struct LiveState {
    Oscillators limbs;
    Glide speed, turn;                           ///< [m/s], [deg/s] of the root
    Glide posture_speed, posture_turn;           ///< of the joints, which take their time
    std::array<Glide, k_most_manners> weight{};  ///< of manners; add up to 1
    Glide standing;                              ///< 0: goes, 1: stands
    std::array<LiveFoot, 2> feet;                ///< by Side
    float breath = 0;                            ///< [0, 1) of the idle's cycle
    std::int32_t rests = 0;                      ///< 1: both feet have arrived, and the limbs' time stands still
};
static_assert(std::is_trivially_copyable_v<LiveState> && sizeof(LiveState) <= 512);

struct LiveFrame {
    RootFrame root_delta;         ///< this frame's root motion seen from the root before it
    Vec3 velocity;                ///< [m/s] of the root in its own frame, at the end of the frame
    float turn = 0;               ///< [deg/s] the same
    float frequency = 0;          ///< [cycles/s]
    std::array<bool, 2> planted;  ///< by Side: stands at its place
    bool rests = false;           ///< stands, breathing at most, and will until asked otherwise
};

/// A character that has long been doing as asked; `phase` is that of the left foot. Asked for nothing, it stands.
LiveState start(const LiveRig& rig, const LiveRequest& request, float phase = 0) noexcept;

/// Advances by `dt` >= 0 seconds.
LiveFrame update(const LiveRig& rig, LiveState& state, const LiveRequest& request, float dt) noexcept;

/// Where the root will be in `seconds` if nothing else is asked for, seen from where it is.
RootFrame travel(const LiveRig& rig, const LiveState& state, float seconds) noexcept;

/// Working memory of `pose`, made once and used for one character after the other; keeps what depends on speed and turn
/// alone for as long as they stay.
struct LiveScratch {
    explicit LiveScratch(const LiveRig& rig);
    struct Manner {
        std::vector<float> values;
        const HarmonicLanes* lanes = nullptr;  ///< of the values; null: none yet
        float speed = 0, turn = 0;
        std::array<FootPrint, 2> middle;  ///< of the values: the feet in the middle of their stance
        HarmonicLanes::Waves waves;       ///< of the limbs, then of the two feet
    };
    std::vector<Manner> manners;
    HarmonicLanes::Waves idle_waves;
    std::vector<Transform> locals;
};

/// The local pose: joint_count() transforms, the root at the origin, facing +Z.
void pose(const LiveRig& rig, const LiveState& state, LiveScratch& scratch, std::span<Transform> locals) noexcept;

}  // namespace surefoot
