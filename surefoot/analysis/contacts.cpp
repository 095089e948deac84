#include <surefoot/analysis/contacts.h>
#include <surefoot/analysis/ground_fit.h>
#include <surefoot/analysis/signal.h>

#include <algorithm>

namespace surefoot {
namespace {

// For a leg of 0.9 m; heights scale with the leg, speeds with its root (Froude).
constexpr float k_standard_leg = 0.9f;
constexpr float k_touch_height = 0.025f, k_leave_height = 0.045f;  // [m]
constexpr float k_touch_speed = 0.45f, k_leave_speed = 0.80f;      // [m/s] a rolling heel or toe moves up to 0.4
// A sole rolls on a shoe and over the ball, so the faster the body passes over it, the more of its speed it shows.
constexpr float k_touch_share = 0.12f, k_leave_share = 0.20f;  // of the body's speed
constexpr float k_shortest = 0.05f;                            // [s] shorter touches and gaps are noise
constexpr float k_shortest_swing = 0.08f;  // [s] a hasty step on the spot takes 0.1, a sprinter's swing 0.3
constexpr float k_smoothing = 0.015f;      // [s] of the paths before speeds are taken

struct Region {
    std::vector<float> height, speed;  ///< [m] above the ground, [m/s]
};

/// The lower and the slower of two sole points.
Region region_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const GroundFit& ground, float fps) {
    const std::vector<Vec3> va = derivative(smoothed(a, k_smoothing * fps), fps);
    const std::vector<Vec3> vb = derivative(smoothed(b, k_smoothing * fps), fps);
    Region region;
    for (std::size_t f = 0; f < a.size(); ++f) {
        region.height.push_back(std::min(a[f].y - ground.at(a[f]), b[f].y - ground.at(b[f])));
        region.speed.push_back(std::min(length(va[f]), length(vb[f])));
    }
    return region;
}

/// Local ground of a foot that stands at different heights: interpolated in time between its standing frames.
std::vector<float> between_stances(const std::vector<float>& lowest, const std::vector<char>& still) {
    std::vector<float> ground(lowest.size());
    const int n = static_cast<int>(lowest.size());
    int previous = -1;
    for (int f = 0; f <= n; ++f) {
        if (f < n && !still[static_cast<std::size_t>(f)]) continue;
        for (int g = previous + 1; g < std::min(f + 1, n); ++g) {
            const int a = previous >= 0 ? previous : f, b = f < n ? f : previous;
            if (a >= n || b < 0) {  // this foot never stands
                ground[static_cast<std::size_t>(g)] = lowest[static_cast<std::size_t>(g)];
                continue;
            }
            const float t = b > a ? static_cast<float>(g - a) / static_cast<float>(b - a) : 0;
            ground[static_cast<std::size_t>(g)] =
                (1 - t) * lowest[static_cast<std::size_t>(a)] + t * lowest[static_cast<std::size_t>(b)];
        }
        previous = f;
    }
    return ground;
}

/// Replaces runs shorter than `shortest` samples by what surrounds them; runs at the ends stay.
void drop_short_runs(std::vector<char>& flags, int shortest) {
    const int n = static_cast<int>(flags.size());
    for (const char value : {0, 1})  // gaps first, so that a flickering touch grows together
        for (int begin = 0; begin < n;) {
            int end = begin;
            while (end < n && flags[static_cast<std::size_t>(end)] == flags[static_cast<std::size_t>(begin)]) ++end;
            if (flags[static_cast<std::size_t>(begin)] == value && begin > 0 && end < n && end - begin < shortest)
                std::fill(flags.begin() + begin, flags.begin() + end, static_cast<char>(!value));
            begin = end;
        }
}

/// Speeds [m/s] below which a point comes to stand, and above which it no longer does.
struct SpeedLimits {
    float touch, leave;
};

SpeedLimits speed_limits(const Tracks& tracks, float scale) {
    std::vector<Vec3> hips;
    for (const Transform& joint : tracks.hips) hips.push_back(joint.translation);
    std::vector<float> pace;
    for (const Vec3 v : derivative(smoothed(hips, 0.1f * tracks.fps), tracks.fps)) pace.push_back(planar_length(v));
    const float body = median(pace), tempo = std::sqrt(scale);
    return {std::max(k_touch_speed * tempo, k_touch_share * body),
            std::max(k_leave_speed * tempo, k_leave_share * body)};
}

std::vector<char> touching(const Region& region, const std::vector<float>& ground, float scale,
                           const SpeedLimits& limits, float fps) {
    std::vector<char> flags;
    const auto stays = [&](std::size_t f) {
        return (region.height[f] - ground[f]) / scale < k_leave_height && region.speed[f] < limits.leave;
    };
    bool on = false;
    for (std::size_t f = 0; f < region.height.size(); ++f) {
        on = on ? stays(f) : (region.height[f] - ground[f]) / scale < k_touch_height && region.speed[f] < limits.touch;
        flags.push_back(on);
    }
    // Hysteresis must not depend on the direction of time: what the backward pass accepts counts too.
    on = false;
    for (std::size_t f = flags.size(); f-- > 0;) {
        on = on ? stays(f) : flags[f] != 0;
        if (on) flags[f] = 1;
    }
    drop_short_runs(flags, static_cast<int>(k_shortest * fps + 0.5f));
    return flags;
}

/// Where this region stands in the clip: the height at which it rests most (toe tips dip lower at push-off), but never
/// so high that a heel which only floats past (sprinting on the forefoot) would count as standing.
float standing_height(const Region& region, float scale) {
    std::vector<float> slow;
    for (std::size_t f = 0; f < region.height.size(); ++f)
        if (region.speed[f] < k_leave_speed) slow.push_back(region.height[f]);
    return std::clamp(densest(slow, 0.01f * scale), -0.04f * scale, 0.02f * scale);
}

/// A foot that is up for less time than any swing takes was never up: it keeps the state it had.
void bridge_short_lifts(std::vector<Contact>& states, int shortest) {
    const int n = static_cast<int>(states.size());
    for (int begin = 0; begin < n;) {
        int end = begin;
        const auto lifted = [&](int f) { return states[static_cast<std::size_t>(f)] == Contact::lifted; };
        while (end < n && lifted(end) == lifted(begin)) ++end;
        if (lifted(begin) && begin > 0 && end < n && end - begin < shortest)
            std::fill(states.begin() + begin, states.begin() + end, states[static_cast<std::size_t>(begin - 1)]);
        begin = end;
    }
}

}  // namespace

Contacts find_contacts(const Tracks& tracks, float leg_length) {
    Contacts contacts;
    const float scale = leg_length > 0.05f ? leg_length / k_standard_leg : 1;
    GroundFit ground = fit_ground(tracks, leg_length);
    contacts.uneven = !ground.planar;
    if (contacts.uneven || ground.samples == 0) ground.height = ground.slope_x = ground.slope_z = 0;
    const std::array<std::vector<char>, 2> still = still_feet(tracks, leg_length);
    const SpeedLimits limits = speed_limits(tracks, scale);
    for (std::size_t s = 0; s < 2; ++s) {
        const FootTrack& foot = tracks.foot[s];
        const Region regions[2] = {region_of(foot.heel, foot.heel, ground, tracks.fps),
                                   region_of(foot.ball, foot.tip, ground, tracks.fps)};
        std::vector<float> lowest = regions[0].height;
        for (std::size_t f = 0; f < lowest.size(); ++f) lowest[f] = std::min(lowest[f], regions[1].height[f]);
        const std::vector<float> local = between_stances(lowest, still[s]);
        std::vector<char> flags[2];
        for (int r = 0; r < 2; ++r) {
            const std::vector<float> flat(lowest.size(), standing_height(regions[r], scale));
            flags[r] = touching(regions[r], contacts.uneven ? local : flat, scale, limits, tracks.fps);
        }
        for (std::size_t f = 0; f < lowest.size(); ++f)
            contacts.state[s].push_back(flags[0][f] ? (flags[1][f] ? Contact::flat : Contact::heel)
                                                    : (flags[1][f] ? Contact::toe : Contact::lifted));
        bridge_short_lifts(contacts.state[s], static_cast<int>(k_shortest_swing * tracks.fps + 0.5f));
    }
    return contacts;
}

std::vector<PhaseEvent> find_events(const Contacts& contacts, float fps) {
    std::vector<PhaseEvent> events;
    for (int f = 1; f < static_cast<int>(contacts.state[0].size()); ++f)
        for (const Side side : {Side::left, Side::right}) {
            const bool before = contacts.down(side, f - 1), now = contacts.down(side, f);
            if (before != now)
                events.push_back({side, now ? StrideEvent::strike : StrideEvent::toe_off, static_cast<float>(f) / fps});
        }
    return events;
}

float planted_skate(const Tracks& tracks) {
    double sum = 0;
    std::size_t count = 0;
    for (const FootTrack& foot : tracks.foot)
        for (const std::vector<Vec3>* points : {&foot.heel, &foot.mid, &foot.ball, &foot.tip}) {
            const std::vector<Vec3> speed = derivative(smoothed(*points, 0.025f * tracks.fps), tracks.fps);
            std::vector<float> heights;
            for (const Vec3 p : *points) heights.push_back(p.y);
            const float limit = percentile(heights, 0.03f) + 0.015f;
            for (std::size_t f = 0; f < points->size(); ++f)
                if (heights[f] < limit && planar_length(speed[f]) < 0.25f) {
                    sum += static_cast<double>(planar_length(speed[f]));
                    ++count;
                }
        }
    return count ? static_cast<float>(sum / static_cast<double>(count)) : 0;
}

}  // namespace surefoot
