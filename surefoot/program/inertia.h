#pragma once
// Inertialization: the new pose plays at once, and what the old one was ahead of it in place and speed dies away
// (Bollo 2018, "Inertialization: High-Performance Animation Transitions in Gears of War"). Unlike there the quintic
// runs on rotation vectors, a joint's three components each by itself: no axis has to be chosen, and an interruption
// folds into what is carried already, for that is part of the old pose. Private to program/.

#include <surefoot/program/memory.h>

namespace surefoot {

/// Old and new pose in the step in which the new one takes over; the old one a step earlier, the new one a step later.
struct PosePair {
    std::span<const Transform> from, from_before, to, to_after;
    Vec3 velocity;   ///< [m/s] that the old root is ahead of the new one
    float turn = 0;  ///< [rad/s]
};

/// Begins to carry the difference for `seconds`; `dt` [s] is the step between the poses (0: speeds are not known).
void carry(const Program& program, std::span<std::byte> state, float seconds, float dt, const PosePair& poses) noexcept;

/// Adds what is carried now to a pose.
void apply_inertia(const Program& program, std::span<const std::byte> state, std::span<Transform> locals) noexcept;

/// Share of the root's carried velocity that is left.
float carried_share(const InertiaMemory& inertia) noexcept;

}  // namespace surefoot
