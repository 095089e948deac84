#include <surefoot/clip/sample.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/pack/foot_prints.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_usual_duty = 0.6f;
constexpr float k_least_lift = 0.1f, k_most_lift = 0.9f;  // a stance outside is a mistake of the events

/// Share of each step's phase at which the foot leaves the ground: by the last toe-off in it.
std::vector<float> lifts(const PackedClip& clip, const ClipFacts& facts, Side side) {
    const float usual = facts.duty > 0 ? std::clamp(facts.duty, k_least_lift, k_most_lift) : k_usual_duty;
    std::vector<float> lift(static_cast<std::size_t>(clip.cycles), 0.0f);
    for (const PhaseEvent& event : facts.events) {
        if (event.kind != StrideEvent::toe_off || event.foot != side) continue;
        const float after = phase_at(clip, event.time) - strike_phase(side), step = std::floor(after);
        const float share = after - step;
        if (share < k_least_lift || share > k_most_lift) continue;
        const int at = (static_cast<int>(step) + clip.cycles) % clip.cycles;
        lift[static_cast<std::size_t>(at)] = std::max(lift[static_cast<std::size_t>(at)], share);
    }
    for (float& share : lift)
        if (share == 0) share = usual;
    return lift;
}

std::vector<FootStep> make_steps(const PackedClip& clip, const ClipFacts& facts, Side side) {
    std::vector<FootStep> steps;
    for (const float lift : lifts(clip, facts, side)) {
        const float strike = strike_phase(side) + static_cast<float>(steps.size()), from = unwrapped_time(clip, strike);
        steps.push_back({lift, unwrapped_time(clip, strike + lift) - from, unwrapped_time(clip, strike + 1) - from});
    }
    return steps;
}

/// The clip's keys for a side; its steps are known.
std::vector<FootKey> make_keys(const PackedClip& clip, const Skeleton& skeleton, const Leg& leg, Side side,
                               std::span<const Transform> locals) {
    const std::size_t joints = skeleton.rest.size();
    std::vector<Transform> models(joints);
    std::vector<FootKey> keys;
    for (int f = 0; f < clip.frame_count; ++f) {
        const std::span<const Transform> frame = locals.subspan(static_cast<std::size_t>(f) * joints, joints);
        local_to_model(skeleton, frame, models);
        FootKey key;
        key.age = foot_age_at(clip, side, static_cast<float>(f) / clip.fps);
        key.print = to_transform(integrate(clip.velocity, clip.turn_rate, key.age)) *
                    models[static_cast<std::size_t>(leg.foot)];
        if (leg.toes != k_no_joint) key.toes = frame[static_cast<std::size_t>(leg.toes)].rotation;
        // Keys of one hemisphere each may be mixed without looking at signs.
        if (!keys.empty()) {
            key.print.rotation = aligned(key.print.rotation, keys.back().print.rotation);
            key.toes = aligned(key.toes, keys.back().toes);
        }
        keys.push_back(key);
    }
    return keys;
}

}  // namespace

void add_foot_prints(PackedClip& clip, const Skeleton& skeleton, const Legs& legs, std::span<const Transform> locals,
                     const ClipFacts& facts) {
    for (const Side side : {Side::left, Side::right}) {
        FootPrints& foot = clip.feet[static_cast<std::size_t>(side)];
        if (clip.cycles > 0) foot.steps = make_steps(clip, facts, side);
        foot.keys = make_keys(clip, skeleton, legs[side], side, locals);
    }
}

}  // namespace surefoot
