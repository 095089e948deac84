#include "fit_clips.h"

#include "gait_clips.h"

#include <surefoot/analysis/measure.h>
#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>
#include <surefoot/motion/edit.h>

#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <optional>

namespace surefoot::cli {
namespace {

std::vector<LoadedClip> load(const FitInput& input) {
    LoadResult loaded = load_clips_and_gaits(input.in);
    for (const LoadFailure& failure : loaded.failed) fmt::print(stderr, "surefoot: {}\n", failure.error);
    if (loaded.clips.empty()) throw Error("there are no clips to fit", "fit", "give .bvh, .glb, .gltf or .fbx files");
    return std::move(loaded.clips);
}

/// Calls `work(i)` for each clip at once; what it throws is told, in order.
void for_each_clip(std::size_t count, const std::function<void(std::size_t)>& work) {
    std::vector<std::string> failed(count);
    parallel_for(count, [&](std::size_t i) {
        try {
            work(i);
        } catch (const Error& error) {
            failed[i] = error.what();
        }
    });
    for (const std::string& text : failed)
        if (!text.empty()) fmt::print(stderr, "surefoot: {}\n", text);
}

std::vector<AnalyzedClip> analyzed(const FitInput& input) {
    std::vector<LoadedClip> clips = load(input);
    const RoleOverrides roles = parse_roles(input.roles, "--roles");
    std::vector<std::optional<AnalyzedClip>> takes(clips.size());
    for_each_clip(clips.size(), [&](std::size_t i) {
        takes[i] = analyze_clip(std::move(clips[i].motion), clips[i].file, clips[i].unit_scale, roles);
    });
    std::vector<AnalyzedClip> result;
    for (std::optional<AnalyzedClip>& take : takes)
        if (take) result.push_back(std::move(*take));
    return result;
}

/// A take whose ends happen to meet is a cycle of several strides, each a little different: fitted as one they blur.
/// What steps more than once is looked through for single cycles, and stays whole where it holds none.
std::vector<AnalyzedClip> find_single(const FindCycles& find, const AnalyzedClip& clip) {
    const float strides = clip.facts.cadence * clip.facts.duration / 120;
    if (clip.facts.cyclic && strides > 1.5f) {
        AnalyzedClip take = clip;
        take.facts.cyclic = take.motion.cyclic = false;
        if (std::vector<AnalyzedClip> found = find(take); !found.empty()) return found;
    }
    return find(clip);
}

AnalyzedClip on_target(const AnalyzedClip& clip, const Actor& source, const Actor& target) {
    AnalyzedClip result = retargeted(clip, source, target);
    for (const Role role : {Role::left_shoulder, Role::right_shoulder})
        if (target.body.roles.has(role)) untwist(result.motion, target.body.roles[role]);
    return result;
}

AnalyzedClip played_backwards(AnalyzedClip clip) {
    clip.motion = reverse(clip.motion);
    start_at_origin(clip.motion);
    measure(clip.motion, clip.roles.roles, clip.legs, clip.facts);
    return clip;
}

bool is_usable(const AnalyzedClip& clip) {
    const bool stands = clip.facts.locomotion && std::fabs(clip.facts.speed) < 0.02f;
    return clip.facts.cyclic && (clip.facts.cadence > 0 || stands);
}

}  // namespace

std::vector<AnalyzedClip> cycles_to_fit(const FitInput& input, const FindCycles& find) {
    const std::vector<AnalyzedClip> takes = analyzed(input);
    std::optional<Actor> source, target;
    if (!input.to.empty() && !takes.empty()) {
        target = read_actor(input.to);
        std::vector<const AnalyzedClip*> seen;
        for (const AnalyzedClip& take : takes) {
            if (!(*take.motion.skeleton == *takes.front().motion.skeleton))
                throw Error("it moves another skeleton than the first clip", take.source,
                            "put one character's clips at a time onto another");
            seen.push_back(&take);
        }
        source = actor_of(seen);
    }
    std::vector<std::vector<AnalyzedClip>> found(takes.size());
    for_each_clip(takes.size(), [&](std::size_t i) {
        for (AnalyzedClip& clip : find_single(find, takes[i])) {
            if (!is_usable(clip)) continue;
            if (target) clip = on_target(clip, *source, *target);
            if (input.reverse) clip = played_backwards(std::move(clip));
            found[i].push_back(std::move(clip));
        }
    });
    std::vector<AnalyzedClip> cycles;
    for (std::vector<AnalyzedClip>& clips : found)
        cycles.insert(cycles.end(), std::make_move_iterator(clips.begin()), std::make_move_iterator(clips.end()));
    if (cycles.empty())
        throw Error("no cycle of steps was found", input.in.front(), "see what the clips hold: surefoot analyze");
    return cycles;
}

}  // namespace surefoot::cli
