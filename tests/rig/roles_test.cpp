#include <surefoot/rig/roles.h>

#include <gtest/gtest.h>

#include <map>
#include <sstream>

namespace surefoot {
namespace {

// "hips(spine(head) thigh.L(shin.L))": a skeleton from nested names; '%' stands for a space inside a name.
Skeleton tree(const std::string& text) {
    Skeleton s;
    std::vector<int> open;
    int last = k_no_joint;
    std::string name;
    const auto finish = [&] {
        if (name.empty()) return;
        for (char& c : name)
            if (c == '%') c = ' ';
        last = s.add(name, open.empty() ? k_no_joint : open.back(), {});
        name.clear();
    };
    for (const char c : text) {
        if (c == '(') {
            finish();
            open.push_back(last);
        } else if (c == ')') {
            finish();
            open.pop_back();
        } else if (c == ' ' || c == '\n') {
            finish();
        } else {
            name += c;
        }
    }
    finish();
    return s;
}

RoleReport report_of(const Skeleton& s, const RoleOverrides& overrides = {}) {
    std::vector<Transform> models(s.names.size());
    local_to_model(s, s.rest, models);
    return find_roles(s, models, overrides);
}

std::string joint_of(const Skeleton& s, const RoleReport& report, std::string_view role) {
    const int joint = report.roles[role_from_name(role)];
    return joint == k_no_joint ? "-" : s.names[static_cast<std::size_t>(joint)];
}

// Each line of `expected`: role joint.
void expect_roles(const Skeleton& s, const RoleReport& report, const std::string& expected) {
    std::istringstream lines(expected);
    for (std::string role, joint; lines >> role >> joint;) {
        for (char& c : joint)
            if (c == '%') c = ' ';
        EXPECT_EQ(joint_of(s, report, role), joint) << role << " (" << report.convention << ")";
    }
}

TEST(roles, every_role_name_leads_back_to_its_role) {
    for (int i = 0; i < k_role_count; ++i) {
        const Role role = static_cast<Role>(i);
        EXPECT_EQ(role_from_name(role_name(role)), role);
        EXPECT_EQ(mirrored(mirrored(role)), role);
    }
    EXPECT_EQ(role_from_name("tail"), Role::count);
    EXPECT_EQ(mirrored(Role::left_ring_distal), Role::right_ring_distal);
    EXPECT_EQ(mirrored(Role::hips), Role::hips);
}

TEST(roles, cmu_names_are_found) {
    const Skeleton s = tree(
        "root(lhipjoint(lfemur(ltibia(lfoot(ltoes)))) rhipjoint(rfemur(rtibia(rfoot(rtoes)))) "
        "lowerback(upperback(thorax("
        "lowerneck(upperneck(head)) lclavicle(lhumerus(lradius(lwrist(lhand(lfingers) lthumb)))) "
        "rclavicle(rhumerus(rradius(rwrist(rhand(rfingers) rthumb))))))))");
    const RoleReport r = report_of(s);
    EXPECT_EQ(r.convention, "CMU");
    expect_roles(
        s, r,
        "hips root left_upper_leg lfemur left_lower_leg ltibia left_foot lfoot left_toes ltoes right_upper_leg "
        "rfemur right_lower_leg rtibia right_foot rfoot right_toes rtoes spine lowerback chest upperback "
        "upper_chest thorax neck lowerneck head head left_shoulder lclavicle left_upper_arm lhumerus "
        "left_lower_arm lradius left_hand lwrist right_shoulder rclavicle right_hand rwrist");
}

TEST(roles, godot_and_unity_names_are_found) {
    const Skeleton s = tree(
        "Root(Hips(Spine(Chest(UpperChest(Neck(Head) LeftShoulder(LeftUpperArm(LeftLowerArm(LeftHand))) "
        "RightShoulder(RightUpperArm(RightLowerArm(RightHand))))) ) LeftUpperLeg(LeftLowerLeg(LeftFoot(LeftToes))) "
        "RightUpperLeg(RightLowerLeg(RightFoot(RightToes)))))");
    const RoleReport r = report_of(s);
    EXPECT_EQ(r.convention, "Unity / Godot humanoid");
    expect_roles(s, r,
                 "hips Hips spine Spine chest Chest upper_chest UpperChest neck Neck head Head left_shoulder "
                 "LeftShoulder left_upper_arm LeftUpperArm left_lower_arm LeftLowerArm left_hand LeftHand "
                 "right_upper_leg RightUpperLeg right_toes RightToes left_foot LeftFoot");
}

}  // namespace
}  // namespace surefoot
