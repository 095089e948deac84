#include <surefoot/analysis/strikes.h>

#include <algorithm>

namespace surefoot {

std::vector<PhaseEvent> alternating_strikes(std::span<const PhaseEvent> events, float duration, float fps) {
    std::vector<PhaseEvent> strikes;
    for (const PhaseEvent& event : events) {
        if (event.kind != StrideEvent::strike) continue;
        const float time = std::min(std::max(event.time, 0.0f), duration);
        const float nearest = 0.25f / fps;
        if (!strikes.empty() && duration - time <= nearest && strikes.front().time <= nearest &&
            strikes.front().foot == event.foot)
            continue;
        strikes.push_back({event.foot, event.kind, time});
    }
    std::stable_sort(strikes.begin(), strikes.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    const std::size_t count = strikes.size();
    if (count < 2 || count % 2 != 0) return {};
    for (std::size_t i = 0; i < count; ++i) {
        const PhaseEvent &a = strikes[i], &b = strikes[(i + 1) % count];
        const float gap = i + 1 < count ? b.time - a.time : b.time + duration - a.time;
        if (a.foot == b.foot || gap <= 0.5f / fps) return {};
    }
    return strikes;
}

}  // namespace surefoot
