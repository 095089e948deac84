#include <surefoot/synthetic/foot_path.h>
#include <surefoot/synthetic/gait_cycle.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

constexpr float k_tau = static_cast<float>(2 * k_pi);
constexpr float k_gravity = 9.81f;  // m/s^2
constexpr Vec3 k_x{1, 0, 0}, k_y{0, 1, 0}, k_z{0, 0, 1};

float rad(float degrees) { return degrees * k_radians_per_degree; }
/// Wave over the phase that peaks in the middle of left stance, negative in right stance.
float over_left_stance(const GaitParameters& g, float phase) {
    return cos(k_tau * (phase - 0.5f * std::min(g.duty, 0.6f)));
}
Quat heading_roll_pitch(float yaw, float roll, float pitch) {
    return axis_angle(k_y, yaw) * axis_angle(k_z, roll) * axis_angle(k_x, pitch);
}
/// The same rotation on the other side of the body.
Quat mirrored(Quat q) { return {q.x, -q.y, -q.z, q.w}; }

struct LegRoles {
    Role upper, lower, foot, toes;
};
constexpr LegRoles k_leg_roles[2] = {
    {Role::left_upper_leg, Role::left_lower_leg, Role::left_foot, Role::left_toes},
    {Role::right_upper_leg, Role::right_lower_leg, Role::right_foot, Role::right_toes}};
struct ArmRoles {
    Role shoulder, upper, lower, hand;
};
constexpr ArmRoles k_arm_roles[2] = {
    {Role::left_shoulder, Role::left_upper_arm, Role::left_lower_arm, Role::left_hand},
    {Role::right_shoulder, Role::right_upper_arm, Role::right_lower_arm, Role::right_hand}};

/// Builds the poses of one cycle. Sides are 0 left, 1 right; `sign` is +1 left, -1 right; the right side lives half a
/// cycle later, so that a mirrored gait is the mirror image half a cycle later.
class Walker {
  public:
    Walker(const Rig& biped, const GaitParameters& gait);
    void pose(float phase, std::span<Transform> locals) const;

  private:
    static float sign(int side) { return side == 0 ? 1.0f : -1.0f; }
    FootPose foot(int side, float phase) const { return feet_[side].at(phase - 0.5f * static_cast<float>(side)); }
    Transform pelvis(float phase) const;
    Vec3 hip(const Transform& pelvis, int side) const {
        return transform_point(pelvis, {sign(side) * size_.hip_half_width, -size_.hip_drop, 0});
    }
    float highest_hips() const;
    void place_feet(float ahead);
    float best_foothold();
    float reach(float flexion) const;
    RootFrame foothold(int side, float ahead) const;
    void pose_leg(int side, float phase, const Transform& pelvis, std::span<Transform> locals) const;
    void pose_trunk(float phase, const Transform& pelvis, std::span<Transform> locals) const;
    void pose_arm(int side, float phase, Quat facing, Quat chest, std::span<Transform> locals) const;
    Transform& joint(std::span<Transform> locals, Role role) const {
        return locals[static_cast<std::size_t>(biped_.roles[role])];
    }

    const Rig& biped_;
    GaitParameters gait_;
    LegSize size_;
    float bank_;             // radians towards the inside of the turn, positive to the left
    float hips_height_ = 0;  // of the hips joint, before it bobs
    std::vector<FootPath> feet_;
};

float bank_angle(const GaitParameters& g) { return g.bank * atan2(g.forward * rad(g.turn), k_gravity); }

Walker::Walker(const Rig& biped, const GaitParameters& gait)
    : biped_(biped), gait_(gait), size_(leg_size(biped)), bank_(bank_angle(gait)) {
    place_feet((gait.duty < 1 ? best_foothold() : 0) + gait.ahead);
    hips_height_ = highest_hips();
}

void Walker::place_feet(float ahead) {
    feet_.clear();
    for (int side = 0; side < 2; ++side) feet_.emplace_back(gait_, size_, foothold(side, ahead));
}

/// Under the hips by half a step's width, outward of a banked body.
RootFrame Walker::foothold(int side, float ahead) const {
    const float outward = (size_.length() + size_.ankle_height) * tan(bank_);
    return {{sign(side) * 0.5f * gait_.step_width - outward, 0, ahead}, sign(side) * rad(gait_.toe_out)};
}

/// How far ahead of the hips the footholds should lie so that the body is carried highest, which is where the leg is as
/// straight at the strike as when the heel has risen behind. By ternary search: too far either way lowers the hips.
float Walker::best_foothold() {
    float low = -0.3f, high = 0.3f;  // metres
    for (int i = 0; i < 20; ++i) {
        const float third = (high - low) / 3;
        place_feet(low + third);
        const float at_low = highest_hips();
        place_feet(high - third);
        if (at_low < highest_hips())
            low += third;
        else
            high -= third;
    }
    return 0.5f * (low + high);
}

Transform Walker::pelvis(float phase) const {
    const GaitParameters& g = gait_;
    const float side = over_left_stance(g, phase);
    // The pelvis drops on the free side a little before mid-stance (Perry, "Gait Analysis", 1992, pelvis).
    const float drop = over_left_stance(g, phase + 0.08f);
    const float inside = g.lateral > 0 ? 1.0f : g.lateral < 0 ? -1.0f : 0.0f;
    const float bob =
        -g.bob * cos(2 * k_tau * (phase - g.bob_low)) - inside * g.sidestep_bob * cos(k_tau * (phase - g.bob_low));
    const Quat rotation =
        heading_roll_pitch(-rad(g.pelvis_yaw) * cos(k_tau * phase), rad(g.list) * drop - bank_, rad(g.pelvis_pitch));
    return {rotation, {g.sway * side, hips_height_ + bob, 0}};
}

/// Distance from hip to ankle with the knee bent by `flexion` radians: law of cosines.
float Walker::reach(float flexion) const {
    const float a = size_.thigh, b = size_.shank;
    return std::sqrt(a * a + b * b + 2 * a * b * cos(flexion));
}

/// The highest hips at which no knee is straighter than allowed, over the whole cycle.
float Walker::highest_hips() const {
    const float limit = reach(rad(gait_.straightest_knee));
    float height = 10;
    for (int f = 0; f < gait_.intervals; ++f) {
        const float phase = static_cast<float>(f) / static_cast<float>(gait_.intervals);
        const Transform body = pelvis(phase);
        for (int side = 0; side < 2; ++side) {
            const Vec3 to = foot(side, phase).ankle - hip(body, side);
            const float planar = planar_length(to);
            const float down = std::sqrt(std::max(0.0f, limit * limit - planar * planar));
            height = std::min(height, down + to.y);
        }
    }
    return height;
}

void Walker::pose_leg(int side, float phase, const Transform& pelvis, std::span<Transform> locals) const {
    const LegRoles& roles = k_leg_roles[side];
    const FootPose target = foot(side, phase);
    const Vec3 from = hip(pelvis, side), line = target.ankle - from;
    const float a = size_.thigh, b = size_.shank, d = std::min(length(line), reach(rad(1)));
    // The knee's axis lies halfway between the pelvis's and the foot's sideways directions.
    const Vec3 down = normalized(line), foot_side = rotate(from_yaw(target.yaw), k_x);
    const Vec3 across = normalized(rotate(pelvis.rotation, k_x) + foot_side);
    const Vec3 axis = normalized(across - down * dot(across, down));
    const float at_hip = acos((a * a + d * d - b * b) / (2 * a * d)),
                at_ankle = acos((b * b + d * d - a * a) / (2 * b * d));
    const auto along = [&](float bend) { return rotate(axis_angle(axis, bend), down); };
    const auto bone = [&](Vec3 direction) {  // -Y along the bone, X the knee's axis
        const Quat swing = rotation_between(-k_y, direction);
        const Vec3 turned = rotate(swing, k_x);
        return axis_angle(direction, atan2(dot(cross(turned, axis), direction), dot(turned, axis))) * swing;
    };
    const Quat upper = bone(along(-at_hip)), lower = bone(along(at_ankle));
    const Quat foot_rotation = axis_angle(k_y, target.yaw) * axis_angle(k_x, -target.pitch);
    joint(locals, roles.upper).rotation = normalized(conjugate(pelvis.rotation) * upper);
    joint(locals, roles.lower).rotation = normalized(conjugate(upper) * lower);
    joint(locals, roles.foot).rotation = normalized(conjugate(lower) * foot_rotation);
    joint(locals, roles.toes).rotation = axis_angle(k_x, -target.toe_bend);
}

void Walker::pose_arm(int side, float phase, Quat facing, Quat chest, std::span<Transform> locals) const {
    const GaitParameters& g = gait_;
    const ArmRoles& roles = k_arm_roles[side];
    // In front when the leg of its side is behind.
    const float front = -cos(k_tau * (phase - 0.5f * static_cast<float>(side) - 0.02f));
    const float swing = rad(g.arm_bias + g.arm_swing * front), flexion = rad(g.elbow + g.elbow_swing * front);
    // The left arm from the T-pose: hang down, turn inward about itself, swing. A swinging shoulder follows a little.
    const Quat hang = axis_angle(k_z, -rad(90 - g.arm_out)) * axis_angle(k_x, rad(g.arm_twist));
    const Quat upper = axis_angle(k_x, -swing) * hang;
    const Quat girdle = axis_angle(k_y, -0.15f * swing) * axis_angle(k_z, rad(-4));
    const Quat lower = axis_angle(k_y, -flexion);
    const auto sided = [&](Quat q) { return side == 0 ? q : mirrored(q); };
    const Quat shoulder = chest * sided(girdle);
    joint(locals, roles.shoulder).rotation = sided(girdle);
    joint(locals, roles.upper).rotation = normalized(conjugate(shoulder) * facing * sided(upper));
    joint(locals, roles.lower).rotation = sided(lower);
    joint(locals, roles.hand).rotation = sided(axis_angle(k_z, rad(-6)));
}

void Walker::pose_trunk(float phase, const Transform& pelvis, std::span<Transform> locals) const {
    const GaitParameters& g = gait_;
    const float yaw = rad(g.trunk_yaw) * cos(k_tau * phase), breath = rad(g.breath) * sin(k_tau * phase);
    const float roll = -0.2f * rad(g.list) * over_left_stance(g, phase) - bank_;
    const Quat chest = heading_roll_pitch(yaw, roll, rad(g.lean) - breath);
    const Quat step = from_rotation_vector(to_rotation_vector(conjugate(pelvis.rotation) * chest) / 3.0f);
    for (Role role : {Role::spine, Role::chest, Role::upper_chest}) joint(locals, role).rotation = step;
    // The head stays level and looks where the turn leads.
    constexpr float k_furthest_look = 30;  // degrees
    const float look = std::clamp(g.turn * g.look, -k_furthest_look, k_furthest_look);
    const Quat head = heading_roll_pitch(rad(look), -0.3f * bank_, 0);
    const Quat nod = from_rotation_vector(to_rotation_vector(conjugate(chest) * head) / 2.0f);
    for (Role role : {Role::neck, Role::head}) joint(locals, role).rotation = nod;
    // Arms hang by weight more than they follow the trunk's lean.
    const Quat facing = heading_roll_pitch(yaw, roll, 0.3f * rad(g.lean));
    for (int side = 0; side < 2; ++side) pose_arm(side, phase, facing, chest, locals);
}

void Walker::pose(float phase, std::span<Transform> locals) const {
    const Transform body = pelvis(phase);
    joint(locals, Role::hips) = body;
    pose_trunk(phase, body, locals);
    for (int side = 0; side < 2; ++side) pose_leg(side, phase, body, locals);
}

}  // namespace

GaitParameters mirrored_gait(GaitParameters gait, std::string name) {
    gait.name = std::move(name);
    gait.lateral = -gait.lateral;
    gait.turn = -gait.turn;
    return gait;
}

Motion make_gait_cycle(const Rig& biped, const GaitParameters& gait) {
    Motion motion = make_motion(biped.skeleton, gait.name, gait.intervals + 1, k_gait_fps);
    motion.cyclic = true;
    const Walker walker(biped, gait);
    for (int f = 0; f <= gait.intervals; ++f) {
        const float time = static_cast<float>(f) / k_gait_fps;
        motion.root[static_cast<std::size_t>(f)] = gait_travel(gait, time);
        // The last frame is the first one again, to the bit.
        walker.pose(static_cast<float>(f % gait.intervals) / static_cast<float>(gait.intervals), motion.frame(f));
    }
    return motion;
}

}  // namespace surefoot
