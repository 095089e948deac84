#pragma once
// Blended legs whose feet are where the blend's feet should be.
//
// A weighted mean of joint angles puts each clip's planted foot somewhere near, and lets it slide. What must be blended
// is where the feet stand: each clip's foot as seen from mid-stance (clip/foot_prints.h) is one constant frame while it
// stands, so their weighted mean is constant too; seen from the blended root, which moves on with the blended velocity
// and turn, it is a foot that stands still in the world. So says the algebra for clips of any speed, turn and
// direction, whatever the phase rate. Each foot keeps time by itself: stance meets stance and swing meets swing though
// one clip is a walk and the other a run. The blended hips stay; hip and knee are solved for the foot.

#include <surefoot/clip/sample.h>
#include <surefoot/rig/leg.h>

#include <array>
#include <span>
#include <string>

namespace surefoot {

/// The joints of both legs and all above them, parents first: what has to be run forward to find the feet. Immutable.
struct LegPaths {
    static constexpr int k_most = 48;
    struct Side {
        int upper_parent = -1, upper = 0, lower_parent = 0, lower = 0, foot_parent = 0, foot = 0;  ///< slots; -1: none
        int toes = k_no_joint;                                                                     ///< joint
        Vec3 knee_forward;  ///< in the thigh's frame: where a straight knee would bend to
        Vec3 heel, ball;    ///< [m] on the sole, foot's frame
    };
    int count = 0;  ///< 0: legs are not known, and stay as blended
    std::array<std::int16_t, k_most> joint{};
    std::array<std::int16_t, k_most> parent{};  ///< slot, or -1
    std::array<Side, 2> side;
};

/// `standing` is the pose, in model space, that `legs` was made from. No paths (count 0) where a skeleton has more than
/// k_most joints in them.
LegPaths make_leg_paths(const Skeleton& skeleton, const Legs& legs, std::span<const Transform> standing);

/// What is wrong with paths for that skeleton, as a sentence; empty: nothing.
std::string problem(const LegPaths& paths, const Skeleton& skeleton);

/// Where a foot shall be: its joint in model space, and the local rotation of its toes (unused without a toe joint).
struct FootGoal {
    Transform foot;
    Quat toes;
};

/// The frame of a foot joint of that rotation whose heel and ball are at these places, or as near as a rigid foot can
/// be: the lower of the two is what stands on the ground.
Transform stand_on(const LegPaths::Side& leg, Quat rotation, Vec3 heel, Vec3 ball) noexcept;

/// [m] How high a flat foot is at `done` [0, 1] of a step that no clip takes.
float step_height(const LegPaths::Side& leg, float done) noexcept;

/// Solves both legs of a local pose for their feet; the rest of the pose stays. Nothing changes where `paths` is empty.
/// What a leg cannot reach is pulled in softly (ik/two_bone.h).
void reach_feet(const LegPaths& paths, const std::array<FootGoal, 2>& feet, std::span<Transform> locals) noexcept;

/// How far a foot is held from where its blend has it (graph/foot_memory.h), as seen from the root.
struct FootOffset {
    float x = 0, z = 0;  ///< [m]
    float yaw = 0;       ///< [rad] about the vertical through its joint
    float step = 0;      ///< (0, 1) of the way of a step to where the blend has it; 0: it takes none

    friend bool operator==(const FootOffset&, const FootOffset&) = default;
};
inline bool is_held(const std::array<FootOffset, 2>& hold) noexcept {
    return !(hold[0] == FootOffset{}) || !(hold[1] == FootOffset{});
}

/// Leaves that share one phase, and how they and their root move.
struct FootBlend {
    std::span<const Leaf> leaves;  ///< at most k_max_leaves
    float phase = 0;               ///< [0, 1) now
    std::uint32_t cycle = 0;
    float phase_before = 0;  ///< a frame ago
    std::uint32_t cycle_before = 0;
    float phase_rate = 0;              ///< [cycles/s] at `phase_before`
    Vec3 velocity;                     ///< [m/s] of the blended root, in its own frame
    float turn = 0;                    ///< [rad/s]
    std::array<FootOffset, 2> hold{};  ///< by Side
};

/// What a blended foot does, and where it stands next.
struct FootPlan {
    FootGoal now;         ///< as seen from the root, held as the blend's hold says
    bool steps = false;   ///< false: it stands for good, and the rest means nothing
    float share = 0;      ///< [0, 1) of the way from its strike to its next
    float stance = 0.6f;  ///< [0, 1) share at which it leaves the ground
    FootGoal next;        ///< of a foot that swings: the middle of its next stance, seen from the root as it is now
    bool swings() const noexcept { return steps && share >= stance; }
};

struct FootPlans {
    bool known = false;  ///< false where one of the clips has no foot track; the rest is then not set
    std::array<FootPlan, 2> side;
};

/// Both feet of each blend, if it goes on as it does now. The more at once the better: feet are computed eight at a
/// time.
void plan_feet(const LegPaths& paths, std::span<const PackedClip> clips, std::span<const FootBlend> blends,
               std::span<FootPlans> plans) noexcept;

/// Solves both legs of the blended pose `locals` (joint_count() transforms) for the blended feet of the leaves. Nothing
/// changes where one of the clips has no foot track. Never allocates or fails.
void blend_feet(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
                std::span<Transform> locals) noexcept;

struct BlendedPose {
    FootBlend blend;
    std::span<Transform> locals;
};
/// The same of many poses, to the bit; four at a time.
void blend_feet(const LegPaths& paths, std::span<const PackedClip> clips, std::span<const BlendedPose> poses) noexcept;

}  // namespace surefoot
