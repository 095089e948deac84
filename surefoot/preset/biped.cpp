#include <surefoot/preset/biped.h>

#include <iterator>

namespace surefoot {

namespace {

// Fractions of stature. Drillis & Contini give heights of joints above the floor and lengths of segments.
constexpr float k_hip_height = 0.530f;
constexpr float k_knee_height = 0.285f;
constexpr float k_ankle_height = 0.039f;
constexpr float k_foot_length = 0.152f;
constexpr float k_foot_breadth = 0.055f;
constexpr float k_shoulder_height = 0.818f;
constexpr float k_upper_arm = 0.186f;
constexpr float k_forearm = 0.146f;
constexpr float k_hand = 0.108f;
// Their half shoulder breadth of 0.129 is that of the acromion; the joint's centre lies further in and lower. Their hip
// breadth is that of the trochanters; joint centres are about 0.1 apart (Bell, Brand & Pedersen, 1989).
constexpr float k_shoulder_half_width = 0.107f;
constexpr float k_shoulder_below_acromion = 0.012f;
constexpr float k_hip_half_width = 0.050f;
// Heights along the spine, between the ends that they give: hips, and the base of the skull below the chin's 0.870.
constexpr float k_pelvis_height = 0.545f;
constexpr float k_spine_height = 0.585f;
constexpr float k_chest_height = 0.650f;
constexpr float k_upper_chest_height = 0.725f;
constexpr float k_neck_height = 0.832f;
constexpr float k_head_height = 0.880f;
// The foot: the ankle stands a quarter of the foot's length from the heel, the ball at 0.72 of it. The toe joint lies
// in the sole itself, so that rolling over the ball moves neither ball nor toes.
constexpr float k_heel_share = 0.25f;
constexpr float k_ball_share = 0.72f;

struct JointRow {
    const char* name;
    const char* parent;
    Role role, right_role;  // the second for rows of the left side
    Vec3 position;          // of the whole, fractions of stature
    Vec3 tip;               // from the joint, fractions of stature
};

constexpr float k_ball_z = (k_ball_share - k_heel_share) * k_foot_length;
constexpr float k_toe = (1.0f - k_ball_share) * k_foot_length;
constexpr float k_shoulder_y = k_shoulder_height - k_shoulder_below_acromion;
constexpr float k_elbow_x = k_shoulder_half_width + k_upper_arm;
constexpr float k_wrist_x = k_elbow_x + k_forearm;

// Left side only: the right side is its mirror image.
constexpr JointRow k_rows[] = {
    {"Hips", "", Role::hips, Role::hips, {0, k_pelvis_height, 0}, {}},
    {"Spine", "Hips", Role::spine, Role::spine, {0, k_spine_height, -0.004f}, {}},
    {"Chest", "Spine", Role::chest, Role::chest, {0, k_chest_height, -0.006f}, {}},
    {"UpperChest", "Chest", Role::upper_chest, Role::upper_chest, {0, k_upper_chest_height, -0.010f}, {}},
    {"Neck", "UpperChest", Role::neck, Role::neck, {0, k_neck_height, -0.012f}, {}},
    {"Head", "Neck", Role::head, Role::head, {0, k_head_height, -0.004f}, {0, 1.0f - k_head_height, 0}},
    {"LeftShoulder",
     "UpperChest",
     Role::left_shoulder,
     Role::right_shoulder,
     {0.022f, k_shoulder_y - 0.004f, -0.004f},
     {}},
    {"LeftUpperArm",
     "LeftShoulder",
     Role::left_upper_arm,
     Role::right_upper_arm,
     {k_shoulder_half_width, k_shoulder_y, -0.012f},
     {}},
    {"LeftLowerArm",
     "LeftUpperArm",
     Role::left_lower_arm,
     Role::right_lower_arm,
     {k_elbow_x, k_shoulder_y, -0.012f},
     {}},
    {"LeftHand", "LeftLowerArm", Role::left_hand, Role::right_hand, {k_wrist_x, k_shoulder_y, -0.012f}, {k_hand, 0, 0}},
    {"LeftUpperLeg", "Hips", Role::left_upper_leg, Role::right_upper_leg, {k_hip_half_width, k_hip_height, 0}, {}},
    {"LeftLowerLeg",
     "LeftUpperLeg",
     Role::left_lower_leg,
     Role::right_lower_leg,
     {k_hip_half_width, k_knee_height, 0},
     {}},
    {"LeftFoot", "LeftLowerLeg", Role::left_foot, Role::right_foot, {k_hip_half_width, k_ankle_height, 0}, {}},
    {"LeftToes", "LeftFoot", Role::left_toes, Role::right_toes, {k_hip_half_width, 0, k_ball_z}, {0, 0, k_toe}},
};

constexpr Vec3 mirrored_x(Vec3 v) { return {-v.x, v.y, v.z}; }
std::string mirrored_name(std::string name) {
    if (name.rfind("Left", 0) == 0) name.replace(0, 4, "Right");
    return name;
}

}  // namespace

Biped make_biped(float stature) {
    auto skeleton = std::make_shared<Skeleton>();
    Biped biped;
    std::vector<Vec3> positions;
    const auto add = [&](const std::string& name, const std::string& parent, Role role, Vec3 position, Vec3 tip) {
        const int parent_joint = skeleton->find(parent);
        const Vec3 origin = parent_joint < 0 ? Vec3{} : positions[static_cast<std::size_t>(parent_joint)];
        positions.push_back(position * stature);
        biped.roles.set(role, skeleton->add(name, parent_joint, {{}, positions.back() - origin}, tip * stature));
    };
    const auto is_left = [](const JointRow& row) { return row.position.x > 0; };
    // Limbs one after another (left arm, right arm, left leg, right leg), as rigs usually list them.
    for (std::size_t i = 0; i < std::size(k_rows); ++i) {
        const JointRow& row = k_rows[i];
        add(row.name, row.parent, row.role, row.position, row.tip);
        const bool limb_ends = is_left(row) && row.tip != Vec3{};
        if (!limb_ends) continue;
        for (std::size_t k = i - 3; k <= i; ++k)
            add(mirrored_name(k_rows[k].name), mirrored_name(k_rows[k].parent), k_rows[k].right_role,
                mirrored_x(k_rows[k].position), mirrored_x(k_rows[k].tip));
    }
    biped.skeleton = std::move(skeleton);
    biped.stature = stature;
    return biped;
}

LegSize leg_size(float stature) noexcept {
    LegSize size;
    size.thigh = (k_hip_height - k_knee_height) * stature;
    size.shank = (k_knee_height - k_ankle_height) * stature;
    size.hip_half_width = k_hip_half_width * stature;
    size.hip_drop = (k_pelvis_height - k_hip_height) * stature;
    size.ankle_height = k_ankle_height * stature;
    size.heel_back = k_heel_share * k_foot_length * stature;
    size.ball_ahead = k_ball_z * stature;
    size.toe_length = k_toe * stature;
    size.half_breadth = 0.5f * k_foot_breadth * stature;
    return size;
}

}  // namespace surefoot
