#include <surefoot/base/random.h>
#include <surefoot/harmonic/harmonic_lanes.h>
#include <surefoot/harmonic/kernels.h>
#include <tests/support/allocations.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

/// Eleven joints in a chain, two of them moving, random series.
HarmonicGait random_gait(std::uint64_t seed, float most) {
    Random random(seed);
    Skeleton s;
    for (int j = 0; j < 11; ++j)
        s.add("joint" + std::to_string(j), j - 1, {{}, {0, 0.1f, 0.01f * static_cast<float>(j)}});
    HarmonicGait gait;
    gait.skeleton = std::make_shared<const Skeleton>(s);
    gait.harmonics = 5, gait.foot_harmonics = 10;
    for (int j = 0; j < 11; ++j)
        gait.mean.push_back(
            from_rotation_vector({random.between(-2, 2), random.between(-1, 1), random.between(-1, 1)}));
    gait.moving = {0, 7};
    gait.basis.modes = 2, gait.basis.degree = 2;
    gait.coefficients.resize(static_cast<std::size_t>(value_count(gait) * gait.basis.terms()));
    for (float& value : gait.coefficients) value = random.between(-most, most);
    return gait;
}

const std::vector<std::uint8_t> k_limbs{4, 4, 0, 0, 1, 1, 1, 2, 2, 3, 4};

TEST(HarmonicLanes, give_what_the_formulas_give) {
    const HarmonicGait gait = random_gait(3, 0.05f);
    ASSERT_EQ(problem(gait), "");
    const HarmonicLanes lanes(gait, k_limbs);
    std::vector<float> values(lanes.value_count()), plain(static_cast<std::size_t>(value_count(gait)));
    std::vector<Transform> fast(11), slow(11);
    HarmonicLanes::Waves waves;
    const std::array<float, 8> phases{0.1f, 0.35f, 0.6f, 0.8f, 0.97f, 0.2f, 0.7f, 0};
    lanes.waves_at(phases, waves);
    for (const float speed : {0.7f, 1.5f, 2.0f, 3.5f}) {
        lanes.values_at(speed, 30, values);
        values_at(gait, speed, 30, plain);
        lanes.joint_pose(values, waves, fast);
        joint_pose(gait, plain, k_limbs, phases, slow);
        for (std::size_t j = 0; j < 11; ++j) {
            EXPECT_LT(distance(fast[j].translation, slow[j].translation), 2e-5f) << j;
            EXPECT_GT(std::fabs(dot(fast[j].rotation, slow[j].rotation)), 1 - 1e-6f) << j;
        }
        for (std::size_t side = 0; side < 2; ++side) {
            const FootPrint a = lanes.foot_print(values, waves, side, 5 + side);
            const FootPrint b = foot_print(gait, plain, side, phases[5 + side]);
            EXPECT_LT(distance(a.heel, b.heel), 2e-5f);
            EXPECT_LT(distance(a.ball, b.ball), 2e-5f);
            EXPECT_GT(std::fabs(dot(a.rotation, b.rotation)), 1 - 1e-6f);
            EXPECT_GT(std::fabs(dot(a.toes, b.toes)), 1 - 1e-6f);
            const FootPrint middle = lanes.middle_print(values, side);
            EXPECT_LT(distance(middle.heel, foot_print(gait, plain, side, 0.5f * gait.foot_lift).heel), 2e-5f);
            const FootPrint once = foot_print_at(gait, speed, 30, side, phases[5]);
            EXPECT_LT(distance(once.heel, foot_print(gait, plain, side, phases[5]).heel), 1e-6f);
        }
    }
}

/// Both give the same bits, even of wild numbers.
void expect_twins(const HarmonicLanes& lanes, const HarmonicLanes& twin) {
    Random random(1);
    std::vector<float> a(lanes.value_count()), b(a);
    std::vector<Transform> left(11), right(11);
    HarmonicLanes::Waves waves{}, other{};
    for (int i = 0; i < 200; ++i) {
        const float speed = random.between(0, 5), turn = random.between(-120, 120);
        std::array<float, 8> phases;
        for (float& phase : phases) phase = random.between(0, 1);
        lanes.values_at(speed, turn, a);
        twin.values_at(speed, turn, b);
        ASSERT_EQ(a, b);
        lanes.waves_at(phases, waves);
        twin.waves_at(phases, other);
        ASSERT_EQ(waves, other);
        lanes.joint_pose(a, waves, left);
        twin.joint_pose(b, other, right);
        ASSERT_EQ(left, right);
        for (const Transform& t : left) ASSERT_TRUE(is_finite(t.rotation) && is_finite(t.translation));
        ASSERT_EQ(lanes.foot_print(a, waves, 1, 3).heel, twin.foot_print(b, other, 1, 3).heel);
    }
}

TEST(HarmonicLanes, every_build_gives_the_scalar_twins_bits) {
    for (const float most : {0.05f, 5.0f}) {
        const HarmonicGait gait = random_gait(9, most);
        HarmonicLanes lanes(gait, k_limbs), twin(gait, k_limbs);
        twin.use_kernels(KernelBuilds<HarmonicKernels>::scalar);
        for (const HarmonicKernels* kernels : KernelBuilds<HarmonicKernels>::here()) {
            SCOPED_TRACE(kernels->name);
            lanes.use_kernels(*kernels);
            expect_twins(lanes, twin);
        }
    }
}

TEST(HarmonicLanes, a_pose_allocates_nothing) {
    const HarmonicGait gait = random_gait(4, 0.1f);
    const HarmonicLanes lanes(gait, {});
    std::vector<float> values(lanes.value_count());
    std::vector<Transform> locals(11);
    HarmonicLanes::Waves waves;
    const long before = test::allocation_count();
    for (int i = 0; i < 50; ++i) {
        lanes.values_at(0.1f * static_cast<float>(i), 0, values);
        lanes.waves_at(std::array<float, 8>{0.02f * static_cast<float>(i)}, waves);
        lanes.joint_pose(values, waves, locals);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace surefoot
