#include <surefoot/analysis/ground_fit.h>
#include <surefoot/analysis/signal.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_still = 0.22f;        // [m/s] of heel and ball, for a leg of 0.9 m
constexpr float k_smoothing = 0.015f;   // [s]
constexpr float k_scatter = 0.012f;     // [m] of soles on one plane in motion capture
constexpr float k_tolerance = 0.04f;    // [m] farther from the plane is another level
constexpr float k_on_plane = 0.85f;     // share of samples within that, for one plane
constexpr float k_hull_window = 0.55f;  // [s] half of it: any stride has a stance of the same foot within

struct Standing {
    double x, z, y;
};

/// Plane through weighted points by normal equations about their mean; slopes are held down where the points do not
/// spread (a ridge worth a point 20 cm aside).
GroundFit weighted_plane(const std::vector<Standing>& points, const std::vector<double>& weights) {
    double n = 0, mx = 0, mz = 0, my = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        n += weights[i];
        mx += weights[i] * points[i].x;
        mz += weights[i] * points[i].z;
        my += weights[i] * points[i].y;
    }
    mx /= n, mz /= n, my /= n;
    const double ridge = 0.04 * n;
    double xx = ridge, zz = ridge, xz = 0, xy = 0, zy = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double x = points[i].x - mx, z = points[i].z - mz, y = points[i].y - my;
        xx += weights[i] * x * x, zz += weights[i] * z * z, xz += weights[i] * x * z;
        xy += weights[i] * x * y, zy += weights[i] * z * y;
    }
    const double det = xx * zz - xz * xz;
    const double sx = (zz * xy - xz * zy) / det, sz = (xx * zy - xz * xy) / det;
    GroundFit fit;
    fit.slope_x = static_cast<float>(sx);
    fit.slope_z = static_cast<float>(sz);
    fit.height = static_cast<float>(my - sx * mx - sz * mz);
    return fit;
}

}  // namespace

std::array<std::vector<char>, 2> still_feet(const Tracks& tracks, float leg_length) {
    std::array<std::vector<char>, 2> still;
    const float limit = k_still * std::sqrt(std::max(leg_length, 0.05f) / 0.9f);
    for (std::size_t s = 0; s < 2; ++s) {
        const std::vector<Vec3> heel = derivative(smoothed(tracks.foot[s].heel, k_smoothing * tracks.fps), tracks.fps);
        const std::vector<Vec3> ball = derivative(smoothed(tracks.foot[s].ball, k_smoothing * tracks.fps), tracks.fps);
        for (std::size_t f = 0; f < heel.size(); ++f)
            still[s].push_back(length(heel[f]) < limit && length(ball[f]) < limit);
    }
    return still;
}

GroundFit fit_ground(const Tracks& tracks, float leg_length) {
    const std::array<std::vector<char>, 2> still = still_feet(tracks, leg_length);
    std::vector<Standing> points;
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t f = 0; f < still[s].size(); ++f)
            if (still[s][f]) {
                const Vec3 heel = tracks.foot[s].heel[f], ball = tracks.foot[s].ball[f];
                points.push_back({static_cast<double>(0.5f * (heel.x + ball.x)),
                                  static_cast<double>(0.5f * (heel.z + ball.z)),
                                  static_cast<double>(std::min(heel.y, ball.y))});
            }
    GroundFit fit;
    if (points.empty()) return fit;
    std::vector<double> weights(points.size(), 1.0);
    fit = weighted_plane(points, weights);
    int on_plane = 0;
    for (int round = 0; round < 15; ++round) {
        on_plane = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 p{static_cast<float>(points[i].x), static_cast<float>(points[i].y),
                         static_cast<float>(points[i].z)};
            const double off = static_cast<double>((p.y - fit.at(p)) / k_scatter);
            weights[i] = 1 / (1 + off * off);
            on_plane += std::fabs(p.y - fit.at(p)) < k_tolerance;
        }
        fit = weighted_plane(points, weights);
    }
    fit.samples = static_cast<int>(points.size());
    fit.planar = static_cast<float>(on_plane) >= k_on_plane * static_cast<float>(points.size());
    return fit;
}

float ground_trend(const Tracks& tracks) {
    const int n = tracks.frame_count(), reach = static_cast<int>(k_hull_window * tracks.fps) + 1;
    if (n <= 2 * reach) return 0;
    double count = 0, st = 0, sy = 0, stt = 0, sty = 0;
    for (const FootTrack& foot : tracks.foot) {
        std::vector<float> low;
        for (std::size_t f = 0; f < foot.heel.size(); ++f) low.push_back(std::min(foot.heel[f].y, foot.ball[f].y));
        for (int f = reach; f + reach < n; ++f) {
            const float hull = *std::min_element(low.begin() + (f - reach), low.begin() + (f + reach + 1));
            const double t = static_cast<double>(f) / static_cast<double>(tracks.fps), y = static_cast<double>(hull);
            count += 1, st += t, sy += y, stt += t * t, sty += t * y;
        }
    }
    const double spread = stt - st * st / count;
    return spread > 1e-6 ? static_cast<float>((sty - st * sy / count) / spread) : 0;
}

}  // namespace surefoot
