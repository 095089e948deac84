#pragma once
// Where a clip's feet stand, kept so that blends of clips can stand there too (graph/foot_blend.h).
//
// A foot that stands still in the world runs backwards as seen from the moving root, at a speed of its own in each
// clip. So each frame's foot is kept as it is seen from where the steady root is at the *middle of the stance*: there
// a standing foot is one constant frame, its print, whatever the clip's speed and turn.

#include <surefoot/base/table.h>
#include <surefoot/clip/curves.h>
#include <surefoot/math/transform.h>

#include <vector>

namespace surefoot {

/// A foot at one frame. With root(t) the steady root after t seconds: foot seen from the root = inverse(root(age)) *
/// print.
struct FootKey {
    Transform print;  ///< of the foot joint, as seen from the root at mid-stance
    Quat toes;        ///< local rotation of the toe joint; identity without one
    float age = 0;    ///< [s] since mid-stance; during the swing it runs back smoothly, from one stance to the next
};

/// One step: from a strike of the foot to its next.
struct FootStep {
    float lift = 0.6f;    ///< (0, 1) share of the cycle's phase at which the stance ends
    float stance = 0.6f;  ///< [s]
    float duration = 1;   ///< [s] [Limit: > stance]
};

/// Age [s] of a foot `elapsed` seconds after the strike of `step`; `next` is the step after it. In the swing a cubic
/// leads from the end of one stance to the beginning of the other, with slope 1 at both, so that age is smooth.
constexpr float foot_age(const FootStep& step, const FootStep& next, float elapsed) noexcept {
    if (elapsed <= step.stance) return elapsed - 0.5f * step.stance;
    const float swing = step.duration - step.stance, share = (elapsed - step.stance) / swing;
    const float t = share < 1.0f ? share : 1.0f, u = 1 - t;
    return 0.5f * step.stance * (u * u * (1 + 2 * t)) + swing * (t * u * u) -
           0.5f * next.stance * (t * t * (3 - 2 * t)) - swing * (t * t * u);
}

/// A foot in a clip's small form (packed_clip.h). Its age follows from its steps.
struct FootCurves {
    FootKey middle;
    /// Numbers: the print's rotation from the middle (x y z; w >= 0 follows), its translation from it [m], the toes'
    /// rotation.
    Curves curves;
};
inline constexpr int k_foot_numbers = 9;

struct FootPrints {
    Table<FootKey> keys;          ///< one a frame; empty where the clip has none, or keeps curves
    FootCurves small;             ///< in their stead
    std::vector<FootStep> steps;  ///< one a cycle, the first from the strike of phase 0 (left) or 0.5 (right) on

    bool known() const noexcept { return !keys.empty() || !small.curves.empty(); }
};

}  // namespace surefoot
