#pragma once
// What a character's state block holds, and where. Private to program/.

#include <surefoot/graph/foot_memory.h>
#include <surefoot/program/evaluate.h>

#include <cassert>
#include <cstddef>
#include <type_traits>

namespace surefoot {

struct ParameterMemory {
    float value = 0, asked = 0;
    float age = 0;  ///< [s] since a trigger was set
};

struct GroupMemory {
    float phase = 0;
    std::uint32_t cycle = 0;
    std::uint32_t runs = 0;  ///< some member played in the last step
};

struct ClipMemory {
    float time = 0;           ///< [s] in [0, duration]
    std::uint32_t fresh = 1;  ///< has not moved yet: what happens at time 0 has still to happen
};

struct SpaceMemory {
    double clock = 0;  ///< [s] of clips without steps
    std::int32_t facing_hint = 0, lateral_hint = 0;
};

/// Standing feet, of the one sync group whose steps carry the character.
struct FeetMemory {
    FootMemory feet;
    std::int32_t group = -1;  ///< -1: none has run yet
    std::uint32_t unused = 0;
};

struct MachineMemory {
    struct Fading {
        float from = 0;  ///< weight when the running transition began
        std::int16_t state = -1, unused = 0;
    };
    std::int16_t current = 0;      ///< the state it is in, or heading for
    std::int16_t transition = -1;  ///< the running one
    std::int16_t fading_count = 0, unused = 0;
    float elapsed = 0;      ///< [s] of the running transition
    float in_state = 0;     ///< [s] since `current` was entered
    float target_from = 1;  ///< weight of `current` when the running transition began
    std::array<Fading, k_max_fading> fading{};
};

/// Followed by 6 int16 a joint (rotation vector, and its rate times the duration) and 6 floats a drifting joint.
struct InertiaMemory {
    float elapsed = 0, seconds = 0;  ///< [s]; 0 seconds: nothing is carried
    Vec3 velocity;                   ///< [m/s] that the old root was ahead of the new one
    float turn = 0;                  ///< [rad/s]
};

static_assert(std::is_trivially_copyable_v<MachineMemory> && std::is_trivially_copyable_v<LiveState>);

/// The bytes at an offset of a state as what lay_out put there.
template <class T>
T& memory_at(std::span<std::byte> state, std::size_t at) noexcept {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 8);
    assert(at % alignof(T) == 0 && at + sizeof(T) <= state.size());
    return *reinterpret_cast<T*>(state.data() + at);
}
template <class T>
const T& memory_at(std::span<const std::byte> state, std::size_t at) noexcept {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 8);
    assert(at % alignof(T) == 0 && at + sizeof(T) <= state.size());
    return *reinterpret_cast<const T*>(state.data() + at);
}

/// The sync group that a node is a member of, or -1.
inline int group_of(const NodeData& data) noexcept {
    if (const auto* clip = std::get_if<ClipNode>(&data)) return clip->group;
    if (const auto* space = std::get_if<SpaceNode>(&data)) return space->group;
    if (const auto* locomotion = std::get_if<LocomotionNode>(&data)) return locomotion->group;
    return -1;
}

constexpr std::size_t aligned_to_8(std::size_t size) noexcept { return (size + 7) / 8 * 8; }

inline std::size_t parameter_memory(std::size_t index) noexcept { return index * sizeof(ParameterMemory); }
inline std::size_t group_memory(const Program& program, std::size_t index) noexcept {
    return aligned_to_8(program.parameters.size() * sizeof(ParameterMemory)) + index * sizeof(GroupMemory);
}

inline float value_of(std::span<const std::byte> state, const Operand& operand) noexcept {
    if (operand.parameter < 0) return operand.offset;
    const auto at = parameter_memory(static_cast<std::size_t>(operand.parameter));
    return operand.offset + operand.scale * memory_at<ParameterMemory>(state, at).value;
}
inline float share_of(std::span<const std::byte> state, const Operand& operand) noexcept {
    const float value = value_of(state, operand);
    return value < 1 ? (value > 0 ? value : 0.0f) : 1.0f;
}
inline float rate_of(std::span<const std::byte> state, const Operand& operand) noexcept {
    const float value = value_of(state, operand);
    return value > 0 ? value : 0.0f;
}

/// A whole subtree at its beginning, as when a state is entered.
void reset_subtree(const Program& program, std::span<std::byte> state, int root) noexcept;

/// [s] until what a node plays ends, or, of a loop, begins anew; far away where nothing ends.
float remaining_seconds(const Program& program, std::span<const std::byte> state, int node) noexcept;

/// A machine's turn in a step: its transitions, then `dt` seconds. Returns the seconds over which to inertialize where
/// such a transition has begun, else a number below 0.
float run_machine(const Program& program, std::span<std::byte> state, int node, float dt, bool decide) noexcept;

/// Weight of each state now; those without any are left out.
struct StateWeights {
    std::array<std::int16_t, k_max_fading + 1> state{};
    std::array<float, k_max_fading + 1> weight{};
    int count = 0;
};
StateWeights state_weights(const MachineNode& machine, const MachineMemory& memory) noexcept;

inline constexpr float k_least_share = 1e-4f;  ///< a node of less adds nothing that can be seen, and is culled

}  // namespace surefoot
