#include <surefoot/author/json_node.h>
#include <surefoot/author/personalities.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <limits>

namespace surefoot {
namespace {

constexpr std::array<const char*, k_body_parts> k_parts{"legs", "pelvis", "spine", "head", "arms"};

template <typename Of>
struct Range {
    const char* name;
    float Of::*value;
    float least, most;
};
constexpr std::array<Range<GaitStyle>, 5> k_whole{{{"stride", &GaitStyle::stride, 0.5f, 1.5f},
                                                   {"width_m", &GaitStyle::width, -0.1f, 0.3f},
                                                   {"crouch_m", &GaitStyle::crouch, -0.05f, 0.4f},
                                                   {"sway", &GaitStyle::sway, 0, 4},
                                                   {"bounce", &GaitStyle::bounce, 0, 4}}};
constexpr std::array<Range<PartStyle>, 8> k_of_part{{{"amplitude", &PartStyle::amplitude, 0, 3},
                                                     {"lag", &PartStyle::lag, -0.5f, 0.5f},
                                                     {"sharpness", &PartStyle::sharpness, 0.3f, 2},
                                                     {"lean_deg", &PartStyle::lean, -60, 60},
                                                     {"side_deg", &PartStyle::side, -45, 45},
                                                     {"turn_deg", &PartStyle::turn, -45, 45},
                                                     {"out_deg", &PartStyle::out, -45, 60},
                                                     {"bend_deg", &PartStyle::bend, -30, 120}}};

/// What a part can do: all of it swings; trunks lean, limbs go out.
bool has(BodyPart part, std::string_view slider) {
    const bool trunk = part == BodyPart::pelvis || part == BodyPart::spine || part == BodyPart::head;
    if (slider == "side_deg" || slider == "turn_deg") return trunk;
    if (slider == "lean_deg") return part != BodyPart::legs;
    if (slider == "out_deg") return !trunk;
    if (slider == "bend_deg") return part == BodyPart::arms;
    return true;
}

/// The value of a slider in a style, const or not; null where there is no slider of that name.
template <typename Style>
auto* find_slider(Style& style, std::string_view name) {
    for (const auto& range : k_whole)
        if (name == range.name) return &(style.*range.value);
    const std::size_t dot = name.find('.');
    for (std::size_t p = 0; p < k_body_parts && dot != std::string_view::npos; ++p)
        for (const auto& range : k_of_part)
            if (name.substr(0, dot) == k_parts[p] && name.substr(dot + 1) == range.name)
                return &(style.parts[p].*range.value);
    return static_cast<decltype(&style.stride)>(nullptr);
}

}  // namespace

std::vector<Slider> sliders() {
    std::vector<Slider> all;
    for (const auto& range : k_whole) all.push_back({range.name, range.least, range.most});
    for (std::size_t p = 0; p < k_body_parts; ++p)
        for (const auto& range : k_of_part)
            if (has(static_cast<BodyPart>(p), range.name))
                all.push_back({std::string(k_parts[p]) + "." + range.name, range.least, range.most});
    return all;
}

void set_slider(GaitStyle& style, const std::string& name, float value, const std::string& where) {
    for (const Slider& slider : sliders()) {
        if (slider.name != name) continue;
        if (!(value >= slider.least && value <= slider.most))
            throw Error(fmt::format("{} = {:g} is not between {:g} and {:g}", name, value, slider.least, slider.most),
                        where, "stay within its range");
        *find_slider(style, name) = value;
        return;
    }
    std::string names;
    for (const Slider& slider : sliders()) names += (names.empty() ? "" : ", ") + slider.name;
    throw Error("there is no slider '" + name + "'", where, "there are " + names);
}

float slider_value(const GaitStyle& style, const std::string& name) noexcept {
    const float* value = find_slider(style, name);
    return value ? *value : std::numeric_limits<float>::quiet_NaN();
}

std::vector<Personality> read_personalities(std::string_view text, const std::string& where) {
    Json parsed;
    try {
        parsed = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        throw Error(fmt::format("it is no JSON (byte {})", error.byte), where, "see gaits/personalities.json");
    } catch (const Json::exception&) {
        throw Error("a number in it is too large", where, "see gaits/personalities.json");
    }
    std::vector<Personality> all;
    for (const auto& [name, node] : JsonNode(parsed, where, "", nullptr).entries()) {
        Personality personality;
        personality.name = name;
        for (const auto& [key, value] : node.entries()) {
            if (key == "help") {
                personality.help = value.text();
            } else if (value.json().is_object()) {
                for (const auto& [slider, number] : value.entries())
                    set_slider(personality.style, key + "." + slider, number.real(), number.where());
            } else {
                set_slider(personality.style, key, value.real(), value.where());
            }
        }
        all.push_back(std::move(personality));
    }
    return all;
}

const std::vector<Personality>& bundled_personalities() {
    static const std::vector<Personality> all =
        read_personalities(gait_settings_text("personalities"), "personalities.json");
    return all;
}

}  // namespace surefoot
