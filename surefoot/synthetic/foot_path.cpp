#include <surefoot/synthetic/foot_path.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

// A turn slower than this [rad/s] is walked as a straight line: the arc's formula would divide by almost nothing.
constexpr float k_straight = 1e-6f;
// Soles leave the heel for the toes in mid-swing over about this much height [m] instead of with a kink.
constexpr float k_sole_softness = 0.012f;

/// A vector of the foot's sagittal plane, pitched toes up.
Vec3 pitched(float y, float z, float pitch) {
    const float c = cos(pitch), s = sin(pitch);
    return {0, y * c + z * s, z * c - y * s};
}

/// Rises from 0 and returns to 0 with no slope at either end; 1 in the middle.
float bump(float t) { return 16 * t * t * (1 - t) * (1 - t); }
/// The same with its peak at two fifths.
float early_bump(float t) {
    constexpr float k_peak = 0.4f * 0.4f * 0.6f * 0.6f * 0.6f;
    return t * t * (1 - t) * (1 - t) * (1 - t) / k_peak;
}

Vec3 hermite(Vec3 a, Vec3 velocity_a, Vec3 b, Vec3 velocity_b, float t, float seconds) {
    const float u = 1 - t;
    return a * (u * u * (1 + 2 * t)) + b * (t * t * (3 - 2 * t)) + velocity_a * (t * u * u * seconds) -
           velocity_b * (t * t * u * seconds);
}

/// Keys over the shares of stance and swing become keys over the phase, in radians.
PeriodicCurve pitch_curve(const GaitParameters& gait) {
    std::vector<PeriodicCurve::Key> keys;
    for (const auto& key : gait.stance_pitch) keys.push_back({key.phase * gait.duty, key.value * k_radians_per_degree});
    for (const auto& key : gait.swing_pitch)
        keys.push_back({gait.duty + key.phase * (1 - gait.duty), key.value * k_radians_per_degree});
    return PeriodicCurve(std::move(keys));
}

/// Share of the foot's downward pitch that the bending toes make up for: all while they lie on the ground.
PeriodicCurve toe_curve(const GaitParameters& gait) {
    if (gait.duty >= 1) return PeriodicCurve({{0, 1}});
    const auto swing = [&](float share) { return gait.duty + share * (1 - gait.duty); };
    return PeriodicCurve({{0, 1},
                          {gait.toes_flat_until * gait.duty, 1},
                          {gait.duty, gait.toe_share},
                          {swing(0.4f), 0},
                          {swing(0.7f), 0}});
}

}  // namespace

RootFrame gait_travel(const GaitParameters& gait, float seconds) noexcept {
    const float rate = gait.turn * k_radians_per_degree, yaw = rate * seconds;
    if (std::fabs(rate) < k_straight) return {{gait.lateral * seconds, 0, gait.forward * seconds}, yaw};
    // Integral of forward (sin, 0, cos) and left (cos, 0, -sin) over the arc.
    const float s = sin(yaw) / rate, c = (1 - cos(yaw)) / rate;
    return {{gait.forward * c + gait.lateral * s, 0, gait.forward * s - gait.lateral * c}, yaw};
}

FootPath::FootPath(const GaitParameters& gait, const LegSize& size, RootFrame foothold)
    : gait_(gait),
      size_(size),
      foothold_(foothold),
      cycle_(static_cast<float>(gait.intervals) / k_gait_fps),
      pitch_(pitch_curve(gait)),
      toe_share_(toe_curve(gait)) {}

float FootPath::pitch(float phase) const { return pitch_(phase); }
float FootPath::toe_bend(float phase) const { return std::max(0.0f, -pitch_(phase)) * toe_share_(phase); }

/// Height of the ankle above the lowest point of the sole. `softness` above zero smooths the change of that point and
/// only ever adds height.
float FootPath::sole_reach(float phase, float softness) const {
    const float foot = pitch(phase), toes = foot + toe_bend(phase);
    const float heel = -pitched(-size_.ankle_height, -size_.heel_back, foot).y;
    const float ball = -pitched(-size_.ankle_height, size_.ball_ahead, foot).y;
    const float tip = ball - pitched(0, size_.toe_length, toes).y;
    const float front = std::max(ball, tip), highest = std::max(heel, front);
    if (!(softness > 0)) return highest;
    const float gap = std::fabs(heel - front) / softness;
    return highest + softness * log(1 + exp(-gap));
}

/// The ankle while the foot rolls over its foothold, in the frame of the flat foot: about the heel's edge while the
/// toes are up, about the ball while the heel is up and the toes lie flat, about the tip once they peel off.
Vec3 FootPath::rolled(float phase) const {
    const float foot = pitch(phase), toes = foot + toe_bend(phase);
    Vec3 ankle;
    if (foot >= 0) {
        ankle = Vec3{0, 0, -size_.heel_back} - pitched(-size_.ankle_height, -size_.heel_back, foot);
    } else {
        const Vec3 ball = Vec3{0, 0, size_.ball_ahead + size_.toe_length} - pitched(0, size_.toe_length, toes);
        ankle = ball - pitched(-size_.ankle_height, size_.ball_ahead, foot);
    }
    ankle.y = sole_reach(phase, 0);
    return ankle;
}

Vec3 FootPath::rolled_velocity(float phase, float step) const {
    const Vec3 moved = (rolled(phase + step) - rolled(phase)) / (step * cycle_);
    return {0, 0, moved.z};
}

FootPose FootPath::standing(float phase) const {
    const RootFrame flat = gait_travel(gait_, (0.5f * gait_.duty - phase) * cycle_) * foothold_;
    return {transform_point(to_transform(flat), rolled(phase)), flat.yaw, pitch(phase), toe_bend(phase), true};
}

/// Horizontally a cubic in the world that keeps the velocities of the roll at both ends; vertically as high as the sole
/// asks for, plus clearance.
FootPose FootPath::swinging(float phase) const {
    constexpr float k_step = 1e-3f;
    const RootFrame from = gait_travel(gait_, (0.5f * gait_.duty - phase) * cycle_) * foothold_;
    const RootFrame to = gait_travel(gait_, (1 + 0.5f * gait_.duty - phase) * cycle_) * foothold_;
    const float t = (phase - gait_.duty) / (1 - gait_.duty), seconds = (1 - gait_.duty) * cycle_;
    const auto place = [&](const RootFrame& flat, float at) { return transform_point(to_transform(flat), rolled(at)); };
    const auto drift = [&](const RootFrame& flat, float at, float step) {
        return rotate(from_yaw(flat.yaw), rolled_velocity(at, step));
    };
    FootPose pose;
    pose.ankle = hermite(place(from, gait_.duty), drift(from, gait_.duty, -k_step), place(to, 0), drift(to, 0, k_step),
                         t, seconds);
    const float hard = sole_reach(phase, 0), soft = sole_reach(phase, k_sole_softness);
    pose.ankle.y = hard + bump(t) * (soft - hard) + gait_.clearance * bump(t) + gait_.kick * early_bump(t);
    pose.yaw = from.yaw + (to.yaw - from.yaw) * smooth_step(t);
    pose.pitch = pitch(phase);
    pose.toe_bend = toe_bend(phase);
    return pose;
}

FootPose FootPath::at(float phase) const {
    phase -= std::floor(phase);
    return phase < gait_.duty ? standing(phase) : swinging(phase);
}

}  // namespace surefoot
