// Closing of loops: what the body does from the first to the last frame beside its travel is spread over the cycle.

#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>

#include <algorithm>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<Transform> models_of(const Motion& motion, int frame) {
    std::vector<Transform> models(at(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.frame(frame), models);
    return models;
}

// The step on the ground that best lays the last pose over the first (least squares of joint positions in the plane).
// The low-passed root drifts by a centimetre or two against the body from cycle to cycle; this takes the drift out of
// the seam without moving a joint in the world.
RootFrame alignment(const Motion& motion) {
    const std::vector<Transform> first = models_of(motion, 0), last = models_of(motion, motion.frame_count() - 1);
    const double n = static_cast<double>(first.size());
    double ax = 0, az = 0, bx = 0, bz = 0;
    for (std::size_t j = 0; j < first.size(); ++j) {
        ax += static_cast<double>(first[j].translation.x) / n, az += static_cast<double>(first[j].translation.z) / n;
        bx += static_cast<double>(last[j].translation.x) / n, bz += static_cast<double>(last[j].translation.z) / n;
    }
    double along = 0, across = 0;
    for (std::size_t j = 0; j < first.size(); ++j) {
        const double px = static_cast<double>(first[j].translation.x) - ax;
        const double pz = static_cast<double>(first[j].translation.z) - az;
        const double qx = static_cast<double>(last[j].translation.x) - bx;
        const double qz = static_cast<double>(last[j].translation.z) - bz;
        along += px * qx + pz * qz;
        across += pz * qx - px * qz;  // turning first into last, about +Y
    }
    const double yaw = along != 0 || across != 0 ? atan2(across, along) : 0.0;
    const Vec3 centre = rotate(from_yaw(static_cast<float>(yaw)), {static_cast<float>(ax), 0, static_cast<float>(az)});
    return {{static_cast<float>(bx) - centre.x, 0, static_cast<float>(bz) - centre.z}, static_cast<float>(yaw)};
}

// The root takes the alignment over the cycle, a little more each frame; world poses stay as they are.
void align(Motion& motion) {
    const RootFrame whole = alignment(motion);
    std::vector<RootFrame> frames = motion.root;
    const int last = motion.frame_count() - 1;
    for (int f = 1; f <= last; ++f) {
        const float s = static_cast<float>(f) / static_cast<float>(last);
        frames[at(f)] = frames[at(f)] * RootFrame{whole.position * s, whole.yaw * s};
    }
    set_root_frames(motion, frames);
}

float largest_distance(std::span<const Transform> a, std::span<const Transform> b) {
    float worst = 0;
    for (std::size_t j = 0; j < a.size(); ++j) worst = std::fmax(worst, distance(a[j].translation, b[j].translation));
    return worst;
}

LoopClosing seam_of(const Motion& motion) {
    LoopClosing result;
    const int last = motion.frame_count() - 1;
    if (last < 1) return result;
    const std::vector<Transform> first = models_of(motion, 0), second = models_of(motion, 1);
    const std::vector<Transform> before = models_of(motion, last - 1), end = models_of(motion, last);
    result.seam = largest_distance(first, end);
    for (std::size_t j = 0; j < first.size(); ++j) {
        const Vec3 leaving = second[j].translation - first[j].translation;
        const Vec3 arriving = end[j].translation - before[j].translation;
        result.seam_speed = std::fmax(result.seam_speed, length(leaving - arriving) * motion.fps);
    }
    return result;
}

}  // namespace

LoopClosing measure_seam(const Motion& motion) {
    if (motion.frame_count() < 2) return {};
    Motion aligned = motion;
    align(aligned);
    return seam_of(aligned);
}

LoopClosing close_loop(Motion& motion) {
    const int last = motion.frame_count() - 1;
    if (last < 1) return {};
    align(motion);
    LoopClosing result = seam_of(motion);
    std::vector<Vec3> turn, shift;
    for (std::size_t j = 0; j < at(motion.joint_count()); ++j) {
        const Transform& a = motion.frame(0)[j];
        const Transform& b = motion.frame(last)[j];
        turn.push_back(to_rotation_vector(conjugate(a.rotation) * b.rotation));
        shift.push_back(b.translation - a.translation);
    }
    for (int f = 0; f <= last; ++f) {
        // Half of the mismatch at either end, none in the middle: the same constant speed is added everywhere, so the
        // seam's velocities stay as they are, and no frame moves by more than half of the seam.
        const float share = 0.5f - static_cast<float>(f) / static_cast<float>(last);
        const std::vector<Transform> old = models_of(motion, f);
        const auto pose = motion.frame(f);
        for (std::size_t j = 0; j < pose.size(); ++j) {
            pose[j].rotation = normalized(pose[j].rotation * from_rotation_vector(turn[j] * share));
            pose[j].translation += shift[j] * share;
        }
        result.added = std::fmax(result.added, largest_distance(old, models_of(motion, f)));
    }
    const auto first = motion.frame(0);
    const auto end = motion.frame(last);
    for (std::size_t j = 0; j < first.size(); ++j)  // to the last bit, and on the same side of the quaternion sphere
        end[j] = {aligned(first[j].rotation, end[j].rotation), first[j].translation};
    motion.cyclic = true;
    return result;
}

}  // namespace surefoot
