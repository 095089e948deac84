#pragma once
// How high a swinging foot goes: a small quadratic programme.
//
// Between two plants a foot's height above the clip is the blend of what the two plants would make of it, plus a hump.
// The hump is the smoothest one (least squares of second differences of the sum) that keeps the foot above the ground:
// FEET's "swing height as a small quadratic programme". It is a cubic B-spline with value and slope given at its start
// and zero at its end; its matrices do not depend on the swing, so they are made once.

#include <array>

namespace surefoot {

inline constexpr int k_hump_free = 10;                ///< free coefficients
inline constexpr int k_hump_spans = k_hump_free + 1;  ///< polynomial pieces over the swing
inline constexpr int k_hump_samples = 29;             ///< moments at which the ground is kept clear, both ends included

/// A hump over share s in [0, 1] of its time.
struct Hump {
    float start_value = 0;  ///< [m] at s = 0
    float start_slope = 0;  ///< [m] per unit of s at s = 0
    std::array<float, k_hump_free> coefficients{};

    float at(float s) const noexcept;     ///< 0 outside [0, 1] after the end; the start value before it
    float slope(float s) const noexcept;  ///< d at / ds
    std::array<float, k_hump_samples> at_samples() const noexcept;
};

/// What the programme is asked. Samples are at s = i / (k_hump_samples - 1).
struct HumpTask {
    /// [m] the blend of the two plants, with one sample before the start and one after the end: [0] is s < 0.
    std::array<float, k_hump_samples + 2> base{};
    std::array<float, k_hump_samples> need{};  ///< [m] least height of base + hump
    float start_value = 0, start_slope = 0;
};

class SwingSolver {
  public:
    SwingSolver();
    Hump solve(const HumpTask& task) const noexcept;

  private:
    using Row = std::array<double, k_hump_free>;
    std::array<Row, k_hump_samples> basis_;                                // hump at the samples per coefficient
    std::array<double, k_hump_samples> from_value_{}, from_slope_{};       // and per start value and slope
    std::array<Row, k_hump_samples> to_free_;                              // -Q^-1 A^T, transposed
    std::array<Row, k_hump_samples> response_;                             // Q^-1 B^T, transposed
    std::array<std::array<double, k_hump_samples>, k_hump_samples> gram_;  // B Q^-1 B^T
    std::array<double, k_hump_samples> weight_{};
    std::array<double, k_hump_samples> bend_value_{}, bend_slope_{};  // second differences of start terms
    double softness_ = 0;
};

}  // namespace surefoot
