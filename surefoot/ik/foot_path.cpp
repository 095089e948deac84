// Where a foot is at a moment: its plants, what lies between them, what replanning left over.

#include <surefoot/ik/foot_forecast.h>

#include <algorithm>

namespace surefoot {
namespace {

/// How deep the clip itself sinks heel or ball into its own ground; it begins smoothly.
float own_depth(const LegPoints& points) noexcept {
    constexpr float k_soft = 0.004f;  // [m]
    const float depth = std::max(0.0f, -std::min(points.heel.y, points.ball.y));
    return depth * depth / (depth + k_soft);
}

Vec3 plant_ankle(const Plant& plant, const LegPoints& points, float leg_length) noexcept {
    const Vec3 ankle = planted(plant, points.ankle, leg_length);
    return plant.uneven > 0 ? ankle + k_up * (plant.uneven * own_depth(points)) : ankle;
}

/// Turns a foot about its ball, heel up; the toes stay. Without a toe joint the tip is what stays on the ground.
void raise_heel(PlacedFoot& placed, const FootState& foot, double clock, const LegPoints& points,
                const Leg& leg) noexcept {
    if (!(foot.rise > 0) || clock <= foot.rise_from || clock >= foot.rise_until) return;
    const auto between = [&](double a, double b) { return smootherstep(static_cast<float>((clock - a) / (b - a))); };
    const float share =
        clock < foot.rise_peak ? between(foot.rise_from, foot.rise_peak) : 1 - between(foot.rise_peak, foot.rise_until);
    const Vec3 pivot = leg.toes == k_no_joint ? points.toe_tip : points.ball;
    const Vec3 arm = rotate(placed.tilt, pivot - points.ankle);
    const Vec3 forward = rotate(placed.tilt, points.ball - points.heel);
    const Quat turn = axis_angle(normalized(cross(k_up, forward), {1, 0, 0}), foot.rise * share);
    placed.ankle += arm - rotate(turn, arm);
    placed.tilt = turn * placed.tilt;
}

/// How far it has come from one plant to the next.
float swing_share(const FootState& foot, double clock) noexcept {
    if (!foot.has_next || clock <= foot.lift) return 0;
    if (clock >= foot.strike) return 1;
    return smootherstep(static_cast<float>((clock - foot.lift) / (foot.strike - foot.lift)));
}

Quat part_of_turn(Quat from, Quat to, float share) noexcept {
    return from_rotation_vector(to_rotation_vector(to * conjugate(from)) * share) * from;
}

PlacedFoot stand_or_swing(const FootState& foot, double clock, const LegPoints& points, float leg_length) noexcept {
    const auto stand = [&](const Plant& planted) {
        const Plant plant = plant_for(planted, points.heel, points.ball);
        return PlacedFoot{plant_ankle(plant, points, leg_length), plant.tilt, plant.uneven, plant.tilt};
    };
    if (!foot.has_next || clock <= foot.lift) return stand(foot.plant);
    if (clock >= foot.strike) return stand(foot.next);
    const float s = swing_share(foot, clock);
    const PlacedFoot a = stand(foot.plant), b = stand(foot.next);
    const Quat tilt = part_of_turn(a.tilt, b.tilt, s);
    return {a.ankle + (b.ankle - a.ankle) * s, tilt, a.uneven + (b.uneven - a.uneven) * s, tilt};
}

}  // namespace

Quat ground_tilt(const FootState& foot, double clock) noexcept {
    const float share = swing_share(foot, clock);
    if (share == 0) return foot.plant.tilt;
    if (share == 1) return foot.next.tilt;
    return part_of_turn(foot.plant.tilt, foot.next.tilt, share);
}

PlacedFoot blend_plants(const FootState& foot, double clock, const LegPoints& points, const Leg& leg) noexcept {
    PlacedFoot placed = stand_or_swing(foot, clock, points, leg.length());
    raise_heel(placed, foot, clock, points, leg);
    return placed;
}

namespace {

/// What is left of the fade: cubic Hermite from (offset, rate) to (0, 0).
struct Fade {
    Vec3 offset;
    float turn_share = 0;
};
Fade fade_at(const FootState& foot, double clock) noexcept {
    if (clock >= foot.fade_until || foot.fade_until <= foot.fade_from) return {};
    const auto length = static_cast<float>(foot.fade_until - foot.fade_from);
    const float t = std::clamp(static_cast<float>(clock - foot.fade_from) / length, 0.0f, 1.0f);
    const float rest = (1 - t) * (1 - t);
    return {foot.fade_offset * (rest * (1 + 2 * t)) + foot.fade_rate * (rest * t * length), 1 - smootherstep(t)};
}

}  // namespace

Vec3 fade_offset(const FootState& foot, double clock) noexcept { return fade_at(foot, clock).offset; }

SwingBumps swing_bumps(float share) noexcept {
    constexpr float k_early = 0.28f, k_late = 0.72f, k_half = 0.28f;  // their middles and half their widths
    const auto bump = [&](float middle) {
        const float x = (share - middle) / k_half, inside = std::max(0.0f, 1 - x * x);
        return inside * inside * inside;
    };
    return {bump(k_early), bump(k_late)};
}

PlacedFoot place_foot(const FootState& foot, double clock, const LegPoints& points, const Leg& leg) noexcept {
    PlacedFoot placed = blend_plants(foot, clock, points, leg);
    if (!foot.has_next || clock < foot.hump_from || clock >= foot.strike) return placed;
    const auto share = static_cast<float>((clock - foot.hump_from) / (foot.strike - foot.hump_from));
    const Fade fade = fade_at(foot, clock);
    placed.ankle +=
        fade.offset + swing_bumps(share).shift(foot.shift_early, foot.shift_late) + k_up * foot.hump.at(share);
    if (fade.turn_share > 0) {
        const Quat turn = from_rotation_vector(foot.fade_turn * fade.turn_share);
        placed.tilt = turn * placed.tilt;
        placed.toes_tilt = turn * placed.toes_tilt;
    }
    return placed;
}

}  // namespace surefoot
