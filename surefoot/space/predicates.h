#pragma once
// The two exact questions that triangulation asks, in 1 to 4 dimensions, on the 16-bit lattice.
//
// Bit budget, for four dimensions (fewer need less). Coordinates are 0 … 65535, so differences are below 2^16 in size.
// By cofactor expansion a 2 x 2 minor is below 2 * 2^32 = 2^33, a 3 x 3 one below 3 * 2^16 * 2^33 < 2^51 (both fit 64
// bits), a 4 x 4 one below 4 * 2^16 * 2^51 = 2^69. A lifted coordinate (the squared distance) is below 4 * 2^32 = 2^34,
// so the in-sphere determinant, five such products, is below 5 * 2^34 * 2^69 < 2^106: all sums fit 128 bits with room.

#include <surefoot/space/triangulate.h>

namespace surefoot {

/// 128-bit integers; every compiler we build with has them on every target.
__extension__ typedef __int128 Wide;

/// Insertion sort, for the handful of corners that a simplex has.
template <typename T, typename Less>
constexpr void sort_few(T* first, int count, const Less& less) {
    for (int i = 1; i < count; ++i) {
        const T value = first[i];
        int j = i;
        for (; j > 0 && less(value, first[j - 1]); --j) first[j] = first[j - 1];
        first[j] = value;
    }
}

/// d! times the signed volume of the simplex p[0] … p[d]: positive, negative, or zero where they are dependent.
Wide orientation(int dimensions, const LatticePoint* p) noexcept;

/// True where `q` lies inside the sphere through the positively oriented simplex p[0] … p[d]. A point exactly on the
/// sphere is decided by symbolic perturbation: every point's lifted coordinate is raised by its own infinitesimal, and
/// that of the lexicographically smaller position is larger beyond all measure. So the answer is never "on", depends on
/// positions alone, and all answers together belong to one (regular) triangulation. The points must be distinct.
bool in_sphere(int dimensions, const LatticePoint* p, const LatticePoint& q) noexcept;

/// Rank of the affine hull of the points: 0 for one place, 1 for a line, … at most `dimensions`. `basis` receives
/// rank + 1 indices of points that span it.
int affine_rank(int dimensions, std::span<const LatticePoint> points,
                std::array<std::int32_t, k_max_dimensions + 1>& basis) noexcept;

}  // namespace surefoot
