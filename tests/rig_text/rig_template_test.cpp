#include <surefoot/base/error.h>
#include <surefoot/rig_text/rig_template.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr const char* k_stick = R"(
rig stick help "The least that walks"
parameter stature = 1.75 in [0.5, 3] unit "m" group "Size" help "Sole to crown"
parameter leg = 1 in [0.5, 2] help "Length of the legs"
parameter joints = 2 in [0, 30]
parameter toes = 0 in [0, 1]
let hip = 0.53 * leg
scale = stature / (hip + 0.47)
joint Hips role hips at (0, hip, 0)
chain Spine Chest = joints in Hips through (0, hip + 0.1, 0) (0, hip + 0.2, 0.1) (0, hip + 0.4, 0.1)
joint Head in Spine.end role head at (0, hip + 0.4, 0.1) tip (0, hip + 0.47, 0.1)
joint LeftUpperLeg in Hips role left_upper_leg at (0.05, hip, 0)
joint LeftLowerLeg in LeftUpperLeg role left_lower_leg at (0.05, hip / 2, 0)
joint LeftFoot in LeftLowerLeg role left_foot at (0.05, 0.04, 0) tip (0.05, 0, 0.1)
when toes > 0.5 {
    joint LeftToes in LeftFoot role left_toes at (0.05, 0, 0.08) tip (0.05, 0, 0.12)
}
limit left_lower_leg x [-2, 135] z [-1, 3]
preset tall help "A tall one" { stature = 2.1 }
)";

Rig rig_of(const std::string& text, std::vector<std::string> set = {}, const char* preset = "") {
    const RigTemplate rig = read_rig_template(text, "test.rig");
    return make_rig(rig, rig_values(rig, preset, set));
}

std::vector<Transform> models(const Rig& rig) {
    std::vector<Transform> models(rig.skeleton->rest.size());
    local_to_model(*rig.skeleton, rig.skeleton->rest, models);
    return models;
}
Vec3 place(const Rig& rig, Role role) { return models(rig)[static_cast<std::size_t>(rig.roles[role])].translation; }
Vec3 place(const Rig& rig, const char* joint) {
    return models(rig)[static_cast<std::size_t>(rig.skeleton->find(joint))].translation;
}

TEST(RigTemplate, points_become_a_skeleton_in_metres_with_a_mirrored_right_side) {
    const Rig rig = rig_of(k_stick);
    EXPECT_EQ(problem(*rig.skeleton), "");
    EXPECT_EQ(rig.name, "stick");
    const std::vector<std::string> names = {"Hips",          "Spine",        "Chest",    "Head",
                                            "LeftUpperLeg",  "LeftLowerLeg", "LeftFoot", "RightUpperLeg",
                                            "RightLowerLeg", "RightFoot"};
    EXPECT_EQ(rig.skeleton->names, names);
    EXPECT_NEAR(rig.stature, 1.75f, 1e-6f);
    EXPECT_LT(distance(place(rig, Role::left_foot), Vec3{0.05f, 0.04f, 0} * 1.75f), 1e-6f);
    EXPECT_LT(distance(place(rig, Role::right_foot), Vec3{-0.05f, 0.04f, 0} * 1.75f), 1e-6f);
    EXPECT_LT(distance(rig.skeleton->tips[6], Vec3{0, -0.04f, 0.1f} * 1.75f), 1e-6f);
    EXPECT_EQ(rig.skeleton->tips[0], Vec3{});
    EXPECT_TRUE(std::all_of(rig.skeleton->rest.begin(), rig.skeleton->rest.end(),
                            [](const Transform& t) { return t.rotation == Quat{}; }));
    EXPECT_TRUE(rig.legs.known());
    EXPECT_EQ(rig.roles[Role::chest], 2);
}

TEST(RigTemplate, parameters_presets_and_conditions_shape_it) {
    EXPECT_NEAR(rig_of(k_stick, {"stature=1.2"}).stature, 1.2f, 1e-6f);
    EXPECT_NEAR(rig_of(k_stick, {}, "tall").stature, 2.1f, 1e-6f);
    const Rig long_legs = rig_of(k_stick, {"leg=1.5"});
    EXPECT_NEAR(place(long_legs, Role::hips).y, 1.75f * 0.795f / 1.265f, 1e-5f);
    EXPECT_FALSE(long_legs.roles.has(Role::left_toes));
    const Rig toes = rig_of(k_stick, {"toes=1"});
    EXPECT_TRUE(toes.roles.has(Role::left_toes) && toes.roles.has(Role::right_toes));
    // A bone that carries another ends there.
    EXPECT_EQ(toes.skeleton->tips[static_cast<std::size_t>(toes.roles[Role::left_foot])], Vec3{});
}

TEST(RigTemplate, chains_take_any_number_of_joints_at_equal_steps) {
    // Through (0, .1, 0), (0, .2, .1), (0, .4, .1) over the hips at .53: with two joints they stand at the first two.
    const Rig two = rig_of(k_stick);
    EXPECT_LT(distance(place(two, "Spine"), Vec3{0, 0.63f, 0} * 1.75f), 1e-6f);
    EXPECT_LT(distance(place(two, "Chest"), Vec3{0, 0.73f, 0.1f} * 1.75f), 1e-6f);
    const Rig one = rig_of(k_stick, {"joints=1"});
    EXPECT_EQ(one.skeleton->find("Chest"), k_no_joint);
    EXPECT_EQ(one.roles[Role::spine], 1);
    const Rig four = rig_of(k_stick, {"joints=4"});
    EXPECT_LT(distance(place(four, "Spine1"), Vec3{0, 0.68f, 0.05f} * 1.75f), 1e-6f);
    EXPECT_LT(distance(place(four, "Spine3"), Vec3{0, 0.83f, 0.1f} * 1.75f), 1e-6f);
    for (int n = 1; n <= k_max_chain_joints; ++n) {
        const Rig rig = rig_of(k_stick, {"joints=" + std::to_string(n)});
        EXPECT_EQ(rig.skeleton->joint_count(), 8 + n);
        EXPECT_LT(distance(place(rig, Role::head), Vec3{0, 0.93f, 0.1f} * 1.75f), 1e-6f);
        const int head = rig.roles[Role::head];
        EXPECT_EQ(rig.skeleton->parents[static_cast<std::size_t>(head)], n);
    }
}

TEST(RigTemplate, limits_replace_the_human_ones_axis_by_axis_on_both_sides) {
    const Rig rig = rig_of(k_stick);
    const JointLimit &left = rig.limits[Role::left_lower_leg], &right = rig.limits[Role::right_lower_leg];
    EXPECT_NEAR(left.low.x, -2 * k_radians_per_degree, 1e-6f);
    EXPECT_NEAR(right.high.x, 135 * k_radians_per_degree, 1e-6f);
    EXPECT_NEAR(left.high.z, 3 * k_radians_per_degree, 1e-6f);
    EXPECT_NEAR(right.low.z, -3 * k_radians_per_degree, 1e-6f);
    EXPECT_EQ(left.low.y, human_limits()[Role::left_lower_leg].low.y);
    EXPECT_EQ(rig.limits[Role::left_foot], human_limits()[Role::left_foot]);
}

TEST(RigTemplate, a_template_may_be_another_with_other_defaults_and_more_joints) {
    const Rig rig = rig_of(
        "rig small from adult help \"Half\" set stature = 0.9\n"
        "joint LeftEar in Head at (0.05, 0.95, 0)\n limit left_foot x [-5, 5]");
    EXPECT_EQ(rig.name, "small");
    EXPECT_NEAR(rig.stature, 0.9f, 1e-6f);
    EXPECT_EQ(rig.skeleton->joint_count(), 24);
    EXPECT_NEAR(place(rig, "RightEar").x, -0.045f, 1e-6f);
    EXPECT_NEAR(rig.limits[Role::right_foot].high.x, 5 * k_radians_per_degree, 1e-6f);
}

/// The text is refused, at this place, in these words.
void expect_says(const std::string& text, const std::string& where, const std::string& words) {
    try {
        rig_of(text);
        ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find(where), std::string::npos) << what;
        EXPECT_NE(what.find(words), std::string::npos) << what;
    }
}

/// k_stick with one thing replaced.
std::string with(const std::string& from, const std::string& to) {
    std::string text = k_stick;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(RigTemplate, errors_show_line_column_and_a_caret) {
    try {
        rig_of(with("role head at (0, hip", "role head at (0, hop"));
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "test.rig:11:42: nothing above is named 'hop'; define it above by parameter or let\n"
                     "    joint Head in Spine.end role head at (0, hop + 0.4, 0.1) tip (0, hip + 0.47, 0.1)\n"
                     "                                             ^");
    }
}

TEST(RigTemplate, what_is_wrong_is_said) {
    expect_says("", "test.rig:1:1", "begins by its name");
    expect_says("joint Hips at (0, 1, 0)", "test.rig:1:1", "begins by its name");
    expect_says("rig x", "test.rig", "no scale");
    expect_says("rig x scale = 1", "test.rig", "no joints");
    expect_says("rig x from nobody", "test.rig:1:12", "adult");
    expect_says("rig x rig y", "test.rig", "named twice");
    expect_says(with("in Hips role left_upper_leg", "role left_upper_leg"), "test.rig:12", "no parent");
    expect_says(with("LeftLowerLeg in LeftUpperLeg", "LeftLowerLeg in Thigh"), "test.rig:13", "no joint 'Thigh'");
    expect_says(with("in Spine.end", "in Spine"), "test.rig:11", ".end");
    expect_says(with("role head", "role brain"), "test.rig:11", "no role 'brain'");
    expect_says(with("role head", "role left_hand"), "test.rig:11", "side");
    expect_says(with("role left_foot", "role left_lower_leg"), "test.rig:14", "given twice");
    expect_says(with("joint LeftFoot", "joint RightFoot"), "test.rig:14", "what is named Left is mirrored");
    expect_says(with("joint LeftFoot", "joint Foot"), "test.rig:14", "begin its name with Left");
    expect_says(with("joint LeftFoot", "joint Hips"), "test.rig:14", "already");
    expect_says(with("scale = ", "scale = 1 scale = "), "test.rig:8", "twice");
    expect_says(with("x [-2, 135]", "x 135"), "test.rig:18", "[low, high]");
    expect_says(with("limit left_lower_leg x", "limit right_lower_leg x"), "test.rig:18", "left side");
    expect_says(with("x [-2, 135] z [-1, 3]", ""), "test.rig", "no range");
    expect_says(with("x [-2, 135]", "x [135, -2]"), "test.rig:18", "ascend");
    expect_says(with("joints = 2", "joints = 2.5"), "test.rig:10", "whole number");
    expect_says(with("joints = 2", "joints = 0"), "test.rig:10", "whole number");
    expect_says(with("(0, hip, 0)", "(0, hip)"), "test.rig:9", "point");
    expect_says(with("hip / 2, 0)", "hip, 0)"), "stick", "no length");
    expect_says(with("scale = stature", "scale = 0 * stature"), "stick", "scale");
    expect_says(with("0.05, 0.04, 0)", "0.05, 1e9, 0)"), "test.rig:14", "100 m");
    expect_says(with("joint LeftToes in LeftFoot", "when 1 { joint LeftToes in LeftFoot"), "test.rig", "condition");
    expect_says(with("preset tall", "set height = 2 preset tall"), "test.rig:19", "no parameter 'height'");
    expect_says(with("preset tall", "set stature = 9 preset tall"), "test.rig:19", "outside the range");
    expect_says(with("let hip", "let hip = t let hop"), "test.rig:7", "nothing above is named 't'");
    expect_says(with("role left_foot ", ""), "stick", "left_foot");
    // A joint that hangs on one that is left out.
    expect_says(with("limit left_lower_leg", "joint LeftNail in LeftToes at (0.05, 0, 0.2) limit left_lower_leg"),
                "test.rig:18", "left out");
}

TEST(RigTemplate, names_that_nothing_uses_are_warned_of) {
    const RigTemplate rig = read_rig_template(with("scale =", "let idle = 1 scale ="), "test.rig");
    ASSERT_EQ(rig.warnings.size(), 1u);
    EXPECT_EQ(rig.warnings[0], "test.rig:8:5: nothing uses 'idle'");
}

}  // namespace
}  // namespace surefoot
