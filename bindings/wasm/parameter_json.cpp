#include "parameter_json.h"

#include <surefoot/base/error.h>

#include <algorithm>

namespace surefoot::wasm {

Json parameter_json(const GaitParameter& parameter) {
    return {{"name", parameter.name}, {"initial", parameter.value}, {"low", parameter.low},  {"high", parameter.high},
            {"unit", parameter.unit}, {"group", parameter.group},   {"help", parameter.help}};
}

std::vector<double> within_ranges(std::span<const GaitParameter> parameters, std::span<const double> values,
                                  const std::string& name) {
    if (values.size() != parameters.size()) throw Error("it takes one value a parameter", name, "read it first");
    std::vector<double> within(values.begin(), values.end());
    for (std::size_t p = 0; p < within.size(); ++p)
        within[p] = std::clamp(within[p], parameters[p].low, parameters[p].high);
    return within;
}

}  // namespace surefoot::wasm
