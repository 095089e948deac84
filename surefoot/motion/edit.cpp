#include <surefoot/motion/edit.h>

#include <surefoot/base/error.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Motion empty_copy(const Motion& motion, int frames) {
    Motion result;
    result.name = motion.name;
    result.skeleton = motion.skeleton;
    result.fps = motion.fps;
    result.cyclic = motion.cyclic;
    result.root.resize(at(frames));
    result.locals.resize(at(frames) * at(motion.joint_count()));
    return result;
}

void copy_frame(const Motion& from, int source, Motion& to, int target) {
    to.root[at(target)] = from.root[at(source)];
    const auto pose = from.frame(source);
    std::copy(pose.begin(), pose.end(), to.frame(target).begin());
}

RootFrame inverse_frame(const RootFrame& frame) { return between(frame, RootFrame{}); }

// `step` taken `times` over, by repeated squaring: a clip may be asked for a moment days ahead.
RootFrame repeated(RootFrame step, double times) {
    RootFrame result;
    for (auto k = static_cast<std::uint64_t>(std::fmin(times, 1e15)); k > 0; k >>= 1u) {
        if (k & 1u) result = result * step;
        step = step * step;
    }
    return result;
}

// `where` in frames, within the clip.
void sample_frames(const Motion& motion, double where, RootFrame& root, std::span<Transform> locals) {
    const int last = motion.frame_count() - 1;
    const int f = std::clamp(static_cast<int>(std::floor(where)), 0, last);
    const float t = static_cast<float>(where - f);
    const auto a = motion.frame(f);
    root = motion.root[at(f)];
    if (f == last || !(t > 0)) {
        std::copy(a.begin(), a.end(), locals.begin());
        return;
    }
    const auto b = motion.frame(f + 1);
    const RootFrame& next = motion.root[at(f + 1)];
    root.position = lerp(root.position, next.position, t);
    root.yaw += (next.yaw - root.yaw) * t;
    for (std::size_t j = 0; j < a.size(); ++j)
        locals[j] = {slerp(a[j].rotation, b[j].rotation, t), lerp(a[j].translation, b[j].translation, t)};
}

}  // namespace

Motion cut(const Motion& motion, int first_frame, int last_frame) {
    const int last = motion.frame_count() - 1;
    const int first = std::clamp(first_frame, 0, last);
    const int end = std::clamp(last_frame, first, last);
    Motion result = empty_copy(motion, end - first + 1);
    result.cyclic = motion.cyclic && first == 0 && end == last;
    for (int f = first; f <= end; ++f) copy_frame(motion, f, result, f - first);
    return result;
}

void start_at_origin(Motion& motion) {
    if (motion.root.empty()) return;
    RootFrame start = motion.root[0];
    start.position.y = 0;
    const RootFrame back = inverse_frame(start);
    for (RootFrame& frame : motion.root) frame = back * frame;
}

Motion rotate_cycle(const Motion& motion, int first_frame) {
    const int last = motion.frame_count() - 1;
    if (!motion.cyclic || first_frame <= 0 || first_frame >= last) return motion;
    Motion result = empty_copy(motion, last + 1);
    result.cyclic = true;
    const RootFrame travel = motion.root[at(last)] * inverse_frame(motion.root[0]);
    for (int f = 0; f <= last; ++f) {
        const int source = first_frame + f <= last ? first_frame + f : first_frame + f - last;
        copy_frame(motion, source, result, f);
        if (first_frame + f > last) result.root[at(f)] = travel * result.root[at(f)];
    }
    return result;
}

Motion reverse(const Motion& motion) {
    const int count = motion.frame_count();
    Motion result = empty_copy(motion, count);
    if (count == 0) return result;
    const RootFrame shift = motion.root[0] * inverse_frame(motion.root[at(count - 1)]);
    for (int f = 0; f < count; ++f) {
        copy_frame(motion, count - 1 - f, result, f);
        result.root[at(f)] = shift * result.root[at(f)];
    }
    result.root[0] = motion.root[0];  // to the last bit
    return result;
}

void sample(const Motion& motion, float time, RootFrame& root, std::span<Transform> locals) {
    const int intervals = motion.frame_count() - 1;
    double where = static_cast<double>(time) * static_cast<double>(motion.fps);
    if (!motion.cyclic || intervals < 1) {
        sample_frames(motion, std::clamp(where, 0.0, static_cast<double>(std::max(intervals, 0))), root, locals);
        return;
    }
    const double cycles = std::floor(where / intervals);
    sample_frames(motion, std::clamp(where - cycles * intervals, 0.0, static_cast<double>(intervals)), root, locals);
    const RootFrame start = motion.root.front(), step = between(start, motion.root.back());
    root = start * repeated(cycles < 0 ? inverse_frame(step) : step, std::fabs(cycles)) * between(start, root);
}

Motion retime(const Motion& motion, float rate) {
    if (!(rate >= k_slowest_retime && rate <= k_fastest_retime))
        throw Error("a clip cannot be played " + std::to_string(rate) + " times as fast and still look right",
                    motion.name, "stay between 0.8 and 1.25; for other speeds blend it with a faster or slower clip");
    Motion faster = motion;
    faster.fps = motion.fps * rate;
    return resample(faster, motion.fps);
}

Motion resample(const Motion& motion, float fps) {
    if (!(fps > 0) || !std::isfinite(fps))
        throw Error("the frame rate must be a positive number", motion.name, "ask for 30 or 60 frames a second, say");
    const int intervals = motion.frame_count() - 1;
    if (intervals < 1) {
        Motion result = motion;
        result.fps = fps;
        return result;
    }
    const double duration = intervals / static_cast<double>(motion.fps);
    const double wanted = std::floor(duration * static_cast<double>(fps) + 0.5);
    constexpr double k_most_frames = 10'000'000;  // 46 hours at 60 Hz: a typing error, not a clip
    if (wanted * motion.joint_count() > k_most_frames * 60)
        throw Error("the resampled clip would have too many frames", motion.name, "ask for a lower frame rate");
    const int steps = std::max(1, static_cast<int>(wanted));
    Motion result = empty_copy(motion, steps + 1);
    result.fps = static_cast<float>(steps / duration);
    for (int f = 0; f <= steps; ++f)
        sample_frames(motion, static_cast<double>(f) * intervals / steps, result.root[at(f)], result.frame(f));
    return result;
}

void untwist(Motion& motion, int joint) {
    const Skeleton& skeleton = *motion.skeleton;
    const auto child = std::find(skeleton.parents.begin(), skeleton.parents.end(), joint);
    if (child == skeleton.parents.end() || std::count(child, skeleton.parents.end(), joint) != 1) return;
    const std::size_t from = at(joint), to = static_cast<std::size_t>(child - skeleton.parents.begin());
    const Quat rest = skeleton.rest[from].rotation;
    const Vec3 bone = skeleton.rest[to].translation;
    for (int f = 0; f < motion.frame_count(); ++f) {
        const std::span<Transform> locals = motion.frame(f);
        const Transform end = locals[from] * locals[to];
        const Quat turn = conjugate(rest) * locals[from].rotation;
        locals[from].rotation = normalized(rest * rotation_between(bone, rotate(turn, bone)));
        locals[to] = {normalized(conjugate(locals[from].rotation) * end.rotation),
                      rotate(conjugate(locals[from].rotation), end.translation - locals[from].translation)};
    }
}

Motion concatenate(std::span<const Motion> parts) {
    if (parts.empty()) throw Error("there is nothing to join", "concatenate", "give at least one clip");
    Motion result = parts[0];
    result.cyclic = false;
    for (const Motion& part : parts.subspan(1)) {
        if (part.joint_count() != result.joint_count() ||
            !(part.skeleton == result.skeleton || *part.skeleton == *result.skeleton))
            throw Error("clips of different skeletons cannot be joined", part.name, "retarget one of them first");
        if (std::fabs(part.fps - result.fps) > 1e-3f * result.fps)
            throw Error("clips of different frame rates cannot be joined", part.name, "resample one of them first");
        if (part.frame_count() == 0) continue;
        RootFrame from = part.root[0];
        from.position.y = 0;
        RootFrame to = result.root.back();
        to.position.y = 0;
        const RootFrame shift = to * inverse_frame(from);
        const int start = result.frame_count() - 1;
        result.root.resize(at(start + part.frame_count()));
        result.locals.resize(result.root.size() * at(result.joint_count()));
        for (int f = 0; f < part.frame_count(); ++f) {
            copy_frame(part, f, result, start + f);
            result.root[at(start + f)] = shift * result.root[at(start + f)];
        }
    }
    return result;
}

}  // namespace surefoot
