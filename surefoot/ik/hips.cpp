#include <surefoot/ik/hips.h>

#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

float FootholdLine::at(double time) const noexcept {
    if (count == 0) return 0;
    const auto pass = [&](int i) -> const FootholdPass& { return passes[static_cast<std::size_t>(i)]; };
    if (time <= pass(0).time) return pass(0).height;
    for (int i = 1; i < count; ++i)
        if (time < pass(i).time) {
            const auto share = static_cast<float>((time - pass(i - 1).time) / (pass(i).time - pass(i - 1).time));
            return pass(i - 1).height + (pass(i).height - pass(i - 1).height) * share;
        }
    return pass(count - 1).height;
}

void FootholdLine::add(FootholdPass added) noexcept {
    constexpr double k_same = 0.08;  // [s] both feet of a standing character; a polyline needs time between its points
    for (int i = 0; i < count; ++i) {
        FootholdPass& pass = passes[static_cast<std::size_t>(i)];
        if (std::fabs(pass.time - added.time) < k_same) {
            pass.height = 0.5f * (pass.height + added.height);
            return;
        }
    }
    if (count == k_capacity) {
        std::move(passes.begin() + 1, passes.end(), passes.begin());
        --count;
    }
    int place = count;
    while (place > 0 && passes[static_cast<std::size_t>(place - 1)].time > added.time) {
        passes[static_cast<std::size_t>(place)] = passes[static_cast<std::size_t>(place - 1)];
        --place;
    }
    passes[static_cast<std::size_t>(place)] = added;
    ++count;
}

void FootholdLine::keep_past(double time) noexcept {
    while (count > 0 && passes[static_cast<std::size_t>(count - 1)].time > time) --count;
    constexpr int k_kept = 2;
    if (count <= k_kept) return;
    std::move(passes.begin() + (count - k_kept), passes.begin() + count, passes.begin());
    count = k_kept;
}

void HeightSpring::step(float target, float stiffness, float dt) noexcept {
    step(target, stiffness, dt, exp(-stiffness * dt));
}

void HeightSpring::step(float target, float stiffness, float dt, float decay) noexcept {
    const float offset = value - target, c = rate + stiffness * offset;
    value = target + (offset + c * dt) * decay;
    rate = (rate - stiffness * c * dt) * decay;
}

void HeightRest::step(float stiffness, float dt) noexcept {
    // (value + b t + c t^2) e^(-stiffness t): three poles in one place.
    const float w = stiffness, b = rate + w * value, c = 0.5f * (acceleration + w * (2 * rate + w * value));
    const float now = value + dt * (b + dt * c), slope = b + 2 * dt * c, decay = exp(-w * dt);
    value = now * decay;
    rate = (slope - w * now) * decay;
    acceleration = (2 * c - w * (2 * slope - w * now)) * decay;
}

void HipLimiter::fill(double time, float shortfall) noexcept {
    ring_.fill(std::min(shortfall, 0.0f));
    last_ = static_cast<std::int64_t>(std::floor(time * k_rate)) + 1;
}

void HipLimiter::set(std::int64_t slot, float shortfall) noexcept {
    const float latest = get(last_);
    for (std::int64_t between = std::max(last_ + 1, slot - k_slots); between < slot; ++between)
        ring_[static_cast<std::size_t>(between % k_slots)] = latest;
    ring_[static_cast<std::size_t>(slot % k_slots)] = std::min(shortfall, 0.0f);
    last_ = std::max(last_, slot);
}

float HipLimiter::get(std::int64_t slot) const noexcept {
    slot = std::clamp(slot, std::max<std::int64_t>(last_ - k_slots + 1, 0), last_);
    return ring_[static_cast<std::size_t>(slot % k_slots)];
}

float HipLimiter::at(double time) const noexcept {
    const double now = std::max(time, 0.0) * k_rate;
    const auto middle = static_cast<std::int64_t>(std::floor(now));
    constexpr int k_window = 2 * k_half + 1, k_windows = 2 * k_half + 2;
    std::array<float, k_window + k_windows - 1> near;  // slots of all windows
    for (std::size_t j = 0; j < near.size(); ++j) near[j] = get(middle - 2 * k_half + static_cast<std::int64_t>(j));
    float sum = 0, weights = 0;
    for (int i = 0; i < k_windows; ++i) {
        const auto x = static_cast<float>((now - static_cast<double>(middle - k_half + i)) / k_half);
        if (x <= -1 || x >= 1) continue;
        const float inside = 1 - x * x, weight = inside * inside * inside;
        float least = 0;
        for (int j = i; j < i + k_window; ++j) least = std::min(least, near[static_cast<std::size_t>(j)]);
        sum += weight * least;
        weights += weight;
    }
    return weights > 0 ? sum / weights : 0;
}

}  // namespace surefoot
