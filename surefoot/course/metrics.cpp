#include <surefoot/base/error.h>
#include <surefoot/course/metrics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

constexpr double k_not_measured = std::numeric_limits<double>::quiet_NaN();
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

/// Height of the ground that a sole point stands on. A sole is no set of points: where one hangs over an edge, or is
/// cut by one, by a centimetre, the foot stands on that side of it which is nearer to its own height, less what the
/// clip itself has it above flat ground: `own` [m]. A heel that peels off is not on the higher tile beside it.
float standing_height(const Ground& ground, Vec3 p, float own) {
    constexpr float k_beside = 0.015f, k_edge = 0.02f;  // [m] how near an edge counts, and from which height
    constexpr int k_directions = 8;
    const float under = ground_height(ground, p), level = p.y - own;
    float nearest = under;
    for (int d = 0; d < k_directions; ++d) {
        const float angle = static_cast<float>(2 * k_pi) * static_cast<float>(d) / k_directions;
        const float there = ground_height(ground, p + Vec3{sin(angle), 0, cos(angle)} * k_beside);
        if (std::fabs(there - under) > k_edge && std::fabs(there - level) < std::fabs(nearest - level)) nearest = there;
    }
    return nearest;
}

/// Angle between a sole and the ground under its heel and ball, degrees. `twin` tells the clip's own heights of them.
double sole_angle(const LegTrack& leg, const LegTrack& twin, const Ground& ground) {
    const Vec3 heel = leg.sole[0], ball = leg.sole[2];
    const float own_heel = std::max(0.0f, twin.sole[0].y), own_ball = std::max(0.0f, twin.sole[2].y);
    const Vec3 forward = normalized(Vec3{ball.x - heel.x, 0, ball.z - heel.z}), side{forward.z, 0, -forward.x};
    const float run = planar_length(ball - heel);
    if (run < 1e-4f) return 0;
    const float rise = (standing_height(ground, ball, own_ball) - standing_height(ground, heel, own_heel)) / run;
    // Beside heel and ball, where it bears, in the sole's own plane.
    const float lean = -dot(leg.sole_up, side) / std::max(leg.sole_up.y, 0.1f);
    const Vec3 reach = (side + k_up * lean) * k_roll_reach;
    const auto roll_at = [&](Vec3 p, float own) {
        return (standing_height(ground, p + reach, own) - standing_height(ground, p - reach, own)) / (4 * k_roll_reach);
    };
    const float roll = roll_at(heel, own_heel) + roll_at(ball, own_ball);
    const Vec3 normal = cross(forward + k_up * rise, side + k_up * roll);
    const Vec3 across = cross(normal, leg.sole_up);
    return atan2(static_cast<double>(length(across)), static_cast<double>(dot(normal, leg.sole_up))) * k_degrees;
}

/// RMS of the hips' vertical jerk, m/s^3.
double hip_jerk(const WalkTrack& track, std::size_t first, std::size_t end) {
    const auto fps = static_cast<double>(track.fps);
    Series y;
    for (const TrackFrame& frame : track.frames) y.push_back(static_cast<double>(frame.hips.y));
    const Series s = smoothed_series(y, fps);
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
        : walked_(walked), twin_(twin), ground_(ground) {
        first_ = first_measured(walked, margin);
        end_ = walked.frames.size() - first_;
    }

    void contacts();
    void depths();
    void knees();
    void hips();
    WalkMetrics result;

  private:
    void floating_point(std::size_t side, std::size_t point, const Mask& mask);

    const WalkTrack& walked_;
    const WalkTrack& twin_;
    const Ground& ground_;
    std::size_t first_, end_;
    double float_ = 0;
};

/// How far a planted point is above where the twin has it.
void Measurement::floating_point(std::size_t side, std::size_t point, const Mask& mask) {
    for (std::size_t i = first_; i < end_; ++i) {
        if (!mask[i]) continue;
        const Vec3 p = walked_.frames[i].legs[side].sole[point];
        const float own = twin_.frames[i].legs[side].sole[point].y;
        const auto above = static_cast<double>(p.y - own - standing_height(ground_, p, std::max(0.0f, own)));
        const double floating = std::max(0.0, above) * k_cm;
        float_ += floating;
        result.float_max_cm = std::max(result.float_max_cm, floating);
    }
}

void Measurement::contacts() {
    double angles = 0;
    int angle_count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        std::array<Mask, k_sole_points> masks;
        for (std::size_t point = 0; point < k_sole_points; ++point) {
            masks[point] = planted_frames(twin_, side, point);
            floating_point(side, point, masks[point]);
        }
        for (std::size_t i = first_; i < end_; ++i) {
            if (!masks[0][i] || !masks[2][i]) continue;  // heel and ball
            const double angle = sole_angle(walked_.frames[i].legs[side], twin_.frames[i].legs[side], ground_);
            angles += angle;
            ++angle_count;
            result.sole_angle_worst_deg = std::max(result.sole_angle_worst_deg, angle);
        }
    }
    const auto ground = [&](Vec3 point) {
        UnderFoot under;
        under.height = ground_height(ground_, point, &under.normal);
        return under;
    };
    const SkateFigures skate = measure_skate(walked_, twin_, {first_, end_}, ground);
    result.drag_cm = longest_drag_cm(walked_, {first_, end_}, ground);
    result.planted_samples = skate.planted_samples;
    result.skate_cm_s = skate.mean_cm_s;
    result.skate_level_cm_s = skate.level_cm_s;
    result.skate_weighted_cm = skate.weighted_cm;
    result.skate_share = skate.share;
    // Nothing planted is nothing measured: the figures are no numbers then, not perfect ones.
    if (angle_count == 0) result.sole_angle_worst_deg = k_not_measured;
    if (result.planted_samples == 0) result.float_max_cm = k_not_measured;
    result.float_mean_cm = float_ / (result.planted_samples > 0 ? result.planted_samples : k_not_measured);
    result.sole_angle_deg = angle_count > 0 ? angles / angle_count : k_not_measured;
}

void Measurement::depths() {
    double sum = 0;
    int count = 0;
    for (std::size_t i = first_; i < end_; ++i)
        for (const LegTrack& leg : walked_.frames[i].legs)
            for (std::size_t point = 0; point < k_sole_points; ++point) {
                const double depth = static_cast<double>(depth_in_ground(ground_, leg.sole[point])) * k_cm;
                sum += depth;
                ++count;
                double& most = point == 0 || point == 2 ? result.penetration_heel_ball_cm  // see k_sole_points
                                                        : result.penetration_toe_mid_cm;
                most = std::max(most, depth);
            }
    result.penetration_max_cm = std::max(result.penetration_heel_ball_cm, result.penetration_toe_mid_cm);
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
        result.knee_peak_deg_s2 = std::max(result.knee_peak_deg_s2, knee_peak(walked_, side, {first_, end_}));
        twin_peak = std::max(twin_peak, knee_peak(twin_, side, {first_, end_}));
    }
    result.knee_peak_ratio = twin_peak > 0 ? result.knee_peak_deg_s2 / twin_peak : 1;
}

void Measurement::hips() {
    const double twin = hip_jerk(twin_, first_, end_);
    result.hip_jerk_ratio = twin > 0 ? hip_jerk(walked_, first_, end_) / twin : 1;
}

}  // namespace

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
    for (std::size_t side = 0; side < 2; ++side)
        figures.knee_peak_deg_s2 = std::max(figures.knee_peak_deg_s2, knee_peak(twin, side, {first, end}));
    figures.skate_cm_s = measure_skate(twin, twin, {first, end}).mean_cm_s;
    figures.hip_jerk_m_s3 = hip_jerk(twin, first, end);
    for (std::size_t i = 1; i < twin.frames.size(); ++i)
        figures.path_m +=
            static_cast<double>(planar_length(twin.frames[i].root.position - twin.frames[i - 1].root.position));
    return figures;
}

float depth_in_ground(const Ground& ground, Vec3 p) noexcept {
    Vec3 normal;
    const float vertical = ground_height(ground, p, &normal) - p.y;
    if (!(vertical > 0)) return 0;
    // Straight up, out along the surface's own normal, or a way level in any direction, to a riser's face, and up
    // what is left: what lies a hair deep in a tread is out of the riser there.
    float best = vertical * normal.y;
    constexpr int k_directions = 16, k_steps = 24;
    for (int d = 0; d < k_directions; ++d) {
        const float angle = static_cast<float>(2 * k_pi) * static_cast<float>(d) / k_directions;
        const Vec3 way{sin(angle), 0, cos(angle)};
        const float farthest = best;
        for (int i = 1; i <= k_steps; ++i) {
            const float r = farthest * static_cast<float>(i) / k_steps;
            const float up = std::max(0.0f, ground_height(ground, p + way * r) - p.y);
            best = std::min(best, std::sqrt(r * r + up * up));
            if (up == 0) break;
        }
    }
    return best;
}

}  // namespace surefoot
