#include <surefoot/crowd/crowd.h>
#include <surefoot/space/triangulate.h>

#include "tests/support/allocations.h"
#include "tests/support/treadmill_clips.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

namespace surefoot {
namespace {

using namespace surefoot::test;

constexpr std::size_t k_count = 101;  // no multiple of eight
constexpr float k_dt = 1.0f / 60;

LocomotionGraph make_graph() {
    const auto skeleton = feet_skeleton();
    std::vector<PackedClip> clips{idle_clip(*skeleton)};
    clips.push_back(gait_clip(*skeleton, {{0, 0, 1.4f}, 0, 1.1f}, "walk"));
    clips.push_back(gait_clip(*skeleton, {{0, 0, 3.5f}, 0, 0.7f}, "run"));
    SpaceDefinition facing;
    facing.space.axes = {{"speed", "m/s", 0, 4}};
    facing.space.samples = {{0}, {1.4f}, {3.5f}};
    facing.clips = {0, 1, 2};
    triangulate(facing.space);
    return make_locomotion_graph(skeleton, std::move(clips), std::move(facing), {});
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// A crowd in which everybody goes at a speed of their own, and what it wrote.
struct Arrays {
    LocomotionGraph graph = make_graph();
    std::size_t joints = graph.skeleton->rest.size();
    std::vector<LocomotionState> states = std::vector<LocomotionState>(k_count);
    std::vector<LocomotionRequest> wishes = std::vector<LocomotionRequest>(k_count);
    std::vector<RootFrame> roots = std::vector<RootFrame>(k_count);
    std::vector<Transform> locals = std::vector<Transform>(k_count * joints);
    std::vector<Matrix34> matrices = std::vector<Matrix34>(k_count * joints);
    std::vector<std::uint8_t> periods;
    std::vector<Matrix34> inverse_bind;
    std::uint32_t frame = 0;

    Arrays() {
        for (std::size_t c = 0; c < k_count; ++c) wishes[c].speed = 3.5f * static_cast<float>(c) / k_count;
    }
    Crowd crowd() {
        Crowd crowd{states, wishes, roots};
        crowd.periods = periods;
        crowd.frame = frame;
        crowd.locals = locals;
        crowd.matrices = matrices;
        crowd.inverse_bind = inverse_bind;
        return crowd;
    }
    void step(CrowdScratch& scratch, std::size_t range = k_count) {
        for (std::size_t first = 0; first < k_count; first += range)
            evaluate(graph, crowd(), {first, std::min(range, k_count - first)}, k_dt, scratch);
        ++frame;
    }
};

TEST(Crowd, does_what_each_character_does_alone) {
    Arrays arrays;
    CrowdScratch scratch(arrays.graph);
    std::vector<LocomotionState> alone(k_count);
    std::vector<RootFrame> roots(k_count);
    std::vector<Transform> locals(arrays.joints), models(arrays.joints);
    for (int frame = 0; frame < 20; ++frame) {
        arrays.step(scratch);
        for (std::size_t c = 0; c < k_count; ++c) {
            const LocomotionFrame step = update(arrays.graph, alone[c], arrays.wishes[c], k_dt);
            roots[c] = roots[c] * step.root_delta;
            pose(arrays.graph, step, locals);
            ASSERT_EQ(std::memcmp(locals.data(), &arrays.locals[c * arrays.joints], locals.size() * sizeof(Transform)),
                      0);
            local_to_model(*arrays.graph.skeleton, locals, models);
            for (std::size_t j = 0; j < arrays.joints; ++j) {
                const Matrix34 wanted = to_matrix(models[j]), got = arrays.matrices[c * arrays.joints + j];
                ASSERT_EQ(std::memcmp(&wanted, &got, sizeof got), 0) << "character " << c << ", joint " << j;
            }
        }
    }
    EXPECT_TRUE(same_bytes(arrays.states, alone));
    EXPECT_TRUE(same_bytes(arrays.roots, roots));
}

TEST(Crowd, ranges_and_threads_change_no_bit) {
    Arrays whole, cut, threaded;
    for (Arrays* a : {&whole, &cut, &threaded})
        for (std::size_t c = 0; c < k_count; ++c) a->periods.push_back(static_cast<std::uint8_t>(c % 4));
    CrowdScratch scratch(whole.graph);
    for (int frame = 0; frame < 30; ++frame) {
        whole.step(scratch);
        cut.step(scratch, 7);
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 3; ++t)
            threads.emplace_back([&threaded, t] {
                CrowdScratch own(threaded.graph);
                const std::size_t first = k_count * t / 3, end = k_count * (t + 1) / 3;
                evaluate(threaded.graph, threaded.crowd(), {first, end - first}, k_dt, own);
            });
        for (std::thread& thread : threads) thread.join();
        ++threaded.frame;
    }
    for (const Arrays* a : {&cut, &threaded}) {
        EXPECT_TRUE(same_bytes(a->states, whole.states));
        EXPECT_TRUE(same_bytes(a->roots, whole.roots));
        EXPECT_TRUE(same_bytes(a->locals, whole.locals));
        EXPECT_TRUE(same_bytes(a->matrices, whole.matrices));
    }
}

TEST(Crowd, rolls_back_by_copying_states_and_roots) {
    Arrays arrays;
    CrowdScratch scratch(arrays.graph);
    for (int frame = 0; frame < 10; ++frame) arrays.step(scratch);
    const std::vector<LocomotionState> states = arrays.states;
    const std::vector<RootFrame> roots = arrays.roots;
    for (int frame = 0; frame < 10; ++frame) arrays.step(scratch);
    const std::vector<Matrix34> wanted = arrays.matrices;
    arrays.states = states;
    arrays.roots = roots;
    for (int frame = 0; frame < 10; ++frame) arrays.step(scratch);
    EXPECT_TRUE(same_bytes(arrays.matrices, wanted));
}

TEST(Crowd, who_is_not_due_keeps_the_pose_and_walks_on) {
    Arrays arrays, always;
    arrays.periods.assign(k_count, 3);
    CrowdScratch scratch(arrays.graph);
    std::size_t posed = 0;
    for (int frame = 0; frame < 31; ++frame) {
        const std::vector<Matrix34> before = arrays.matrices;
        const Crowd crowd = arrays.crowd();
        arrays.step(scratch);
        always.step(scratch);
        for (std::size_t c = 0; c < k_count; ++c) {
            const std::size_t at = c * arrays.joints, bytes = arrays.joints * sizeof(Matrix34);
            const bool due = is_due(crowd, c);
            posed += due;
            ASSERT_EQ(std::memcmp(&arrays.matrices[at], due ? &always.matrices[at] : &before[at], bytes), 0);
        }
    }
    EXPECT_EQ(posed, k_count + k_count * 30 / 3);
    EXPECT_TRUE(same_bytes(arrays.roots, always.roots));
}

// What a period costs the eye: no joint is farther off than it moves in the frames that it waits.
TEST(Crowd, poses_that_last_are_off_by_what_joints_move_meanwhile) {
    for (const std::uint8_t period : {2, 4}) {
        Arrays lasting, always;
        lasting.periods.assign(k_count, period);
        CrowdScratch scratch(lasting.graph);
        float worst = 0;
        for (int frame = 0; frame < 60; ++frame) {
            lasting.step(scratch);
            always.step(scratch);
            for (std::size_t i = 0; i < always.matrices.size(); ++i) {
                const float *a = always.matrices[i].m, *b = lasting.matrices[i].m;
                worst = std::max(worst, distance(Vec3{a[3], a[7], a[11]}, Vec3{b[3], b[7], b[11]}));
            }
        }
        RecordProperty("worst_cm_at_period_" + std::to_string(period), std::to_string(100 * worst));
        constexpr float k_fastest = 13;  // [m/s] a foot that swings in a run, seen from the root
        EXPECT_LT(worst, k_fastest * k_dt * static_cast<float>(period - 1));
        EXPECT_GT(worst, 0.01f);
    }
}

TEST(Crowd, matrices_for_skinning_are_the_identity_in_the_bind_pose) {
    Arrays plain, skinning;
    CrowdScratch scratch(plain.graph);
    plain.step(scratch);
    for (std::size_t j = 0; j < plain.joints; ++j) {  // character 0's own pose is the bind pose
        const float* m = plain.matrices[j].m;
        Matrix34 inverse{{m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0}};
        for (int r = 0; r < 3; ++r) inverse.m[4 * r + 3] = -(m[r] * m[3] + m[4 + r] * m[7] + m[8 + r] * m[11]);
        skinning.inverse_bind.push_back(inverse);
    }
    skinning.step(scratch);
    for (std::size_t j = 0; j < plain.joints; ++j)
        for (int k = 0; k < 12; ++k) EXPECT_NEAR(skinning.matrices[j].m[k], k % 5 == 0 ? 1 : 0, 1e-5f);
    EXPECT_FALSE(same_bytes(skinning.matrices, plain.matrices));
}

TEST(Crowd, allocates_nothing_and_computes_only_what_is_asked_for) {
    Arrays arrays, roots_only;
    CrowdScratch scratch(arrays.graph);
    roots_only.locals.clear();
    roots_only.matrices.clear();
    const long before = allocation_count();
    for (int frame = 0; frame < 5; ++frame) {
        arrays.step(scratch);
        roots_only.step(scratch);
    }
    EXPECT_EQ(allocation_count(), before);
    EXPECT_TRUE(same_bytes(arrays.roots, roots_only.roots));
}

}  // namespace
}  // namespace surefoot
