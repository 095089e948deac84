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

// One little body in each family's spelling, with what is expected of some roles ("-": none).
struct Family {
    const char* convention;
    const char* text;
    const char* expected;
};

std::string no_name(const testing::TestParamInfo<Family>& info) {
    std::string name = info.param.convention;
    for (char& c : name)
        if (!isalnum(static_cast<unsigned char>(c))) c = '_';
    return name + "_" + std::to_string(info.index);
}

class rig_family : public testing::TestWithParam<Family> {};

TEST_P(rig_family, is_recognised_and_mapped) {
    const Skeleton s = tree(GetParam().text);
    const RoleReport r = report_of(s);
    EXPECT_EQ(r.convention, GetParam().convention);
    expect_roles(s, r, GetParam().expected);
    EXPECT_TRUE(r.roles.has_legs());
    std::map<int, int> used;
    for (const std::int16_t joint : r.roles.joints)
        if (joint != k_no_joint) used[joint]++;
    for (const auto& [joint, times] : used)
        EXPECT_EQ(times, 1) << s.names[static_cast<std::size_t>(joint)] << " has two roles";
}

constexpr Family k_families[] = {
    {"Mixamo",
     "mixamorig:Hips(mixamorig:Spine(mixamorig:Spine1(mixamorig:Spine2(mixamorig:Neck(mixamorig:Head("
     "mixamorig:HeadTop_End mixamorig:LeftEye mixamorig:RightEye)) mixamorig:LeftShoulder(mixamorig:LeftArm("
     "mixamorig:LeftForeArm(mixamorig:LeftHand(mixamorig:LeftHandThumb1(mixamorig:LeftHandThumb2("
     "mixamorig:LeftHandThumb3(mixamorig:LeftHandThumb4))) mixamorig:LeftHandIndex1(mixamorig:LeftHandIndex2("
     "mixamorig:LeftHandIndex3(mixamorig:LeftHandIndex4))) mixamorig:LeftHandPinky1(mixamorig:LeftHandPinky2("
     "mixamorig:LeftHandPinky3(mixamorig:LeftHandPinky4))))))) mixamorig:RightShoulder(mixamorig:RightArm("
     "mixamorig:RightForeArm(mixamorig:RightHand)))))) mixamorig:LeftUpLeg(mixamorig:LeftLeg(mixamorig:LeftFoot("
     "mixamorig:LeftToeBase(mixamorig:LeftToe_End)))) mixamorig:RightUpLeg(mixamorig:RightLeg(mixamorig:RightFoot("
     "mixamorig:RightToeBase(mixamorig:RightToe_End)))))",
     "hips mixamorig:Hips spine mixamorig:Spine chest mixamorig:Spine1 upper_chest mixamorig:Spine2 neck "
     "mixamorig:Neck head mixamorig:Head left_shoulder mixamorig:LeftShoulder left_upper_arm mixamorig:LeftArm "
     "left_lower_arm mixamorig:LeftForeArm left_hand mixamorig:LeftHand left_upper_leg mixamorig:LeftUpLeg "
     "left_lower_leg mixamorig:LeftLeg left_foot mixamorig:LeftFoot left_toes mixamorig:LeftToeBase right_toes "
     "mixamorig:RightToeBase left_eye mixamorig:LeftEye left_thumb_metacarpal mixamorig:LeftHandThumb1 "
     "left_thumb_distal mixamorig:LeftHandThumb3 left_index_proximal mixamorig:LeftHandIndex1 left_little_distal "
     "mixamorig:LeftHandPinky3"},
    {"Mixamo",  // without prefix
     "Hips(Spine(Spine1(Spine2(Neck(Head) LeftShoulder(LeftArm(LeftForeArm(LeftHand))) RightShoulder(RightArm("
     "RightForeArm(RightHand)))))) LeftUpLeg(LeftLeg(LeftFoot(LeftToeBase))) RightUpLeg(RightLeg(RightFoot("
     "RightToeBase))))",
     "hips Hips left_upper_leg LeftUpLeg left_lower_leg LeftLeg left_upper_arm LeftArm left_shoulder LeftShoulder "
     "upper_chest Spine2 right_lower_arm RightForeArm"},
    {"Mixamo",  // numbered namespace turned into a prefix
     "mixamorig1_Hips(mixamorig1_Spine(mixamorig1_Neck(mixamorig1_Head) mixamorig1_LeftArm(mixamorig1_LeftForeArm("
     "mixamorig1_LeftHand)) mixamorig1_RightArm(mixamorig1_RightForeArm(mixamorig1_RightHand))) mixamorig1_LeftUpLeg("
     "mixamorig1_LeftLeg(mixamorig1_LeftFoot)) mixamorig1_RightUpLeg(mixamorig1_RightLeg(mixamorig1_RightFoot)))",
     "hips mixamorig1_Hips left_upper_leg mixamorig1_LeftUpLeg left_foot mixamorig1_LeftFoot left_toes - spine "
     "mixamorig1_Spine chest - left_shoulder -"},
    {"Unreal",
     "root(pelvis(spine_01(spine_02(spine_03(spine_04(spine_05(clavicle_l(upperarm_l(upperarm_twist_01_l "
     "lowerarm_l(lowerarm_twist_01_l hand_l(index_metacarpal_l(index_01_l(index_02_l(index_03_l))) thumb_01_l("
     "thumb_02_l(thumb_03_l)))))) clavicle_r(upperarm_r(lowerarm_r(hand_r))) neck_01(neck_02(head))))))) "
     "thigh_l(thigh_twist_01_l calf_l(calf_twist_01_l foot_l(ball_l))) thigh_r(thigh_twist_01_r calf_r(calf_twist_01_r "
     "foot_r(ball_r)))) ik_foot_root(ik_foot_l ik_foot_r) ik_hand_root(ik_hand_gun(ik_hand_l ik_hand_r)))",
     "hips pelvis spine spine_01 chest spine_03 upper_chest spine_05 neck neck_01 head head left_shoulder clavicle_l "
     "left_upper_arm upperarm_l left_lower_arm lowerarm_l left_hand hand_l left_upper_leg thigh_l left_lower_leg "
     "calf_l left_foot foot_l left_toes ball_l right_toes ball_r left_index_proximal index_01_l "
     "left_thumb_metacarpal thumb_01_l left_thumb_distal thumb_03_l"},
    {"Biped",
     "Bip01(Bip01%Pelvis(Bip01%Spine(Bip01%L%Thigh(Bip01%L%Calf(Bip01%L%Foot(Bip01%L%Toe0(Bip01%L%Toe0Nub)))) "
     "Bip01%R%Thigh(Bip01%R%Calf(Bip01%R%Foot(Bip01%R%Toe0))) Bip01%Spine1(Bip01%Spine2(Bip01%Neck(Bip01%Head("
     "Bip01%HeadNub) Bip01%L%Clavicle(Bip01%L%UpperArm(Bip01%L%Forearm(Bip01%L%Hand(Bip01%L%Finger0(Bip01%L%Finger01("
     "Bip01%L%Finger02)) Bip01%L%Finger1(Bip01%L%Finger11(Bip01%L%Finger12)))))) Bip01%R%Clavicle(Bip01%R%UpperArm("
     "Bip01%R%Forearm(Bip01%R%Hand)))))))))",
     "hips Bip01%Pelvis left_upper_leg Bip01%L%Thigh left_foot Bip01%L%Foot left_toes Bip01%L%Toe0 right_toes "
     "Bip01%R%Toe0 neck Bip01%Neck head Bip01%Head spine Bip01%Spine chest Bip01%Spine1 upper_chest Bip01%Spine2 "
     "left_shoulder Bip01%L%Clavicle left_hand Bip01%L%Hand left_thumb_metacarpal Bip01%L%Finger0 "
     "left_thumb_proximal Bip01%L%Finger01 left_index_proximal Bip01%L%Finger1 left_index_distal Bip01%L%Finger12"},
    {"Biped",
     "ValveBiped.Bip01_Pelvis(ValveBiped.Bip01_Spine(ValveBiped.Bip01_Spine1(ValveBiped.Bip01_Spine2("
     "ValveBiped.Bip01_Spine4(ValveBiped.Bip01_Neck1(ValveBiped.Bip01_Head1) ValveBiped.Bip01_L_Clavicle("
     "ValveBiped.Bip01_L_UpperArm(ValveBiped.Bip01_L_Forearm(ValveBiped.Bip01_L_Hand))) ValveBiped.Bip01_R_Clavicle("
     "ValveBiped.Bip01_R_UpperArm(ValveBiped.Bip01_R_Forearm(ValveBiped.Bip01_R_Hand))))))) ValveBiped.Bip01_L_Thigh("
     "ValveBiped.Bip01_L_Calf(ValveBiped.Bip01_L_Foot(ValveBiped.Bip01_L_Toe0))) ValveBiped.Bip01_R_Thigh("
     "ValveBiped.Bip01_R_Calf(ValveBiped.Bip01_R_Foot(ValveBiped.Bip01_R_Toe0))))",
     "hips ValveBiped.Bip01_Pelvis left_toes ValveBiped.Bip01_L_Toe0 head ValveBiped.Bip01_Head1 neck "
     "ValveBiped.Bip01_Neck1 spine ValveBiped.Bip01_Spine upper_chest ValveBiped.Bip01_Spine4"},
    {"Blender DEF",  // Rigify: the spine's first joint is the pelvis, its last the head; limbs in two segments
     "root(DEF-spine(DEF-pelvis.L DEF-pelvis.R DEF-thigh.L(DEF-thigh.L.001(DEF-shin.L(DEF-shin.L.001(DEF-foot.L("
     "DEF-toe.L))))) DEF-thigh.R(DEF-thigh.R.001(DEF-shin.R(DEF-shin.R.001(DEF-foot.R(DEF-toe.R))))) DEF-spine.001("
     "DEF-spine.002(DEF-spine.003(DEF-breast.L DEF-breast.R DEF-shoulder.L(DEF-upper_arm.L(DEF-upper_arm.L.001("
     "DEF-forearm.L(DEF-forearm.L.001(DEF-hand.L(DEF-f_index.01.L(DEF-f_index.02.L(DEF-f_index.03.L)) DEF-palm.01.L "
     "DEF-thumb.01.L(DEF-thumb.02.L(DEF-thumb.03.L)))))))) DEF-shoulder.R(DEF-upper_arm.R(DEF-upper_arm.R.001("
     "DEF-forearm.R(DEF-forearm.R.001(DEF-hand.R))))) DEF-spine.004(DEF-spine.005(DEF-spine.006)))))))",
     "hips DEF-spine spine DEF-spine.001 chest DEF-spine.002 upper_chest DEF-spine.003 neck DEF-spine.004 head "
     "DEF-spine.006 left_upper_leg DEF-thigh.L left_lower_leg DEF-shin.L left_foot DEF-foot.L left_toes DEF-toe.L "
     "left_upper_arm DEF-upper_arm.L left_lower_arm DEF-forearm.L left_hand DEF-hand.L left_index_distal "
     "DEF-f_index.03.L left_thumb_metacarpal DEF-thumb.01.L"},
    {"Blender DEF",  // UAL
     "root(DEF-hips(DEF-spine.001(DEF-spine.002(DEF-spine.003(DEF-neck(DEF-head) DEF-shoulder.L(DEF-upper_arm.L("
     "DEF-forearm.L(DEF-hand.L))) DEF-shoulder.R(DEF-upper_arm.R(DEF-forearm.R(DEF-hand.R)))))) DEF-thigh.L(DEF-shin.L("
     "DEF-foot.L(DEF-toe.L))) DEF-thigh.R(DEF-shin.R(DEF-foot.R(DEF-toe.R)))))",
     "hips DEF-hips spine DEF-spine.001 chest DEF-spine.002 upper_chest DEF-spine.003 neck DEF-neck head DEF-head "
     "right_lower_arm DEF-forearm.R right_toes DEF-toe.R"},
    {"Character Creator",
     "CC_Base_BoneRoot(CC_Base_Hip(CC_Base_Pelvis(CC_Base_L_Thigh(CC_Base_L_Calf(CC_Base_L_Foot("
     "CC_Base_L_ToeBaseShareBone CC_Base_L_ToeBase(CC_Base_L_PinkyToe1 CC_Base_L_BigToe1)) CC_Base_L_CalfTwist01 "
     "CC_Base_L_KneeShareBone) CC_Base_L_ThighTwist01) CC_Base_R_Thigh(CC_Base_R_ThighTwist01 CC_Base_R_Calf("
     "CC_Base_R_Foot(CC_Base_R_ToeBase CC_Base_R_ToeBaseShareBone)))) CC_Base_Waist(CC_Base_Spine01(CC_Base_Spine02("
     "CC_Base_NeckTwist01(CC_Base_NeckTwist02(CC_Base_Head(CC_Base_FacialBone(CC_Base_JawRoot(CC_Base_Tongue01) "
     "CC_Base_R_Eye CC_Base_L_Eye CC_Base_UpperJaw)))) CC_Base_L_Clavicle(CC_Base_L_Upperarm(CC_Base_L_Forearm("
     "CC_Base_L_ForearmTwist01 CC_Base_L_Hand(CC_Base_L_Mid1(CC_Base_L_Mid2(CC_Base_L_Mid3)) CC_Base_L_Thumb1("
     "CC_Base_L_Thumb2(CC_Base_L_Thumb3)))) CC_Base_L_UpperarmTwist01)) CC_Base_R_Clavicle(CC_Base_R_Upperarm("
     "CC_Base_R_Forearm(CC_Base_R_Hand))) CC_Base_R_RibsTwist(CC_Base_R_Breast))))))",
     "hips CC_Base_Hip spine CC_Base_Waist chest CC_Base_Spine01 upper_chest CC_Base_Spine02 neck CC_Base_NeckTwist01 "
     "head CC_Base_Head jaw CC_Base_JawRoot left_eye CC_Base_L_Eye left_upper_leg CC_Base_L_Thigh left_lower_leg "
     "CC_Base_L_Calf left_foot CC_Base_L_Foot left_toes CC_Base_L_ToeBase right_toes CC_Base_R_ToeBase left_upper_arm "
     "CC_Base_L_Upperarm left_lower_arm CC_Base_L_Forearm left_hand CC_Base_L_Hand left_middle_distal CC_Base_L_Mid3 "
     "left_thumb_metacarpal CC_Base_L_Thumb1"},
    {"VRM",
     "root(hips(spine(chest(upperChest(neck(head(leftEye rightEye jaw)) "
     "leftShoulder(leftUpperArm(leftLowerArm(leftHand("
     "leftThumbMetacarpal(leftThumbProximal(leftThumbDistal)) leftLittleProximal(leftLittleIntermediate("
     "leftLittleDistal)))))) rightShoulder(rightUpperArm(rightLowerArm(rightHand)))))) leftUpperLeg(leftLowerLeg("
     "leftFoot(leftToes))) rightUpperLeg(rightLowerLeg(rightFoot(rightToes)))))",
     "hips hips spine spine chest chest upper_chest upperChest neck neck head head jaw jaw left_eye leftEye "
     "left_thumb_metacarpal leftThumbMetacarpal left_thumb_proximal leftThumbProximal left_thumb_distal "
     "leftThumbDistal left_little_intermediate leftLittleIntermediate right_toes rightToes"},
    {"Unity / Godot humanoid",  // VRM 0.x thumbs
     "Hips(Spine(Chest(Neck(Head) LeftUpperArm(LeftLowerArm(LeftHand(LeftThumbProximal(LeftThumbIntermediate("
     "LeftThumbDistal))))) RightUpperArm(RightLowerArm(RightHand)))) LeftUpperLeg(LeftLowerLeg(LeftFoot)) "
     "RightUpperLeg(RightLowerLeg(RightFoot)))",
     "left_thumb_metacarpal LeftThumbProximal left_thumb_proximal LeftThumbIntermediate left_thumb_distal "
     "LeftThumbDistal upper_chest - chest Chest"},
    {"VRoid",
     "Root(J_Bip_C_Hips(J_Bip_C_Spine(J_Bip_C_Chest(J_Bip_C_UpperChest(J_Sec_L_Bust1 J_Bip_C_Neck(J_Bip_C_Head("
     "J_Adj_L_FaceEye J_Sec_Hair1_01)) J_Bip_L_Shoulder(J_Bip_L_UpperArm(J_Bip_L_LowerArm(J_Bip_L_Hand("
     "J_Bip_L_Index1(J_Bip_L_Index2(J_Bip_L_Index3)))))) J_Bip_R_Shoulder(J_Bip_R_UpperArm(J_Bip_R_LowerArm("
     "J_Bip_R_Hand)))))) J_Bip_L_UpperLeg(J_Bip_L_LowerLeg(J_Bip_L_Foot(J_Bip_L_ToeBase))) J_Bip_R_UpperLeg("
     "J_Bip_R_LowerLeg(J_Bip_R_Foot(J_Bip_R_ToeBase)))))",
     "hips J_Bip_C_Hips upper_chest J_Bip_C_UpperChest left_foot J_Bip_L_Foot left_toes J_Bip_L_ToeBase "
     "left_index_distal J_Bip_L_Index3 head J_Bip_C_Head"},
    {"CMU",  // cgspeed's conversion
     "Hips(LHipJoint(LeftUpLeg(LeftLeg(LeftFoot(LeftToeBase)))) "
     "RHipJoint(RightUpLeg(RightLeg(RightFoot(RightToeBase)))) "
     "LowerBack(Spine(Spine1(Neck(Neck1(Head)) "
     "LeftShoulder(LeftArm(LeftForeArm(LeftHand(LeftFingerBase(LeftHandIndex1) "
     "LThumb)))) RightShoulder(RightArm(RightForeArm(RightHand)))))))",
     "hips Hips left_upper_leg LeftUpLeg spine LowerBack chest Spine upper_chest Spine1 neck Neck head Head "
     "left_upper_arm LeftArm left_index_proximal LeftHandIndex1"},
    {"generic names",  // classic BVH: named after the joint, not the bone
     "Hips(LeftHip(LeftKnee(LeftAnkle(LeftToe))) RightHip(RightKnee(RightAnkle(RightToe))) Chest(LeftCollar("
     "LeftShoulder(LeftElbow(LeftWrist))) RightCollar(RightShoulder(RightElbow(RightWrist))) Neck(Head)))",
     "hips Hips left_upper_leg LeftHip left_lower_leg LeftKnee left_foot LeftAnkle left_toes LeftToe left_shoulder "
     "LeftCollar left_upper_arm LeftShoulder left_lower_arm LeftElbow left_hand LeftWrist neck Neck head Head spine "
     "Chest"},
    {"generic names",  // Kinect: side last
     "SpineBase(SpineMid(SpineShoulder(Neck(Head) ShoulderLeft(ElbowLeft(WristLeft(HandLeft))) "
     "ShoulderRight(ElbowRight("
     "WristRight(HandRight))))) HipLeft(KneeLeft(AnkleLeft(FootLeft))) HipRight(KneeRight(AnkleRight(FootRight))))",
     "hips SpineBase spine SpineMid chest SpineShoulder left_upper_arm ShoulderLeft left_shoulder - left_hand "
     "WristLeft "
     "left_upper_leg HipLeft left_foot AnkleLeft left_toes FootLeft right_toes FootRight"},
    {"generic names",  // CesiumMan: only numbered
     "Skeleton_torso_joint_1(Skeleton_torso_joint_2(torso_joint_3(Skeleton_neck_joint_1(Skeleton_neck_joint_2) "
     "Skeleton_arm_joint_L__4_(Skeleton_arm_joint_L__3_(Skeleton_arm_joint_L__2_)) Skeleton_arm_joint_R("
     "Skeleton_arm_joint_R__2_(Skeleton_arm_joint_R__3_)))) leg_joint_L_1(leg_joint_L_2(leg_joint_L_3(leg_joint_L_5))) "
     "leg_joint_R_1(leg_joint_R_2(leg_joint_R_3(leg_joint_R_5))))",
     "hips Skeleton_torso_joint_1 spine Skeleton_torso_joint_2 chest torso_joint_3 neck Skeleton_neck_joint_1 head "
     "Skeleton_neck_joint_2 left_upper_arm Skeleton_arm_joint_L__4_ left_lower_arm Skeleton_arm_joint_L__3_ left_hand "
     "Skeleton_arm_joint_L__2_ right_upper_arm Skeleton_arm_joint_R left_upper_leg leg_joint_L_1 left_lower_leg "
     "leg_joint_L_2 left_foot leg_joint_L_3 left_toes leg_joint_L_5 right_toes leg_joint_R_5"},
    {"Unreal",  // GDQuest's mannequiny: Unreal's words, Blender's sides, no little finger
     "pelvis(thigh.l(calf.l(foot.l(ball.l))) thigh.r(calf.r(foot.r(ball.r))) spine_01(spine_02(neck_01(head) "
     "clavicle.r("
     "upperarm.r(lowerarm.r(hand.r(thumb_01.r(thumb_02.r(thumb_03.r)) ring_01.r(ring_02.r(ring_03.r)))))) clavicle.l("
     "upperarm.l(lowerarm.l(hand.l))))))",
     "hips pelvis spine spine_01 chest spine_02 upper_chest - neck neck_01 head head left_upper_leg thigh.l left_toes "
     "ball.l right_thumb_metacarpal thumb_01.r right_ring_distal ring_03.r right_little_proximal -"},
    {"generic names",  // lower case, glued sides, twist joints between
     "hips(spine(chest(head leftupperarm(lefttwist(leftforearm(lefthand))) rightupperarm(rightforearm(righthand)))) "
     "leftthigh(leftshin(leftfoot)) rightthigh(rightshin(rightfoot)))",
     "left_upper_leg leftthigh left_lower_leg leftshin left_foot leftfoot left_hand lefthand right_hand righthand"},
    {"generic names",  // Motion-capture names in the O3DE manner
     "root(c_Pelvis(c_spine1(c_spine2(l_shldr(l_upArm(l_loArm(l_hand))) r_shldr(r_upArm(r_loArm(r_hand))) "
     "c_neck(c_head))) "
     "l_upLeg(l_loLeg(l_ankle(l_ball))) r_upLeg(r_loLeg(r_ankle(r_ball)))))",
     "hips c_Pelvis left_shoulder l_shldr left_lower_arm l_loArm left_lower_leg l_loLeg left_foot l_ankle left_toes "
     "l_ball head c_head"},
};
INSTANTIATE_TEST_SUITE_P(roles, rig_family, testing::ValuesIn(k_families), no_name);

TEST(roles, overrides_win_and_bad_ones_are_reported) {
    const Skeleton s = tree("hips(spine(head) leftThigh(leftShin(leftFoot(extra))) rightThigh(rightShin(rightFoot)))");
    const RoleReport r =
        report_of(s, {{"left_toes", "extra"}, {"head", "spine"}, {"tail", "extra"}, {"jaw", "nothing"}});
    expect_roles(s, r, "left_toes extra head spine spine - left_foot leftFoot");
    std::string all;
    for (const std::string& line : r.lines) all += line + "\n";
    EXPECT_NE(all.find("no role 'tail'"), std::string::npos) << all;
    EXPECT_NE(all.find("no joint 'nothing'"), std::string::npos) << all;
    EXPECT_NE(all.find("by hand"), std::string::npos) << all;
}

TEST(roles, what_is_missing_is_said) {
    const Skeleton s = tree("hips(spine(head) leftThigh(leftShin(leftFoot)))");
    const RoleReport r = report_of(s);
    EXPECT_FALSE(r.roles.has_legs());
    std::string all;
    for (const std::string& line : r.lines) all += line + "\n";
    EXPECT_NE(all.find("missing and needed for locomotion: right_upper_leg, right_lower_leg, right_foot"),
              std::string::npos)
        << all;
}

TEST(roles, hostile_skeletons_do_not_cost_much) {
    Skeleton s;
    for (int j = 0; j < k_max_joints; ++j)
        s.add((j % 3 == 0   ? "LeftUpLeg "
               : j % 3 == 1 ? "LeftLeg "
                            : "LeftFoot ") +
                  std::to_string(j),
              j - 1, {{}, {0, -0.01f, 0}});
    EXPECT_FALSE(report_of(s).roles.has_legs());
    Skeleton one;
    one.add("x", k_no_joint, {});
    EXPECT_FALSE(report_of(one).roles.has_legs());
}
}  // namespace
}  // namespace surefoot
