#include <surefoot/fit/ridge.h>

#include <cmath>

namespace surefoot {

RidgeProblem::RidgeProblem(std::size_t terms, std::size_t targets)
    : terms_(terms), targets_(targets), normal_(terms * terms), right_(terms * targets) {}

void RidgeProblem::add_sample(std::span<const float> terms, std::span<const float> targets, double weight) {
    for (std::size_t i = 0; i < terms_; ++i) {
        const double t = weight * static_cast<double>(terms[i]);
        if (t == 0) continue;
        for (std::size_t j = 0; j < terms_; ++j) normal_[i * terms_ + j] += t * static_cast<double>(terms[j]);
        for (std::size_t k = 0; k < targets_; ++k) right_[i * targets_ + k] += t * static_cast<double>(targets[k]);
    }
}

void RidgeProblem::add_penalty(const std::vector<std::pair<int, double>>& sum, double weight) {
    for (const auto& [i, a] : sum)
        for (const auto& [j, b] : sum)
            normal_[static_cast<std::size_t>(i) * terms_ + static_cast<std::size_t>(j)] += weight * a * b;
}

std::vector<float> RidgeProblem::solve() const {
    constexpr double k_unknown = 1e-9;  // of a pivot: nothing was said of this term
    std::vector<double> lower = normal_;
    std::vector<bool> known(terms_, true);
    for (std::size_t j = 0; j < terms_; ++j) {
        double* row = lower.data() + j * terms_;
        for (std::size_t k = 0; k < j; ++k) {
            double sum = row[k];
            for (std::size_t m = 0; m < k; ++m) sum -= row[m] * lower[k * terms_ + m];
            row[k] = known[k] ? sum / lower[k * terms_ + k] : 0;
        }
        double pivot = row[j];
        for (std::size_t m = 0; m < j; ++m) pivot -= row[m] * row[m];
        known[j] = pivot > k_unknown;
        row[j] = known[j] ? std::sqrt(pivot) : 1;
    }
    std::vector<double> x = right_;
    for (std::size_t j = 0; j < terms_; ++j)
        for (std::size_t k = 0; k < targets_; ++k) {
            double sum = x[j * targets_ + k];
            for (std::size_t m = 0; m < j; ++m) sum -= lower[j * terms_ + m] * x[m * targets_ + k];
            x[j * targets_ + k] = known[j] ? sum / lower[j * terms_ + j] : 0;
        }
    for (std::size_t j = terms_; j-- > 0;)
        for (std::size_t k = 0; k < targets_; ++k) {
            double sum = x[j * targets_ + k];
            for (std::size_t m = j + 1; m < terms_; ++m) sum -= lower[m * terms_ + j] * x[m * targets_ + k];
            x[j * targets_ + k] = known[j] ? sum / lower[j * terms_ + j] : 0;
        }
    return {x.begin(), x.end()};
}

}  // namespace surefoot
