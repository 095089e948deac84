#pragma once
// Low-pass filtering of uniformly sampled signals that neither shifts their phase nor bends them at the ends.

#include <vector>

namespace surefoot {

/// Gaussian of `sigma` samples. Where the window leaves the signal, a Gaussian-weighted straight line is fitted instead
/// of an average (local linear regression, Cleveland 1979), so a linear trend comes out unchanged to its very ends.
std::vector<double> low_pass(const std::vector<double>& signal, double sigma);

/// The same for a signal that repeats every `period` samples with `jump` added: signal[i + period] = signal[i] + jump.
/// Needs `period` samples at least; the result is as long as the signal, and repeats the same way.
std::vector<double> low_pass_periodic(const std::vector<double>& signal, int period, double jump, double sigma);

}  // namespace surefoot
