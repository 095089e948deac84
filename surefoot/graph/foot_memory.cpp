#include <surefoot/graph/blended_feet.h>
#include <surefoot/graph/foot_memory.h>

namespace surefoot {
namespace {

constexpr float k_swing_to_return = 0.95f;  // share of a swing, that it comes down already held
constexpr float k_fastest_return = 2.0f;    // [m/s] of a swinging foot to where the blend has it
constexpr float k_astray = 0.5f;            // soles' lengths
constexpr float k_twist_as_offset = 1.2f;   // soles' lengths a radian
constexpr float k_side_by_side = 0.2f;      // soles' lengths
constexpr float k_least_pace = 1e-3f;       // [m/s]
constexpr float k_least_turn = 1e-3f;       // [rad/s]
constexpr float k_drift_seconds = 0.1f;
constexpr float k_foresight = 0.2f;  // [s] for which changes are taken to go on after a strike
constexpr float k_settle_seconds = 0.45f;
constexpr float k_stopping = 0.3f;  // share of the blend that still steps, from which a stop is as good as done

constexpr float k_fastest_untwist = 6.0f;  // [rad/s]

bool is_same(const FootMemory& was, const FootBlend& is) noexcept {
    if (was.count != is.leaves.size() || was.turn != is.turn || !(was.velocity == is.velocity)) return false;
    for (std::size_t i = 0; i < was.count; ++i)
        if (was.leaf[i].clip != is.leaves[i].clip || was.leaf[i].weight != is.leaves[i].weight) return false;
    return true;
}

void remember(const FootBlend& blend, FootMemory& memory) noexcept {
    memory.count = blend.leaves.size() <= FootMemory::k_most ? static_cast<std::uint32_t>(blend.leaves.size()) : 0;
    memory.leaf = {};
    std::copy_n(blend.leaves.begin(), memory.count, memory.leaf.begin());
    memory.velocity = blend.velocity;
    memory.turn = blend.turn;
}

bool steps(const PackedClip& clip) noexcept { return clip.cycles > 0; }

/// How much of a blend steps.
float stepping_share(std::span<const PackedClip> clips, std::span<const Leaf> leaves) noexcept {
    float stepping = 0, all = 0;
    for (const Leaf& leaf : leaves) {
        const float weight = std::fabs(leaf.weight);
        all += weight;
        if (steps(clips[static_cast<std::size_t>(leaf.clip)])) stepping += weight;
    }
    return all > 0 ? stepping / all : 0.0f;
}

/// Clips without steps have their own time, which has gone on; their feet are to be seen at one moment.
void take_times(std::span<const Leaf> from, std::span<Leaf> to) noexcept {
    for (Leaf& leaf : to)
        for (const Leaf& same : from)
            if (same.clip == leaf.clip) leaf.time = same.time;
}

/// What a foot bears on, heel or ball, from its ankle; and where its sole points.
struct Bearing {
    Vec3 from_ankle;
    float yaw;
};
Bearing bearing_of(const LegPaths::Side& leg, const Transform& foot, bool on_heel) noexcept {
    const Vec3 heel = rotate(foot.rotation, leg.heel), ball = rotate(foot.rotation, leg.ball), sole = ball - heel;
    return {on_heel ? heel : ball, atan2(sole.x, sole.z)};
}

/// Holds the foot so that heel or ball, whichever it bears on, stays where the old blend, held as it was, had it.
void take_up(const LegPaths::Side& leg, const Transform& was, const Transform& is, FootOffset& hold) noexcept {
    const bool on_heel = rotate(is.rotation, leg.heel).y < rotate(is.rotation, leg.ball).y;
    const Bearing before = bearing_of(leg, was, on_heel), after = bearing_of(leg, is, on_heel);
    const float yaw = hold.yaw + wrap_angle(before.yaw - after.yaw);
    const Vec3 stood = was.translation + rotate(from_yaw(hold.yaw), before.from_ankle),
               stands = is.translation + rotate(from_yaw(yaw), after.from_ankle);
    hold = {hold.x + stood.x - stands.x, hold.z + stood.z - stands.z, yaw, hold.step};
}

/// Both feet by both blends, as they were before this step.
void take_up_change(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
                    BlendedFeet& new_feet, FootMemory& memory) noexcept {
    take_times(blend.leaves, std::span(memory.leaf).first(memory.count));
    FootBlend was;
    was.leaves = std::span(memory.leaf).first(memory.count);
    was.velocity = memory.velocity;
    was.turn = memory.turn;
    was.phase_rate = memory.phase_rate;
    was.phase_before = memory.phase_before;
    was.cycle_before = memory.cycle_before;
    BlendedFeet old_feet(paths, was);
    if (!old_feet.gather(clips)) return;
    FootMeans means;
    std::array<FootGoal, 2> before, after;
    for (std::size_t side = 0; side < 2; ++side) {
        const auto ask = [&](BlendedFeet& feet, FootGoal& goal) noexcept {
            feet.ask(feet.turn_to(side, blend.phase_before, blend.cycle_before), 0, goal, means);
        };
        ask(new_feet, after[side]);
        ask(old_feet, before[side]);
    }
    means.answer_all();
    for (std::size_t side = 0; side < 2; ++side)
        take_up(paths.side[side], before[side].foot, after[side].foot, memory.hold[side]);
}

/// What is seen from the root, which has turned.
void turn_with_root(Quat back, float& x, float& z) noexcept {
    const Vec3 turned = rotate(back, {x, 0, z});
    x = turned.x;
    z = turned.z;
}

void see_drift(const FootOffset& before, const FootOffset& after, float dt, FootMemory::Drift& drift) noexcept {
    if (!(dt > 0)) return;
    const float share = std::min(dt / k_drift_seconds, 1.0f);
    drift.x += ((before.x - after.x) / dt - drift.x) * share;
    drift.z += ((before.z - after.z) / dt - drift.z) * share;
    constexpr float k_none = 1e-3f;  // [m/s]
    if (std::fabs(drift.x) < k_none && std::fabs(drift.z) < k_none) drift = {};
}

/// Share of a swing's hold that is left when `done` of the swing has passed.
float left_of(float done) noexcept { return 1 - smooth_step(done); }

/// A hold goes to where the blend will have the foot once it stands, if changes go on for `foresight` seconds.
void let_go(const FootMemory::Drift& drift, float foresight, float share, float dt, FootOffset& hold) noexcept {
    const float to_x = drift.x * foresight, to_z = drift.z * foresight;
    const float x = hold.x - to_x, z = hold.z - to_z, offset = planar_length({x, 0, z}), twist = std::fabs(hold.yaw);
    const float least = offset > 0 ? 1 - k_fastest_return * dt / offset : 0,
                least_twist = twist > 0 ? 1 - k_fastest_untwist * dt / twist : 0;
    const float kept = std::max(share, least), kept_twist = std::max(share, least_twist);
    hold = {to_x + x * kept, to_z + z * kept, hold.yaw * kept_twist, hold.step};
}

/// What swings goes to where the blend has it, `foresight` seconds ahead. Returns who swings.
std::array<bool, 2> let_swings_go(const FootBlend& blend, BlendedFeet& feet, float foresight, float dt,
                                  FootMemory& memory) noexcept {
    if (!feet.steps()) return {};
    std::array<bool, 2> swings{};
    const float step = (blend.phase - blend.phase_before) +
                       static_cast<float>(static_cast<std::int32_t>(blend.cycle - blend.cycle_before));
    for (std::size_t side = 0; side < 2; ++side) {
        const float share = feet.turn_to(side), before = share - step, swing = k_swing_to_return * (1 - feet.duty());
        swings[side] = share >= feet.duty();
        const auto done = [&](float at) noexcept { return std::clamp((at - feet.duty()) / swing, 0.0f, 1.0f); };
        // A strike since the last step: what is left of the swing before it.
        const float from = before < 0 ? left_of(done(before + 1)) : left_of(done(before));
        const float to = before < 0 ? 0 : left_of(done(share));
        if (from > 0 && to < from) let_go(memory.drift[side], foresight, to / from, dt, memory.hold[side]);
    }
    return swings;
}

/// How far a foot is from where the blend has it, in soles' lengths.
float astray(const LegPaths::Side& leg, const FootOffset& hold) noexcept {
    const float offset = planar_length({hold.x, 0, hold.z}) / length(leg.ball - leg.heel);
    return offset + k_twist_as_offset * std::fabs(hold.yaw);
}

/// A step under way goes on; returns whether there is one.
bool go_on(FootOffset& hold, float passed) noexcept {
    if (!(hold.step > 0)) return false;
    const float after = hold.step + passed, left = left_of(hold.step);
    constexpr float k_arrived = 1 - 1e-3f;
    if (after < k_arrived && left > 0) {
        const float share = left_of(after) / left;
        hold = {hold.x * share, hold.z * share, hold.yaw * share, after};
    } else {
        hold = {};
    }
    return hold.step > 0;
}

/// Who comes to a stand has no swing to come: a foot that stands far astray takes a step, one foot after the other.
void settle(const LegPaths& paths, std::array<bool, 2> may_step, float dt, FootMemory& memory) noexcept {
    const float passed = dt / k_settle_seconds;
    const bool left_steps = go_on(memory.hold[0], passed), right_steps = go_on(memory.hold[1], passed);
    if (left_steps || right_steps || !(passed > 0)) return;
    const auto astray_if_free = [&](std::size_t side) noexcept {
        return may_step[side] ? astray(paths.side[side], memory.hold[side]) : 0.0f;
    };
    const float left = astray_if_free(0), right = astray_if_free(1);
    if (std::max(left, right) > k_astray) memory.hold[left > right ? 0 : 1].step = std::min(passed, 0.5f);
}

/// A foot's place along a way, as seen from the root.
float along(Vec3 way, const FootGoal& foot, const FootOffset& hold) noexcept {
    return (foot.foot.translation.x + hold.x) * way.x + (foot.foot.translation.z + hold.z) * way.z;
}

}  // namespace

bool stood(std::span<const PackedClip> clips, const FootMemory& memory) noexcept {
    const std::span<const Leaf> leaves = std::span(memory.leaf).first(memory.count);
    return memory.count > 0 && std::none_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
               return leaf.weight != 0 && steps(clips[static_cast<std::size_t>(leaf.clip)]);
           });
}

float starting_phase(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
                     const FootMemory& memory) noexcept {
    const float pace = planar_length(blend.velocity);
    const bool goes = pace > k_least_pace;
    if (paths.count == 0 || !(goes || std::fabs(blend.turn) > k_least_turn)) return blend.phase;
    FootBlend stood = blend;
    stood.leaves = std::span(memory.leaf).first(memory.count);
    BlendedFeet standing(paths, stood), stepping(paths, blend);
    if (!standing.gather(clips) || !stepping.gather(clips)) return blend.phase;
    FootMeans means;
    std::array<FootGoal, 2> feet;
    for (std::size_t side = 0; side < 2; ++side) standing.ask(standing.turn_to(side), 0, feet[side], means);
    means.answer_all();
    std::array<float, 2> lift;
    for (std::size_t side = 0; side < 2; ++side) {
        stepping.turn_to(side);
        lift[side] = strike_phase(static_cast<Side>(side)) + stepping.duty();
    }
    const auto wrapped = [](float phase) noexcept { return phase - std::floor(phase); };
    if (!goes) return wrapped(lift[blend.turn > 0 ? 0 : 1]);
    const Vec3 way = blend.velocity / pace;
    const float ahead = along(way, feet[0], memory.hold[0]) - along(way, feet[1], memory.hold[1]);
    if (std::fabs(ahead) >= k_side_by_side * length(paths.side[0].ball - paths.side[0].heel))
        return wrapped(lift[ahead > 0 ? 1 : 0]);
    return wrapped(lift[wrapped(lift[0] - blend.phase) < wrapped(lift[1] - blend.phase) ? 0 : 1]);
}

void hold_feet(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
               const RootFrame& root_delta, float dt, FootMemory& memory) noexcept {
    if (paths.count == 0) return;
    const bool changed = !is_same(memory, blend);
    const auto rests = [&]() noexcept {
        return !is_held(memory.hold) && memory.drift == std::array<FootMemory::Drift, 2>{};
    };
    const auto see_phase = [&]() noexcept {
        memory.phase_rate = blend.phase_rate;
        memory.phase_before = blend.phase_before;
        memory.cycle_before = blend.cycle_before;
    };
    if (!changed && rests()) return see_phase();
    const float stepping = changed || is_held(memory.hold) ? stepping_share(clips, blend.leaves) : 0;
    const float stepped = changed ? stepping_share(clips, std::span(memory.leaf).first(memory.count)) : stepping;
    const bool stops = stepping == 0 || (stepping < k_stopping && stepping < stepped);
    // Who comes to a stand changes no more once he stands.
    const float foresight =
        stepping < stepped ? std::min(k_foresight, dt * stepping / (stepped - stepping)) : k_foresight;
    const std::array<FootOffset, 2> held = memory.hold;
    BlendedFeet feet(paths, blend);
    const bool known = feet.gather(clips);
    if (known && changed && memory.count > 0) take_up_change(paths, clips, blend, feet, memory);
    if (changed) remember(blend, memory);
    see_phase();
    if (rests()) return;
    const Quat back = from_yaw(-root_delta.yaw);
    for (std::size_t side = 0; side < 2; ++side) {
        see_drift(held[side], memory.hold[side], dt, memory.drift[side]);
        turn_with_root(back, memory.drift[side].x, memory.drift[side].z);
        turn_with_root(back, memory.hold[side].x, memory.hold[side].z);
    }
    const std::array<bool, 2> swings =
        known ? let_swings_go(blend, feet, foresight, dt, memory) : std::array<bool, 2>{};
    settle(paths, {stops && !swings[1], stops && !swings[0]}, dt, memory);
}

}  // namespace surefoot
