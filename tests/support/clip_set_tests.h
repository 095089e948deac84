#pragma once
// What every set of clips that we make must hold to. A room's test says which set it is (`make_tested_set`), and
// includes this once.

#include <surefoot/motion/clip_set.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace surefoot {

ClipSet make_tested_set();

namespace {

// All checks work on world positions of joints and of sole points laid out here, not on what the generator believes.
constexpr float k_stature = 1.75f;
constexpr float k_foot_length = 0.152f * k_stature;
constexpr float k_ankle_height = 0.039f * k_stature;

const ClipSet& tested_set() {
    static const ClipSet set = make_tested_set();
    return set;
}

const Motion& clip(const std::string& name) {
    for (const Motion& motion : tested_set().clips)
        if (motion.name == name) return motion;
    throw std::runtime_error("no clip " + name);
}

std::vector<Transform> world(const Motion& motion, int frame) {
    std::vector<Transform> joints(static_cast<std::size_t>(motion.joint_count()));
    world_pose(motion, frame, joints);
    return joints;
}

Transform joint(const std::vector<Transform>& joints, Role role) {
    return joints[static_cast<std::size_t>(tested_set().roles[role])];
}

/// Corners of the shoe: two at the heel, two at the ball, one at the toes' tip.
std::vector<Vec3> sole(const std::vector<Transform>& joints, bool left) {
    const Transform foot = joint(joints, left ? Role::left_foot : Role::right_foot);
    const Transform toes = joint(joints, left ? Role::left_toes : Role::right_toes);
    const float half = 0.5f * 0.055f * k_stature;
    return {transform_point(foot, {-half, -k_ankle_height, -0.25f * k_foot_length}),
            transform_point(foot, {half, -k_ankle_height, -0.25f * k_foot_length}),
            transform_point(foot, {-half, -k_ankle_height, 0.47f * k_foot_length}),
            transform_point(foot, {half, -k_ankle_height, 0.47f * k_foot_length}),
            transform_point(toes, {0, 0, 0.28f * k_foot_length})};
}

float knee_flexion(const std::vector<Transform>& joints, bool left) {
    const Vec3 hip = joint(joints, left ? Role::left_upper_leg : Role::right_upper_leg).translation;
    const Vec3 knee = joint(joints, left ? Role::left_lower_leg : Role::right_lower_leg).translation;
    const Vec3 ankle = joint(joints, left ? Role::left_foot : Role::right_foot).translation;
    return acos(dot(normalized(knee - hip), normalized(ankle - knee))) * k_degrees_per_radian;
}

class EveryClip : public ::testing::TestWithParam<int> {
  protected:
    const Motion& motion() const { return tested_set().clips[static_cast<std::size_t>(GetParam())]; }
};

TEST_P(EveryClip, is_a_sound_motion) { EXPECT_EQ(problem(motion()), ""); }

TEST_P(EveryClip, ends_as_it_began) {
    const Motion& m = motion();
    EXPECT_TRUE(m.cyclic);
    const auto first = m.frame(0), last = m.frame(m.frame_count() - 1);
    for (std::size_t j = 0; j < first.size(); ++j) EXPECT_EQ(first[j], last[j]);
}

TEST_P(EveryClip, moves_no_joint_faster_over_the_seam_than_elsewhere) {
    const Motion& m = motion();
    const int n = m.frame_count() - 1;
    const auto jump = [&](int f) {  // second difference of the pose, a cycle continued
        float worst = 0;
        const auto a = m.frame((f + n - 1) % n), b = m.frame(f % n), c = m.frame((f + 1) % n);
        for (std::size_t j = 0; j < a.size(); ++j)
            worst = std::max(worst, rotation_angle(conjugate(conjugate(a[j].rotation) * b[j].rotation) *
                                                   (conjugate(b[j].rotation) * c[j].rotation)));
        return worst;
    };
    float elsewhere = 0;
    for (int f = 1; f < n; ++f) elsewhere = std::max(elsewhere, jump(f));
    EXPECT_LE(jump(0), elsewhere + 1e-4f);
}

TEST_P(EveryClip, keeps_its_soles_above_the_floor) {
    const Motion& m = motion();
    for (int f = 0; f < m.frame_count(); ++f) {
        const auto joints = world(m, f);
        for (bool left : {true, false})
            for (Vec3 p : sole(joints, left)) EXPECT_GE(p.y, -0.001f) << m.name << " frame " << f;
    }
}

TEST_P(EveryClip, does_not_slide_where_it_stands) {
    const Motion& m = motion();
    constexpr float k_low = 0.015f, k_slow = 0.25f;  // metres and m/s: DESIGN's definition of planted
    float sum = 0;
    int planted = 0;
    for (int f = 1; f < m.frame_count(); ++f)
        for (bool left : {true, false}) {
            const auto before = sole(world(m, f - 1), left), after = sole(world(m, f), left);
            for (std::size_t k = 0; k < after.size(); ++k) {
                const float speed = planar_length(after[k] - before[k]) * m.fps;
                if (before[k].y > k_low || after[k].y > k_low || speed > k_slow) continue;
                sum += speed;
                ++planted;
            }
        }
    ASSERT_GT(planted, m.frame_count());
    EXPECT_LE(sum / static_cast<float>(planted), 0.01f) << m.name;
}

TEST_P(EveryClip, has_some_point_of_a_standing_foot_exactly_still) {
    const Motion& m = motion();
    // In each step between two frames with a sole on the floor, one of its points on the floor must not move at all.
    int steps = 0;
    for (int f = 1; f < m.frame_count(); ++f)
        for (bool left : {true, false}) {
            const auto before = sole(world(m, f - 1), left), after = sole(world(m, f), left);
            float least = 1;
            bool low = false;
            for (std::size_t k = 0; k < after.size(); ++k) {
                const bool touches = before[k].y < 1e-5f && after[k].y < 1e-5f;
                low |= touches;
                if (touches) least = std::min(least, distance(before[k], after[k]));
            }
            if (!low) continue;
            ++steps;
            EXPECT_LT(least, 5e-5f) << m.name << " frame " << f << (left ? " left" : " right");
        }
    EXPECT_GT(steps, m.frame_count() / 3);
}

TEST_P(EveryClip, never_straightens_a_knee_or_bends_it_the_wrong_way) {
    const Motion& m = motion();
    for (int f = 0; f < m.frame_count(); ++f) {
        const auto joints = world(m, f);
        for (bool left : {true, false}) {
            EXPECT_GE(knee_flexion(joints, left), 5) << m.name << " frame " << f;
            EXPECT_LE(knee_flexion(joints, left), 145) << m.name << " frame " << f;
            // The knee lies in front of the line from hip to ankle, as the pelvis sees it.
            const Transform pelvis = inverse(joint(joints, Role::hips));
            const auto seen = [&](Role role) { return transform_point(pelvis, joint(joints, role).translation); };
            const Vec3 hip = seen(left ? Role::left_upper_leg : Role::right_upper_leg);
            const Vec3 knee = seen(left ? Role::left_lower_leg : Role::right_lower_leg);
            const Vec3 ankle = seen(left ? Role::left_foot : Role::right_foot);
            EXPECT_LT(cross(ankle - hip, knee - hip).x, 0) << m.name << " frame " << f;
        }
    }
}

TEST_P(EveryClip, has_a_root_of_constant_velocity_under_its_hips) {
    const Motion& m = motion();
    const RootFrame step = between(m.root[0], m.root[1]);
    Vec3 mean;
    for (int f = 0; f + 1 < m.frame_count(); ++f) {
        const auto at = static_cast<std::size_t>(f);
        const RootFrame other = between(m.root[at], m.root[at + 1]);
        EXPECT_LT(distance(step.position, other.position), 2e-6f);
        EXPECT_NEAR(step.yaw, other.yaw, 2e-6f);
        mean += m.frame(f)[0].translation / static_cast<float>(m.frame_count() - 1);
    }
    EXPECT_LT(planar_length(mean), 0.002f);
}

TEST_P(EveryClip, holds_its_head_level_and_steady) {
    const Motion& m = motion();
    const auto facing = [&](int f) { return rotate(joint(world(m, f), Role::head).rotation, {0, 0, 1}); };
    for (int f = 0; f < m.frame_count(); ++f) {
        EXPECT_LT(std::fabs(facing(f).y), 0.02f);
        const float yaw = wrap_angle(atan2(facing(f).x, facing(f).z) - m.root[static_cast<std::size_t>(f)].yaw);
        EXPECT_LT(std::fabs(yaw), 0.6f);
    }
}

INSTANTIATE_TEST_SUITE_P(ClipSet, EveryClip, ::testing::Range(0, static_cast<int>(make_tested_set().clips.size())),
                         [](const auto& info) {
                             return tested_set().clips[static_cast<std::size_t>(info.param)].name;
                         });

TEST(ClipSet, has_the_clips_a_locomotion_space_wants) {
    std::set<std::string> names;
    for (const Motion& motion : tested_set().clips) {
        EXPECT_TRUE(names.insert(motion.name).second) << motion.name;
        EXPECT_EQ(motion.skeleton, tested_set().skeleton);
        EXPECT_EQ(motion.fps, 60);
    }
    for (const char* name :
         {"idle", "walk", "walk_left", "walk_right", "jog", "jog_left", "jog_right", "run", "run_left", "run_right",
          "back", "back_left", "back_right", "strafe_left", "strafe_right", "turn_left", "turn_right"})
        EXPECT_TRUE(names.count(name)) << name;
}

TEST(ClipSet, travels_at_the_speeds_it_says) {
    struct Row {
        const char* name;
        float forward, lateral, turn;
    };
    const Row rows[] = {{"idle", 0, 0, 0},
                        {"walk", 1.4f, 0, 0},
                        {"walk_left", 1.4f, 0, 45},
                        {"walk_right", 1.4f, 0, -45},
                        {"jog", 2.6f, 0, 0},
                        {"jog_left", 2.6f, 0, 70},
                        {"run", 4.2f, 0, 0},
                        {"run_right", 4.2f, 0, -45},
                        {"back", -1, 0, 0},
                        {"strafe_left", 0, 0.9f, 0},
                        {"strafe_right", 0, -0.9f, 0},
                        {"turn_left", 0, 0, 90},
                        {"turn_right", 0, 0, -90}};
    for (const Row& row : rows) {
        const Motion& m = clip(row.name);
        // Body-frame velocity from the smallest step; the yaw of half a step corrects the chord's direction.
        const RootFrame step = between(m.root[0], m.root[1]);
        const Vec3 moved = rotate(from_yaw(-0.5f * step.yaw), step.position);
        EXPECT_NEAR(moved.z * m.fps, row.forward, 1e-3f) << row.name;
        EXPECT_NEAR(moved.x * m.fps, row.lateral, 1e-3f) << row.name;
        EXPECT_NEAR(m.root.back().yaw / m.duration(), row.turn * k_radians_per_degree, 1e-4f) << row.name;
    }
}

TEST(ClipSet, mirrored_pairs_are_mirror_images_half_a_cycle_apart) {
    const std::map<std::string, std::string> pairs{{"walk_left", "walk_right"},
                                                   {"jog_left", "jog_right"},
                                                   {"run_left", "run_right"},
                                                   {"back_left", "back_right"},
                                                   {"strafe_left", "strafe_right"},
                                                   {"turn_left", "turn_right"},
                                                   {"walk", "walk"},
                                                   {"run", "run"}};
    const Skeleton& skeleton = *tested_set().skeleton;
    const auto other_side = [&](int j) {
        std::string name = skeleton.names[static_cast<std::size_t>(j)];
        if (name.rfind("Left", 0) == 0)
            name.replace(0, 4, "Right");
        else if (name.rfind("Right", 0) == 0)
            name.replace(0, 5, "Left");
        return static_cast<std::size_t>(skeleton.find(name));
    };
    for (const auto& [left, right] : pairs) {
        const Motion &a = clip(left), &b = clip(right);
        const int n = a.frame_count() - 1;
        ASSERT_EQ(b.frame_count() - 1, n);
        std::vector<Transform> models_a(22), models_b(22);
        for (int f = 0; f < n; ++f) {
            local_to_model(skeleton, a.frame(f), models_a);
            local_to_model(skeleton, b.frame((f + n / 2) % n), models_b);
            for (int j = 0; j < a.joint_count(); ++j) {
                const Transform &p = models_a[static_cast<std::size_t>(j)], &q = models_b[other_side(j)];
                EXPECT_LT(distance({-p.translation.x, p.translation.y, p.translation.z}, q.translation), 1e-4f)
                    << left << " frame " << f << " " << skeleton.names[static_cast<std::size_t>(j)];
                const Quat mirror{p.rotation.x, -p.rotation.y, -p.rotation.z, p.rotation.w};
                EXPECT_GT(std::fabs(dot(mirror, q.rotation)), 1 - 1e-5f);
            }
        }
    }
}

TEST(ClipSet, arms_swing_against_the_legs) {
    for (const char* name : {"walk", "jog", "run"}) {
        const Motion& m = clip(name);
        float together = 0;
        for (int f = 0; f + 1 < m.frame_count(); ++f) {
            const auto joints = world(m, f);
            const auto ahead = [&](Role left, Role right) {
                return joint(joints, left).translation.z - joint(joints, right).translation.z;
            };
            together += ahead(Role::left_hand, Role::right_hand) * ahead(Role::left_foot, Role::right_foot);
        }
        EXPECT_LT(together, 0) << name;
    }
}

TEST(ClipSet, runs_fly_and_walks_do_not) {
    const auto share_in_the_air = [](const Motion& m) {
        int flying = 0;
        for (int f = 0; f + 1 < m.frame_count(); ++f) {
            const auto joints = world(m, f);
            float lowest = 1;
            for (bool left : {true, false})
                for (Vec3 p : sole(joints, left)) lowest = std::min(lowest, p.y);
            flying += lowest > 0.002f;
        }
        return static_cast<float>(flying) / static_cast<float>(m.frame_count() - 1);
    };
    EXPECT_EQ(share_in_the_air(clip("walk")), 0);
    EXPECT_EQ(share_in_the_air(clip("turn_left")), 0);
    EXPECT_GT(share_in_the_air(clip("jog")), 0.05f);
    EXPECT_GT(share_in_the_air(clip("run")), share_in_the_air(clip("jog")));
}

TEST(ClipSet, is_the_same_every_time) {
    const ClipSet again = make_tested_set();
    for (std::size_t i = 0; i < again.clips.size(); ++i) {
        EXPECT_EQ(again.clips[i].locals, tested_set().clips[i].locals);
        EXPECT_EQ(again.clips[i].root, tested_set().clips[i].root);
    }
}

}  // namespace
}  // namespace surefoot
