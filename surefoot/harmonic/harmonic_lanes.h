#pragma once
// Fitted gaits at speed: the numbers of a gait laid out so that eight joints, phases or series are taken at once.
//
//     const HarmonicLanes lanes(gait, limb);                    // once
//     lanes.values_at(1.4f, 20.0f, values);                     // where speed or turn has changed
//     lanes.waves_at(phases, waves);                            // once a frame: limbs and feet
//     lanes.joint_pose(values, waves, locals);
//     lanes.foot_print(values, waves, side, column);
//
// What comes out is what harmonic_gait.h gives, to rounding; there the formulas are in plain sight, and tools use
// those. Vector and scalar kernels give the same bits. Joints of one limb share blocks of eight; the rest of a block is
// idle. Nothing allocates but the constructors.

#include <surefoot/harmonic/harmonic_gait.h>

#include <cstddef>

namespace surefoot {

struct HarmonicKernels;

class HarmonicLanes {
  public:
    HarmonicLanes() = default;
    /// `limb[joint]` is the column of phases that a joint follows, 0 to 7; empty: all follow 0. `gait` has no problem.
    HarmonicLanes(const HarmonicGait& gait, std::span<const std::uint8_t> limb);

    /// Length of `values`.
    std::size_t value_count() const noexcept { return count_; }
    void values_at(float speed, float turn_deg, std::span<float> values) const noexcept;

    /// The waves of eight phases [0, 1], a column each.
    static constexpr std::size_t k_wave_floats = 8 * (1 + 2 * k_most_harmonics);
    using Waves = std::array<float, k_wave_floats>;
    void waves_at(std::span<const float, 8> phases, Waves& waves) const noexcept;

    /// The joints' rotations and translations, each at the phase of its limb's column.
    void joint_pose(std::span<const float> values, const Waves& waves, std::span<Transform> locals) const noexcept;

    /// A foot at the phase of a column of its series.
    FootPrint foot_print(std::span<const float> values, const Waves& waves, std::size_t side,
                         std::size_t column) const noexcept;
    /// A foot in the middle of its stance.
    FootPrint middle_print(std::span<const float> values, std::size_t side) const noexcept;

    /// For tests: another build than the fastest.
    void use_kernels(const HarmonicKernels& kernels) noexcept;

  private:
    struct Block {
        std::array<std::int16_t, 8> joint;  ///< -1: idle
        std::array<float, 32> mean;         ///< x8 y8 z8 w8
        std::uint8_t column = 0;
        std::size_t at = 0;  ///< of its numbers among the values
    };
    void add_block(std::span<const std::int16_t> joints, std::uint8_t column);
    void lay_out();
    FootPrint print_of(std::span<const float> values, const float* wave, std::size_t side) const noexcept;

    const HarmonicGait* gait_ = nullptr;  ///< must outlive this
    const HarmonicKernels* kernels_ = nullptr;
    std::size_t count_ = 0;
    int length_ = 0, foot_length_ = 0;
    std::vector<Block> blocks_;
    std::vector<std::size_t> moving_;          ///< where the three series of each moving joint are among the values
    std::vector<std::uint8_t> moving_column_;  ///< and the phase they follow
    std::array<std::size_t, 2> feet_{};        ///< where those of each foot are: two blocks
    std::vector<float> coefficients_;          ///< [term][count_]
    Waves middle_{};                           ///< column 0: the middle of a foot's stance
};

}  // namespace surefoot
