#include <surefoot/analysis/leg_track.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

constexpr double k_smoothing = 0.025;       // [s] sigma of the Gaussian before derivatives
constexpr float k_planted_height = 0.015f;  // [m] above the point's own 3rd percentile
constexpr double k_percentile = 0.03;
constexpr double k_planted_speed = 0.25;  // [m/s]
constexpr double k_skating_speed = 0.10;  // [m/s]
constexpr float k_lying_height = 0.01f;   // [m] above the ground
constexpr double k_skate_height = 0.025;  // [m] Zhang et al. 2018: H
constexpr double k_cm = 100, k_degrees = 180 / k_pi;

using Series = std::vector<double>;
using Mask = std::vector<bool>;

/// First derivative of the smoothed series, central.
Series rate(const Series& x, double fps) {
    const Series s = smoothed_series(x, fps);
    Series out(x.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        const std::size_t a = i ? i - 1 : 0, b = std::min(i + 1, s.size() - 1);
        out[i] = b > a ? (s[b] - s[a]) * fps / static_cast<double>(b - a) : 0;
    }
    return out;
}

struct Velocity {
    Series x, y, z;
    double level(std::size_t i) const { return std::sqrt(x[i] * x[i] + z[i] * z[i]); }
    /// Of what is perpendicular to `normal`.
    double along(std::size_t i, Vec3 normal) const {
        const double n[]{static_cast<double>(normal.x), static_cast<double>(normal.y), static_cast<double>(normal.z)};
        const double off = x[i] * n[0] + y[i] * n[1] + z[i] * n[2];
        const double u = x[i] - off * n[0], v = y[i] - off * n[1], w = z[i] - off * n[2];
        return std::sqrt(u * u + v * v + w * w);
    }
    double full(std::size_t i) const { return std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]); }
};

Velocity sole_velocity(const WalkTrack& track, std::size_t side, std::size_t point) {
    Series x, y, z;
    for (const TrackFrame& frame : track.frames) {
        const Vec3 p = frame.legs[side].sole[point];
        x.push_back(static_cast<double>(p.x));
        y.push_back(static_cast<double>(p.y));
        z.push_back(static_cast<double>(p.z));
    }
    const auto fps = static_cast<double>(track.fps);
    return {rate(x, fps), rate(y, fps), rate(z, fps)};
}

}  // namespace

/// Gaussian of k_smoothing; at the ends over what there is.
std::vector<double> smoothed_series(const Series& x, double fps) {
    const double sigma = k_smoothing * fps;
    const int radius = static_cast<int>(std::ceil(3 * sigma)), count = static_cast<int>(x.size());
    Series weights;
    for (int i = 0; i <= radius; ++i) weights.push_back(exp(-0.5 * i * i / (sigma * sigma)));
    Series out(x.size());
    for (int i = 0; i < count; ++i) {
        // As a correction to the middle: a constant stays itself to the last bit, and far from the origin nothing is
        // lost.
        double sum = 0, total = 0;
        const double middle = x[static_cast<std::size_t>(i)];
        for (int k = -radius; k <= radius; ++k) {
            // Mirrored through the ends, so that a straight line stays straight.
            const int j = i + k, r = j < 0 ? -j : j >= count ? 2 * (count - 1) - j : j;
            if (r < 0 || r >= count) continue;
            const double value = x[static_cast<std::size_t>(r)];
            const double at_end = x[static_cast<std::size_t>(j < 0 ? 0 : count - 1)];
            const double w = weights[static_cast<std::size_t>(std::abs(k))];
            sum += w * ((r == j ? value : 2 * at_end - value) - middle);
            total += w;
        }
        out[static_cast<std::size_t>(i)] = middle + sum / total;
    }
    return out;
}

TrackFrame track_frame(const RootFrame& root, std::span<const Transform> world, const Legs& legs) {
    const auto at = [&](int joint) -> const Transform& { return world[static_cast<std::size_t>(joint)]; };
    TrackFrame frame;
    frame.root = root;
    frame.hips = at(legs.hips).translation;
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = legs.side[side];
        const SolePoints sole = sole_points(leg, at(leg.foot), at(leg.toes == k_no_joint ? leg.foot : leg.toes));
        LegTrack& out = frame.legs[side];
        out.hip = at(leg.upper).translation;
        out.knee = at(leg.lower).translation;
        out.ankle = at(leg.foot).translation;
        out.sole = {sole.heel, sole.mid, sole.ball, sole.toe_tip};
        out.sole_up = rotate(at(leg.foot).rotation, leg.up);
    }
    return frame;
}

WalkTrack make_track(const Motion& motion, const Legs& legs) {
    WalkTrack track;
    track.fps = motion.fps;
    std::vector<Transform> world(static_cast<std::size_t>(motion.joint_count()));
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        track.frames.push_back(track_frame(motion.root[static_cast<std::size_t>(f)], world, legs));
    }
    return track;
}

std::vector<bool> planted_frames(const WalkTrack& twin, std::size_t side, std::size_t point) {
    std::vector<float> heights;
    for (const TrackFrame& frame : twin.frames) heights.push_back(frame.legs[side].sole[point].y);
    std::vector<float> sorted = heights;
    const auto rank = static_cast<std::size_t>(k_percentile * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
    const float lowest = sorted[rank];
    const Velocity v = sole_velocity(twin, side, point);
    std::vector<bool> mask(heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i)
        mask[i] = heights[i] < lowest + k_planted_height && v.full(i) < k_planted_speed;
    return mask;
}

SkateFigures measure_skate(const WalkTrack& walked, const WalkTrack& twin, FrameRange range,
                           const std::function<UnderFoot(Vec3)>& ground) {
    SkateFigures figures;
    double speed = 0, level = 0, weighted = 0;
    Mask standing(walked.frames.size()), skating(walked.frames.size());
    const auto fps = static_cast<double>(walked.fps);
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t point = 0; point < k_sole_points; ++point) {
            const Mask mask = planted_frames(twin, side, point);
            const Velocity v = sole_velocity(walked, side, point);
            for (std::size_t i = range.first; i < range.end; ++i) {
                if (!mask[i]) continue;
                const Vec3 p = walked.frames[i].legs[side].sole[point];
                const UnderFoot under = ground ? ground(p) : UnderFoot{};
                const double above = static_cast<double>(p.y - under.height), slide = v.along(i, under.normal);
                const double share = std::clamp(above / k_skate_height, 0.0, 1.0);
                ++figures.planted_samples;
                speed += slide * k_cm;
                level += v.level(i) * k_cm;
                weighted += slide / fps * k_cm * (2 - exp(share * 0.6931471805599453));  // 2^x = e^(x ln 2)
                standing[i] = true;
                if (slide > k_skating_speed) skating[i] = true;
            }
        }
    figures.standing = static_cast<std::size_t>(std::count(standing.begin(), standing.end(), true));
    // Nothing planted is nothing measured: the figures are no numbers then, not perfect ones.
    constexpr double k_not_measured = std::numeric_limits<double>::quiet_NaN();
    const double count = figures.planted_samples > 0 ? figures.planted_samples : k_not_measured;
    figures.mean_cm_s = speed / count;
    figures.level_cm_s = level / count;
    figures.weighted_cm = weighted / count;
    figures.share = static_cast<double>(std::count(skating.begin(), skating.end(), true)) /
                    (figures.standing > 0 ? static_cast<double>(figures.standing) : k_not_measured);
    return figures;
}

double longest_drag_cm(const WalkTrack& walked, FrameRange range, const std::function<UnderFoot(Vec3)>& ground) {
    constexpr std::size_t k_heel = 0, k_mid = 1, k_ball = 2;
    const auto fps = static_cast<double>(walked.fps);
    double longest = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const Velocity v = sole_velocity(walked, side, k_mid);
        const auto lies = [&](std::size_t frame, std::size_t point) {
            const Vec3 p = walked.frames[frame].legs[side].sole[point];
            return p.y - (ground ? ground(p).height : 0) < k_lying_height;
        };
        double way = 0;
        for (std::size_t i = range.first; i < range.end; ++i) {
            way = lies(i, k_heel) && lies(i, k_ball) ? way + v.level(i) / fps * k_cm : 0;
            longest = std::max(longest, way);
        }
    }
    return longest;
}

double knee_angle(const LegTrack& leg) {
    const Vec3 a = leg.hip - leg.knee, b = leg.ankle - leg.knee;
    return atan2(static_cast<double>(length(cross(a, b))), static_cast<double>(dot(a, b))) * k_degrees;
}

double knee_peak(const WalkTrack& track, std::size_t side, FrameRange range) {
    const auto fps = static_cast<double>(track.fps);
    Series angles;
    for (const TrackFrame& frame : track.frames) angles.push_back(knee_angle(frame.legs[side]));
    const Series s = smoothed_series(angles, fps);
    double most = 0;
    for (std::size_t i = std::max<std::size_t>(range.first, 1); i + 1 < s.size() && i < range.end; ++i)
        most = std::max(most, std::fabs(s[i + 1] - 2 * s[i] + s[i - 1]) * fps * fps);
    return most;
}

}  // namespace surefoot
