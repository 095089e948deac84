// Rules about one clip alone, wherever it stands.

#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

Finding about(const char* rule, const ProjectClip& clip, std::string message, const char* kind, std::string remedy) {
    Finding finding;
    finding.rule = rule;
    finding.clips = {clip.name};
    finding.message = std::move(message);
    finding.fix = Fix{kind, std::move(remedy), {}, {}, {clip.name}};
    return finding;
}

}  // namespace

void lint_clip(LintContext& context, const ProjectClip& clip) {
    const ClipFacts& facts = clip.facts;
    const bool travels = std::fabs(facts.speed) >= k_standing_speed;
    const bool has_strike = std::any_of(facts.events.begin(), facts.events.end(),
                                        [](const PhaseEvent& e) { return e.kind == StrideEvent::strike; });
    if (travels && facts.cyclic && !has_strike)
        context.add(about("phase-mismatch", clip,
                          fmt::format("\"{}\" travels but no foot strike was found in it: blended with others it falls "
                                      "out of step, and the legs cross.",
                                      clip.name),
                          "remove", "leave the clip out, or check its roles and its ground"));

    // A closed cycle has no seam left: what it was before closing is in its facts, but nobody sees it any more. (Its
    // speed there still differs from one frame to the next, as it does at any foot strike.)
    constexpr float k_closed = 1e-3f;  // [m]
    const double seam_cm = 100.0 * facts.loop_error;
    const double jolt_cm = facts.loop_error > k_closed ? 100.0 * facts.seam_speed : 0;
    if (facts.cyclic &&
        (seam_cm > context.threshold("loop-pop", "seam") || jolt_cm > context.threshold("loop-pop", "speed")))
        context.add(about("loop-pop", clip,
                          fmt::format("\"{}\" jumps by {:.1f} cm and {:.0f} cm/s each time it starts over.", clip.name,
                                      seam_cm, jolt_cm),
                          "close-loop", "close the loop, or cut the clip at a better place"));

    const double skate_cm = 100.0 * facts.skate;
    if (skate_cm > context.threshold("skating-clip", "skate"))
        context.add(about("skating-clip", clip,
                          fmt::format("In \"{}\" itself planted feet slide at {:.0f} cm/s; blending cannot mend that.",
                                      clip.name, skate_cm),
                          "remove", "clean the clip, or replace it"));

    if (!facts.in_place && travels) {
        const double share = 100.0 * facts.root_disagreement_speed / std::fabs(facts.speed);
        if (share > context.threshold("root-disagrees", "speed") ||
            std::fabs(facts.root_disagreement_turn) > context.threshold("root-disagrees", "turn"))
            context.add(about(
                "root-disagrees", clip,
                fmt::format("The root of \"{}\" and its planted feet disagree by {:.2f} m/s ({:.0f} %) and "
                            "{:.0f} deg/s: the feet slide by that much.",
                            clip.name, facts.root_disagreement_speed, share, std::fabs(facts.root_disagreement_turn)),
                "remove", "export the clip again with its true root motion"));
    }
    if (facts.hip_height > 0 && (facts.hip_height < context.threshold("unit-suspect", "low") ||
                                 facts.hip_height > context.threshold("unit-suspect", "high")))
        context.add(about("unit-suspect", clip,
                          fmt::format("In \"{}\" the hips are {:.2f} m above the ground: no person is that size, so "
                                      "speeds and steps are likely off by the same factor.",
                                      clip.name, facts.hip_height),
                          "rescale", "give the file's unit with --unit-scale"));
}

}  // namespace surefoot
