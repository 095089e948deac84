#include <surefoot/pack/fit_curves.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace surefoot {

namespace {

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Conjugate gradients for a symmetric positive matrix, given as what it does to a vector. Where there are more
/// unknowns than the matrix tells apart (an open curve with a key a frame), the smallest solution.
template <typename Apply>
std::vector<double> solve(const Apply& apply, std::vector<double> residual) {
    constexpr int k_most_rounds = 200;
    constexpr double k_done = 1e-24;  // of the squared residual: far below what 16 bits can tell
    std::vector<double> x(residual.size(), 0.0), direction = residual;
    double square = dot(residual, residual);
    const double enough = square * k_done;
    for (int round = 0; round < k_most_rounds && square > enough; ++round) {
        const std::vector<double> image = apply(direction);
        const double step = square / dot(direction, image);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * direction[i], residual[i] -= step * image[i];
        const double next = dot(residual, residual);
        for (std::size_t i = 0; i < x.size(); ++i) direction[i] = residual[i] + next / square * direction[i];
        square = next;
    }
    return x;
}

/// From a few keys to as many as there are frames, a sixth more each time.
std::vector<int> interval_counts(int least, int most) {
    std::vector<int> counts;
    for (int n = least; n < most; n = std::max(n + 1, n + n / 6)) counts.push_back(n);
    counts.push_back(most);
    return counts;
}

}  // namespace

CurveFitter::CurveFitter(int frames, bool periodic, float finest)
    : frames_(frames), periodic_(periodic), finest_(finest) {
    assert(frames >= 4);
    intervals_ = interval_counts(periodic ? 3 : 1, frames - 1);
}

const std::vector<SplinePlace>& CurveFitter::places(int intervals) {
    std::vector<SplinePlace>& places = places_[intervals];
    if (places.empty())
        for (int f = 0; f < frames_; ++f)
            places.push_back(spline_place(intervals, static_cast<float>(f) / static_cast<float>(frames_ - 1)));
    return places;
}

std::vector<double> CurveFitter::played(int intervals, std::span<const double> keys) {
    std::vector<double> values;
    for (const SplinePlace& place : places(intervals)) {
        double value = 0;
        for (std::size_t k = 0; k < 4; ++k)
            value +=
                static_cast<double>(place.weight[k]) * keys[(static_cast<std::size_t>(place.key) + k) % keys.size()];
        values.push_back(value);
    }
    return values;
}

std::vector<double> CurveFitter::fitted(int intervals, std::span<const double> values) {
    const std::vector<SplinePlace>& where = places(intervals);
    const std::size_t count = key_count(intervals);
    const auto gathered = [&](std::span<const double> of_frames) {
        std::vector<double> sums(count, 0.0);
        for (std::size_t f = 0; f < of_frames.size(); ++f)
            for (std::size_t k = 0; k < 4; ++k)
                sums[(static_cast<std::size_t>(where[f].key) + k) % count] +=
                    static_cast<double>(where[f].weight[k]) * of_frames[f];
        return sums;
    };
    return solve([&](const std::vector<double>& keys) { return gathered(played(intervals, keys)); }, gathered(values));
}

void CurveFitter::add_choices(Number& number, int intervals, std::span<const double> values, double reach) {
    const std::vector<double> keys = fitted(intervals, values);
    double largest = 0;
    for (const double key : keys) largest = std::max(largest, std::fabs(key));
    for (const int key_bytes : {1, 2}) {
        const int units =
            key_bytes == 1 ? std::numeric_limits<std::int8_t>::max() : std::numeric_limits<std::int16_t>::max();
        Choice choice{intervals, key_bytes, largest / units, 0, {}};
        std::vector<double> rounded;
        for (const double key : keys) {
            choice.keys.push_back(static_cast<std::int16_t>(std::lround(key / choice.step)));
            rounded.push_back(choice.keys.back() * choice.step);
        }
        const std::vector<double> got = played(intervals, rounded);
        for (std::size_t f = 0; f < got.size(); ++f)
            choice.error = std::max(choice.error, std::fabs(got[f] - values[f]) * reach);
        number.choices.push_back(std::move(choice));
    }
}

void CurveFitter::add(int number, std::span<const double> values, double reach) {
    assert(values.size() == static_cast<std::size_t>(frames_));
    Number added{number, 0, {}};
    for (const double value : values) added.size = std::max(added.size, std::fabs(value) * reach);
    for (const int intervals : intervals_) {
        if (added.size <= finest_) break;
        add_choices(added, intervals, values, reach);
        if (added.choices.back().error <= finest_) break;
    }
    numbers_.push_back(std::move(added));
}

Curves CurveFitter::curves(float tolerance, int number_count) const {
    std::map<std::pair<int, int>, std::vector<std::pair<int, const Choice*>>> groups;  // by width, intervals
    for (const Number& number : numbers_) {
        if (number.size <= static_cast<double>(tolerance) || number.choices.empty()) continue;
        const Choice* best = nullptr;
        for (const Choice& choice : number.choices)
            if (choice.error <= static_cast<double>(tolerance) && (!best || choice.size() < best->size()))
                best = &choice;
        if (!best)
            best = &*std::min_element(number.choices.begin(), number.choices.end(),
                                      [](const Choice& a, const Choice& b) { return a.error < b.error; });
        groups[{-best->key_bytes, best->intervals}].push_back({number.number, best});
    }
    Curves curves;
    curves.number_count = number_count;
    curves.periodic = periodic_;
    std::vector<std::int16_t> words;
    std::vector<std::int8_t> bytes;
    for (const auto& [kind, members] : groups) {
        curves.groups.push_back({kind.second, static_cast<std::int32_t>(members.size()), -kind.first});
        for (const auto& [number, choice] : members) {
            curves.numbers.push_back(static_cast<std::uint16_t>(number));
            curves.steps.push_back(static_cast<float>(choice->step));
        }
        for (std::size_t key = 0; key < key_count(kind.second); ++key)
            for (const auto& [number, choice] : members) {
                if (choice->key_bytes == 2)
                    words.push_back(choice->keys[key]);
                else
                    bytes.push_back(static_cast<std::int8_t>(choice->keys[key]));
            }
    }
    curves.words = std::move(words);
    curves.bytes = std::move(bytes);
    return curves;
}

}  // namespace surefoot
