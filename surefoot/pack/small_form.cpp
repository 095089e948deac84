#include <surefoot/pack/fit_curves.h>
#include <surefoot/pack/joint_track.h>
#include <surefoot/pack/pack_clip.h>
#include <surefoot/pack/small_form.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot {

namespace {

/// Numbers of a clip, frame by frame, and how far in model space a unit of each moves something.
struct Track {
    int number = 0;
    std::vector<double> values;
    double reach = 0;
};
using Tracks = std::vector<Track>;

/// Rotations as seen from one in their middle, and that.
struct Turns {
    Quat middle;
    std::array<std::vector<double>, 3> xyz;
    bool far = false;  ///< some are too far from the middle for x, y and z to tell them well
};

Vec3 middle_of(std::span<const Vec3> values) {
    Vec3 low = values.front(), high = low;
    for (const Vec3 v : values) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    return 0.5f * (low + high);
}

Vec3 vector_part(Quat q) { return {q.x, q.y, q.z}; }

Quat rounded(Quat q) {
    const auto round = [](float x) { return std::round(x * k_rotation_scale) / k_rotation_scale; };
    return {round(q.x), round(q.y), round(q.z), round(q.w)};
}

/// `rotations` are continuous. The middle is rounded to 16 bits where it will be kept in them.
Turns turns_of(std::span<const Quat> rotations, bool round_middle) {
    Quat middle = rotations.front();
    const auto turn = [&](Quat q) { return normalized(conjugate(middle) * q); };
    for (int round = 0; round < 4; ++round) {  // the middle of the range as seen from the one before
        std::vector<Vec3> seen;
        for (const Quat q : rotations) seen.push_back(vector_part(aligned(turn(q), {})));
        const Vec3 v = middle_of(seen);
        middle = normalized(middle * Quat{v.x, v.y, v.z, std::sqrt(std::max(1 - dot(v, v), 0.01f))});
    }
    if (round_middle) middle = rounded(middle);
    constexpr float k_least_w = 0.5f;  // 120 degrees
    Turns turns{middle, {}, false};
    for (const Quat q : rotations) {
        const Quat t = turn(q);
        turns.far |= t.w < k_least_w;
        const float xyz[3] = {t.x, t.y, t.z};
        for (std::size_t c = 0; c < 3; ++c) turns.xyz[c].push_back(static_cast<double>(xyz[c]));
    }
    return turns;
}

/// [m] to the farthest vertex that each joint moves, about.
std::vector<float> reaches(const Skeleton& skeleton, std::span<const Transform> first_frame) {
    std::vector<float> reach(skeleton.rest.size(), k_virtual_vertex_distance);
    for (std::size_t j = reach.size(); j-- > 0;)
        if (skeleton.parents[j] >= 0) {
            float& up = reach[static_cast<std::size_t>(skeleton.parents[j])];
            up = std::max(up, reach[j] + length(first_frame[j].translation));
        }
    return reach;
}

void add_turns(Tracks& tracks, const Turns& turns, int first, int stride, float reach) {
    for (int c = 0; c < 3; ++c)
        tracks.push_back(
            {first + c * stride, turns.xyz[static_cast<std::size_t>(c)], 2.0 * static_cast<double>(reach)});
}

void add_shifts(Tracks& tracks, std::span<const Vec3> places, Vec3 middle, int first, double reach) {
    std::array<std::vector<double>, 3> xyz;
    for (const Vec3 place : places) {
        const Vec3 shift = place - middle;
        const float values[3] = {shift.x, shift.y, shift.z};
        for (std::size_t c = 0; c < 3; ++c) xyz[c].push_back(static_cast<double>(values[c]));
    }
    for (int c = 0; c < 3; ++c) tracks.push_back({first + c, std::move(xyz[static_cast<std::size_t>(c)]), reach});
}

/// Poses but for their curves; the numbers that these shall give go to `tracks`. False where a joint turns too far.
bool pose_tracks(PackedClip& clip, const Skeleton& skeleton, std::span<const Transform> locals, Tracks& tracks) {
    const std::size_t joints = skeleton.rest.size();
    const std::vector<float> reach = reaches(skeleton, locals.first(joints));
    std::vector<std::int16_t> middles(static_cast<std::size_t>(clip.block_count()) * 4 * k_lanes, 0);
    for (std::size_t j = 0; j < middles.size() / 4; ++j) {
        Quat middle;
        if (j < joints) {
            const Turns turns = turns_of(joint_track(locals, joints, j, skeleton.rest[j].rotation).rotations, true);
            if (turns.far || dot(turns.middle, skeleton.rest[j].rotation) < 0) return false;
            middle = turns.middle;
            add_turns(tracks, turns, static_cast<int>(turn_number(static_cast<int>(j))), k_lanes, reach[j]);
        }
        put_rotation(middles.data(), j, middle);
    }
    clip.small.middle = std::move(middles);
    for (std::size_t i = 0; i < clip.moving.size(); ++i) {
        std::vector<Vec3> places;
        for (std::size_t at = static_cast<std::size_t>(clip.moving[i]); at < locals.size(); at += joints)
            places.push_back(locals[at].translation);
        clip.small.moving_middle.push_back(middle_of(places));
        add_shifts(tracks, places, clip.small.moving_middle.back(), static_cast<int>(shift_number(clip, i)), 1);
    }
    return true;
}

/// The same for a foot.
bool foot_tracks(FootPrints& foot, Tracks& tracks) {
    // Nothing but the foot hangs on a print, while errors of joints add up along a limb: it may be coarser.
    constexpr float k_coarser = 0.6f, k_foot = k_coarser * 0.25f, k_toes = k_coarser * 0.1f;  // [m]
    std::vector<Quat> prints, toes;
    std::vector<Vec3> places;
    for (const FootKey& key : foot.keys) {
        prints.push_back(key.print.rotation);
        places.push_back(key.print.translation);
        toes.push_back(key.toes);
    }
    const Turns print = turns_of(prints, false), toe = turns_of(toes, false);
    foot.small.middle = {{print.middle, middle_of(places)}, toe.middle, 0};
    add_turns(tracks, print, 0, 1, k_foot);
    add_shifts(tracks, places, foot.small.middle.print.translation, 3, static_cast<double>(k_coarser));
    add_turns(tracks, toe, 6, 1, k_toes);
    return !print.far && !toe.far;
}

/// Whether the clip's end runs on into its beginning, so nearly that nobody sees the rest of the limit go.
bool is_closed(const Tracks& tracks, float limit) {
    return std::all_of(tracks.begin(), tracks.end(), [&](const Track& track) {
        return std::fabs(track.values.front() - track.values.back()) * track.reach < 0.1 * static_cast<double>(limit);
    });
}

CurveFitter fitter_of(const PackedClip& clip, const Tracks& tracks, float limit, float finest) {
    CurveFitter fitter(clip.frame_count, clip.cyclic && is_closed(tracks, limit), finest);
    for (const Track& track : tracks) fitter.add(track.number, track.values, track.reach);
    return fitter;
}

}  // namespace

std::optional<PackedClip> small_form(const PackedClip& clip, const Skeleton& skeleton,
                                     std::span<const Transform> locals, float limit, const MeasureClip& measure) {
    constexpr int k_least_frames = 4;
    PackedClip small = clip;
    if (clip.frame_count < k_least_frames || clip.joint_count > k_most_curve_joints || !clip.turning_blocks.empty() ||
        shift_number(clip, clip.moving.size()) > static_cast<std::size_t>(k_most_curve_numbers))
        return std::nullopt;
    small.rotations = {}, small.translations = {};
    Tracks pose;
    if (!pose_tracks(small, skeleton, locals, pose)) return std::nullopt;
    // One tolerance serves all numbers, each by how far it reaches. Errors add up along a limb, so the one that meets
    // the limit is looked for.
    constexpr int k_rounds = 9;
    float low = limit / 64, high = 2 * limit;
    const CurveFitter of_pose = fitter_of(clip, pose, limit, low);
    std::vector<CurveFitter> of_feet;
    for (FootPrints& foot : small.feet) {
        if (foot.keys.empty()) continue;
        Tracks tracks;
        if (!foot_tracks(foot, tracks)) return std::nullopt;
        of_feet.push_back(fitter_of(clip, tracks, limit, low));
        foot.keys = {};
    }
    const auto with = [&](float tolerance) {
        small.small.curves = of_pose.curves(tolerance, static_cast<int>(shift_number(clip, clip.moving.size())));
        for (std::size_t side = 0; side < of_feet.size(); ++side)
            small.feet[side].small.curves = of_feet[side].curves(tolerance, k_foot_numbers);
        return small;
    };
    std::optional<PackedClip> best;
    for (int round = 0; round <= k_rounds; ++round) {
        const float tolerance = round == 0 ? low : std::sqrt(low * high);
        PackedClip tried = with(tolerance);
        const bool fine = measure(tried) <= limit;
        if (!fine && round == 0) return std::nullopt;
        (fine ? low : high) = tolerance;
        if (fine) best = std::move(tried);
    }
    return best;
}

}  // namespace surefoot
