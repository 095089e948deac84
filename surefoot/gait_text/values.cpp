#include <surefoot/base/error.h>
#include <surefoot/gait_text/gait.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

std::string names_of(const Gait& gait) {
    std::string names;
    for (const GaitParameter& p : gait.parameters) names += (names.empty() ? "" : " ") + p.name;
    return names.empty() ? "the gait has none" : "it has " + names;
}

void assign(const Gait& gait, const std::string& assignment, std::vector<double>& values) {
    const std::size_t sign = assignment.find('=');
    if (sign == std::string::npos) throw Error("'" + assignment + "' sets no parameter", gait.name, "write name=value");
    const std::string name = assignment.substr(0, sign);
    const auto found = std::find_if(gait.parameters.begin(), gait.parameters.end(),
                                    [&](const GaitParameter& p) { return p.name == name; });
    if (found == gait.parameters.end()) throw Error("there is no parameter '" + name + "'", gait.name, names_of(gait));
    double value = 0;
    const char* end = assignment.data() + assignment.size();
    const auto [stop, error] = fast_float::from_chars(assignment.data() + sign + 1, end, value);
    if (error != std::errc{} || stop != end || !std::isfinite(value))
        throw Error("'" + assignment.substr(sign + 1) + "' is not a number", gait.name, "write " + name + "=1.5");
    if (!(value >= found->low && value <= found->high))
        throw Error(fmt::format("{} = {} is out of range", name, value), gait.name,
                    fmt::format("it goes from {} to {}", found->low, found->high));
    values[static_cast<std::size_t>(found - gait.parameters.begin())] = value;
}

}  // namespace

std::vector<double> gait_values(const Gait& gait, std::string_view preset, std::span<const std::string> assignments) {
    std::vector<double> values;
    for (const GaitParameter& p : gait.parameters) values.push_back(p.value);
    if (!preset.empty()) {
        const auto found = std::find_if(gait.presets.begin(), gait.presets.end(),
                                        [&](const GaitPreset& p) { return p.name == preset; });
        if (found == gait.presets.end()) {
            std::string names;
            for (const GaitPreset& p : gait.presets) names += (names.empty() ? "it has " : " ") + p.name;
            throw Error("there is no preset '" + std::string(preset) + "'", gait.name,
                        names.empty() ? "the gait has none" : names);
        }
        for (const auto& [parameter, value] : found->values) values[static_cast<std::size_t>(parameter)] = value;
    }
    for (const std::string& assignment : assignments) assign(gait, assignment, values);
    return values;
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
