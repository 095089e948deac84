// How a swinging foot clears the ground: over it by a hump, and around edges by a shift along its way.

#include <surefoot/ik/foot_forecast.h>

#include <algorithm>

namespace surefoot {
namespace {

// Ground this far ahead of and behind a swinging point counts; near lift and strike the other way round: there an edge
// may come as near, for a foot that fits a tread just leaves and just reaches it. [m]
constexpr float k_path_margin = 0.02f, k_end_margin = -0.012f;
constexpr float k_tip_share = 1.8f;      // of the latter: toe tips may come nearer, they bend
constexpr float k_toe_bend = 0.01f;      // [m] toes that are down bend out of the way by this much
constexpr float k_toe_down = 0.005f;     // [m]
constexpr int k_end = 4, k_middle = 10;  // samples from lift or strike: so far the one holds, and from there the other
constexpr float k_no_need = -1e3f;       // [m]
constexpr float k_overshoot = 0.16f;     // [m] at most
constexpr int k_most_given_up = 7;       // samples
constexpr float k_low = 0.015f;          // [m] a hump this low is good enough: no shift is tried
// [m] that are tried early and late in a swing; a foot that comes down beside a nose has to keep well ahead of it.
constexpr std::array k_early_shifts{-0.08f, 0.0f, 0.08f};
constexpr std::array k_late_shifts{-0.08f, 0.0f, 0.08f, 0.16f};
constexpr std::size_t k_no_early = 1, k_no_late = 1;
constexpr float k_shift_worth = 0.9f;  // of the cost without: smaller gains are left alone

/// Of a step where the clip takes none.
float step_height(const FootState& foot, double clock) noexcept {
    if (foot.step_height == 0) return k_no_need;
    const auto share = static_cast<float>((clock - foot.lift) / (foot.strike - foot.lift));
    const float arch = std::max(0.0f, 4 * share * (1 - share));
    return foot.step_height * arch * arch;
}

class Clearance {
  public:
    Clearance(const FootRig& rig, FootState& foot, std::size_t side, const GroundProbe& probe,
              const Forecast& forecast) noexcept
        : rig_(rig), foot_(foot), probe_(probe) {
        travel_ = normalized(foot.next.centre - foot.plant.centre, {0, 0, 0});
        start_value_ = foot.hump.start_value;
        start_slope_ = foot.hump.start_slope;
        const double from = foot.hump_from, length = foot.strike - from;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double clock = from + length * (static_cast<double>(i) - 1) / (k_hump_samples - 1);
            points_[i] = forecast.at(side, clock);
            step_[i] = step_height(foot, clock);
            placed_[i] = blend_plants(foot, clock, points_[i], rig.legs.side[side]);
            fade_[i] = fade_offset(foot, clock);
            bumps_[i] = swing_bumps((static_cast<float>(i) - 1) / (k_hump_samples - 1));
        }
        for (auto& late : need_)
            for (auto& samples : late) samples.fill(k_unknown);
    }
    void plan() noexcept;

  private:
    /// A shift, by its places among those that are tried, with the hump that it needs.
    struct Trial {
        std::size_t early, late;
        Hump hump;
        float bent;          // the sum of the squared second differences of the way
        float highest_need;  // [m] above the blend of the two plants
        float overshoot;     // [m] by which the hump is higher than that
    };
    Trial choose_shifts() noexcept;
    Trial try_shift(std::size_t early, std::size_t late) noexcept;
    template <class Up>
    float bent(std::size_t early, std::size_t late, const Up& up) const noexcept;
    float need(int sample, std::size_t early, std::size_t late) noexcept;
    float needed(const LegPoints& points, const PlacedFoot& placed, float margin, float step) const noexcept;

    const FootRig& rig_;
    FootState& foot_;
    const GroundProbe& probe_;
    // At the samples of the hump, one before and one after:
    std::array<LegPoints, k_hump_samples + 2> points_;
    std::array<PlacedFoot, k_hump_samples + 2> placed_;
    std::array<Vec3, k_hump_samples + 2> fade_;
    std::array<float, k_hump_samples + 2> step_;  // [m] how high the foot shall be by itself
    std::array<SwingBumps, k_hump_samples + 2> bumps_;
    // [m] by shifts and sample, as far as they have been asked for: most samples see but one of the two shifts, so that
    // few are asked for twice
    static constexpr float k_unknown = 1e30f;
    std::array<std::array<std::array<float, k_hump_samples>, k_late_shifts.size()>, k_early_shifts.size()> need_;
    Vec3 travel_;  // unit, level
    float start_value_, start_slope_;
    int given_up_ = 1;  // samples at either end at which the ground is not kept clear
};

/// Least height of the ankle above its height in the clip so that heel, ball and toe tip clear the ground.
float Clearance::needed(const LegPoints& points, const PlacedFoot& placed, float margin, float step) const noexcept {
    const std::array<Vec3, 3> soles{points.heel, points.ball, points.toe_tip};
    std::array<Vec3, 3> arms;
    std::array<Vec3, 9> under;
    std::array<float, 9> heights;
    for (std::size_t k = 0; k < soles.size(); ++k) {
        arms[k] = rotate(placed.tilt, soles[k] - points.ankle);
        const Vec3 place = placed.ankle + arms[k];
        const float reach = margin < 0 && k == 2 ? margin * k_tip_share : margin;
        under[3 * k] = place;
        under[3 * k + 1] = place + travel_ * reach;
        under[3 * k + 2] = place - travel_ * reach;
    }
    probe_.heights(under, heights);
    float need = k_no_need;
    for (std::size_t k = 0; k < soles.size(); ++k) {
        const auto [lowest, highest] = std::minmax({heights[3 * k], heights[3 * k + 1], heights[3 * k + 2]});
        const float ground = margin < 0 ? lowest : highest;
        float own = std::min(rig_.settings.swing_clearance, soles[k].y);
        if (own < 0) own *= 1 - placed.uneven;
        own = std::max(own, step);
        float least = ground + own - (points.ankle.y + arms[k].y);
        if (k == 2 && soles[k].y < k_toe_down) least -= k_toe_bend;
        need = std::max(need, least);
    }
    return need;
}

/// `needed` at a sample that some shifts move.
float Clearance::need(int sample, std::size_t early, std::size_t late) noexcept {
    const auto at = static_cast<std::size_t>(sample + 1);
    const SwingBumps& bumps = bumps_[at];
    if (bumps.early == 0) early = k_no_early;
    if (bumps.late == 0) late = k_no_late;
    float& need = need_[early][late][static_cast<std::size_t>(sample)];
    if (need != k_unknown) return need;
    const int from_end = std::min(sample, k_hump_samples - 1 - sample);
    const float inner = std::clamp(static_cast<float>(from_end - k_end) / (k_middle - k_end), 0.0f, 1.0f);
    const float margin = k_end_margin + (k_path_margin - k_end_margin) * inner;
    PlacedFoot placed = placed_[at];
    placed.ankle += fade_[at] + bumps.shift(travel_ * k_early_shifts[early], travel_ * k_late_shifts[late]);
    return need = needed(points_[at], placed, margin, step_[at]);
}

/// How bent a way is whose height bends by `up` at a sample.
template <class Up>
float Clearance::bent(std::size_t early, std::size_t late, const Up& up) const noexcept {
    const Vec3 by_early = travel_ * k_early_shifts[early], by_late = travel_ * k_late_shifts[late];
    const auto shift = [&](std::size_t i) noexcept { return bumps_[i].shift(by_early, by_late); };
    float bent = 0;
    for (std::size_t i = 2; i < k_hump_samples; ++i) {
        const float rises = up(i);
        const Vec3 level = shift(i - 1) - 2.0f * shift(i) + shift(i + 1);
        bent += rises * rises + dot(level, level);
    }
    return bent;
}

Clearance::Trial Clearance::try_shift(std::size_t early, std::size_t late) noexcept {
    Trial trial{early, late, {}, 0, 0, 0};
    HumpTask task;
    task.need.fill(k_no_need);
    for (std::size_t i = 0; i < points_.size(); ++i) task.base[i] = placed_[i].ankle.y - points_[i].ankle.y;
    for (int j = given_up_; j < k_hump_samples - given_up_; ++j) {
        float& least = task.need[static_cast<std::size_t>(j)];
        least = need(j, early, late);
        trial.highest_need = std::max(trial.highest_need, least - task.base[static_cast<std::size_t>(j + 1)]);
    }
    task.start_value = start_value_;
    task.start_slope = start_slope_;
    trial.hump = rig_.solver->solve(task);

    const std::array<float, k_hump_samples> hump = trial.hump.at_samples();
    float highest = 0;
    for (const float value : hump) highest = std::max(highest, value);
    trial.overshoot = highest - std::max({trial.highest_need, start_value_, 0.0f});

    const auto height = [&](std::size_t i) { return task.base[i] + hump[i - 1]; };
    trial.bent =
        bent(early, late, [&](std::size_t i) noexcept { return height(i - 1) - 2 * height(i) + height(i + 1); });
    return trial;
}

Clearance::Trial Clearance::choose_shifts() noexcept {
    Trial best = try_shift(k_no_early, k_no_late);
    if (best.highest_need < k_low) return best;
    float least = best.bent * k_shift_worth;
    for (std::size_t early = 0; early < k_early_shifts.size(); ++early)
        for (std::size_t late = 0; late < k_late_shifts.size(); ++late) {
            if (early == k_no_early && late == k_no_late) continue;
            if (bent(early, late, [](std::size_t) noexcept { return 0.0f; }) >= least) continue;  // whatever the ground
            const Trial trial = try_shift(early, late);
            if (trial.bent < least) least = trial.bent, best = trial;
        }
    return best;
}

/// An edge so near to lift or strike that only a leap would clear it is grazed.
void Clearance::plan() noexcept {
    for (given_up_ = 1; given_up_ <= k_most_given_up; given_up_ += 2) {
        const Trial best = choose_shifts();
        foot_.shift_early = travel_ * k_early_shifts[best.early];
        foot_.shift_late = travel_ * k_late_shifts[best.late];
        foot_.hump = best.hump;
        if (best.overshoot < k_overshoot) return;
    }
}

}  // namespace

void plan_clearance(const FootRig& rig, FootState& foot, std::size_t side, const GroundProbe& probe,
                    const Forecast& forecast) noexcept {
    Clearance(rig, foot, side, probe, forecast).plan();
}

}  // namespace surefoot
