#include <surefoot/clip/curves.h>

#include <surefoot/base/random.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

/// A few groups of either width, the curves in no order.
Curves some_curves(Random& random, bool periodic, int number_count, std::vector<CurveGroup> groups) {
    Curves curves;
    curves.number_count = number_count;
    curves.periodic = periodic;
    curves.groups = std::move(groups);
    std::vector<std::int16_t> words;
    std::vector<std::int8_t> bytes;
    int number = number_count;
    for (const CurveGroup& group : curves.groups) {
        for (int i = 0; i < group.curves; ++i) {
            curves.numbers.push_back(static_cast<std::uint16_t>(--number));
            curves.steps.push_back(random.between(0.5f, 1) / 100);
        }
        for (std::size_t i = 0; i < curves.key_count(group) * static_cast<std::size_t>(group.curves); ++i) {
            if (group.key_bytes == 2)
                words.push_back(static_cast<std::int16_t>(static_cast<int>(random.below(65535)) - 32767));
            else
                bytes.push_back(static_cast<std::int8_t>(static_cast<int>(random.below(255)) - 127));
        }
    }
    curves.words = std::move(words);
    curves.bytes = std::move(bytes);
    return curves;
}

/// The cardinal cubic B-spline about 0, by its truncated powers.
double bump(double x) {
    const double a = std::fabs(x), two = std::max(2 - a, 0.0), one = std::max(1 - a, 0.0);
    return (two * two * two - 4 * one * one * one) / 6;
}

/// What a number should be: every key times its bump, in double precision.
double by_definition(const Curves& curves, int number, double share) {
    std::size_t curve = 0, words = 0, bytes = 0;
    for (const CurveGroup& group : curves.groups) {
        const auto count = static_cast<std::size_t>(group.curves);
        for (std::size_t i = 0; i < count; ++i, ++curve) {
            if (curves.numbers[curve] != number) continue;
            double sum = 0;
            for (std::size_t key = 0; key < curves.key_count(group); ++key) {
                const double value = group.key_bytes == 2 ? curves.words[words + key * count + i]
                                                          : curves.bytes[bytes + key * count + i];
                const double away = share * group.intervals + 1 - static_cast<double>(key);
                for (const int pass : {-1, 0, 1})
                    if (pass == 0 || curves.periodic) sum += value * bump(away + pass * group.intervals);
            }
            return sum * static_cast<double>(curves.steps[curve]);
        }
        (group.key_bytes == 2 ? words : bytes) += curves.key_count(group) * count;
    }
    return 0;
}

TEST(Curves, are_the_sums_of_their_keys_bumps) {
    Random random(1);
    for (const bool periodic : {false, true}) {
        const Curves curves = some_curves(random, periodic, 40, {{12, 19, 2}, {4, 1, 2}, {7, 11, 1}});
        ASSERT_EQ(problem(curves), "");
        std::vector<float> values(40, -1);
        for (const float share : {0.0f, 0.001f, 0.3f, 0.5f, 0.77f, 0.9999f, 1.0f}) {
            curve_values(curves, share, values);
            for (int number = 0; number < 40; ++number)
                EXPECT_NEAR(static_cast<double>(values[static_cast<std::size_t>(number)]),
                            by_definition(curves, number, static_cast<double>(share)), 2e-3)
                    << number << " at " << share;
        }
        EXPECT_EQ(values[0], 0);  // no curve gives it
    }
}

TEST(Curves, end_where_they_begin_if_they_are_periodic) {
    Random random(2);
    const Curves curves = some_curves(random, true, 9, {{5, 9, 2}});
    std::vector<float> first(9), last(9), beyond(9);
    curve_values(curves, 0, first);
    curve_values(curves, 1, last);
    curve_values(curves, 2, beyond);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(first[i], last[i], 1e-3f);
    EXPECT_EQ(last, beyond);
}

TEST(Curves, what_does_not_fit_together_is_named) {
    Random random(3);
    const Curves good = some_curves(random, false, 12, {{6, 5, 2}, {6, 4, 1}});
    const auto broken = [&](auto change) {
        Curves curves = good;
        change(curves);
        return problem(curves);
    };
    EXPECT_EQ(problem(good), "");
    EXPECT_NE(broken([](Curves& c) { c.number_count = k_most_curve_numbers + 1; }), "");
    EXPECT_NE(broken([](Curves& c) { c.number_count = 11; }), "");
    EXPECT_NE(broken([](Curves& c) { c.groups[0].intervals = 0; }), "");
    EXPECT_NE(broken([](Curves& c) { c.groups[0].intervals = 7; }), "");
    EXPECT_NE(broken([](Curves& c) { c.groups[1].key_bytes = 3; }), "");
    EXPECT_NE(broken([](Curves& c) { c.groups[1].curves = -4; }), "");
    EXPECT_NE(broken([](Curves& c) { c.periodic = true; }), "");
    EXPECT_NE(broken([](Curves& c) { c.numbers.pop_back(); }), "");
    EXPECT_NE(broken([](Curves& c) { c.steps[2] = std::nanf(""); }), "");
    EXPECT_NE(broken([](Curves& c) { c.bytes = {}; }), "");
}

}  // namespace
}  // namespace surefoot
