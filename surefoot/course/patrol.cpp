#include <surefoot/course/patrol.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

LocomotionRequest Patrol::ask(const RootFrame& root, float speed) noexcept {
    constexpr float k_look_ahead = 4;                 // [m] along the line, of the place that it heads for
    constexpr float k_gain = 1.6f, k_most_turn = 60;  // [1/s], [deg/s]
    constexpr float k_turning_round = 60;             // [deg] off: slower
    constexpr float k_share_turning = 0.6f;
    if (root.position.z > length_) back_ = true;
    if (root.position.z < 0) back_ = false;
    const float ahead = back_ ? -k_look_ahead : k_look_ahead;
    const float heading = atan2(-root.position.x, ahead);
    const float off = wrap_angle(heading - root.yaw) / k_radians_per_degree;
    LocomotionRequest request;
    request.turn = std::clamp(k_gain * off, -k_most_turn, k_most_turn);
    request.speed = std::fabs(off) > k_turning_round ? speed * k_share_turning : speed;
    return request;
}

}  // namespace surefoot
