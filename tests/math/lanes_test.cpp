#include <surefoot/base/random.h>
#include <surefoot/math/lanes.h>
#include <surefoot/math/trig.h>

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <vector>

namespace surefoot {
namespace {

using VF = Float8<Vector>;
using SF = Float8<Scalar>;

// Numbers of every size and sign, with the awkward ones among them; no NaN (its payload is not promised).
std::vector<float> numbers(std::uint64_t seed, float scale) {
    Random random(seed);
    std::vector<float> list = {0.0f,        -0.0f,      1.0f,       -1.0f,       0.5f,   -0.5f,
                               1.5f,        -2.5f,      8388607.5f, -8388608.0f, 1e-30f, -1e-30f,
                               0.41421357f, 2.4142135f, 3.1415927f, -3.1415927f};
    while (list.size() < 4096) {
        const float x = random.between(-scale, scale);
        list.push_back(list.size() % 3 == 0 ? x * 1e-3f : x);
    }
    return list;
}

template <class V, class S>
void expect_same_bits(const V& vector, const S& scalar, const char* what) {
    for (int i = 0; i < 8; ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(vector[i]), std::bit_cast<std::uint32_t>(scalar[i]))
            << what << ", lane " << i << ": " << vector[i] << " against " << scalar[i];
}
template <class V, class S>
void expect_same_truth(const V& vector, const S& scalar, const char* what) {
    for (int i = 0; i < 8; ++i) ASSERT_EQ(vector[i], scalar[i]) << what << ", lane " << i;
}

template <class Op>
void every_pair(const char* what, float scale, Op op) {
    const auto a = numbers(1, scale), b = numbers(2, scale);
    for (std::size_t i = 0; i + 8 <= a.size(); i += 8)
        expect_same_bits(op(VF::load(&a[i]), VF::load(&b[i])), op(SF::load(&a[i]), SF::load(&b[i])), what);
}

TEST(Lanes, arithmetic_gives_the_scalar_twins_bits) {
    every_pair("+", 100, [](auto a, auto b) { return a + b; });
    every_pair("-", 100, [](auto a, auto b) { return a - b; });
    every_pair("*", 100, [](auto a, auto b) { return a * b; });
    every_pair("/", 100, [](auto a, auto b) { return a / (abs(b) + 1e-3f); });
    every_pair("negation", 100, [](auto a, auto) { return -a; });
    every_pair("a * b + a is not contracted", 100, [](auto a, auto b) { return a * b + a; });
    every_pair("numbers on either side", 100,
               [](auto a, auto b) { return (1.0f - a) + (b - 2.0f) * 3.0f + 4.0f / (5.0f + abs(a)); });
}

TEST(Lanes, selection_gives_the_scalar_twins_bits) {
    every_pair("min", 10, [](auto a, auto b) { return min(a, b); });
    every_pair("max", 10, [](auto a, auto b) { return max(a, b); });
    every_pair("clamp", 10, [](auto a, auto) { return clamp(a, -1.0f, 2.0f); });
    every_pair("abs", 10, [](auto a, auto) { return abs(a); });
    every_pair("copysign", 10, [](auto a, auto b) { return copysign(a, b); });
    every_pair("select <", 10, [](auto a, auto b) { return select(a < b, a, b); });
    every_pair("select <= and >", 10, [](auto a, auto b) { return select((a <= b) & (a > -b), a, b); });
    every_pair("select >= or ==", 10, [](auto a, auto b) { return select(~((a >= b) | (a == b)) ^ (a < b), a, b); });
}

TEST(Lanes, roots_and_rounding_give_the_scalar_twins_bits) {
    every_pair("sqrt", 1e6f, [](auto a, auto) { return sqrt(abs(a)); });
    every_pair("rsqrt", 1e6f, [](auto a, auto) { return rsqrt(abs(a) + 1e-20f); });
    every_pair("floor", 1e3f, [](auto a, auto) { return floor(a); });
    every_pair("to_int and back", 1e6f, [](auto a, auto) { return to_float(to_int(a)); });
}

TEST(Lanes, trigonometry_gives_the_scalar_twins_bits) {
    every_pair("sin", 50, [](auto a, auto) { return sin(a); });
    every_pair("cos", 50, [](auto a, auto) { return cos(a); });
    every_pair("atan2", 3, [](auto a, auto b) { return atan2(a, b); });
    every_pair("acos", 1.1f, [](auto a, auto) { return acos(a); });
}

TEST(Lanes, integers_give_the_scalar_twins_bits) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        std::int32_t a[8], b[8];
        for (int i = 0; i < 8; ++i) {
            a[i] = static_cast<std::int32_t>(random.next() % 20001u) - 10000;
            b[i] = round % 5 == 0 ? a[i] : static_cast<std::int32_t>(random.next() % 20001u) - 10000;
        }
        const auto both = [&](const char* what, auto op) {
            expect_same_truth(op(Int8<Vector>::load(a), Int8<Vector>::load(b)),
                              op(Int8<Scalar>::load(a), Int8<Scalar>::load(b)), what);
        };
        both("+", [](auto x, auto y) { return x + y; });
        both("-", [](auto x, auto y) { return x - y; });
        both("*", [](auto x, auto y) { return x * y; });
        both("&", [](auto x, auto y) { return x & y; });
        both("|", [](auto x, auto y) { return x | y; });
        both("^", [](auto x, auto y) { return x ^ y; });
        both("==", [](auto x, auto y) { return x == y; });
        both("<", [](auto x, auto y) { return x < y; });
        both("select", [](auto x, auto y) { return select(x < y, x, y); });
        expect_same_bits(to_float(Int8<Vector>::load(a)), to_float(Int8<Scalar>::load(a)), "to_float");
    }
}

TEST(Lanes, masks_tell_any_from_all) {
    const float steps[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const auto check = [&](auto lanes) {
        using F = decltype(lanes);
        EXPECT_TRUE(all(lanes < F::splat(8)));
        EXPECT_FALSE(all(lanes < F::splat(7)));
        EXPECT_TRUE(any(lanes < F::splat(1)));
        EXPECT_FALSE(any(lanes < F::splat(0)));
    };
    check(VF::load(steps));
    check(SF::load(steps));
}

TEST(Lanes, sixteen_bit_loads_keep_sign_and_order) {
    const std::int16_t values[9] = {99, -32767, 32767, -1, 0, 1, 12345, -12345, 7};
    for (int offset = 0; offset < 2; ++offset) {
        const VF vector = VF::load_int16(values + offset);
        for (int i = 0; i < 8; ++i) EXPECT_EQ(vector[i], static_cast<float>(values[offset + i]));
        expect_same_bits(vector, SF::load_int16(values + offset), "load_int16");
    }
}

TEST(Lanes, transpose_swaps_rows_and_lanes) {
    float cells[64];
    for (int i = 0; i < 64; ++i) cells[i] = static_cast<float>(i);
    const auto check = [&]<class T>(T) {
        Float8<T> rows[8];
        for (int r = 0; r < 8; ++r) rows[r] = Float8<T>::load(cells + 8 * r);
        transpose(rows);
        for (int r = 0; r < 8; ++r)
            for (int c = 0; c < 8; ++c) EXPECT_EQ(rows[r][c], static_cast<float>(8 * c + r));
    };
    check(Vector{});
    check(Scalar{});
}

TEST(Lanes, gather_picks_each_lanes_element) {
    const float table[4] = {10, 20, 30, 40};
    const std::int32_t at[8] = {3, 0, 1, 2, 2, 1, 0, 3};
    const VF picked = gather(table, Int8<Vector>::load(at));
    for (int i = 0; i < 8; ++i) EXPECT_EQ(picked[i], table[at[i]]);
}

TEST(Lanes, trigonometry_is_accurate) {
    const auto a = numbers(5, 100), b = numbers(6, 100);
    double worst_sin = 0, worst_cos = 0, worst_atan = 0, worst_acos = 0, worst_asin = 0, worst_exp = 0;
    for (std::size_t n = 16; n + 8 <= a.size(); n += 8) {  // the first sixteen hold angles beyond the promise
        const VF x = VF::load(&a[n]), y = VF::load(&b[n]);
        const VF s = sin(x), c = cos(x), t = atan2(y, x), o = acos(x * 0.01f);
        const VF i = asin(x * 0.01f), e = exp(x * 0.87f);
        for (int k = 0; k < 8; ++k) {
            const double dx = x[k], dy = y[k];
            worst_sin = std::fmax(worst_sin, std::fabs(s[k] - surefoot::sin(dx)));
            worst_cos = std::fmax(worst_cos, std::fabs(c[k] - surefoot::cos(dx)));
            worst_atan = std::fmax(worst_atan, std::fabs(t[k] - surefoot::atan2(dy, dx)));
            worst_asin = std::fmax(worst_asin, std::fabs(i[k] - surefoot::asin(static_cast<double>(x[k] * 0.01f))));
            worst_exp = std::fmax(worst_exp, std::fabs(e[k] / surefoot::exp(static_cast<double>(x[k] * 0.87f)) - 1));
            worst_acos = std::fmax(worst_acos, std::fabs(o[k] - surefoot::acos(static_cast<double>(x[k] * 0.01f))));
        }
    }
    EXPECT_LT(worst_sin, 2e-7);
    EXPECT_LT(worst_cos, 2e-7);
    EXPECT_LT(worst_atan, 4e-7);
    EXPECT_LT(worst_acos, 4e-7);
    EXPECT_LT(worst_asin, 4e-7);
    EXPECT_LT(worst_exp, 2e-7);
}

TEST(Lanes, floor_agrees_with_the_library) {
    for (const float x : numbers(7, 1e4f)) EXPECT_EQ(floor(VF::splat(x))[3], std::floor(x));
}

}  // namespace
}  // namespace surefoot
