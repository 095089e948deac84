#include <surefoot/graph/mix.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

bool any_steps(const LocomotionGraph& graph, std::span<const Leaf> leaves) noexcept {
    return std::any_of(leaves.begin(), leaves.end(),
                       [&](const Leaf& leaf) { return graph.clips[static_cast<std::size_t>(leaf.clip)].cycles > 0; });
}

/// A lone clip's feet are where it has them.
bool blends_feet(const LocomotionFrame& frame) noexcept {
    return frame.leaf_count > 1 || frame.styled || is_held(frame.hold);
}

/// Who stood and begins to go does so with the foot that trails: no clip that was seen has a phase.
void step_off(const LocomotionGraph& graph, const Mix& mix, LocomotionState& state) noexcept {
    std::array<Leaf, k_max_locomotion_leaves> leaf;
    const int count = make_leaves(graph.clips, mix.all(), state.clock, state.phase, state.cycle, leaf);
    const std::span<const Leaf> leaves = std::span(leaf).first(static_cast<std::size_t>(count));
    if (!any_steps(graph, leaves)) return;
    FootBlend blend;
    blend.leaves = leaves;
    blend.phase = state.phase;
    blend.cycle = state.cycle;
    blend.velocity = mix.velocity;
    state.phase = starting_phase(graph.legs, graph.clips, blend, state.feet);
}

/// The masked style's own pose over the finished one.
void lay_over(const LocomotionGraph& graph, const LocomotionFrame& frame, std::span<Transform> locals) noexcept {
    alignas(Transform) std::byte memory[k_max_joints * sizeof(Transform)];  // not worth constructing
    const std::size_t joints = graph.skeleton->rest.size();
    const std::span<Transform> layer{reinterpret_cast<Transform*>(memory), joints};
    sample_pose(*graph.skeleton, graph.clips, {frame.layer.data(), static_cast<std::size_t>(frame.layer_count)}, layer);
    const std::vector<float>& mask = graph.styles[static_cast<std::size_t>(frame.layer_style)].mask;
    lay_over(locals.first(joints), layer, frame.layer_weight, mask.data());
}

}  // namespace

LocomotionRequest approach(const LocomotionRequest& current, const LocomotionRequest& wanted, float dt,
                           const RequestRates& rates) noexcept {
    LocomotionRequest next = wanted;
    const float forward = wanted.speed - current.speed, side = wanted.lateral - current.lateral;
    const float change = std::sqrt(forward * forward + side * side), most = rates.acceleration * dt;
    if (change > most) {
        next.speed = current.speed + forward * (most / change);
        next.lateral = current.lateral + side * (most / change);
    }
    const float turn = wanted.turn - current.turn, most_turn = rates.turn_acceleration * dt;
    if (std::fabs(turn) > most_turn) next.turn = current.turn + (turn > 0 ? most_turn : -most_turn);
    const auto limited = [](float from, float to, float most) noexcept {
        return std::min(std::max(to, from - most), from + most);
    };
    next.slope = limited(current.slope, wanted.slope, rates.slope_rate * dt);
    for (std::size_t i = 0; i < next.custom.size(); ++i)
        next.custom[i] = limited(current.custom[i], wanted.custom[i], rates.custom_rate * dt);
    // One style fades out before another fades in.
    const bool leaves = wanted.style != current.style && current.style_weight > 0;
    const float from = leaves || wanted.style == current.style ? current.style_weight : 0;
    next.style = leaves ? current.style : wanted.style;
    next.style_weight = limited(from, leaves ? 0 : wanted.style_weight, rates.custom_rate * dt);
    return next;
}

LocomotionRequest request_at(const LocomotionSpace& space, std::span<const float> at) noexcept {
    LocomotionRequest request;
    float pace = 0, travel = 0;
    for (std::size_t k = 0; k < at.size() && k < space.axes.size(); ++k) switch (space.axes[k]) {
            case RequestAxis::speed:
            case RequestAxis::forward:
                request.speed = at[k];
                break;
            case RequestAxis::turn:
                request.turn = at[k];
                break;
            case RequestAxis::lateral:
                request.lateral = at[k];
                break;
            case RequestAxis::slope:
                request.slope = at[k];
                break;
            case RequestAxis::pace:
                pace = at[k];
                break;
            case RequestAxis::travel:
                travel = at[k] * k_radians_per_degree;
                break;
            case RequestAxis::custom:
                request.custom[space.custom_slots[k]] = at[k];
                break;
            case RequestAxis::none:
                break;
        }
    if (pace != 0) {
        request.speed = pace * cos(travel);
        request.lateral = pace * sin(travel);
    }
    return request;
}

LocomotionFrame update(const LocomotionGraph& graph, LocomotionState& state, const LocomotionRequest& request,
                       float dt) noexcept {
    LocomotionFrame frame;
    Mix mix;
    add_locomotion(mix, graph, state.facing_hint, state.lateral_hint, request);
    frame.clamped = mix.clamped;
    frame.velocity = mix.velocity;
    frame.turn = mix.turn * k_degrees_per_radian;
    const LocomotionStyle* style = style_of(graph, request);
    const float style_weight = std::min(request.style_weight, 1.0f);
    frame.styled = style != nullptr && style->mask.empty();
    if (frame.styled) mix_in_style(mix, *style, style_weight);
    if (stood(graph.clips, state.feet)) step_off(graph, mix, state);
    frame.phase_before = state.phase;
    frame.cycle_before = state.cycle;
    SharedPace pace;
    for (const Active& active : mix.all())
        pace.add(active, graph.clips[static_cast<std::size_t>(active.clip)], state.phase, state.cycle);
    frame.phase_rate = pace.rate();
    frame.root_delta = integrate(mix.velocity, mix.turn, dt);
    state.clock += static_cast<double>(dt);
    advance_phase(state.phase, state.cycle, frame.phase_rate * dt);
    frame.phase = state.phase;
    frame.cycle = state.cycle;
    const auto leaves_of = [&](const Mix& m, std::span<Leaf> leaves) noexcept {
        return make_leaves(graph.clips, m.all(), state.clock, state.phase, state.cycle, leaves);
    };
    frame.leaf_count = leaves_of(mix, frame.leaf);
    frame.stepping = any_steps(graph, frame.leaves());
    if (style != nullptr && !frame.styled) {
        frame.layer_count = leaves_of(style_layer(*style, mix.velocity, mix.turn), frame.layer);
        frame.layer_style = request.style;
        frame.layer_weight = style_weight;
    }
    hold_feet(graph.legs, graph.clips, foot_blend_of(frame), frame.root_delta, dt, state.feet);
    frame.hold = state.feet.hold;
    return frame;
}

FootBlend foot_blend_of(const LocomotionFrame& frame) noexcept {
    return {frame.leaves(),     frame.phase,      frame.cycle,    frame.phase_before,
            frame.cycle_before, frame.phase_rate, frame.velocity, frame.turn * k_radians_per_degree,
            frame.hold};
}

void pose(const LocomotionGraph& graph, const LocomotionFrame& frame, std::span<Transform> locals) noexcept {
    sample_pose(*graph.skeleton, graph.clips, frame.leaves(), locals);
    if (blends_feet(frame)) blend_feet(graph.legs, graph.clips, foot_blend_of(frame), locals);
    if (frame.layer_count > 0) lay_over(graph, frame, locals);
}

void poses(const LocomotionGraph& graph, std::span<const LocomotionFrame> frames,
           std::span<Transform* const> locals) noexcept {
    assert(frames.size() <= static_cast<std::size_t>(k_lanes) && locals.size() == frames.size());
    const auto pose_of = [&](std::size_t i) noexcept { return std::span(locals[i], graph.skeleton->rest.size()); };
    std::array<BlendedPose, k_lanes> blended;
    std::size_t count = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        sample_pose(*graph.skeleton, graph.clips, frames[i].leaves(), pose_of(i));
        if (blends_feet(frames[i])) blended[count++] = {foot_blend_of(frames[i]), pose_of(i)};
    }
    blend_feet(graph.legs, graph.clips, std::span(blended).first(count));
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (frames[i].layer_count > 0) lay_over(graph, frames[i], pose_of(i));
}

void pose_without_feet(const LocomotionGraph& graph, const LocomotionFrame& frame,
                       std::span<Transform> locals) noexcept {
    sample_pose(*graph.skeleton, graph.clips, frame.leaves(), locals);
    if (frame.layer_count > 0) lay_over(graph, frame, locals);
}

}  // namespace surefoot
