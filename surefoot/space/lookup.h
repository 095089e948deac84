#pragma once
// Where a point is among the simplices of a space. Private to the room.

#include <surefoot/space/blend_space.h>

namespace surefoot {

inline constexpr int k_corners = k_max_dimensions + 1;
using ScaledPoint = std::array<double, k_max_dimensions>;  ///< in shares of each axis' range, so that distances compare
using CornerWeights = std::array<double, k_corners>;

/// A simplex and the weights of its corners: those of the point, or of the nearest point of the hull.
struct Located {
    std::int32_t simplex = 0;
    CornerWeights weights{};  ///< >= 0 but for rounding
    bool outside = false;
};

/// The space as the lookup sees it. Needs at least one simplex; never allocates.
class Lookup {
  public:
    explicit Lookup(const BlendSpace& space) noexcept;

    ScaledPoint scaled(const SpacePoint& p) const noexcept {
        ScaledPoint q{};
        for (int k = 0; k < d_; ++k) q[k] = p[k] * scale_[k];
        return q;
    }
    ScaledPoint sample(std::int32_t i) const noexcept { return scaled(space_.samples[i]); }
    /// The mean of a simplex' corners by weights that add up to one.
    ScaledPoint mean(const Located& at) const noexcept;
    int dimensions() const noexcept { return d_; }

    Located locate(const ScaledPoint& p, std::int32_t hint) const noexcept;
    /// Weights of a point in a simplex of dimensions + 1 corners; false where it is flat in floating point.
    bool barycentric(const Simplex& simplex, const ScaledPoint& p, CornerWeights& w) const noexcept;

  private:
    bool is_full(const Simplex& simplex) const noexcept { return simplex[d_] >= 0; }
    int corners(const Simplex& simplex, int without, ScaledPoint* points, int* slots) const noexcept;
    double nearest(const ScaledPoint& p, const ScaledPoint* corner, int count, double* w) const noexcept;
    bool project(const ScaledPoint& p, const ScaledPoint* corner, int count, double* w) const noexcept;
    double nearest_face(const ScaledPoint& p, const ScaledPoint* corner, int count, double* w,
                        bool only_seen) const noexcept;
    Located clamp_to_hull(const ScaledPoint& p) const noexcept;

    const BlendSpace& space_;
    int d_;
    ScaledPoint scale_{};
};

}  // namespace surefoot
