#include <surefoot/base/error.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/interpolate.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Travel and turn in the body's frame.
struct BodyStep {
    double aside = 0, ahead = 0, turn = 0;

    BodyStep& operator+=(const BodyStep& other) {
        aside += other.aside, ahead += other.ahead, turn += other.turn;
        return *this;
    }
    friend BodyStep operator*(const BodyStep& a, double s) { return {a.aside * s, a.ahead * s, a.turn * s}; }
    friend BodyStep operator-(const BodyStep& a, const BodyStep& b) {
        return {a.aside - b.aside, a.ahead - b.ahead, a.turn - b.turn};
    }
    double size() const {
        constexpr double k_metres_per_radian = 0.25;
        const double t = k_metres_per_radian * turn;
        return std::sqrt(aside * aside + ahead * ahead + t * t);
    }
};

BodyStep body_step(const RootFrame& a, const RootFrame& b) {
    const Vec3 step = rotate(from_yaw(-0.5f * (a.yaw + b.yaw)), b.position - a.position);
    return {static_cast<double>(step.x), static_cast<double>(step.z), static_cast<double>(b.yaw - a.yaw)};
}

void check(std::span<const PhasedClip> clips, double weight, std::size_t marks) {
    if (clips.empty() || !(weight > 0))
        throw Error("there is nothing to mix", "interpolate", "give clips with weights above zero");
    const Motion& first = *clips.front().motion;
    for (const PhasedClip& clip : clips) {
        const Motion& motion = *clip.motion;
        if (!(motion.skeleton == first.skeleton || *motion.skeleton == *first.skeleton))
            throw Error("clips of different skeletons cannot be mixed", motion.name, "retarget one of them first");
        if (!(clip.weight >= 0)) throw Error("a weight is below zero", motion.name, "give weights of zero or more");
        if (motion.frame_count() < 1) throw Error("the clip has no frames", motion.name, "leave it out");
        if (clip.marks.empty()) continue;
        if (clip.marks.size() != marks)
            throw Error("the clips have different numbers of steps", motion.name, "mark one cycle in each");
        for (std::size_t k = 1; k < marks; ++k)
            if (!(clip.marks[k] > clip.marks[k - 1]))
                throw Error("the moments of its steps do not ascend", motion.name, "measure the clip again");
    }
}

/// Phase, 0 to 1, of each mark in the mixture: the weighted mean.
std::vector<double> mean_phases(std::span<const PhasedClip> clips, std::size_t marks) {
    std::vector<double> phases(marks, 0.0);
    double sum = 0;
    for (const PhasedClip& clip : clips) {
        if (clip.marks.empty()) continue;
        // A clip of weight 0 among others of weight 0 still says where strikes are.
        const double w = std::max(static_cast<double>(clip.weight), 1e-9);
        const double span = static_cast<double>(clip.marks.back() - clip.marks.front());
        for (std::size_t k = 0; k < marks; ++k)
            phases[k] += w * static_cast<double>(clip.marks[k] - clip.marks.front()) / span;
        sum += w;
    }
    for (double& phase : phases) phase /= sum;
    phases.front() = 0, phases.back() = 1;
    return phases;
}

/// The clip's own moment at a phase of the mixture.
double moment(const PhasedClip& clip, const std::vector<double>& phases, double phase) {
    if (clip.marks.empty()) return 0;
    std::size_t k = 0;
    while (k + 2 < phases.size() && phase > phases[k + 1]) ++k;
    const double t = (phase - phases[k]) / (phases[k + 1] - phases[k]);
    return static_cast<double>(clip.marks[k]) + t * static_cast<double>(clip.marks[k + 1] - clip.marks[k]);
}

struct Rhythm {
    double seconds = 0;
    BodyStep stride, velocity;  // weighted means; the velocity a second
};

/// Stride and velocity of one clip over its marks, in steps as small as its frames.
BodyStep stride_of(const PhasedClip& clip) {
    BodyStep sum;
    if (clip.marks.empty()) return sum;
    const double from = static_cast<double>(clip.marks.front()), to = static_cast<double>(clip.marks.back());
    const int steps = std::max(1, static_cast<int>((to - from) * static_cast<double>(clip.motion->fps) + 0.5));
    std::vector<Transform> unused(at(clip.motion->joint_count()));
    RootFrame before, now;
    sample(*clip.motion, static_cast<float>(from), before, unused);
    for (int i = 1; i <= steps; ++i, before = now) {
        sample(*clip.motion, static_cast<float>(from + (to - from) * i / steps), now, unused);
        sum += body_step(before, now);
    }
    return sum;
}

Rhythm rhythm_of(std::span<const PhasedClip> clips, double weight) {
    Rhythm rhythm;
    double frequency = 0, stepping = 0;
    for (const PhasedClip& clip : clips) {
        if (clip.marks.empty()) continue;
        const double w = static_cast<double>(clip.weight) / weight;
        const double seconds = static_cast<double>(clip.marks.back() - clip.marks.front());
        const BodyStep stride = stride_of(clip);
        rhythm.stride += stride * w;
        rhythm.velocity += stride * (w / seconds);
        frequency += w / seconds;
        stepping += w;
    }
    constexpr double k_vanishes = 0.02;  // [m/s]
    if (rhythm.velocity.size() > k_vanishes && rhythm.stride.size() > 0)
        rhythm.seconds = rhythm.stride.size() / rhythm.velocity.size();
    else if (frequency > 0)
        rhythm.seconds = stepping / frequency;
    else
        rhythm.seconds = static_cast<double>(clips.front().motion->duration());
    return rhythm;
}

void mix_pose(std::span<const PhasedClip> clips, double weight, const std::vector<std::vector<Transform>>& poses,
              std::span<Transform> out) {
    for (std::size_t j = 0; j < out.size(); ++j) {
        Quat sum{0, 0, 0, 0};
        Vec3 shift;
        const Quat reference = poses.front()[j].rotation;
        for (std::size_t i = 0; i < clips.size(); ++i) {
            const auto w = static_cast<float>(static_cast<double>(clips[i].weight) / weight);
            const Quat q = aligned(poses[i][j].rotation, reference);
            sum = {sum.x + w * q.x, sum.y + w * q.y, sum.z + w * q.z, sum.w + w * q.w};
            shift += w * poses[i][j].translation;
        }
        out[j] = {normalized(sum), shift};
    }
}

}  // namespace

Motion interpolate(std::span<const PhasedClip> clips, float fps) {
    double weight = 0;
    std::size_t marks = 0;
    for (const PhasedClip& clip : clips) {
        weight += static_cast<double>(clip.weight);
        marks = std::max(marks, clip.marks.size());
    }
    check(clips, weight, marks);
    if (marks == 1) throw Error("one mark makes no cycle", clips.front().motion->name, "mark both ends of a cycle");
    if (!(fps > 0) || !std::isfinite(fps))
        throw Error("the frame rate must be a positive number", "interpolate", "ask for 30 or 60, say");

    const Rhythm rhythm = rhythm_of(clips, weight);
    const int steps = std::max(1, static_cast<int>(rhythm.seconds * static_cast<double>(fps) + 0.5));
    Motion result = make_motion(clips.front().motion->skeleton, clips.front().motion->name, steps + 1, fps);
    result.fps = rhythm.seconds > 0 ? static_cast<float>(steps / rhythm.seconds) : fps;
    result.cyclic = true;
    const std::vector<double> phases = marks > 0 ? mean_phases(clips, marks) : std::vector<double>{0, 1};
    // What a stride a cycle lacks to the mean velocity (turns and sidesteps of clips at other rhythms), evenly.
    const BodyStep lacking = (rhythm.velocity * rhythm.seconds - rhythm.stride) * (1.0 / steps);

    std::vector<std::vector<Transform>> poses(clips.size(), std::vector<Transform>(at(result.joint_count())));
    std::vector<RootFrame> before(clips.size());
    double x = 0, z = 0, yaw = 0;
    for (int f = 0; f <= steps; ++f) {
        const double phase = static_cast<double>(f) / steps;
        BodyStep step = lacking;
        for (std::size_t i = 0; i < clips.size(); ++i) {
            RootFrame root;
            sample(*clips[i].motion, static_cast<float>(moment(clips[i], phases, phase)), root, poses[i]);
            if (f > 0) step += body_step(before[i], root) * (static_cast<double>(clips[i].weight) / weight);
            before[i] = root;
        }
        mix_pose(clips, weight, poses, result.frame(f));
        if (f > 0) {
            const double middle = yaw + 0.5 * step.turn;
            x += cos(middle) * step.aside + sin(middle) * step.ahead;
            z += cos(middle) * step.ahead - sin(middle) * step.aside;
            yaw += step.turn;
        }
        result.root[at(f)] = {{static_cast<float>(x), 0, static_cast<float>(z)}, static_cast<float>(yaw)};
    }
    const auto first = result.frame(0), last = result.frame(steps);
    std::copy(first.begin(), first.end(), last.begin());
    return result;
}

}  // namespace surefoot
