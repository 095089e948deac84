#include <surefoot/base/error.h>
#include <surefoot/io/sidecar.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;
using Numbers = std::map<std::string, float>;

constexpr const char* k_measured[] = {"speed", "turn", "forward", "lateral", "slope", "pace", "travel"};

void read_number(const std::string& name, const Json& value, const std::string& where, Numbers& numbers) {
    if (name.empty() || name.find(',') != std::string::npos)
        throw Error("\"" + name + "\" cannot name an axis", where, "use a name without commas, as \"style\"");
    if (std::find(std::begin(k_measured), std::end(k_measured), name) != std::end(k_measured))
        throw Error("\"" + name + "\" is measured and cannot be set here", where,
                    "pin the clip's place in the project file instead");
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(std::fabs(number) <= double{std::numeric_limits<float>::max()}))
        throw Error("\"" + name + "\" must be a number, found " + value.dump(), where,
                    "correct the value or remove it");
    numbers[name] = static_cast<float>(number);
}

}  // namespace

std::string sidecar_path(std::string_view clip_file) {
    const std::size_t slash = clip_file.find_last_of("/\\"), dot = clip_file.rfind('.');
    const bool has_extension = dot != std::string_view::npos && (slash == std::string_view::npos || dot > slash);
    return std::string(clip_file.substr(0, has_extension ? dot : clip_file.size())) + ".surefoot.json";
}

void apply_sidecar(std::string_view json, const std::string& where, std::span<LoadedClip> clips) {
    const Json parsed = Json::parse(json.begin(), json.end(), nullptr, false);
    if (!parsed.is_object()) throw Error("this is no JSON object", where, "write it as {\"style\": 0.3}");
    Numbers of_all;
    for (const auto& [name, value] : parsed.items())
        if (name != "clips") read_number(name, value, where, of_all);
    for (LoadedClip& clip : clips) clip.custom = of_all;
    const auto own = parsed.find("clips");
    if (own == parsed.end()) return;
    if (!own->is_object()) throw Error("\"clips\" must be an object of clip names", where, "");
    for (const auto& [name, numbers] : own->items()) {
        const auto clip = std::find_if(clips.begin(), clips.end(),
                                       [&name = name](const LoadedClip& c) { return c.motion.name == name; });
        if (clip == clips.end())
            throw Error("there is no clip \"" + name + "\" in the file beside this one", where,
                        clips.empty() ? "" : "the first one is called \"" + clips.front().motion.name + "\"");
        if (!numbers.is_object()) throw Error("the numbers of clip \"" + name + "\" must be an object", where, "");
        for (const auto& [axis, value] : numbers.items()) read_number(axis, value, where, clip->custom);
    }
}

}  // namespace surefoot
