// Retargeting real clips of real rigs onto one another, measured as any clip is (skipped where they are absent).

#include <surefoot/analysis/contacts.h>
#include <surefoot/author/gather.h>
#include <surefoot/author/retarget_clips.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>
#include <surefoot/synthetic/biped.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/motion_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace surefoot {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// One clip of a file, measured; long takes are cut to `frames`.
AnalyzedClip read(const std::filesystem::path& path, int frames = 600) {
    const std::string paths[] = {path.string()};
    LoadOptions options;
    options.still = true;
    LoadResult result = load_clips(paths, options);
    for (const LoadFailure& failure : result.failed) ADD_FAILURE() << failure.file << ": " << failure.error;
    if (result.clips.empty()) throw std::runtime_error("no clip: " + path.string());
    Motion motion = std::move(result.clips.front().motion);
    if (motion.frame_count() > frames) motion = cut(motion, 0, frames - 1);
    return analyze_clip(std::move(motion), path.filename().string());
}

AnalyzedClip generated(const std::string& name) {
    ClipSet set = make_synthetic_set();
    for (Motion& motion : set.clips)
        if (motion.name == name) return analyze_clip(std::move(motion), name);
    throw std::runtime_error("no such clip");
}

/// Planted skate of the clip as if all of it were larger: thresholds of what is planted are absolute.
float skate_at_scale(const AnalyzedClip& clip, float scale) {
    Tracks tracks = make_tracks(clip.motion, clip.roles.roles);
    add_soles(tracks, clip.legs);
    if (clip.motion.cyclic) tracks = repeated(tracks, clip.motion.root.front(), clip.motion.root.back());
    for (FootTrack& foot : tracks.foot)
        for (std::vector<Vec3>* points : {&foot.heel, &foot.mid, &foot.ball, &foot.tip})
            for (Vec3& point : *points) point *= scale;
    return planted_skate(tracks);
}

float leg_length(const AnalyzedClip& clip) {
    return 0.5f * (clip.legs[Side::left].length() + clip.legs[Side::right].length());
}

/// The clip with the soles that retargeting believes, on the ground that they show.
AnalyzedClip grounded(AnalyzedClip clip) {
    const Actor actor = actor_of(clip);
    bring_to_ground(clip.motion, actor.body, {clip.legs, 0, false});
    clip.legs = actor.body.legs;
    return clip;
}

/// What a viewer would see of one clip.
struct Look {
    std::array<std::vector<float>, 2> lowest;  // [m] sole point of each foot, root space
    std::array<std::vector<float>, 2> knee;    // [m] how far the knee stands before the line from hip to ankle
    std::map<Role, float> turning;             // [rad/s] the fastest that a joint turns
};

Look look_at(const AnalyzedClip& clip) {
    Look look;
    const Motion& motion = clip.motion;
    std::vector<Transform> models(motion.skeleton->rest.size()), before;
    for (int f = 0; f < motion.frame_count(); ++f) {
        local_to_model(*motion.skeleton, motion.frame(f), models);
        for (std::size_t s = 0; s < 2; ++s) {
            const Leg& leg = clip.legs.side[s];
            const Transform foot = models[at(leg.foot)];
            const SolePoints sole = sole_points(leg, foot, leg.toes < 0 ? foot : models[at(leg.toes)]);
            look.lowest[s].push_back(std::min({sole.heel.y, sole.ball.y, sole.toe_tip.y}));
            // Ahead of the leg is where its foot points, as seen along the leg.
            const Vec3 hip = models[at(leg.upper)].translation, line = normalized(foot.translation - hip);
            const Vec3 left = models[at(clip.legs[Side::left].upper)].translation -
                              models[at(clip.legs[Side::right].upper)].translation;
            const Vec3 ahead = normalized(cross(line, left));
            look.knee[s].push_back(dot(models[at(leg.lower)].translation - hip, ahead));
        }
        if (f > 0)
            for (int r = 0; r <= static_cast<int>(Role::right_toes); ++r) {
                const Role role = static_cast<Role>(r);
                if (!clip.roles.roles.has(role)) continue;
                const std::size_t j = at(clip.roles.roles[role]);
                const float step = rotation_angle(conjugate(before[j].rotation) * models[j].rotation) * motion.fps;
                look.turning[role] = std::max(look.turning[role], step);
            }
        before = models;
    }
    return look;
}

struct Pair {
    std::string from, to;
};

struct Quality {
    float sunk = 0, floating = 0, knee = 0, flip = 0;
    std::string flipping;
};

Quality compare(const AnalyzedClip& source, const AnalyzedClip& result, float scale) {
    Quality q;
    const Look from = look_at(source), to = look_at(result);
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t f = 0; f < to.lowest[s].size(); ++f) {
            q.sunk = std::max(q.sunk, std::min(0.0f, scale * from.lowest[s][f]) - to.lowest[s][f]);
            if (source.facts.contacts[s][f] != Contact::lifted)
                q.floating = std::max(q.floating, to.lowest[s][f] - std::max(0.0f, scale * from.lowest[s][f]));
            q.knee = std::max(q.knee, std::min(0.0f, scale * from.knee[s][f]) - to.knee[s][f]);
        }
    // Spines of other joint counts share the turn otherwise: any joint may turn as fast as the fastest of the source's.
    const auto is_trunk = [](Role role) { return role <= Role::head; };
    float trunk = 0;
    for (const auto& [role, speed] : from.turning)
        if (is_trunk(role)) trunk = std::max(trunk, speed);
    for (const auto& [role, speed] : to.turning) {
        const auto theirs = from.turning.find(role);
        if (theirs == from.turning.end()) continue;
        const float more = speed / ((is_trunk(role) ? trunk : theirs->second) + 2);
        if (more > q.flip) q.flip = more, q.flipping = std::string(role_name(role));
    }
    return q;
}

void expect_good(const AnalyzedClip& source, const AnalyzedClip& target, const std::string& name) {
    RetargetReport report;
    const Actor actor = actor_of(source);
    const AnalyzedClip result = retargeted(source, actor, actor_of(target), &report);
    const AnalyzedClip standing = grounded(source);
    const ClipFacts &a = source.facts, &b = result.facts;
    EXPECT_NEAR(report.scale, leg_length(target) / leg_length(source), 1e-5f) << name;
    const Quality q = compare(standing, result, report.scale);
    const float skate = skate_at_scale(standing, report.scale);
    std::printf(
        "  %-44s scale %.3f speed %6.3f -> %6.3f turn %6.1f -> %6.1f skate %4.1f -> %4.1f cm/s sink %.1f cm "
        "under %.2f over %.2f cm, knee back %.2f cm, turning %.2f (%s)\n",
        name.c_str(), (double)report.scale, (double)a.speed, (double)b.speed, (double)a.turn, (double)b.turn,
        100.0 * skate, 100.0 * b.skate, 100.0 * report.sink, 100.0 * q.sunk, 100.0 * q.floating, 100.0 * q.knee,
        (double)q.flip, q.flipping.c_str());
    EXPECT_NEAR(b.speed, report.scale * a.speed, 0.01f * std::fabs(report.scale * a.speed) + 0.002f) << name;
    EXPECT_NEAR(b.turn, a.turn, 0.01f * std::fabs(a.turn) + 0.2f) << name;
    // The stretched bones of one toy are shorter at rest, which leaves its legs short for another's strides.
    const bool short_legs = name == "cesium -> mannequiny";
    EXPECT_LE(b.skate, (short_legs ? 1.3f : 1.2f) * skate + 0.003f) << name;
    EXPECT_LT(q.sunk, 0.01f) << name;
    EXPECT_LT(q.floating, 0.01f) << name;
    EXPECT_LT(q.knee, short_legs ? 0.02f : 0.01f) << name;
    EXPECT_LT(q.flip, 1.5f) << name << " " << q.flipping;
}

std::map<std::string, AnalyzedClip> characters(const std::filesystem::path& folder) {
    std::map<std::string, AnalyzedClip> all;
    const auto add = [&](const std::string& name, const std::filesystem::path& path) { all.emplace(name, read(path)); };
    add("cmu02 walk", folder / "cmu_bvh/02_01.bvh");
    add("cmu07 walk", folder / "cmu_bvh/07_01.bvh");
    add("iclone", folder / "cmu_bvh/06_06_iclone.bvh");
    add("o3de walk", folder / "o3de_mocap_bvh/WalkTurns1.bvh");
    add("o3de run", folder / "o3de_mocap_bvh/Run1.bvh");
    add("ual1 walk", folder / "ual1_locomotion_glb/UAL1_50clips_mannequin.glb#Walk_Loop");
    add("ual1 sprint", folder / "ual1_locomotion_glb/UAL1_50clips_mannequin.glb#Sprint_Loop");
    add("vrm walk", folder / "ual1_locomotion_glb/basic_vrm_names/walk.glb");
    add("cesium", folder / "characters_glb/Cesium_Man.glb");
    add("mannequiny", folder / "characters_glb/gdquest_mannequiny.glb#idle");
    add("human", folder / "characters_glb/m2m_human_male.glb");  // without animation: a target only
    all.emplace("biped", generated("walk"));
    return all;
}

TEST(retargeted_clips, keep_feet_planted_knees_forward_and_speeds_by_leg_length_on_every_rig) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::map<std::string, AnalyzedClip> all = characters(folder);
    for (const auto& [from, source] : all)
        for (const auto& [to, target] : all)
            if (from != "human") expect_good(source, target, from + " -> " + to);
}

/// Mean distance of the joints that both role maps name, over all frames [m]. `roles` are those of the motions.
float mean_distance(const Motion& a, const Motion& b, const RoleMap& roles, const RoleMap& others) {
    std::vector<Transform> x(a.skeleton->rest.size()), y = x;
    double sum = 0, count = 0;
    for (int f = 0; f < a.frame_count(); ++f) {
        world_pose(a, f, x);
        world_pose(b, f, y);
        for (int r = 0; r < k_role_count; ++r) {
            const int joint = roles[static_cast<Role>(r)];
            if (joint == k_no_joint || !others.has(static_cast<Role>(r))) continue;
            sum += static_cast<double>(distance(x[at(joint)].translation, y[at(joint)].translation));
            count += 1;
        }
    }
    return static_cast<float>(sum / count);
}

/// How far a bone's length or direction in its parent's frame is from its rest at most [m]; below the hips.
float stretching(const AnalyzedClip& clip) {
    float most = 0;
    const Skeleton& skeleton = *clip.motion.skeleton;
    const int hips = clip.roles.roles[Role::hips];
    for (int f = 0; f < clip.motion.frame_count(); ++f)
        for (int j = 0; j < skeleton.joint_count(); ++j)
            if (j != hips && is_within(skeleton, j, hips))
                most =
                    std::max(most, distance(clip.motion.frame(f)[at(j)].translation, skeleton.rest[at(j)].translation));
    return most;
}

TEST(retargeted_clips, put_onto_their_own_skeleton_come_back_within_a_tenth_of_a_millimetre) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    int rigid = 0;
    for (const auto& [name, clip] : characters(folder)) {
        if (name == "human") continue;
        if (stretching(clip) > 1e-4f) {  // which no other skeleton can keep
            std::printf("  %s: bones stretch by %.1f mm\n", name.c_str(), 1e3 * static_cast<double>(stretching(clip)));
            continue;
        }
        ++rigid;
        const Actor own = actor_of(clip);
        const AnalyzedClip again = retargeted(clip, own, own);
        EXPECT_LT(mean_distance(clip.motion, again.motion, clip.roles.roles, clip.roles.roles), 1e-4f) << name;
    }
    EXPECT_GE(rigid, 8);
}

TEST(retargeted_clips, return_from_any_other_rig_within_three_centimetres_on_average) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::map<std::string, AnalyzedClip> all = characters(folder);
    for (const auto& [from, source] : all)
        for (const auto& [to, target] : all) {
            if (from == "mannequiny" || from == "human") continue;
            const Actor own = actor_of(source), other = actor_of(target);
            const AnalyzedClip back = retargeted(retargeted(source, own, other), other, own);
            const float error =
                mean_distance(grounded(source).motion, back.motion, source.roles.roles, target.roles.roles);
            std::printf("  %-30s and back: %.2f cm\n", (from + " -> " + to).c_str(),
                        100.0 * static_cast<double>(error));
            // Feet that are short for a sprint's strides let the hips sink on the way, which does not come back.
            EXPECT_LT(error, from == "ual1 sprint" ? 0.06f : 0.03f) << from << " -> " << to;
        }
}

LoadResult load(const std::filesystem::path& folder, const std::vector<std::string>& names) {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back((folder / name).string());
    return load_clips(paths);
}

TEST(gather, puts_takes_of_two_actors_onto_the_skeleton_that_most_clips_share) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    const std::vector<std::string> names = {"cmu_bvh/02_01.bvh", "cmu_bvh/07_01.bvh", "cmu_bvh/07_05.bvh",
                                            "cmu_bvh/07_10.bvh"};
    const Gathered all = gather(load(folder, names).clips, {});
    GatherOptions apart;
    apart.retarget = false;
    const Gathered some = gather(load(folder, names).clips, {}, apart);
    ASSERT_GT(all.kept.size(), some.kept.size());
    EXPECT_TRUE(some.warnings.empty());
    ASSERT_EQ(all.warnings.size(), 1u);
    EXPECT_NE(all.warnings[0].find("07_"), std::string::npos) << all.warnings[0];
    int moved = 0;
    for (const Candidate& candidate : all.kept) {
        EXPECT_EQ(*candidate.clip.motion.skeleton, *all.kept.front().clip.motion.skeleton);
        if (candidate.clip.source.find("02_01") == std::string::npos) continue;
        ++moved;
        EXPECT_NE(candidate.provenance.back().find("retargeted from another skeleton"), std::string::npos);
        EXPECT_NEAR(candidate.clip.facts.speed, 0.964f * 1.18f, 0.1f);
    }
    EXPECT_GT(moved, 0);
    bool told = false;
    for (const ProjectClip& clip : some.left_out)
        told = told || clip.reason.find("other bone lengths") != std::string::npos;
    EXPECT_TRUE(told);
}

TEST(gather, puts_all_clips_onto_the_character_that_is_asked_for) {
    SUREFOOT_NEED_MOTION_DATA(folder);
    GatherOptions options;
    options.actor = actor_of(generated("idle"));
    const Gathered all = gather(load(folder, {"cmu_bvh/07_01.bvh"}).clips, {}, options);
    ASSERT_FALSE(all.kept.empty());
    for (const Candidate& candidate : all.kept)
        EXPECT_EQ(*candidate.clip.motion.skeleton, *options.actor->body.skeleton);
}

}  // namespace
}  // namespace surefoot
