#include <surefoot/graph/locomotion.h>
#include <surefoot/live/mixture.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_longest_step = 1.0f / 30;  // [s] longer frames are taken in parts
// What a body can do: changes that are asked for in less time take longer.
constexpr float k_most_acceleration = 2.3f;      // [m/s^2]
constexpr float k_most_slowing = 1.8f;           // [m/s^2] into a slower gait, whose longer stance has to be found
constexpr float k_most_braking = 3;              // [m/s^2] into a stand
constexpr float k_most_turn_acceleration = 200;  // [deg/s^2]
constexpr float k_least_change = 1.0f;           // [s] of posture
// What has become another manner's own is fast or turning only later than the posture is there.
constexpr float k_after_posture = 1.2f;  // times
// A foot that stands so near to where it belongs need not step.
constexpr float k_near = 0.05f;       // [m]
constexpr float k_near_turn = 0.12f;  // [rad]

std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

/// Whatever a host asks for, no number may come out of it that is none.
LiveRequest bounded(const LiveRig& rig, LiveRequest request) noexcept {
    constexpr float k_most_speed = 12, k_most_turn = 360, k_longest_glide = 30;
    const auto clamped = [](float x, float most) { return x == x ? std::clamp(x, -most, most) : 0.0f; };
    request.speed = clamped(request.speed, k_most_speed);
    request.turn = clamped(request.turn, k_most_turn);
    request.glide = std::max(0.0f, clamped(request.glide, k_longest_glide));
    request.manner = std::clamp(request.manner, 0, static_cast<int>(rig.manners.size()) - 1);
    return request;
}

bool asks_for_nothing(const LiveRequest& request) noexcept {
    constexpr float k_slow = 0.02f, k_slow_turn = 2;  // [m/s], [deg/s]
    return std::fabs(request.speed) < k_slow && std::fabs(request.turn) < k_slow_turn;
}

/// By the cubic's steepest slope, 1.5 times the mean one.
float seconds_for(const Glide& glide, float target, float most_rate, float asked) noexcept {
    return std::max(asked, 1.5f * std::fabs(target - glide.value()) / most_rate);
}

/// Where the root will be when it has come to rest, or far enough ahead.
RootFrame end_of_travel(const LiveRig& rig, const LiveState& state) noexcept {
    return travel(rig, state, std::max(state.speed.left(), state.turn.left()));
}

bool stands_right(const LiveRig& rig, const LiveState& state, const RootFrame& end, std::size_t side) noexcept {
    const RootFrame off = between(end * rig.stand_place[side], state.feet[side].plant);
    return !state.feet[side].swings && planar_length(off.position) < k_near && std::fabs(off.yaw) < k_near_turn;
}

/// Step after step towards `target`, to be there, at rest, in `seconds`.
void pursue(RootFrame& at, RootFrame& rate, const RootFrame& target, float seconds, float dt) noexcept {
    const float x = std::min(dt / seconds, 1.0f), y = 1 - x;
    const float stay = y * y * (1 + 2 * x), come = 1 - stay, along = seconds * x * y * y;
    const float drop = 6 * x * y / seconds, keep = y * y - 2 * x * y;
    const auto go = [&](float& value, float& slope, float to) {
        const float next = value * stay + to * come + slope * along;
        slope = (to - value) * drop + slope * keep;
        value = next;
    };
    go(at.position.x, rate.position.x, target.position.x);
    go(at.position.z, rate.position.z, target.position.z);
    go(at.yaw, rate.yaw, target.yaw);
}

/// One foot after a step of time; `before` is its share of its cycle before.
class FootStepper {
  public:
    FootStepper(const LiveRig& rig, LiveState& state, const Mixture& now, float dt) noexcept
        : rig_(rig), state_(state), now_(now), dt_(dt) {}

    void follow(std::size_t side, float before) noexcept {
        LiveFoot& foot = state_.feet[side];
        const float share = own_share(now_, state_.limbs, side), lift = now_.rhythm.lift[side];
        const bool wrapped = share + 0.5f < before;
        if (foot.swings && wrapped) {
            foot.plant = foot.plant * foot.coming * stance_place(rig_, now_, side);
            foot.swings = false;
            foot.lift = lift;
        }
        const float leaves = lift_of(foot, lift);
        if (!foot.swings && (share >= leaves || out_of_reach(side)) && !holds(side)) {
            constexpr float k_frame = 0.1f;  // later than that it has been held back
            foot = {foot.plant, {}, {}, std::fabs(share - leaves) < k_frame ? leaves : share, now_.standing, true};
            foot.coming = between(foot.plant, next_middle(side, time_to_strike(side, share)));
        } else if (foot.swings) {
            constexpr float k_shortest = 0.1f;  // [s] in which a foot may still be led elsewhere
            const float left = time_to_strike(side, share);
            pursue(foot.coming, foot.coming_rate, between(foot.plant, next_middle(side, left)),
                   std::max(left, k_shortest), dt_);
        }
    }

  private:
    /// The body has gone on so far that the leg would be torn off.
    bool out_of_reach(std::size_t side) const noexcept {
        constexpr float k_share = 0.65f;  // of the leg's length, level: no gait leaves a foot so far behind
        const Vec3 off = state_.feet[side].plant.position - rig_.stand_place[side].position;
        return -dot(off, now_.rhythm.velocity) >
               k_share * rig_.soles.side[side].length() * length(now_.rhythm.velocity);
    }
    bool holds(std::size_t side) const noexcept {
        return state_.standing.target == 1 && stands_right(rig_, state_, end_of_travel(rig_, state_), side);
    }
    /// Steady pace and turn from here on.
    bool steady() const noexcept { return state_.speed.arrived() && state_.turn.arrived(); }
    /// By the pace half way there.
    float time_to_strike(std::size_t side, float share) const noexcept {
        const float strike = side == 0 ? 0.0f : 0.5f;
        const float left = time_share(now_.rhythm, strike + 1) - time_share(now_.rhythm, strike + share);
        const float seconds = left / now_.rhythm.frequency;
        return steady() ? seconds : left / mixture_of(rig_, state_, 0.5f * seconds).rhythm.frequency;
    }
    /// The root in the middle of the foot's next stance: half a stance after the strike by what will be then; where it
    /// grows quicker still, by the pace of the strike, for then the next step will make up for it.
    RootFrame next_middle(std::size_t side, float seconds) const noexcept {
        if (steady()) return travel(rig_, state_, seconds + 0.5f * step_of(now_.rhythm, side).stance);
        const GaitRhythm then = mixture_of(rig_, state_, seconds).rhythm;
        const float half = 0.5f * step_of(then, side).stance;
        // Who slows down brakes with bent knees, on a foot that comes down nearer; the longer it still flies, the more.
        constexpr float k_nearer = 0.85f, k_long = 0.5f;  // [s]
        if (state_.speed.rate(seconds) * state_.speed.value(seconds) <= 0) {
            const float part = 1 - (1 - k_nearer) * std::min(1.0f, seconds / k_long);
            return travel(rig_, state_, seconds + part * half);
        }
        return travel(rig_, state_, seconds) * integrate(then.velocity, then.turn_rate, half);
    }

    const LiveRig& rig_;
    LiveState& state_;
    const Mixture& now_;
    float dt_;
};

/// Nothing of the mixture is on its way elsewhere.
bool is_settled(const LiveState& state) noexcept {
    const auto arrived = [](const Glide& glide) { return glide.arrived(); };
    return state.speed.arrived() && state.turn.arrived() && state.posture_speed.arrived() &&
           state.posture_turn.arrived() && state.standing.arrived() &&
           std::all_of(state.weight.begin(), state.weight.end(), arrived);
}

/// `now` is what it does before the step, and then after it.
void step(const LiveRig& rig, LiveState& state, float dt, Mixture& now, RootFrame& root) noexcept {
    const std::array<float, 2> shares{own_share(now, state.limbs, 0), own_share(now, state.limbs, 1)};
    const bool settled = is_settled(state);
    const RootFrame moved = travel(rig, state, dt);
    root = root * moved;
    for (LiveFoot& foot : state.feet) foot.plant = between(moved, foot.plant);
    advance(state.speed, dt);
    advance(state.turn, dt);
    advance(state.posture_speed, dt);
    advance(state.posture_turn, dt);
    advance(state.standing, dt);
    for (Glide& weight : state.weight) advance(weight, dt);
    state.breath = wrap_phase(state.breath + rig.idle_hz * dt);
    if (state.rests == 0) advance(state.limbs, now.order.offset, now.rhythm.frequency, dt);
    if (!settled) now = mixture_of(rig, state);
    if (state.rests != 0) return;
    FootStepper feet(rig, state, now, dt);
    for (std::size_t side = 0; side < 2; ++side) feet.follow(side, shares[side]);
    if (state.standing.target != 1) return;
    const RootFrame end = end_of_travel(rig, state);
    state.rests = stands_right(rig, state, end, 0) && stands_right(rig, state, end, 1) ? 1 : 0;
}

/// From a stand, the limbs go to where the first foot is about to leave: nobody sees them move.
void set_off(const LiveRig& rig, LiveState& state, const LiveRequest& request) noexcept {
    constexpr float k_weight_shift = 0.08f;  // share of the cycle before the foot leaves
    state.rests = 0;
    if (state.standing.value() < 0.999f) return;
    const Mixture now = mixture_of(rig, state);
    const std::size_t first = request.turn < 0 ? 1 : 0;
    const float strike = first == 0 ? 0.0f : 0.5f;
    const float phase = strike + now.rhythm.lift[first] - k_weight_shift;
    state.limbs = in_step(now.order.offset, time_share(now.rhythm, phase));
}

/// [s] in which to stop so that the body comes to rest over its foremost foot and nobody has to step back.
float seconds_to_stop(const LiveRig& rig, const LiveState& state, float seconds) noexcept {
    const Mixture now = mixture_of(rig, state);
    const float pace = length(now.rhythm.velocity);
    if (pace < 0.05f) return seconds;
    for (std::size_t side = 0; side < 2; ++side) {
        const LiveFoot& foot = state.feet[side];
        const RootFrame& place = rig.stand_place[side];
        constexpr float k_settled = 0.5f;  // share of the swing after which a foot comes down where it was going
        if (foot.swings && swing_share(foot, own_share(now, state.limbs, side)) < k_settled) continue;
        const RootFrame there = foot.swings ? foot.plant * foot.coming * place : foot.plant;
        const float way = dot(there.position - place.position, now.rhythm.velocity) / pace;
        seconds = std::max(seconds, 2 * way / pace);  // on average half as fast
    }
    return seconds;
}

/// [s] The least in which posture may change: the manner asked for, or one that is still being left, may be far off.
float posture_seconds(const LiveRig& rig, const LiveState& state, const LiveRequest& request) noexcept {
    float seconds = k_least_change;
    for (std::size_t m = 0; m < rig.manners.size(); ++m)
        if (static_cast<int>(m) == request.manner || state.weight[m].value() > 0)
            seconds = std::max(seconds, rig.change_seconds[m]);
    return seconds;
}

/// Speed and turn in step with posture. Growing, they wait for it: who rises from a crouch runs when he is up. Into a
/// manner that is far from the first they shrink beforehand, as quickly as ever. Where no manner is far off, they do as
/// they like.
void aim_travel(const LiveRig& rig, LiveState& state, const LiveRequest& request, bool stop) noexcept {
    const float speed = stop ? 0 : request.speed, turn = stop ? 0 : request.turn;
    const bool slows = std::fabs(speed) < std::fabs(state.speed.value());
    const bool straightens = std::fabs(turn) <= std::fabs(state.turn.value());
    const float posture = posture_seconds(rig, state, request);
    const bool waits = !stop && posture > k_least_change, rises = rig.change_seconds[at(request.manner)] == 0;
    const float later = std::max(request.glide, waits ? k_after_posture * std::max(request.glide, posture) : 0);
    const float most = stop ? k_most_braking : slows ? k_most_slowing : k_most_acceleration;
    float in = seconds_for(state.speed, speed, most, slows ? request.glide : later);
    if (stop && state.speed.target != 0) in = seconds_to_stop(rig, state, in);
    const bool turn_waits = !straightens || (!slows && rises);
    aim(state.speed, speed, in);
    aim(state.turn, turn, seconds_for(state.turn, turn, k_most_turn_acceleration, turn_waits ? later : request.glide));
}

void hear(const LiveRig& rig, LiveState& state, const LiveRequest& request) noexcept {
    const bool stop = asks_for_nothing(request);
    const float speed = stop ? 0 : request.speed, turn = stop ? 0 : request.turn;
    if (state.rests != 0 && !stop) set_off(rig, state, request);
    const float seconds = std::max(request.glide, posture_seconds(rig, state, request));
    aim_travel(rig, state, request, stop);
    aim(state.posture_speed, speed, std::max(state.speed.left(), k_least_change));
    aim(state.posture_turn, turn, std::max(state.turn.left(), k_least_change));
    aim(state.standing, stop ? 1.0f : 0.0f, stop ? std::max(seconds, state.speed.left()) : seconds);
    for (std::size_t m = 0; m < rig.manners.size(); ++m)
        aim(state.weight[m], static_cast<int>(m) == request.manner ? 1.0f : 0.0f, seconds);
}

/// A foot that has long been going like this.
LiveFoot steady_foot(const LiveRig& rig, const LiveState& state, const Mixture& now, std::size_t side) noexcept {
    LiveFoot foot;
    const float share = own_share(now, state.limbs, side);
    const GaitRhythm& rhythm = now.rhythm;
    const FootStep one = step_of(rhythm, side);
    const float elapsed = since_strike(rhythm, side, share);
    const RootFrame since = integrate(rhythm.velocity, rhythm.turn_rate, elapsed - 0.5f * one.stance);
    foot.plant = between(since, stance_place(rig, now, side));
    foot.swings = share >= rhythm.lift[side];
    foot.lift = rhythm.lift[side];
    if (foot.swings) foot.coming = between(foot.plant, travel(rig, state, one.duration - elapsed + 0.5f * one.stance));
    return foot;
}

}  // namespace

LiveState start(const LiveRig& rig, const LiveRequest& asked, float phase) noexcept {
    const LiveRequest request = bounded(rig, asked);
    LiveState state;
    const bool stands = asks_for_nothing(request);
    state.speed = at_rest(stands ? 0 : request.speed);
    state.turn = at_rest(stands ? 0 : request.turn);
    state.posture_speed = state.speed;
    state.posture_turn = state.turn;
    state.standing = at_rest(stands ? 1 : 0);
    for (std::size_t m = 0; m < rig.manners.size(); ++m)
        state.weight[m] = at_rest(static_cast<int>(m) == request.manner ? 1 : 0);
    state.rests = stands ? 1 : 0;
    const Mixture now = mixture_of(rig, state);
    state.limbs = in_step(now.order.offset, time_share(now.rhythm, phase));
    for (std::size_t side = 0; side < 2; ++side) {
        state.feet[side] = stands ? LiveFoot{rig.stand_place[side], {}, {}, now.rhythm.lift[side], 1, false}
                                  : steady_foot(rig, state, now, side);
    }
    return state;
}

RootFrame travel(const LiveRig& rig, const LiveState& state, float seconds) noexcept {
    Vec3 direction;
    float sum = 0;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        const float weight = std::max(0.0f, state.weight[m].value());
        if (weight == 0) continue;
        sum += weight;
        direction += weight * rig.direction[m];
    }
    direction = direction / sum;
    if (state.speed.arrived() && state.turn.arrived())
        return integrate(direction * state.speed.target, state.turn.target * k_radians_per_degree, seconds);
    constexpr float k_part = 1.0f / 20;  // [s]
    const int parts = std::clamp(static_cast<int>(std::ceil(seconds / k_part)), 1, 64);
    const float part = seconds / static_cast<float>(parts);
    RootFrame root;
    for (int i = 0; i < parts; ++i) {
        const float middle = (static_cast<float>(i) + 0.5f) * part;
        root = root *
               integrate(direction * state.speed.value(middle), state.turn.value(middle) * k_radians_per_degree, part);
    }
    return root;
}

LiveFrame update(const LiveRig& rig, LiveState& state, const LiveRequest& request, float dt) noexcept {
    hear(rig, state, bounded(rig, request));
    LiveFrame frame;
    Mixture now = mixture_of(rig, state);
    const int parts = std::clamp(static_cast<int>(std::ceil(dt / k_longest_step)), 1, 600);
    for (int i = 0; i < parts; ++i) step(rig, state, dt / static_cast<float>(parts), now, frame.root_delta);
    frame.velocity = now.rhythm.velocity;
    frame.turn = now.turn;
    frame.frequency = state.rests != 0 ? 0 : now.rhythm.frequency;
    frame.planted = {!state.feet[0].swings, !state.feet[1].swings};
    frame.rests = state.rests != 0 && state.speed.arrived() && state.turn.arrived() && state.standing.arrived();
    return frame;
}

}  // namespace surefoot
