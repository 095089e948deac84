// Somebody steers: a walker with its feet on the ground, step by step.

#include <surefoot/bake/character.h>
#include <surefoot/course/patrol.h>
#include <surefoot/course/rolling_metrics.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/motion/edit.h>
#include <surefoot/space/triangulate.h>

#include <surefoot/analysis/analyze.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

constexpr float k_dt = 1 / k_walk_fps;

const Character& character() {
    static const Character made = [] {
        std::vector<AnalyzedClip> clips;
        ProjectSpace facing;
        facing.name = "facing";
        facing.space.axes = {{"speed", "m/s", -2, 6, false}, {"turn", "deg/s", -180, 180, false}};
        for (const char* name : {"idle", "walk", "walk_left", "walk_right", "jog"}) {
            clips.push_back(analyze_clip(generated_clip(name), name));
            facing.space.samples.push_back({clips.back().facts.speed, clips.back().facts.turn});
            facing.clips.push_back(static_cast<int>(clips.size()) - 1);
        }
        triangulate(facing.space);
        return bake_character(clips, {&facing, 1}, "steered");
    }();
    return made;
}

TEST(PlacedWalker, goes_the_way_that_walk_records) {
    const Course course = make_course("hills");
    const auto walker = generated_walker();
    const Walked walked = walk(*walker, *course.ground, {1.2f, 2, FootMode::surefoot});
    PlacedWalker placed(*walker, *course.ground);
    placed.start(1.2f);
    for (int f = 0; f < walked.motion.frame_count(); ++f) {
        if (f) placed.advance(k_dt);
        ASSERT_EQ(placed.root(), walked.motion.root[static_cast<std::size_t>(f)]);
        ASSERT_TRUE(std::equal(placed.locals().begin(), placed.locals().end(), walked.motion.frame(f).begin()));
    }
}

/// A walker whose moments have no numbers: whoever looks ahead has to look.
class Forgetful final : public Walker {
  public:
    explicit Forgetful(Walker& walker) : walker_(walker) {}
    const std::shared_ptr<const Skeleton>& skeleton() const override { return walker_.skeleton(); }
    const Legs& legs() const override { return walker_.legs(); }
    std::span<const Transform> standing() const override { return walker_.standing(); }
    void start(float speed_mps) override { walker_.start(speed_mps); }
    void advance(float dt) noexcept override { walker_.advance(dt); }
    void steer(const LocomotionRequest& asked) noexcept override { walker_.steer(asked); }
    void limit_speed(float mps) noexcept override { walker_.limit_speed(mps); }
    RootFrame requested() const noexcept override { return walker_.requested(); }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        walker_.look(ahead, root, locals);
    }

  private:
    Walker& walker_;
};

TEST(PlacedWalker, what_was_seen_of_the_future_is_what_comes) {
    const Course course = make_course("hills");
    const auto walker = make_character_walker(character()), other = make_character_walker(character());
    Forgetful forgetful(*other);
    PlacedWalker placed(*walker, *course.ground), again(forgetful, *course.ground);
    placed.start(1.2f);
    again.start(1.2f);
    for (int f = 0; f < 600; ++f) {
        // Steers at times, goes on for a while, and has two odd frames.
        const LocomotionRequest asked{f < 300 ? 1.2f : 1.6f, f % 100 < 20 ? static_cast<float>(f % 100) : 20.0f, 0};
        const float dt = f == 150 || f == 151 ? 0.021f : k_dt;
        for (Walker* one : {walker.get(), other.get()}) one->steer(asked);
        placed.advance(dt);
        again.advance(dt);
        ASSERT_EQ(placed.root(), again.root()) << f;
        ASSERT_TRUE(std::equal(placed.locals().begin(), placed.locals().end(), again.locals().begin())) << f;
    }
    EXPECT_GT(placed.state().plans, 10);
}

TEST(PlacedWalker, who_steers_is_obeyed) {
    const Plane flat;
    const auto walker = make_character_walker(character(), {}, walk_path("curve", 20));
    PlacedWalker placed(*walker, flat);
    placed.start(1.4f);
    LocomotionRequest asked;
    asked.speed = 0.9f;
    asked.turn = 15;
    for (int f = 0; f < 120; ++f) {
        walker->steer(asked);
        placed.advance(k_dt);
    }
    const RootFrame before = placed.root();
    walker->steer(asked);
    placed.advance(k_dt);
    const RootFrame step = between(before, placed.root());
    EXPECT_NEAR(planar_length(step.position) / k_dt, 0.9f, 0.02f);
    EXPECT_NEAR(step.yaw / k_dt * k_degrees_per_radian, 15, 1);
}

/// The farthest that an ankle goes from one frame to the next [m], over so many.
float longest_ankle_step(PlacedWalker& placed, const Legs& legs, int frames) {
    std::vector<Transform> models(placed.locals().size());
    const auto ankles = [&] {
        local_to_model(placed.skeleton(), placed.locals(), models);
        std::array<Vec3, 2> at;
        for (std::size_t side = 0; side < 2; ++side)
            at[side] =
                (to_transform(placed.root()) * models[static_cast<std::size_t>(legs.side[side].foot)]).translation;
        return at;
    };
    float longest = 0;
    for (std::array<Vec3, 2> before = ankles(); frames > 0; --frames) {
        placed.advance(k_dt);
        const std::array<Vec3, 2> now = ankles();
        for (std::size_t side = 0; side < 2; ++side) longest = std::max(longest, length(now[side] - before[side]));
        before = now;
    }
    return longest;
}

TEST(PlacedWalker, another_mode_is_there_within_a_second_and_no_foot_jumps) {
    const Course course = make_course("stairs_up");
    const auto walker = generated_walker();
    PlacedWalker placed(*walker, *course.ground);
    placed.start(1.2f);
    const float own = longest_ankle_step(placed, walker->legs(), 300);
    // At all moments of a cycle, or nearly.
    for (int moment = 0; moment < 8; ++moment)
        for (const FootMode mode : {FootMode::none, FootMode::colvin2013, FootMode::surefoot}) {
            placed.set_mode(mode);
            EXPECT_TRUE(placed.changes_mode());
            EXPECT_LT(longest_ankle_step(placed, walker->legs(), 60), 1.15f * own)
                << "to mode " << static_cast<int>(mode) << ", " << moment;
            EXPECT_FALSE(placed.changes_mode());
            EXPECT_EQ(placed.feet().moves_legs, mode != FootMode::none);
            placed.advance(7 * k_dt);
        }
}

TEST(PlacedWalker, who_is_put_elsewhere_goes_on_from_there) {
    const Plane flat;
    const auto walker = make_character_walker(character());
    PlacedWalker placed(*walker, flat);
    placed.start(1.4f);
    for (int f = 0; f < 60; ++f) placed.advance(k_dt);
    const RootFrame there{{3, 0, -2}, 1};
    walker->put(there);
    placed.take_up();
    EXPECT_EQ(placed.root(), there);
    for (int f = 0; f < 60; ++f) placed.advance(k_dt);
    const RootFrame gone = between(there, placed.root());
    EXPECT_NEAR(gone.position.z, 1.4f, 0.1f);
    EXPECT_NEAR(gone.position.x, 0, 0.1f);
}

TEST(Patrol, goes_up_and_down_the_middle_of_the_course) {
    const Course course = make_course("stairs_up");
    const auto walker = make_character_walker(character());
    PlacedWalker placed(*walker, *course.ground);
    placed.start(1.4f);
    Patrol patrol(course.length);
    float farthest = 0, nearest_after = 100, widest = 0;
    bool been_there = false;
    int returns = 0;
    for (int f = 0; f < 60 * 120; ++f) {
        walker->steer(patrol.ask(placed.root(), 1.4f));
        placed.advance(k_dt);
        const Vec3 at = placed.root().position;
        farthest = std::max(farthest, at.z);
        widest = std::max(widest, std::fabs(at.x));
        if (at.z > course.length) been_there = true;
        if (been_there) nearest_after = std::min(nearest_after, at.z);
        if (been_there && at.z < 0) {
            ++returns;
            been_there = false;
        }
    }
    EXPECT_GE(returns, 1);
    EXPECT_LT(nearest_after, 0);
    EXPECT_LT(farthest, course.length + 3);
    EXPECT_LT(widest, 4);
}

TEST(RollingMetrics, are_those_of_the_last_seconds_of_a_walk) {
    const Course course = make_course("hills");
    const auto walker = generated_walker();
    PlacedWalker placed(*walker, *course.ground);
    RollingMetrics rolling(4);
    const WalkInfo info{"generated", "hills"};
    Motion walked = make_motion(walker->skeleton(), "walked", 240, k_walk_fps), twin = walked;
    placed.start(1.4f);
    for (int f = 0; f < 600; ++f) {
        if (f == 100) {
            EXPECT_FALSE(rolling.measure(*course.ground, info, FootMode::surefoot)) << "too little to say";
        }
        rolling.add(placed, walker->legs());
        if (f >= 360) {
            const auto at = static_cast<std::size_t>(f - 360);
            walked.root[at] = twin.root[at] = placed.root();
            twin.root[at].position.y = 0;
            std::copy(placed.locals().begin(), placed.locals().end(), walked.frame(f - 360).begin());
            model_to_local(*walker->skeleton(), placed.unplaced(), twin.frame(f - 360));
        }
        placed.advance(k_dt);
    }
    const auto measured = rolling.measure(*course.ground, info, FootMode::surefoot);
    ASSERT_TRUE(measured);
    const WalkMetrics expected = measure_walk(make_track(walked, walker->legs()), make_track(twin, walker->legs()),
                                              *course.ground, walked.root.back());
    EXPECT_GT(measured->metrics.planted_samples, 100);
    EXPECT_NEAR(measured->metrics.planted_samples, expected.planted_samples, 2);
    EXPECT_NEAR(measured->metrics.skate_cm_s, expected.skate_cm_s, 0.02);
    EXPECT_NEAR(measured->metrics.knee_min_deg, expected.knee_min_deg, 0.01);
    rolling.clear();
    EXPECT_FALSE(rolling.measure(*course.ground, info, FootMode::surefoot));
}

}  // namespace
}  // namespace surefoot
