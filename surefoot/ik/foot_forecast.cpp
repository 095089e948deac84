#include <surefoot/ik/foot_forecast.h>

#include <algorithm>

namespace surefoot {
namespace {

// A sole point stands where it is low and slow; lengths for a leg of k_usual_leg, others scale with it. Fast runs roll
// faster over the foot, so the limit grows with the root's speed.
constexpr float k_usual_leg = 0.85f;    // [m]
constexpr float k_heel_height = 0.03f;  // [m]
constexpr float k_ball_height = 0.035f;
constexpr float k_tip_height = 0.02f;  // the toe tip is the last to leave
constexpr float k_slow = 0.35f;        // [m/s]
constexpr float k_slow_share = 0.3f;   // of the root's speed
constexpr float k_fast_root = 1.7f;    // [m/s] from here on the share counts
constexpr float k_still = 0.03f;       // [m] that a foot may shift about the root and yet rest
constexpr int k_gap = 8;               // samples: no swing is shorter; a shorter gap is a foot that drags or noise
constexpr int k_shortest_run = 3;      // and so are shorter stances
constexpr double k_most_early = 0.5;   // [s] a root that passes a foot this long before or after its stance is turning
constexpr int k_batch = 12;            // samples asked of the host at once

float speed_at(const std::array<LegPoints, Forecast::k_samples>& leg, Vec3 LegPoints::*point, int i) noexcept {
    const int before = std::max(i - 1, 0), after = std::min(i + 1, Forecast::k_samples - 1);
    const Vec3 step = leg[static_cast<std::size_t>(after)].*point - leg[static_cast<std::size_t>(before)].*point;
    return length(step) * Forecast::k_rate / static_cast<float>(after - before);
}

void find_runs(Forecast& f, std::size_t side) noexcept {
    int count = 0;
    auto& runs = f.runs[side];
    const auto on = [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        return f.heel_down[side][n] || f.ball_down[side][n] || f.tip_down[side][n];
    };
    const auto too_short = [&](const ContactRun& run) {
        return run.last - run.first + 1 < k_shortest_run && run.first > 0 && run.last + 1 < Forecast::k_samples;
    };
    for (int i = 0; i < Forecast::k_samples; ++i) {
        if (!on(i)) continue;
        int last = i;
        for (int j = i + 1; j < Forecast::k_samples && j <= last + k_gap; ++j)
            if (on(j)) last = j;
        const ContactRun run{i, last};
        if (!too_short(run) && count < Forecast::k_most_runs) runs[static_cast<std::size_t>(count++)] = run;
        i = last;
    }
    f.run_count[side] = count;
}

/// True where a foot stays down and in its place as seen from the root, wherever that goes.
bool foot_rests(const Forecast& f, std::size_t side, float scale) noexcept {
    Vec3 first;
    for (std::size_t i = 0; i < Forecast::k_samples; ++i) {
        const LegPoints& p = f.legs[side][i];
        if (p.heel.y > k_heel_height * scale || p.ball.y > k_ball_height * scale) return false;
        const Vec3 seen = rotate(from_yaw(-f.yaw[i]), (p.heel + p.ball) * 0.5f - f.root[i]);
        if (i == 0) first = seen;
        if (planar_length(seen - first) > k_still * scale) return false;
    }
    return true;
}

/// Catmull-Rom, so that second differences of what is built on it stay smooth.
Vec3 between(Vec3 a, Vec3 b, Vec3 c, Vec3 d, float t) noexcept {
    const Vec3 slope_b = (c - a) * 0.5f, slope_c = (d - b) * 0.5f;
    const float t2 = t * t, t3 = t2 * t;
    return b * (2 * t3 - 3 * t2 + 1) + slope_b * (t3 - 2 * t2 + t) + c * (3 * t2 - 2 * t3) + slope_c * (t3 - t2);
}

/// Over flat ground.
Transform world_of(const RootFrame& root) noexcept {
    return {from_yaw(root.yaw), {root.position.x, 0, root.position.z}};
}

LegPoints leg_points(const Leg& leg, const LegPose& pose, const Transform& world) noexcept {
    const Transform foot = world * pose.foot;
    const SolePoints sole = sole_points(leg, foot, leg.toes == k_no_joint ? foot : world * pose.toes);
    return {transform_point(world, pose.upper.translation),
            transform_point(world, pose.lower.translation),
            foot.translation,
            sole.heel,
            sole.ball,
            sole.toe_tip};
}

}  // namespace

WorldLeg world_leg(const Leg& leg, const LegPose& pose, const RootFrame& root) noexcept {
    const Transform world = world_of(root);
    WorldLeg out;
    out.points = leg_points(leg, pose, world);
    out.upper = world.rotation * pose.upper.rotation;
    out.lower = world.rotation * pose.lower.rotation;
    out.foot = world.rotation * pose.foot.rotation;
    out.toe_joint = transform_point(world, pose.toes.translation);
    out.toes = world.rotation * pose.toes.rotation;
    out.upper_parent = world.rotation * pose.upper_parent;
    out.lower_parent = world.rotation * pose.lower_parent;
    out.foot_parent = world.rotation * pose.foot_parent;
    out.toes_parent = world.rotation * pose.toes_parent;
    return out;
}

LegPoints Forecast::at(std::size_t side, double clock) const noexcept {
    const double x = std::clamp((clock - start) * k_rate, 0.0, static_cast<double>(k_samples - 1));
    const int i = std::min(static_cast<int>(x), k_samples - 2);
    const auto t = static_cast<float>(x - i);
    const auto sample = [&](int j) -> const LegPoints& {
        return legs[side][static_cast<std::size_t>(std::clamp(j, 0, k_samples - 1))];
    };
    const LegPoints &a = sample(i - 1), &b = sample(i), &c = sample(i + 1), &d = sample(i + 2);
    LegPoints out;
    for (Vec3 LegPoints::*point : {&LegPoints::hip, &LegPoints::knee, &LegPoints::ankle, &LegPoints::heel,
                                   &LegPoints::ball, &LegPoints::toe_tip})
        out.*point = between(a.*point, b.*point, c.*point, d.*point, t);
    return out;
}

Footprint Forecast::footprint(std::size_t side, const ContactRun& run, float leg_length) const noexcept {
    const auto mean = [&](bool flat_only, int& count) {
        LegPoints sum{};
        count = 0;
        for (int i = run.first; i <= run.last; ++i) {
            const auto n = static_cast<std::size_t>(i);
            if (flat_only && !(heel_down[side][n] && ball_down[side][n])) continue;
            sum.heel += legs[side][n].heel;
            sum.ball += legs[side][n].ball;
            sum.toe_tip += legs[side][n].toe_tip;
            ++count;
        }
        return sum;
    };
    int count = 0;
    LegPoints sum = mean(true, count);
    if (count < k_shortest_run) sum = mean(false, count);
    const float share = 1.0f / static_cast<float>(std::max(count, 1));
    return make_footprint(sum.heel * share, sum.ball * share, sum.toe_tip * share, leg_length);
}

double Forecast::passing(Vec3 place, double otherwise) const noexcept {
    std::size_t nearest = 0;
    float least = 1e30f;
    for (std::size_t i = 0; i < k_samples; ++i) {
        const float d = planar_length(root[i] - place);
        if (d < least) least = d, nearest = i;
    }
    // Between the samples, and beyond them as the root goes there.
    const std::size_t before = nearest > 0 ? nearest - 1 : 0, after = std::min<std::size_t>(nearest + 1, k_samples - 1);
    const Vec3 step = (root[after] - root[before]) * (1.0f / static_cast<float>(after - before));
    const float square = dot(step, step);
    constexpr float k_slowest = 0.1f / k_rate;  // [m] a sample: slower roots pass nothing
    if (square < k_slowest * k_slowest) return otherwise;
    const double samples =
        static_cast<double>(nearest) + static_cast<double>(dot(place - root[nearest], step) / square);
    return std::clamp(start + samples / k_rate, otherwise - k_most_early, otherwise + k_most_early);
}

void look_ahead(const FootRig& rig, double clock, const LegPreview& preview, Forecast& f) noexcept {
    f.start = clock;
    std::array<float, k_batch> ahead;
    std::array<LegsPose, k_batch> legs;
    std::array<RootFrame, k_batch> roots;
    for (int first = 0; first < Forecast::k_samples; first += k_batch) {
        const auto count = static_cast<std::size_t>(std::min(k_batch, Forecast::k_samples - first));
        for (std::size_t i = 0; i < count; ++i)
            ahead[i] = static_cast<float>(first + static_cast<int>(i)) / Forecast::k_rate;
        preview.sample({ahead.data(), count}, {legs.data(), count}, {roots.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const auto n = static_cast<std::size_t>(first) + i;
            f.root[n] = {roots[i].position.x, 0, roots[i].position.z};
            f.yaw[n] = roots[i].yaw;
            const Transform world = world_of(roots[i]);
            for (std::size_t side = 0; side < 2; ++side)
                f.legs[side][n] = leg_points(rig.legs.side[side], legs[i].side[side], world);
        }
    }
    for (std::size_t side = 0; side < 2; ++side) {
        const float scale = rig.legs.side[side].length() / k_usual_leg;
        for (int i = 0; i < Forecast::k_samples; ++i) {
            const auto n = static_cast<std::size_t>(i);
            const auto before = static_cast<std::size_t>(std::max(i - 1, 0)),
                       after = static_cast<std::size_t>(std::min(i + 1, Forecast::k_samples - 1));
            const float root_speed =
                planar_length(f.root[after] - f.root[before]) * Forecast::k_rate / static_cast<float>(after - before);
            const float slow = std::max(k_slow * scale, root_speed > k_fast_root ? k_slow_share * root_speed : 0);
            const LegPoints& p = f.legs[side][n];
            f.heel_down[side][n] =
                p.heel.y < k_heel_height * scale && speed_at(f.legs[side], &LegPoints::heel, i) < slow;
            f.ball_down[side][n] =
                p.ball.y < k_ball_height * scale && speed_at(f.legs[side], &LegPoints::ball, i) < slow;
            f.tip_down[side][n] =
                p.toe_tip.y < k_tip_height * scale && speed_at(f.legs[side], &LegPoints::toe_tip, i) < slow;
        }
        find_runs(f, side);
        f.rests[side] = foot_rests(f, side, scale);
    }
}

}  // namespace surefoot
