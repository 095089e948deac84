#pragma once
// Feet on uneven ground, for clips made on flat ground.
//
// A frame goes like this: the host samples its pose, runs it to model space, and hands the legs (`read_legs`) with the
// world root to `place_feet`. The answer is a vertical offset of the hips and the local rotations of two legs, which
// `apply` writes into the pose; one local-to-model pass later the character stands on the ground.
//
// Three modes:
//   none        the root is put on the ground under it, the legs stay as animated
//   colvin2013  Colvin & Kajala 2013, §IV.B, the five steps as printed
//   surefoot    each plant is one rigid transform of the whole foot onto a foothold; swings clear the ground; the hips
//               follow the footholds and never ask for more than a leg has (docs/feet.md)
//
// Mode `surefoot` looks about a second ahead through `LegPreview`: the host answers with the legs as they will be,
// un-placed, if steering stays as it is (copy the locomotion state, advance the copy). Footholds and swings are planned
// once a step; where steering has moved a coming foothold they are planned anew, and position and velocity go on
// without a jump. On flat ground nothing changes at all.
//
// A host may also move the root of a clip that stands: feet then step after it by themselves.
//
// State is one trivially copyable block: saving and rolling back is memcpy. No call allocates or throws.

#include <surefoot/ik/hips.h>
#include <surefoot/ik/lean.h>
#include <surefoot/ik/plant.h>
#include <surefoot/ik/swing_hump.h>

#include <array>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace surefoot {

enum class FootMode : std::uint8_t { none, colvin2013, surefoot };

/// "none", "colvin2013", "surefoot".
const char* foot_mode_name(FootMode mode) noexcept;

struct FootSettings {
    FootMode mode = FootMode::surefoot;
    float reach = 0.975f;     ///< share of a leg's length that the hips leave it, where the clip does not ask more
    float hip_stiffness = 8;  ///< [1/s] of the critically damped spring on the footholds' heights
    float swing_clearance =
        0.02f;                    ///< [m] at most, between a swinging sole and the ground; less where the clip has less
    float search_along = 0.16f;   ///< [m] how far a foothold may move along the foot to find firmer ground
    float search_across = 0.06f;  ///< [m] and to its sides
    float ground_up = 1.5f;       ///< [m] how far above and below the root's height ground is looked for
    float ground_down = 2.5f;
    bool limit_pace = true;  ///< see FootOutput::speed_limit
    bool lean = true;        ///< see FootOutput::lean
};

/// Model-space joints of one leg, and the world rotations its local rotations are relative to.
struct LegPose {
    Transform upper, lower, foot, toes;  ///< [m] relative to the root; toes = foot where there is no toe joint
    Quat upper_parent, lower_parent, foot_parent, toes_parent;
};

struct LegsPose {
    std::array<LegPose, 2> side;  ///< by Side
};

/// Supplied by the host: what the legs will do. `ahead` are seconds from now, ascending. Answers the un-placed legs and
/// the world root at each of them; must not allocate.
class LegPreview {
  public:
    virtual ~LegPreview() = default;
    virtual void sample(std::span<const float> ahead, std::span<LegsPose> legs,
                        std::span<RootFrame> roots) const noexcept = 0;
};

/// Everything that is the same for all characters of one kind. Immutable; made once.
struct FootRig {
    Legs legs;
    FootSettings settings;
    std::array<Vec3, 2> knee_forward;  ///< in the thigh's frame: where a straight knee would bend to
    int hips = k_no_joint;
    LeanJoints lean_joints;
    std::vector<std::int16_t> parents;          ///< of the skeleton's joints
    std::shared_ptr<const SwingSolver> solver;  ///< the swing programme's constant matrices
};

/// Where the knee of a standing leg would bend to if it were straight, in the thigh's frame: to where the toes point.
Vec3 knee_forward(const Leg& leg, std::span<const Transform> standing) noexcept;

/// `standing` is the pose, in model space, that `legs` was made from: it tells where knees bend to.
FootRig make_foot_rig(const Skeleton& skeleton, const Legs& legs, std::span<const Transform> standing,
                      const FootSettings& settings = {});

/// The legs of a pose in model space (joint_count() transforms).
LegsPose read_legs(const FootRig& rig, std::span<const Transform> models) noexcept;

/// What foot placement remembers of one foot.
struct FootState {
    Plant plant;  ///< the one it stands on or left last
    Plant next;   ///< the one to come, where `has_next`
    bool has_next = false;
    double lift = 0, strike = 0;  ///< [s] on the state's clock: the coming or running swing
    double hump_from = 0;         ///< [s] when `hump` begins: the lift, or a replanning in mid-swing
    Hump hump;
    Vec3 shift_early, shift_late;  ///< [m] level: how far the swing goes out of the way of edges, at most
    /// How far the heel rises about the ball before it lifts, where the leg would be too short [rad]; and when [s].
    float rise = 0;
    double rise_from = 0, rise_peak = 0, rise_until = 0;
    float step_height = 0;   ///< [m] that a swing rises by itself, where the clip's own foot stays on the ground
    bool rests = false;      ///< the clip's foot stands, said the forecast of this plan, and stays where it is
    bool dragged = false;    ///< the root takes the clip's foot along, this frame
    Vec3 last_middle;        ///< [m] between heel and ball of the clip's foot, a frame ago
    double foreseen_at = 0;  ///< [s] the strike, or half a second after the plan
    Vec3 foreseen;           ///< [m] where the clip's foot was to be then, said the forecast of this plan
    // What replanning left over, fading out by the strike, so that position and velocity go on without a jump.
    double fade_from = 0, fade_until = 0;
    Vec3 fade_offset, fade_rate;  ///< [m], [m/s] level
    Vec3 fade_turn;               ///< [rad] rotation vector
};

inline constexpr float k_no_speed_limit = 1e6f;  ///< [m/s]

/// What foot placement remembers of how fast the ground ahead lets the character go.
struct PaceState {
    float limit = k_no_speed_limit;  ///< [m/s] handed to steering
    float from = 0;                  ///< [m/s] from which it slows down
    float cadence = 2;               ///< [1/s] steps
    double next_look = 0;            ///< [s] on the state's clock
    double held_until = 0;           ///< [s] before then the limit does not rise
};

/// A character's feet. As constructed it is "not started"; a teleport goes back to that.
struct FootPlacementState {
    double clock = 0;       ///< [s] since the start
    double next_plan = 0;   ///< [s] plan at the latest then
    double next_check = 0;  ///< [s] look at the coming footholds again then
    std::array<FootState, 2> feet;
    FootholdLine line;
    HeightSpring base;  ///< of the hips, before the legs' reach
    HipLimiter limiter;
    HeightRest hips_rest;  ///< what a new plan took from under the hips' way, fading
    HeightSpring lean;     ///< [rad], [rad/s] of the trunk
    PaceState pace;
    RootFrame last_root;         ///< a frame ago
    Vec3 ground_velocity;        ///< [m/s] see FootOutput
    HeightSpring weight{-1, 0};  ///< of all this, eased; -1: not known yet
    std::int32_t plans = 0;      ///< how often it planned: for tests and profiles
    bool started = false;
};
static_assert(std::is_trivially_copyable_v<FootPlacementState>);

struct FootInput {
    float dt = 0;    ///< [s] since the last call; 0 at the first
    RootFrame root;  ///< world; y is where ground is looked for, and what hips_offset is relative to
    LegsPose legs;   ///< un-placed
    /// [0, 1] how much of foot placement shall apply; 0 for jumps and falls. It may step: feet let go and are taken up
    /// again smoothly, within 0.4 s. At 0 the pose is the clip's, at the root's own height.
    float weight = 1;
    bool teleport = false;  ///< forget everything: the character was moved by hand
};

struct FootOutput {
    float hips_offset = 0;  ///< [m] to add to the hips' model-space height (root.position.y stays as passed in)
    struct LegRotations {
        Quat upper, lower, foot, toes;  ///< new local rotations; toes only where there is a toe joint
    };
    std::array<LegRotations, 2> leg;
    /// [rad] By which the trunk leans forward, into a slope or back from it (slope_lean). Mode surefoot only.
    float lean = 0;
    bool moves_legs = false;                 ///< false: the legs stay as they were, `leg` is not set
    std::array<bool, 2> planted{};           ///< stands on its foothold
    std::array<bool, 2> pulled_in{};         ///< could not reach its target
    std::array<std::uint32_t, 2> surface{};  ///< GroundHit::surface under each foot: ice or mud may drive a blend
    std::array<Vec3, 2> surface_velocity;    ///< [m/s] of the ground under each foot
    /// [m/s] Of what it stands on: move the root by it, times dt, before the next call, and a platform carries the
    /// character; footholds go with the ground by themselves. Mode surefoot only.
    Vec3 ground_velocity;
    /// [m/s] Steer no faster: steps that fit the stairs or the slope ahead. Longer ones would fold a knee too far, and
    /// that only steering can mend. It is said in good time to slow down and may step: ease what you ask for as you do
    /// a stick (`approach`), in what LegPreview foresees, too. Mode surefoot only.
    float speed_limit = k_no_speed_limit;
};

/// One frame. `preview` may be null for the modes none and colvin2013.
void place_feet(const FootRig& rig, FootPlacementState& state, const FootInput& input, const Ground& ground,
                const LegPreview* preview, FootOutput& output) noexcept;

/// Writes an output into a pose: the hips' translation, the legs' rotations and, where it leans, those of trunk, neck
/// and upper arms. `models` is the un-placed pose in model space that the legs were read from.
void apply(const FootRig& rig, const FootOutput& output, std::span<const Transform> models,
           std::span<Transform> locals) noexcept;

/// Rotation about the toe joint that lifts the tip of `toe` (joint to tip) by `lacking` metres, as far as toes bend.
Quat bend_toe_up(Vec3 toe, float lacking) noexcept;

/// Cleans an un-placed pose before it is placed: toes bend up where the clip has their tips under its own flat ground
/// (y = 0 in model space), which captured toes often are when a foot leaves. No joint moves but those below the toes.
void lift_toe_tips(const FootRig& rig, std::span<const Transform> models, std::span<Transform> locals) noexcept;

}  // namespace surefoot
