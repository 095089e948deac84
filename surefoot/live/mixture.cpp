#include <surefoot/live/mixture.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// The rhythm at a speed and turn; the gait of one clip is played slower or faster.
GaitRhythm rhythm_of_manner(const HarmonicGait& gait, float speed, float turn) noexcept {
    GaitRhythm rhythm = rhythm_at(gait, speed, turn);
    if (gait.family()) return rhythm;
    constexpr float k_on_the_spot = 0.1f, k_slowest = 0.6f, k_fastest = 1.6f;  // [m/s], times
    const float own = planar_length(rhythm.velocity);
    if (own > k_on_the_spot) rhythm.frequency *= std::clamp(speed / own, k_slowest, k_fastest);
    return rhythm;
}

FootfallPattern order_of(const LiveManner& manner, const GaitRhythm& rhythm) noexcept {
    FootfallPattern order;
    if (manner.pattern != nullptr)
        order = *manner.pattern;
    else
        order.offset = {0, rhythm.right_strike, rhythm.right_strike, 0, 0};
    for (std::size_t side = 0; side < 2; ++side)
        if (order.duty[side] == 0) order.duty[side] = rhythm.lift[side];
    return order;
}

void find_shares(const LiveRig& rig, const LiveState& state, float ahead, Mixture& mixture) noexcept {
    float sum = 0;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        const float weight = state.weight[m].value(ahead);
        if (weight >= k_least_share) sum += mixture.share[m] = weight;
    }
    for (float& share : mixture.share) share /= sum;
}

}  // namespace

Mixture mixture_of(const LiveRig& rig, const LiveState& state, float ahead) noexcept {
    Mixture mixture;
    mixture.speed = state.speed.value(ahead);
    mixture.turn = state.turn.value(ahead);
    mixture.posture_speed = state.posture_speed.value(ahead);
    mixture.posture_turn = state.posture_turn.value(ahead);
    mixture.standing = std::clamp(state.standing.value(ahead), 0.0f, 1.0f);
    find_shares(rig, state, ahead, mixture);
    GaitRhythm sum{{}, mixture.turn * k_radians_per_degree, 0, 0, {0, 0}};
    float done = 0;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        const float share = mixture.share[m];
        if (share == 0) continue;
        const LiveManner& manner = rig.manners[m];
        const GaitRhythm rhythm = rhythm_of_manner(*manner.gait, mixture.speed, mixture.turn);
        sum.frequency += share * rhythm.frequency;
        sum.right_strike += share * rhythm.right_strike;
        mixture.direction += share * rig.direction[m];
        const FootfallPattern order = order_of(manner, rhythm);
        done += share;
        mixture.order = share == done ? order : mix(mixture.order, order, share / done);
    }
    sum.velocity = mixture.direction * mixture.speed;
    sum.lift = mixture.order.duty;
    mixture.rhythm = sum;
    return mixture;
}

float series_phase(const Mixture& mixture, const Oscillators& limbs, Limb limb) noexcept {
    const auto i = static_cast<std::size_t>(limb);
    const bool with_right_strike = limb == Limb::right_leg || limb == Limb::left_arm;
    return phase_of(mixture.rhythm, limbs.phase[i] + (with_right_strike ? mixture.rhythm.right_strike : 0.0f));
}

float own_share(const Mixture& mixture, const Oscillators& limbs, std::size_t side) noexcept {
    return side == 0 ? wrap_phase(series_phase(mixture, limbs, Limb::left_leg))
                     : wrap_phase(series_phase(mixture, limbs, Limb::right_leg) - 0.5f);
}

RootFrame place_of(Vec3 heel, Vec3 ball) noexcept {
    const Vec3 middle = (heel + ball) * 0.5f, along = ball - heel;
    return {{middle.x, 0, middle.z}, atan2(along.x, along.z)};
}

RootFrame stance_place(const LiveRig& rig, const Mixture& mixture, std::size_t side) noexcept {
    Vec3 heel, ball;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        if (mixture.share[m] == 0) continue;
        const HarmonicGait& gait = *rig.manners[m].gait;
        const FootPrint print =
            foot_print_at(gait, mixture.posture_speed, mixture.posture_turn, side, 0.5f * gait.foot_lift);
        heel += mixture.share[m] * print.heel;
        ball += mixture.share[m] * print.ball;
    }
    return place_of(heel, ball);
}

float swing_share(const LiveFoot& foot, float share) noexcept {
    return std::clamp((share - foot.lift) / (1 - foot.lift), 0.0f, 1.0f);
}

float foot_phase(const LiveFoot& foot, const HarmonicGait& gait, float share, float lift) noexcept {
    if (!foot.swings) return std::min(share / lift_of(foot, lift), 1.0f) * gait.foot_lift;
    return gait.foot_lift + swing_share(foot, share) * (1 - gait.foot_lift);
}

}  // namespace surefoot
