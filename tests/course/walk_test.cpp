#include <surefoot/course/walk.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/motion/edit.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

constexpr auto k_none = static_cast<std::size_t>(FootMode::none);
constexpr auto k_colvin = static_cast<std::size_t>(FootMode::colvin2013);
constexpr auto k_surefoot = static_cast<std::size_t>(FootMode::surefoot);

TEST(Walk, flat_ground_leaves_every_clip_unchanged) {
    for (const char* name : {"walk", "jog", "run", "back", "walk_left", "strafe_left", "turn_left", "idle"}) {
        const auto walker = generated_walker(name);
        ASSERT_TRUE(walker) << name;
        const Plane flat;
        const Walked twin = walk(*walker, flat, {0, 5, FootMode::none});
        EXPECT_LT(largest_distance(twin.motion, walk(*walker, flat, {0, 5, FootMode::surefoot}).motion), 2e-5f) << name;
        EXPECT_LT(largest_distance(twin.motion, walk(*walker, flat, {0, 5, FootMode::colvin2013}).motion), 1e-3f)
            << name;
    }
}

/// A ground seen in a mirror.
class Mirrored final : public Ground {
  public:
    explicit Mirrored(const Ground& ground) : ground_(ground) {}
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            GroundQuery query = queries[i];
            query.origin.x = -query.origin.x;
            ground_.query({&query, 1}, {&hits[i], 1});
            hits[i].normal.x = -hits[i].normal.x;
        }
    }

  private:
    const Ground& ground_;
};

TEST(Walk, a_mirrored_walk_over_mirrored_ground_is_the_mirrored_walk) {
    const ClipSet set = make_synthetic_set();
    std::vector<Transform> standing(set.skeleton->rest.size());
    local_to_model(*set.skeleton, set.skeleton->rest, standing);
    const Legs legs = make_legs(*set.skeleton, set.roles, standing, 0);
    for (const char* clip_name : {"walk", "walk_left"})
        for (const char* course : {"hills", "cross_slope", "stairs_up", "stairs_down", "curb_oblique", "rubble"}) {
            const Motion* clip = nullptr;
            for (const Motion& each : set.clips)
                if (each.name == clip_name) clip = &each;
            ASSERT_TRUE(clip);
            const std::shared_ptr<const Ground> ground = make_course(course).ground;
            const auto there = make_clip_walker(*clip, legs), back = make_clip_walker(mirror(*clip, set.roles), legs);
            const Walked one = walk(*there, *ground, {1.2f, 10, FootMode::surefoot});
            const Walked other = walk(*back, Mirrored(*ground), {1.2f, 10, FootMode::surefoot});
            EXPECT_LT(largest_distance(mirror(one.motion, set.roles), other.motion), 1e-3f)
                << clip_name << " on " << course;
            for (std::size_t side = 0; side < 2; ++side) EXPECT_EQ(one.planted[side], other.planted[1 - side]);
        }
}

TEST(Walk, on_hills_feet_stand_on_the_ground) {
    const Course hills = make_course("hills");
    const WalkComparison c = compare_modes(*generated_walker(), *hills.ground, 1.4f, 10);
    const WalkMetrics &none = c.metrics[k_none], &ours = c.metrics[k_surefoot];
    ASSERT_GT(ours.planted_samples, 500);
    EXPECT_LT(ours.penetration_max_cm, none.penetration_max_cm / 20);
    EXPECT_LT(ours.penetration_mean_cm, none.penetration_mean_cm / 50);
    EXPECT_LT(ours.float_max_cm, none.float_max_cm / 10);
    EXPECT_LT(ours.float_mean_cm, none.float_mean_cm / 20);
    EXPECT_LT(ours.skate_cm_s, none.skate_cm_s + 0.3);
    EXPECT_LT(ours.sole_angle_deg, 0.5);
    EXPECT_EQ(ours.over_extensions, 0);
    EXPECT_LT(ours.knee_peak_ratio, 1.5);
    EXPECT_LT(ours.hip_jerk_ratio, 1.5);
    EXPECT_LT(ours.drift_m, 1e-3);
}

TEST(Walk, colvin2013_stretches_legs_and_jerks_the_hips_as_the_paper_says) {
    const Course hills = make_course("hills");
    const WalkComparison c = compare_modes(*generated_walker(), *hills.ground, 1.4f, 10);
    EXPECT_GT(c.metrics[k_colvin].over_extensions, 20);
    EXPECT_GT(c.metrics[k_colvin].hip_jerk_ratio, 2);
    EXPECT_LT(c.metrics[k_colvin].float_mean_cm, c.metrics[k_none].float_mean_cm);
}

TEST(Walk, slopes_are_walked_up_and_down) {
    for (const char* name : {"slope_up", "slope_down"})
        for (const float grade : {10.0f, 15.0f, 30.0f}) {
            const Course slope = make_course(name, grade);
            const WalkComparison c = compare_modes(*generated_walker(), *slope.ground, 1.4f, 10);
            const WalkMetrics& m = c.metrics[k_surefoot];
            EXPECT_LT(m.penetration_max_cm, 1) << name << grade;
            EXPECT_LT(m.float_mean_cm, 0.1) << name << grade;
            EXPECT_LT(m.sole_angle_deg, 1) << name << grade;
            EXPECT_EQ(m.over_extensions, 0) << name << grade;
            EXPECT_TRUE(m.knee_peak_ratio < 1.8 || m.knee_peak_deg_s2 < 22000) << name << grade;
            EXPECT_LT(m.hip_jerk_ratio, grade > 20 ? 2.5 : 2) << name << grade;
        }
}

/// How far a joint of the trunk is turned forward against the flat twin [deg], most over the frames after `from`.
float most_lean(const std::string& course, bool leans) {
    const Course slope = make_course(course, 20);
    const auto walker = generated_walker();
    const int chest = generated_set().roles[Role::chest];
    const Walked twin = walk(*walker, Plane(), {1.2f, 8, FootMode::none});
    WalkRequest request{1.2f, 8, FootMode::surefoot};
    request.lean = leans;
    const Walked walked = walk(*walker, *slope.ground, request);
    const auto chest_in = [&](const Walked& each, std::size_t f) {
        std::vector<Transform> models(each.motion.skeleton->rest.size());
        local_to_model(*each.motion.skeleton, each.motion.frame(static_cast<int>(f)), models);
        return models[static_cast<std::size_t>(chest)].rotation;
    };
    float most = 0;
    for (std::size_t f = 0; f < walked.motion.root.size(); ++f) {
        const Vec3 turn = to_rotation_vector(chest_in(walked, f) * conjugate(chest_in(twin, f)));
        if (std::fabs(turn.x) > std::fabs(most)) most = turn.x;
    }
    return most * k_degrees_per_radian;
}

TEST(Walk, the_trunk_leans_a_little_into_a_slope) {
    EXPECT_GT(most_lean("slope_up", true), 2);
    EXPECT_LT(most_lean("slope_up", true), 8);
    EXPECT_LT(most_lean("slope_down", true), -0.8f);
    EXPECT_EQ(most_lean("slope_up", false), 0);
}

TEST(Walk, planning_happens_once_a_step_not_once_a_frame) {
    const Course hills = make_course("hills");
    const auto walker = generated_walker();
    const Walked walked = walk(*walker, *hills.ground, {1.4f, 10, FootMode::surefoot});
    EXPECT_LT(walked.plans, 50);
    EXPECT_GT(walked.plans, 10);
}

TEST(Walk, the_same_walk_has_the_same_bytes) {
    const Course hills = make_course("hills");
    const auto walker = generated_walker();
    const Walked a = walk(*walker, *hills.ground, {1.4f, 3, FootMode::surefoot});
    const Walked b = walk(*walker, *hills.ground, {1.4f, 3, FootMode::surefoot});
    EXPECT_EQ(a.motion.locals, b.motion.locals);
    EXPECT_EQ(a.motion.root, b.motion.root);
}

}  // namespace
}  // namespace surefoot
