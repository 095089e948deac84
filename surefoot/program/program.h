#pragma once
// A compiled animation graph: what parameters there are, and the tree of nodes that turns them into a pose.
//
// Immutable, and shared by all characters of its kind. A character is one flat block of bytes (Program::state_size;
// evaluate.h): saving, restoring and rolling back is memcpy. Made by reading a graph file (graph_text/), or by hand:
//
//     Program program = …;                                    // body, parameters, …
//     add_node(program, "walk", LocomotionNode{…}, {});       // children before their parent
//     lay_out(program);                                       // state and scratch, once
//     assert(problem(program).empty());                       // and then nothing can fail
//
// Terms: a *state machine*'s states are subtrees of which one plays, or several while a *transition* runs. A *sync
// group* is a phase that all its members share, whatever their clips' lengths: foot strikes fall together. What plays
// with no weight is *culled*: it is neither looked at nor goes on in time.

#include <surefoot/graph/locomotion.h>
#include <surefoot/live/live.h>
#include <surefoot/rig/mirror.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace surefoot {

inline constexpr int k_max_parameters = 256;
inline constexpr int k_max_nodes = 1024;
inline constexpr int k_max_depth = 32;  ///< of nodes below one another
inline constexpr int k_max_sync_groups = 16;
inline constexpr int k_max_states = 256;  ///< of one machine
inline constexpr int k_max_fading = 4;    ///< states of one machine that fade out at once
inline constexpr int k_max_frame_events = 32;

// --- parameters

enum class ParameterKind : std::uint8_t {
    number,
    flag,    ///< 0 or 1
    trigger  ///< 1 once set, 0 again when a transition has taken it
};

struct Parameter {
    std::string name;
    std::string unit;
    ParameterKind kind = ParameterKind::number;
    float initial = 0;
    float low = 0, high = 1;  ///< [Limit: low <= high] what is set is clamped to this
    float rate = 0;           ///< [units/s] at which the value goes for what was set; 0: at once
    float lasts = 0;          ///< [s] after which a trigger that nothing has taken is forgotten; 0: never
};

/// A number of a node: offset, or offset + scale * a parameter's value.
struct Operand {
    float offset = 0;
    float scale = 1;
    std::int16_t parameter = -1;

    constexpr Operand() = default;
    constexpr Operand(float constant) : offset(constant) {}  // NOLINT: a constant is an operand
    constexpr Operand(float offset_, float scale_, int parameter_)
        : offset(offset_), scale(scale_), parameter(static_cast<std::int16_t>(parameter_)) {}
};

// --- nodes

/// Something that happens at a time of a clip or a phase of a group.
struct EventMark {
    std::int16_t event = 0;  ///< index into Program::events
    float at = 0;            ///< [s] of the clip, or [0, 1) of the phase
};

/// One clip. In a sync group its time is the group's phase; else it has a time of its own.
struct ClipNode {
    std::int32_t clip = 0;  ///< index into Program::body.clips
    bool loop = true;       ///< false: it plays once and holds its last pose
    Operand rate = 1.0f;    ///< how fast its own time runs [Limit: >= 0; less counts as 0]
    std::int16_t group = -1;
    std::vector<EventMark> events;  ///< ascending
    /// Alignment: while its time is in [align_from, align_until] its root is led to where it shall be at align_until,
    /// which the host says each frame (GraphInput::targets). The clip's own path is bent to it, and nothing jumps.
    std::int16_t target = -1;               ///< index into Program::targets
    float align_from = 0, align_until = 0;  ///< [s]
};

/// A blend space over parameters. Its cyclic clips share the group's phase.
struct SpaceNode {
    LocomotionSpace space;
    std::array<Operand, k_max_dimensions> at;  ///< one an axis
    std::int16_t group = 0;
};

/// The spaces over speed and turn of Program::body, and its styles.
struct LocomotionNode {
    Operand speed, turn, lateral, slope;  ///< [m/s], [deg/s], [m/s], [deg]
    std::array<Operand, k_max_custom_axes> custom;
    std::int16_t style = -1;
    Operand style_weight;
    std::int16_t group = 0;
};

/// A live gait: no clips at all (live/live.h).
struct GaitNode {
    std::int16_t rig = 0;  ///< index into Program::rigs
    Operand speed, turn;   ///< [m/s], [deg/s]
    Operand manner;        ///< index into LiveRig::manners, rounded
    float glide = 0.8f;    ///< [s]
};

/// Children: from, to.
struct LerpNode {
    Operand weight;  ///< [0, 1]
};

/// Children: base, addition. What the addition differs from its reference is added to the base, root motion apart.
struct AdditiveNode {
    Operand weight;
    std::int16_t mask = -1;      ///< index into Program::masks; -1: the whole body
    std::int16_t reference = 0;  ///< index into Program::references
};

/// Children: base, layer. The layer replaces the base where the mask is, root motion apart.
struct LayerNode {
    Operand weight;
    std::int16_t mask = 0;
};

/// Child: left and right exchanged, root motion too, where `when` is above 1/2. What plays in a group goes half a cycle
/// ahead then, so that left strikes stay left strikes.
struct MirrorNode {
    Operand when = 1.0f;
};

/// Child: its time runs that much faster, and its root motion with it.
struct RateNode {
    Operand factor = 1.0f;  ///< [Limit: >= 0; less counts as 0]
};

/// Child: how much of foot placement the host should apply (GraphFrame::feet); 0 for jumps and falls.
struct FeetNode {
    Operand weight = 1.0f;  ///< [0, 1]
};

// --- state machines

enum class Curve : std::uint8_t { linear, smoothstep, cubic_in, cubic_out, cubic_in_out };
/// Of a share in [0, 1].
float ease(Curve curve, float share) noexcept;

enum class TransitionKind : std::uint8_t {
    feather,     ///< both play, one fades into the other
    inertialize  ///< the new one plays alone, and what the old one's pose and movement were ahead of it dies away
};

/// Who may interrupt a running transition. What is interrupted keeps fading: weights go on from where they are.
enum class Interruption : std::uint8_t { nobody, higher, anyone };  ///< `higher`: transitions of a higher priority

/// Where the new state's own clips begin.
enum class Entry : std::uint8_t {
    start,  ///< at their beginning
    keep,   ///< where they were left
    phase   ///< where the group's phase is: on the right foot
};

enum class ConditionKind : std::uint8_t {
    compare,    ///< a parameter with a value
    elapsed,    ///< at least `value` seconds in the state
    remaining,  ///< at most `value` seconds until the state's clip ends (of a loop: until it begins anew)
    window      ///< the group's phase is in [value, value_to), across the seam too
};
enum class Comparison : std::uint8_t { less, less_equal, greater, greater_equal, equal, not_equal };

struct Condition {
    ConditionKind kind = ConditionKind::compare;
    std::int16_t subject = -1;  ///< parameter or group
    Comparison comparison = Comparison::greater;
    float value = 0, value_to = 0;
};

struct Transition {
    std::string name;
    std::int16_t from = -1;  ///< state; -1: any but `to`
    std::int16_t to = 0;
    float seconds = 0.2f;  ///< [Limit: >= 0]
    Curve curve = Curve::smoothstep;
    TransitionKind kind = TransitionKind::feather;
    Interruption interrupted_by = Interruption::nobody;
    Entry entry = Entry::start;
    std::int16_t entry_group = -1;      ///< of Entry::phase
    float priority = 0;                 ///< of several that may run the highest does; of equals the first
    std::vector<Condition> conditions;  ///< all must hold
};

/// Children: the states, in order.
struct MachineNode {
    std::vector<std::string> states;
    std::vector<Transition> transitions;
    std::int16_t initial = 0;
};

using NodeData = std::variant<ClipNode, SpaceNode, LocomotionNode, GaitNode, LerpNode, AdditiveNode, LayerNode,
                              MirrorNode, RateNode, FeetNode, MachineNode>;

struct Node {
    std::string path;  ///< where it stands in its file, for messages
    NodeData data;
    std::vector<std::int16_t> children;
    // Filled by add_node and lay_out.
    std::int16_t first = 0;  ///< its subtree is [first, this one]
    /// It follows its group's phase and has no say in how fast that runs: for it adds to another pose and is no leg's,
    /// or another node leads.
    bool follows = false;
    std::uint32_t memory = 0;  ///< [bytes] where in the state its memory is
};

// --- the program

struct SyncGroup {
    std::string name;
    std::vector<EventMark> events{};  ///< by phase, ascending
    /// Path of the node (and all below it) that says how fast the phase runs, as long as it plays; every other member
    /// follows. Empty: all members have a say by their weight, but for what is layered or added, which follows.
    std::string leader{};
};

struct Program {
    std::string name;
    /// Skeleton, clips (all that any node plays), legs; spaces and styles for LocomotionNode, which may be empty.
    LocomotionGraph body;
    std::vector<std::shared_ptr<const LiveRig>> rigs;
    std::vector<Parameter> parameters;
    std::vector<SyncGroup> groups;
    std::vector<std::string> events;
    std::vector<std::string> targets;
    std::vector<std::vector<float>> masks;           ///< [0, 1] by joint
    std::vector<std::vector<Transform>> references;  ///< local poses
    MirrorMap mirror;                                ///< needed by MirrorNode alone
    std::vector<Node> nodes;                         ///< children before parents; the last one is the root

    // Filled by lay_out.
    std::uint32_t state_size = 0;  ///< [bytes] of a character, a multiple of 8
    bool inertializes = false;
    std::uint32_t inertia_memory = 0;
    bool holds_feet = false;  ///< standing feet are held while weights change (graph/foot_memory.h)
    std::uint32_t feet_memory = 0;
    int registers = 0;                   ///< poses that evaluating needs at once
    std::vector<std::int16_t> drifting;  ///< joints whose translation an inertialized transition has to carry

    int parameter(std::string_view name) const noexcept;  ///< index, or -1
    int event(std::string_view name) const noexcept;      ///< index, or -1
    int target(std::string_view name) const noexcept;     ///< index, or -1
    int group(std::string_view name) const noexcept;      ///< index, or -1
};

/// Appends a node below which are `children`, the roots of the subtrees added last, in order. Returns its index.
int add_node(Program& program, std::string path, NodeData data, const std::vector<int>& children);

/// Finds out how much state and scratch a character needs. Call it once, when all is there.
void lay_out(Program& program);

/// What is wrong with what a program is made of: all of `problem` that can be told before lay_out, which needs it
/// sound.
std::string definition_problem(const Program& program);

/// What is wrong with a laid-out program, as a sentence with the node's path; empty: nothing, and then evaluate.h
/// cannot fail.
std::string problem(const Program& program);

}  // namespace surefoot
