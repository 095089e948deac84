#include <surefoot/base/error.h>
#include <surefoot/gait_text/definitions.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

template <class List>
std::string names_of(const List& list) {
    std::string names;
    for (const auto& entry : list) names += (names.empty() ? "it has " : " ") + entry.name;
    return names.empty() ? "it has none" : names;
}

void assign(const std::string& where, std::span<const GaitParameter> parameters, const std::string& assignment,
            std::vector<double>& values) {
    const std::size_t sign = assignment.find('=');
    if (sign == std::string::npos) throw Error("'" + assignment + "' sets no parameter", where, "write name=value");
    const std::string name = assignment.substr(0, sign);
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const GaitParameter& p) { return p.name == name; });
    if (found == parameters.end()) throw Error("there is no parameter '" + name + "'", where, names_of(parameters));
    double value = 0;
    const char* end = assignment.data() + assignment.size();
    const auto [stop, error] = fast_float::from_chars(assignment.data() + sign + 1, end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value))
        throw Error("'" + assignment.substr(sign + 1) + "' is not a number", where, "write " + name + "=1.5");
    if (!(value >= found->low && value <= found->high))
        throw Error(fmt::format("{} = {} is out of range", name, value), where,
                    fmt::format("it goes from {} to {}", found->low, found->high));
    values[static_cast<std::size_t>(found - parameters.begin())] = value;
}

}  // namespace

std::vector<double> parameter_values(const std::string& where, std::span<const GaitParameter> parameters,
                                     std::span<const GaitPreset> presets, std::string_view preset,
                                     std::span<const std::string> assignments) {
    std::vector<double> values;
    for (const GaitParameter& p : parameters) values.push_back(p.value);
    if (!preset.empty()) {
        const auto found =
            std::find_if(presets.begin(), presets.end(), [&](const GaitPreset& p) { return p.name == preset; });
        if (found == presets.end())
            throw Error("there is no preset '" + std::string(preset) + "'", where, names_of(presets));
        for (const auto& [parameter, value] : found->values) values[static_cast<std::size_t>(parameter)] = value;
    }
    for (const std::string& assignment : assignments) assign(where, parameters, assignment, values);
    return values;
}

std::vector<double> gait_values(const Gait& gait, std::string_view preset, std::span<const std::string> assignments) {
    return parameter_values(gait.name, gait.parameters, gait.presets, preset, assignments);
}

double gait_period(const Gait& gait, std::span<const double> values, double speed, double turn, double slope) {
    const double inputs[k_gait_inputs] = {0, 0, speed, turn, slope};
    std::vector<double> outputs(gait.program.outputs.size());
    run_exactly(gait.program, inputs, values, outputs);
    const double period = outputs.back();
    if (!(period > 0)) throw Error("its period is not positive", gait.name, "change the parameters that it is made of");
    return period;
}

}  // namespace surefoot
