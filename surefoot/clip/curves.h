#pragma once
// Numbers that change over a clip, as uniform cubic B-splines (de Boor, A Practical Guide to Splines, 1978, chapter
// IX): each has as many keys, of one or two bytes, as its error asks for. The small form of a clip's tracks
// (packed_clip.h); pack/fit_curves.h makes them.

#include <surefoot/base/table.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace surefoot {

/// Curves with the same number of keys of the same width.
struct CurveGroup {
    std::int32_t intervals = 1;  ///< the clip's duration in keys [Limit: 1 … 1e6; periodic >= 3]
    std::int32_t curves = 0;
    std::int32_t key_bytes = 2;  ///< 1 or 2
};

struct Curves {
    /// [Limit: k_most_curve_numbers] 0: there are no curves here. Numbers without a curve are 0.
    std::int32_t number_count = 0;
    bool periodic = false;  ///< the end runs on into the beginning; else a curve has three keys more
    std::vector<CurveGroup> groups;
    std::vector<std::uint16_t> numbers;  ///< [curve], group after group: which number it gives
    std::vector<float> steps;            ///< [curve]: what one unit of its keys is worth
    Table<std::int16_t> words;           ///< [group of two bytes][key][curve]
    Table<std::int8_t> bytes;            ///< [group of one byte][key][curve]

    bool empty() const noexcept { return number_count == 0; }
    std::size_t key_count(const CurveGroup& group) const noexcept {
        return static_cast<std::size_t>(group.intervals) + (periodic ? 0 : 3);
    }
};

inline constexpr int k_most_curve_numbers = 2048;

/// Where a share [0, 1] of the duration lies on a spline: the first of four keys, and what each weighs.
struct SplinePlace {
    int key = 0;
    float weight[4] = {};
};
constexpr SplinePlace spline_place(int intervals, float share) noexcept {
    const float at = share * static_cast<float>(intervals);
    const int key = at < static_cast<float>(intervals - 1) ? static_cast<int>(at) : intervals - 1;
    const float u = at - static_cast<float>(key), v = 1 - u;
    return {key,
            {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6}};
}

/// All numbers at a share [0, 1] of the duration; `values` receives number_count.
void curve_values(const Curves& curves, float share, std::span<float> values) noexcept;

/// What is wrong, as a sentence; empty: nothing.
std::string problem(const Curves& curves);

/// [bytes] of memory that they take.
std::size_t memory_size(const Curves& curves) noexcept;

}  // namespace surefoot
