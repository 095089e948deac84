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
        }
    }
    void plan() noexcept;

  private:
    void choose_shifts() noexcept;
    float try_shift(float early, float late) noexcept;
    float needed(const LegPoints& points, const PlacedFoot& placed, float margin, float step) const noexcept;

    const FootRig& rig_;
    FootState& foot_;
    const GroundProbe& probe_;
    // At the samples of the hump, one before and one after:
    std::array<LegPoints, k_hump_samples + 2> points_;
    std::array<PlacedFoot, k_hump_samples + 2> placed_;
    std::array<Vec3, k_hump_samples + 2> fade_;
    std::array<float, k_hump_samples + 2> step_;  // [m] how high the foot shall be by itself
    Vec3 travel_;                                 // unit, level
    float start_value_, start_slope_;
    int given_up_ = 1;        // samples at either end at which the ground is not kept clear
    float highest_need_ = 0;  // [m] above the blend of the two plants, at the last try
    float overshoot_ = 0;     // [m] by which the hump is higher than that
};

/// Least height of the ankle above its height in the clip so that heel, ball and toe tip clear the ground.
float Clearance::needed(const LegPoints& points, const PlacedFoot& placed, float margin, float step) const noexcept {
    const std::array<Vec3, 3> soles{points.heel, points.ball, points.toe_tip};
    float need = k_no_need;
    for (std::size_t k = 0; k < soles.size(); ++k) {
        const Vec3 arm = rotate(placed.tilt, soles[k] - points.ankle), place = placed.ankle + arm;
        const float reach = margin < 0 && k == 2 ? margin * k_tip_share : margin;
        const std::array<Vec3, 3> under{place, place + travel_ * reach, place - travel_ * reach};
        std::array<float, 3> heights;
        probe_.heights(under, heights);
        const auto [lowest, highest] = std::minmax({heights[0], heights[1], heights[2]});
        const float ground = margin < 0 ? lowest : highest;
        float own = std::min(rig_.settings.swing_clearance, soles[k].y);
        if (own < 0) own *= 1 - placed.uneven;
        own = std::max(own, step);
        float least = ground + own - (points.ankle.y + arm.y);
        if (k == 2 && soles[k].y < k_toe_down) least -= k_toe_bend;
        need = std::max(need, least);
    }
    return need;
}

/// Plans the hump for a shift; answers how bent the way is then, as the sum of its squared second differences.
float Clearance::try_shift(float early, float late) noexcept {
    foot_.shift_early = travel_ * early;
    foot_.shift_late = travel_ * late;
    HumpTask task;
    highest_need_ = 0;
    std::array<Vec3, k_hump_samples + 2> shift;
    for (int j = -1; j <= k_hump_samples; ++j) {
        const auto at = static_cast<std::size_t>(j + 1);
        const LegPoints& points = points_[at];
        PlacedFoot placed = placed_[at];
        task.base[at] = placed.ankle.y - points.ankle.y;
        shift[at] = swing_shift(foot_, static_cast<float>(j) / (k_hump_samples - 1));
        if (j < 0 || j == k_hump_samples) continue;
        const int from_end = std::min(j, k_hump_samples - 1 - j);
        float& need = task.need[static_cast<std::size_t>(j)];
        need = k_no_need;
        if (from_end < given_up_) continue;
        const float inner = std::clamp(static_cast<float>(from_end - k_end) / (k_middle - k_end), 0.0f, 1.0f);
        const float margin = k_end_margin + (k_path_margin - k_end_margin) * inner;
        placed.ankle += fade_[at] + shift[at];
        need = needed(points, placed, margin, step_[at]);
        highest_need_ = std::max(highest_need_, need - task.base[at]);
    }
    task.start_value = start_value_;
    task.start_slope = start_slope_;
    foot_.hump = rig_.solver->solve(task);

    float highest = 0;
    for (int j = 0; j < k_hump_samples; ++j)
        highest = std::max(highest, foot_.hump.at(static_cast<float>(j) / (k_hump_samples - 1)));
    overshoot_ = highest - std::max({highest_need_, start_value_, 0.0f});

    float bent = 0;
    const auto height = [&](std::size_t i) {
        return task.base[i] + foot_.hump.at(static_cast<float>(i - 1) / (k_hump_samples - 1));
    };
    for (std::size_t i = 2; i < k_hump_samples; ++i) {
        const float up = height(i - 1) - 2 * height(i) + height(i + 1);
        const Vec3 level = shift[i - 1] - 2.0f * shift[i] + shift[i + 1];
        bent += up * up + dot(level, level);
    }
    return bent;
}

void Clearance::choose_shifts() noexcept {
    const float without = try_shift(0, 0);
    if (highest_need_ < k_low) return;
    float least = without * k_shift_worth, best_early = 0, best_late = 0;
    for (const float early : k_early_shifts)
        for (const float late : k_late_shifts) {
            if (early == 0 && late == 0) continue;
            const float cost = try_shift(early, late);
            if (cost < least) least = cost, best_early = early, best_late = late;
        }
    try_shift(best_early, best_late);
}

/// An edge so near to lift or strike that only a leap would clear it is grazed.
void Clearance::plan() noexcept {
    for (given_up_ = 1; given_up_ <= k_most_given_up; given_up_ += 2) {
        choose_shifts();
        if (overshoot_ < k_overshoot) return;
    }
}

}  // namespace

void plan_clearance(const FootRig& rig, FootState& foot, std::size_t side, const GroundProbe& probe,
                    const Forecast& forecast) noexcept {
    Clearance(rig, foot, side, probe, forecast).plan();
}

}  // namespace surefoot
