#include <surefoot/clip/foot_keys.h>
#include <surefoot/clip/kernels.h>
#include <surefoot/clip/sample.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace surefoot {

namespace {

static_assert(sizeof(Transform) == 7 * sizeof(float), "kernels see a transform as qx qy qz qw tx ty tz");
static_assert(sizeof(Matrix34) == 12 * sizeof(float));
constexpr std::size_t k_transform_floats = 7;

/// The frames on either side of a time.
struct Keys {
    int from = 0;
    float share = 0;  ///< of the later frame
};
Keys keys_at(const PackedClip& clip, float time) noexcept {
    const float last = static_cast<float>(clip.frame_count - 1);
    const float frame = std::min(std::max(0.0f, time * clip.fps), last);  // in this order: what is no number is 0
    const int from = std::min(static_cast<int>(frame), clip.frame_count - 2);
    return {from, frame - static_cast<float>(from)};
}

// Translations that move: rest plus the weighted sum of each leaf's deviation from rest.
void add_translations(const Skeleton& skeleton, const PackedClip& clip, Keys keys, float weight,
                      std::span<Transform> locals) noexcept {
    const std::size_t count = clip.moving.size();
    const Vec3* from = clip.translations.data() + static_cast<std::size_t>(keys.from) * count;
    const Vec3* to = from + count;
    for (std::size_t i = 0; i < count; ++i) {
        const auto joint = static_cast<std::size_t>(clip.moving[i]);
        locals[joint].translation += weight * (lerp(from[i], to[i], keys.share) - skeleton.rest[joint].translation);
    }
}

/// Share of a clip's duration at a time.
float share_at(const PackedClip& clip, float time) noexcept { return time / clip.duration(); }

/// A leaf in the small form: its rotations go to `sums`, its translations to `locals`.
void add_curves(const ClipKernels& kernels, const Skeleton& skeleton, const PackedClip& clip, float time, float weight,
                float* sums, std::span<Transform> locals) noexcept {
    float values[k_most_curve_numbers];
    curve_values(clip.small.curves, share_at(clip, time), values);
    kernels.add_turns(values, clip.small.middle.data(), clip.joint_count, weight, sums);
    for (std::size_t i = 0; i < clip.moving.size(); ++i) {
        const auto joint = static_cast<std::size_t>(clip.moving[i]);
        const float* shift = values + shift_number(clip, i);
        const Vec3 at = clip.small.moving_middle[i] + Vec3{shift[0], shift[1], shift[2]};
        locals[joint].translation += weight * (at - skeleton.rest[joint].translation);
    }
}

/// Sums of the leaves in the small form: [block][x8 y8 z8 w8].
struct CurveSums {
    float rotations[k_most_curve_joints * 4];
};
static_assert(k_most_curve_joints % k_lanes == 0 && k_most_curve_joints * 3 <= k_most_curve_numbers);

void blend(const ClipKernels& kernels, const Skeleton& skeleton, std::span<const PackedClip> clips,
           std::span<const Leaf> leaves, float total, CurveSums* sums, std::span<Transform> locals) noexcept {
    KeyPair pairs[k_max_leaves];
    int count = 0;
    const auto add = [&](const Leaf& leaf) noexcept {
        const PackedClip& clip = clips[static_cast<std::size_t>(leaf.clip)];
        assert(clip.joint_count == skeleton.joint_count());
        const float weight = leaf.weight / total;
        if (!clip.small.empty()) return add_curves(kernels, skeleton, clip, leaf.time, weight, sums->rotations, locals);
        const Keys keys = keys_at(clip, leaf.time);
        const std::size_t frame = static_cast<std::size_t>(clip.block_count()) * 4 * k_lanes;
        const std::int16_t* from = clip.rotations.data() + static_cast<std::size_t>(keys.from) * frame;
        const int to_share = static_cast<int>(keys.share * static_cast<float>(k_whole_share) + 0.5f);
        pairs[count++] = {from,
                          from + frame,
                          clip.turning_blocks.empty() ? nullptr : clip.turning_blocks.data(),
                          k_whole_share - to_share,
                          to_share,
                          weight / static_cast<float>(k_whole_share)};
        add_translations(skeleton, clip, keys, weight, locals);
    };
    // What is taken off comes last: signs of joints that turn far are told by the sum so far (kernels_impl.h).
    for (const Leaf& leaf : leaves)
        if (leaf.weight >= 0) add(leaf);
    for (const Leaf& leaf : leaves)
        if (leaf.weight < 0) add(leaf);
    kernels.blend_rotations(pairs, count, sums != nullptr ? sums->rotations : nullptr, skeleton.joint_count(),
                            &locals[0].rotation.x, k_transform_floats);
}

void blend_with_curves(const ClipKernels& kernels, const Skeleton& skeleton, std::span<const PackedClip> clips,
                       std::span<const Leaf> leaves, float total, std::span<Transform> locals) noexcept {
    CurveSums sums;
    std::fill_n(sums.rotations, (skeleton.rest.size() + k_lanes - 1) / k_lanes * k_lanes * 4, 0.0f);
    blend(kernels, skeleton, clips, leaves, total, &sums, locals);
}

void sample_with(const ClipKernels& kernels, const Skeleton& skeleton, std::span<const PackedClip> clips,
                 std::span<const Leaf> leaves, std::span<Transform> locals) noexcept {
    const std::size_t joints = skeleton.rest.size();
    assert(!leaves.empty() && leaves.size() <= static_cast<std::size_t>(k_max_leaves) && locals.size() >= joints);
    float total = 0;
    bool curves = false;
    for (const Leaf& leaf : leaves) {
        total += leaf.weight;
        curves |= !clips[static_cast<std::size_t>(leaf.clip)].small.empty();
    }
    assert(total > 0);
    std::memcpy(static_cast<void*>(locals.data()), skeleton.rest.data(), joints * sizeof(Transform));
    if (curves)
        blend_with_curves(kernels, skeleton, clips, leaves, total, locals);
    else
        blend(kernels, skeleton, clips, leaves, total, nullptr, locals);
}

void models_with(const ClipKernels& kernels, const Skeleton& skeleton, const Transform* const (&locals)[k_lanes],
                 Matrix34* const (&models)[k_lanes], float* scratch) noexcept {
    const float* from[k_lanes];
    float* to[k_lanes];
    for (int c = 0; c < k_lanes; ++c) {
        from[c] = &locals[c]->rotation.x;
        to[c] = models[c]->m;
    }
    kernels.local_to_model(skeleton.parents.data(), skeleton.joint_count(), from, to, scratch);
}

/// a, n times after one another.
RootFrame repeated(RootFrame a, int n) noexcept {
    RootFrame result;
    for (; n > 0; n /= 2, a = a * a)
        if (n % 2 == 1) result = result * a;
    return result;
}

}  // namespace

void sample_pose(const Skeleton& skeleton, std::span<const PackedClip> clips, std::span<const Leaf> leaves,
                 std::span<Transform> locals) noexcept {
    sample_with(KernelBuilds<ClipKernels>::fastest(), skeleton, clips, leaves, locals);
}
void sample_pose_scalar(const Skeleton& skeleton, std::span<const PackedClip> clips, std::span<const Leaf> leaves,
                        std::span<Transform> locals) noexcept {
    sample_with(KernelBuilds<ClipKernels>::scalar, skeleton, clips, leaves, locals);
}

const char* kernels_name() noexcept { return KernelBuilds<ClipKernels>::fastest().name; }

void local_to_model_8(const Skeleton& skeleton, const Transform* const (&locals)[k_lanes],
                      Matrix34* const (&models)[k_lanes], float* scratch) noexcept {
    models_with(KernelBuilds<ClipKernels>::fastest(), skeleton, locals, models, scratch);
}
void local_to_model_8_scalar(const Skeleton& skeleton, const Transform* const (&locals)[k_lanes],
                             Matrix34* const (&models)[k_lanes], float* scratch) noexcept {
    models_with(KernelBuilds<ClipKernels>::scalar, skeleton, locals, models, scratch);
}

RootFrame integrate(Vec3 velocity, float turn_rate, float seconds) noexcept {
    const float angle = turn_rate * seconds;
    float along, across;  // of the mean direction: sin(t)/t and (1 - cos t)/t
    if (std::fabs(angle) < 0.05f) {
        const float square = angle * angle;
        along = 1.0f - square / 6.0f * (1.0f - square / 20.0f);
        across = 0.5f * angle * (1.0f - square / 12.0f * (1.0f - square / 30.0f));
    } else {
        const SinCos turn = sin_cos(static_cast<double>(angle));
        along = static_cast<float>(turn.sin) / angle;
        across = (1.0f - static_cast<float>(turn.cos)) / angle;
    }
    return {{seconds * (velocity.x * along + velocity.z * across), seconds * velocity.y,
             seconds * (velocity.z * along - velocity.x * across)},
            angle};
}

RootFrame root_within(const PackedClip& clip, float time) noexcept {
    if (clip.root.empty()) {
        const float within = std::min(std::max(0.0f, time), clip.duration());
        return integrate(clip.velocity, clip.turn_rate, within);
    }
    const Keys keys = keys_at(clip, time);
    const RootFrame& a = clip.root[static_cast<std::size_t>(keys.from)];
    const RootFrame& b = clip.root[static_cast<std::size_t>(keys.from) + 1];
    return {lerp(a.position, b.position, keys.share), a.yaw + (b.yaw - a.yaw) * keys.share};
}

RootFrame clip_root(const PackedClip& clip, float time) noexcept {
    const float duration = clip.duration();
    int passes = 0;
    if (clip.cyclic && duration > 0) {
        constexpr float k_most_passes = 1e6f;
        passes = static_cast<int>(std::min(std::max(-k_most_passes, std::floor(time / duration)), k_most_passes));
        time -= static_cast<float>(passes) * duration;
    }
    const RootFrame within = root_within(clip, time);
    if (passes == 0) return within;
    return repeated(passes > 0 ? clip.travel : between(clip.travel, RootFrame{}), passes > 0 ? passes : -passes) *
           within;
}

float phase_at(const PackedClip& clip, float time) noexcept {
    if (clip.phase_map.empty()) return 0;
    const float share = std::min(std::max(time / clip.duration(), 0.0f), 1.0f);
    std::size_t i = 1;
    while (i + 1 < clip.phase_map.size() && clip.phase_map[i][0] < share) ++i;
    const auto& a = clip.phase_map[i - 1];
    const auto& b = clip.phase_map[i];
    return a[1] + (share - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

PhaseTime phase_time(const PackedClip& clip, float phase) noexcept {
    if (clip.phase_map.empty()) return {};
    const float first = clip.phase_map.front()[1], cycles = static_cast<float>(clip.cycles);
    const float past = phase - first;
    phase -= std::floor(clip.cycles == 1 ? past : past / cycles) * cycles;  // called ten times a character and frame
    std::size_t i = 1;
    while (i + 1 < clip.phase_map.size() && clip.phase_map[i][1] < phase) ++i;
    const auto& a = clip.phase_map[i - 1];
    const auto& b = clip.phase_map[i];
    const float slope = (b[0] - a[0]) / (b[1] - a[1]) * clip.duration();
    const float time = a[0] * clip.duration() + (phase - a[1]) * slope;
    return {std::min(std::max(time, 0.0f), clip.duration()), slope};
}

float time_at(const PackedClip& clip, float phase) noexcept { return phase_time(clip, phase).time; }

float unwrapped_time(const PackedClip& clip, float phase) noexcept {
    const auto cycles = static_cast<float>(clip.cycles);
    const float passes = std::floor((phase - clip.phase_map.front()[1]) / cycles);
    return passes * clip.duration() + time_at(clip, phase);
}

namespace {

std::string problem_of_frames(const PackedClip& clip) {
    const auto frames = static_cast<std::size_t>(clip.frame_count);
    if (clip.rotations.size() != frames * static_cast<std::size_t>(clip.block_count()) * 4 * k_lanes)
        return "has rotations that do not match its frames and joints";
    if (!clip.turning_blocks.empty() && clip.turning_blocks.size() != static_cast<std::size_t>(clip.block_count()))
        return "has turning flags that do not match its joints";
    if (clip.translations.size() != frames * clip.moving.size()) return "has translations that do not match its frames";
    if (!clip.small.middle.empty() || !clip.small.moving_middle.empty()) return "has two forms";
    for (const FootPrints& foot : clip.feet)
        if (!foot.small.curves.empty() || foot.keys.empty() != clip.feet[0].keys.empty() ||
            (!foot.keys.empty() && foot.keys.size() != frames))
            return "has a footprint track that does not match its frames";
    return {};
}

std::string problem_of_curves(const PackedClip& clip) {
    const PoseCurves& small = clip.small;
    if (clip.joint_count > k_most_curve_joints) return "has curves for more than 512 joints";
    if (!clip.rotations.empty() || !clip.turning_blocks.empty() || !clip.translations.empty()) return "has two forms";
    if (small.middle.size() != static_cast<std::size_t>(clip.block_count()) * 4 * k_lanes ||
        small.moving_middle.size() != clip.moving.size() ||
        static_cast<std::size_t>(small.curves.number_count) != shift_number(clip, clip.moving.size()))
        return "has curves that do not match its joints";
    if (const std::string text = problem(small.curves); !text.empty()) return "has " + text;
    for (const FootPrints& foot : clip.feet) {
        if (!foot.keys.empty() || foot.known() != clip.feet[0].known() ||
            (foot.known() && foot.small.curves.number_count != k_foot_numbers))
            return "has footprint curves that do not match it";
        if (const std::string text = problem(foot.small.curves); !text.empty()) return "has " + text;
    }
    return {};
}

}  // namespace

std::size_t memory_size(const PackedClip& clip) noexcept {
    const auto size = [](const auto& values) noexcept { return values.size() * sizeof(values[0]); };
    std::size_t bytes = size(clip.rotations) + size(clip.translations) + size(clip.root) + size(clip.small.middle) +
                        size(clip.small.moving_middle) + memory_size(clip.small.curves);
    for (const FootPrints& foot : clip.feet) {
        bytes += size(foot.keys) + memory_size(foot.small.curves);
        if (!foot.small.curves.empty()) bytes += sizeof foot.small.middle;
    }
    return bytes;
}

std::string problem(const PackedClip& clip) {
    constexpr float k_least_fps = 0.01f, k_most_fps = 1e5f;
    const auto frames = static_cast<std::size_t>(clip.frame_count > 0 ? clip.frame_count : 0);
    const std::string where = "clip '" + clip.name + "' ";
    if (clip.frame_count < 2) return where + "has fewer than two frames";
    if (clip.joint_count < 1 || clip.joint_count > k_max_joints) return where + "has a wrong number of joints";
    if (!(clip.fps >= k_least_fps && clip.fps <= k_most_fps))
        return where + "has a frame rate that is not between 0.01 and 100000";
    if (const std::string text = clip.small.empty() ? problem_of_frames(clip) : problem_of_curves(clip); !text.empty())
        return where + text;
    for (std::size_t i = 0; i < clip.moving.size(); ++i)
        if (clip.moving[i] < (i > 0 ? clip.moving[i - 1] + 1 : 0) || clip.moving[i] >= clip.joint_count)
            return where + "names moving joints out of order";
    if (clip.root.size() != frames && !(clip.root.empty() && !clip.small.empty()))
        return where + "has a root track that does not match its frames";
    for (const FootPrints& foot : clip.feet) {
        if (foot.known() && foot.steps.size() != static_cast<std::size_t>(clip.cycles))
            return where + "has foot steps that do not match its cycles";
        for (const FootStep& step : foot.steps)
            if (!(step.lift > 0 && step.lift < 1 && step.stance > 0 && step.duration > step.stance))
                return where + "has a step without stance or swing";
    }
    const auto& map = clip.phase_map;
    if (map.empty() != (clip.cycles == 0)) return where + "has a phase map and a cycle count that disagree";
    if (map.empty()) return {};
    if (map.size() < 2 || clip.cycles < 1 || map.front()[0] != 0 || map.back()[0] != 1 || map.front()[1] < 0 ||
        map.front()[1] >= 1 || std::fabs(map.back()[1] - map.front()[1] - static_cast<float>(clip.cycles)) > 1e-4f)
        return where + "has a phase map that does not span its cycles";
    for (std::size_t i = 1; i < map.size(); ++i)
        if (!(map[i][0] > map[i - 1][0] && map[i][1] > map[i - 1][1]))
            return where + "has a phase map that does not ascend";
    return {};
}

namespace {

Quat turned(Quat middle, const float* turn) noexcept {
    const Vec3 v{turn[0], turn[1], turn[2]};
    return middle * Quat{v.x, v.y, v.z, std::sqrt(std::max(1 - dot(v, v), 0.0f))};
}

}  // namespace

float foot_age_at(const PackedClip& clip, Side side, float time) noexcept {
    const std::vector<FootStep>& steps = clip.feet[static_cast<std::size_t>(side)].steps;
    if (steps.empty()) return 0;
    const float after = phase_at(clip, time) - strike_phase(side), whole = std::floor(after);
    const std::size_t at = static_cast<std::size_t>(static_cast<int>(whole) + clip.cycles) % steps.size();
    const float strike = strike_phase(side) + whole;
    const float elapsed = unwrapped_time(clip, strike + after - whole) - unwrapped_time(clip, strike);
    return foot_age(steps[at], steps[(at + 1) % steps.size()], elapsed);
}

FootKeyPlace foot_key_place(const PackedClip& clip, Side side, float time, FootKey& made) noexcept {
    const FootPrints& track = clip.feet[static_cast<std::size_t>(side)];
    if (track.keys.empty()) {
        float values[k_foot_numbers];
        curve_values(track.small.curves, share_at(clip, time), values);
        const FootKey& middle = track.small.middle;
        made = {
            {turned(middle.print.rotation, values), middle.print.translation + Vec3{values[3], values[4], values[5]}},
            turned(middle.toes, values + 6),
            foot_age_at(clip, side, std::min(std::max(0.0f, time), clip.duration()))};
        return {&made, &made, 0};
    }
    const Keys keys = keys_at(clip, time);
    const FootKey* from = track.keys.data() + static_cast<std::size_t>(keys.from);
    return {from, from + 1, keys.share};
}

FootKey foot_key_at(const PackedClip& clip, Side side, float time) noexcept {
    FootKey made;
    const FootKeyPlace place = foot_key_place(clip, side, time, made);
    if (place.from == &made) return made;
    const FootKey &a = *place.from, &b = *place.to;
    return {{nlerp(a.print.rotation, b.print.rotation, place.share),
             lerp(a.print.translation, b.print.translation, place.share)},
            nlerp(a.toes, b.toes, place.share),
            a.age + (b.age - a.age) * place.share};
}

}  // namespace surefoot
