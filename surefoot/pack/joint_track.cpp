#include <surefoot/pack/joint_track.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

JointTrack joint_track(std::span<const Transform> locals, std::size_t joints, std::size_t joint, Quat rest) {
    JointTrack track;
    int other_side = 0;
    for (std::size_t at = joint; at < locals.size(); at += joints) {
        const Quat q = normalized(locals[at].rotation);
        track.rotations.push_back(track.rotations.empty() ? aligned(q, rest) : aligned(q, track.rotations.back()));
        other_side += dot(track.rotations.back(), rest) < 0;
    }
    if (2 * static_cast<std::size_t>(other_side) > track.rotations.size()) {
        for (Quat& q : track.rotations) q = -q;
        other_side = static_cast<int>(track.rotations.size()) - other_side;
    }
    track.turning = other_side > 0;
    return track;
}

void put_rotation(std::int16_t* blocks, std::size_t joint, Quat q) {
    std::int16_t* to = blocks + joint / k_lanes * 4 * k_lanes + joint % k_lanes;
    const float values[4] = {q.x, q.y, q.z, q.w};
    for (std::size_t c = 0; c < 4; ++c)
        to[c * k_lanes] = static_cast<std::int16_t>(std::lround(std::clamp(values[c], -1.0f, 1.0f) * k_rotation_scale));
}

}  // namespace surefoot
