#pragma once
// Numbers of a clip to curves (clip/curves.h): least-squares splines, each with the fewest bytes that keep it near
// enough.

#include <surefoot/clip/curves.h>

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace surefoot {

/// Fits every number at many key counts once; asking for another tolerance then costs nothing.
class CurveFitter {
  public:
    /// `finest` [m]: no tolerance will be below it. [Limit: frames >= 4]
    CurveFitter(int frames, bool periodic, float finest);
    /// One value a frame, evenly over the clip; where it is periodic, the last is the first. `reach`: how far a unit of
    /// the number moves what is seen [m].
    void add(int number, std::span<const double> values, double reach);
    /// Curves of all numbers, each within tolerance / reach of its values, or as near as every frame's key brings it.
    Curves curves(float tolerance, int number_count) const;

  private:
    /// Keys of a curve, in units of `step`.
    struct Choice {
        int intervals = 0, key_bytes = 2;
        double step = 0, error = 0;  ///< error [m]
        std::vector<std::int16_t> keys;
        std::size_t size() const { return keys.size() * static_cast<std::size_t>(key_bytes); }
    };
    struct Number {
        int number = 0;
        double size = 0;  ///< [m] the error of no curve at all
        std::vector<Choice> choices;
    };
    /// Where each frame lies on a spline of that many intervals.
    const std::vector<SplinePlace>& places(int intervals);
    std::vector<double> fitted(int intervals, std::span<const double> values);
    std::vector<double> played(int intervals, std::span<const double> keys);
    void add_choices(Number& number, int intervals, std::span<const double> values, double reach);
    std::size_t key_count(int intervals) const { return static_cast<std::size_t>(intervals) + (periodic_ ? 0 : 3); }

    int frames_;
    bool periodic_;
    double finest_;
    std::vector<int> intervals_;
    std::map<int, std::vector<SplinePlace>> places_;
    std::vector<Number> numbers_;
};

}  // namespace surefoot
