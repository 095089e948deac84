#include <surefoot/ik/lean.h>

#include "tests/support/rigs.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_degree = k_radians_per_degree;

TEST(Lean, is_forward_uphill_back_downhill_and_nothing_on_the_level) {
    EXPECT_EQ(slope_lean(0), 0);
    EXPECT_NEAR(slope_lean(15 * k_degree) / k_degree, 4.1f, 0.1f);
    EXPECT_NEAR(slope_lean(-15 * k_degree) / k_degree, -1.75f, 0.1f);
    EXPECT_LT(slope_lean(2 * k_degree) / k_degree, 0.3f);
    EXPECT_EQ(slope_lean(35 * k_degree), slope_lean(80 * k_degree));
    for (float slope = -40; slope < 40; slope += 0.25f) {
        const float step = slope_lean((slope + 0.25f) * k_degree) - slope_lean(slope * k_degree);
        EXPECT_GE(step, 0) << slope;
        EXPECT_LT(step, 0.1f * k_degree) << slope;
    }
}

TEST(Lean, feels_the_slope_along_its_way) {
    const Quat uphill = axis_angle({1, 0, 0}, -20 * k_degree);  // ground that rises towards +Z
    EXPECT_NEAR(slope_along({uphill, uphill}, 0) / k_degree, 20, 0.01f);
    EXPECT_NEAR(slope_along({uphill, uphill}, 3.14159265f) / k_degree, -20, 0.01f);
    EXPECT_NEAR(slope_along({uphill, uphill}, 1.5707963f), 0, 1e-5f);
    EXPECT_NEAR(slope_along({uphill, Quat{}}, 0) / k_degree, 10, 0.1f);
    EXPECT_EQ(slope_along({Quat{}, Quat{}}, 0.3f), 0);
}

// On many rigs, for what works with one set of axes only works by chance.
TEST(Lean, turns_the_trunk_and_leaves_legs_and_hanging_arms_as_they_were) {
    constexpr float k_angle = 6 * k_degree;
    for (const test::Rig& rig : test::many_rigs()) {
        SCOPED_TRACE(rig.name);
        const std::vector<Transform>& models = rig.stance;
        const LeanJoints joints = find_lean_joints(*rig.skeleton, models);
        std::vector<Transform> locals(models.size()), leant(models.size());
        model_to_local(*rig.skeleton, models, locals);
        const std::vector<Transform> before = locals;
        lean(joints, rig.skeleton->parents, k_angle, models, locals);
        local_to_model(*rig.skeleton, locals, leant);
        const auto turned = [&](Role role) {
            const auto j = static_cast<std::size_t>(rig.roles[role]);
            return leant[j].rotation * conjugate(models[j].rotation);
        };
        const auto expect_turned = [&](Role role, float angle) {
            if (rig.roles[role] == k_no_joint) return;
            EXPECT_LT(rotation_angle(conjugate(axis_angle({1, 0, 0}, angle)) * turned(role)), 1e-3f) << role_name(role);
        };
        expect_turned(rig.roles[Role::upper_chest] == k_no_joint ? Role::chest : Role::upper_chest, k_angle);
        expect_turned(Role::neck, 0.5f * k_angle);
        for (const Role role : {Role::hips, Role::left_upper_arm, Role::right_upper_arm, Role::left_foot,
                                Role::right_lower_leg, Role::left_hand})
            expect_turned(role, 0);
        EXPECT_GT(leant[static_cast<std::size_t>(rig.roles[Role::head])].translation.z,
                  models[static_cast<std::size_t>(rig.roles[Role::head])].translation.z + 0.02f);
        std::vector<Transform> level = before;
        lean(joints, rig.skeleton->parents, 0, models, level);
        EXPECT_TRUE(std::equal(level.begin(), level.end(), before.begin()));
    }
}

}  // namespace
}  // namespace surefoot
