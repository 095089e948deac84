// Foot placement when nobody knows the path: steering that changes without notice, odd frame rates, holes in the
// ground.

#include <surefoot/course/walk.h>
#include <surefoot/ground/shapes.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

#include <cstring>

namespace surefoot {
namespace {

/// Plays a clip, but the root goes where a stick says; what comes is foreseen as though the stick stayed.
class SteeredWalker final : public Walker {
  public:
    using Stick = float (*)(double time);  ///< turn rate, rad/s
    SteeredWalker(const Motion& clip, Stick stick) : inner_(make_clip_walker(clip, generated_legs())), stick_(stick) {}
    const std::shared_ptr<const Skeleton>& skeleton() const override { return inner_->skeleton(); }
    const Legs& legs() const override { return inner_->legs(); }
    std::span<const Transform> standing() const override { return inner_->standing(); }
    void start(float speed_mps) override {
        inner_->start(speed_mps);
        speed_ = speed_mps;
        root_ = {};
        time_ = 0;
    }
    void advance(float dt) noexcept override {
        inner_->advance(dt);
        root_ = go(root_, stick_(time_), dt);
        time_ += static_cast<double>(dt);
    }
    RootFrame requested() const noexcept override { return root_; }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        inner_->look(ahead, root, locals);
        root = root_;
        for (float left = ahead; left > 0; left -= k_step) root = go(root, stick_(time_), std::min(left, k_step));
    }

  private:
    static constexpr float k_step = 1.0f / 120;
    RootFrame go(RootFrame from, float turn, float dt) const noexcept {
        return from * RootFrame{{0, 0, speed_ * dt}, turn * dt};
    }
    std::unique_ptr<Walker> inner_;
    Stick stick_;
    float speed_ = 1.4f;
    RootFrame root_;
    double time_ = 0;
};

/// Largest change from frame to frame, and change of that change, of what placing adds to the ankles.
struct Jumps {
    float step = 0, kink = 0;
};
Jumps jumps(const Walked& placed, const Walked& plain, const Legs& legs) {
    const WalkTrack a = make_track(placed.motion, legs), b = make_track(plain.motion, legs);
    Jumps worst;
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t f = 2; f < a.frames.size(); ++f) {
            const auto added = [&](std::size_t i) {
                return a.frames[i].legs[side].ankle - b.frames[i].legs[side].ankle;
            };
            worst.step = std::max(worst.step, distance(added(f), added(f - 1)));
            worst.kink = std::max(worst.kink, length(added(f) - 2.0f * added(f - 1) + added(f - 2)));
        }
    return worst;
}

/// A hard turn to the left, then to the right, out of nowhere.
float slalom(double time) { return time < 2 ? 0.0f : time < 4.3 ? 1.6f : time < 6.1 ? -1.9f : 0.4f; }

TEST(SteeredWalk, feet_stay_on_the_hills_where_steering_changes_without_notice) {
    const Course hills = make_course("hills");
    SteeredWalker walker(generated_clip("walk"), slalom);
    const WalkComparison c = compare_modes(walker, *hills.ground, 1.4f, 10);
    const WalkMetrics &none = c.metrics[0], &ours = c.metrics[2];
    EXPECT_LT(ours.penetration_max_cm, 1.5);
    EXPECT_LT(ours.penetration_mean_cm, 0.1);
    EXPECT_LT(ours.float_mean_cm, 0.2);
    EXPECT_LT(ours.sole_angle_deg, 1.5);
    EXPECT_LT(ours.skate_cm_s, none.skate_cm_s + 0.6);
    EXPECT_EQ(ours.over_extensions, 0);
    EXPECT_LT(ours.hip_jerk_ratio, 2.5);
    EXPECT_LT(c.walked[2].plans, 120);  // a few more than once a step
}

/// Away from the far edge of the ledge, when the hips have begun to sink for the step down.
float turned_away(double time) { return time > 6 && time < 7 ? 3.0f : 0.0f; }

TEST(SteeredWalk, hips_that_have_begun_to_give_way_turn_back_without_a_jerk) {
    const Course ledge = make_course("ledge");
    SteeredWalker walker(generated_clip("walk"), turned_away);
    const WalkMetrics ours = compare_modes(walker, *ledge.ground, 1.4f, 9).metrics[2];
    EXPECT_LT(ours.hip_jerk_ratio, 2);  // 2.9 where only position and velocity go on
}

TEST(SteeredWalk, soles_lie_flat_on_rubble_though_feet_turn_on_their_way_and_drift_where_they_stand) {
    const Course rubble = make_course("rubble");
    SteeredWalker walker(generated_clip("walk"), slalom);
    const auto measured = [&](float speed) { return compare_modes(walker, *rubble.ground, speed, 14).metrics[2]; };
    EXPECT_LT(measured(1.4f).sole_angle_deg, 0.45);
    EXPECT_LT(measured(1.1f).sole_angle_worst_deg, 6);
}

TEST(SteeredWalk, knees_of_runs_do_not_fold_below_40_degrees) {
    for (const char* name : {"hills", "slope_up", "ledge"}) {
        const Course course = make_course(name);
        SteeredWalker walker(generated_clip("run"), [](double) { return 0.0f; });
        const WalkMetrics ours = compare_modes(walker, *course.ground, 4, 10).metrics[2];
        EXPECT_GE(ours.knee_min_deg, 40) << name;  // 31 to 36 where legs fold as far as asked
        EXPECT_LT(ours.penetration_max_cm, 1.5) << name;
    }
}

TEST(SteeredWalk, replanning_in_mid_swing_makes_no_jump) {
    const Course hills = make_course("hills");
    SteeredWalker steered(generated_clip("walk"), slalom),
        straight(generated_clip("walk"), [](double) { return 0.0f; });
    const auto worst = [&](SteeredWalker& walker) {
        const Walked plain = walk(walker, Plane(), {1.4f, 10, FootMode::none});
        return jumps(walk(walker, *hills.ground, {1.4f, 10, FootMode::surefoot}), plain, walker.legs());
    };
    const Jumps calm = worst(straight), wild = worst(steered);
    EXPECT_LT(wild.step, 0.04f);
    EXPECT_LT(wild.kink, 2.5f * calm.kink + 0.002f) << calm.kink;
}

TEST(SteeredWalk, on_flat_ground_steering_changes_nothing_either) {
    SteeredWalker walker(generated_clip("walk"), slalom);
    const Walked plain = walk(walker, Plane(), {1.4f, 8, FootMode::none});
    const Jumps worst = jumps(walk(walker, Plane(), {1.4f, 8, FootMode::surefoot}), plain, walker.legs());
    EXPECT_LT(worst.step, 2e-5f);
}

/// Runs foot placement by hand, at a frame rate of one's own.
struct ByHand {
    explicit ByHand(Walker& walker_to_use, FootMode mode = FootMode::surefoot) : walker(walker_to_use) {
        FootSettings settings;
        settings.mode = mode;
        rig = make_foot_rig(*walker.skeleton(), walker.legs(), walker.standing(), settings);
        locals.resize(walker.skeleton()->rest.size());
        models.resize(locals.size());
        walker.start(1.4f);
    }
    struct Preview final : LegPreview {
        const ByHand* self;
        void sample(std::span<const float> ahead, std::span<LegsPose> legs,
                    std::span<RootFrame> roots) const noexcept override {
            std::vector<Transform> l(self->locals.size()), m(l.size());
            for (std::size_t i = 0; i < ahead.size(); ++i) {
                self->walker.look(ahead[i], roots[i], l);
                roots[i].position += self->carried;
                local_to_model(*self->walker.skeleton(), l, m);
                legs[i] = read_legs(self->rig, m);
            }
        }
    };
    void frame(float dt, const Ground& ground) {
        if (dt > 0) walker.advance(dt);
        FootInput input;
        input.dt = dt;
        input.weight = weight;
        walker.look(0, input.root, locals);
        input.root.position += carried;
        input.root.position.y += root_height;
        local_to_model(*walker.skeleton(), locals, models);
        input.legs = read_legs(rig, models);
        Preview preview;
        preview.self = this;
        place_feet(rig, state, input, ground, &preview, output);
        apply(rig, output, models, locals);
        local_to_model(*walker.skeleton(), locals, models);
        for (Transform& t : models) t = to_transform(input.root) * t;
    }
    Vec3 ankle(std::size_t side) const {
        return models[static_cast<std::size_t>(walker.legs().side[side].foot)].translation;
    }
    Walker& walker;
    FootRig rig;
    FootPlacementState state;
    FootOutput output;
    float weight = 1, root_height = 0;
    Vec3 carried;  // by platforms
    std::vector<Transform> locals, models;
};

/// A walker on hills that jumps: for half a second its feet are let go, and its root flies 40 cm high.
struct Jumping {
    ByHand hand;
    std::vector<std::array<Vec3, 2>> ankles;
    explicit Jumping(Walker& walker, const Ground& ground, bool jumps) : hand(walker) {
        constexpr int k_take_off = 70, k_landing = 100;
        for (int f = 0; f < 200; ++f) {
            const float z = static_cast<float>(f) * 1.4f / 60;
            const float t = static_cast<float>(f - k_take_off) / (k_landing - k_take_off);
            hand.root_height = height_at(ground, 0, z);
            hand.weight = jumps && t > 0 && t < 1 ? 0.0f : 1.0f;
            if (hand.weight == 0) hand.root_height += 1.6f * t * (1 - t);
            hand.frame(f ? 1.0f / 60 : 0, ground);
            ankles.push_back({hand.ankle(0), hand.ankle(1)});
            if (jumps && f == k_landing - 1) air = hand.output;
        }
    }
    FootOutput air;
};

TEST(FootPlacement, other_frame_rates_give_the_same_walk) {
    const Course hills = make_course("hills");
    const auto one = generated_walker(), other = generated_walker();
    ByHand fast(*one), slow(*other);
    fast.frame(0, *hills.ground);
    slow.frame(0, *hills.ground);
    float worst = 0;
    for (int i = 0; i < 150; ++i) {
        for (int k = 0; k < 4; ++k) fast.frame(1.0f / 120, *hills.ground);
        slow.frame(1.0f / 30, *hills.ground);
        for (std::size_t side = 0; side < 2; ++side)
            worst = std::max(worst, distance(fast.ankle(side), slow.ankle(side)));
    }
    EXPECT_LT(worst, 0.03f);
}

TEST(FootPlacement, state_rolls_back_by_copying_bytes) {
    const Course hills = make_course("hills");
    const auto walker = generated_walker();
    ByHand hand(*walker);
    hand.frame(0, *hills.ground);
    for (int i = 0; i < 100; ++i) hand.frame(1.0f / 60, *hills.ground);
    FootPlacementState saved;
    std::memcpy(&saved, &hand.state, sizeof saved);
    std::vector<Vec3> first;
    for (int i = 0; i < 50; ++i) hand.frame(1.0f / 60, *hills.ground), first.push_back(hand.ankle(0));
    std::memcpy(&hand.state, &saved, sizeof saved);
    walker->start(1.4f);
    for (int i = 0; i < 100; ++i) walker->advance(1.0f / 60);
    for (int i = 0; i < 50; ++i) {
        hand.frame(1.0f / 60, *hills.ground);
        EXPECT_EQ(hand.ankle(0), first[static_cast<std::size_t>(i)]) << i;
    }
}

TEST(FootPlacement, without_ground_or_across_a_hitch_nothing_breaks) {
    struct Nothing final : Ground {
        void query(std::span<const GroundQuery>, std::span<GroundHit> hits) const noexcept override {
            for (GroundHit& hit : hits) hit = {false, std::nanf(""), {}, 0, {}};
        }
    };
    const auto walker = generated_walker();
    for (const FootMode mode : {FootMode::none, FootMode::colvin2013, FootMode::surefoot}) {
        ByHand hand(*walker, mode);
        for (const float dt : {0.0f, 0.016f, 0.5f, 0.0f, 3.0f, 0.001f, 0.016f, 0.2f}) {
            hand.frame(dt, Nothing());
            for (const Transform& t : hand.models) ASSERT_TRUE(is_finite(t.translation) && is_finite(t.rotation));
        }
    }
}

TEST(FootPlacement, feet_are_let_go_for_a_jump_and_taken_up_again_without_a_pop) {
    const Course hills = make_course("hills");
    const auto walker = generated_walker();
    const Jumping jump(*walker, *hills.ground, true);
    walker->start(1.4f);
    const Jumping stays(*walker, *hills.ground, false);
    // In the air the pose is the clip's.
    EXPECT_FALSE(jump.air.moves_legs);
    EXPECT_EQ(jump.air.hips_offset, 0);
    EXPECT_EQ(jump.air.speed_limit, k_no_speed_limit);
    // A second after the landing the jump is forgotten.
    for (std::size_t f = 160; f < 200; ++f)
        for (std::size_t side = 0; side < 2; ++side)
            EXPECT_LT(distance(jump.ankles[f][side], stays.ankles[f][side]), 0.02f) << f;
    // Neither then nor between is there a jerk that steps do not have, the take-off and landing of the root apart.
    const auto kink = [](const Jumping& walk, std::size_t f, std::size_t side) {
        return length(walk.ankles[f][side] - 2.0f * walk.ankles[f - 1][side] + walk.ankles[f - 2][side]);
    };
    float usual = 0, worst = 0;
    for (std::size_t f = 2; f < 200; ++f)
        for (std::size_t side = 0; side < 2; ++side) {
            usual = std::max(usual, kink(stays, f, side));
            worst = std::max(worst, kink(jump, f, side));
        }
    EXPECT_LT(worst, 2 * usual + 0.01f) << usual;
}

TEST(FootPlacement, a_weight_that_steps_fades_evenly) {
    const Course hills = make_course("hills");
    const auto walker = generated_walker();
    ByHand hand(*walker);
    std::vector<float> offsets;
    for (int f = 0; f < 120; ++f) {
        hand.weight = f < 40 ? 1.0f : f < 80 ? 0.0f : 1.0f;
        hand.frame(f ? 1.0f / 60 : 0, Plane(0, 0, 0.2f));  // the root stays at 0: all of 20 cm is foot placement's
        offsets.push_back(hand.output.hips_offset);
    }
    EXPECT_NEAR(offsets[39], 0.2f, 0.02f);
    EXPECT_EQ(offsets[79], 0);
    EXPECT_NEAR(offsets[119], 0.2f, 0.02f);
    for (std::size_t f = 2; f < offsets.size(); ++f) {
        EXPECT_LT(std::fabs(offsets[f] - offsets[f - 1]), 0.035f) << f;
        EXPECT_LT(std::fabs(offsets[f] - 2 * offsets[f - 1] + offsets[f - 2]), 0.015f) << f;
    }
}

/// Ground that goes where it is carried, all of it the same way.
class Carried final : public Ground {
  public:
    Carried(const Ground& ground, Vec3 velocity) : ground_(ground), velocity_(velocity) {}
    Vec3 gone;  ///< [m] so far
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            GroundQuery query = queries[i];
            query.origin = query.origin - gone;
            ground_.query({&query, 1}, {&hits[i], 1});
            hits[i].height += gone.y;
            hits[i].velocity = velocity_;
            hits[i].surface = 7;
        }
    }

  private:
    const Ground& ground_;
    Vec3 velocity_;
};

TEST(FootPlacement, a_platform_carries_feet_and_root_as_though_it_stood_still) {
    for (const char* course : {"flat", "hills", "stairs_up"}) {
        const Course still = make_course(course);
        const Vec3 velocity{0.6f, 0.25f, -0.4f};
        Carried platform(*still.ground, velocity);
        const auto one = generated_walker(), other = generated_walker();
        ByHand stands(*one), rides(*other);
        float worst = 0;
        for (int f = 0; f < 190; ++f) {
            const float dt = f ? 1.0f / 60 : 0;
            if (f) {
                platform.gone += velocity * dt;
                rides.carried += rides.output.ground_velocity * dt;  // as a host would
            }
            stands.frame(dt, *still.ground);
            rides.frame(dt, platform);
            for (std::size_t side = 0; side < 2; ++side) {
                const Vec3 ankle = rides.ankle(side) - platform.gone;
                worst = std::max(worst, distance(ankle, stands.ankle(side)));
                EXPECT_EQ(rides.output.surface[side], 7u);
                EXPECT_EQ(rides.output.surface_velocity[side], velocity);
                EXPECT_EQ(stands.output.surface[side], 0u);
            }
        }
        EXPECT_LT(worst, 1e-4f) << course;
    }
}

TEST(FootPlacement, a_teleport_forgets_the_old_ground) {
    const Course hills = make_course("hills");
    const auto walker = generated_walker();
    ByHand hand(*walker);
    for (int i = 0; i < 30; ++i) hand.frame(i ? 1.0f / 60 : 0, *hills.ground);
    hand.state = {};
    hand.frame(0, Plane(0, 0, 1.2f));
    for (std::size_t side = 0; side < 2; ++side) EXPECT_GT(hand.ankle(side).y, 1.2f);
}

}  // namespace
}  // namespace surefoot
