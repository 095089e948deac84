#include <surefoot/math/trig.h>
#include <surefoot/preset/level_head.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surefoot {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Gaze {
    float yaw = 0, pitch = 0;  ///< [rad] to its left, upward; as seen from the root
};

Quat rotation_of(Gaze gaze) { return from_yaw(gaze.yaw) * axis_angle({1, 0, 0}, -gaze.pitch); }

Gaze gaze_of(Quat head) {
    const Vec3 ahead = rotate(head, {0, 0, 1});
    return {atan2(ahead.x, ahead.z), asin(std::clamp(ahead.y, -1.0f, 1.0f))};
}

/// Brings values nearer to zero, all by the same factor, so that none is beyond `most`.
float fitting_factor(float largest, float most) { return largest > most ? most / largest : 1.0f; }

}  // namespace

void level_head(Motion& motion, const RoleMap& roles) {
    constexpr float k_most_pitch = 1 * k_radians_per_degree, k_most_yaw = 30 * k_radians_per_degree;
    const int neck = roles[Role::neck], head = roles[Role::head], parent = motion.skeleton->parents[at(neck)];
    const int frames = motion.frame_count();
    std::vector<Transform> rest(at(motion.joint_count())), models(rest.size());
    local_to_model(*motion.skeleton, motion.skeleton->rest, rest);
    const Quat upright = conjugate(rest[at(head)].rotation);
    std::vector<Gaze> gazes;
    Gaze mean;
    for (int f = 0; f < frames; ++f) {
        local_to_model(*motion.skeleton, motion.frame(f), models);
        gazes.push_back(gaze_of(models[at(head)].rotation * upright));
        mean.yaw += gazes.back().yaw / static_cast<float>(frames);
        mean.pitch += gazes.back().pitch / static_cast<float>(frames);
    }
    if (motion.root.back().yaw != 0) mean.yaw = 0;  // who turns looks where that leads
    Gaze largest;
    for (const Gaze& gaze : gazes) {
        largest.yaw = std::max(largest.yaw, std::fabs(gaze.yaw - mean.yaw));
        largest.pitch = std::max(largest.pitch, std::fabs(gaze.pitch - mean.pitch));
    }
    const float of_yaw = fitting_factor(largest.yaw, k_most_yaw),
                of_pitch = fitting_factor(largest.pitch, k_most_pitch);
    for (int f = 0; f < frames; ++f) {
        const Gaze gaze = gazes[at(f)];
        const Gaze level{of_yaw * (gaze.yaw - mean.yaw), of_pitch * (gaze.pitch - mean.pitch)};
        const Quat turn = rotation_of(level) * conjugate(rotation_of(gaze));
        const Quat half = from_rotation_vector(to_rotation_vector(turn) * 0.5f);
        const auto locals = motion.frame(f);
        local_to_model(*motion.skeleton, locals, models);
        const Quat turned = half * models[at(neck)].rotation;
        locals[at(neck)].rotation = normalized(conjugate(models[at(parent)].rotation) * turned);
        locals[at(head)].rotation = normalized(conjugate(turned) * turn * models[at(head)].rotation);
    }
}

}  // namespace surefoot
