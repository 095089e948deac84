#pragma once
// The fitted gaits that the program carries, by name: gaits/fitted/, where its README says what comes from where.
//
//     const HarmonicGait gait = fitted_gait("crouch");
//     const NamedGait* walk = find_fitted_gait("walk");       // walk, jog and run are one family at three speeds

#include <surefoot/harmonic/harmonic_gait.h>

#include <span>
#include <string>
#include <string_view>

namespace surefoot {

struct NamedGait {
    const char* name;
    const char* file;    ///< in gaits/fitted/, without ".json"
    float speed = 0;     ///< [m/s] along its travel, that it has unless asked for another
    float turn_deg = 0;  ///< [deg/s] likewise
    const char* help;
};

/// In the order in which people look for them.
std::span<const NamedGait> fitted_gaits() noexcept;

/// Null where there is none of that name.
const NamedGait* find_fitted_gait(std::string_view name) noexcept;

/// Whether `fitted_gait` knows that name.
bool has_fitted_gait(std::string_view name) noexcept;

/// The gait of that name or file. Throws Error where there is none; reading costs a few milliseconds.
HarmonicGait fitted_gait(std::string_view name);

/// Text of gaits/fitted/NAME.json, as embedded; empty: there is none.
std::string_view fitted_gait_text(std::string_view name) noexcept;

}  // namespace surefoot
