#include <surefoot/base/random.h>
#include <surefoot/gait/program.h>
#include <surefoot/math/trig.h>

#include "tests/support/allocations.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <memory>

namespace surefoot {
namespace {

constexpr int k_first = k_gait_inputs;  // the register of the first parameter

/// op(p0, p1, p2)
GaitProgram single(GaitOp op) {
    GaitProgram program;
    program.parameters = 3;
    program.registers = k_first + 4;
    program.instructions = {{op, k_first + 3, k_first, k_first + 1, k_first + 2}};
    program.outputs = {k_first + 3};
    return program;
}

struct Eight {
    float inputs[8 * k_gait_inputs] = {};
    float parameters[24] = {};
};

std::array<float, 8> outcome(const GaitProgram& program, const Eight& x, bool scalar = false) {
    std::array<float, 8> out{};
    if (scalar)
        run_scalar(program, x.inputs, x.parameters, out);
    else
        run(program, x.inputs, x.parameters, out);
    return out;
}

Eight random_eight(Random& random, float reach) {
    Eight x;
    for (float& p : x.parameters) p = random.between(-reach, reach);
    return x;
}

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_nasty[] = {0,      -0.0f, 1,    -1,    0.5f,       1e-45f,      1e-38f, 3e38f,
                             -3e38f, 1e6f,  2e9f, -5e9f, k_infinity, -k_infinity, k_nan};

TEST(GaitProgram, lanes_and_their_scalar_twin_give_the_same_bits) {
    Random random(1);
    for (int op = 0; op < k_gait_ops; ++op) {
        const GaitProgram program = single(static_cast<GaitOp>(op));
        for (int i = 0; i < 2000; ++i) {
            const Eight x = random_eight(random, i % 3 == 0 ? 1.5f : i % 3 == 1 ? 100.0f : 1e7f);
            const auto a = outcome(program, x), b = outcome(program, x, true);
            for (std::size_t k = 0; k < 8; ++k)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(a[k]), std::bit_cast<std::uint32_t>(b[k])) << "operation " << op;
        }
    }
}

TEST(GaitProgram, every_operation_gives_a_number_whatever_goes_in) {
    for (int op = 0; op < k_gait_ops; ++op) {
        const GaitProgram program = single(static_cast<GaitOp>(op));
        for (const float a : k_nasty)
            for (const float b : k_nasty) {
                Eight x;
                for (std::size_t k = 0; k < 24; ++k) x.parameters[k] = k < 8 ? a : k < 16 ? b : 1.0f;
                const auto v = outcome(program, x), s = outcome(program, x, true);
                EXPECT_TRUE(std::isfinite(v[3])) << "operation " << op << " of " << a << ", " << b;
                EXPECT_EQ(std::bit_cast<std::uint32_t>(v[3]), std::bit_cast<std::uint32_t>(s[3]))
                    << op << " " << a << " " << b;
                const double in[k_gait_inputs] = {}, p[3] = {static_cast<double>(a), static_cast<double>(b), 1.0};
                double exact[1];
                run_exactly(program, in, p, exact);
                EXPECT_TRUE(std::isfinite(exact[0])) << "operation " << op << " of " << a << ", " << b;
            }
    }
}

TEST(GaitProgram, functions_are_good_to_the_bounds_that_their_headers_promise) {
    struct Bound {
        GaitOp op;
        float low, high;
        double error;
        bool relative;
    };
    const Bound bounds[] = {{GaitOp::sin, -100, 100, 2e-7, false},   {GaitOp::cos, -100, 100, 2e-7, false},
                            {GaitOp::tan, -1.4f, 1.4f, 1e-6, true},  {GaitOp::asin, -1, 1, 4e-7, false},
                            {GaitOp::acos, -1, 1, 4e-7, false},      {GaitOp::atan2, -50, 50, 4e-7, false},
                            {GaitOp::exp, -69, 69, 2e-7, true},      {GaitOp::sqrt, 0, 1000, 1e-7, true},
                            {GaitOp::noise, -300, 300, 2e-4, false}, {GaitOp::divide, -50, 50, 1e-7, true}};
    Random random(2);
    for (const Bound& bound : bounds) {
        const GaitProgram program = single(bound.op);
        double worst = 0;
        for (int i = 0; i < 20000; ++i) {
            Eight x;
            for (float& p : x.parameters) p = random.between(bound.low, bound.high);
            const auto v = outcome(program, x);
            for (std::size_t k = 0; k < 8; ++k) {
                const double exact =
                    apply(bound.op, static_cast<double>(x.parameters[k]), static_cast<double>(x.parameters[8 + k]), 0);
                const double error = std::fabs(static_cast<double>(v[k]) - exact);
                worst = std::fmax(worst, bound.relative ? error / std::fmax(std::fabs(exact), 1e-30) : error);
            }
        }
        EXPECT_LT(worst, bound.error) << "operation " << static_cast<int>(bound.op);
    }
}

TEST(GaitProgram, double_precision_means_what_mathematics_means) {
    EXPECT_EQ(apply(GaitOp::tan, 1.0, 0, 0), surefoot::tan(1.0));
    EXPECT_EQ(apply(GaitOp::divide, 1, 0, 0), 0);
    EXPECT_EQ(apply(GaitOp::sqrt, -4, 0, 0), 0);
    EXPECT_EQ(apply(GaitOp::mod, -0.25, 1, 0), 0.75);
    EXPECT_EQ(apply(GaitOp::mod, 7, 2.5, 0), 2);
    EXPECT_EQ(apply(GaitOp::mod, 7, 0, 0), 0);
    EXPECT_EQ(apply(GaitOp::choose, -0.5, 1, 2), 1);
    EXPECT_EQ(apply(GaitOp::choose, 0, 1, 2), 2);
    EXPECT_EQ(apply(GaitOp::both, 1, 0, 0), 0);
    EXPECT_EQ(apply(GaitOp::either, 0, 3, 0), 1);
    EXPECT_EQ(apply(GaitOp::exp, 0, 0, 0), 1);
}

TEST(GaitProgram, noise_is_smooth_bounded_zero_at_whole_numbers_and_uneven) {
    double low = 0, high = 0, before = apply(GaitOp::noise, -20, 0, 0);
    for (double x = -20; x < 300; x += 0.01) {
        const double y = apply(GaitOp::noise, x, 0, 0);
        EXPECT_LT(std::fabs(y - before), 0.08) << x;
        before = y;
        low = std::fmin(low, y);
        high = std::fmax(high, y);
    }
    EXPECT_GT(high, 0.5);
    EXPECT_LT(low, -0.5);
    EXPECT_LE(high, 1);
    EXPECT_GE(low, -1);
    for (int x = -5; x < 5; ++x) EXPECT_EQ(apply(GaitOp::noise, x, 0, 0), 0);
    EXPECT_EQ(apply(GaitOp::noise, 3.25, 0, 0), apply(GaitOp::noise, 259.25, 0, 0));
    EXPECT_NE(apply(GaitOp::noise, 3.25, 0, 0), apply(GaitOp::noise, 4.25, 0, 0));
}

TEST(GaitProgram, running_allocates_nothing) {
    const GaitProgram program = single(GaitOp::noise);
    const Eight x;
    float out[8];
    const long before = test::allocation_count();
    run(program, x.inputs, x.parameters, out);
    EXPECT_EQ(test::allocation_count() - before, 0);
    const auto counted = std::make_unique<int>(1);
    EXPECT_EQ(test::allocation_count() - before, 1) << "the counter must count";
}

TEST(GaitProgram, a_program_that_breaks_a_limit_has_a_problem) {
    const GaitProgram good = single(GaitOp::choose);
    EXPECT_EQ(good.problem(), "");
    GaitProgram bad = good;
    bad.instructions[0].c = k_first + 3;
    EXPECT_NE(bad.problem(), "");
    bad = good;
    bad.instructions[0].to = k_first + 4;
    EXPECT_NE(bad.problem(), "");
    bad = good;
    bad.instructions[0].to = 0;
    EXPECT_NE(bad.problem(), "");
    bad = good;
    bad.instructions[0].op = static_cast<GaitOp>(k_gait_ops);
    EXPECT_NE(bad.problem(), "");
    bad = good;
    bad.outputs = {500};
    EXPECT_NE(bad.problem(), "");
    bad = good;
    bad.registers = k_max_gait_registers + 1;
    EXPECT_NE(bad.problem(), "");
    bad = good;
    bad.parameters = 7;
    EXPECT_NE(bad.problem(), "");
}

}  // namespace
}  // namespace surefoot
