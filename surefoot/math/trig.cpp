#include <surefoot/math/trig.h>

#include <cstdint>
#include <cstring>

namespace surefoot {

namespace {

// pi/2 in three parts whose leading ones have trailing zeros, so that k * part is exact (Cody and Waite, 1980).
constexpr double k_half_pi_1 = 1.57079632673412561417e+00;
constexpr double k_half_pi_2 = 6.07710050630396597660e-11;
constexpr double k_half_pi_3 = 2.02226624879595063154e-21;

// Taylor series on [-pi/4, pi/4]: the first omitted terms are below 1e-19.
double sin_core(double r) noexcept {
    const double s = r * r;
    double p = 1.0 / 355687428096000.0;
    p = p * s - 1.0 / 1307674368000.0;
    p = p * s + 1.0 / 6227020800.0;
    p = p * s - 1.0 / 39916800.0;
    p = p * s + 1.0 / 362880.0;
    p = p * s - 1.0 / 5040.0;
    p = p * s + 1.0 / 120.0;
    p = p * s - 1.0 / 6.0;
    return r + r * s * p;
}

double cos_core(double r) noexcept {
    const double s = r * r;
    double p = 1.0 / 20922789888000.0;
    p = p * s - 1.0 / 87178291200.0;
    p = p * s + 1.0 / 479001600.0;
    p = p * s - 1.0 / 3628800.0;
    p = p * s + 1.0 / 40320.0;
    p = p * s - 1.0 / 720.0;
    p = p * s + 1.0 / 24.0;
    return 1.0 - 0.5 * s + s * s * p;
}

struct Reduced {
    double angle;  // in [-pi/4, pi/4]
    int quadrant;  // 0..3
};

Reduced reduce(double x) noexcept {
    const double k = std::floor(x * (2.0 / k_pi) + 0.5);
    const double r = ((x - k * k_half_pi_1) - k * k_half_pi_2) - k * k_half_pi_3;
    return {r, static_cast<int>(static_cast<std::int64_t>(k) & 3)};
}

double in_quadrant(Reduced r, int shift) noexcept {
    switch ((r.quadrant + shift) & 3) {
        case 0:
            return sin_core(r.angle);
        case 1:
            return cos_core(r.angle);
        case 2:
            return -sin_core(r.angle);
        default:
            return -cos_core(r.angle);
    }
}

// arctangent of t in [0, 1]: atan(t) = atan(c) + atan((t - c) / (1 + t c)) with c = k/8, so the series runs on 1/16.
double atan_unit(double t) noexcept {
    static constexpr double k_table[9] = {0.0,
                                          0.12435499454676144,
                                          0.24497866312686414,
                                          0.35877067027057225,
                                          0.46364760900080610,
                                          0.55859931534356240,
                                          0.64350110879328440,
                                          0.71882999962162450,
                                          0.78539816339744830};
    const int k = static_cast<int>(t * 8.0 + 0.5);
    const double c = static_cast<double>(k) * 0.125;
    const double r = (t - c) / (1.0 + t * c);
    const double s = r * r;
    double p = 1.0 / 13.0;
    p = p * s - 1.0 / 11.0;
    p = p * s + 1.0 / 9.0;
    p = p * s - 1.0 / 7.0;
    p = p * s + 1.0 / 5.0;
    p = p * s - 1.0 / 3.0;
    return k_table[k] + (r + r * s * p);
}

}  // namespace

namespace {

/// So small that the series end with their first term, to the last bit: characters that go straight ahead turn by 0
/// many times a frame.
bool is_tiny(double x) noexcept { return x < 0x1p-27 && x > -0x1p-27; }

}  // namespace

double sin(double x) noexcept { return is_tiny(x) ? x + 0.0 : in_quadrant(reduce(x), 0); }
double cos(double x) noexcept { return is_tiny(x) ? 1.0 : in_quadrant(reduce(x), 1); }
SinCos sin_cos(double x) noexcept {
    if (is_tiny(x)) return {x + 0.0, 1.0};
    const Reduced r = reduce(x);
    const double s = sin_core(r.angle), c = cos_core(r.angle);
    switch (r.quadrant) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}
double tan(double x) noexcept {
    const Reduced r = reduce(x);
    return in_quadrant(r, 0) / in_quadrant(r, 1);
}

double atan2(double y, double x) noexcept {
    const double ax = std::fabs(x), ay = std::fabs(y);
    const double high = ax > ay ? ax : ay;
    if (!(high > 0.0)) return std::signbit(x) ? (std::signbit(y) ? -k_pi : k_pi) : y;
    double angle = ax >= ay ? atan_unit(ay / ax) : 0.5 * k_pi - atan_unit(ax / ay);
    if (std::signbit(x)) angle = k_pi - angle;
    return std::signbit(y) ? -angle : angle;
}

double asin(double x) noexcept {
    x = x < -1.0 ? -1.0 : (x > 1.0 ? 1.0 : x);
    return atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

double acos(double x) noexcept {
    x = x < -1.0 ? -1.0 : (x > 1.0 ? 1.0 : x);
    return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

double exp(double x) noexcept {
    if (x < -708.0) return 0.0;
    if (x > 709.0) x = 709.0;
    constexpr double k_ln2_1 = 6.93147180369123816490e-01, k_ln2_2 = 1.90821492927058770002e-10;
    const double k = std::floor(x * 1.44269504088896340736 + 0.5);
    const double r = (x - k * k_ln2_1) - k * k_ln2_2;  // |r| <= ln2 / 2
    double p = 1.0;
    for (int n = 14; n >= 1; --n) p = 1.0 + p * r / static_cast<double>(n);
    const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023) << 52u;
    double scale;
    std::memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

double log(double x) noexcept {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    int exponent = static_cast<int>(bits >> 52u) - 1023;
    bits = (bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull;
    double m;
    std::memcpy(&m, &bits, sizeof m);
    if (m > 1.4142135623730951) {
        m *= 0.5;
        ++exponent;
    }
    // log m = 2 atanh((m - 1) / (m + 1)), |argument| <= 0.172
    const double t = (m - 1.0) / (m + 1.0), s = t * t;
    double p = 0.0;
    for (int n = 21; n >= 3; n -= 2) p = (p + 1.0 / static_cast<double>(n)) * s;
    return static_cast<double>(exponent) * 0.69314718055994530942 + 2.0 * (t + t * p);
}

double wrap_angle(double radians) noexcept {
    const double turns = std::floor(radians / (2.0 * k_pi) + 0.5);
    const double wrapped = radians - turns * 2.0 * k_pi;
    return wrapped <= -k_pi ? wrapped + 2.0 * k_pi : wrapped;
}

}  // namespace surefoot
