// The pass over groups and leaves: how fast phases run, and everybody's time. Events happen here.

#include <surefoot/program/step.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

float wrapped_angle(float angle) noexcept {
    const float turn = static_cast<float>(2 * k_pi);
    return angle - turn * std::floor(angle / turn + 0.5f);
}

/// What of the error is taken back in a step of the window, so that none is left at its end and the first steps take
/// little.
float warp_share(float from, float until, float t0, float t1) noexcept {
    const auto done = [&](float t) { return ease(Curve::smoothstep, (t - from) / (until - from)); };
    const float left = 1 - done(t0);
    return left > 1e-6f ? (done(t1) - done(t0)) / left : 1.0f;
}

RootFrame toward(const RootFrame& a, const RootFrame& b, float share) noexcept {
    return {lerp(a.position, b.position, share), a.yaw + wrapped_angle(b.yaw - a.yaw) * share};
}

/// A step of a clip whose root shall be at `target` when its time is `until`. The place where it would arrive by itself
/// is moved there bit by bit, and the path with it.
RootFrame aligned_step(const PackedClip& packed, const ClipNode& clip, float t0, float t1, const RootFrame& root,
                       const RootFrame& target) noexcept {
    const RootFrame goal = clip_root(packed, clip.align_until);
    const RootFrame arrives = root * between(clip_root(packed, t0), goal);
    const RootFrame led = toward(arrives, target, warp_share(clip.align_from, clip.align_until, t0, t1));
    return between(root, led * between(goal, clip_root(packed, t1)));
}

}  // namespace

void velocity_of(const RootFrame& delta, float dt, Vec3& velocity, float& turn) noexcept {
    if (!(dt > 0)) return;
    turn = delta.yaw / dt;
    // integrate() is a rotation and scaling of the velocity in the plane, by (along, across) of a unit step.
    const RootFrame unit = integrate({0, 0, 1}, turn, dt);
    const float along = unit.position.z, across = unit.position.x, square = along * along + across * across;
    const Vec3 p = delta.position;
    velocity = {(p.x * along - p.z * across) / square, p.y / dt, (p.z * along + p.x * across) / square};
}

void GraphStep::fire(const std::vector<EventMark>& marks, float from, float to, bool with_from, int owner, float weight,
                     float left, float per_second) noexcept {
    for (const EventMark& mark : marks) {
        if (mark.at > to || !(with_from ? mark.at >= from : mark.at > from)) continue;
        if (frame_.event_count_ == frame_.event_.size()) {
            ++frame_.events_lost;
            continue;
        }
        const float ago = per_second > 0 ? left + (to - mark.at) / per_second : left;
        frame_.event_[frame_.event_count_++] = {mark.event, static_cast<std::int16_t>(owner), weight, ago};
    }
}

void GraphStep::sort_events(std::size_t first) noexcept {
    const auto begin = frame_.event_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = frame_.event_.begin() + static_cast<std::ptrdiff_t>(frame_.event_count_);
    for (auto i = begin; i != end; ++i)  // few, and stable without memory
        std::rotate(std::upper_bound(begin, i, *i, [](const auto& a, const auto& b) { return a.ago > b.ago; }), i,
                    i + 1);
}

/// A phase that begins to run goes on from the step of the clip that plays most, if that steps by itself.
void GraphStep::take_over_phase(GroupMemory& group) noexcept {
    float heaviest = 0;
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
        const NodeStep& step = parts_.nodes[i];
        const auto* clip = std::get_if<ClipNode>(&program_.nodes[i].data);
        if (!step.plays || clip == nullptr || clip->group >= 0 || !(step.weight > heaviest)) continue;
        const PackedClip& p = packed(clip->clip);
        if (p.cycles == 0) continue;
        heaviest = step.weight;
        const float phase = phase_at(p, memory_at<ClipMemory>(state_, program_.nodes[i].memory).time);
        group.phase = phase - std::floor(phase);
        if (step.turned) turn_phase(group.phase, group.cycle);
        if (!(group.phase < 1)) group.phase = 0;
    }
}

/// What a node of a group plays; a clip by itself is written to `alone`.
std::span<const Active> GraphStep::played_by(int i, Active& alone) noexcept {
    const auto* clip = std::get_if<ClipNode>(&node(i).data);
    if (clip == nullptr) return mix_at(i).all();
    alone = {clip->clip, 1, packed(clip->clip).velocity, packed(clip->clip).turn_rate};
    return {&alone, 1};
}

void GraphStep::run_groups(float dt, float left) noexcept {
    struct Pacing {
        SharedPace leading, following;
        bool leads = false, follows = false, fresh = false;
        float weight = 0;
    };
    std::array<Pacing, k_max_sync_groups> pacing;
    const auto memory_of = [&](std::size_t g) -> GroupMemory& {
        return memory_at<GroupMemory>(state_, group_memory(program_, g));
    };
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
        const int g = parts_.nodes[i].plays ? group_of(program_.nodes[i].data) : -1;
        if (g < 0) continue;
        auto& p = pacing[static_cast<std::size_t>(g)];
        (program_.nodes[i].follows ? p.follows : p.leads) = true;
        p.weight += parts_.nodes[i].weight;
    }
    for (std::size_t g = 0; g < program_.groups.size(); ++g) {
        GroupMemory& group = memory_of(g);
        const bool runs = pacing[g].leads || pacing[g].follows;
        pacing[g].fresh = runs && group.runs == 0;
        if (pacing[g].fresh) take_over_phase(group);
        if (runs) step_off(static_cast<int>(g));
        group.runs = runs ? 1 : 0;
    }
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
        const NodeStep& step = parts_.nodes[i];
        const int g = step.plays ? group_of(program_.nodes[i].data) : -1;
        if (g < 0) continue;
        const GroupMemory& group = memory_of(static_cast<std::size_t>(g));
        float phase = group.phase;
        std::uint32_t cycle = group.cycle;
        if (step.turned) turn_phase(phase, cycle);
        auto& p = pacing[static_cast<std::size_t>(g)];
        SharedPace& pace = program_.nodes[i].follows ? p.following : p.leading;
        const auto add = [&](Active active) noexcept {
            active.weight *= step.weight;
            active.velocity *= step.rate;
            active.turn *= step.rate;
            pace.add(active, packed(active.clip), phase, cycle);
        };
        Active alone;
        for (const Active& active : played_by(static_cast<int>(i), alone)) add(active);
    }
    for (std::size_t g = 0; g < program_.groups.size(); ++g) {
        GroupMemory& group = memory_of(g);
        const float rate = pacing[g].leads ? pacing[g].leading.rate() : pacing[g].following.rate();
        GroupStep& step = frame_.groups[g];
        step = {group.phase, group.phase, group.cycle, group.cycle, rate, group.runs != 0};
        if (!step.runs) continue;
        advance_phase(group.phase, group.cycle, rate * dt);
        step.phase = group.phase;
        step.cycle = group.cycle;
        const auto cycles = static_cast<std::int32_t>(group.cycle - step.cycle_before);
        if (!(rate > 0) || dt == 0) continue;
        // Up to the seam, whole rounds, and from the seam on.
        const float weight = std::min(pacing[g].weight, 1.0f);
        const auto& marks = program_.groups[g].events;
        for (std::int32_t c = 0; c <= std::min(cycles, k_max_frame_events); ++c) {
            const float from = c == 0 ? step.phase_before : 0.0f, to = c == cycles ? group.phase : 1.0f;
            const float later = (static_cast<float>(cycles - c) - to + group.phase) / rate;
            fire(marks, from, to, c > 0 || pacing[g].fresh, -1, weight, left + later, rate);
        }
    }
}

void GraphStep::run_clip(int i, const ClipNode& clip, const GraphInput& input, float dt, float left) noexcept {
    const PackedClip& p = packed(clip.clip);
    NodeStep& step = at(i);
    const float duration = p.duration();
    if (clip.group >= 0) {
        const GroupStep& group = frame_.groups[static_cast<std::size_t>(clip.group)];
        step.velocity = p.velocity * step.rate;
        step.turn = p.turn_rate * step.rate;
        if (clip.events.empty() || dt == 0) return;
        const auto time = [&](float phase, std::uint32_t cycle) noexcept {
            if (step.turned) turn_phase(phase, cycle);
            return time_at(p, phase_in(p, phase, cycle));
        };
        const float t0 = time(group.phase_before, group.cycle_before), t1 = time(group.phase, group.cycle);
        const float passed = t1 >= t0 ? t1 - t0 : t1 - t0 + duration;
        const float per_second = passed / dt;
        if (t1 >= t0) {
            fire(clip.events, t0, t1, false, i, step.weight, left, per_second);
        } else {
            fire(clip.events, t0, duration, false, i, step.weight, left + t1 / per_second, per_second);
            fire(clip.events, 0, t1, true, i, step.weight, left, per_second);
        }
        return;
    }
    auto& memory = memory_at<ClipMemory>(state_, node(i).memory);
    const float rate = rate_of(state_, clip.rate) * step.rate;
    float ahead = rate * dt;
    RootFrame moved;
    constexpr int k_most_rounds = 64;
    for (int round = 0; round < k_most_rounds; ++round) {
        const float t0 = memory.time, t1 = std::min(t0 + ahead, duration);
        ahead -= t1 - t0;
        const bool again = clip.loop && t1 >= duration && ahead > 0;
        if (dt > 0) {
            const float after = rate > 0 ? ahead / rate : 0.0f;
            fire(clip.events, t0, t1, memory.fresh != 0, i, step.weight, left + after, rate);
            memory.fresh = 0;
        }
        const bool aligns = clip.target >= 0 && static_cast<std::size_t>(clip.target) < input.targets.size() &&
                            t1 > clip.align_from && t0 < clip.align_until;
        moved = moved * (aligns ? aligned_step(p, clip, t0, t1, input.root * frame_.root_delta,
                                               input.targets[static_cast<std::size_t>(clip.target)])
                                : between(clip_root(p, t0), clip_root(p, t1)));
        memory.time = t1;
        if (!again) break;
        memory.time = 0;
        memory.fresh = 1;
    }
    step.velocity = p.velocity * rate;
    step.turn = p.turn_rate * rate;
    velocity_of(moved, dt, step.velocity, step.turn);
}

void GraphStep::run_gait(int i, const GaitNode& gait, float dt) noexcept {
    NodeStep& step = at(i);
    auto& live = memory_at<LiveState>(state_, node(i).memory);
    LiveRequest request;
    request.speed = value(gait.speed);
    request.turn = value(gait.turn);
    request.manner = static_cast<int>(std::floor(value(gait.manner) + 0.5f));
    request.glide = gait.glide;
    const LiveFrame live_frame =
        update(*program_.rigs[static_cast<std::size_t>(gait.rig)], live, request, dt * step.rate);
    step.velocity = live_frame.velocity;
    step.turn = live_frame.turn * k_radians_per_degree;
    velocity_of(live_frame.root_delta, dt, step.velocity, step.turn);
}

void GraphStep::run_leaves(const GraphInput& input, float dt, float left) noexcept {
    for (int i = 0; i < static_cast<int>(program_.nodes.size()); ++i) {
        NodeStep& step = at(i);
        if (!step.plays) continue;
        const NodeData& data = node(i).data;
        if (const auto* clip = std::get_if<ClipNode>(&data)) {
            run_clip(i, *clip, input, dt, left);
        } else if (const auto* gait = std::get_if<GaitNode>(&data)) {
            run_gait(i, *gait, dt);
        } else if (std::holds_alternative<SpaceNode>(data) || std::holds_alternative<LocomotionNode>(data)) {
            memory_at<SpaceMemory>(state_, node(i).memory).clock += static_cast<double>(dt * step.rate);
            step.velocity = mix_at(i).velocity * step.rate;
            step.turn = mix_at(i).turn * step.rate;
        }
    }
}

}  // namespace surefoot
