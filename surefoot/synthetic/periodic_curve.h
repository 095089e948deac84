#pragma once
// A smooth periodic curve through keys over phase, without overshoot: where two keys have the same value the curve is
// flat between them, which is how a foot is kept exactly still.

#include <vector>

namespace surefoot {

/// Monotone piecewise cubic (F. Fritsch and J. Butland, "A method for constructing local monotone piecewise cubic
/// interpolants", SIAM J. Sci. Stat. Comput. 5, 1984), continued with period 1.
class PeriodicCurve {
  public:
    struct Key {
        float phase = 0;  ///< [0, 1), strictly ascending
        float value = 0;
    };
    PeriodicCurve() = default;
    explicit PeriodicCurve(std::vector<Key> keys);

    /// Any phase; 0 without keys.
    float operator()(float phase) const noexcept;

  private:
    std::vector<Key> keys_;
    std::vector<float> slopes_;
};

}  // namespace surefoot
