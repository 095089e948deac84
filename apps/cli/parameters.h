#pragma once
// What gaits and rigs have in common on the command line: texts by name, parameters and presets for reading and as
// JSON.

#include <surefoot/gait_text/gait.h>

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::cli {

/// Texts that the program carries.
struct Bundle {
    const char* noun;  ///< "gait"
    std::string_view (*text)(std::string_view name) noexcept;
    std::string_view (*names)() noexcept;  ///< one a line

    std::vector<std::string> list() const;
};

/// The text of a file, or of that name in the bundle, and what to call it in messages. Throws Error.
struct NamedText {
    std::string text, where;
};
NamedText find_text(const std::string& name, const Bundle& bundle);

/// Units are the text's own words, so they stand beside the numbers instead of in the keys.
nlohmann::ordered_json parameters_json(std::span<const GaitParameter> parameters, std::span<const double> values);
nlohmann::ordered_json presets_json(std::span<const GaitPreset> presets, std::span<const GaitParameter> parameters);
void print_parameters(std::span<const GaitParameter> parameters, std::span<const double> values);
void print_presets(std::span<const GaitPreset> presets);

/// To standard output; JSON with what is no UTF-8 replaced.
void print(const std::string& text);
void print_json(const nlohmann::ordered_json& json);

}  // namespace surefoot::cli
