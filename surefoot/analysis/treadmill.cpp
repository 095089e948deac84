#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/treadmill.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_standard_leg = 0.9f;
constexpr float k_height_scale = 0.015f;   // [m] a point this high counts 1/e
constexpr float k_vertical_slope = 0.15f;  // [1] a foot on the ground moves along it, not up or down
constexpr float k_vertical_scale = 0.20f;  // [m/s] likewise
constexpr float k_yaw_arm = 0.20f;         // [m] how much a foot's rotation weighs against its ends' velocities
constexpr float k_smoothing = 0.012f;      // [s]
// A foot rolls forward onto and off its flat stance and rests in the middle of it: in CMU's walks, counting all of the
// stance reads 4 to 5 % low, the middles half of that. Only the mean velocity rests on them: the turn needs the ends of
// the stances, too, where the feet are far from the body.
constexpr float k_flat = 0.05f;           // [1] certainty of heel and ball together
constexpr float k_roll = 0.1f;            // of a flat stance, at either end
constexpr float k_shortest_flat = 0.08f;  // [s] a shorter one is passing by
constexpr float k_settled_share = 0.1f;   // of the frames: fewer say too little of the whole clip
constexpr float k_held_hips = 0.005f;     // [m] hips that stray less were held still by a tool, not by a walker
constexpr int k_rounds = 25;              // IRLS settles in about ten

/// One standing point in one frame: where it is (from the centre), how it moves, how surely it stands.
struct Sample {
    int frame;
    float rx, rz, vx, vz, weight;
    bool rotation;  // vx holds a yaw rate instead
    bool settled;   // in the middle of a flat stance
};

std::vector<Vec3> relative_to(const std::vector<Vec3>& points, Vec3 centre) {
    std::vector<Vec3> result;
    for (const Vec3 p : points) result.push_back(p - centre);
    return result;
}

float low_height(const std::vector<Vec3>& points, float scale) {
    std::vector<float> heights;
    for (const Vec3 p : points) heights.push_back(p.y);
    return std::clamp(percentile(heights, 0.05f), -0.04f * scale, 0.02f * scale);
}

/// Samples of one sole point; `certainty` receives exp(-…) a frame.
std::vector<float> add_samples(std::vector<Sample>& samples, const std::vector<Vec3>& points, Vec3 centre, float fps,
                               float scale) {
    const std::vector<Vec3> path = smoothed(relative_to(points, centre), k_smoothing * fps);
    const std::vector<Vec3> velocity = derivative(path, fps);
    const float low = low_height(points, scale);
    std::vector<float> certainty;
    for (std::size_t f = 0; f < points.size(); ++f) {
        const float height = std::max(0.0f, points[f].y - low) / (k_height_scale * scale);
        const float rise = velocity[f].y / std::max(k_vertical_scale, k_vertical_slope * planar_length(velocity[f]));
        const float weight = exp(-height * height - rise * rise);
        certainty.push_back(weight);
        if (weight > 0.02f)
            samples.push_back(
                {static_cast<int>(f), path[f].x, path[f].z, velocity[f].x, velocity[f].z, weight, false, false});
    }
    return certainty;
}

/// The middles of the stretches of time in which the foot lies flat.
std::vector<char> mid_stance(const std::vector<float>& heel, const std::vector<float>& ball, float fps) {
    std::vector<char> middle(heel.size());
    for (std::size_t begin = 0; begin < heel.size();) {
        std::size_t end = begin;
        while (end < heel.size() && heel[end] * ball[end] > k_flat) ++end;
        const float count = static_cast<float>(end - begin);
        const std::size_t trim = static_cast<std::size_t>(k_roll * count + 0.5f);
        if (count >= k_shortest_flat * fps) {
            const auto at = middle.begin() + static_cast<std::ptrdiff_t>(begin);
            std::fill(at + static_cast<std::ptrdiff_t>(trim), at + static_cast<std::ptrdiff_t>(end - begin - trim), 1);
        }
        begin = end + 1;
    }
    return middle;
}

std::vector<Sample> standing_samples(const Tracks& tracks, Vec3 centre, float scale) {
    std::vector<Sample> samples;
    for (const FootTrack& foot : tracks.foot) {
        const std::size_t first = samples.size();
        const std::vector<float> heel = add_samples(samples, foot.heel, centre, tracks.fps, scale);
        const std::vector<float> ball = add_samples(samples, foot.ball, centre, tracks.fps, scale);
        const std::vector<float> rate = derivative(smoothed(foot.yaw, k_smoothing * tracks.fps), tracks.fps);
        for (std::size_t f = 0; f < rate.size(); ++f)
            if (const float flat = heel[f] * ball[f]; flat > 0.05f)
                samples.push_back({static_cast<int>(f), 0, 0, rate[f], 0, flat, true, false});
        const std::vector<char> middle = mid_stance(heel, ball, tracks.fps);
        for (std::size_t i = first; i < samples.size(); ++i)
            samples[i].settled = middle[static_cast<std::size_t>(samples[i].frame)] != 0;
    }
    return samples;
}

struct Solution {
    float vx = 0, vz = 0, turn = 0;

    /// Velocity of a standing point over the ground.
    float slip_x(const Sample& s) const { return s.vx + vx + turn * s.rz; }
    float slip_z(const Sample& s) const { return s.vz + vz - turn * s.rx; }
    float slip(const Sample& s) const {
        if (s.rotation) return std::fabs(s.vx + turn) * k_yaw_arm;
        return std::sqrt(slip_x(s) * slip_x(s) + slip_z(s) * slip_z(s));
    }
};

float weighted_median(std::vector<std::pair<float, float>> values) {
    std::sort(values.begin(), values.end());
    float total = 0, sum = 0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values)
        if ((sum += weight) >= 0.5f * total) return value;
    return 0;
}

Solution median_start(const std::vector<Sample>& samples) {
    std::vector<std::pair<float, float>> x, z;
    for (const Sample& s : samples)
        if (!s.rotation) x.push_back({-s.vx, s.weight}), z.push_back({-s.vz, s.weight});
    return {weighted_median(x), weighted_median(z), 0};
}

/// Weighted least squares for (vx, vz, turn): three normal equations, solved by Cramer's rule.
Solution least_squares(const std::vector<Sample>& samples, const std::vector<float>& weights) {
    double n = 0, sx = 0, sz = 0, r2 = 0, bx = 0, bz = 0, bt = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        const double w = static_cast<double>(weights[i]);
        if (s.rotation) {
            const double arm = w * static_cast<double>(k_yaw_arm * k_yaw_arm);
            r2 += arm;
            bt -= arm * static_cast<double>(s.vx);
            continue;
        }
        const double rx = static_cast<double>(s.rx), rz = static_cast<double>(s.rz);
        const double vx = static_cast<double>(s.vx), vz = static_cast<double>(s.vz);
        n += w, sx += w * rx, sz += w * rz, r2 += w * (rx * rx + rz * rz);
        bx -= w * vx, bz -= w * vz, bt += w * (rx * vz - rz * vx);
    }
    if (!(n > 1e-6)) return {};
    // [n 0 sz; 0 n -sx; sz -sx r2] (vx vz turn) = (bx bz bt)
    const double det = r2 - (sx * sx + sz * sz) / n;
    const double turn = det > 1e-6 * n ? (bt - (sz * bx - sx * bz) / n) / det : 0;
    return {static_cast<float>((bx - sz * turn) / n), static_cast<float>((bz + sx * turn) / n),
            static_cast<float>(turn)};
}

std::vector<float> robust_weights(const std::vector<Sample>& samples, const Solution& solution, float scale) {
    // A rolling sole differs from the ground by up to a quarter of the speed; what differs by more does not stand.
    const float speed = std::sqrt(solution.vx * solution.vx + solution.vz * solution.vz);
    const float cut = std::max(0.12f * scale, 0.15f * speed);
    std::vector<float> weights;
    for (const Sample& s : samples) {
        const float d = solution.slip(s) / cut, q = 1 / (1 + d * d);
        weights.push_back(s.weight * q * q);
    }
    return weights;
}

/// May the middles of flat stances speak for the whole clip? Not where the hips were held still frame by frame: the
/// surge of the body is in the feet then, which are slowest in the middle.
bool settled_speak(const std::vector<Sample>& samples, const Tracks& tracks, Vec3 centre, float scale) {
    double stray = 0;
    for (const Transform& hips : tracks.hips) {
        const float d = planar_length(hips.translation - centre) / scale;
        stray += static_cast<double>(d * d);
    }
    const std::size_t frames = tracks.hips.size();
    if (stray < static_cast<double>(k_held_hips * k_held_hips) * static_cast<double>(frames)) return false;
    std::vector<char> seen(frames);
    for (const Sample& s : samples) seen[static_cast<std::size_t>(s.frame)] |= s.settled ? 1 : 0;
    return static_cast<float>(std::count(seen.begin(), seen.end(), 1)) > k_settled_share * static_cast<float>(frames);
}

/// Mean slip over time, of settled samples only where they speak for all: frames in which no point stands take the mean
/// of their neighbours in time.
Solution averaged_over_time(const std::vector<Sample>& samples, const std::vector<float>& weights,
                            const Solution& start, int frames, bool settled, float& coverage) {
    std::vector<float> standing(static_cast<std::size_t>(frames)), total(standing), x(standing), z(standing);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].rotation) continue;
        const std::size_t f = static_cast<std::size_t>(samples[i].frame);
        standing[f] += weights[i];
        if (settled && !samples[i].settled) continue;
        total[f] += weights[i];
        x[f] += weights[i] * start.slip_x(samples[i]);
        z[f] += weights[i] * start.slip_z(samples[i]);
    }
    double sum_x = 0, sum_z = 0, time = 0;
    int previous = -1;
    float px = 0, pz = 0;
    for (int f = 0; f < frames; ++f) {
        const std::size_t i = static_cast<std::size_t>(f);
        if (total[i] < 0.1f) continue;
        const float nx = x[i] / total[i], nz = z[i] / total[i];
        if (previous >= 0) {  // trapezoids between covered frames
            const double step = f - previous;
            sum_x += 0.5 * step * static_cast<double>(px + nx);
            sum_z += 0.5 * step * static_cast<double>(pz + nz);
            time += step;
        }
        previous = f, px = nx, pz = nz;
    }
    const auto covered = std::count_if(standing.begin(), standing.end(), [](float w) { return w >= 0.1f; });
    coverage = frames ? static_cast<float>(covered) / static_cast<float>(frames) : 0;
    if (!(time > 0)) return start;
    return {start.vx - static_cast<float>(sum_x / time), start.vz - static_cast<float>(sum_z / time), start.turn};
}

}  // namespace

GroundMotion estimate_ground_motion(const Tracks& tracks, float leg_length) {
    GroundMotion motion;
    const float scale = leg_length > 0.05f ? leg_length / k_standard_leg : 1;
    for (const Transform& hips : tracks.hips)
        motion.centre += hips.translation / static_cast<float>(tracks.hips.size());
    motion.centre.y = 0;
    const std::vector<Sample> samples = standing_samples(tracks, motion.centre, scale);
    if (samples.empty()) return motion;
    Solution solution = median_start(samples);
    std::vector<float> weights;
    for (int round = 0; round < k_rounds; ++round) {
        weights = robust_weights(samples, solution, scale);
        solution = least_squares(samples, weights);
    }
    const bool settled = settled_speak(samples, tracks, motion.centre, scale);
    solution = averaged_over_time(samples, weights, solution, tracks.frame_count(), settled, motion.coverage);
    motion.velocity = {solution.vx, 0, solution.vz};
    motion.turn = solution.turn;
    double slip = 0, total = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].rotation) continue;
        slip += static_cast<double>(samples[i].weight * solution.slip(samples[i]));
        total += static_cast<double>(samples[i].weight);
    }
    motion.residual = total > 0 ? static_cast<float>(slip / total) : 0;
    return motion;
}

std::vector<RootFrame> constant_path(const GroundMotion& motion, float fps, int frames) {
    std::vector<RootFrame> path;
    for (int f = 0; f < frames; ++f) {
        const float t = static_cast<float>(f) / fps, angle = motion.turn * t;
        // Displacement of the centre: the integral of R(turn * s) V over s in (0, t).
        float along = t, aside = 0.5f * angle * t;  // series for a vanishing turn
        if (std::fabs(angle) > 1e-4f) along = sin(angle) / motion.turn, aside = (1 - cos(angle)) / motion.turn;
        const Vec3 moved{along * motion.velocity.x + aside * motion.velocity.z, 0,
                         along * motion.velocity.z - aside * motion.velocity.x};
        path.push_back({motion.centre + moved - rotate(from_yaw(angle), motion.centre), angle});
    }
    return path;
}

}  // namespace surefoot
