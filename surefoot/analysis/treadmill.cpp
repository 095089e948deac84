#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/treadmill.h>

#include <algorithm>
#include <array>

namespace surefoot {
namespace {

constexpr float k_standard_leg = 0.9f;
constexpr float k_height_scale = 0.015f;   // [m] a point this high counts 1/e
constexpr float k_vertical_slope = 0.15f;  // [1] a foot on the ground moves along it, not up or down
constexpr float k_vertical_scale = 0.20f;  // [m/s] likewise
constexpr float k_rolling_share = 0.02f;   // what a point counts while the other end of its foot is off the ground
constexpr float k_flat_runner = 0.03f;     // flat feet a frame: below this the ball alone has to tell the speed
constexpr float k_sure_held = 0.05f;       // the same where the whole stance must speak
constexpr float k_held_hips = 0.005f;      // [m] hips that stray less were held by a tool, not by a walker
constexpr float k_rolling_turn = 0.65f;    // what rolling feet have to say in the turn; flat ones say the rest
constexpr float k_sure = 0.6f;             // of the surest frames' weight: frames that enter the mean over time
constexpr float k_yaw_arm = 0.10f;         // [m] how much a foot's rotation weighs against its ends' velocities
constexpr float k_smoothing = 0.012f;      // [s]
constexpr int k_rounds = 25;               // IRLS settles in about ten

/// One standing point in one frame: where it is (from the centre), how it moves, how surely it stands.
struct Sample {
    int frame;
    float rx, rz, vx, vz, weight;
    bool rotation;  // vx holds a yaw rate instead
    std::size_t foot;
};

/// From where the feet are watched: a fixed centre, under which the ground runs, or a root that moves over it.
struct Viewpoint {
    Vec3 centre;
    std::span<const RootFrame> root;  // one a frame, or none
    Vec3 way;                         // [m/s] of the root in its own frame, mean

    Vec3 place(Vec3 p, std::size_t f) const {
        return root.empty() ? p - centre : rotate(from_yaw(-root[f].yaw), p - root[f].position);
    }
    Vec3 direction(Vec3 v, std::size_t f) const { return root.empty() ? v : rotate(from_yaw(-root[f].yaw), v); }
};

float low_height(const std::vector<Vec3>& points, float scale) {
    std::vector<float> heights;
    for (const Vec3 p : points) heights.push_back(p.y);
    return std::clamp(percentile(heights, 0.05f), -0.04f * scale, 0.02f * scale);
}

/// One sole point over time: its path, its velocity, and how surely it stands by height and rise alone.
struct PointTrack {
    std::vector<Vec3> path, velocity;
    std::vector<float> certainty;
};

PointTrack track_point(const std::vector<Vec3>& points, const Viewpoint& view, float fps, float scale) {
    PointTrack track;
    track.path = smoothed(points, k_smoothing * fps);
    track.velocity = derivative(track.path, fps);
    const float low = low_height(points, scale);
    for (std::size_t f = 0; f < points.size(); ++f) {
        track.path[f] = view.place(track.path[f], f);
        track.velocity[f] = view.direction(track.velocity[f], f);
        const Vec3 v = track.velocity[f];
        const float height = std::max(0.0f, points[f].y - low) / (k_height_scale * scale);
        const float rise = v.y / std::max(k_vertical_scale, k_vertical_slope * planar_length(v));
        track.certainty.push_back(exp(-height * height - rise * rise));
    }
    return track;
}

/// A point counts in full while the other end of the foot stands, too: a heel or ball that the foot rolls over creeps
/// forward, which would read as a slower ground.
void add_samples(std::vector<Sample>& samples, const PointTrack& point, const PointTrack& other, float rolling,
                 std::size_t side) {
    for (std::size_t f = 0; f < point.path.size(); ++f) {
        const Vec3 r = point.path[f], v = point.velocity[f];
        const float weight = point.certainty[f] * (rolling + (1 - rolling) * other.certainty[f]);
        if (weight > 0.005f) samples.push_back({static_cast<int>(f), r.x, r.z, v.x, v.z, weight, false, side});
    }
}

std::vector<Sample> standing_samples(const Tracks& tracks, const Viewpoint& view, float scale, float rolling) {
    std::vector<Sample> samples;
    for (std::size_t side = 0; side < 2; ++side) {
        const FootTrack& foot = tracks.foot[side];
        const PointTrack heel = track_point(foot.heel, view, tracks.fps, scale);
        const PointTrack ball = track_point(foot.ball, view, tracks.fps, scale);
        add_samples(samples, heel, ball, rolling, side);
        add_samples(samples, ball, heel, rolling, side);
        const std::vector<float> rate = derivative(smoothed(foot.yaw, k_smoothing * tracks.fps), tracks.fps);
        for (std::size_t f = 0; f < rate.size(); ++f)
            if (const float flat = heel.certainty[f] * ball.certainty[f]; flat > 0.05f)
                samples.push_back({static_cast<int>(f), 0, 0, rate[f], 0, flat, true, side});
    }
    return samples;
}

/// Feet flat on the ground, in feet a frame. Their rotation samples tell.
float flat_share(const std::vector<Sample>& samples, int frames) {
    float sum = 0;
    for (const Sample& s : samples)
        if (s.rotation) sum += s.weight;
    return sum / static_cast<float>(frames);
}

/// Were the hips held still frame by frame, by a tool? The surge of the body is in the feet then, which are slowest in
/// the middle of a stance: flat feet must not speak for the rest.
bool holds_hips_still(const Tracks& tracks, const Viewpoint& view, float scale) {
    std::vector<Vec3> places;
    Vec3 mean;
    for (std::size_t f = 0; f < tracks.hips.size(); ++f) {
        places.push_back(view.place(tracks.hips[f].translation, f));
        mean += places.back() / static_cast<float>(tracks.hips.size());
    }
    float stray = 0;
    for (const Vec3 place : places) {
        const float d = planar_length(place - mean) / scale;
        stray += d * d / static_cast<float>(places.size());
    }
    return stray < k_held_hips * k_held_hips;
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

/// Least squares of one turn rate from equations value + turn * arm = common, whose common part is unknown.
class TurnEquations {
  public:
    void add(double arm, double value, double weight) {
        weights_ += weight, arms_ += weight * arm, values_ += weight * value;
        squares_ += weight * arm * arm, products_ += weight * arm * value;
    }
    double square() const { return squares_ - (weights_ > 0 ? arms_ * arms_ / weights_ : 0); }
    double product() const { return products_ - (weights_ > 0 ? arms_ * values_ / weights_ : 0); }

  private:
    double weights_ = 0, arms_ = 0, values_ = 0, squares_ = 0, products_ = 0;
};

/// The turn that makes standing points stand. What bodies do with every step must not be taken for one. They surge:
/// along the way each frame has a velocity of its own, common to its points. They sway towards the standing foot and
/// away, and feet twist under them: both do so to the other side on the other foot, by as much.
float best_turn(const std::vector<Sample>& samples, const std::vector<float>& weights, Vec3 way, int frames) {
    constexpr float k_goes = 0.2f;     // [m/s] slower, there is no way along which a body could surge
    constexpr double k_sway = 0.0005;  // [m^2] the information that it takes to tell a sway from a turn
    constexpr double k_twist = 0.01;   // [m^2] likewise, of feet that twist
    const float speed = planar_length(way);
    const bool goes = speed > k_goes;
    const float dx = goes ? way.x / speed : 0, dz = goes ? way.z / speed : 1;
    std::vector<TurnEquations> along(goes ? static_cast<std::size_t>(frames) : 1);
    std::array<TurnEquations, 2> across;
    std::array<double, 2> yaw_square{}, yaw_product{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        const double w = static_cast<double>(weights[i]);
        if (s.rotation) {
            const double arm = w * static_cast<double>(k_yaw_arm * k_yaw_arm);
            yaw_square[s.foot] += arm;
            yaw_product[s.foot] += arm * static_cast<double>(s.vx);
            continue;
        }
        along[goes ? static_cast<std::size_t>(s.frame) : 0].add(static_cast<double>(s.rz * dx - s.rx * dz),
                                                                static_cast<double>(s.vx * dx + s.vz * dz), w);
        across[s.foot].add(static_cast<double>(-s.rz * dz - s.rx * dx), static_cast<double>(-s.vx * dz + s.vz * dx), w);
    }
    // (turn, sway, twist): left feet see turn + sway and turn + twist, right feet turn - sway and turn - twist.
    double square = 0, product = 0;
    for (const TurnEquations& frame : along) square += frame.square(), product += frame.product();
    const auto both_sides = [&](double left, double right, double left_product, double right_product, double belief) {
        const double sum = left + right, difference = left - right, own = sum + belief;
        const double product_sum = left_product + right_product, product_difference = left_product - right_product;
        square += sum - difference * difference / own;
        product += product_sum - difference * product_difference / own;
    };
    both_sides(across[0].square(), across[1].square(), across[0].product(), across[1].product(), k_sway);
    both_sides(yaw_square[0], yaw_square[1], yaw_product[0], yaw_product[1], k_twist);
    return square > 1e-9 ? static_cast<float>(-product / square) : 0;
}

/// Weighted least squares for (vx, vz) with the turn given.
Solution best_velocity(const std::vector<Sample>& samples, const std::vector<float>& weights, float turn) {
    double n = 0, x = 0, z = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        if (s.rotation) continue;
        const double w = static_cast<double>(weights[i]);
        n += w;
        x += w * static_cast<double>(s.vx + turn * s.rz);
        z += w * static_cast<double>(s.vz - turn * s.rx);
    }
    if (!(n > 1e-6)) return {};
    return {static_cast<float>(-x / n), static_cast<float>(-z / n), turn};
}

std::vector<float> robust_weights(const std::vector<Sample>& samples, const Solution& solution, float scale,
                                  float fps) {
    // A rolling sole differs from the ground by up to a quarter of the speed; what differs by more does not stand.
    const float speed = std::sqrt(solution.vx * solution.vx + solution.vz * solution.vz);
    // At few frames a second a runner's stance is two frames long, and differences over it include landing or leaving.
    const float coarse = std::clamp((60 - fps) / 30, 0.0f, 1.0f) * std::clamp(0.5f * speed - 1, 0.0f, 1.0f);
    const float cut = std::max(0.12f * scale, (0.10f + 0.15f * coarse) * speed);
    std::vector<float> weights;
    for (const Sample& s : samples) {
        const float d = solution.slip(s) / cut, q = 1 / (1 + d * d);
        weights.push_back(s.weight * q * q);
    }
    return weights;
}

Solution solve(const std::vector<Sample>& samples, int frames, const Viewpoint& view, float scale, float fps,
               const float* given_turn, std::vector<float>& weights) {
    Solution solution = median_start(samples);
    for (int round = 0; round < k_rounds; ++round) {
        weights = robust_weights(samples, solution, scale, fps);
        const Vec3 way{solution.vx + view.way.x, 0, solution.vz + view.way.z};
        solution = best_velocity(samples, weights, given_turn ? *given_turn : best_turn(samples, weights, way, frames));
    }
    return solution;
}

/// Mean slip over time: frames in which no point stands take the mean of their neighbours in time.
Solution averaged_over_time(const std::vector<Sample>& samples, const std::vector<float>& weights,
                            const Solution& start, int frames, float sure_share, float& coverage) {
    std::vector<float> total(static_cast<std::size_t>(frames)), x(total.size()), z(total.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].rotation) continue;
        const std::size_t f = static_cast<std::size_t>(samples[i].frame);
        total[f] += weights[i];
        x[f] += weights[i] * start.slip_x(samples[i]);
        z[f] += weights[i] * start.slip_z(samples[i]);
    }
    const float sure = std::max(0.01f, sure_share * percentile(total, 0.95f));
    double sum_x = 0, sum_z = 0, time = 0;
    int covered = 0, previous = -1;
    float px = 0, pz = 0;
    for (int f = 0; f < frames; ++f) {
        const std::size_t i = static_cast<std::size_t>(f);
        covered += total[i] > 0.01f;
        if (total[i] < sure) continue;
        const float nx = x[i] / total[i], nz = z[i] / total[i];
        if (previous >= 0) {  // trapezoids between covered frames
            const double step = f - previous;
            sum_x += 0.5 * step * static_cast<double>(px + nx);
            sum_z += 0.5 * step * static_cast<double>(pz + nz);
            time += step;
        }
        previous = f, px = nx, pz = nz;
    }
    coverage = frames ? static_cast<float>(covered) / static_cast<float>(frames) : 0;
    if (!(time > 0)) return start;
    return {start.vx - static_cast<float>(sum_x / time), start.vz - static_cast<float>(sum_z / time), start.turn};
}

GroundMotion estimate(const Tracks& tracks, const Viewpoint& view, float leg_length, const float* given_turn) {
    GroundMotion motion;
    motion.centre = view.centre;
    const float scale = leg_length > 0.05f ? leg_length / k_standard_leg : 1;
    const int frames = tracks.frame_count();
    std::vector<float> weights;
    // Turn first: a rolling foot moves too slowly but in the right direction, so what it says of the turn counts, and
    // both ends of long stances hold the turn much better than flat feet alone. The two answers err independently.
    std::vector<Sample> samples = standing_samples(tracks, view, scale, 1);
    if (samples.empty()) return motion;
    const float rolling_turn = solve(samples, frames, view, scale, tracks.fps, nullptr, weights).turn;
    const bool held = holds_hips_still(tracks, view, scale);
    if (!held && flat_share(samples, frames) > k_flat_runner)  // a sprinter never has a foot flat
        samples = standing_samples(tracks, view, scale, k_rolling_share);
    const float flat_turn = solve(samples, frames, view, scale, tracks.fps, nullptr, weights).turn;
    const float turn = given_turn ? *given_turn : k_rolling_turn * rolling_turn + (1 - k_rolling_turn) * flat_turn;
    Solution solution = solve(samples, frames, view, scale, tracks.fps, &turn, weights);
    solution = averaged_over_time(samples, weights, solution, frames, held ? k_sure_held : k_sure, motion.coverage);
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

}  // namespace

GroundMotion estimate_ground_motion(const Tracks& tracks, float leg_length, const float* given_turn) {
    Viewpoint view;
    for (const Transform& hips : tracks.hips) view.centre += hips.translation / static_cast<float>(tracks.hips.size());
    view.centre.y = 0;
    return estimate(tracks, view, leg_length, given_turn);
}

GroundMotion estimate_slip(const Tracks& tracks, std::span<const RootFrame> root, float leg_length) {
    if (root.size() < 2 || root.size() != tracks.hips.size()) return {};
    Viewpoint view;
    view.root = root;
    for (std::size_t f = 1; f < root.size(); ++f)
        view.way += between(root[f - 1], root[f]).position * (tracks.fps / static_cast<float>(root.size() - 1));
    return estimate(tracks, view, leg_length, nullptr);
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
