#pragma once
// Penalised least squares of many targets over few terms: min sum w |b C - y|^2 + sum w (p . C)^2. Private to the room.

#include <span>
#include <utility>
#include <vector>

namespace surefoot {

class RidgeProblem {
  public:
    RidgeProblem(std::size_t terms, std::size_t targets);

    void add_sample(std::span<const float> terms, std::span<const float> targets, double weight);
    /// `weight` times the square of a weighted sum of coefficients (index, factor), for each target.
    void add_penalty(const std::vector<std::pair<int, double>>& sum, double weight);
    /// [term][target], by Cholesky's factors. A term that neither samples nor penalties speak of comes out as 0.
    std::vector<float> solve() const;

  private:
    std::size_t terms_, targets_;
    std::vector<double> normal_;  // [term][term]
    std::vector<double> right_;   // [term][target]
};

}  // namespace surefoot
