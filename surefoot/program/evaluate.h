#pragma once
// Running a program: each frame `update` decides (parameters, transitions, weights, phases, events, root motion) and
// leaves a short list of what to evaluate; `pose` evaluates it. A character that is not seen needs no pose.
//
//     GraphScratch scratch(program);  GraphFrame frame(program);        // one a thread
//     std::vector<std::byte> state(program.state_size);  start(program, state);      // one a character
//     …
//     set(program, state, speed, 1.4f);
//     update(program, state, {.dt = dt, .root = world_root}, scratch, frame);
//     world_root = world_root * frame.root_delta;
//     pose(program, state, frame, scratch, locals);                     // then foot placement, then local_to_model
//
// The state block is aligned to 8 bytes. Nothing here allocates or fails for a program without `problem`.

#include <surefoot/program/program.h>

#include <cstddef>
#include <span>

namespace surefoot {

/// Everything at its beginning.
void start(const Program& program, std::span<std::byte> state) noexcept;

/// Asks for a value, which is clamped to the parameter's range; what is no number is ignored. A trigger is set by any
/// value above 0.
void set(const Program& program, std::span<std::byte> state, int parameter, float value) noexcept;
/// The value now, on its way at the parameter's rate.
float get(const Program& program, std::span<const std::byte> state, int parameter) noexcept;

struct GraphInput {
    float dt = 0;                          ///< [s] >= 0; long frames are taken in steps of 1/30 s
    RootFrame root;                        ///< world, before this frame; read by alignment alone
    std::span<const RootFrame> targets{};  ///< world, one for each of Program::targets, or none
    bool decide = true;  ///< false: states stay as they are and time passes in one step, to look ahead on a copy
};

struct GraphEvent {
    std::int16_t event = 0;
    std::int16_t node = -1;  ///< whose clip it stands in; -1: a group's
    float weight = 1;        ///< of the node in the whole
    float ago = 0;           ///< [s] before the frame's end
};

/// What of a sync group a frame's poses need.
struct GroupStep {
    float phase = 0, phase_before = 0;  ///< [0, 1)
    std::uint32_t cycle = 0, cycle_before = 0;
    float rate = 0;  ///< [cycles/s] at phase_before
    bool runs = false;
};

/// One step of evaluating a pose, on a small stack of poses.
struct PoseTask {
    enum class Kind : std::uint8_t { sample, gait, blend, layer, add, mirror };
    Kind kind = Kind::sample;
    std::int16_t to = 0;         ///< register; blend, layer and add read the one after it, too
    std::int16_t node = -1;      ///< gait
    std::int16_t group = -1;     ///< sample: whose phase the leaves share; below 0: they have none
    std::int16_t mask = -1;      ///< layer, add; -1: the whole body
    std::int16_t reference = 0;  ///< add
    std::int32_t first_leaf = 0, leaf_count = 0;
    float weight = 1;  ///< of the second pose
    float legs = 0;    ///< sample: share of the character's legs that is seen
    Vec3 velocity;     ///< sample: of the leaves' root
    float turn = 0;
    bool steps = false;       ///< sample: its legs may be held, they are no clip's by itself
    bool blends = false;      ///< sample: its feet are a mean
    bool turned = false;      ///< sample: half a cycle ahead, for it is mirrored
    bool style_mask = false;  ///< layer: the mask is a style's, `mask` its index
};

class GraphFrame {
  public:
    explicit GraphFrame(const Program& program);

    RootFrame root_delta;  ///< this frame's root motion seen from the root before it
    Vec3 velocity;         ///< [m/s] of the root, in its own frame, at the end of the frame
    float turn = 0;        ///< [rad/s]
    float feet = 1;        ///< [0, 1] how much of foot placement to apply
    int visited = 0;       ///< nodes that were looked at in the last step: the others are culled
    int events_lost = 0;   ///< more than k_max_frame_events happened
    std::array<GroupStep, k_max_sync_groups> groups{};
    std::span<const GraphEvent> events() const noexcept { return {event_.data(), event_count_}; }
    std::span<const PoseTask> tasks() const noexcept { return {task_.data(), task_count_}; }
    std::span<const Leaf> leaves() const noexcept { return {leaf_.data(), leaf_count_}; }

  private:
    friend class GraphStep;
    std::array<GraphEvent, k_max_frame_events> event_{};
    std::vector<PoseTask> task_;
    std::vector<Leaf> leaf_;
    std::size_t event_count_ = 0, task_count_ = 0, leaf_count_ = 0;
};

/// Working memory, used for one character after the other.
class GraphScratch {
  public:
    explicit GraphScratch(const Program& program);
    ~GraphScratch();
    GraphScratch(GraphScratch&&) noexcept;
    GraphScratch& operator=(GraphScratch&&) noexcept;

    struct Parts;
    Parts& parts() noexcept { return *parts_; }
    const Parts& parts() const noexcept { return *parts_; }

  private:
    std::unique_ptr<Parts> parts_;
};

/// Advances a character. Poses are sampled only in the one frame in which an inertialized transition begins.
void update(const Program& program, std::span<std::byte> state, const GraphInput& input, GraphScratch& scratch,
            GraphFrame& frame) noexcept;

/// The local pose of the state that `update` has just left with `frame`: joint_count() transforms, the root at the
/// origin, facing +Z.
void pose(const Program& program, std::span<const std::byte> state, const GraphFrame& frame, GraphScratch& scratch,
          std::span<Transform> locals) noexcept;

/// Name of the state a machine is in, or heading for; empty where the node is no machine.
std::string_view machine_state(const Program& program, std::span<const std::byte> state, int node) noexcept;
/// What a machine is doing.
struct MachineStatus {
    int state = -1;       ///< it is in, or heading for; -1: the node is no machine
    int transition = -1;  ///< index into MachineNode::transitions of the running one
    float elapsed = 0;    ///< [s] of it
    float in_state = 0;   ///< [s] since the state was entered
};
MachineStatus machine_status(const Program& program, std::span<const std::byte> state, int node) noexcept;
/// Weight in the whole, [0, 1], that a node had in the last step that used this scratch; 0 of what is culled.
float node_weight(const GraphScratch& scratch, int node) noexcept;
/// The machine at that path, or -1.
int find_node(const Program& program, std::string_view path) noexcept;

}  // namespace surefoot
