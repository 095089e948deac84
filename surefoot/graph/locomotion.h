#pragma once
// A character that goes where it is told: blend spaces over speed, turn and sideways speed in, leaves to blend and
// root motion out.
//
// The graph is immutable and shared by all characters of its kind; a character is one LocomotionState, a few bytes
// that are saved, restored and rolled back by copying them. Each frame:
//
//     LocomotionFrame f = update(graph, state, {.speed = 1.4f, .turn = 30.0f}, dt);
//     world_root = world_root * f.root_delta;
//     pose(graph, f, locals);                       // then foot placement, then local_to_model
//
// What it promises: within the hull of the spaces (and as far beyond as they extrapolate) the root moves with exactly
// the velocity and turn rate asked for, if they weigh barycentrically and have axes in m/s and deg/s for them;
// cyclic leaves share one phase, whose rate makes the blended feet move as fast as the root does (see
// graph/README.md), so blending adds no skate; a lone clip plays as recorded.

#include <surefoot/clip/sample.h>
#include <surefoot/graph/foot_memory.h>
#include <surefoot/space/blend_space.h>

#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

namespace surefoot {

/// Axes of the user's own (style, weariness, load) that one graph may have.
inline constexpr int k_max_custom_axes = 4;

/// How a character should move, in its own frame. Steps in it are steps in the pose: smooth it (`approach`).
struct LocomotionRequest {
    float speed = 0;    ///< [m/s] along its facing, negative backward
    float turn = 0;     ///< [deg/s] positive to its left
    float lateral = 0;  ///< [m/s] sideways, positive to its left
    float slope = 0;    ///< [deg] of the ground under it along its way, positive uphill; read by spaces with that axis
    std::array<float, k_max_custom_axes> custom{};  ///< by LocomotionGraph::custom_slot, in units of the axis
    std::int32_t style = -1;                        ///< index into LocomotionGraph::styles, -1: none
    float style_weight = 0;                         ///< [0, 1] how intense
};

/// Moves `current` towards `wanted` by at most these rates; a host's simplest steering filter.
struct RequestRates {
    float acceleration = 2.5f;         ///< [m/s^2] for speed and lateral together
    float turn_acceleration = 240.0f;  ///< [deg/s^2]
    float slope_rate = 60.0f;          ///< [deg/s]
    float custom_rate = 2.0f;          ///< [1/s] of an axis' unit, and of a style's weight
};
LocomotionRequest approach(const LocomotionRequest& current, const LocomotionRequest& wanted, float dt,
                           const RequestRates& rates = {}) noexcept;

/// What of a request an axis of a space reads, by the axis' name; every other name is one of the user's own. `pace` is
/// the size of the planar velocity, `travel` its direction against the facing (0 ahead, +90 to the left): a blend by
/// them obeys direction and pace only nearly (means of directions are no arcs), by forward and lateral exactly.
enum class RequestAxis : std::uint8_t { none, speed, turn, forward, lateral, slope, pace, travel, custom };

/// A blend space whose samples are clips.
struct LocomotionSpace {
    BlendSpace space;
    std::vector<std::int32_t> clips;  ///< of each sample: index into LocomotionGraph::clips
    std::vector<Vec3> velocities;     ///< [m/s] of each sample's root: what its place in the space declares
    std::vector<float> turns;         ///< [rad/s] the same
    std::array<RequestAxis, k_max_dimensions> axes{};
    std::array<std::uint8_t, k_max_dimensions> custom_slots{};  ///< of custom axes: index into the request's `custom`
    bool has_turn = false;  ///< some axis is the turn; if none is, the turn asked for is passed through to the root

    bool empty() const noexcept { return space.samples.empty(); }
};

/// Another manner of moving (tired, proud, sneaking): clips that go straight at one or several speeds, in a space over
/// speed, laid over all that the locomotion spaces can do (Delicado & Pelechano 2019, §4). Other than there, the root
/// moves as the locomotion spaces say at any weight, and the feet with it.
struct LocomotionStyle {
    std::string name;
    LocomotionSpace space;
    /// By joint [0, 1]; empty: the whole body, stride and feet included. A mask leaves hips and legs alone; the style
    /// is then laid over the finished pose.
    std::vector<float> mask;
};

struct LocomotionGraph {
    std::shared_ptr<const Skeleton> skeleton;
    std::vector<PackedClip> clips;
    LocomotionSpace facing;   ///< (speed, turn), or one of them
    LocomotionSpace lateral;  ///< (forward, lateral), or one of them; may be empty
    std::vector<LocomotionStyle> styles;
    LegPaths legs;  ///< set_legs; without them blended legs are as their joints' angles say
    /// Folded travel angle [rad, 0 ahead, pi/2 sideways] of the lateral space's sample nearest to ahead (or to
    /// behind) in each quadrant: left ahead, right ahead, left behind, right behind.
    std::array<float, 4> side_travel{};
    std::vector<std::string> custom_names;  ///< [Limit: k_max_custom_axes] in the order of a request's `custom`

    /// Where in a request's `custom` the axis of that name is read, or -1.
    int custom_slot(std::string_view name) const noexcept {
        for (std::size_t i = 0; i < custom_names.size(); ++i)
            if (custom_names[i] == name) return static_cast<int>(i);
        return -1;
    }
};

/// The request that lies at a place of a space, `at` holding one value an axis.
LocomotionRequest request_at(const LocomotionSpace& space, std::span<const float> at) noexcept;

/// A space before it is joined with its clips, and what its axes are called tells what they read (RequestAxis).
struct SpaceDefinition {
    BlendSpace space;
    std::vector<std::int32_t> clips;
};
/// Builds a graph; at least one of the spaces has samples. Check it with `problem` before use.
LocomotionGraph make_locomotion_graph(std::shared_ptr<const Skeleton> skeleton, std::vector<PackedClip> clips,
                                      SpaceDefinition facing, SpaceDefinition lateral);
/// A space by itself, over parameters of its own (program/program.h, SpaceNode).
LocomotionSpace join_clips(SpaceDefinition definition, const std::vector<PackedClip>& clips);
/// Lets blends put their feet where feet stand (graph/foot_blend.h). `standing` is the pose, in model space, that
/// `legs` was made from.
void set_legs(LocomotionGraph& graph, const Legs& legs, std::span<const Transform> standing);
/// Adds a style; `mask` as in LocomotionStyle.
void add_style(LocomotionGraph& graph, std::string name, SpaceDefinition definition, std::vector<float> mask = {});
/// What is wrong with a graph, as a sentence; empty: nothing, and then update and pose cannot fail.
std::string problem(const LocomotionGraph& graph);

/// All that a character remembers.
struct LocomotionState {
    double clock = 0;              ///< [s] time of clips without steps (idles)
    float phase = 0;               ///< [0, 1) of the shared cycle; 0 is a left foot strike
    std::uint32_t cycle = 0;       ///< full cycles so far, for clips of several
    std::int32_t facing_hint = 0;  ///< last simplex of each space
    std::int32_t lateral_hint = 0;
    FootMemory feet;  ///< that stand while weights change

    friend bool operator==(const LocomotionState&, const LocomotionState&) = default;
};
static_assert(std::is_trivially_copyable_v<LocomotionState> && sizeof(LocomotionState) <= 512);
static_assert(sizeof(LocomotionState) == 248, "no padding: states may be compared and hashed as bytes");

/// What each of the two spaces and a style may answer.
inline constexpr int k_max_locomotion_leaves = 3 * k_max_blend_weights;
static_assert(k_max_locomotion_leaves <= k_max_leaves);

struct LocomotionFrame {
    std::array<Leaf, k_max_locomotion_leaves> leaf{};  ///< the first `leaf_count`; weights add up to 1
    int leaf_count = 0;
    RootFrame root_delta;    ///< this frame's root motion seen from the root before it
    Vec3 velocity;           ///< [m/s] of the root in its own frame: what was obtained
    float turn = 0;          ///< [deg/s] the same
    float phase = 0;         ///< [0, 1) after the step
    float phase_rate = 0;    ///< [cycles/s] at `phase_before`
    float phase_before = 0;  ///< before this frame's time passed
    std::uint32_t cycle_before = 0;
    std::uint32_t cycle = 0;           ///< full cycles so far, as in the state
    std::array<FootOffset, 2> hold{};  ///< by Side
    bool stepping = false;             ///< some leaf has steps (else phase stands still)
    bool clamped = false;              ///< the request lay outside what the clips cover

    bool styled = false;  ///< among the leaves are a style's, whose root is not the leaves' own

    std::array<Leaf, k_max_blend_weights> layer{};  ///< of a style with a mask: the first `layer_count`
    int layer_count = 0;
    std::int32_t layer_style = -1;
    float layer_weight = 0;

    std::span<const Leaf> leaves() const noexcept { return {leaf.data(), static_cast<std::size_t>(leaf_count)}; }
};

/// Advances a character by `dt` >= 0 seconds. The leaves are for the end of the step.
LocomotionFrame update(const LocomotionGraph& graph, LocomotionState& state, const LocomotionRequest& request,
                       float dt) noexcept;

/// The frame's local pose: joint_count() transforms, the root at the origin, facing +Z. Where the graph knows the legs,
/// the feet are blended as feet (graph/foot_blend.h).
void pose(const LocomotionGraph& graph, const LocomotionFrame& frame, std::span<Transform> locals) noexcept;
/// Poses of many characters, to the bit what `pose` makes of each; the more at once the better (blend_feet).
/// [Limit: as many poses as frames, k_lanes at most]
void poses(const LocomotionGraph& graph, std::span<const LocomotionFrame> frames,
           std::span<Transform* const> locals) noexcept;
/// The pose with the legs as the joints' mean has them: for who knows better where the feet shall be (plan_feet).
void pose_without_feet(const LocomotionGraph& graph, const LocomotionFrame& frame,
                       std::span<Transform> locals) noexcept;
/// What foot_blend.h asks of a frame.
FootBlend foot_blend_of(const LocomotionFrame& frame) noexcept;

/// Speed of the ground under a foot [m/s]: planar, and by turning [rad/s] at the lever of a foot.
float foot_speed(Vec3 velocity, float turn_rate) noexcept;

}  // namespace surefoot
