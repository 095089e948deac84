#include <surefoot/base/error.h>
#include <surefoot/course/metrics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

constexpr double k_not_measured = std::numeric_limits<double>::quiet_NaN();
constexpr double k_smoothing = 0.025;       // [s] sigma of the Gaussian before derivatives
constexpr float k_planted_height = 0.015f;  // [m] above the point's own 3rd percentile
constexpr double k_percentile = 0.03;
constexpr double k_planted_speed = 0.25;  // [m/s]
constexpr double k_skating_speed = 0.10;  // [m/s]
constexpr double k_skate_height = 0.025;  // [m] Zhang et al. 2018: H
constexpr double k_over_extended_deg = 179.5;
constexpr float k_roll_reach = 0.03f;  // [m] to either side, for the ground's roll under a sole
constexpr double k_cm = 100, k_degrees = 180 / k_pi;

using Series = std::vector<double>;
using Mask = std::vector<bool>;

float ground_height(const Ground& ground, Vec3 p, Vec3* normal = nullptr) {
    const GroundQuery query{p, 100, 100};
    GroundHit hit;
    ground.query({&query, 1}, {&hit, 1});
    if (normal) *normal = hit.hit ? hit.normal : k_up;
    return hit.hit ? hit.height : -1e6f;  // no ground: free space
}

/// Gaussian of k_smoothing; at the ends over what there is.
Series smoothed(const Series& x, double fps) {
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

/// First derivative of the smoothed series, central.
Series rate(const Series& x, double fps) {
    const Series s = smoothed(x, fps);
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

double knee_angle(const LegTrack& leg) {
    const Vec3 a = leg.hip - leg.knee, b = leg.ankle - leg.knee;
    return atan2(static_cast<double>(length(cross(a, b))), static_cast<double>(dot(a, b))) * k_degrees;
}

/// Angle between a sole and the ground under its heel and ball, degrees.
double sole_angle(const LegTrack& leg, const Ground& ground) {
    const Vec3 heel = leg.sole[0], ball = leg.sole[2];
    const Vec3 forward = normalized(Vec3{ball.x - heel.x, 0, ball.z - heel.z}), side{forward.z, 0, -forward.x};
    const float run = planar_length(ball - heel);
    if (run < 1e-4f) return 0;
    const float rise = (ground_height(ground, ball) - ground_height(ground, heel)) / run;
    const Vec3 middle = (heel + ball) * 0.5f;
    const float roll =
        (ground_height(ground, middle + side * k_roll_reach) - ground_height(ground, middle - side * k_roll_reach)) /
        (2 * k_roll_reach);
    const Vec3 normal = cross(forward + k_up * rise, side + k_up * roll);
    const Vec3 across = cross(normal, leg.sole_up);
    return atan2(static_cast<double>(length(across)), static_cast<double>(dot(normal, leg.sole_up))) * k_degrees;
}

/// Largest angular acceleration of a knee, deg/s^2, over frames [first, end).
double knee_peak(const WalkTrack& track, std::size_t side, std::size_t first, std::size_t end) {
    const auto fps = static_cast<double>(track.fps);
    Series angles;
    for (const TrackFrame& frame : track.frames) angles.push_back(knee_angle(frame.legs[side]));
    const Series s = smoothed(angles, fps);
    double most = 0;
    for (std::size_t i = std::max<std::size_t>(first, 1); i + 1 < s.size() && i < end; ++i)
        most = std::max(most, std::fabs(s[i + 1] - 2 * s[i] + s[i - 1]) * fps * fps);
    return most;
}

/// RMS of the hips' vertical jerk, m/s^3.
double hip_jerk(const WalkTrack& track, std::size_t first, std::size_t end) {
    const auto fps = static_cast<double>(track.fps);
    Series y;
    for (const TrackFrame& frame : track.frames) y.push_back(static_cast<double>(frame.hips.y));
    const Series s = smoothed(y, fps);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = std::max<std::size_t>(first, 1); i + 2 < s.size() && i < end; ++i, ++count) {
        const double j = (s[i + 2] - 3 * s[i + 1] + 3 * s[i] - s[i - 1]) * fps * fps * fps;
        sum += j * j;
    }
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

/// Frames without the margins, but a third of the walk at least.
std::size_t first_measured(const WalkTrack& track, float margin) {
    return std::min(static_cast<std::size_t>(margin * track.fps), track.frames.size() / 3);
}

class Measurement {
  public:
    Measurement(const WalkTrack& walked, const WalkTrack& twin, const Ground& ground, float margin)
        : walked_(walked), twin_(twin), ground_(ground), fps_(static_cast<double>(walked.fps)) {
        first_ = first_measured(walked, margin);
        end_ = walked.frames.size() - first_;
    }

    void contacts();
    void depths();
    void knees();
    void hips();
    WalkMetrics result;

  private:
    void contact_point(std::size_t side, std::size_t point, const Mask& mask);

    const WalkTrack& walked_;
    const WalkTrack& twin_;
    const Ground& ground_;
    double fps_;
    std::size_t first_, end_;
    double skate_ = 0, float_ = 0, weighted_ = 0;
    std::vector<bool> skating_, standing_;
};

void Measurement::contact_point(std::size_t side, std::size_t point, const Mask& mask) {
    const Velocity v = sole_velocity(walked_, side, point);
    for (std::size_t i = first_; i < end_; ++i) {
        if (!mask[i]) continue;
        const Vec3 p = walked_.frames[i].legs[side].sole[point];
        const double above = static_cast<double>(p.y - ground_height(ground_, p));
        const double floating =
            std::max(0.0, above - static_cast<double>(twin_.frames[i].legs[side].sole[point].y)) * k_cm;
        const double share = std::clamp(above / k_skate_height, 0.0, 1.0);
        ++result.planted_samples;
        skate_ += v.level(i) * k_cm;
        weighted_ += v.level(i) / fps_ * k_cm * (2 - exp(share * 0.6931471805599453));  // 2^x = e^(x ln 2)
        float_ += floating;
        result.float_max_cm = std::max(result.float_max_cm, floating);
        standing_[i] = true;
        if (v.level(i) > k_skating_speed) skating_[i] = true;
    }
}

void Measurement::contacts() {
    skating_.assign(walked_.frames.size(), false);
    standing_.assign(walked_.frames.size(), false);
    double angles = 0;
    int angle_count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        std::array<Mask, k_sole_points> masks;
        for (std::size_t point = 0; point < k_sole_points; ++point) {
            masks[point] = planted_frames(twin_, side, point);
            contact_point(side, point, masks[point]);
        }
        for (std::size_t i = first_; i < end_; ++i) {
            if (!masks[0][i] || !masks[2][i]) continue;  // heel and ball
            const double angle = sole_angle(walked_.frames[i].legs[side], ground_);
            angles += angle;
            ++angle_count;
            result.sole_angle_worst_deg = std::max(result.sole_angle_worst_deg, angle);
        }
    }
    // Nothing planted is nothing measured: the figures are no numbers then, not perfect ones.
    if (angle_count == 0) result.sole_angle_worst_deg = k_not_measured;
    if (result.planted_samples == 0) result.float_max_cm = k_not_measured;
    const double count = result.planted_samples > 0 ? result.planted_samples : k_not_measured;
    result.skate_cm_s = skate_ / count;
    result.skate_weighted_cm = weighted_ / count;
    result.float_mean_cm = float_ / count;
    result.sole_angle_deg = angle_count > 0 ? angles / angle_count : k_not_measured;
    const auto frames = std::count(standing_.begin(), standing_.end(), true);
    result.skate_share = frames > 0 ? static_cast<double>(std::count(skating_.begin(), skating_.end(), true)) /
                                          static_cast<double>(frames)
                                    : k_not_measured;
}

void Measurement::depths() {
    double sum = 0;
    int count = 0;
    for (std::size_t i = first_; i < end_; ++i)
        for (const LegTrack& leg : walked_.frames[i].legs)
            for (const Vec3 p : leg.sole) {
                const double depth = static_cast<double>(depth_in_ground(ground_, p)) * k_cm;
                sum += depth;
                ++count;
                result.penetration_max_cm = std::max(result.penetration_max_cm, depth);
            }
    result.penetration_mean_cm = sum / std::max(count, 1);
}

void Measurement::knees() {
    double twin_peak = 0;
    result.knee_min_deg = 180;
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = first_; i < end_; ++i) {
            const double own = knee_angle(walked_.frames[i].legs[side]), twin = knee_angle(twin_.frames[i].legs[side]);
            result.knee_min_deg = std::min(result.knee_min_deg, own);
            if (own > k_over_extended_deg && twin <= k_over_extended_deg) ++result.over_extensions;
        }
        result.knee_peak_deg_s2 = std::max(result.knee_peak_deg_s2, knee_peak(walked_, side, first_, end_));
        twin_peak = std::max(twin_peak, knee_peak(twin_, side, first_, end_));
    }
    result.knee_peak_ratio = twin_peak > 0 ? result.knee_peak_deg_s2 / twin_peak : 1;
}

void Measurement::hips() {
    const double twin = hip_jerk(twin_, first_, end_);
    result.hip_jerk_ratio = twin > 0 ? hip_jerk(walked_, first_, end_) / twin : 1;
}

}  // namespace

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

WalkTrack make_track(const Motion& motion, const Legs& legs) {
    WalkTrack track;
    track.fps = motion.fps;
    std::vector<Transform> world(static_cast<std::size_t>(motion.joint_count()));
    const auto at = [&](int joint) -> const Transform& { return world[static_cast<std::size_t>(joint)]; };
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        TrackFrame frame;
        frame.root = motion.root[static_cast<std::size_t>(f)];
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
        track.frames.push_back(frame);
    }
    return track;
}

WalkMetrics measure_walk(const WalkTrack& walked, const WalkTrack& twin, const Ground& ground,
                         const RootFrame& requested_end, float margin) {
    if (walked.frames.size() != twin.frames.size() || walked.frames.size() < 4)
        throw Error("a walk and its flat twin must have the same frames, four at least", "measure_walk", "");
    Measurement measurement(walked, twin, ground, margin);
    measurement.contacts();
    measurement.depths();
    measurement.knees();
    measurement.hips();
    const RootFrame& end = walked.frames.back().root;
    measurement.result.drift_m = static_cast<double>(planar_length(end.position - requested_end.position));
    measurement.result.drift_deg = std::fabs(wrap_angle(static_cast<double>(end.yaw - requested_end.yaw))) * k_degrees;
    return measurement.result;
}

TwinFigures measure_twin(const WalkTrack& twin, float margin) {
    TwinFigures figures;
    const std::size_t first = first_measured(twin, margin), end = twin.frames.size() - first;
    double sum = 0;
    int count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        figures.knee_peak_deg_s2 = std::max(figures.knee_peak_deg_s2, knee_peak(twin, side, first, end));
        for (std::size_t point = 0; point < k_sole_points; ++point) {
            const Mask mask = planted_frames(twin, side, point);
            const Velocity v = sole_velocity(twin, side, point);
            for (std::size_t i = first; i < end; ++i) {
                if (!mask[i]) continue;
                sum += v.level(i) * k_cm;
                ++count;
            }
        }
    }
    figures.skate_cm_s = count > 0 ? sum / count : k_not_measured;
    figures.hip_jerk_m_s3 = hip_jerk(twin, first, end);
    return figures;
}

float depth_in_ground(const Ground& ground, Vec3 p) noexcept {
    Vec3 normal;
    const float vertical = ground_height(ground, p, &normal) - p.y;
    if (!(vertical > 0)) return 0;
    // Straight up, out along the surface's own normal, or level in any direction: a riser's face.
    float best = vertical * normal.y;
    constexpr int k_directions = 16, k_steps = 24;
    for (int d = 0; d < k_directions; ++d) {
        const float angle = static_cast<float>(2 * k_pi) * static_cast<float>(d) / k_directions;
        const Vec3 way{sin(angle), 0, cos(angle)};
        for (int i = 1; i <= k_steps; ++i) {
            const float r = best * static_cast<float>(i) / k_steps;
            if (ground_height(ground, p + way * r) > p.y) continue;
            best = r;
            break;
        }
    }
    return best;
}

}  // namespace surefoot
