#pragma once
// Gaits as text: the language, what a text says once it is read, and the program that it becomes.
//
//     # a comment, to the end of the line
//     gait nod help "One line about it"
//     parameter rate = 1 in [0.1, 4] unit "Hz" group "Time" help "Nods a second"
//     parameter reach = 0.05 in [0, 0.2] unit "m"
//     let swing = sin(2 * pi * rate * t)              # a named sub-expression
//     control head.tY = swing > 0 ? swing * reach : 0 unit "m"
//     period = 1 / rate                               # seconds; 1 where a gait says none
//     preset shallow help "Barely a nod" { reach = 0.01 }
//
// Statements may stand in any order but a name is used only below the line that defines it. Controls may use controls.
// Expressions, from weakest to strongest:
//
//     c ? a : b | or | and | not | < <= > >= == != | + - | * / | -a +a | 12.5 name f(a, b) (a)
//
// (comparisons do not chain). Constants: pi. Time: t or time (s), T (frames, 24 a second), phase ([0, 1), 0 is a left
// foot strike), speed (m/s), turn (deg/s), slope (deg). Angles are in radians. Functions: sin cos tan asin acos
// atan2(y, x) exp sqrt abs floor min(a, b, ...) max(a, b, ...) clamp(x, low, high) mix(a, b, share)
// smoothstep(from, to, x) step(edge, x) (0 below the edge, else 1) mod(x, length) pulse(x, duty) (1 in the first `duty`
// of every whole step of x, else 0) noise(x). gait/program.h says what each gives where mathematics says nothing (a /
// 0).
//
// Names are letters, digits and underscores, joined by dots. A text is bounded: see the limits. Reading throws Error
// with file:line:column, the line and a caret.

#include <surefoot/gait/program.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

inline constexpr std::size_t k_max_gait_bytes = std::size_t{1} << 20;
inline constexpr int k_max_gait_depth = 64;     ///< of parentheses, calls, signs and choices within each other
inline constexpr int k_max_gait_names = 512;    ///< parameters, sub-expressions and controls together
inline constexpr int k_max_gait_nodes = 16384;  ///< different operations and numbers

struct GaitParameter {
    std::string name;
    double value = 0;  ///< default, in [low, high]
    double low = -1e30, high = 1e30;
    std::string unit, group, help;
};

/// A control, or a named sub-expression.
struct GaitOutput {
    std::string name;
    bool control = true;
    std::string unit, help;
};

/// Values of some parameters under one name.
struct GaitPreset {
    struct Value {
        int parameter;
        double value;
    };
    std::string name, help;
    std::vector<Value> values;
};

/// A gait as read. `program` has the outputs below, then the period in seconds.
struct Gait {
    std::string name, help;
    std::vector<GaitParameter> parameters;
    std::vector<GaitOutput> outputs;  ///< in the order of the text
    std::vector<GaitPreset> presets;
    GaitProgram program;
    /// What is no error but hardly meant, each with file:line:column: names that nothing uses.
    std::vector<std::string> warnings;
};

/// Which outputs the program of a gait computes.
enum class GaitOutputs {
    controls,   ///< what moves a character
    everything  ///< named sub-expressions, too: for tables and plots
};

/// `where` names the text in messages. Throws Error.
Gait read_gait(std::string_view text, const std::string& where, GaitOutputs outputs = GaitOutputs::controls);

/// Values of a gait's parameters: the defaults, then the preset (empty: none), then `name=value` in order. Throws Error
/// for unknown names, what is no number, and values out of range.
std::vector<double> gait_values(const Gait& gait, std::string_view preset, std::span<const std::string> assignments);

/// The gait's period in seconds at these values, speed (m/s), turn (deg/s) and slope (deg); throws Error where that is
/// not positive and finite.
double gait_period(const Gait& gait, std::span<const double> values, double speed, double turn, double slope);

/// A gait's controls (and sub-expressions, if its program has them) at moments, in double precision.
struct GaitTable {
    double period_s = 1;
    std::vector<double> times_s;
    std::vector<double> values;  ///< [row * outputs + output]
};
struct GaitMoments {
    double speed_mps = 0, turn_deg_s = 0, slope_deg = 0;
    int frames = 0;  ///< rows at 24 a second; 0: one period in `steps` equal steps, both ends included
    int steps = 96;
};
/// Row by row; the phase is the time in periods. Throws as gait_period does.
GaitTable sample_gait(const Gait& gait, std::span<const double> values, const GaitMoments& moments);
/// Columns T (frames, 24 a second), time (s) and every output; numbers in the shortest form that reads back the same.
std::string gait_table_csv(const Gait& gait, const GaitTable& table);
std::string gait_table_json(const Gait& gait, const GaitTable& table);
/// A picture (SVG) of every control over time, each on its own scale.
std::string gait_table_svg(const Gait& gait, const GaitTable& table);

/// The texts of the gaits that the program carries (the folder `gaits`); empty where there is none of that name.
std::string_view bundled_gait(std::string_view name) noexcept;
/// Their names, one a line, in order.
std::string_view bundled_gait_names() noexcept;

}  // namespace surefoot
