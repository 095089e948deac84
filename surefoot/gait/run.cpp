// One interpreter over a type of value: eight lanes, their scalar twin, and double precision. Each type brings the
// primitives; what an operation means is written once.

#include <surefoot/gait/program.h>
#include <surefoot/math/lanes.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

constexpr int k_slopes = 256;

/// Slopes of the noise at whole numbers, in [-2, 2), so that its values stay within [-1, 1].
constexpr std::array<float, k_slopes> make_slopes() {
    std::array<float, k_slopes> slopes{};
    std::uint64_t state = 0x9e3779b97f4a7c15ull;
    for (float& slope : slopes) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        slope = static_cast<float>(static_cast<std::int32_t>(state >> 40u) - (1 << 23)) / static_cast<float>(1 << 22);
    }
    return slopes;
}
constexpr std::array<float, k_slopes> k_noise_slopes = make_slopes();

// --- the primitives in double precision

inline double splat(double, double x) noexcept { return x; }
inline double select(bool truth, double a, double b) noexcept { return truth ? a : b; }
inline double abs(double x) noexcept { return std::fabs(x); }
inline double floor(double x) noexcept { return std::floor(x); }
inline double sqrt(double x) noexcept { return std::sqrt(x); }
inline double min(double a, double b) noexcept { return a < b ? a : b; }
inline double max(double a, double b) noexcept { return b < a ? a : b; }
inline double slope_at(double whole) noexcept {
    return static_cast<double>(k_noise_slopes[static_cast<std::size_t>(whole)]);
}

// --- the primitives over lanes that lanes.h does not have

template <class T>
SUREFOOT_INLINE Float8<T> splat(Float8<T>, double x) noexcept {
    return Float8<T>::splat(static_cast<float>(x));
}
template <class T>
SUREFOOT_INLINE Float8<T> slope_at(Float8<T> whole) noexcept {
    return gather(k_noise_slopes.data(), to_int(whole));
}

// --- what the operations mean

template <class V>
SUREFOOT_INLINE V quotient(V a, V b) noexcept {
    const V zero = splat(a, 0.0);
    const auto none = b == zero;
    return select(none, zero, a / select(none, splat(a, 1.0), b));
}

template <class V>
SUREFOOT_INLINE V remainder(V a, V b) noexcept {
    const V zero = splat(a, 0.0);
    const V rest = a - b * floor(quotient(a, b));
    // Rounding may reach b itself, or fall a hair below 0.
    const V above = select(rest < zero, zero, select(rest < b, rest, zero));
    return select(b > zero, above, select(b < zero, rest, zero));
}

/// Angles that the reduction to a quarter turn can take; NaN becomes 0 as well.
template <class V>
SUREFOOT_INLINE V angle_in_reach(V a) noexcept {
    return select(abs(a) <= splat(a, 1e6), a, splat(a, 0.0));
}

template <class V>
SUREFOOT_INLINE V noise(V a) noexcept {
    const V x = remainder(select(abs(a) <= splat(a, 1e6), a, splat(a, 0.0)), splat(a, double{k_slopes}));
    const V left = floor(x), one = splat(a, 1.0);
    const V right = select(left + one < splat(a, double{k_slopes}), left + one, splat(a, 0.0));
    const V f = x - left;
    const V fade = f * f * f * (f * (f * splat(a, 6.0) - splat(a, 15.0)) + splat(a, 10.0));
    const V from = slope_at(left) * f, to = slope_at(right) * (f - one);
    return from + (to - from) * fade;
}

template <class V>
SUREFOOT_INLINE V compute(GaitOp op, V a, V b, V c) noexcept {
    const V zero = splat(a, 0.0), one = splat(a, 1.0);
    switch (op) {
        case GaitOp::negate:
            return -a;
        case GaitOp::add:
            return a + b;
        case GaitOp::subtract:
            return a - b;
        case GaitOp::multiply:
            return a * b;
        case GaitOp::divide:
            return quotient(a, b);
        case GaitOp::less:
            return select(a < b, one, zero);
        case GaitOp::less_equal:
            return select(a <= b, one, zero);
        case GaitOp::equal:
            return select(a == b, one, zero);
        case GaitOp::both:
            return select(a == zero, zero, select(b == zero, zero, one));
        case GaitOp::either:
            return select(a == zero, select(b == zero, zero, one), one);
        case GaitOp::invert:
            return select(a == zero, one, zero);
        case GaitOp::choose:
            return select(a == zero, c, b);
        case GaitOp::sin:
            return sin(angle_in_reach(a));
        case GaitOp::cos:
            return cos(angle_in_reach(a));
        case GaitOp::tan: {
            const V angle = angle_in_reach(a);
            return quotient(sin(angle), cos(angle));
        }
        case GaitOp::asin:
            return asin(select(a == a, a, zero));
        case GaitOp::acos:
            return acos(select(a == a, a, zero));
        case GaitOp::atan2: {
            const V far = splat(a, 1e30);
            return atan2(min(max(a, -far), far), min(max(b, -far), far));
        }
        case GaitOp::exp:
            return exp(min(max(select(a == a, a, zero), splat(a, -87.0)), splat(a, 88.0)));
        case GaitOp::sqrt:
            return sqrt(select(a > zero, a, zero));
        case GaitOp::abs:
            return abs(a);
        case GaitOp::floor:
            return floor(a);
        case GaitOp::min:
            return min(a, b);
        case GaitOp::max:
            return max(a, b);
        case GaitOp::mod:
            return remainder(a, b);
        case GaitOp::noise:
            return noise(a);
    }
    return zero;
}

template <class V>
SUREFOOT_INLINE V finite(V a) noexcept {
    return select(abs(a) <= splat(a, 1e30), a, splat(a, 0.0));
}

/// Runs the instructions on registers whose inputs, parameters and constants are set.
template <class V>
SUREFOOT_INLINE void execute(const GaitProgram& program, V* registers) noexcept {
    for (const GaitInstruction& i : program.instructions)
        registers[i.to] = compute(i.op, registers[i.a], registers[i.b], registers[i.c]);
}

template <class T>
SUREFOOT_INLINE void run_lanes(const GaitProgram& program, std::span<const float> inputs,
                               std::span<const float> parameters, std::span<float> outputs) noexcept {
    using V = Float8<T>;
    V registers[k_max_gait_registers];
    std::size_t next = 0;
    for (std::size_t i = 0; i < inputs.size(); i += 8) registers[next++] = V::load(inputs.data() + i);
    for (std::size_t i = 0; i < parameters.size(); i += 8) registers[next++] = V::load(parameters.data() + i);
    for (const double constant : program.constants) registers[next++] = V::splat(static_cast<float>(constant));
    execute(program, registers);
    for (std::size_t o = 0; o < program.outputs.size(); ++o)
        finite(registers[program.outputs[o]]).store(outputs.data() + 8 * o);
}

}  // namespace

double apply(GaitOp op, double a, double b, double c) noexcept { return compute(op, a, b, c); }

void run(const GaitProgram& program, std::span<const float> inputs, std::span<const float> parameters,
         std::span<float> outputs) noexcept {
    run_lanes<Vector>(program, inputs, parameters, outputs);
}

void run_scalar(const GaitProgram& program, std::span<const float> inputs, std::span<const float> parameters,
                std::span<float> outputs) noexcept {
    run_lanes<Scalar>(program, inputs, parameters, outputs);
}

void run_exactly(const GaitProgram& program, std::span<const double> inputs, std::span<const double> parameters,
                 std::span<double> outputs) noexcept {
    double registers[k_max_gait_registers];
    double* next = std::copy(inputs.begin(), inputs.end(), registers);
    next = std::copy(parameters.begin(), parameters.end(), next);
    std::copy(program.constants.begin(), program.constants.end(), next);
    execute(program, registers);
    for (std::size_t o = 0; o < program.outputs.size(); ++o) outputs[o] = finite(registers[program.outputs[o]]);
}

}  // namespace surefoot
