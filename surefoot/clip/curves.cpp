#include <surefoot/clip/curves.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

constexpr std::int32_t k_most_intervals = 1000000;

/// Eight curves at a time between their four keys: the compiler makes vectors of it, and every build the same bits.
template <typename Key>
void group_values(const Key* const (&keys)[4], const float (&weight)[4], std::size_t count, const float* steps,
                  const std::uint16_t* numbers, float* values) noexcept {
    constexpr std::size_t k_at_once = 8;
    std::size_t i = 0;
    const auto value = [&](std::size_t at) noexcept {
        return steps[at] *
               ((weight[0] * static_cast<float>(keys[0][at]) + weight[1] * static_cast<float>(keys[1][at])) +
                (weight[2] * static_cast<float>(keys[2][at]) + weight[3] * static_cast<float>(keys[3][at])));
    };
    for (; i + k_at_once <= count; i += k_at_once) {
        float some[k_at_once];
        for (std::size_t k = 0; k < k_at_once; ++k) some[k] = value(i + k);
        for (std::size_t k = 0; k < k_at_once; ++k) values[numbers[i + k]] = some[k];
    }
    for (; i < count; ++i) values[numbers[i]] = value(i);
}

template <typename Key>
void group_values(const Curves& curves, const CurveGroup& group, const Key* keys, float share, std::size_t first,
                  float* values) noexcept {
    const SplinePlace place = spline_place(group.intervals, share);
    const auto count = static_cast<std::size_t>(group.curves), key_count = curves.key_count(group);
    const Key* rows[4];
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t key = static_cast<std::size_t>(place.key) + k;
        rows[k] = keys + (key < key_count ? key : key - key_count) * count;
    }
    group_values(rows, place.weight, count, curves.steps.data() + first, curves.numbers.data() + first, values);
}

}  // namespace

void curve_values(const Curves& curves, float share, std::span<float> values) noexcept {
    assert(values.size() >= static_cast<std::size_t>(curves.number_count));
    std::fill_n(values.begin(), curves.number_count, 0.0f);
    share = std::min(std::max(0.0f, share), 1.0f);  // in this order: what is no number is 0
    const std::int16_t* words = curves.words.data();
    const std::int8_t* bytes = curves.bytes.data();
    std::size_t first = 0;
    for (const CurveGroup& group : curves.groups) {
        const std::size_t size = curves.key_count(group) * static_cast<std::size_t>(group.curves);
        if (group.key_bytes == 2) {
            group_values(curves, group, words, share, first, values.data());
            words += size;
        } else {
            group_values(curves, group, bytes, share, first, values.data());
            bytes += size;
        }
        first += static_cast<std::size_t>(group.curves);
    }
}

std::string problem(const Curves& curves) {
    if (curves.number_count < 0 || curves.number_count > k_most_curve_numbers) return "curves of too many numbers";
    std::size_t count = 0, words = 0, bytes = 0;
    for (const CurveGroup& group : curves.groups) {
        if (group.intervals < (curves.periodic ? 3 : 1) || group.intervals > k_most_intervals)
            return "a curve with a wrong number of keys";
        if (group.curves < 1 || group.curves > k_most_curve_numbers) return "an empty group of curves";
        if (group.key_bytes != 1 && group.key_bytes != 2) return "curves whose keys are neither bytes nor words";
        count += static_cast<std::size_t>(group.curves);
        (group.key_bytes == 2 ? words : bytes) += curves.key_count(group) * static_cast<std::size_t>(group.curves);
    }
    if (curves.numbers.size() != count || curves.steps.size() != count || curves.words.size() != words ||
        curves.bytes.size() != bytes)
        return "curves that do not match their keys";
    for (const std::uint16_t number : curves.numbers)
        if (number >= curves.number_count) return "a curve of a number that is not there";
    for (const float step : curves.steps)
        if (!std::isfinite(step)) return "a curve whose steps are no numbers";
    return {};
}

std::size_t memory_size(const Curves& curves) noexcept {
    return curves.groups.size() * sizeof(CurveGroup) + curves.numbers.size() * sizeof(std::uint16_t) +
           curves.steps.size() * sizeof(float) + curves.words.size() * sizeof(std::int16_t) + curves.bytes.size();
}

}  // namespace surefoot
