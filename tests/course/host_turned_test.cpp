// A host that turns or slides the root while a clip stands: feet are held, and step one at a time.

#include <surefoot/course/placed_walker.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/math/trig.h>
#include <surefoot/motion/edit.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

/// What a host adds to the root, for 3 seconds after the first or always.
struct HostMoves {
    float turn_deg_s = 0, slide_mps = 0;
    bool foresees = true;  ///< its preview goes on turning; false: the root stays where it is now
    bool always = false;
};

/// Plays a standing clip.
class HostTurned final : public Walker {
  public:
    HostTurned(const Motion& clip, HostMoves host) : inner_(make_clip_walker(clip, generated_legs())), host_(host) {}
    const std::shared_ptr<const Skeleton>& skeleton() const override { return inner_->skeleton(); }
    const Legs& legs() const override { return inner_->legs(); }
    std::span<const Transform> standing() const override { return inner_->standing(); }
    void start(float) override {
        inner_->start(0);
        root_ = {};
        time_ = 0;
    }
    void advance(float dt) noexcept override {
        inner_->advance(dt);
        if (moves()) root_ = root_ * way(dt);
        time_ += dt;
    }
    RootFrame requested() const noexcept override { return root_; }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        inner_->look(ahead, root, locals);
        root = moves() && host_.foresees ? root_ * way(ahead) : root_;
    }

  private:
    bool moves() const noexcept { return host_.always || (time_ > 0.99f && time_ < 3.99f); }
    RootFrame way(float dt) const noexcept {
        return integrate({host_.slide_mps, 0, 0}, host_.turn_deg_s * k_radians_per_degree, dt);
    }
    std::unique_ptr<Walker> inner_;
    HostMoves host_;
    RootFrame root_;
    float time_ = 0;
};

struct Turned {
    int steps = 0, both_up = 0;
    float skate_cm_s = 0;        ///< mean of standing ankles, while the host moves the root
    float kink = 0;              ///< [m] largest second difference of an ankle from frame to frame
    float most_turned = 0;       ///< [deg] of a foot against the clip's
    float turned = 0, off = 0;   ///< [deg], [m] the same and how far it is from the clip's, level, at the end
    float least_apart = 1e6f;    ///< [m] ankles
    std::array<Vec3, 2> ankles;  ///< at the end
};

Turned turn(HostMoves host, const Ground& ground, FootMode mode = FootMode::surefoot,
            const Motion& clip = generated_clip("idle")) {
    HostTurned walker(clip, host);
    FootSettings settings;
    settings.mode = mode;
    PlacedWalker placed(walker, ground, settings);
    placed.start(0);
    std::vector<Transform> models(placed.locals().size());
    Turned result;
    std::array<std::array<Vec3, 2>, 3> ankles{};  // this frame's and those of the two before
    std::array<bool, 2> stood{true, true};
    int standing = 0;
    for (int f = 1; f < 6 * 60; ++f) {
        placed.advance(1.0f / 60);
        local_to_model(placed.skeleton(), placed.locals(), models);
        ankles[2] = ankles[1];
        ankles[1] = ankles[0];
        result.turned = result.off = 0;
        int up = 0;
        for (std::size_t side = 0; side < 2; ++side) {
            const Leg& leg = walker.legs().side[side];
            const auto joint = static_cast<std::size_t>(leg.foot);
            const Transform root = to_transform(placed.root());
            const Transform foot = root * models[joint], plain = root * placed.unplaced()[joint];
            ankles[0][side] = foot.translation;
            const Vec3 to = rotate(foot.rotation, leg.forward), from = rotate(plain.rotation, leg.forward);
            const float angle = std::fabs(atan2(from.z * to.x - from.x * to.z, from.x * to.x + from.z * to.z));
            result.turned = std::max(result.turned, angle * k_degrees_per_radian);
            result.off = std::max(result.off, planar_length(foot.translation - plain.translation));
            const bool stands = mode != FootMode::surefoot || placed.feet().planted[side];
            up += !stands;
            result.steps += stood[side] && !stands;
            if (f > 60 && f < 240 && stood[side] && stands) {
                result.skate_cm_s += 6000 * planar_length(ankles[0][side] - ankles[1][side]);
                ++standing;
            }
            if (f > 2)
                result.kink = std::max(result.kink, length(ankles[0][side] - 2.0f * ankles[1][side] + ankles[2][side]));
            stood[side] = stands;
        }
        result.most_turned = std::max(result.most_turned, result.turned);
        result.least_apart = std::min(result.least_apart, planar_length(ankles[0][0] - ankles[0][1]));
        result.both_up += up == 2;
    }
    result.skate_cm_s /= static_cast<float>(standing);
    result.ankles = ankles[0];
    return result;
}

TEST(HostTurned, feet_step_one_at_a_time_instead_of_dragging_along) {
    for (const char* course : {"flat", "hills", "cross_slope"})
        for (const HostMoves host : {HostMoves{90, 0}, HostMoves{-90, 0}, HostMoves{30, 0}, HostMoves{0, 0.25f},
                                     HostMoves{0, -0.25f}, HostMoves{45, 0.15f}}) {
            const Course where = make_course(course);
            const auto name = testing::Message()
                              << course << ", " << host.turn_deg_s << " deg/s, " << host.slide_mps << " m/s";
            EXPECT_GT(turn(host, *where.ground, FootMode::none).skate_cm_s, 4) << name;
            const Turned ours = turn(host, *where.ground);
            EXPECT_LT(ours.skate_cm_s, 0.5) << name;
            EXPECT_GE(ours.steps, 4) << name;
            EXPECT_EQ(ours.both_up, 0) << name;
            EXPECT_LT(ours.most_turned, 45) << name;  // 30, and what it turns while the other foot is in the air
            EXPECT_LT(ours.kink, 0.009f) << name;     // m: a walk's own are 6 mm
            EXPECT_GT(ours.least_apart, 0.08f) << name;
            // Where it stands still again it stands as the clip does, but for what is not worth a step.
            EXPECT_LT(ours.turned, 11) << name;
            EXPECT_LT(ours.off, 0.06f) << name;
        }
}

TEST(HostTurned, a_host_that_foresees_nothing_is_stepped_after_all_the_same) {
    const Turned ours = turn({90, 0, false}, Plane());
    EXPECT_GE(ours.steps, 6);
    EXPECT_EQ(ours.both_up, 0);
    EXPECT_LT(ours.skate_cm_s, 4);  // of 14: it drags as far as to its first step, for who can tell
    EXPECT_LT(ours.most_turned, 75);
    EXPECT_LT(ours.turned, 11);
}

TEST(HostTurned, who_is_left_alone_stands_as_the_clip_does) {
    const Turned ours = turn({}, Plane());
    EXPECT_EQ(ours.steps, 0);
    EXPECT_LT(ours.off, 1e-5f);
    EXPECT_LT(ours.turned, 0.01f);
}

TEST(HostTurned, turned_the_other_way_the_other_foot_does_the_same) {
    const Motion& clip = generated_clip("idle");
    const Motion mirrored = mirror(clip, generated_set().roles);
    const Turned left = turn({70, 0.1f}, Plane(), FootMode::surefoot, clip);
    const Turned right = turn({-70, -0.1f}, Plane(), FootMode::surefoot, mirrored);
    EXPECT_EQ(left.steps, right.steps);
    for (std::size_t side = 0; side < 2; ++side) {
        const Vec3 a = left.ankles[side], b = right.ankles[1 - side];
        EXPECT_LT(distance({-a.x, a.y, a.z}, b), 1e-3f) << side;
    }
}

/// Ground that goes to the side, and a root that goes with it.
TEST(HostTurned, a_platform_is_no_host) {
    class Platform final : public Ground {
      public:
        void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
            for (std::size_t i = 0; i < queries.size(); ++i) hits[i] = {true, 0, k_up, 0, {0.25f, 0, 0}};
        }
    };
    const Turned ours = turn({0, 0.25f, false, true}, Platform());
    EXPECT_EQ(ours.steps, 0);
    EXPECT_GT(turn({0, 0.25f, false, true}, Plane()).steps, 4);
}

}  // namespace
}  // namespace surefoot
