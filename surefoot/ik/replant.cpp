#include <surefoot/ik/replant.h>

#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_dragged_speed = 0.005f;  // [m/s] at a foot: less is left alone
constexpr float k_stirs = 0.2f;            // [m/s] of a foot that was to rest: steering has changed
constexpr float k_rigid = 0.1f;            // of the root's way at a foot, that the foot's may differ from it
constexpr float k_foreseen = 0.2f;         // of the limits below: a drag that goes on, not the last of a stop
constexpr float k_most_drift = 0.15f;      // of the leg's length, before a foot steps
constexpr float k_most_turn = 30 * k_radians_per_degree;
constexpr float k_settled = 0.35f;        // of these: a character that stands still again closes up what is more
constexpr float k_at_rest = 0.05f;        // of these, over the forecast: it stands still
constexpr int k_settle_after = 12;        // samples
constexpr int k_swing = 18, k_pause = 2;  // samples of a step; from one foot's strike to the other's lift
constexpr int k_shortest = 3;             // samples of a stance
constexpr int k_together = 3;             // samples: feet that would step at the same time
constexpr int k_last = Forecast::k_samples - 1, k_none = Forecast::k_samples;

Vec3 middle_of(const LegPoints& p) noexcept {
    const Vec3 middle = (p.heel + p.ball) * 0.5f;
    return {middle.x, 0, middle.z};
}

/// Level, of the clip's foot.
struct Stand {
    Vec3 middle, forward;
};
Stand stand_of(const LegPoints& p) noexcept {
    return {middle_of(p), normalized(Vec3{p.ball.x - p.heel.x, 0, p.ball.z - p.heel.z})};
}

/// How far a foot has gone from another place, 1: so far that it steps.
float drift(const Stand& from, const Stand& to, float leg_length) noexcept {
    const float turn = std::fabs(atan2(cross(from.forward, to.forward).y, dot(from.forward, to.forward)));
    return std::max(planar_length(to.middle - from.middle) / (k_most_drift * leg_length), turn / k_most_turn);
}

/// The foot stays where it is placed now.
void hold_here(Plant& plant, const LegPoints& points, float leg_length) noexcept {
    const Stand stand = stand_of(points);
    plant.foothold = planted(plant, stand.middle, leg_length);
    plant.centre = stand.middle;
    plant.heading = stand.forward;
    plant.held = true;
}

class Replanting {
  public:
    Replanting(const FootRig& rig, FootPlacementState& state, Forecast& forecast) noexcept
        : rig_(rig), state_(state), forecast_(forecast) {}
    void run() noexcept;

  private:
    float leg_length(std::size_t side) const noexcept { return rig_.legs.side[side].length(); }
    Stand stand(std::size_t side, int sample) const noexcept {
        return stand_of(forecast_.legs[side][static_cast<std::size_t>(sample)]);
    }
    bool swings(std::size_t side) const noexcept { return is_swinging(state_.feet[side], state_.clock); }
    bool is_dragged_on(std::size_t side) const noexcept;
    void prepare(std::size_t side) noexcept;
    int strike_of(std::size_t side) const noexcept;
    int due(std::size_t side) const noexcept;
    std::size_t first_to_step(const std::array<int, 2>& due) const noexcept;
    int end_of_stance(std::size_t side, int first) const noexcept;
    void step(std::size_t side, int lift) noexcept;
    void land(std::size_t side) noexcept;

    const FootRig& rig_;
    FootPlacementState& state_;
    Forecast& forecast_;
    std::array<bool, 2> held_{};
};

/// The sample at which a swinging foot comes down.
int Replanting::strike_of(std::size_t side) const noexcept {
    const double samples = (state_.feet[side].strike - state_.clock) * Forecast::k_rate;
    return std::clamp(static_cast<int>(std::lround(samples)), 1, k_last);
}

/// True of a foot that the root drags, and will by what is foreseen, or has far enough already.
bool Replanting::is_dragged_on(std::size_t side) const noexcept {
    const FootState& foot = state_.feet[side];
    const Stand now = stand(side, 0), planted{foot.plant.centre, foot.plant.heading};
    return foot.dragged && (drift(now, stand(side, k_last), leg_length(side)) > k_foreseen ||
                            drift(planted, now, leg_length(side)) > 1);
}

void Replanting::prepare(std::size_t side) noexcept {
    FootState& foot = state_.feet[side];
    const bool ours = swings(side) && foot.next.held;
    if (forecast_.rests[side]) {
        if (!foot.plant.held && !swings(side) && is_dragged_on(side))
            hold_here(foot.plant, forecast_.legs[side][0], leg_length(side));
        held_[side] = ours || (foot.plant.held && !swings(side));
        if (!held_[side]) return;
        forecast_.heel_down[side].fill(true);
        forecast_.ball_down[side].fill(true);
        forecast_.run_count[side] = 1;
        forecast_.runs[side][0] = {0, k_last};
        if (ours) land(side);
    } else if (ours) {
        land(side);
    } else if (foot.plant.held && !swings(side)) {
        const LegPoints& now = forecast_.legs[side][0];
        foot.plant = plant_for(foot.plant, now.heel, now.ball);
        foot.plant.held = false;
    }
}

/// A foot that is in the air though the clip's is not comes down when it was to, or, where the clip steps before, as
/// the clip does.
void Replanting::land(std::size_t side) noexcept {
    auto& runs = forecast_.runs[side];
    int& count = forecast_.run_count[side];
    const int strike = strike_of(side);
    if (count == 0 || runs[0].first >= strike) return;
    if (forecast_.rests[side]) {
        runs[0] = {strike, end_of_stance(side, strike)};
    } else if (runs[0].last >= strike + k_shortest) {
        runs[0].first = strike;
    } else {
        std::move(runs.begin() + 1, runs.begin() + count, runs.begin());
        --count;
    }
}

/// When a foot that stands must step; k_none: not in sight.
int Replanting::due(std::size_t side) const noexcept {
    const Plant& plant = state_.feet[side].plant;
    const Stand planted{plant.centre, plant.heading};
    const float length = leg_length(side);
    const bool at_rest = drift(stand(side, 0), stand(side, k_last), length) < k_at_rest;
    if (at_rest) return drift(planted, stand(side, 0), length) > k_settled ? k_settle_after : k_none;
    float before = drift(planted, stand(side, 0), length);
    for (int i = 1; i <= k_last; ++i) {
        const float now = drift(planted, stand(side, i), length);
        if (now >= 1 && now > before) return i - 1;  // one that has just stepped ahead comes nearer yet
        before = now;
    }
    return k_none;
}

/// The last sample of a stance that begins at `first`, on a foothold in its middle.
int Replanting::end_of_stance(std::size_t side, int first) const noexcept {
    int last = std::min(first + k_shortest, k_last);
    while (last < k_last && drift(stand(side, (first + last) / 2), stand(side, last), leg_length(side)) < 1) ++last;
    return last;
}

/// Of two that must step at about the same time, the one on the side to which the root turns or goes; else the one that
/// is farther off.
std::size_t Replanting::first_to_step(const std::array<int, 2>& due) const noexcept {
    if (std::abs(due[0] - due[1]) > k_together) return due[0] < due[1] ? 0 : 1;
    constexpr float k_lever = 0.3f, k_sideways = 0.005f;  // [m] that a turn counts for; less is straight ahead
    const Vec3 left = rotate(from_yaw(forecast_.yaw[0]), {1, 0, 0});
    const float aside =
        dot(forecast_.root[k_last] - forecast_.root[0], left) + k_lever * (forecast_.yaw[k_last] - forecast_.yaw[0]);
    if (std::fabs(aside) > k_sideways) return aside > 0 ? 0 : 1;
    const auto off = [&](std::size_t side) {
        const Plant& plant = state_.feet[side].plant;
        return drift({plant.centre, plant.heading}, stand(side, 0), leg_length(side));
    };
    return off(0) >= off(1) ? 0 : 1;
}

void Replanting::step(std::size_t side, int lift) noexcept {
    const int strike = lift + k_swing;
    if (strike + k_shortest > k_last) return;  // the next plan will see it
    forecast_.runs[side][0] = {0, lift};
    forecast_.runs[side][1] = {strike, end_of_stance(side, strike)};
    forecast_.run_count[side] = 2;
}

void Replanting::run() noexcept {
    prepare(0);
    prepare(1);
    std::array<int, 2> due_at{k_none, k_none};
    for (std::size_t side = 0; side < 2; ++side)
        if (held_[side] && !swings(side)) due_at[side] = due(side);
    for (std::size_t side = 0; side < 2; ++side) {
        if (due_at[side] == k_none) continue;
        const std::size_t other = 1 - side;
        if (!forecast_.rests[other]) continue;  // the clip steps
        if (swings(other))
            step(side, std::max(due_at[side], strike_of(other) + k_pause));
        else if (due_at[other] == k_none)
            step(side, due_at[side]);
    }
    if (due_at[0] == k_none || due_at[1] == k_none) return;
    // The one steps early enough for the other to step in time.
    const std::size_t first = first_to_step(due_at), second = 1 - first;
    const int lift = std::max(0, std::min(due_at[first], due_at[second] - k_swing - k_pause));
    step(first, lift);
    step(second, std::max(due_at[second], lift + k_swing + k_pause));
}

}  // namespace

bool feel_drag(const FootRig& rig, FootPlacementState& state, const FootInput& input) noexcept {
    const Vec3 ground_way = state.ground_velocity * input.dt;
    const Quat turn = from_yaw(input.root.yaw - state.last_root.yaw);
    bool begins = false;
    for (std::size_t side = 0; side < 2; ++side) {
        FootState& foot = state.feet[side];
        const Vec3 middle = middle_of(world_leg(rig.legs.side[side], input.legs.side[side], input.root).points);
        const Vec3 with_root = input.root.position + rotate(turn, foot.last_middle - state.last_root.position);
        const float way = planar_length(with_root - foot.last_middle - ground_way);
        const bool was = foot.dragged;
        foot.dragged = state.started && foot.rests && way > k_dragged_speed * input.dt &&
                       planar_length(middle - with_root) < k_rigid * way;
        const bool stirs = state.started && foot.rests && planar_length(middle - with_root) > k_stirs * input.dt;
        begins = begins || stirs || (foot.dragged && !was && !foot.plant.held);
        foot.last_middle = middle;
    }
    state.last_root = input.root;
    return begins;
}

void replant(const FootRig& rig, FootPlacementState& state, Forecast& forecast) noexcept {
    Replanting(rig, state, forecast).run();
}

}  // namespace surefoot
