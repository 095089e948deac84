#pragma once
// A blend's feet where they are held (graph/foot_memory.h). Inner header of the graph room.

#include <surefoot/graph/foot_blend.h>

namespace surefoot {

/// Moves a foot to where it is held; in the middle of a step it is lifted.
void hold_at(const LegPaths::Side& leg, const FootOffset& hold, FootGoal& goal) noexcept;
/// The same of what is foreseen of it: a step to where the blend has it is a swing of its own.
void hold_plan(const LegPaths::Side& leg, const FootOffset& hold, FootPlan& plan) noexcept;

/// A leg as its blend has it, in model space [m].
struct BlendedLeg {
    Vec3 hip, knee, ankle;
};
/// Who goes off stands on a foot until long after the blend would have let go of it. Before the leg is straight the
/// heel rises: the foot rolls about its ball until the leg reaches, its toes stay down. Nothing happens where it
/// reaches, or has no toes to stand on.
void rise_on_ball(const LegPaths::Side& leg, const BlendedLeg& pose, FootGoal& goal) noexcept;

}  // namespace surefoot
