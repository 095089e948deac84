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

// Low joints count most when poses are laid over each other: what the seam takes out of a standing foot is skate, and
// a hand has 15 finger joints. The weight falls by a factor e with every half of the figure's height.
std::vector<double> weights_by_height(const std::vector<Transform>& a, const std::vector<Transform>& b) {
    float low = a[0].translation.y, high = low;
    for (const std::vector<Transform>* pose : {&a, &b})
        for (const Transform& joint : *pose) {
            low = std::fmin(low, joint.translation.y);
            high = std::fmax(high, joint.translation.y);
        }
    const double scale = std::fmax(1e-6, 0.5 * static_cast<double>(high - low));
    std::vector<double> weights;
    double sum = 0;
    for (std::size_t j = 0; j < a.size(); ++j) {
        const double y = 0.5 * static_cast<double>(a[j].translation.y + b[j].translation.y) - static_cast<double>(low);
        weights.push_back(exp(-y / scale) + 1e-3);
        sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

// The step on the ground that best lays the last pose over the first (weighted least squares of joint positions in the
// plane). The low-passed root drifts by a centimetre or two against the body from cycle to cycle; this takes the drift
// out of the seam without moving a joint in the world.
RootFrame alignment(const Motion& motion) {
    const std::vector<Transform> first = models_of(motion, 0), last = models_of(motion, motion.frame_count() - 1);
    const std::vector<double> w = weights_by_height(first, last);
    double ax = 0, az = 0, bx = 0, bz = 0;
    for (std::size_t j = 0; j < first.size(); ++j) {
        ax += w[j] * static_cast<double>(first[j].translation.x),
            az += w[j] * static_cast<double>(first[j].translation.z);
        bx += w[j] * static_cast<double>(last[j].translation.x),
            bz += w[j] * static_cast<double>(last[j].translation.z);
    }
    double along = 0, across = 0;
    for (std::size_t j = 0; j < first.size(); ++j) {
        const double px = static_cast<double>(first[j].translation.x) - ax;
        const double pz = static_cast<double>(first[j].translation.z) - az;
        const double qx = static_cast<double>(last[j].translation.x) - bx;
        const double qz = static_cast<double>(last[j].translation.z) - bz;
        along += w[j] * (px * qx + pz * qz);
        across += w[j] * (pz * qx - px * qz);  // turning first into last, about +Y
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

// Speeds at the ends come from three frames each, one-sided and of second order: what a steady curve bends within a
// frame is no mismatch.
LoopClosing seam_of(const Motion& motion) {
    LoopClosing result;
    const int last = motion.frame_count() - 1;
    if (last < 1) return result;
    const auto near_start = [&](int f) { return models_of(motion, std::min(f, last)); };
    const auto near_end = [&](int f) { return models_of(motion, std::max(last - f, 0)); };
    const std::vector<Transform> first = near_start(0), second = near_start(1), third = near_start(2);
    const std::vector<Transform> end = near_end(0), before = near_end(1), earlier = near_end(2);
    result.seam = largest_distance(first, end);
    for (std::size_t j = 0; j < first.size(); ++j) {
        const Vec3 leaving = 2.0f * (second[j].translation - first[j].translation) -
                             0.5f * (third[j].translation - first[j].translation);
        const Vec3 arriving =
            2.0f * (end[j].translation - before[j].translation) - 0.5f * (end[j].translation - earlier[j].translation);
        result.seam_speed = std::fmax(result.seam_speed, length(leaving - arriving) * motion.fps);
    }
    return result;
}

// What leads from pose a to pose b, joint by joint.
struct Change {
    std::vector<Vec3> turn, shift;

    Change(std::span<const Transform> a, std::span<const Transform> b) {
        for (std::size_t j = 0; j < a.size(); ++j) {
            turn.push_back(to_rotation_vector(conjugate(a[j].rotation) * b[j].rotation));
            shift.push_back(b[j].translation - a[j].translation);
        }
    }
    void add_to(std::span<Transform> pose, float share) const {
        for (std::size_t j = 0; j < pose.size(); ++j) {
            pose[j].rotation = normalized(pose[j].rotation * from_rotation_vector(turn[j] * share));
            pose[j].translation += shift[j] * share;
        }
    }
};

// Half of the mismatch at either end, none in the middle: the same constant speed is added everywhere, so the seam's
// velocities stay as they are, and the ends move by half of the seam.
void close_positions(Motion& motion) {
    const int last = motion.frame_count() - 1;
    const Change mismatch(motion.frame(0), motion.frame(last));
    for (int f = 0; f <= last; ++f)
        mismatch.add_to(motion.frame(f), 0.5f - static_cast<float>(f) / static_cast<float>(last));
}

// Then the velocities meet halfway: beside the seam either end gets a (t)(1 - t / width)^2, which starts with slope a
// and moves no pose by more than 4/27 of a times the width (half a metre a second: 0.6 cm).
void close_velocities(Motion& motion, float seconds) {
    const int last = motion.frame_count() - 1;
    const float width = std::fmin(seconds * motion.fps, 0.25f * static_cast<float>(last));  // frames
    if (width < 2.0f) return;
    const Change leaving(motion.frame(0), motion.frame(1)), leaving_2(motion.frame(0), motion.frame(2));
    const Change arriving(motion.frame(last - 1), motion.frame(last)),
        arriving_2(motion.frame(last - 2), motion.frame(last));
    Change half = arriving;
    // Slopes of second order as in seam_of; by the same formula the correction itself has slope 1 - 2 / width^2.
    const float slope = 0.5f / (1 - 2 / (width * width));
    const auto mismatch = [&](auto part, std::size_t j) {
        const Vec3 in = 2.0f * (arriving.*part)[j] - 0.5f * (arriving_2.*part)[j];
        const Vec3 out = 2.0f * (leaving.*part)[j] - 0.5f * (leaving_2.*part)[j];
        return (in - out) * slope;
    };
    for (std::size_t j = 0; j < half.turn.size(); ++j) {
        half.turn[j] = mismatch(&Change::turn, j);
        half.shift[j] = mismatch(&Change::shift, j);
    }
    for (int t = 1; static_cast<float>(t) < width; ++t) {
        const float fall = 1 - static_cast<float>(t) / width, share = static_cast<float>(t) * fall * fall;
        half.add_to(motion.frame(t), share);
        half.add_to(motion.frame(last - t), share);
    }
}

}  // namespace

LoopClosing measure_seam(const Motion& motion) {
    if (motion.frame_count() < 2) return {};
    Motion aligned = motion;
    align(aligned);
    return seam_of(aligned);
}

LoopClosing close_loop(Motion& motion, const LoopOptions& options) {
    const int last = motion.frame_count() - 1;
    if (last < 1) return {};
    if (options.fit_step) align(motion);
    LoopClosing result = seam_of(motion);
    const Motion before = motion;
    close_positions(motion);
    close_velocities(motion, options.velocity_width);
    for (int f = 0; f <= last; ++f)
        result.added = std::fmax(result.added, largest_distance(models_of(before, f), models_of(motion, f)));
    const auto first = motion.frame(0);
    const auto end = motion.frame(last);
    for (std::size_t j = 0; j < first.size(); ++j)  // to the last bit, and on the same side of the quaternion sphere
        end[j] = {aligned(first[j].rotation, end[j].rotation), first[j].translation};
    motion.cyclic = true;
    return result;
}

}  // namespace surefoot
