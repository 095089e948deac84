// Known glitches are put into real clips and must come out again; sound clips must come back as they are.

#include <surefoot/motion/clean.h>

#include <surefoot/analysis/footing.h>
#include <surefoot/base/random.h>
#include <surefoot/io/load.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/motion_data.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Motion load_one(const std::filesystem::path& path) {
    const std::string file = path.string();
    LoadResult loaded = load_clips({&file, 1});
    EXPECT_EQ(loaded.clips.size(), 1u) << file;
    return std::move(loaded.clips.at(0).motion);
}

/// Clips of two makers (a slow and a fast one of each) that hold no glitch but toes in the floor. Those of the CMU
/// database hold many.
std::vector<Motion> sound_clips(const std::filesystem::path& folder) {
    std::vector<Motion> clips;
    for (const char* name : {"Walk1", "Run1"})
        clips.push_back(load_one(folder / "o3de_mocap_bvh" / (std::string(name) + ".bvh")));
    for (const char* name : {"Walk_Loop", "Jog_Fwd_Loop"})
        clips.push_back(load_one(folder / "ual1_locomotion_glb" / ("UAL1_50clips_mannequin.glb#" + std::string(name))));
    return clips;
}

int joint_of(const Motion& motion, Role role) {
    std::vector<Transform> models(at(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.skeleton->rest, models);
    const RoleMap roles = find_roles(*motion.skeleton, models).roles;
    EXPECT_TRUE(roles.has(role)) << motion.name;
    return std::max(0, roles[role]);
}

float angle(const Motion& a, const Motion& b, int frame, int joint) {
    return k_degrees_per_radian *
           rotation_angle(conjugate(a.frame(frame)[at(joint)].rotation) * b.frame(frame)[at(joint)].rotation);
}

/// RMS angle [deg] between two versions of a joint over some frames.
float error(const Motion& a, const Motion& b, int joint, int first, int last) {
    float sum = 0;
    for (int f = first; f <= last; ++f) sum += angle(a, b, f, joint) * angle(a, b, f, joint);
    return std::sqrt(sum / static_cast<float>(last - first + 1));
}

/// Frames outside [first, last] must keep their bits.
void expect_untouched(const Motion& broken, const Motion& mended, int first, int last) {
    for (int f = 0; f < broken.frame_count(); ++f) {
        if (f >= first && f <= last) continue;
        const auto a = broken.frame(f), b = mended.frame(f);
        for (std::size_t j = 0; j < a.size(); ++j) ASSERT_TRUE(a[j] == b[j]) << mended.name << " frame " << f;
    }
}

void turn_joint(Motion& motion, int frame, int joint, Quat by) {
    Quat& q = motion.frame(frame)[at(joint)].rotation;
    q = normalized(q * by);
}

TEST(clean, sound_clips_come_back_bit_for_bit) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    std::vector<Motion> clips = sound_clips(folder);
    ClipSet set = make_synthetic_set();
    std::move(set.clips.begin(), set.clips.end(), std::back_inserter(clips));
    for (const Motion& clip : clips) {
        Motion same = clip;
        const auto repairs = clean(same);
        for (const GlitchRepair& repair : repairs)
            ADD_FAILURE() << clip.name << ": " << describe(repair, *clip.skeleton);
        EXPECT_TRUE(same.locals == clip.locals) << clip.name;
        EXPECT_TRUE(same.root == clip.root) << clip.name;
    }
}

TEST(clean, a_spike_is_taken_out_and_nothing_else_is_touched) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const Motion& sound : sound_clips(folder))
        for (const int length : {1, 2, 3}) {
            if (length > 1 && sound.fps < 45) continue;  // two frames of 30 Hz are half a step
            const int joint = joint_of(sound, Role::left_lower_leg), first = sound.frame_count() / 2,
                      last = first + length - 1;
            Motion broken = sound;
            // What counts as a jump depends on how far joints get within a frame.
            const float size = 0.8f * std::max(1.0f, 60 / sound.fps);
            for (int f = first; f <= last; ++f) turn_joint(broken, f, joint, axis_angle({0.6f, 0.0f, 0.8f}, size));
            Motion mended = broken;
            const auto repairs = clean(mended);
            ASSERT_EQ(repairs.size(), 1u) << sound.name << " length " << length;
            EXPECT_EQ(repairs[0].kind, Glitch::spike);
            EXPECT_EQ(repairs[0].joint, joint);
            EXPECT_EQ(repairs[0].first, first);
            EXPECT_EQ(repairs[0].last, last);
            expect_untouched(broken, mended, first, last);
            const float was = error(sound, broken, joint, first, last), is = error(sound, mended, joint, first, last);
            EXPECT_LT(is, was / 10) << sound.name << " length " << length << ": " << was << " -> " << is << " deg";
        }
}

TEST(clean, hips_that_jump_for_a_frame_are_put_back) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const Motion& sound : sound_clips(folder)) {
        const int hips = joint_of(sound, Role::hips);
        const int frame = sound.frame_count() / 3;
        Motion broken = sound;
        broken.frame(frame)[at(hips)].translation += Vec3{0.3f, 0.1f, -0.2f};
        Motion mended = broken;
        const auto repairs = clean(mended);
        ASSERT_EQ(repairs.size(), 1u) << sound.name;
        EXPECT_EQ(repairs[0].first, frame);
        EXPECT_LT(distance(mended.frame(frame)[at(hips)].translation, sound.frame(frame)[at(hips)].translation), 0.01f);
        expect_untouched(broken, mended, frame, frame);
    }
}

TEST(clean, a_joint_flipped_for_a_while_is_turned_back) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const Motion& sound : sound_clips(folder))
        for (const bool in_parent : {false, true}) {
            const int joint = joint_of(sound, Role::left_hand);
            const int first = sound.frame_count() / 3, last = first + static_cast<int>(0.25f * sound.fps);
            const Quat flip = axis_angle(normalized(Vec3{1, 0.2f, 0}), 3.0f);
            Motion broken = sound;
            for (int f = first; f <= last; ++f) {
                Quat& q = broken.frame(f)[at(joint)].rotation;
                q = normalized(in_parent ? flip * q : q * flip);
            }
            Motion mended = broken;
            const auto repairs = clean(mended);
            ASSERT_EQ(repairs.size(), 1u) << sound.name;
            EXPECT_EQ(repairs[0].kind, Glitch::flip);
            EXPECT_EQ(repairs[0].first, first);
            EXPECT_EQ(repairs[0].last, last);
            expect_untouched(broken, mended, first, last);
            EXPECT_LT(error(sound, mended, joint, first, last), error(sound, broken, joint, first, last) / 20);
        }
}

TEST(clean, dropped_frames_are_filled_in) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const Motion& sound : sound_clips(folder)) {
        const int length = std::max(2, static_cast<int>(0.06f * sound.fps));
        const int first = sound.frame_count() / 2 + 3, last = first + length - 1,
                  joint = joint_of(sound, Role::left_lower_leg);
        Motion broken = sound;
        for (int f = first; f <= last; ++f) {
            std::copy(sound.frame(first - 1).begin(), sound.frame(first - 1).end(), broken.frame(f).begin());
            broken.root[at(f)] = sound.root[at(first - 1)];
        }
        Motion mended = broken;
        const auto repairs = clean(mended);
        ASSERT_EQ(repairs.size(), 1u) << sound.name;
        EXPECT_EQ(repairs[0].kind, Glitch::dropped);
        EXPECT_EQ(repairs[0].first, first);
        EXPECT_EQ(repairs[0].last, last);
        expect_untouched(broken, mended, first, last);
        const float was = error(sound, broken, joint, first, last), is = error(sound, mended, joint, first, last);
        EXPECT_LT(is, was / (sound.fps < 45 ? 2 : 4)) << sound.name << ": " << was << " -> " << is << " deg";
    }
}

TEST(clean, a_trembling_joint_is_smoothed) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const Motion& sound : sound_clips(folder)) {
        if (sound.fps < 45) continue;
        const int joint = joint_of(sound, Role::left_lower_arm), first = sound.frame_count() / 2, last = first + 24;
        Random random(5);
        Motion broken = sound;
        for (int f = first; f <= last; ++f) {
            const auto noise = [&] { return 0.07f * (2 * random.unit() - 1); };
            turn_joint(broken, f, joint, from_rotation_vector({noise(), noise(), noise()}));
        }
        Motion mended = broken;
        const auto repairs = clean(mended);
        ASSERT_FALSE(repairs.empty()) << sound.name;
        for (const GlitchRepair& repair : repairs) {
            EXPECT_EQ(repair.joint, joint);
            EXPECT_GE(repair.first, first - 6);
            EXPECT_LE(repair.last, last + 6);
        }
        const float was = error(sound, broken, joint, first, last), is = error(sound, mended, joint, first, last);
        EXPECT_LT(is, was / 1.7f) << sound.name << ": " << was << " -> " << is << " deg";
        expect_untouched(broken, mended, first - 6, last + 6);
    }
}

TEST(clean, captured_toes_come_out_of_the_floor) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    Motion motion = load_one(folder / "o3de_mocap_bvh/Walk1.bvh");
    std::vector<Transform> models(at(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.skeleton->rest, models);
    const RoleMap roles = find_roles(*motion.skeleton, models).roles;
    const Footing footing = find_footing(motion, roles, make_tracks(motion, roles));
    // Frames in which a toe tip is more than 5 mm under the floor, and how deep the deepest is.
    const auto sunk = [&] {
        std::pair<int, float> result{0, 0.0f};
        for (int f = 0; f < motion.frame_count(); ++f) {
            world_pose(motion, f, models);
            for (const Leg& leg : footing.legs.side) {
                const float depth = footing.floor - transform_point(models[at(leg.toes)], leg.toe_tip).y;
                result.first += depth > 0.0051f;
                result.second = std::max(result.second, depth);
            }
        }
        return result;
    };
    const auto before = sunk();
    CleanOptions options;
    options.legs = &footing.legs;
    options.floor = footing.floor;
    const auto repairs = clean(motion, options);
    const auto after = sunk();
    std::printf("  %zu repairs; frames with a sunken toe %d -> %d, deepest %.1f -> %.1f cm\n", repairs.size(),
                before.first, after.first, 100.0 * before.second, 100.0 * after.second);
    EXPECT_GT(before.first, 300);
    EXPECT_LT(after.first, before.first / 10);  // those that point straight down: toes bend by 60 degrees, not more
    EXPECT_LT(after.second, before.second / 2);
    for (const GlitchRepair& repair : repairs) EXPECT_EQ(repair.kind, Glitch::toes);
}

}  // namespace
}  // namespace surefoot
