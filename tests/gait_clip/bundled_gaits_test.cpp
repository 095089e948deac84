// The bundled gaits beyond walking: what each promises, in the world, on the adult for whom gaits are written.

#include <surefoot/gait_clip/gait_clip.h>

#include "tests/support/rigs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

const GaitActor& adult() {
    static const GaitActor actor = [] {
        const test::Rig rig = test::many_rigs().front();
        RoleReport roles;
        roles.roles = rig.roles;
        return make_gait_actor(rig.skeleton, roles, rig.legs, {}, rig.name);
    }();
    return actor;
}

/// A gait's cycle as world poses, frame by frame.
struct Stage {
    AnalyzedClip clip;
    std::vector<std::vector<Transform>> world;
    float duration = 0;

    Vec3 at(int frame, Role role) const {
        return world[static_cast<std::size_t>(frame)][static_cast<std::size_t>(clip.roles.roles[role])].translation;
    }
    SolePoints sole(int frame, Side side) const {
        const Leg& leg = clip.legs[side];
        const std::vector<Transform>& pose = world[static_cast<std::size_t>(frame)];
        return sole_points(leg, pose[static_cast<std::size_t>(leg.foot)], pose[static_cast<std::size_t>(leg.toes)]);
    }
    float lowest(int frame) const {
        float low = 10;
        for (const Side side : {Side::left, Side::right}) {
            const SolePoints p = sole(frame, side);
            low = std::min({low, p.heel.y, p.ball.y, p.toe_tip.y});
        }
        return low;
    }
    int frames() const { return static_cast<int>(world.size()); }
    float phase(int frame) const { return static_cast<float>(frame) / static_cast<float>(frames() - 1); }
};

Stage stage(const std::string& name, const std::string& preset = "", const GaitPlay& play = {}) {
    const Gait gait = read_gait(bundled_gait(name), name + ".gait");
    EXPECT_TRUE(bind_gait(gait).unknown.empty()) << name << ": " << bind_gait(gait).unknown.front();
    EXPECT_TRUE(gait.warnings.empty()) << gait.warnings.front();
    Stage s{play_gait(gait, gait_values(gait, preset, {}), adult(), play), {}, 0};
    for (int f = 0; f < s.clip.motion.frame_count(); ++f) {
        s.world.emplace_back(static_cast<std::size_t>(s.clip.motion.joint_count()));
        world_pose(s.clip.motion, f, s.world.back());
    }
    s.duration = s.clip.motion.duration();
    return s;
}

/// How far a point strays from where it first was, over the frames of a range of phases.
template <class Point>
float stray(const Stage& s, float from, float to, Point point) {
    float most = 0;
    bool first = true;
    Vec3 start;
    for (int f = 0; f < s.frames(); ++f) {
        if (s.phase(f) < from || s.phase(f) > to) continue;
        if (first) start = point(f);
        first = false;
        most = std::max(most, distance(point(f), start));
    }
    EXPECT_FALSE(first);
    return most;
}

TEST(BundledGaits, all_of_them_with_all_presets_move_smoothly_and_close) {
    const std::string_view names = bundled_gait_names();
    int count = 0;
    for (std::size_t at = 0; at < names.size(); at = names.find('\n', at) + 1) {
        const std::string name(names.substr(at, names.find('\n', at) - at));
        if (name == "bhatti2017_as_printed") continue;  // which is as it is
        std::vector<std::string> presets{""};
        for (const GaitPreset& preset : read_gait(bundled_gait(name), name).presets) presets.push_back(preset.name);
        for (const std::string& preset : presets) {
            const Stage s = stage(name, preset);
            ++count;
            EXPECT_LT(s.clip.facts.seam, 1e-3f) << name << " " << preset;
            for (int f = 1; f < s.frames(); ++f)
                for (int j = 0; j < s.clip.motion.joint_count(); ++j) {
                    const std::size_t joint = static_cast<std::size_t>(j);
                    const Quat turned = normalized(conjugate(s.clip.motion.frame(f - 1)[joint].rotation) *
                                                   s.clip.motion.frame(f)[joint].rotation);
                    EXPECT_LT(rotation_angle(turned) * s.clip.motion.fps, 26)
                        << name << " " << preset << " frame " << f << " " << s.clip.motion.skeleton->names[joint];
                }
        }
    }
    EXPECT_GE(count, 25);
}

TEST(BundledGaits, a_run_and_a_jog_leave_the_ground_twice_a_cycle_and_a_walk_never_does) {
    for (const auto& [preset, flights] : {std::pair{"run", 2}, {"jog", 2}, {"normal_walk", 0}, {"crouch_walk", 0}}) {
        const Stage s = stage("bhatti2017", preset);
        int found = 0;
        for (int f = 1; f < s.frames(); ++f) found += s.lowest(f) > 0.002f && s.lowest(f - 1) <= 0.002f;
        EXPECT_EQ(found, flights) << preset;
    }
}

TEST(BundledGaits, on_stairs_feet_stand_on_treads_and_never_cut_into_them) {
    for (const std::string preset : {"", "down", "steep"}) {
        const Stage s = stage("stairs", preset, {.cycles = 2});
        const Vec3 end = s.clip.motion.root.back().position;
        const float riser = preset == "steep" ? 0.22f : preset == "down" ? -0.17f : 0.17f;
        const float tread = preset == "steep" ? 0.24f : 0.28f;
        EXPECT_NEAR(end.z, 4 * tread, 1e-3f) << preset;
        EXPECT_NEAR(end.y, 4 * riser, 1e-3f) << preset;
        // The left foot's second stance begins in the middle of the clip; its ball is still until the foot leaves.
        const float still =
            stray(s, 0.5f + 0.13f / 2, 0.5f + 0.6f / 2, [&](int f) { return s.sole(f, Side::left).ball; });
        EXPECT_LT(still, 0.002f) << preset;
        // Each stair is as deep as a tread and its edge lies half a tread before the middle of the foot's place.
        const float stand = s.sole(static_cast<int>(0.65f * static_cast<float>(s.frames() - 1)), Side::left).ball.y;
        const float next = s.sole(static_cast<int>(0.9f * static_cast<float>(s.frames() - 1)), Side::right).ball.y;
        EXPECT_NEAR(next - stand, riser, 0.003f) << preset;
    }
}

TEST(BundledGaits, a_jump_flies_like_a_stone_and_lands_as_it_left) {
    const Stage s = stage("jump", "", {.fps = 120});
    const float flight = 2 * std::sqrt(2 * 0.3f / 9.81f);
    int up = 0;
    float top = 0, leave = 0;
    for (int f = 0; f < s.frames(); ++f) {
        up += s.lowest(f) > 0.003f;
        if (s.lowest(f) <= 0.003f && s.phase(f) > 0.5f) leave = s.at(f, Role::hips).y;
        top = std::max(top, s.at(f, Role::hips).y);
    }
    EXPECT_NEAR(static_cast<float>(up) / s.clip.motion.fps, flight, 0.06f);
    EXPECT_NEAR(top - leave, 0.3f, 0.04f);
    EXPECT_NEAR(s.clip.motion.root.back().position.z, 0.6f, 1e-3f);
    EXPECT_LT(stray(s, 0.1f, 0.55f, [&](int f) { return s.sole(f, Side::left).ball; }), 0.002f);
    for (int f = 0; f < s.frames(); ++f) EXPECT_GT(s.lowest(f), -0.001f) << f;
}

TEST(BundledGaits, a_climbers_hands_and_feet_hold_still_rungs_while_the_root_goes_up) {
    const Stage s = stage("climb");
    EXPECT_NEAR(s.clip.motion.root.back().position.y, 0.56f, 1e-3f);
    EXPECT_NEAR(s.clip.motion.root.back().position.z, 0, 1e-5f);
    EXPECT_LT(stray(s, 0.02f, 0.62f, [&](int f) { return s.sole(f, Side::left).ball; }), 0.004f);
    EXPECT_LT(stray(s, 0.02f, 0.62f, [&](int f) { return s.at(f, Role::right_hand); }), 0.004f);
    EXPECT_LT(stray(s, 0.52f, 1.0f, [&](int f) { return s.sole(f, Side::right).ball; }), 0.004f);
    EXPECT_LT(stray(s, 0.52f, 1.0f, [&](int f) { return s.at(f, Role::left_hand); }), 0.004f);
}

TEST(BundledGaits, a_cyclists_feet_go_round_with_the_pedals_and_hips_stay_on_the_saddle) {
    const Stage s = stage("cycling");
    for (int f = 0; f < s.frames(); ++f) {
        const Vec3 root = s.clip.motion.root[static_cast<std::size_t>(f)].position;
        const Vec3 left = s.sole(f, Side::left).ball - root, right = s.sole(f, Side::right).ball - root;
        const float radius = std::sqrt(left.z * left.z + (left.y - 0.28f) * (left.y - 0.28f));
        EXPECT_NEAR(radius, 0.17f, 0.003f) << f;
        EXPECT_NEAR(left.y + right.y, 0.56f, 0.003f) << f;
        EXPECT_NEAR(left.z + right.z, 0, 0.003f) << f;
        EXPECT_LT(distance(s.at(f, Role::hips) - root, s.at(0, Role::hips)), 0.04f) << f;
        EXPECT_LT(distance(s.at(f, Role::left_hand) - root, s.at(0, Role::left_hand)), 0.002f) << f;
    }
    EXPECT_NEAR(s.clip.motion.root.back().position.z, 4.6f, 1e-3f);
    const Stage fast = stage("cycling", "", {.speed_mps = 8});
    EXPECT_NEAR(fast.duration, 4.6f / 8, 0.01f);
}

}  // namespace
}  // namespace surefoot
