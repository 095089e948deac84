#pragma once
// Parameters, of gaits and of rigs alike, as the page gets and sets them.

#include <surefoot/gait_text/gait.h>

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace surefoot::wasm {

using Json = nlohmann::ordered_json;

/// surefoot.d.mts: GaitParameter.
Json parameter_json(const GaitParameter& parameter);

/// One value a parameter, each brought into its range. Throws Error where there are more or fewer; `name` is whose.
std::vector<double> within_ranges(std::span<const GaitParameter> parameters, std::span<const double> values,
                                  const std::string& name);

}  // namespace surefoot::wasm
