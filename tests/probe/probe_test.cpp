#include <surefoot/analysis/analyze.h>
#include <surefoot/author/place.h>
#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/host/parallel.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/probe/played_figures.h>
#include <surefoot/probe/probe.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

/// The generated set: feet stand still where they stand, so what the instrument reads beside the truth is its own.
const std::vector<AnalyzedClip>& synthetic_clips() {
    static const std::vector<AnalyzedClip> clips = [] {
        std::vector<AnalyzedClip> result;
        for (const Motion& motion : make_synthetic_set().clips) result.push_back(analyze_clip(motion, motion.name));
        return result;
    }();
    return clips;
}

const AnalyzedClip& clip_named(const std::string& name) {
    for (const AnalyzedClip& clip : synthetic_clips())
        if (clip.facts.name == name) return clip;
    throw Error("no such clip", name, {});
}

Project place(const std::vector<AnalyzedClip>& clips) {
    Project project;
    for (const AnalyzedClip& clip : clips) {
        ProjectClip entry;
        entry.name = clip.facts.name;
        entry.file = "clips/" + entry.name + ".glb";
        entry.facts = clip.facts;
        project.clips.push_back(entry);
    }
    std::vector<std::string> warnings;
    place_clips(project, {}, nullptr, warnings);
    return project;
}

Character character_of(const std::vector<AnalyzedClip>& clips) { return bake_character(clips, place(clips).spaces); }

/// One clip alone, as the probe plays the sources of a cell.
PlayedFigures alone(const AnalyzedClip& clip) {
    std::vector<AnalyzedClip> clips{clip};
    if (clip.facts.name != "idle") clips.push_back(clip_named("idle"));
    const Character character = character_of(clips);
    for (std::size_t i = 0; i < character.graph.clips.size(); ++i)
        if (character.graph.clips[i].name == clip.facts.name) {
            const SteadyPlay play = play_clip(character, static_cast<int>(i));
            return measure_play(character, play, play.velocity, play.turn);
        }
    throw Error("the clip is not in the character", clip.facts.name, {});
}

/// The clip with another root under the same pose: the feet go on saying what they said.
AnalyzedClip with_root(AnalyzedClip clip, float speed_factor, float sideways, float turn_deg_s) {
    const std::vector<RootFrame> root = clip.motion.root;
    const float dt = 1 / clip.motion.fps;
    for (std::size_t f = 1; f < root.size(); ++f) {
        RootFrame step = between(root[f - 1], root[f]);
        step.position = step.position * speed_factor + Vec3{sideways * dt, 0, 0};
        step.yaw += turn_deg_s * k_radians_per_degree * dt;
        clip.motion.root[f] = clip.motion.root[f - 1] * step;
    }
    return clip;
}

TEST(probe, every_clip_alone_reads_its_own_speed_and_turn) {
    const Character character = character_of(synthetic_clips());
    for (std::size_t i = 0; i < character.graph.clips.size(); ++i) {
        const SteadyPlay play = play_clip(character, static_cast<int>(i));
        const PlayedFigures played = measure_play(character, play, play.velocity, play.turn);
        SCOPED_TRACE(character.graph.clips[i].name);
        EXPECT_GT(played.standing, 0);
        EXPECT_LT(std::fabs(played.figures[ProbeFigure::speed]), 1.0f);
        EXPECT_LT(std::fabs(played.figures[ProbeFigure::lateral]), 1.0f);
        EXPECT_LT(std::fabs(played.figures[ProbeFigure::turn]), 1.0f);
        EXPECT_LT(played.figures[ProbeFigure::skate], 3.0f);
    }
}

TEST(probe, a_root_ten_percent_too_fast_is_found_out_by_the_feet) {
    for (const char* name : {"walk", "jog", "run"}) {
        SCOPED_TRACE(name);
        const PlayedFigures right = alone(clip_named(name)), wrong = alone(with_root(clip_named(name), 1.1f, 0, 0));
        EXPECT_NEAR(wrong.velocity.z, right.velocity.z, 0.01f * right.velocity.z) << "the pose did not change";
        EXPECT_NEAR(wrong.figures[ProbeFigure::speed], -100 * 0.1f / 1.1f, 1.0f);
    }
    const PlayedFigures walk = alone(with_root(clip_named("walk"), 1.1f, 0, 0));
    EXPECT_GT(walk.figures[ProbeFigure::skate], 8.0f) << "a tenth of 1.4 m/s is 14 cm/s of skate";
    EXPECT_GT(walk.figures[ProbeFigure::skate_share], 0.8f);
}

TEST(probe, a_root_that_turns_or_drifts_under_an_unchanged_pose_is_found_out) {
    EXPECT_NEAR(alone(with_root(clip_named("walk"), 1, 0, 10)).figures[ProbeFigure::turn], -10, 1.0f);
    EXPECT_NEAR(alone(with_root(clip_named("walk_left"), 1, 0, -15)).figures[ProbeFigure::turn], 15, 1.5f);
    // Drifting to the left at a tenth of the speed, the feet fall behind to the right.
    const float speed = clip_named("strafe_left").facts.lateral;
    const PlayedFigures strafe = alone(with_root(clip_named("strafe_left"), 1, 0.1f * speed, 0));
    EXPECT_NEAR(strafe.figures[ProbeFigure::speed], -100 * 0.1f / 1.1f, 1.0f);
}

TEST(probe, a_climb_is_measured_against_its_slope) {
    // The walk on a plane tilted by 10 degrees, the body with it: the feet stand as they did on the level.
    constexpr float k_tilt = 10 * k_radians_per_degree;
    AnalyzedClip climb = clip_named("walk");
    const int hips = climb.roles.roles[Role::hips];
    for (std::size_t f = 0; f < climb.motion.root.size(); ++f) {
        RootFrame& root = climb.motion.root[f];
        const Vec3 level = root.position;
        root.position = {level.x, level.z * sin(k_tilt), level.z * cos(k_tilt)};
        Transform& local = climb.motion.frame(static_cast<int>(f))[static_cast<std::size_t>(hips)];
        local = Transform{from_rotation_vector({-k_tilt, 0, 0}), {}} * local;
    }
    const PlayedFigures flat = alone(clip_named("walk")), steep = alone(climb);
    EXPECT_NEAR(steep.velocity.z, flat.velocity.z * cos(k_tilt), 0.01f);
    EXPECT_NEAR(steep.figures[ProbeFigure::speed], 0, 1);
    EXPECT_NEAR(steep.figures[ProbeFigure::skate], flat.figures[ProbeFigure::skate], 1);
    EXPECT_NEAR(steep.standing, flat.standing, 0.05f);
}

TEST(probe, a_pose_that_glides_without_a_step_obtains_nothing_of_its_speed) {
    AnalyzedClip glide = clip_named("idle");
    glide.facts.name = "glide";
    glide.facts.forward = glide.facts.speed = 1.5f;
    for (std::size_t f = 0; f < glide.motion.root.size(); ++f)
        glide.motion.root[f].position = {0, 0, 1.5f * static_cast<float>(f) / glide.motion.fps};
    const PlayedFigures played = alone(glide);
    EXPECT_NEAR(played.velocity.z, 0, 0.02f);
    EXPECT_NEAR(played.figures[ProbeFigure::speed], -100, 2);
    EXPECT_NEAR(played.figures[ProbeFigure::skate], 150, 3) << "too fast to be called planted, and still skate";
    EXPECT_EQ(played.figures[ProbeFigure::skate_share], 1);
}

TEST(probe, cells_cover_the_hull_and_only_the_hull_and_name_the_clips_that_make_them) {
    const Character character =
        character_of({clip_named("idle"), clip_named("walk"), clip_named("walk_left"), clip_named("walk_right"),
                      clip_named("turn_left"), clip_named("turn_right")});
    const ProbeResult result = probe(character, {5});
    ASSERT_EQ(result.spaces.size(), 1u);
    const ProbeSpace& space = result.spaces[0];
    EXPECT_EQ(space.name, "facing");
    ASSERT_EQ(space.axes.size(), 2u);
    EXPECT_EQ(space.axes[0].points, 5);
    EXPECT_GT(space.cells.size(), 5u);
    EXPECT_LT(space.cells.size(), 25u) << "the corners are outside";
    bool idle_found = false;
    for (const ProbeCell& cell : space.cells) {
        float sum = 0;
        for (std::size_t i = 0; i < cell.shares.size(); ++i) {
            sum += cell.shares[i].weight;
            ASSERT_LT(static_cast<std::size_t>(cell.shares[i].clip), space.clips.size());
            EXPECT_LE(cell.shares[i].weight, cell.shares[i > 0 ? i - 1 : 0].weight);
        }
        EXPECT_NEAR(sum, 1, 1e-3f);
        if (cell.at == std::vector<float>{0, 0}) {
            idle_found = true;
            EXPECT_EQ(space.clips[static_cast<std::size_t>(cell.shares[0].clip)], "idle");
            EXPECT_NEAR(cell.blend[ProbeFigure::speed], 0, 1.0f);
            EXPECT_NEAR(cell.blend[ProbeFigure::turn], 0, 1.0f);
        }
    }
    EXPECT_TRUE(idle_found);
}

TEST(probe, blends_of_the_default_set_go_as_asked_and_do_not_slide) {
    std::vector<AnalyzedClip> clips;
    for (const Motion& motion : make_default_set().clips) clips.push_back(analyze_clip(motion, motion.name));
    const ProbeResult result = probe(character_of(clips));
    const auto mean = [&](ProbeFigure figure) { return probe_stat(result.spaces, figure).mean; };
    EXPECT_GT(probe_stat(result.spaces, ProbeFigure::speed).cells, 100);
    EXPECT_LE(mean(ProbeFigure::speed), 1.0);  // %
    EXPECT_LE(mean(ProbeFigure::turn), 1.0);   // deg/s
    EXPECT_LE(mean(ProbeFigure::skate), 2.0);  // cm/s
}

TEST(probe, the_result_is_the_same_on_any_number_of_threads) {
    const Character character = character_of({clip_named("idle"), clip_named("walk"), clip_named("jog")});
    set_thread_count(1);
    const std::string one = probe_json(probe(character, {7}));
    set_thread_count(4);
    const std::string four = probe_json(probe(character, {7}));
    set_thread_count(0);
    EXPECT_EQ(one, four);
}

TEST(probe, a_grid_that_cannot_be_is_refused) {
    const Character character = character_of({clip_named("idle"), clip_named("walk")});
    EXPECT_THROW(probe(character, {1}), Error);
    EXPECT_THROW(probe(character, {-3}), Error);
    EXPECT_THROW(probe(character, {k_finest_probe_grid + 1}), Error);
}

}  // namespace
}  // namespace surefoot
