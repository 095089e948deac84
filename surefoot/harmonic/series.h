#pragma once
// Where the series lie among the values of a gait, and what can be done to one without taking it apart: for sliders and
// derived gaits. A series is a0, a1, b1, a2, b2, …

#include <surefoot/harmonic/harmonic_gait.h>

namespace surefoot {

/// The values of one gait, seen as series. [Limit: `values` is value_count(gait) long and outlives this]
class GaitSeries {
  public:
    GaitSeries(const HarmonicGait& gait, std::span<float> values) noexcept : gait_(&gait), values_(values) {}

    /// Axis 0 to 2 of a joint's rotation vector, and of the k-th moving joint's translation.
    std::span<float> rotation(int joint, int axis) const noexcept;
    std::span<float> translation(int moving, int axis) const noexcept;
    enum class FootPart : std::uint8_t { rotation, heel, ball, toes };
    std::span<float> foot(std::size_t side, FootPart part, int axis) const noexcept;
    /// Velocity x y z, turn rate, frequency, right strike, lift left and right.
    std::span<float> rhythm() const noexcept { return values_.last(k_rhythm_values); }
    /// Index among the moving joints, or -1.
    int moving_index(int joint) const noexcept;

  private:
    const HarmonicGait* gait_;
    std::span<float> values_;
};

float series_at(std::span<const float> series, float phase) noexcept;

/// All waves times `factor`; the mean stays.
void scale_waves(std::span<float> series, float factor) noexcept;

/// All of what the series does apart from its value at `phase` times `factor`: that value stays.
void scale_about(std::span<float> series, float phase, float factor) noexcept;

/// What the series does comes later by `lag` of a cycle.
void delay(std::span<float> series, float lag) noexcept;

/// The k-th wave times factor^(k - 1): above 1 turns are quicker and stops harder, below 1 all is rounder.
void sharpen(std::span<float> series, float factor) noexcept;

/// Adds a small turn to a joint's rotation: a rotation vector of the model [rad], `model` being the joint's own
/// rotation in the mean pose. Exact to first order in the product of both turns.
void add_turn(const GaitSeries& series, int joint, Quat model, Vec3 turn) noexcept;

/// The same to the rotation of a foot that its series leads.
void add_foot_turn(const HarmonicGait& gait, const GaitSeries& series, std::size_t side, Vec3 turn) noexcept;

/// What the feet do in their swing times `factor`: heights and angles; where they stand stays.
void scale_steps(const HarmonicGait& gait, const GaitSeries& series, float factor) noexcept;

/// Every joint's model rotation when each is at its mean. Allocates.
std::vector<Quat> mean_models(const HarmonicGait& gait);

}  // namespace surefoot
