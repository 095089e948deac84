#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/cycle_name.h>
#include <surefoot/analysis/cycle_search.h>
#include <surefoot/analysis/locomotion.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace surefoot {
namespace {

constexpr float k_most_added = 0.02f;  // [m] a joint may be displaced by closing (DESIGN §5)

/// A steady root path that runs, on average, under the body: the take's own low-passed root, straightened.
std::vector<RootFrame> cycle_path(const Motion& part, const RootFrame& step) {
    const int n = part.frame_count();
    RootFrame start = part.root.front();
    start.position.y = 0;
    for (int round = 0; round < 3; ++round) {  // moving the start moves the whole path; converges at once when straight
        const std::vector<RootFrame> path = steady_path(start, step, n);
        Vec3 offset;
        float yaw = 0;
        for (int f = 0; f < n; ++f) {
            const RootFrame off = between(path[static_cast<std::size_t>(f)], part.root[static_cast<std::size_t>(f)]);
            offset += off.position / static_cast<float>(n);
            yaw += off.yaw / static_cast<float>(n);
        }
        start = start * RootFrame{{offset.x, 0, offset.z}, yaw};
    }
    return steady_path(start, step, n);
}

AnalyzedClip measured_cycle(const AnalyzedClip& take, Motion motion, const LoopClosing& closing, int first, int last) {
    AnalyzedClip cycle;
    cycle.roles = take.roles;
    cycle.legs = take.legs;
    cycle.source = take.source;
    cycle.source_first = take.source_first + first;
    cycle.source_last = take.source_first + last;
    cycle.motion = std::move(motion);
    ClipFacts& facts = cycle.facts;
    facts.file = take.facts.file;
    facts.unit_scale = take.facts.unit_scale;
    facts.in_place = take.facts.in_place;
    const Measured measured = measure(cycle.motion, take.roles.roles, take.legs, facts);
    facts.seam = closing.seam;
    facts.seam_speed = closing.seam_speed;
    facts.closing = closing.added;
    facts.height = take.facts.height;
    const float leg = 0.5f * (take.legs[Side::left].length() + take.legs[Side::right].length());
    const BodyFeatures body = body_features(measured, facts, leg);
    facts.not_locomotion = why_not_locomotion(body, facts, leg);
    facts.locomotion = facts.not_locomotion.empty();
    // Flight alone does not tell a run: a flicker of contacts looks like it, and slow jogs have next to none. The hips
    // do.
    const bool runs = body.vault < 0 && facts.cadence > 0 && (facts.duty < 0.6f || body.airborne > 0.03f);
    facts.name = cycle.motion.name = cycle_name(facts, leg, runs);
    return cycle;
}

/// Velocities are led into each other as well where that leaves every joint within the bound.
LoopClosing close_gently(Motion& part) {
    LoopOptions options;
    options.fit_step = false;
    Motion smooth = part;
    const LoopClosing closing = close_loop(smooth, options);
    if (closing.added <= k_most_added) {
        part = std::move(smooth);
        return closing;
    }
    options.velocity_width = 0;
    return close_loop(part, options);
}

AnalyzedClip cut_cycle(const AnalyzedClip& take, const CycleCandidate& c) {
    Motion part = cut(take.motion, c.first, c.last);
    RootFrame step = c.step;
    const bool climbs = std::fabs(take.motion.root.back().position.y - take.motion.root.front().position.y) > 0.1f;
    if (!climbs) step.position.y = 0;
    set_root_frames(part, cycle_path(part, step));
    fold_dedicated_root(part, take.roles.roles);
    const LoopClosing closing = close_gently(part);
    if (!c.idle) part = rotate_cycle(part, c.strike - c.first);
    start_at_origin(part);
    return measured_cycle(take, std::move(part), closing, c.first, c.last);
}

/// From one left strike to the next, if exactly one right one lies between; `strike` of the result is its first frame.
std::optional<CycleCandidate> stride_between(const AnalyzedClip& take, const PhaseEvent& from, const PhaseEvent& to) {
    constexpr float k_shortest = 0.35f, k_longest = 2.4f;  // [s]
    if (to.time - from.time < k_shortest || to.time - from.time > k_longest) return {};
    const auto rights = std::count_if(take.facts.events.begin(), take.facts.events.end(), [&](const PhaseEvent& e) {
        return e.kind == StrideEvent::strike && e.foot == Side::right && e.time > from.time && e.time < to.time;
    });
    if (rights != 1) return {};
    CycleCandidate stride;
    stride.first = stride.strike = static_cast<int>(from.time * take.motion.fps + 0.5f);
    stride.last = std::min(static_cast<int>(to.time * take.motion.fps + 0.5f), take.motion.frame_count() - 1);
    const RootFrame& first = take.motion.root[static_cast<std::size_t>(stride.first)];
    stride.step = take.motion.root[static_cast<std::size_t>(stride.last)] * between(first, RootFrame{});
    return stride;
}

/// "walk_1.40mps", "walk_1.40mps_2", …
void make_names_unique(std::vector<AnalyzedClip>& cycles) {
    std::set<std::string> taken;
    for (AnalyzedClip& cycle : cycles) {
        std::string name = cycle.facts.name;
        for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}_{}", cycle.facts.name, k);
        cycle.facts.name = cycle.motion.name = name;
    }
}

}  // namespace

std::vector<AnalyzedClip> find_cycles(const AnalyzedClip& take) {
    std::vector<AnalyzedClip> cycles;
    if (take.motion.cyclic) {
        if (!take.facts.locomotion) return cycles;
        Motion whole = take.motion;
        const std::string name = whole.name;
        const LoopClosing closing = close_loop(whole);
        cycles.push_back(measured_cycle(take, std::move(whole), closing, 0, take.motion.frame_count() - 1));
        cycles.back().facts.name = cycles.back().motion.name = name;
        return cycles;
    }
    if (take.motion.frame_count() < 4) return cycles;
    const KeyPoses poses = key_poses(take.motion, take.roles.roles);
    for (const CycleCandidate& c : best_distinct(cycle_candidates(take, poses))) {
        AnalyzedClip cycle = cut_cycle(take, c);
        const int strikes =
            static_cast<int>(std::count_if(cycle.facts.events.begin(), cycle.facts.events.end(),
                                           [](const PhaseEvent& event) { return event.kind == StrideEvent::strike; }));
        if (!cycle.facts.locomotion || cycle.facts.closing > k_most_added || (!c.idle && strikes < 2)) continue;
        cycles.push_back(std::move(cycle));
    }
    make_names_unique(cycles);
    return cycles;
}

std::vector<AnalyzedClip> find_strides(const AnalyzedClip& take, float most_closing) {
    if (take.motion.cyclic) return {take};
    std::vector<PhaseEvent> lefts;
    for (const PhaseEvent& event : take.facts.events)
        if (event.kind == StrideEvent::strike && event.foot == Side::left) lefts.push_back(event);
    std::vector<AnalyzedClip> strides;
    for (std::size_t i = 0; i + 1 < lefts.size(); ++i) {
        const std::optional<CycleCandidate> stride = stride_between(take, lefts[i], lefts[i + 1]);
        if (!stride) continue;
        AnalyzedClip cycle = cut_cycle(take, *stride);
        if (cycle.facts.locomotion && cycle.facts.closing <= most_closing) strides.push_back(std::move(cycle));
    }
    make_names_unique(strides);
    return strides;
}

}  // namespace surefoot
