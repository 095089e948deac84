#include <surefoot/analysis/strikes.h>
#include <surefoot/base/error.h>
#include <surefoot/clip/sample.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/pack/foot_prints.h>
#include <surefoot/pack/joint_track.h>
#include <surefoot/pack/pack_clip.h>
#include <surefoot/pack/small_form.h>
#include <surefoot/pack/steady_root.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

void pack_rotations(PackedClip& clip, const Skeleton& skeleton, const std::vector<Transform>& locals) {
    const std::size_t joints = skeleton.rest.size(), blocks = static_cast<std::size_t>(clip.block_count());
    const std::size_t frames = static_cast<std::size_t>(clip.frame_count), frame_size = blocks * 4 * k_lanes;
    std::vector<std::int16_t> rotations(frames * frame_size, 0);
    for (std::size_t j = 0; j < blocks * k_lanes; ++j) {
        // Lanes without a joint hold the identity.
        JointTrack track{std::vector<Quat>(frames), false};
        if (j < joints) track = joint_track(locals, joints, j, skeleton.rest[j].rotation);
        if (track.turning) {
            clip.turning_blocks.resize(blocks);
            clip.turning_blocks[j / k_lanes] = 1;
        }
        for (std::size_t f = 0; f < frames; ++f) put_rotation(rotations.data() + f * frame_size, j, track.rotations[f]);
    }
    clip.rotations = std::move(rotations);
}

void pack_translations(PackedClip& clip, const Skeleton& skeleton, const std::vector<Transform>& locals, float least) {
    const std::size_t joints = skeleton.rest.size();
    for (std::size_t j = 0; j < joints; ++j) {
        bool moves = false;
        for (std::size_t at = j; at < locals.size() && !moves; at += joints)
            moves = distance(locals[at].translation, skeleton.rest[j].translation) > least;
        if (moves) clip.moving.push_back(static_cast<std::int16_t>(j));
    }
    std::vector<Vec3> translations;
    for (std::size_t at = 0; at < locals.size(); at += joints)
        for (const std::int16_t j : clip.moving)
            translations.push_back(locals[at + static_cast<std::size_t>(j)].translation);
    clip.translations = std::move(translations);
}

// Strikes alternate between the feet in a sound cycle. Where an event is doubtful (two of one foot in a row) the clip
// has no usable phase, and it plays on its own clock.
void pack_phase(PackedClip& clip, const ClipFacts& facts) {
    if (!clip.cyclic) return;
    const float duration = clip.duration();
    const std::vector<PhaseEvent> strikes = alternating_strikes(facts.events, duration, clip.fps);
    if (strikes.empty()) return;
    const std::size_t count = strikes.size();
    clip.cycles = static_cast<int>(count / 2);
    // Phase of the first frame: between the last strike of the pass before and the first of this one.
    const PhaseEvent &first = strikes.front(), &last = strikes.back();
    const float first_phase = first.foot == Side::left ? 1.0f : 0.5f;
    const float gap = first.time + duration - last.time;
    float start = first_phase - 0.5f * first.time / gap;
    const float whole = std::floor(start);
    start -= whole;
    clip.phase_map.push_back({0, start});
    for (std::size_t i = 0; i < count; ++i) {
        const float phase = first_phase - whole + 0.5f * static_cast<float>(i);
        const float share = strikes[i].time / duration;
        // A strike within a thousandth of the ends is the end.
        if (share > 1e-3f && share < 1 - 1e-3f) clip.phase_map.push_back({share, phase});
    }
    clip.phase_map.push_back({1, start + static_cast<float>(clip.cycles)});
}

/// The motion's poses as seen from a steady root.
std::vector<Transform> with_deviation(const Motion& motion, const std::vector<RootFrame>& deviation) {
    std::vector<Transform> locals = motion.locals;
    const std::size_t joints = motion.skeleton->rest.size();
    for (std::size_t f = 0; f < deviation.size(); ++f)
        for (std::size_t j = 0; j < joints; ++j)
            if (motion.skeleton->parents[j] < 0)
                locals[f * joints + j] = to_transform(deviation[f]) * locals[f * joints + j];
    return locals;
}

/// A clip of one frame becomes two equal ones: a pose that lasts.
Motion at_least_two_frames(Motion motion) {
    if (motion.frame_count() == 1) {
        motion.root.push_back(motion.root[0]);
        motion.locals.insert(motion.locals.end(), motion.locals.begin(), motion.locals.end());
        for (std::size_t i = 0; i < motion.locals.size() / 2; ++i)
            motion.locals[motion.locals.size() / 2 + i] = motion.locals[i];
    }
    return motion;
}

}  // namespace

namespace {

void keep_small(PackedClip& clip, const Motion& motion, std::span<const Transform> locals, const PackOptions& options) {
    PackedClip steady = clip;
    if (options.steady_root) steady.root = {};
    const auto error = [&](const PackedClip& tried) { return measure_packing(motion, tried, options.legs).error; };
    if (std::optional<PackedClip> small = small_form(steady, *motion.skeleton, locals, options.error, error))
        clip = *std::move(small);
}

}  // namespace

PackedClip pack_clip(const Motion& given, const ClipFacts& facts, const PackOptions& options, PackReport* report) {
    if (const std::string text = problem(given); !text.empty())
        throw Error(text, "clip '" + given.name + "'", "import the clip again");
    const Motion motion = at_least_two_frames(given);
    PackedClip clip;
    clip.name = motion.name;
    clip.fps = motion.fps;
    clip.frame_count = motion.frame_count();
    clip.joint_count = motion.joint_count();
    clip.cyclic = motion.cyclic;
    clip.travel = between(motion.root.front(), motion.root.back());

    const SteadyRoot steady = fit_steady_root(motion, options.along_travel);
    clip.velocity = steady.velocity;
    clip.turn_rate = steady.turn_rate;
    std::vector<Transform> locals = motion.locals;
    std::vector<RootFrame> root;
    if (options.steady_root) {
        locals = with_deviation(motion, steady.deviation);
        for (int f = 0; f < clip.frame_count; ++f)
            root.push_back(integrate(clip.velocity, clip.turn_rate, static_cast<float>(f) / clip.fps));
        clip.travel = root.back();
        clip.start = steady.deviation.front();
    } else {
        for (const RootFrame& frame : motion.root) root.push_back(between(motion.root.front(), frame));
    }
    clip.root = std::move(root);
    pack_rotations(clip, *motion.skeleton, locals);
    pack_translations(clip, *motion.skeleton, locals, options.moving_translation);
    pack_phase(clip, facts);
    if (options.legs != nullptr && options.legs->known() && options.steady_root)
        add_foot_prints(clip, *motion.skeleton, *options.legs, locals, facts);
    if (options.error > 0) keep_small(clip, motion, locals, options);
    if (report != nullptr) {
        *report = measure_packing(motion, clip, options.legs);
        for (const RootFrame& deviation : steady.deviation) {
            report->root_deviation = std::max(report->root_deviation, length(deviation.position));
            report->root_deviation_yaw = std::max(report->root_deviation_yaw, std::fabs(deviation.yaw));
        }
    }
    return clip;
}

namespace {

/// The largest distance between where two transforms put a joint's virtual vertices.
float vertex_distance(const Transform& a, const Transform& b) {
    float most = 0;
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Vec3 vertex = axis * k_virtual_vertex_distance;
        most = std::max(most, distance(transform_point(a, vertex), transform_point(b, vertex)));
    }
    return most;
}

/// Where a clip's print says that a foot is at a time, as seen from its root.
Transform foot_by_print(const PackedClip& clip, Side side, float time) {
    const FootKey key = foot_key_at(clip, side, time);
    return inverse(to_transform(integrate(clip.velocity, clip.turn_rate, key.age))) * key.print;
}

}  // namespace

PackReport measure_packing(const Motion& given, const PackedClip& clip, const Legs* legs) {
    const Motion motion = at_least_two_frames(given);
    const Skeleton& skeleton = *motion.skeleton;
    const std::size_t joints = skeleton.rest.size();
    std::vector<Transform> locals(joints), wanted(joints), got(joints);
    PackReport report;
    const RootFrame shift = between(clip.start, RootFrame{});  // lays the motion's first root frame at the origin
    for (int f = 0; f < clip.frame_count; ++f) {
        const float time = static_cast<float>(f) / clip.fps;
        local_to_model(skeleton, motion.frame(f), wanted);
        const Leaf leaf{0, time, 1};
        sample_pose(skeleton, {&clip, 1}, {&leaf, 1}, locals);
        local_to_model(skeleton, locals, got);
        const Transform wanted_root = to_transform(between(motion.root[0], motion.root[static_cast<std::size_t>(f)]));
        const Transform got_root = to_transform(shift * root_within(clip, time));
        const auto note = [&](std::size_t joint, const Transform& model) {
            const float error = vertex_distance(wanted_root * wanted[joint], got_root * model);
            if (error <= report.error) return;
            report.error = error;
            report.error_frame = f;
            report.error_joint = static_cast<int>(joint);
        };
        for (std::size_t j = 0; j < joints; ++j) note(j, got[j]);
        for (const Side side : {Side::left, Side::right})
            if (legs != nullptr && clip.feet[static_cast<std::size_t>(side)].known())
                note(static_cast<std::size_t>((*legs)[side].foot), foot_by_print(clip, side, time));
    }
    report.bytes = memory_size(clip);
    report.raw_bytes = motion.locals.size() * 40;
    return report;
}

}  // namespace surefoot
