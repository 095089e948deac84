#pragma once
// How much poses of a family differ between neighbouring speeds.

#include <surefoot/harmonic/harmonic_gait.h>

#include <algorithm>
#include <vector>

namespace surefoot {

inline constexpr float k_speed_step = 0.025f;  ///< [m/s]

/// Largest angle [deg] by which a local rotation differs between speeds `steps` * k_speed_step apart, from wherever in
/// the range, over twelve phases.
inline float largest_change(const HarmonicGait& gait, std::size_t steps, float turn) {
    constexpr std::size_t k_phases = 12;
    std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
    std::vector<std::vector<Transform>> poses;  // [speed * k_phases + phase]
    for (float speed = gait.basis.least_speed; speed <= gait.basis.most_speed; speed += k_speed_step) {
        values_at(gait, speed, turn, values);
        for (std::size_t i = 0; i < k_phases; ++i)
            pose(gait, values, static_cast<float>(i) / k_phases, poses.emplace_back(gait.mean.size()));
    }
    float most = 0;
    for (std::size_t i = steps * k_phases; i < poses.size(); ++i)
        for (std::size_t j = 0; j < gait.mean.size(); ++j)
            most = std::max(most,
                            rotation_angle(conjugate(poses[i - steps * k_phases][j].rotation) * poses[i][j].rotation));
    return most * k_degrees_per_radian;
}

}  // namespace surefoot
