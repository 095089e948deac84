#include <surefoot/rig/skeleton.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

Skeleton chain() {
    Skeleton s;
    s.add("a", k_no_joint, {{}, {0, 1, 0}});
    s.add("b", 0, {axis_angle({1, 0, 0}, 0.5f), {0, 1, 0}});
    s.add("c", 1, {{}, {0, 1, 0}}, {0, 0, 0.1f});
    return s;
}

TEST(Skeleton, a_sound_one_has_no_problem) { EXPECT_EQ(problem(chain()), ""); }

TEST(Skeleton, each_fault_is_named_with_its_joint) {
    Skeleton s = chain();
    s.names[2] = "a";
    EXPECT_NE(problem(s).find("two joints are named 'a'"), std::string::npos);
    s = chain();
    s.parents[1] = 2;
    EXPECT_NE(problem(s).find("joint 'b' does not come after its parent"), std::string::npos);
    s = chain();
    s.rest[1].rotation.w = 2;
    EXPECT_NE(problem(s).find("'b' is not a unit"), std::string::npos);
    EXPECT_NE(problem(Skeleton{}).find("no joints"), std::string::npos);
}

TEST(Skeleton, local_to_model_and_back_round_trips) {
    const Skeleton s = chain();
    std::vector<Transform> models(3), locals(3);
    local_to_model(s, s.rest, models);
    EXPECT_NEAR(models[2].translation.z, std::sin(0.5f), 1e-6);
    model_to_local(s, models, locals);
    for (int j = 0; j < 3; ++j) EXPECT_LT(distance(locals[j].translation, s.rest[j].translation), 1e-6f);
}

TEST(Skeleton, is_within_follows_parents) {
    const Skeleton s = chain();
    EXPECT_TRUE(is_within(s, 2, 0));
    EXPECT_TRUE(is_within(s, 1, 1));
    EXPECT_FALSE(is_within(s, 0, 1));
}

}  // namespace
}  // namespace surefoot
