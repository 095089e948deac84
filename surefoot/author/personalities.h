#pragma once
// Personalities: named settings of the sliders that a fitted gait has (harmonic/gait_style.h), as a text file.
//
//     {"tired": {"help": "…", "stride": 0.9, "crouch_m": 0.02, "spine": {"lean_deg": 14, "lag": 0.03}}}
//
// What is not named is as in the gait. gaits/personalities.json is embedded.

#include <surefoot/harmonic/gait_style.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot {

struct Personality {
    std::string name, help;
    GaitStyle style;
};

/// Throws Error, which says where in the file it was unhappy: names that are no sliders, numbers beyond their ranges.
std::vector<Personality> read_personalities(std::string_view text, const std::string& where);

/// Those that the program carries, in the file's order.
const std::vector<Personality>& bundled_personalities();

/// Sets one slider by its name in the file: "stride", "spine.lean_deg". Throws Error.
void set_slider(GaitStyle& style, const std::string& name, float value, const std::string& where);
/// Its value; NaN where there is no slider of that name.
float slider_value(const GaitStyle& style, const std::string& name) noexcept;

/// Names of all sliders and their ranges, in the file's order.
struct Slider {
    std::string name;
    float least = 0, most = 1;
};
std::vector<Slider> sliders();

/// Text of gaits/NAME.json, as embedded.
std::string_view gait_settings_text(std::string_view name) noexcept;

}  // namespace surefoot
