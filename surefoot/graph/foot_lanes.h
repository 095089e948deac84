#pragma once
// Feet and legs eight at a time: what is to be computed is collected, and done once lanes are full, or when the answers
// are needed. Nobody's bits depend on who else is in the lanes. Inner header of the graph room and the crowd's.

#include <surefoot/clip/foot_keys.h>
#include <surefoot/graph/held_feet.h>
#include <surefoot/graph/kernels.h>

namespace surefoot {

/// Means of keys. 20 KB, meant for the stack: nothing is set before it is used.
class FootMeans {
  public:
    FootMeans() noexcept {}  // NOLINT: lanes are set as they fill
    /// What is added until end() is a foot's, whose mean goes to `answer` at the latest by answer_all(): where the
    /// blend has it in `ahead` seconds, as seen from the root as it is now.
    void begin(const LegPaths::Side& leg, const FootBlend& blend, float pace, float ahead, FootGoal& answer) noexcept;
    /// One leaf of that foot, at most k_max_leaves.
    void add(const PackedClip& clip, Side side, float time, float weight, float say) noexcept;
    void end() noexcept {
        if (++lanes_ == k_foot_lanes) answer_all();
    }
    void answer_all() noexcept;

  private:
    static constexpr int k_key_floats = sizeof(FootKey) / sizeof(float);
    struct Made {
        alignas(FootKey) std::byte memory[sizeof(FootKey)];  // not worth constructing
    };

    FootLeafLanes leaves_[k_max_leaves];
    Made made_[k_max_leaves][k_foot_lanes];  // keys of clips that keep curves
    FootLanes feet_;
    FootGoal* answers_[k_foot_lanes];
    int counts_[k_foot_lanes], lanes_ = 0, most_ = 0;
};

/// The joints of both legs from the root on, as kernels want them; none without paths.
LegChains make_leg_chains(const LegPaths& paths) noexcept;

/// Both legs of up to four poses.
class LegLanes {
  public:
    static constexpr int k_poses = k_foot_lanes / 2;

    explicit LegLanes(const LegChains& chains) noexcept : chains_(chains) {}
    bool full() const noexcept { return count_ == k_poses; }
    int count() const noexcept { return count_; }
    void clear() noexcept { count_ = 0; }
    /// Returns its number. All are of one skeleton.
    int add(std::span<Transform> locals) noexcept;
    /// Finds the legs of all poses.
    void run_forward() noexcept;
    BlendedLeg pose(int pose, std::size_t side) const noexcept;
    void set_goals(int pose, const std::array<FootGoal, 2>& feet) noexcept;
    /// The same for who has them in lanes: left and right of the poses in turns.
    LegGoalLanes& goals() noexcept { return goals_; }
    /// How far bodies would have to sink [m] >= 0 for each foot to be within `share` of its leg's length of its goal.
    void sink_to_reach(float share, float (&sinks)[k_foot_lanes]) noexcept;
    /// Solves all legs for their goals.
    void reach() noexcept;

  private:
    void repeat_first() noexcept;

    const LegChains& chains_;
    float* locals_[k_foot_lanes];
    LegGoalLanes goals_;
    alignas(32) float models_[k_leg_joints * k_model_floats];
    int joints_ = 0, count_ = 0;
};

}  // namespace surefoot
