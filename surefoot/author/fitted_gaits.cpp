#include <surefoot/author/fitted_gaits.h>
#include <surefoot/author/gait_file.h>
#include <surefoot/base/error.h>

#include <algorithm>
#include <array>

namespace surefoot {
namespace {

constexpr std::array<NamedGait, 13> k_gaits{{
    {"walk", "human", 1.3f, 0, "walks; 0.3 to 5 m/s, turns by up to 120 deg/s"},
    {"jog", "human", 2.3f, 0, "the same family, jogging"},
    {"run", "human", 3.6f, 0, "the same family, running"},
    {"back", "back", 0.8f, 0, "walks backward; 0.3 to 2 m/s"},
    {"strafe", "strafe_left", 0.8f, 0, "steps to its left, facing ahead; 0.3 to 1.6 m/s"},
    {"strafe_left", "strafe_left", 0.8f, 0, "the same"},
    {"strafe_right", "strafe_right", 0.8f, 0, "steps to its right"},
    {"turn", "turn", 0, 60, "turns on the spot, to the left; up to 120 deg/s to either side"},
    {"turn_right", "turn", 0, -60, "the same to the right"},
    {"idle", "idle", 0, 0, "stands, breathes, shifts its weight"},
    {"crouch", "crouch", 0.75f, 0, "sneaks, deep in the knees; 0.3 to 1.4 m/s"},
    {"stairs_up", "stairs_up", 0.5f, 0, "climbs stairs of 17 by 28 cm; 0.3 to 0.9 m/s along the ground"},
    {"stairs_down", "stairs_down", 0.5f, 0, "goes down such stairs"},
}};

}  // namespace

std::span<const NamedGait> fitted_gaits() noexcept { return k_gaits; }

const NamedGait* find_fitted_gait(std::string_view name) noexcept {
    const auto found =
        std::find_if(k_gaits.begin(), k_gaits.end(), [&](const NamedGait& gait) { return name == gait.name; });
    return found == k_gaits.end() ? nullptr : &*found;
}

bool has_fitted_gait(std::string_view name) noexcept {
    return find_fitted_gait(name) != nullptr || !fitted_gait_text(name).empty();
}

HarmonicGait fitted_gait(std::string_view name) {
    const NamedGait* named = find_fitted_gait(name);
    const std::string file = named ? named->file : std::string(name);
    const std::string_view text = fitted_gait_text(file);
    if (text.empty()) throw Error("there is no fitted gait of that name", std::string(name), "see surefoot gait list");
    return gait_from_json(text, file + ".json");
}

}  // namespace surefoot
