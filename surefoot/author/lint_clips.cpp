// Rules about one clip alone, wherever it stands.

#include <surefoot/analysis/strikes.h>
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

/// What keeps a clip's steps from being matched with those of others.
std::string what_steps(const ClipFacts& facts) {
    int strikes[2] = {0, 0};
    for (const PhaseEvent& event : facts.events)
        if (event.kind == StrideEvent::strike) ++strikes[static_cast<std::size_t>(event.foot)];
    if (strikes[0] + strikes[1] == 0) return "no foot strike was found in it";
    if (strikes[0] != strikes[1])
        return fmt::format("its left foot strikes {} and its right foot {} times a loop", strikes[0], strikes[1]);
    return "its left and right foot do not strike in turn";
}

}  // namespace

void lint_clip(LintContext& context, const ProjectClip& clip) {
    const ClipFacts& facts = clip.facts;
    const bool travels = std::fabs(facts.speed) >= k_standing_speed, moves = !is_idle(facts);
    if (moves && facts.cyclic && alternating_strikes(facts.events, facts.duration, facts.fps).empty())
        context.add(about("phase-mismatch", clip,
                          fmt::format("\"{}\" {} but {}: blended with others it falls out of step, and the legs cross.",
                                      clip.name, travels ? "travels" : "turns", what_steps(facts)),
                          "remove", "leave the clip out, cut it to whole strides, or check its roles and its ground"));

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
                          fmt::format("In \"{}\" itself planted feet slide at {:.1f} cm/s; blending cannot mend that.",
                                      clip.name, skate_cm),
                          "remove", "clean the clip, or replace it"));

    if (!facts.in_place && moves) {
        const double share = travels ? 100.0 * facts.root_disagreement_speed / std::fabs(facts.speed) : 0;
        const double turn = std::fabs(facts.root_disagreement_turn);
        if (share > context.threshold("root-disagrees", "speed") || turn > context.threshold("root-disagrees", "turn"))
            context.add(
                about("root-disagrees", clip,
                      fmt::format("The root of \"{}\" and its planted feet disagree by {:.2f} m/s ({:.0f} %) and "
                                  "{:.0f} deg/s: the feet slide by that much.",
                                  clip.name, facts.root_disagreement_speed, share, turn),
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
