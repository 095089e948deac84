// Roles, root motion and edits on clips made by others (skipped where they are absent).

#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>

#include "tests/support/motion_data.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<Transform> rest_models(const Skeleton& skeleton) {
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    return models;
}

std::vector<LoadedClip> load(const std::filesystem::path& path) {
    const std::string paths[] = {path.string()};
    LoadResult result = load_clips(paths);
    for (const LoadFailure& failure : result.failed) ADD_FAILURE() << failure.file << ": " << failure.error;
    return std::move(result.clips);
}

// A pose that shows the shape: the rest pose where the rig has one, else the clip's first frame.
std::vector<Transform> shape_of(const Motion& motion, const std::filesystem::path& path) {
    if (path.string().find("Cesium") != std::string::npos || path.string().find("ual1") != std::string::npos)
        return rest_models(*motion.skeleton);
    std::vector<Transform> models(motion.skeleton->rest.size());
    world_pose(motion, 0, models);
    return models;
}

// One clip of every rig in the collection, chosen to begin upright.
std::vector<std::filesystem::path> one_of_each(const std::filesystem::path& folder) {
    return {folder / "cmu_bvh/07_01.bvh",
            folder / "cmu_bvh/06_06_iclone.bvh",
            folder / "o3de_mocap_bvh/Walk1.bvh",
            folder / "ual1_locomotion_glb/UAL1_50clips_mannequin.glb#Walk_Loop",
            folder / "ual1_locomotion_glb/basic_vrm_names/walk.glb",
            folder / "characters_glb/Cesium_Man.glb",
            folder / "characters_glb/gdquest_mannequiny.glb#idle"};
}

TEST(real_rigs, legs_spine_head_and_arms_are_mapped_and_left_is_left_of_the_feet) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const auto& path : one_of_each(folder)) {
        const std::vector<LoadedClip> clips = load(path);
        ASSERT_FALSE(clips.empty()) << path;
        const Motion& motion = clips[0].motion;
        const RoleReport report = find_roles(*motion.skeleton, rest_models(*motion.skeleton));
        EXPECT_TRUE(report.roles.has_legs()) << path;
        for (const Role role : {Role::spine, Role::chest, Role::neck, Role::head, Role::left_upper_arm,
                                Role::left_lower_arm, Role::left_hand, Role::right_upper_arm, Role::right_lower_arm,
                                Role::right_hand, Role::left_toes, Role::right_toes})
            EXPECT_TRUE(report.roles.has(role)) << path << " " << role_name(role);
        const std::vector<Transform> world = shape_of(motion, path);
        const auto place = [&](Role role) { return world[at(report.roles[role])].translation; };
        EXPECT_GT(place(Role::head).y, place(Role::hips).y) << path;
        EXPECT_GT(place(Role::hips).y, place(Role::left_lower_leg).y) << path;
        const Vec3 ahead =
            place(Role::left_toes) - place(Role::left_foot) + place(Role::right_toes) - place(Role::right_foot);
        const Vec3 left = place(Role::left_upper_leg) - place(Role::right_upper_leg);
        EXPECT_GT(dot(cross(k_up, ahead), left), 0) << path;
        const Quat facing = from_yaw(torso_yaw(report.roles, world));
        EXPECT_GT(dot(rotate(facing, {0, 0, 1}), ahead), 0) << path;
    }
}

TEST(real_rigs, shape_finds_the_same_joints_as_names_do) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const auto& path : one_of_each(folder)) {
        const std::vector<LoadedClip> clips = load(path);
        ASSERT_FALSE(clips.empty()) << path;
        const Motion& motion = clips[0].motion;
        const RoleReport named = find_roles(*motion.skeleton, rest_models(*motion.skeleton));
        Skeleton nameless = *motion.skeleton;
        for (int j = 0; j < nameless.joint_count(); ++j) nameless.names[at(j)] = "x_" + std::to_string(j);
        const RoleReport shaped = find_roles(nameless, shape_of(motion, path));
        EXPECT_EQ(shaped.convention, "shape");
        for (const Role role :
             {Role::hips, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot, Role::left_toes,
              Role::right_upper_leg, Role::right_lower_leg, Role::right_foot, Role::right_toes, Role::head,
              Role::left_upper_arm, Role::left_lower_arm, Role::left_hand, Role::right_upper_arm, Role::right_lower_arm,
              Role::right_hand, Role::spine}) {
            const auto name = [&](const RoleReport& r) {
                return r.roles.has(role) ? motion.skeleton->names[at(r.roles[role])] : std::string("-");
            };
            EXPECT_EQ(name(shaped), name(named)) << path << " " << role_name(role);
        }
    }
}

TEST(real_motion, extraction_keeps_the_speed_of_cmu_walks_within_one_percent) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    int walks = 0;
    for (const LoadedClip& clip : load(folder / "cmu_bvh")) {
        if (clip.file.find("/07_") == std::string::npos) continue;
        Motion motion = clip.motion;
        const RoleMap roles = find_roles(*motion.skeleton, rest_models(*motion.skeleton)).roles;
        std::vector<Transform> first(at(motion.joint_count())), last = first;
        world_pose(motion, 0, first);
        world_pose(motion, motion.frame_count() - 1, last);
        const std::size_t hips = at(roles[Role::hips]);
        const float expected = planar_length(last[hips].translation - first[hips].translation) / motion.duration();
        extract_root_motion(motion, roles);
        const float obtained =
            planar_length(motion.root.back().position - motion.root.front().position) / motion.duration();
        EXPECT_NEAR(obtained / expected, 1.0f, 0.01f) << clip.file;
        ++walks;
        std::vector<Transform> again(at(motion.joint_count()));
        world_pose(motion, 0, again);
        for (std::size_t j = 0; j < again.size(); ++j)
            EXPECT_LT(distance(again[j].translation, first[j].translation), 1e-4f) << clip.file;
    }
    EXPECT_EQ(walks, 12);
}

TEST(real_motion, extraction_keeps_world_poses_of_long_takes) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::vector<LoadedClip> clips = load(folder / "o3de_mocap_bvh/Snake1.bvh");
    ASSERT_EQ(clips.size(), 1u);
    Motion motion = clips[0].motion;
    const RoleMap roles = find_roles(*motion.skeleton, rest_models(*motion.skeleton)).roles;
    extract_root_motion(motion, roles);
    std::vector<Transform> before(at(motion.joint_count())), after = before;
    const int root = motion.skeleton->find("Root");
    float worst = 0, lean = 0;
    for (int f = 0; f < motion.frame_count(); f += 7) {
        world_pose(clips[0].motion, f, before);
        world_pose(motion, f, after);
        for (int j = 0; j < motion.joint_count(); ++j)
            if (j != root) worst = std::fmax(worst, distance(before[at(j)].translation, after[at(j)].translation));
        lean = std::fmax(lean, planar_length(after[at(roles[Role::hips])].translation - motion.root[at(f)].position));
        EXPECT_LT(distance(after[at(root)].translation, motion.root[at(f)].position), 1e-4f);
    }
    EXPECT_LT(worst, 1e-4f);
    EXPECT_LT(lean, 0.25f);  // the path stays under the hips through starts and turns
}

TEST(real_motion, mirrored_clips_are_reflections_and_mirroring_twice_is_identity) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    for (const auto& path : one_of_each(folder)) {
        const std::vector<LoadedClip> clips = load(path);
        ASSERT_FALSE(clips.empty()) << path;
        const Motion motion = cut(clips[0].motion, 0, 200);
        const RoleMap roles = find_roles(*motion.skeleton, rest_models(*motion.skeleton)).roles;
        const Motion image = mirror(motion, roles), twice = mirror(image, roles);
        const std::vector<int> pairs = mirror_pairs(*motion.skeleton, roles);
        std::vector<Transform> a(at(motion.joint_count())), b = a, c = a;
        float worst = 0, worst_twice = 0;
        std::string where;
        for (int f = 0; f < motion.frame_count(); f += 4) {
            world_pose(motion, f, a);
            world_pose(image, f, b);
            world_pose(twice, f, c);
            for (std::size_t j = 0; j < a.size(); ++j) {
                const Vec3 p = a[at(pairs[j])].translation;
                const float off = distance(b[j].translation, {-p.x, p.y, p.z});
                if (off > worst) worst = off, where = motion.skeleton->names[j];
                worst_twice = std::fmax(worst_twice, distance(a[j].translation, c[j].translation));
            }
        }
        // Bodies of real actors, and a few hand-made rigs, are not quite symmetric.
        EXPECT_LT(worst, 0.05f) << path << " " << where;
        EXPECT_LT(worst_twice, 1e-4f) << path;
        RecordProperty(path.filename().string(), std::to_string(worst));
        std::printf("  %s: off the reflection by %.1f mm at %s\n", path.filename().c_str(),
                    1e3 * static_cast<double>(worst), where.c_str());
    }
}

}  // namespace
}  // namespace surefoot
