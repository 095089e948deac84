#include <surefoot/clip/foot_prints.h>
#include <surefoot/fit/rolling_foot.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr Vec3 k_x{1, 0, 0}, k_y{0, 1, 0}, k_z{0, 0, 1};
constexpr float k_clear = 0.012f;     // [m] of a sole in the middle of its swing, at least
constexpr float k_half_width = 0.2f;  // of a sole's length
constexpr float k_still = 0.01f;      // [m/s] who goes slower stands
constexpr float k_step = 1e-3f;       // of the cycle, for slopes

float between(float t, float from, float to) { return smooth_step((t - from) / (to - from)); }
/// Rises from 0 and returns to 0 with no slope at either end; 1 in the middle.
float bump(float t) { return 16 * t * t * (1 - t) * (1 - t); }

template <class T>
T hermite(T a, T slope_a, T b, T slope_b, float t) {
    const float u = 1 - t;
    return a * (u * u * (1 + 2 * t)) + b * (t * t * (3 - 2 * t)) + slope_a * (t * u * u) - slope_b * (t * t * u);
}

/// Where a foot's series is at a share of its own cycle: as foot_series_phase, but its pace goes over smoothly where
/// the foot strikes and lifts.
float smooth_series_phase(float share, float lift, float series_lift) {
    const float standing = series_lift / lift, swinging = (1 - series_lift) / (1 - lift);
    const float pace = 2 * standing * swinging / (standing + swinging);  // monotone (Fritsch and Butland, 1984)
    if (share < lift) return hermite(0.0f, pace * lift, series_lift, pace * lift, share / lift);
    const float swing = 1 - lift;
    return hermite(series_lift, pace * swing, 1.0f, pace * swing, (share - lift) / swing);
}

/// The foot's rotation when it lies flat and points ahead.
Quat flat_rotation(const Leg& leg) {
    const Quat upright = rotation_between(leg.up, k_y);
    const Vec3 ahead = rotate(upright, leg.forward);
    return from_yaw(-atan2(ahead.x, ahead.z)) * upright;
}

}  // namespace

FootHold hold_of(const HarmonicGait& gait) noexcept {
    constexpr float k_ringing = 0.02f;  // [rad]
    return gait.foot_hold > 0 ? FootHold{gait.foot_hold, k_ringing} : FootHold{};
}

RollingFoot::RollingFoot(const HarmonicGait& gait, std::span<const float> values, const GaitRhythm& rhythm,
                         std::size_t side, Vec3 origin, const FootHold& hold)
    : gait_(gait),
      values_(values),
      rhythm_(rhythm),
      side_(side),
      leg_(gait.soles.side[side]),
      origin_(origin),
      stands_(foot_speed(rhythm.velocity, rhythm.turn_rate) < k_still),
      flat_(flat_rotation(leg_)),
      toes_(leg_.ball),
      step_(step_of(rhythm, side)),
      lift_(hold.share * step_.lift),
      flat_pitch_(hold.flat) {
    if (leg_.toes != k_no_joint) {
        const Transform& rest = gait.skeleton->rest[static_cast<std::size_t>(leg_.toes)];
        toes_flat_ = rest.rotation;
        toes_ = rest.translation;
    }
    // The foothold is where the flat foot would be, in the mean over the middle of the stance.
    constexpr int k_samples = 16;
    constexpr float k_edge = 0.15f;
    const float stance = stands_ ? 1.0f : lift_;
    for (int i = 0; i < k_samples; ++i) {
        const float within = (static_cast<float>(i) + 0.5f) / k_samples;
        const float share = stance * (stands_ ? within : k_edge + (1 - 2 * k_edge) * within);
        const Transform print = captured_print(share);
        const float yaw = attitude(print.rotation).yaw;
        const Vec3 place = print.translation - rotate(from_yaw(yaw), rolled(share).ankle);
        foothold_.position += Vec3{place.x, 0, place.z} / k_samples;
        foothold_.yaw += yaw / k_samples;
    }
}

/// The foot joint as the gait has it, from where the root is in the middle of the stance.
Transform RollingFoot::captured_print(float share) const {
    const FootPrint print = foot_print(gait_, values_, side_, smooth_series_phase(share, step_.lift, gait_.foot_lift));
    Transform foot = stand_on(gait_.legs.side[side_], print.rotation, print.heel, print.ball);
    foot.translation = foot.translation - origin_;
    return foot;
}

/// By where its left side points, which tells the yaw even of a foot whose toes hang straight down.
RollingFoot::Attitude RollingFoot::attitude(Quat rotation) const {
    const Quat turned = rotation * conjugate(flat_);
    const Vec3 left = rotate(turned, k_x);
    const float yaw = atan2(-left.z, left.x), roll = asin(std::clamp(left.y, -1.0f, 1.0f));
    const Vec3 ahead = rotate(conjugate(from_yaw(yaw) * axis_angle(k_z, roll)) * turned, k_z);
    return {yaw, atan2(ahead.y, ahead.z), roll};
}

/// The root's move since the middle of the stance; in the swing it goes over to that to the middle of the next.
RootFrame RollingFoot::moved(float share) const {
    return integrate(rhythm_.velocity, rhythm_.turn_rate, foot_age(step_, step_, since_strike(rhythm_, side_, share)));
}

RollingFoot::Placed RollingFoot::captured(float share) const {
    const Transform foot = inverse(to_transform(moved(share))) * captured_print(share);
    return {foot.translation, attitude(foot.rotation).yaw};
}

float RollingFoot::pitch(float share) const {
    const float angle = attitude(captured_print(share).rotation).pitch;
    return angle * angle * angle / (angle * angle + flat_pitch_ * flat_pitch_);
}

/// Of a foot that points down the toes lie flat while it stands, peel off at the end, and hang free in the swing.
float RollingFoot::toe_bend(float share) const {
    constexpr float k_peel = 0.8f, k_quickest = 0.08f;  // share of the stance from which on they peel off; [s] at least
    constexpr float k_left = 0.55f;                     // of the bend at its end
    constexpr float k_hanging = 0.4f, k_landing = 0.7f;  // shares of the swing
    const float down = std::max(0.0f, -pitch(share));
    const float from = std::min(k_peel, 1 - k_quickest / step_.stance);
    if (share < lift_) return down * (1 - (1 - k_left) * between(share / lift_, from, 1));
    const float t = (share - lift_) / (1 - lift_);
    return down * std::max(k_left * (1 - between(t, 0, k_hanging)), between(t, k_landing, 1));
}

float RollingFoot::roll(float share) const {
    if (share <= lift_) return 0;
    return attitude(captured_print(share).rotation).roll * bump((share - lift_) / (1 - lift_));
}

RollingFoot::Sole RollingFoot::rolled(float share) const {
    const float foot_pitch = stands_ ? 0 : pitch(share), bend = stands_ ? 0 : toe_bend(share);
    const float tilt = stands_ ? 0 : roll(share);
    Sole sole;
    sole.foot = axis_angle(k_z, tilt) * axis_angle(k_x, -foot_pitch) * flat_;
    sole.toes = axis_angle(rotate(conjugate(flat_), k_x), -bend) * toes_flat_;
    const bool has_toes = leg_.toes != k_no_joint;
    const Vec3 tip = has_toes ? toes_ + rotate(sole.toes, leg_.toe_tip) : leg_.toe_tip;
    const Vec3 flat_tip = has_toes ? toes_ + rotate(toes_flat_, leg_.toe_tip) : leg_.toe_tip;
    const Vec3 about = foot_pitch >= 0 ? leg_.heel : has_toes ? tip : leg_.ball;
    const Vec3 flat_about = foot_pitch >= 0 ? leg_.heel : has_toes ? flat_tip : leg_.ball;
    sole.ankle = rotate(flat_, flat_about) - rotate(sole.foot, about);
    float lowest = 0;
    for (const Vec3 point : {leg_.heel, leg_.ball, tip}) lowest = std::min(lowest, rotate(sole.foot, point).y);
    sole.ankle.y = -lowest + k_half_width * distance(leg_.heel, flat_tip) * std::fabs(sin(tilt));
    return sole;
}

RollingFoot::Placed RollingFoot::held(float share) const {
    const float seconds = stands_ ? 0 : since_strike(rhythm_, side_, share) - 0.5f * step_.stance;
    const RootFrame root = integrate(rhythm_.velocity, rhythm_.turn_rate, seconds);
    const RootFrame flat = surefoot::between(root, foothold_);
    return {transform_point(to_transform(flat), rolled(share).ankle), flat.yaw};
}

/// The gait's own swing, led over from the place where the foot stood to that where it will.
RollingFoot::Placed RollingFoot::swinging(float share) const {
    const float lift = lift_, swing = 1 - lift, t = (share - lift) / swing;
    const auto change = [&](float at_share, float to) {  // of place and yaw, and its slope over the swing
        struct {
            Vec3 move, slope;
            float yaw, yaw_slope;
        } c;
        const Placed here = held(to), own = captured(at_share);
        c.move = here.ankle - own.ankle;
        c.yaw = wrap_angle(here.yaw - own.yaw);
        const float inward = to == 0 ? -k_step : k_step;  // the gait's slope within the swing, the other's outside it
        const Placed own_near = captured(at_share + inward), near = held(to - inward);
        const float per_swing = swing / inward;
        c.slope = ((here.ankle - near.ankle) - (own_near.ankle - own.ankle)) * per_swing;
        c.yaw_slope = (wrap_angle(here.yaw - near.yaw) - wrap_angle(own_near.yaw - own.yaw)) * per_swing;
        return c;
    };
    const auto from = change(lift, lift), to = change(1, 0);
    Placed foot = captured(share);
    foot.ankle += hermite(from.move, from.slope, to.move, to.slope, t);
    foot.yaw += hermite(from.yaw, from.yaw_slope, to.yaw, to.yaw_slope, t);
    // Never into the floor: with some way to spare in the middle, none at the ends.
    const float height = rolled(share).ankle.y, clear = foot.ankle.y - height, spare = k_clear * bump(t);
    foot.ankle.y = height + 0.5f * (clear + std::sqrt(clear * clear + 4 * spare * spare));
    return foot;
}

FootGoal RollingFoot::at(float share) const {
    const Placed placed = stands_ || share <= lift_ ? held(share) : swinging(share);
    const Sole sole = rolled(share);
    return {{normalized(from_yaw(placed.yaw) * sole.foot), placed.ankle}, sole.toes};
}

FootGoal RollingFoot::print(float share) const {
    const FootGoal goal = at(share);
    return {to_transform(moved(share)) * goal.foot, goal.toes};
}

GroundedBody::GroundedBody(const HarmonicGait& gait, std::span<const float> values, const GaitRhythm& rhythm,
                           Vec3 origin)
    : gait_(gait),
      values_(values),
      origin_(origin),
      feet_{RollingFoot(gait, values, rhythm, 0, origin, hold_of(gait)),
            RollingFoot(gait, values, rhythm, 1, origin, hold_of(gait))} {}

void GroundedBody::pose(float phase, std::span<Transform> locals) const {
    constexpr float k_free = 0.985f;  // share of its length to which a leg reaches freely: a knee bent by 20 degrees
    joint_pose(gait_, values_, {}, {&phase, 1}, locals);
    if (!gait_.moving.empty()) {
        Vec3& top = locals[static_cast<std::size_t>(gait_.moving.front())].translation;
        top = top - origin_;
    }
    const std::array<FootGoal, 2> goals{feet_[0].at(phase), feet_[1].at(phase < 0.5f ? phase + 0.5f : phase - 0.5f)};
    stand_on_feet(*gait_.skeleton, gait_.soles, gait_.legs, goals, k_free, locals);
}

}  // namespace surefoot
