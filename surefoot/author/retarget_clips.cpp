#include <surefoot/analysis/cycle_name.h>
#include <surefoot/analysis/measure.h>
#include <surefoot/author/retarget_clips.h>
#include <surefoot/host/parallel.h>
#include <surefoot/mannequin/mannequin.h>
#include <surefoot/motion/root_motion.h>

#include <algorithm>

namespace surefoot {
namespace {

float leg_length(const Legs& legs) { return 0.5f * (legs[Side::left].length() + legs[Side::right].length()); }

/// A name that tells the old speed tells the new one.
std::string renamed(const ClipFacts& before, float leg_before, const ClipFacts& now, float leg_now) {
    for (const bool airborne : {false, true})
        if (before.name == cycle_name(before, leg_before, airborne)) return cycle_name(now, leg_now, airborne);
    return before.name;
}

bool same_soles(const Legs& a, const Legs& b) {
    for (std::size_t s = 0; s < 2; ++s)
        if (a.side[s].ball != b.side[s].ball || a.side[s].heel != b.side[s].heel) return false;
    return true;
}

}  // namespace

Actor actor_of(const AnalyzedClip& clip) {
    const Legs legs = matched_soles(clip.motion, clip.roles.roles, clip.legs);
    Actor result{{clip.motion.skeleton, clip.roles.roles, legs, {}}, clip.roles, clip.source};
    const int frame = mannequin_bind_frame(clip.motion, clip.roles.roles);
    if (frame >= 0) {
        result.body.shape.resize(clip.motion.skeleton->rest.size());
        local_to_model(*clip.motion.skeleton, clip.motion.frame(frame), result.body.shape);
    }
    return result;
}

Actor actor_of(std::span<const AnalyzedClip* const> clips) {
    // What is no locomotion may sit, lie or fall: it comes last.
    const auto unrest = [](const AnalyzedClip* clip) {
        constexpr float k_never_flat = 100;  // [m/s]
        return std::fabs(clip->facts.speed) + (clip->facts.locomotion ? 0 : k_never_flat);
    };
    return actor_of(**std::min_element(clips.begin(), clips.end(),
                                       [&](const auto* a, const auto* b) { return unrest(a) < unrest(b); }));
}

Actor actor_in(std::span<const LoadedClip> clips, const RoleOverrides& overrides) {
    std::vector<AnalyzedClip> analyzed(clips.size());
    const auto same = [&](std::size_t i) { return *clips[i].motion.skeleton == *clips.front().motion.skeleton; };
    parallel_for(clips.size(), [&](std::size_t i) {
        if (same(i)) analyzed[i] = analyze_clip(clips[i].motion, clips[i].file, clips[i].unit_scale, overrides);
    });
    std::vector<const AnalyzedClip*> seen;
    for (std::size_t i = 0; i < clips.size(); ++i)
        if (same(i)) seen.push_back(&analyzed[i]);
    return actor_of(seen);
}

void bring_to_ground(Motion& motion, const RetargetBody& body, const Footing& footing) {
    const float floor =
        same_soles(footing.legs, body.legs) ? footing.floor : floor_under(motion, body.roles, body.legs);
    if (floor != 0) shift_pose(motion, body.roles, {0, -floor, 0});
}

AnalyzedClip retargeted(const AnalyzedClip& clip, const Actor& source, const Actor& target, RetargetReport* report) {
    AnalyzedClip result = clip;
    Motion grounded = clip.motion;
    bring_to_ground(grounded, source.body, {clip.legs, 0, false});
    result.motion = retarget(grounded, source.body, target.body, {}, report);
    result.roles = target.roles;
    result.legs = target.body.legs;
    ClipFacts& facts = result.facts;
    measure(result.motion, target.body.roles, target.body.legs, facts);
    facts.seam = clip.facts.seam;
    facts.seam_speed = clip.facts.seam_speed;
    facts.closing = clip.facts.closing;
    facts.name = renamed(clip.facts, leg_length(clip.legs), facts, leg_length(result.legs));
    return result;
}

}  // namespace surefoot
