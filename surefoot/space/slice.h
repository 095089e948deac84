#pragma once
// Cutting a space of two to four dimensions with a plane: what can be drawn of it, and so be understood. The plane runs
// along two of the axes through a point; in it every simplex that it meets is a convex polygon, and around the point
// lies the live one. Not for the frame: it allocates.

#include <surefoot/space/blend_space.h>

#include <array>
#include <vector>

namespace surefoot {

/// A place in the cutting plane, in units of the two free axes.
using PlanePoint = std::array<double, 2>;

struct SliceCell {
    std::int32_t simplex = 0;
    std::vector<PlanePoint> polygon;  ///< convex, counter-clockwise (first axis to the right, second up), >= 3 corners
};

struct SpaceSlice {
    std::array<int, 2> axes{0, 1};  ///< the two free ones: right, up
    SpacePoint at{};                ///< the plane goes through it
    std::vector<SliceCell> cells;   ///< in order of simplex; those that the plane merely touches are left out
    BlendWeights live;              ///< what plays at the point
    /// Of `cells`: the one around the point (of several that share it, one), or the one of the simplex that holds the
    /// nearest point of the hull; -1 where the plane does not meet that.
    int live_cell = -1;
};

/// The plane through `at` along axes `right` and `up` (different, within the space's). Where all samples lie on a line,
/// a plane, …, so that simplices have fewer corners than dimensions + 1, there are no cells but still weights.
SpaceSlice slice(const BlendSpace& space, const SpacePoint& at, int right, int up);

}  // namespace surefoot
