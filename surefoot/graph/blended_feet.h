#pragma once
// The leaves of a blend as its feet see them: which step of which clip, and where the mean of them has the foot. Inner
// header of the graph room.

#include <surefoot/graph/foot_lanes.h>
#include <surefoot/graph/locomotion.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

inline constexpr float k_least_duty = 0.05f, k_most_duty = 0.95f;
inline constexpr float k_most_pace =
    4;  // times faster or slower than its clips a blend is played, where it means anything

/// What a leaf's foot is doing: which step, and how much the leaf has to say about timing.
struct FootLeaf {
    const PackedClip* clip;
    const FootPrints* track;
    float weight;  ///< adds up to 1
    float say;     ///< of the leaf's speed, adds up to 1; 0 for clips without steps
    float time;    ///< [s] of the body
    int step;
};

struct FootLeaves {
    FootLeaf leaf[k_max_leaves];
    int count = 0;

    std::span<FootLeaf> all() noexcept { return {leaf, static_cast<std::size_t>(count)}; }
    std::span<const FootLeaf> all() const noexcept { return {leaf, static_cast<std::size_t>(count)}; }
};

/// What the leaves are to both sides; false where one has no tracks.
inline bool gather_leaves(std::span<const PackedClip> clips, const FootBlend& blend, FootLeaves& leaves) noexcept {
    float weights = 0, says = 0;
    for (const Leaf& leaf : blend.leaves) {
        const PackedClip& clip = clips[static_cast<std::size_t>(leaf.clip)];
        if (!clip.feet[0].known() || !clip.feet[1].known()) return false;
        constexpr float k_slowest = 1e-3f;  // [m/s] so that clips that stamp on the spot have a say among themselves
        const float speed = clip.cycles > 0 ? std::max(foot_speed(clip.velocity, clip.turn_rate), k_slowest) : 0.0f;
        FootLeaf& out = leaves.leaf[leaves.count++];
        // What extrapolation takes off has its say about timing, too.
        out = {&clip, nullptr, leaf.weight, std::fabs(leaf.weight) * speed, leaf.time, 0};
        weights += leaf.weight;
        says += out.say;
    }
    for (FootLeaf& leaf : leaves.all()) {
        leaf.weight /= weights;
        leaf.say = says > 0 ? leaf.say / says : 0.0f;
    }
    return true;
}

/// The leaves as one side sees them, which is in its step of that number.
inline void turn_to(std::size_t side, std::uint32_t step, FootLeaves& leaves) noexcept {
    for (FootLeaf& leaf : leaves.all()) {
        leaf.track = &leaf.clip->feet[side];
        if (leaf.clip->cycles > 0) leaf.step = static_cast<int>(step % static_cast<std::uint32_t>(leaf.clip->cycles));
    }
}

/// Share of the step's phase for which the blended foot stands: a mean by the steps' durations, so that its way on the
/// ground is the mean of the clips' ways. A lone stepping clip keeps its own.
inline float blended_duty(const FootLeaves& leaves) noexcept {
    float stance = 0, duration = 0;
    for (const FootLeaf& leaf : leaves.all()) {
        if (leaf.clip->cycles == 0) continue;
        const FootStep& step = leaf.track->steps[static_cast<std::size_t>(leaf.step)];
        stance += leaf.say * step.duration * step.lift;
        duration += leaf.say * step.duration;
    }
    return duration > 0 ? std::clamp(stance / duration, k_least_duty, k_most_duty) : 0.5f;
}

/// Where a clip's own step is when the blended one is `share` of its way, of which it stands for `duty`.
inline float own_share(const FootStep& step, float share, float duty) noexcept {
    return share < duty ? share / duty * step.lift : step.lift + (share - duty) / (1 - duty) * (1 - step.lift);
}

/// How much faster the blend goes through its phase than its clips would by themselves: the age of a stance passes that
/// much quicker.
inline float pace_of(const FootLeaves& leaves, const FootBlend& blend) noexcept {
    float seconds = 0;
    for (const FootLeaf& leaf : leaves.all())
        if (leaf.clip->cycles > 0)
            seconds +=
                leaf.say * phase_time(*leaf.clip, phase_in(*leaf.clip, blend.phase_before, blend.cycle_before)).slope;
    const float pace = seconds * blend.phase_rate;
    return pace > 0 ? std::clamp(pace, 1 / k_most_pace, k_most_pace) : 1.0f;
}

/// A blend's feet, one side and step at a time.
class BlendedFeet {
  public:
    BlendedFeet(const LegPaths& paths, const FootBlend& blend) noexcept : paths_(paths), blend_(blend) {}

    /// False where one of the clips has no foot track.
    bool gather(std::span<const PackedClip> clips) noexcept { return gather_leaves(clips, blend_, leaves_); }
    /// Goes over to a side, and returns its share of its step.
    float turn_to(std::size_t side) noexcept { return turn_to(side, blend_.phase, blend_.cycle); }
    /// The same at another moment.
    float turn_to(std::size_t side, float phase, std::uint32_t cycle) noexcept {
        strike_ = strike_phase(static_cast<Side>(side));
        const float after = phase - strike_;
        // Counted from well above zero, so that the step before the first one has a number too.
        constexpr std::uint32_t k_far = 27720;  // a multiple of every small cycle count
        step_ = cycle + k_far - (after < 0);
        see_step(side, step_);
        return after < 0 ? after + 1 : after;
    }
    void turn_to_next_step() noexcept { see_step(side_, step_ + 1); }
    float duty() const noexcept { return duty_; }
    bool steps() const noexcept {
        for (const FootLeaf& leaf : leaves_.all())
            if (leaf.clip->cycles > 0) return true;
        return false;
    }
    /// Asks for the foot at a share of its step, which it has in `ahead` seconds, as seen from the root as it is now:
    /// the weighted mean of the leaves' keys. Heel and ball are what is averaged: the foot rolls about one and then the
    /// other, which stand still, while the ankle moves on a curve that no mean keeps.
    void ask(float share, float ahead, FootGoal& answer, FootMeans& means) noexcept {
        if (!(pace_ > 0)) pace_ = pace_of(leaves_, blend_);
        means.begin(paths_.side[side_], blend_, pace_, ahead, answer);
        for (const FootLeaf& leaf : leaves_.all()) {
            float time = leaf.time;
            if (leaf.clip->cycles > 0) {
                const FootStep& step = leaf.track->steps[static_cast<std::size_t>(leaf.step)];
                time = time_at(*leaf.clip, strike_ + static_cast<float>(leaf.step) + own_share(step, share, duty_));
            }
            means.add(*leaf.clip, static_cast<Side>(side_), time, leaf.weight, leaf.say);
        }
        means.end();
    }

  private:
    void see_step(std::size_t side, std::uint32_t step) noexcept {
        side_ = side;
        surefoot::turn_to(side, step, leaves_);
        duty_ = blended_duty(leaves_);
    }

    const LegPaths& paths_;
    const FootBlend& blend_;
    FootLeaves leaves_;
    float pace_ = 0;  // 0: nobody has asked for it yet
    float strike_ = 0, duty_ = 0;
    std::uint32_t step_ = 0;
    std::size_t side_ = 0;
};

}  // namespace surefoot
