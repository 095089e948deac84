#include "parameters.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace surefoot::cli {

using Json = nlohmann::ordered_json;

std::vector<std::string> Bundle::list() const {
    std::vector<std::string> list;
    const std::string_view all = names();
    for (std::size_t at = 0; at < all.size(); at = all.find('\n', at) + 1)
        list.emplace_back(all.substr(at, all.find('\n', at) - at));
    return list;
}

NamedText find_text(const std::string& name, const Bundle& bundle) {
    if (std::filesystem::exists(name)) return {read_file(name, k_max_gait_bytes), name};
    if (const std::string_view text = bundle.text(name); !text.empty())
        return {std::string(text), name + "." + bundle.noun};
    throw Error(fmt::format("there is no such file and no such {}", bundle.noun), name,
                fmt::format("name a .{} file or one of: {}", bundle.noun, fmt::join(bundle.list(), ", ")));
}

Json parameters_json(std::span<const GaitParameter> parameters, std::span<const double> values) {
    Json list = Json::array();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const GaitParameter& p = parameters[i];
        list.push_back({{"name", p.name},
                        {"value", values[i]},
                        {"default", p.value},
                        {"min", p.low},
                        {"max", p.high},
                        {"unit", p.unit},
                        {"group", p.group},
                        {"help", p.help}});
    }
    return list;
}

Json presets_json(std::span<const GaitPreset> presets, std::span<const GaitParameter> parameters) {
    Json list = Json::array();
    for (const GaitPreset& preset : presets) {
        Json set = Json::object();
        for (const auto& [parameter, value] : preset.values)
            set[parameters[static_cast<std::size_t>(parameter)].name] = value;
        list.push_back({{"name", preset.name}, {"help", preset.help}, {"values", set}});
    }
    return list;
}

void print_parameters(std::span<const GaitParameter> parameters, std::span<const double> values) {
    std::size_t longest = 8;
    for (const GaitParameter& p : parameters) longest = std::max(longest, p.name.size());
    std::string group = "\n";  // no group is called so
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const GaitParameter& p = parameters[i];
        if (p.group != group) print((group = p.group).empty() ? "parameters\n" : p.group + "\n");
        print(fmt::format("  {:<{}} {:>8.4g} {:<9} {:>8.4g} to {:<8.4g} {}\n", p.name, longest, values[i], p.unit,
                          p.low, p.high, p.help));
    }
}

void print_presets(std::span<const GaitPreset> presets) {
    if (!presets.empty()) print("\npresets\n");
    for (const GaitPreset& preset : presets) print(fmt::format("  {:<24} {}\n", preset.name, preset.help));
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_json(const Json& json) { print(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"); }

}  // namespace surefoot::cli
