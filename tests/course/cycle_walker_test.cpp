// A gait that is shaped while it goes: from cycle to cycle without a jump.

#include <surefoot/base/error.h>
#include <surefoot/course/cycle_walker.h>
#include <surefoot/motion/edit.h>

#include "generated_walker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

constexpr float k_dt = 1 / k_walk_fps;

RootFrame root_of(const CycleWalker& walker) {
    RootFrame root;
    std::vector<Transform> locals(static_cast<std::size_t>(walker.skeleton()->joint_count()));
    walker.look(0, root, locals);
    return root;
}

CycleWalker walker_on(const char* name) { return CycleWalker(generated_clip(name), generated_legs()); }

TEST(CycleWalker, changes_the_cycle_at_the_same_place_and_the_same_share) {
    CycleWalker walker = walker_on("walk_left");
    walker.start(0);
    for (int f = 0; f < 100; ++f) walker.advance(k_dt);
    const RootFrame before = root_of(walker);
    const double share = walker.share();
    EXPECT_GT(std::fabs(before.yaw), 0.1f);
    walker.change(generated_clip("jog"), generated_legs());
    const RootFrame after = root_of(walker);
    EXPECT_NEAR(walker.share(), share, 1e-6);
    EXPECT_NEAR(length(after.position - before.position), 0, 1e-4f);
    EXPECT_NEAR(after.yaw, before.yaw, 1e-5f);
    // It goes on where it looks.
    for (int f = 0; f < 60; ++f) walker.advance(k_dt);
    const Vec3 gone = root_of(walker).position - before.position;
    EXPECT_GT(gone.x * std::sin(before.yaw) + gone.z * std::cos(before.yaw), 1.5f);
}

TEST(CycleWalker, begins_again_where_it_began) {
    CycleWalker walker = walker_on("walk");
    walker.start(0);
    const RootFrame start = root_of(walker);
    for (int f = 0; f < 90; ++f) walker.advance(k_dt);
    walker.change(generated_clip("walk_right"), generated_legs());
    walker.start(0);
    EXPECT_EQ(root_of(walker), start);
    EXPECT_EQ(walker.share(), 0);
}

TEST(CycleWalker, refuses_what_is_no_cycle_and_goes_on) {
    CycleWalker walker = walker_on("walk");
    walker.start(0);
    walker.advance(k_dt);
    const RootFrame before = root_of(walker);
    EXPECT_THROW(walker.change(cut(generated_clip("walk"), 3, 3), generated_legs()), Error);
    EXPECT_EQ(root_of(walker), before);
}

}  // namespace
}  // namespace surefoot
