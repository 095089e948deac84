// The solver's one text, instantiated for the machine's vectors and for the scalar twin.
//
// Space: the character's own, its root on the ground at the origin. A *turn* is how a joint has rotated against the
// stance, in that space: model rotation = turn * rotation in the stance. A joint that is not moved has its base's turn.

#include <surefoot/body/body.h>
#include <surefoot/math/lanes_rigid.h>

namespace surefoot {

namespace {

constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr float k_pelvis_share = 0.3f;       // of the spine's lean that the pelvis makes
constexpr float k_girdle_above = -0.3f;      // sine of an arm's elevation from which its girdle goes along
constexpr float k_sink_smoothing = 0.01f;    // [m] for an adult: how softly the hips begin to sink
constexpr float k_lowest_hip = 0.3f;         // share of a leg's length to which hips sink for a foot at most
constexpr float k_airborne = 0.12f;          // [m] for an adult: lift from which a foot no longer pulls at the hips
constexpr float k_airborne_stretch = 0.95f;  // share of its length from which a leg in the air resists stretching
constexpr float k_hand_out = 0.06f;          // share of an arm's length that hanging hands are outside their shoulders
constexpr float k_elbow_out = 0.45f;         // [rad] elbows of hanging arms point backward and this much outward

template <class T>
SUREFOOT_INLINE Vec8<T> normalized(const Vec8<T>& v) noexcept {
    return v * rsqrt(max(dot(v, v), Float8<T>::splat(1e-20f)));
}
template <class T>
SUREFOOT_INLINE Quat8<T> normalized(const Quat8<T>& q) noexcept {
    const Float8<T> s = rsqrt(max(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, Float8<T>::splat(1e-20f)));
    return {q.x * s, q.y * s, q.z * s, q.w * s};
}
template <class T>
SUREFOOT_INLINE Vec8<T> select(Mask8<T> m, const Vec8<T>& a, const Vec8<T>& b) noexcept {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
/// Least rotation from the unit vector a to b; half a turn about `aside` (unit, perpendicular to a) where they oppose.
template <class T>
SUREFOOT_INLINE Quat8<T> between(const Vec8<T>& a, const Vec8<T>& b, const Vec8<T>& aside) noexcept {
    const Vec8<T> n = cross(a, b);
    const Float8<T> w = 1.0f + dot(a, b), zero = Float8<T>::splat(0);
    const Mask8<T> opposed = w < Float8<T>::splat(1e-5f);
    return normalized(Quat8<T>{select(opposed, aside.x, n.x), select(opposed, aside.y, n.y),
                               select(opposed, aside.z, n.z), select(opposed, zero, w)});
}
template <class T>
SUREFOOT_INLINE Quat8<T> turn_about(const Vec8<T>& unit, Float8<T> angle) noexcept {
    Float8<T> s, c;
    sincos(0.5f * angle, s, c);
    return {unit.x * s, unit.y * s, unit.z * s, c};
}
/// Yaw about Y after roll about Z after pitch about X.
template <class T>
SUREFOOT_INLINE Quat8<T> yaw_roll_pitch(Float8<T> yaw, Float8<T> roll, Float8<T> pitch) noexcept {
    Float8<T> sy, cy, sz, cz, sx, cx;
    sincos(0.5f * yaw, sy, cy);
    sincos(0.5f * roll, sz, cz);
    sincos(0.5f * pitch, sx, cx);
    const Quat8<T> q{sy * sz, sy * cz, cy * sz, cy * cz};
    return {q.w * sx + q.x * cx, q.y * cx + q.z * sx, q.z * cx - q.y * sx, q.w * cx - q.x * sx};
}
/// max(0, a, b), smooth over some `width`.
template <class T>
SUREFOOT_INLINE Float8<T> smooth_excess(Float8<T> a, Float8<T> b, float width) noexcept {
    const auto smooth_max = [&](Float8<T> x, Float8<T> y) {
        const Float8<T> d = x - y;
        return 0.5f * ((x + y) + sqrt(d * d + width * width));
    };
    return smooth_max(smooth_max(a, b), Float8<T>::splat(0));
}

/// 0 up to 0, 1 from 1, smooth between.
template <class T>
SUREFOOT_INLINE Float8<T> smooth(Float8<T> x) noexcept {
    const Float8<T> share = clamp(x, 0.0f, 1.0f);
    return share * share * (3.0f - 2.0f * share);
}

/// A limb's solution: the directions of its bones, and of their fronts.
template <class T>
struct Bent {
    Vec8<T> upper, lower, upper_front, lower_front;
};

/// `soft` [m]: from where stretching is resisted. `bend`: unit, the direction in which the hinge points for a limb that
/// hangs straight down; carried along with it. `front` is 1 where a limb's front faces as its hinge does (knees), -1
/// where the other way (elbows).
template <class T>
SUREFOOT_INLINE Bent<T> bend_limb(const BodyLimb& limb, Float8<T> soft, const Vec8<T>& to_end, const Vec8<T>& bend,
                                  float front) noexcept {
    using F = Float8<T>;
    const F wanted = sqrt(dot(to_end, to_end)), one = F::splat(1);
    // As far as the soft limit as asked; beyond, ever slower towards the farthest (smooth in value and slope).
    const F room = limb.farthest - soft;
    const F over = max(wanted - soft, F::splat(0)) / room;
    const F reach = max(min(wanted, soft) + room * (over / (1.0f + over)), F::splat(limb.nearest));

    const Vec8<T> down = Vec8<T>::splat({0, -1, 0});
    const Mask8<T> there = wanted > F::splat(1e-6f);
    const Vec8<T> along = select(there, to_end * (1.0f / select(there, wanted, one)), down);
    const Vec8<T> out = rotate(between(down, along, Vec8<T>::splat({1, 0, 0})), bend);

    const float a = limb.upper_length, b = limb.lower_length;
    const F square = reach * reach;
    const F at_root = clamp((square + (a * a - b * b)) / (reach * (2 * a)), -1.0f, 1.0f);
    const F at_end = clamp((square + (b * b - a * a)) / (reach * (2 * b)), -1.0f, 1.0f);
    const F root_sine = sqrt(max(1.0f - at_root * at_root, F::splat(0)));
    const F end_sine = sqrt(max(1.0f - at_end * at_end, F::splat(0)));
    return {along * at_root + out * root_sine, along * at_end - out * end_sine,
            (out * at_root - along * root_sine) * F::splat(front), (out * at_end + along * end_sine) * F::splat(front)};
}

/// The turn that takes a bone of the stance to a direction with its front that way; both unit and perpendicular.
template <class T>
SUREFOOT_INLINE Quat8<T> align(const BodyBone& bone, const Vec8<T>& along, const Vec8<T>& front) noexcept {
    const Vec8<T> own = Vec8<T>::splat(bone.front);
    const Quat8<T> swing = between(Vec8<T>::splat(bone.along), along, own);
    const Vec8<T> carried = rotate(swing, own);
    // Half a turn about the bone itself where the fronts oppose.
    return normalized(multiply(between(carried, front, along), swing));
}

/// A foot on its way: where its ankle goes, and how foot and toes turn.
template <class T>
struct Step {
    Vec8<T> ankle;
    Quat8<T> foot, toes;
    Float8<T> heading;
    Float8<T> lift, air;  // of the sole over the lowest that it may be [m]; 0 on the ground to 1 well above it
};

template <class T>
class Solver {
    using F = Float8<T>;
    using V = Vec8<T>;
    using Q = Quat8<T>;

  public:
    Solver(const Body& body, const float* channels) : body_(body), channels_(channels) {}

    SUREFOOT_INLINE void run(float* pose) noexcept {
        pelvis();
        for (const Side side : {Side::left, Side::right}) place_foot(side);
        sink();
        trunk();
        for (const Side side : {Side::left, Side::right}) {
            leg(side);
            arm(side);
        }
        write(pose);
    }

  private:
    F channel(BodyChannel c) const noexcept { return F::load(channels_ + 8 * static_cast<std::size_t>(c)); }
    F channel(BodyChannel c, Side side) const noexcept { return F::load(channels_ + 8 * at(of_side(c, side))); }
    /// Half the sum and half the difference (left less right) of a channel's two sides.
    F mean(BodyChannel c) const noexcept { return 0.5f * (channel(c, Side::left) + channel(c, Side::right)); }
    F lead(BodyChannel c) const noexcept { return channel(c, Side::left) - channel(c, Side::right); }

    const BodyJoint& joint(int i) const noexcept { return body_.joints[at(i)]; }
    /// Where a joint is, its base being placed and turned.
    V carried(int i) const noexcept {
        const BodyJoint& j = joint(i);
        const BodyJoint& base = joint(j.base);
        return place_[j.base] + rotate(turn_[j.base], V::splat(j.place - base.place));
    }

    void pelvis() noexcept {
        const F one = F::splat(1);
        // The spine's line first, for the pelvis leans with it.
        const Vec3 line = body_.spine_line;
        const F up = line.y + channel(BodyChannel::chest_y), ahead = line.z + channel(BodyChannel::chest_z);
        lean_ = atan2(ahead, up) - atan2(F::splat(line.z), F::splat(line.y));
        side_lean_ = atan2(channel(BodyChannel::chest_x), F::splat(length(line)));
        // An arc of angle h is shorter than its length by h^2 / 24: what the line lacks, the spine makes up by
        // hunching.
        const F share = min(sqrt(up * up + ahead * ahead) / length(line), one);
        constexpr float k_soft = 0.15f;  // [rad] so that a spine as long as its line does not jerk
        const F hunch = sqrt(24.0f * (1.0f - share) + k_soft * k_soft) - k_soft;
        const F most = F::splat(body_.most_hunch + 1e-3f);
        hunch_ = hunch / sqrt(1.0f + (hunch / most) * (hunch / most));

        const float wide = body_.hip_width;
        const F yaw = atan2(-lead(BodyChannel::hip_z), F::splat(wide)) + channel(BodyChannel::hips_ry);
        const F roll = atan2(lead(BodyChannel::hip_y), F::splat(wide)) + channel(BodyChannel::hips_rz);
        const F pitch = k_pelvis_share * (lean_ - 0.5f * hunch_) + channel(BodyChannel::hips_rx);
        pelvis_yaw_ = yaw, pelvis_roll_ = roll, pelvis_pitch_ = pitch;
        turn_[0] = yaw_roll_pitch(yaw, roll, pitch);
        const Vec3 left = joint(body_.leg[0].upper).place, right = joint(body_.leg[1].upper).place;
        const Vec3 middle = lerp(left, right, 0.5f);
        const V hips{middle.x + channel(BodyChannel::hips_x), middle.y + mean(BodyChannel::hip_y),
                     middle.z + mean(BodyChannel::hip_z)};
        place_[0] = hips + rotate(turn_[0], V::splat(joint(0).place - middle));
    }

    /// The foot lies on the ground under its place, rolled over heel or ball; toes stay on the ground as long as they
    /// can.
    void place_foot(Side side) noexcept {
        const BodyFoot& foot = body_.foot[static_cast<std::size_t>(side)];
        Step<T>& step = step_[static_cast<std::size_t>(side)];
        const F zero = F::splat(0);
        const F slope = channel(BodyChannel::ground_slope);
        F slope_sine, slope_cosine;
        sincos(slope, slope_sine, slope_cosine);
        const Vec3 ankle = joint(body_.leg[static_cast<std::size_t>(side)].end).place;
        const F floor = channel(BodyChannel::foot_floor, side);
        const F lift = max(channel(BodyChannel::foot_y, side), floor);
        step.lift = lift - floor;
        const F turned = channel(BodyChannel::foot_turned, side);
        const F aside = ankle.x + channel(BodyChannel::foot_x, side),
                ahead = ankle.z + channel(BodyChannel::foot_z, side);
        F sine, cosine;
        sincos(turned, sine, cosine);
        const F x = aside * cosine + ahead * sine, z = ahead * cosine - aside * sine;
        step.heading = turned + channel(BodyChannel::foot_ry, side);

        const V across = V::splat(foot.across);
        const Q tilt = turn_about(V::splat({1, 0, 0}), -slope);
        const Q flat = multiply(tilt, yaw_roll_pitch(step.heading, channel(BodyChannel::foot_rz, side), zero));
        const F pitch = clamp(channel(BodyChannel::foot_rx, side), -1.2f, 1.4f);
        step.foot = multiply(flat, turn_about(across, pitch));
        // Toes hang the more the higher the foot is, and always less than their tip has room for.
        const F hang = smooth(step.lift / (2.5f * foot.toe_length));
        const F on_ground = min(pitch, pitch * hang);
        const F raised =
            atan2(channel(BodyChannel::toe_y, side), F::splat(foot.toe_length)) - channel(BodyChannel::toe_rx, side);
        const F bend = min(max(pitch - on_ground + raised, F::splat(-foot.toes_down)), F::splat(foot.toes_up));
        step.toes = multiply(flat, turn_about(across, pitch - bend));

        // The ground under the ankle of the flat foot, then what rolling does to it.
        const V ground{x, lift + z * (slope_sine / max(slope_cosine, F::splat(0.1f))), z};
        const Mask8<T> heel_up = pitch > zero;
        const V pivot = select(heel_up, V::splat(foot.ball), V::splat(foot.heel));
        step.ankle =
            ground + rotate(tilt, V::splat({0, foot.height, 0})) + rotate(flat, pivot) - rotate(step.foot, pivot);
        // A foot that is tilted sideways, or whose toes bend down, must not dip into the ground.
        const V normal{zero, slope_cosine, -slope_sine};
        const V tip = rotate(step.foot, V::splat(foot.ball)) + rotate(step.toes, V::splat(foot.tip - foot.ball));
        const F lowest = min(min(dot(rotate(step.foot, V::splat(foot.heel)), normal),
                                 dot(rotate(step.foot, V::splat(foot.ball)), normal)),
                             dot(tip, normal));
        const F dip = floor * slope_cosine - (dot(step.ankle, normal) + lowest);
        step.ankle = step.ankle + normal * max(dip, zero);
    }

    /// Lowers the hips where a leg is too short for its foot, and raises them where it could not fold over a foot on
    /// the ground. (A foot in the air that is too near is pushed away instead.)
    void sink() noexcept {
        F drop[2], rise[2];
        for (const std::size_t s : {0u, 1u}) {
            const BodyLimb& limb = body_.leg[s];
            const V hip = carried(limb.upper);
            const V to = step_[s].ankle - hip;
            const float low = k_lowest_hip * limb.soft;
            const F down = sqrt(max(limb.soft * limb.soft - (to.x * to.x + to.z * to.z), F::splat(low * low)));
            // Hips wait for no foot that is well in the air: that one comes as far as it can.
            step_[s].air = smooth(step_[s].lift / (k_airborne * body_.scale.leg));
            const F lacks = -to.y - down;
            drop[s] = lacks - step_[s].air * max(lacks, F::splat(0));
            rise[s] = limb.nearest + to.y - step_[s].lift;
        }
        const float width = k_sink_smoothing * body_.scale.leg;
        const F sunk = smooth_excess(drop[0], drop[1], width);
        place_[0].y = place_[0].y - sunk + smooth_excess(rise[0] + sunk, rise[1] + sunk, width);
    }

    void trunk() noexcept {
        // The chest's heading and tilt are those of the shoulders, as far as they are told; its pitch is the arc's end.
        const float wide = body_.shoulder_width;
        const F yaw = atan2(-lead(BodyChannel::shoulder_z), F::splat(wide)) + channel(BodyChannel::chest_ry);
        const F roll =
            atan2(lead(BodyChannel::shoulder_y), F::splat(wide)) + channel(BodyChannel::chest_rz) - side_lean_;
        const F bend = channel(BodyChannel::chest_rx);
        F pitch = pelvis_pitch_;
        for (int i = 0; i < body_.spine; ++i) {
            const float middle = (static_cast<float>(i) + 0.5f) / static_cast<float>(body_.spine);
            const float share = static_cast<float>(i + 1) / static_cast<float>(body_.spine);
            pitch = lean_ + hunch_ * (middle - 0.5f) + share * bend;
            turn(body_.first_spine + i, pelvis_yaw_ + share * (yaw - pelvis_yaw_),
                 pelvis_roll_ + share * (roll - pelvis_roll_), pitch);
        }
        const float most = body_.most_nod;
        const F nod = min(max(channel(BodyChannel::head_rx) - pitch, F::splat(-most)), F::splat(most));
        const F look = channel(BodyChannel::head_ry), tilt = channel(BodyChannel::head_rz);
        for (int i = 0; i < body_.neck; ++i) {
            const float share = static_cast<float>(i + 1) / static_cast<float>(body_.neck);
            turn(body_.first_neck + i, yaw + share * (look - yaw), roll + share * (tilt - roll), pitch + share * nod);
        }
    }
    void turn(int i, F yaw, F roll, F pitch) noexcept {
        turn_[i] = yaw_roll_pitch(yaw, roll, pitch);
        place_[i] = carried(i);
    }

    void leg(Side side) noexcept {
        const std::size_t s = static_cast<std::size_t>(side);
        const BodyLimb& limb = body_.leg[s];
        const F outward = F::splat(side == Side::left ? 1.0f : -1.0f);
        const F heading = 0.5f * (pelvis_yaw_ + step_[s].heading) + channel(BodyChannel::knee_out, side) * outward;
        F sine, cosine;
        sincos(heading, sine, cosine);
        // A leg in the air need not hold a foot in its place and keeps off full stretch.
        const F soft = limb.soft - step_[s].air * ((limb.soft - k_airborne_stretch * limb.farthest));
        const Bent<T> bent =
            bend_limb(limb, soft, step_[s].ankle - carried(limb.upper), V{sine, F::splat(0), cosine}, 1);
        turn_[limb.upper] = align(limb.upper_bone, bent.upper, bent.upper_front);
        turn_[limb.lower] = align(limb.lower_bone, bent.lower, bent.lower_front);
        turn_[limb.end] = step_[s].foot;
        if (const int toes = body_.foot[s].toes; toes >= 0) turn_[toes] = step_[s].toes;
    }

    void arm(Side side) noexcept {
        const std::size_t s = static_cast<std::size_t>(side);
        const BodyLimb& limb = body_.arm[s];
        const float left = side == Side::left ? 1.0f : -1.0f;
        const int chest = body_.chest, girdle = body_.girdle[s];
        constexpr float k_hanging = k_gait_shoulder_height - k_gait_wrist_height;
        const V offset{channel(BodyChannel::hand_x, side) + left * k_hand_out * limb.farthest,
                       channel(BodyChannel::hand_y, side) - body_.scale.arm * k_hanging,
                       channel(BodyChannel::hand_z, side)};
        const F hold = channel(BodyChannel::hand_hold, side);
        if (girdle >= 0) {
            const V start = limb.upper >= 0 ? joint_place(limb.upper, chest) : joint_place(girdle, chest);
            const V held = limb.upper >= 0 ? V::splat(joint(limb.upper).place) + offset - start : offset;
            const F height = mixed(offset.y, held.y, hold) / (limb.upper >= 0 ? limb.farthest : 1.0f);
            const F raise = clamp((height - k_girdle_above) / (1.0f - k_girdle_above), 0.0f, 1.0f);
            const float wide = body_.girdle_length;
            const F lift = atan2(mean(BodyChannel::shoulder_y), F::splat(wide)) + raise * raise * body_.girdle_lift;
            const F forward = atan2(mean(BodyChannel::shoulder_z), F::splat(wide));
            turn_[girdle] = multiply(turn_[chest], yaw_roll_pitch(-left * forward, left * lift, F::splat(0)));
            place_[girdle] = carried(girdle);
        }
        if (limb.upper < 0) return;
        const V shoulder = carried(limb.upper);
        const V held = V::splat(joint(limb.upper).place) + offset - shoulder;
        const V to{mixed(offset.x, held.x, hold), mixed(offset.y, held.y, hold), mixed(offset.z, held.z, hold)};
        F sine, cosine;
        sincos(k_elbow_out + channel(BodyChannel::elbow_out, side), sine, cosine);
        const Bent<T> bent = bend_limb(limb, F::splat(limb.soft), to, V{left * sine, F::splat(0), -cosine}, -1);
        turn_[limb.upper] = align(limb.upper_bone, bent.upper, bent.upper_front);
        turn_[limb.lower] = align(limb.lower_bone, bent.lower, bent.lower_front);
        const Q hanging = Q::splat(body_.hanging[s]);
        const Q hand = yaw_roll_pitch(channel(BodyChannel::hand_ry, side), channel(BodyChannel::hand_rz, side),
                                      channel(BodyChannel::hand_rx, side));
        turn_[limb.end] = multiply(turn_[limb.lower], multiply(conjugate(hanging), multiply(hand, hanging)));
    }
    V joint_place(int i, int base) const noexcept {
        return place_[base] + rotate(turn_[base], V::splat(joint(i).place - joint(base).place));
    }
    static F mixed(F a, F b, F share) noexcept { return a + (b - a) * share; }

    void write(float* pose) noexcept {
        for (int i = 0; i < body_.joint_count(); ++i, pose += 32) {
            const BodyJoint& j = joint(i);
            const Q own = multiply(turn_[i], Q::splat(j.stance));
            const Q relative = j.base < 0 ? own : multiply(conjugate(turn_[j.base]), own);
            const Q local = normalized(multiply(Q::splat(j.to_parent), relative));
            local.x.store(pose);
            local.y.store(pose + 8);
            local.z.store(pose + 16);
            local.w.store(pose + 24);
        }
        const Transform down = inverse(body_.above_hips);
        const V hips = rotate(Q::splat(down.rotation), place_[0]) + V::splat(down.translation);
        hips.x.store(pose);
        hips.y.store(pose + 8);
        hips.z.store(pose + 16);
    }

    const Body& body_;
    const float* channels_;
    Q turn_[k_most_body_joints];
    V place_[k_most_body_joints];
    Step<T> step_[2];
    F lean_, side_lean_, hunch_, pelvis_yaw_, pelvis_roll_, pelvis_pitch_;
};

}  // namespace

void solve(const Body& body, std::span<const float> channels, std::span<float> pose) noexcept {
    Solver<Vector>(body, channels.data()).run(pose.data());
}

void solve_scalar(const Body& body, std::span<const float> channels, std::span<float> pose) noexcept {
    Solver<Scalar>(body, channels.data()).run(pose.data());
}

}  // namespace surefoot
