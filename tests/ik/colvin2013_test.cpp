// What Colvin & Kajala 2013 found, in numbers: angles applied as Euler angles pop (§IV.A), the 90 degree preset and the
// twist do not (§IV.B).

#include <surefoot/ik/two_bone.h>
#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_thigh = 0.42f, k_calf = 0.41f;
constexpr Vec3 k_hip{0.1f, 0.88f, 0};

/// A foot that is carried forward under its hip, a little to its side, as in the swing of a step.
struct SwingingFoot {
    std::vector<Vec3> ankles;
    float fastest = 0;  // [m] a frame
    SwingingFoot() {
        for (int i = 0; i <= 25; ++i) {
            const float z = -0.25f + 0.02f * static_cast<float>(i);
            ankles.push_back({k_hip.x - 0.005f, 0.12f + 0.15f * (1 - z * z / 0.0625f), z});
            if (i) fastest = std::max(fastest, distance(ankles[ankles.size() - 1], ankles[ankles.size() - 2]));
        }
    }
};

/// The first attempt that the paper tells of: the angles of a target, about the vertical and from it, and the knee's by
/// the law of cosines, are simply set as the joints' Euler angles.
Vec3 knee_by_euler_angles(Vec3 target) {
    const Vec3 to = target - k_hip;
    const float reach = std::min(length(to), k_thigh + k_calf);
    const float heading = atan2(to.x, to.z), lifted = atan2(planar_length(to), -to.y);
    const float bent =
        acos(std::clamp((k_thigh * k_thigh + reach * reach - k_calf * k_calf) / (2 * k_thigh * reach), -1.0f, 1.0f));
    const Quat thigh = axis_angle({0, 1, 0}, heading) * axis_angle({1, 0, 0}, -(lifted + bent));
    return k_hip + rotate(thigh, {0, -k_thigh, 0});
}

/// The animated leg: the foot straight below, the knee a little in front.
ColvinInput leg_to(Vec3 target) {
    ColvinInput leg;
    leg.hip = k_hip;
    leg.knee = k_hip + Vec3{0, -0.415f, 0.0648f};
    leg.ankle = k_hip + Vec3{0, -0.8199f, 0};
    leg.target = target;
    const Vec3 thigh = normalized(leg.knee - leg.hip), off = leg.knee - leg.ankle;
    leg.upper_forward = normalized(off - thigh * dot(off, thigh));
    return leg;
}

template <typename Knee>
float largest_jump(const SwingingFoot& foot, const Knee& knee) {
    float worst = 0;
    for (std::size_t i = 1; i < foot.ankles.size(); ++i)
        worst = std::max(worst, distance(knee(foot.ankles[i]), knee(foot.ankles[i - 1])));
    return worst;
}

TEST(Colvin2013, the_naive_euler_variant_pops_where_the_foot_passes_under_the_hip_and_the_five_steps_do_not) {
    const SwingingFoot foot;
    const float euler = largest_jump(foot, knee_by_euler_angles);
    const float five = largest_jump(foot, [](Vec3 target) { return solve_colvin(leg_to(target)).knee; });
    EXPECT_GT(euler, 0.25f) << "the knee goes from behind to in front within a frame";
    EXPECT_GT(euler, 8 * foot.fastest);
    EXPECT_LT(five, 2 * foot.fastest);
    RecordProperty("euler_jump_cm", std::to_string(100 * euler));
    RecordProperty("five_steps_jump_cm", std::to_string(100 * five));
}

TEST(Colvin2013, the_twist_restores_the_knees_plane) {
    // Feet to the side, where the swing of step 4 from the preset leaves the knee's plane turned.
    float before = 0, after = 0;
    int count = 0;
    for (float x = -0.15f; x <= 0.151f; x += 0.05f)
        for (float z = -0.25f; z <= 0.251f; z += 0.05f) {
            const ColvinInput leg = leg_to({k_hip.x + x, 0.15f, z});
            const Vec3 animated = normalized(cross(leg.knee - leg.hip, leg.ankle - leg.knee));
            // The animated plane, carried with the leg onto its target.
            const Vec3 wanted = rotate(carry_swing(leg.hip, leg.ankle, leg.target), animated);
            const auto off = [&](Vec3 knee, Vec3 ankle) {
                const Vec3 plane = normalized(cross(knee - leg.hip, ankle - knee));
                return acos(std::clamp(dot(plane, wanted), -1.0f, 1.0f)) * k_degrees_per_radian;
            };
            const Vec3 forward{sin(0.5f), 0, cos(0.5f)};  // a character that faces 29 degrees beside its leg's plane
            const float angle = colvin_step3_knee_angle(k_thigh, k_calf, distance(leg.hip, leg.target));
            const ColvinLeg posed = colvin_step3_preset(k_thigh, k_calf, angle, forward);
            const Quat swing = colvin_step4_swing(posed.ankle, leg.target - leg.hip);
            before += off(leg.hip + rotate(swing, posed.knee), leg.target);
            ColvinInput whole = leg;
            whole.forward = forward;
            const TwoBoneResult twisted = solve_colvin(whole);
            after += off(twisted.knee, twisted.ankle);
            ++count;
        }
    before /= static_cast<float>(count);
    after /= static_cast<float>(count);
    EXPECT_GT(before, 20) << "degrees, on average";
    EXPECT_LT(after, 5);
    RecordProperty("plane_before_deg", std::to_string(before));
    RecordProperty("plane_after_deg", std::to_string(after));
}

}  // namespace
}  // namespace surefoot
