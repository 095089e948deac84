#include <surefoot/ik/pace.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr int k_places = 128;                 // along the way
constexpr float k_spacing = 0.06f;            // [m]
constexpr float k_behind = 0.5f;              // [m] behind the root, where the trailing foot may stand yet
constexpr float k_climb_smooth = 0.37f;       // of the leg's length, that a step may climb or sink: on slopes
constexpr float k_climb_rough = 0.28f;        // on stairs, whose edges a foot must clear besides
constexpr float k_rough = 0.05f;              // [m] of a jump between two places, from which ground counts as stairs
constexpr float k_braking = 1.8f;             // [m/s^2] at which steering may be expected to slow down
constexpr float k_usual = 1.5f;               // [m/s] ground that this speed must brake for counts for slower ones, too
constexpr float k_slowest = 0.3f;             // [m/s] no ground is a reason to go more slowly than this
constexpr int k_shortest_step = 14;           // samples of the forecast: 0.23 s
constexpr float k_new_share = 0.4f;           // of a new measurement of the cadence
constexpr float k_ahead = 0.3f;               // [s] over which the root shows its way
constexpr double k_hold = 0.7;                // [s] at least, before a limit is lifted
constexpr double k_look_interval = 1.0 / 15;  // [s]
constexpr float k_stands = 0.05f;             // [m/s] a root slower than this tells no way: it will go as it faces

using Heights = std::array<float, k_places>;

/// Looks down from where the way has led so far, however high that is, at the first `count` places at least.
Heights heights_along(GroundProbe probe, Vec3 from, Vec3 way, int count) noexcept {
    constexpr std::size_t k_batch = 16;
    static_assert(k_places % k_batch == 0);
    Heights heights;
    std::array<Vec3, k_batch> places;
    for (std::size_t first = 0; first < static_cast<std::size_t>(count); first += k_batch) {
        for (std::size_t i = 0; i < k_batch; ++i)
            places[i] = from + way * (k_spacing * static_cast<float>(first + i) - k_behind);
        probe.heights(places, {heights.data() + first, k_batch});
        probe.level = probe.fallback = heights[first + k_batch - 1];
    }
    return heights;
}

/// The longest step from a place that the ground bears: half the way on which it climbs, or sinks, more than two steps
/// may, if that lies before the place `end`. [m]
float longest_step(const Heights& heights, int place, int end, float leg_length) noexcept {
    const auto at = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
    float rough = 0;
    for (int i = place + 1; i < end; ++i) {
        const float slope = (at(i) - at(place)) / static_cast<float>(i - place);
        rough = std::max(rough, std::fabs(at(i) - at(i - 1) - slope));
        const float share = std::min(rough / k_rough, 1.0f);
        const float climb = k_climb_smooth + (k_climb_rough - k_climb_smooth) * share;
        if (std::fabs(at(i) - at(place)) > 2 * climb * leg_length)
            return 0.5f * k_spacing * static_cast<float>(i - place);
    }
    return k_no_speed_limit;
}

}  // namespace

void measure_cadence(PaceState& pace, const Forecast& forecast) noexcept {
    int strikes = 0, first = Forecast::k_samples, last = 0;
    for (std::size_t side = 0; side < 2; ++side)
        for (int i = 0; i < forecast.run_count[side]; ++i) {
            const int strike = forecast.runs[side][static_cast<std::size_t>(i)].first;
            if (strike == 0) continue;  // it stands already: since when is not in sight
            ++strikes;
            first = std::min(first, strike);
            last = std::max(last, strike);
        }
    if (strikes < 2 || last - first < k_shortest_step * (strikes - 1)) return;  // feet that stop come down together
    const float measured = static_cast<float>((strikes - 1) * Forecast::k_rate) / static_cast<float>(last - first);
    pace.cadence += k_new_share * (measured - pace.cadence);
}

namespace {

/// Along the way of `root`, which has gone on to `later` in k_ahead: how fast it may go.
void look_along(const FootRig& rig, PaceState& pace, double clock, const GroundProbe& probe, const RootFrame& root,
                const RootFrame& later) noexcept {
    const Vec3 step{later.position.x - root.position.x, 0, later.position.z - root.position.z};
    const float speed = length(step) / k_ahead;
    const Vec3 way = speed > k_stands ? normalized(step) : rotate(from_yaw(root.yaw), {0, 0, 1});
    const float leg_length = std::min(rig.legs.side[0].length(), rig.legs.side[1].length());
    // Who slows down goes on doing so: places count as though the speed were still that from which it began.
    pace.from = std::max({pace.limit < k_no_speed_limit ? pace.from : 0, speed, k_usual});
    const auto away_of = [](int place) { return std::max(k_spacing * static_cast<float>(place) - k_behind, 0.0f); };
    // Beyond these there is time yet, whatever is there; and steps of so many places are as long as they are anyway.
    int places = 0;
    while (places < k_places && k_slowest * k_slowest + 2 * k_braking * away_of(places) < pace.from * pace.from)
        ++places;
    const float step_places = pace.from / (0.5f * k_spacing * pace.cadence);
    const int reach = static_cast<int>(std::min(step_places, static_cast<float>(k_places))) + 2;
    const auto end_of = [&](int place) { return std::min(place + reach, k_places); };
    const Heights heights = heights_along(probe, root.position, way, end_of(places));
    float limit = k_no_speed_limit;
    for (int i = 0; i < places; ++i) {
        const float away = away_of(i);
        const float bears = longest_step(heights, i, end_of(i), leg_length);
        if (bears >= k_no_speed_limit) continue;
        const float there = std::max(bears * pace.cadence, k_slowest);
        if (there * there + 2 * k_braking * away < pace.from * pace.from) limit = std::min(limit, there);
    }
    // The edges of stairs lie now so, now so to where the root is: what counts is the least over a tread.
    if (limit > pace.limit && clock < pace.held_until) return;
    pace.limit = limit;
    pace.held_until = clock + k_hold;
}

}  // namespace

void keep_pace(const FootRig& rig, FootPlacementState& state, const FootInput& input, const GroundProbe& probe,
               const LegPreview& preview) noexcept {
    PaceState& pace = state.pace;
    if (state.clock < pace.next_look) return;
    LegsPose legs;
    RootFrame later;
    preview.sample({&k_ahead, 1}, {&legs, 1}, {&later, 1});
    look_along(rig, pace, state.clock, probe, input.root, later);
    pace.next_look = state.clock + k_look_interval;
}

}  // namespace surefoot
