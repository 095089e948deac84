#pragma once
// The kernels' one text, instantiated for each instruction set and for the scalar twin (kernels_*.cpp).

#include <surefoot/graph/kernels.h>
#include <surefoot/graph/sole_lanes.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

// --- keys

template <class T>
struct KeyLanes {
    Quat8<T> print;
    Vec8<T> place;
    Quat8<T> toes;
    Float8<T> age;
};

/// Twelve floats a lane.
template <class T>
SUREFOOT_INLINE KeyLanes<T> load_keys(const float* const (&keys)[k_foot_lanes]) noexcept {
    Float8<T> first[8], last[8];
    for (int lane = 0; lane < 8; ++lane) {
        first[lane] = Float8<T>::load(keys[lane]);
        last[lane] = Float8<T>::load(keys[lane] + 4);
    }
    transpose(first);
    transpose(last);
    return {{first[0], first[1], first[2], first[3]},
            {last[0], last[1], last[2]},
            {last[3], last[4], last[5], last[6]},
            last[7]};
}

template <class T>
SUREFOOT_INLINE Quat8<T> nlerp(const Quat8<T>& a, const Quat8<T>& to, Float8<T> t) noexcept {
    const Quat8<T> b = lanes::aligned(to, a);
    return lanes::normalized(
        Quat8<T>{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t});
}

template <class T>
SUREFOOT_INLINE KeyLanes<T> keys_of(const FootLeafLanes& leaf) noexcept {
    const KeyLanes<T> a = load_keys<T>(leaf.from), b = load_keys<T>(leaf.to);
    const Float8<T> share = Float8<T>::load(leaf.share);
    return {nlerp(a.print, b.print, share), lanes::lerp(a.place, b.place, share), nlerp(a.toes, b.toes, share),
            a.age + (b.age - a.age) * share};
}

template <class T>
SUREFOOT_INLINE void add_rotation(Quat8<T>& sum, const Quat8<T>& leaf, Float8<T> weight) noexcept {
    const Quat8<T> q = lanes::aligned(leaf, sum);
    sum = {sum.x + weight * q.x, sum.y + weight * q.y, sum.z + weight * q.z, sum.w + weight * q.w};
}

// --- soles

/// The sole's two places as the leaves have them. Clips that stand (idles) keep a stepping foot where it is, but must
/// not keep it on the ground: a foot that is on its way has to leave it, or it shuffles.
template <class T>
class SoleMean {
    using F = Float8<T>;

  public:
    SUREFOOT_INLINE void add(const Vec8<T>& heel, const Vec8<T>& ball, F weight, F stepping) noexcept {
        heel_ = heel_ + heel * weight;
        ball_ = ball_ + ball * weight;
        stepping_ += stepping;
        heel_lift_ += heel.y * stepping;
        ball_lift_ += ball.y * stepping;
    }
    SUREFOOT_INLINE Vec8<T> heel() const noexcept { return lifted(heel_, heel_lift_); }
    SUREFOOT_INLINE Vec8<T> ball() const noexcept { return lifted(ball_, ball_lift_); }

  private:
    SUREFOOT_INLINE Vec8<T> lifted(const Vec8<T>& mean, F stepping_height) const noexcept {
        constexpr float k_half = 0.15f;  // weight of the stepping clips at which half their height is reached, about
        const Mask8<T> mixed = (stepping_ > F::splat(0)) & (stepping_ < F::splat(1));
        const F stepping = select(mixed, stepping_, F::splat(0.5f));
        const F share = stepping * (1 + k_half) / (stepping + k_half);
        const F standing_height = (mean.y - stepping_height) / (1.0f - stepping);
        const F height = share * (stepping_height / stepping) + (1.0f - share) * standing_height;
        return {mean.x, select(mixed, height, mean.y), mean.z};
    }
    const F zero_ = F::splat(0);
    Vec8<T> heel_{zero_, zero_, zero_}, ball_{zero_, zero_, zero_};
    F stepping_ = zero_, heel_lift_ = zero_, ball_lift_ = zero_;
};

// --- feet

template <class T>
void mean_feet(const FootLeafLanes* leaves, int count, FootLanes& feet) {
    using F = Float8<T>;
    using V = Vec8<T>;
    using Q = Quat8<T>;
    const F zero = F::splat(0);
    const V heel = load_vec<T>(feet.heel), ball = load_vec<T>(feet.ball);
    Q print{zero, zero, zero, zero}, toes = print;
    F age = zero;
    SoleMean<T> sole;
    for (int i = 0; i < count; ++i) {
        const FootLeafLanes& leaf = leaves[i];
        const KeyLanes<T> key = keys_of<T>(leaf);
        const F weight = F::load(leaf.weight);
        sole.add(key.place + rotate(key.print, heel), key.place + rotate(key.print, ball), weight,
                 F::load(leaf.stepping));
        add_rotation(print, key.print, weight);
        add_rotation(toes, key.toes, weight);
        age += key.age * F::load(leaf.say);
    }
    print = lanes::normalized(print);
    const V place = stand_on(print, heel, ball, sole.heel(), sole.ball());

    // The root has moved on since mid-stance, steadily: by (sin a / a) along and (1 - cos a) / a across its velocity.
    const F seconds = age / F::load(feet.pace) - F::load(feet.ahead), angle = F::load(feet.turn) * seconds;
    F s, c;
    sincos(0.5f * angle, s, c);
    const F sine = 2.0f * s * c, less_cosine = 2.0f * s * s, cosine = 1.0f - less_cosine;
    const Mask8<T> turns = abs(angle) > F::splat(1e-6f);
    const F over = select(turns, angle, F::splat(1));
    const F along = seconds * select(turns, sine / over, F::splat(1)),
            across = seconds * select(turns, less_cosine / over, 0.5f * angle);
    const V velocity = load_vec<T>(feet.velocity);
    const V off = place - V{velocity.x * along + velocity.z * across, seconds * velocity.y,
                            velocity.z * along - velocity.x * across};
    store<T>(V{off.x * cosine - off.z * sine, off.y, off.z * cosine + off.x * sine}, feet.foot + 4);
    store<T>(
        Q{c * print.x - s * print.z, c * print.y - s * print.w, c * print.z + s * print.x, c * print.w + s * print.y},
        feet.foot);
    store<T>(lanes::normalized(toes), feet.toes);
}

// --- legs

/// A joint's local transform in each lane, as rows of seven floats and one that means nothing.
template <class T>
SUREFOOT_INLINE void load_joint(const LegChains& chains, int place, const float* const* locals, int joints,
                                Float8<T> (&rows)[8]) noexcept {
    alignas(32) static constexpr float none[8] = {0, 0, 0, 1, 0, 0, 0, 0};
    for (int lane = 0; lane < 8; ++lane) {
        const int joint = chains.joint[lane % 2][place];
        const float* from = joint < 0 ? none : locals[lane] + joint * 7;
        if (joint + 1 < joints) {
            rows[lane] = Float8<T>::load(from);
        } else {  // the last joint has no eighth float behind it
            float last[8] = {};
            std::memcpy(last, from, 7 * sizeof(float));
            rows[lane] = Float8<T>::load(last);
        }
    }
    transpose(rows);
}

template <class T>
void run_forward(const LegChains& chains, const float* const* locals, int joints, float* models) {
    using F = Float8<T>;
    Quat8<T> q;
    Vec8<T> p;
    for (int place = 0; place < chains.count; ++place) {
        F rows[8];
        load_joint<T>(chains, place, locals, joints, rows);
        const Quat8<T> own{rows[0], rows[1], rows[2], rows[3]};
        const Vec8<T> at{rows[4], rows[5], rows[6]};
        p = place == 0 ? at : p + rotate(q, at);
        q = place == 0 ? own : multiply(q, own);
        auto* to = reinterpret_cast<float(*)[8]>(models + place * k_model_floats);
        store<T>(q, to);
        store<T>(p, to + 4);
    }
}

template <class T>
SUREFOOT_INLINE Quat8<T> model_rotation(const float* models, int place) noexcept {
    if (place < 0) return Quat8<T>::splat({0, 0, 0, 1});
    return load_quat<T>(reinterpret_cast<const float(*)[8]>(models + place * k_model_floats));
}
template <class T>
SUREFOOT_INLINE Vec8<T> model_place(const float* models, int place) noexcept {
    return load_vec<T>(reinterpret_cast<const float(*)[8]>(models + place * k_model_floats) + 4);
}

template <class T>
void sink(const LegChains& chains, const float* models, const LegGoalLanes& goals, float share, float* sinks) {
    using F = Float8<T>;
    const Vec8<T> hip = model_place<T>(models, chains.upper), knee = model_place<T>(models, chains.lower);
    const Vec8<T> foot = model_place<T>(models, chains.count - 1), goal = load_vec<T>(goals.foot + 4);
    const F length = share * (lanes::length(hip - knee) + lanes::length(knee - foot)), zero = F::splat(0);
    const F level = lanes::planar_length(goal - hip), square = length * length - level * level;
    const F lacking = hip.y - goal.y - sqrt(max(square, zero));
    select(square > zero, max(zero, lacking), zero).store(sinks);
}

template <class T>
SUREFOOT_INLINE void write_rotations(const Quat8<T>& q, const std::int16_t (&joint)[2], float* const* locals) noexcept {
    const Float8<T> quads[4] = {q.x, q.y, q.z, q.w};
    store_quads(quads, [&](int lane) noexcept { return locals[lane] + joint[lane % 2] * 7; });
}

template <class T>
void reach(const LegChains& chains, const float* models, const LegGoalLanes& goals, float* const* locals) {
    using Q = Quat8<T>;
    const int upper = chains.upper, lower = chains.lower, foot = chains.count - 1;
    float bends[3][8];
    for (int k = 0; k < 3; ++k)
        for (int lane = 0; lane < 8; ++lane) bends[k][lane] = chains.knee_forward[k][lane % 2];
    const Q thigh = model_rotation<T>(models, upper), calf = model_rotation<T>(models, lower);
    const TwoBoneLanesResult<T> solved = solve_two_bone(TwoBoneLanes<T>{
        model_place<T>(models, upper), model_place<T>(models, lower), model_place<T>(models, foot),
        load_vec<T>(goals.foot + 4), rotate(thigh, load_vec<T>(bends)), Float8<T>::splat(k_soft_extension)});
    const auto seen_from = [](const Q& parent, const Q& q) noexcept {
        return lanes::normalized(multiply(conjugate(parent), q));
    };
    const Q new_thigh = seen_from(model_rotation<T>(models, upper - 1), multiply(solved.upper, thigh));
    const Q new_calf =
        seen_from(multiply(solved.upper, model_rotation<T>(models, lower - 1)), multiply(solved.lower, calf));
    const Q new_foot = seen_from(multiply(solved.lower, model_rotation<T>(models, foot - 1)), load_quat<T>(goals.foot));
    const auto joint_at = [&](int place, std::int16_t(&joint)[2]) noexcept {
        for (int side = 0; side < 2; ++side) joint[side] = chains.joint[side][place];
    };
    std::int16_t joint[2];
    joint_at(upper, joint);
    write_rotations<T>(new_thigh, joint, locals);
    joint_at(lower, joint);
    write_rotations<T>(new_calf, joint, locals);
    joint_at(foot, joint);
    write_rotations<T>(new_foot, joint, locals);
    for (int lane = 0; lane < 8; ++lane)
        if (const int toes = chains.toes[lane % 2]; toes >= 0)
            for (int k = 0; k < 4; ++k) locals[lane][toes * 7 + k] = goals.toes[k][lane];
}

template <class T>
constexpr FootKernels kernels_named(const char* name) {
    return {name, mean_feet<T>, run_forward<T>, sink<T>, reach<T>};
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
