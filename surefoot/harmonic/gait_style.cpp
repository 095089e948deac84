#include <surefoot/harmonic/gait_style.h>
#include <surefoot/harmonic/series.h>
#include <surefoot/ik/lean.h>
#include <surefoot/math/trig.h>
#include <surefoot/rig/roles.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot {
namespace {

using FootPart = GaitSeries::FootPart;

std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

BodyPart part_of(Role role) noexcept {
    switch (role) {
        case Role::hips:
            return BodyPart::pelvis;
        case Role::spine:
        case Role::chest:
        case Role::upper_chest:
            return BodyPart::spine;
        case Role::neck:
        case Role::head:
            return BodyPart::head;
        case Role::left_upper_leg:
        case Role::right_upper_leg:
            return BodyPart::legs;
        case Role::left_shoulder:
        case Role::right_shoulder:
        case Role::left_upper_arm:
        case Role::right_upper_arm:
            return BodyPart::arms;
        default:
            return BodyPart::count;
    }
}

/// How every joint of one part moves.
void move_joints(const HarmonicGait& gait, const StyleBody& body, const GaitStyle& style,
                 const GaitSeries& series) noexcept {
    for (int j = 0; j < static_cast<int>(gait.mean.size()); ++j) {
        const BodyPart part = body.part[at(j)];
        if (part == BodyPart::count || part == BodyPart::legs) continue;
        const PartStyle& s = style[part];
        for (int axis = 0; axis < 3; ++axis) {
            const std::span<float> rotation = series.rotation(j, axis);
            scale_waves(rotation, std::clamp(s.amplitude, 0.0f, 3.0f));
            delay(rotation, std::clamp(s.lag, -0.5f, 0.5f));
            sharpen(rotation, std::clamp(s.sharpness, 0.3f, 2.0f));
        }
    }
}

/// Turns a chain of joints by angles of the model [deg], shared out evenly.
template <std::size_t N>
void hold(const GaitSeries& series, const StyleBody& body, const std::array<int, N>& joints, Vec3 turn_deg) noexcept {
    const auto count = std::count_if(joints.begin(), joints.end(), [](int j) { return j != k_no_joint; });
    if (count == 0 || turn_deg == Vec3{}) return;
    const Vec3 each = turn_deg * (k_radians_per_degree / static_cast<float>(count));
    for (const int joint : joints)
        if (joint != k_no_joint) add_turn(series, joint, body.model[at(joint)], each);
}

Vec3 held(const PartStyle& s) noexcept {
    return {std::clamp(s.lean, -60.0f, 60.0f), std::clamp(s.turn, -45.0f, 45.0f), -std::clamp(s.side, -45.0f, 45.0f)};
}

void hold_arms(const GaitSeries& series, const StyleBody& body, const PartStyle& s) noexcept {
    const float forward = -std::clamp(s.lean, -60.0f, 60.0f), out = std::clamp(s.out, -45.0f, 60.0f);
    const float bend = -std::clamp(s.bend, -30.0f, 120.0f);
    for (std::size_t side = 0; side < 2; ++side) {
        const float sign = side == 0 ? 1.0f : -1.0f;
        hold(series, body, std::array{body.upper_arm[side]}, {forward, 0, sign * out});
        hold(series, body, std::array{body.lower_arm[side]}, {bend, 0, 0});
    }
}

/// The hips' own way through space: waves sideways and up and down, and how low they are.
void move_hips(const HarmonicGait& gait, const StyleBody& body, const GaitStyle& style,
               const GaitSeries& series) noexcept {
    const int hips = gait.soles.hips, moving = series.moving_index(hips), parent = gait.skeleton->parents[at(hips)];
    if (moving < 0) return;
    const Quat frame = parent == k_no_joint ? Quat{} : body.model[at(parent)];
    const PartStyle& pelvis = style[BodyPart::pelvis];
    const float sway = std::clamp(style.sway, 0.0f, 4.0f), bounce = std::clamp(style.bounce, 0.0f, 4.0f);
    const std::span<float> x = series.translation(moving, 0), y = series.translation(moving, 1),
                           z = series.translation(moving, 2);
    for (std::size_t i = 0; i < x.size(); ++i) {
        Vec3 own{x[i], y[i], z[i]};
        Vec3 model = rotate(frame, own);
        if (i > 0) model.x *= sway, model.y *= bounce;
        if (i == 0) model.y -= std::clamp(style.crouch, -0.05f, 0.4f);
        own = rotate(conjugate(frame), model);
        x[i] = own.x, y[i] = own.y, z[i] = own.z;
    }
    for (const std::span<float> axis : {x, y, z}) delay(axis, std::clamp(pelvis.lag, -0.5f, 0.5f));
}

/// Turns a foot about the vertical through its middle.
void turn_foot(const HarmonicGait& gait, const GaitSeries& series, std::size_t side, float angle) noexcept {
    const SinCos turn = sin_cos(static_cast<double>(angle));
    const auto c = static_cast<float>(turn.cos), s = static_cast<float>(turn.sin);
    const std::span<float> heel_x = series.foot(side, FootPart::heel, 0), heel_z = series.foot(side, FootPart::heel, 2);
    const std::span<float> ball_x = series.foot(side, FootPart::ball, 0), ball_z = series.foot(side, FootPart::ball, 2);
    for (std::size_t i = 0; i < heel_x.size(); ++i) {
        const float mx = 0.5f * (heel_x[i] + ball_x[i]), mz = 0.5f * (heel_z[i] + ball_z[i]);
        const float dx = 0.5f * (ball_x[i] - heel_x[i]), dz = 0.5f * (ball_z[i] - heel_z[i]);
        const float rx = c * dx + s * dz, rz = c * dz - s * dx;
        heel_x[i] = mx - rx, ball_x[i] = mx + rx;
        heel_z[i] = mz - rz, ball_z[i] = mz + rz;
    }
    add_foot_turn(gait, series, side, {0, angle, 0});
}

void move_feet(const HarmonicGait& gait, const GaitStyle& style, const GaitSeries& series) noexcept {
    const PartStyle& legs = style[BodyPart::legs];
    scale_steps(gait, series, std::clamp(legs.amplitude, 0.0f, 3.0f));
    const float out = std::clamp(legs.out, -45.0f, 60.0f) * k_radians_per_degree;
    const float apart = 0.5f * std::clamp(style.width, -0.1f, 0.3f);
    for (std::size_t side = 0; side < 2; ++side) {
        const float sign = side == 0 ? 1.0f : -1.0f;
        if (out != 0) turn_foot(gait, series, side, sign * out);
        for (const FootPart part : {FootPart::heel, FootPart::ball}) series.foot(side, part, 0)[0] += sign * apart;
    }
    // What a foot strays while it stands takes less time in a shorter stride: it may stray less.
    const float stride = std::clamp(style.stride, 0.5f, 1.5f);
    for (std::size_t side = 0; side < 2; ++side)
        for (const FootPart part : {FootPart::heel, FootPart::ball})
            for (const int axis : {0, 2}) scale_about(series.foot(side, part, axis), 0.5f * gait.foot_lift, stride);
    const std::span<float> rhythm = series.rhythm();
    rhythm[4] /= stride;
    rhythm[5] += legs.lag;
    if (legs.sharpness == 1) return;
    for (std::size_t side = 0; side < 2; ++side)
        rhythm[6 + side] = 1 - (1 - rhythm[6 + side]) / std::clamp(legs.sharpness, 0.3f, 2.0f);
}

/// All of the sliders but for what keeps rhythms sane. What it makes of a sum of values is the sum of what it makes of
/// each, but for what it adds to all of them alike.
void apply_sliders(const HarmonicGait& gait, const StyleBody& body, const GaitStyle& style,
                   std::span<float> values) noexcept {
    const GaitSeries series(gait, values);
    move_joints(gait, body, style, series);
    move_hips(gait, body, style, series);
    hold(series, body, std::array{gait.soles.hips}, held(style[BodyPart::pelvis]));
    // What stands on the pelvis stays upright: its lean is its own.
    hold(series, body, body.spine, held(style[BodyPart::spine]) - held(style[BodyPart::pelvis]));
    hold(series, body, body.head, held(style[BodyPart::head]));
    hold_arms(series, body, style[BodyPart::arms]);
    move_feet(gait, style, series);
}

}  // namespace

StyleBody make_style_body(const HarmonicGait& gait) {
    StyleBody body;
    body.model = mean_models(gait);
    std::vector<Transform> rest(gait.skeleton->rest.size());
    local_to_model(*gait.skeleton, gait.skeleton->rest, rest);
    const RoleMap roles = find_roles(*gait.skeleton, rest).roles;
    for (int j = 0; j < gait.skeleton->joint_count(); ++j) {
        const int parent = gait.skeleton->parents[at(j)];
        BodyPart part = parent == k_no_joint ? BodyPart::count : body.part[at(parent)];
        for (int r = 0; r < k_role_count; ++r)
            if (roles[static_cast<Role>(r)] == j && part_of(static_cast<Role>(r)) != BodyPart::count)
                part = part_of(static_cast<Role>(r));
        body.part.push_back(part);
    }
    body.spine = {roles[Role::spine], roles[Role::chest], roles[Role::upper_chest]};
    body.head = {roles[Role::neck], roles[Role::head], k_no_joint};
    body.upper_arm = {roles[Role::left_upper_arm], roles[Role::right_upper_arm]};
    body.lower_arm = {roles[Role::left_lower_arm], roles[Role::right_lower_arm]};
    return body;
}

void apply_style(const HarmonicGait& gait, const StyleBody& body, const GaitStyle& style,
                 std::span<float> values) noexcept {
    apply_sliders(gait, body, style, values);
    const PartStyle& legs = style[BodyPart::legs];
    const std::span<float> rhythm = GaitSeries(gait, values).rhythm();
    if (legs.lag != 0) rhythm[5] = std::clamp(rhythm[5], 0.3f, 0.7f);
    if (legs.sharpness != 1)
        for (float& lift : rhythm.subspan(6, 2)) lift = std::clamp(lift, 0.2f, 0.8f);
}

HarmonicGait with_style(const HarmonicGait& gait, const GaitStyle& style) {
    if (style == GaitStyle{}) return gait;  // to the last bit
    const StyleBody body = make_style_body(gait);
    const std::size_t count = at(value_count(gait)), of_mode = at(gait.basis.terms_of_mode());
    std::vector<float> added(count, 0.0f);
    apply_sliders(gait, body, style, added);
    HarmonicGait styled = gait;
    for (std::size_t term = 0; term < at(gait.basis.terms()); ++term) {
        const std::span<float> values(styled.coefficients.data() + term * count, count);
        apply_sliders(gait, body, style, values);
        if (term % of_mode == 0) continue;  // the first term of a mode weighs as much as the mode: all add up to 1
        for (std::size_t i = 0; i < count; ++i) values[i] -= added[i];
    }
    return styled;
}

void apply_slope(const HarmonicGait& gait, const StyleBody& body, float slope_deg, std::span<float> values) noexcept {
    constexpr float k_steepest = 35;
    constexpr float k_shorter = 0.008f;  // of the stride a degree
    const float slope = std::clamp(slope_deg, -k_steepest, k_steepest);
    if (slope == 0) return;
    const GaitSeries series(gait, values);
    const float angle = slope * k_radians_per_degree;
    const auto rise = static_cast<float>(tan(static_cast<double>(angle)));
    for (std::size_t side = 0; side < 2; ++side) {
        for (const FootPart part : {FootPart::heel, FootPart::ball}) {
            const std::span<float> y = series.foot(side, part, 1), z = series.foot(side, part, 2);
            for (std::size_t i = 0; i < y.size(); ++i) y[i] += rise * z[i];
        }
        add_foot_turn(gait, series, side, {-angle, 0, 0});
    }
    const std::span<float> rhythm = series.rhythm();
    rhythm[1] += rise * rhythm[2];
    rhythm[4] *= 1 + k_shorter * std::fabs(slope);
    const float lean = slope_lean(angle) * k_degrees_per_radian;
    hold(series, body, std::array{gait.soles.hips}, {0.4f * lean, 0, 0});
    hold(series, body, body.spine, {0.6f * lean, 0, 0});
    hold(series, body, body.head, {-0.5f * lean, 0, 0});
}

}  // namespace surefoot
