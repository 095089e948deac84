#pragma once
// A gait as the runtime runs it: a list of instructions over registers, made from text by the room gait_text.
//
// Every operation is total: whatever goes in, what comes out is a number, so that no gait can stop a game.
//
//     a / 0 is 0; the root of a negative number is 0; asin and acos clamp their argument to [-1, 1]; exp clamps its own
//     to [-87, 88]; sin, cos and tan of angles beyond a million radians are those of 0; mod(a, b) lies in [0, b) for
//     b > 0 and is 0 for b = 0; an output that is not finite, or beyond 1e30, is 0.
//
// Eight lanes are eight characters or eight moments. The vector build and its scalar twin give the same bits.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// What a gait may ask for beside its parameters, in the order of the inputs of `run`.
enum class GaitInput : std::uint8_t {
    time,   ///< seconds
    phase,  ///< [0, 1) of a cycle, 0 is a left foot strike
    speed,  ///< m/s
    turn,   ///< deg/s, positive to the character's left
    slope,  ///< degrees, positive uphill
};
inline constexpr int k_gait_inputs = 5;
/// The frames that `T` counts: 24 a second, as in Bhatti et al. (2017).
inline constexpr double k_gait_frames_per_second = 24.0;

/// Operations, with as many operands as `gait_operands` says. Truth is 1, falsehood 0; what is not 0 is true.
enum class GaitOp : std::uint8_t {
    negate,
    add,
    subtract,
    multiply,
    divide,
    less,
    less_equal,
    equal,
    both,    ///< a and b
    either,  ///< a or b
    invert,  ///< not a
    choose,  ///< a ? b : c
    sin,
    cos,
    tan,
    asin,
    acos,
    atan2,  ///< a is y, b is x
    exp,
    sqrt,
    abs,
    floor,
    min,
    max,
    mod,
    noise,  ///< gradient noise in [-1, 1], 0 at whole numbers, smooth; repeats after 256
};
inline constexpr int k_gait_ops = 26;

int gait_operands(GaitOp op) noexcept;
/// One operation in double precision: what constant folding uses.
double apply(GaitOp op, double a, double b, double c) noexcept;

/// register[to] = op(register[a], register[b], register[c])
struct GaitInstruction {
    GaitOp op = GaitOp::add;
    std::uint16_t to = 0, a = 0, b = 0, c = 0;
};

/// What bounds a program, and so the time and the memory (on the stack) of running it.
inline constexpr int k_max_gait_registers = 1024;
inline constexpr int k_max_gait_instructions = 8192;

/// Immutable once made; shared by all who walk this way. Registers: inputs, then parameters, then constants, then what
/// the instructions make.
struct GaitProgram {
    int parameters = 0;
    std::vector<double> constants;
    std::vector<GaitInstruction> instructions;
    std::vector<std::uint16_t> outputs;  ///< the register of each
    int registers = 0;

    /// Empty where every register is in bounds and written before it is read, and the limits hold. A program that
    /// passes can be run; only such may be.
    std::string problem() const;
};

/// Eight lanes: inputs[i * 8 + lane], parameters[p * 8 + lane] to outputs[o * 8 + lane]. Allocates nothing.
void run(const GaitProgram& program, std::span<const float> inputs, std::span<const float> parameters,
         std::span<float> outputs) noexcept;
/// The scalar twin of `run`: the same bits.
void run_scalar(const GaitProgram& program, std::span<const float> inputs, std::span<const float> parameters,
                std::span<float> outputs) noexcept;
/// One lane in double precision, for tables and for tools.
void run_exactly(const GaitProgram& program, std::span<const double> inputs, std::span<const double> parameters,
                 std::span<double> outputs) noexcept;

}  // namespace surefoot
