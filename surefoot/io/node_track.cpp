#include <surefoot/io/node_track.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

// Keys are floats: at 100 s they are 8 us apart. A time this near a key (in seconds, and of the time) is the key.
constexpr double k_same_time = 1e-6, k_same_time_share = 2.5e-7;
// A key may lie this share of an interval away from its place on a grid.
constexpr double k_grid_slack = 0.02;
constexpr double k_coarsest_rate = 23.5, k_finest_rate = 1000;

template <typename T, typename Read>
T hermite(const Read& read, std::size_t key, float u, float interval) {
    // glTF 2.0 specification, appendix C.5: keys hold in-tangent, value, out-tangent.
    const float u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * read(3 * key + 1) + interval * (u3 - 2 * u2 + u) * read(3 * key + 2) +
           (3 * u2 - 2 * u3) * read(3 * key + 4) + interval * (u3 - u2) * read(3 * key + 3);
}

struct Four {
    float v[4];
    friend Four operator+(const Four& a, const Four& b) {
        return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]}};
    }
    friend Four operator*(float s, const Four& a) { return {{s * a.v[0], s * a.v[1], s * a.v[2], s * a.v[3]}}; }
};

/// Exactly what the file says where that is a unit already.
Quat unit(const Four& f) {
    const Quat q{f.v[0], f.v[1], f.v[2], f.v[3]};
    return std::fabs(dot(q, q) - 1) < 1e-6f ? q : normalized(q);
}

}  // namespace

TrackPlayer::Place TrackPlayer::find(double time) {
    const std::vector<float>& times = *track_->times;
    const double slack = k_same_time + k_same_time_share * std::fabs(time);
    if (key_ > 0 && static_cast<double>(times[key_]) > time + slack) key_ = 0;
    if (key_ + 1 < times.size() && static_cast<double>(times[key_ + 1]) <= time + slack) {
        const auto after =
            std::upper_bound(times.begin() + static_cast<std::ptrdiff_t>(key_) + 1, times.end(), time + slack,
                             [](double t, float key) { return t < static_cast<double>(key); });
        key_ = static_cast<std::size_t>(after - times.begin()) - 1;
    }
    const double passed = time - static_cast<double>(times[key_]);
    if (key_ + 1 >= times.size() || passed <= slack) return {key_, 0, 0};
    const double interval = static_cast<double>(times[key_ + 1]) - static_cast<double>(times[key_]);
    return {key_, static_cast<float>(std::fmin(1.0, passed / interval)), static_cast<float>(interval)};
}

Vec3 TrackPlayer::vector_at(double time) {
    const Place at = find(time);
    const auto read = [&](std::size_t i) {
        const float* v = track_->values->data() + 3 * i;
        return Vec3{v[0], v[1], v[2]};
    };
    if (track_->curve == NodeTrack::Curve::cubic)
        return at.share > 0 ? hermite<Vec3>(read, at.key, at.share, at.interval) : read(3 * at.key + 1);
    if (track_->curve == NodeTrack::Curve::step || at.share == 0) return read(at.key);
    return lerp(read(at.key), read(at.key + 1), at.share);
}

Quat TrackPlayer::rotation_at(double time) {
    const Place at = find(time);
    const auto read = [&](std::size_t i) {
        const float* v = track_->values->data() + 4 * i;
        return Four{{v[0], v[1], v[2], v[3]}};
    };
    if (track_->curve == NodeTrack::Curve::cubic)
        return unit(at.share > 0 ? hermite<Four>(read, at.key, at.share, at.interval) : read(3 * at.key + 1));
    if (track_->curve == NodeTrack::Curve::step || at.share == 0) return unit(read(at.key));
    return slerp(unit(read(at.key)), unit(read(at.key + 1)), at.share);
}

namespace {

/// How many keys miss the grid of that spacing.
std::size_t misses(std::span<const float> times, double start, double spacing) {
    std::size_t count = 0;
    for (const float time : times) {
        const double at = (static_cast<double>(time) - start) / spacing;
        const double slack = k_grid_slack + k_same_time_share * 2 * std::fabs(static_cast<double>(time)) / spacing;
        if (std::fabs(at - std::floor(at + 0.5)) > slack) ++count;
    }
    return count;
}

/// Intervals of a grid finer than the keys' own: that of a usual rate if all keys lie on it, else a whole multiple.
double refined(std::span<const float> times, double start, double duration, double intervals) {
    for (const double rate : {30.0, 24.0, 25.0, 60.0}) {
        const double candidate = std::floor(duration * rate + 0.5);
        if (candidate >= 1 && std::fabs(candidate / duration - rate) < 1e-4 * rate &&
            misses(times, start, duration / candidate) == 0)
            return candidate;
    }
    return intervals * std::ceil(30 * duration / intervals - 1e-6);
}

}  // namespace

TimeGrid fit_time_grid(std::span<const float> times, std::size_t most_frames) {
    TimeGrid grid;
    if (times.empty()) return grid;
    grid.start = static_cast<double>(times.front());
    const double duration = static_cast<double>(times.back()) - grid.start;
    double spacing = duration;
    for (std::size_t i = 1; i < times.size(); ++i) {
        const double step = static_cast<double>(times[i]) - static_cast<double>(times[i - 1]);
        if (step > 1.0 / k_finest_rate) spacing = std::fmin(spacing, step);
    }
    if (!(duration > 1.0 / k_finest_rate)) return grid;
    double intervals = std::floor(duration / spacing + 0.5);
    if (misses(times, grid.start, duration / intervals) == 0) {
        const double rate = intervals / duration;
        if (rate < k_coarsest_rate) intervals = refined(times, grid.start, duration, intervals);
    } else {
        double fewest = 0;
        double chosen = 0;
        for (const double rate : {30.0, 60.0, 120.0}) {
            const double candidate = std::fmax(1.0, std::floor(duration * rate + 0.5));
            const double missed = static_cast<double>(misses(times, grid.start, duration / candidate));
            if (chosen == 0 || missed < 0.5 * fewest) chosen = candidate, fewest = missed;
        }
        intervals = chosen;
    }
    const bool fits = intervals + 1 <= static_cast<double>(most_frames);
    grid.frames = fits ? static_cast<int>(intervals) + 1 : 0;
    grid.step = duration / intervals;
    grid.fps = intervals / duration;
    const double whole = std::floor(grid.fps + 0.5);
    if (std::fabs(grid.fps - whole) < 1e-4 * whole) grid.fps = whole;
    return grid;
}

}  // namespace surefoot
