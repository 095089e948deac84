#include <surefoot/graph/locomotion.h>
#include <surefoot/pack/steady_root.h>

namespace surefoot {

namespace {

constexpr int k_rounds = 12;                  // each shrinks the rest about tenfold
constexpr float k_least_travel_speed = 0.1f;  // [m/s] slower has no direction worth aligning with

/// The constant velocity that leads to `travel` in `seconds` while turning steadily by its yaw; `fallback` where the
/// path closes on itself (whole turns), which any velocity does.
Vec3 steady_velocity(const RootFrame& travel, float seconds, Vec3 fallback) {
    // Position after turning by t = turn * seconds: seconds * [s c; -c s] v, with s = sin t / t, c = (1 - cos t) / t.
    const RootFrame ahead = integrate({0, 0, 1}, travel.yaw / seconds, seconds);
    const float c = ahead.position.x, s = ahead.position.z, determinant = s * s + c * c;
    constexpr float k_least_determinant = 0.05f;  // of seconds squared: within about 80 degrees of a whole turn
    if (determinant < k_least_determinant * seconds * seconds)
        return {fallback.x, travel.position.y / seconds, fallback.z};
    return {(s * travel.position.x - c * travel.position.z) / determinant, travel.position.y / seconds,
            (c * travel.position.x + s * travel.position.z) / determinant};
}

/// Mean velocity between frames in the root's own frame.
Vec3 mean_body_velocity(const std::vector<RootFrame>& path, float seconds) {
    Vec3 sum;
    for (std::size_t f = 1; f < path.size(); ++f) {
        const RootFrame step = between(path[f - 1], path[f]);
        sum += rotate(from_yaw(-0.5f * step.yaw), step.position);
    }
    return sum / seconds;
}

RootFrame inverse_of(const RootFrame& a) { return between(a, RootFrame{}); }

/// Heading error of a velocity against straight ahead, or straight back if that is nearer.
float heading_error(Vec3 velocity) {
    return velocity.z >= 0 ? atan2(velocity.x, velocity.z) : atan2(-velocity.x, -velocity.z);
}

}  // namespace

SteadyRoot fit_steady_root(const Motion& motion, bool along_travel) {
    const auto frames = static_cast<std::size_t>(motion.frame_count());
    SteadyRoot result;
    result.deviation.resize(frames);
    const float seconds = motion.duration();
    if (frames < 2 || !(seconds > 0)) return result;
    std::vector<RootFrame> path(frames);
    for (std::size_t f = 0; f < frames; ++f) path[f] = between(motion.root[0], motion.root[f]);

    // The steady root starts at inverse(start): it sees the motion's first frame at `start` and, because the path ends
    // on `travel` as the motion does, its last frame there too.
    RootFrame start;
    for (int round = 0; round < k_rounds; ++round) {
        const RootFrame travel = start * path.back() * inverse_of(start);
        result.turn_rate = path.back().yaw / seconds;
        result.velocity =
            steady_velocity(travel, seconds, rotate(from_yaw(start.yaw), mean_body_velocity(path, seconds)));
        RootFrame mean;
        for (std::size_t f = 0; f < frames; ++f) {
            const float time = static_cast<float>(f) / motion.fps;
            result.deviation[f] = inverse_of(integrate(result.velocity, result.turn_rate, time)) * (start * path[f]);
            mean.position += result.deviation[f].position / static_cast<float>(frames);
            mean.yaw += result.deviation[f].yaw / static_cast<float>(frames);
        }
        if (round + 1 == k_rounds) break;
        start.position -= mean.position;
        const bool align = along_travel && planar_length(result.velocity) >= k_least_travel_speed;
        start.yaw -= align ? heading_error(result.velocity) : mean.yaw;
    }
    return result;
}

}  // namespace surefoot
