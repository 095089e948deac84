#pragma once
// One step of a program. Private to program/.
//
// Three passes over the flat list of nodes. Downward (parents first): who plays, with what weight; machines decide.
// Across: each sync group's pace from all that plays in it, and everybody's time. Upward (children first): leaves and
// pose tasks on a stack, as long as possible as one weighted sum; root motion on the way.

#include <surefoot/graph/mix.h>
#include <surefoot/program/memory.h>

namespace surefoot {

/// What the passes hand to one another of a node.
struct NodeStep {
    bool plays = false;
    bool turned = false;  ///< an odd number of mirrors is above it
    float weight = 0;     ///< in the whole
    float rate = 1;       ///< of everything above it
    Vec3 velocity;        ///< [m/s] of a leaf's root
    float turn = 0;       ///< [rad/s]
};

/// A pose in the making: a sum of leaves, or what has been evaluated to a register.
struct Partial {
    static constexpr int k_neutral = -1, k_own = -2;
    bool sum = true;
    bool styled = false;
    int group = k_own;  ///< whose phase its leaves share; neutral: they have no steps; own: a clip by itself
    bool turned = false;
    int first = 0, count = 0;  ///< leaves
    Vec3 velocity;
    float turn = 0;
    float feet = 1;
    float legs = 0;  ///< share of the character's legs that is this pose's
};

struct GraphScratch::Parts {
    explicit Parts(const Program& program);

    std::vector<NodeStep> nodes;
    std::vector<Mix> mixes;            ///< of spaces and locomotion
    std::vector<std::int16_t> mix_of;  ///< by node
    std::vector<LiveScratch> rigs;
    std::vector<Partial> stack;        ///< Program::registers
    std::vector<Transform> registers;  ///< all but the first: that is the pose asked for
    std::vector<Transform> mirrored;   ///< three poses
    // For the beginning of an inertialized transition.
    std::vector<std::byte> before, copy;
    std::vector<Transform> from, from_before, to, to_after;
    GraphFrame spare;
};

class GraphStep {
  public:
    GraphStep(const Program& program, std::span<std::byte> state, GraphScratch& scratch, GraphFrame& frame) noexcept
        : program_(program), state_(state), parts_(scratch.parts()), frame_(frame) {}

    /// A new frame: nothing has happened yet.
    void begin() noexcept;
    /// Goes on by `dt`; `left` is what of the frame comes after. Returns the seconds over which to inertialize, or a
    /// number below 0.
    float run(const GraphInput& input, float dt, float left, bool decide) noexcept;

  private:
    const Node& node(int i) const noexcept { return program_.nodes[static_cast<std::size_t>(i)]; }
    NodeStep& at(int i) noexcept { return parts_.nodes[static_cast<std::size_t>(i)]; }
    Mix& mix_at(int i) noexcept {
        return parts_.mixes[static_cast<std::size_t>(parts_.mix_of[static_cast<std::size_t>(i)])];
    }
    const PackedClip& packed(int clip) const noexcept { return program_.body.clips[static_cast<std::size_t>(clip)]; }
    Partial& on_stack(int position) noexcept { return parts_.stack[static_cast<std::size_t>(position)]; }
    float value(const Operand& operand) const noexcept { return value_of(state_, operand); }

    void advance_parameters(float dt) noexcept;

    // down.cpp
    float pass_down(float dt, bool decide) noexcept;
    void pass_to(int child, const NodeStep& parent, float share) noexcept;
    void mix_space(int i, const SpaceNode& space) noexcept;
    void mix_locomotion(int i, const LocomotionNode& locomotion) noexcept;
    LocomotionRequest request_of(const LocomotionNode& locomotion) const noexcept;

    // across.cpp
    void run_groups(float dt, float left) noexcept;
    void take_over_phase(GroupMemory& group) noexcept;
    void run_leaves(const GraphInput& input, float dt, float left) noexcept;
    void run_clip(int i, const ClipNode& clip, const GraphInput& input, float dt, float left) noexcept;
    void run_gait(int i, const GaitNode& gait, float dt) noexcept;
    std::span<const Active> played_by(int i, Active& alone) noexcept;
    void fire(const std::vector<EventMark>& marks, float from, float to, bool with_from, int owner, float weight,
              float left, float per_second) noexcept;
    void sort_events(std::size_t first) noexcept;

    // feet.cpp
    void step_off(int group) noexcept;
    void share_legs() noexcept;
    int bearing_group(int before) noexcept;
    void hold_feet(const RootFrame& moved, float dt) noexcept;

    // up.cpp
    void pass_up() noexcept;
    void emit(int i) noexcept;
    void push_sum(int i, int group, std::span<const Active> active, double clock, Vec3 velocity, float turn) noexcept;
    void push_clip(int i, const ClipNode& clip) noexcept;
    void push_locomotion(int i, const LocomotionNode& locomotion) noexcept;
    void merge(int count, const float* weights) noexcept;
    bool mergeable(int first, int count, int& group) noexcept;
    void evaluate(int position) noexcept;
    PoseTask& add_task(PoseTask::Kind kind, int to) noexcept;
    float phase_of(int group, bool turned, std::uint32_t& cycle) const noexcept;
    int children_played(int i, float* weights) noexcept;

    const Program& program_;
    std::span<std::byte> state_;
    GraphScratch::Parts& parts_;
    GraphFrame& frame_;
    int depth_ = 0;
};

/// Half a cycle on, for what is mirrored.
inline void turn_phase(float& phase, std::uint32_t& cycle) noexcept {
    phase += 0.5f;
    if (phase >= 1) {
        phase -= 1;
        ++cycle;
    }
}

/// Constant velocity and turn rate that make a step of that time: integrate(velocity, turn, dt) == delta.
void velocity_of(const RootFrame& delta, float dt, Vec3& velocity, float& turn) noexcept;

}  // namespace surefoot
