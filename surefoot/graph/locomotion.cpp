#include <surefoot/graph/locomotion.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

/// A clip's stride is measured where the feet are: turning counts by this lever, the distance of a foot from the root.
constexpr float k_foot_lever = 0.15f;  // [m]
/// A sample weighing less adds nothing that can be seen (a thousandth of a pose), and costs a leaf.
constexpr float k_least_weight = 1e-4f;

/// Velocity of the ground under the feet, or its travel a cycle: planar and by turning, in metres.
struct Stride {
    float x = 0, z = 0, turn = 0;

    friend Stride operator*(Stride a, float s) noexcept { return {a.x * s, a.z * s, a.turn * s}; }
    Stride& operator+=(Stride b) noexcept { return *this = {x + b.x, z + b.z, turn + b.turn}; }
    float length() const noexcept { return std::sqrt(x * x + z * z + turn * turn); }
};
Stride stride_of(Vec3 velocity, float turn_rate) noexcept { return {velocity.x, velocity.z, turn_rate * k_foot_lever}; }

/// A sample of a space with its share in this frame.
struct Active {
    std::int32_t clip;
    float weight;
    Vec3 velocity;
    float turn;
};

struct Mix {
    Active active[k_max_locomotion_leaves];
    int count = 0;
    Vec3 velocity;
    float turn = 0;  // [rad/s]
    bool clamped = false;
};

/// Where in a space a request lies; `forward` and `lateral` are this space's part of its velocity.
SpacePoint point_in(const LocomotionSpace& space, const LocomotionRequest& request, float forward,
                    float lateral) noexcept {
    SpacePoint point{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(space.space.dimensions()); ++d) {
        switch (space.axes[d]) {
            case RequestAxis::speed:
            case RequestAxis::forward:
                point[d] = forward;
                break;
            case RequestAxis::turn:
                point[d] = request.turn;
                break;
            case RequestAxis::lateral:
                point[d] = lateral;
                break;
            case RequestAxis::slope:
                point[d] = request.slope;
                break;
            case RequestAxis::pace:
                point[d] = std::sqrt(forward * forward + lateral * lateral);
                break;
            case RequestAxis::travel:
                point[d] = forward == 0 && lateral == 0 ? 0.0f : atan2(lateral, forward) * k_degrees_per_radian;
                break;
            case RequestAxis::custom:
                point[d] = request.custom[space.custom_slots[d]];
                break;
            case RequestAxis::none:
                break;
        }
    }
    return point;
}

/// Adds the samples found in a space, all weighed by `share`.
void add_samples(Mix& mix, const LocomotionSpace& space, const BlendWeights& found, float share) noexcept {
    float kept = 0;
    for (int i = 0; i < found.count; ++i)
        if (std::fabs(found.weights[static_cast<std::size_t>(i)]) >= k_least_weight)
            kept += found.weights[static_cast<std::size_t>(i)];
    for (int i = 0; i < found.count; ++i) {
        const float raw = found.weights[static_cast<std::size_t>(i)];
        if (std::fabs(raw) < k_least_weight) continue;
        const auto sample = static_cast<std::size_t>(found.samples[static_cast<std::size_t>(i)]);
        const float weight = share * (raw / kept);
        mix.active[mix.count++] = {space.clips[sample], weight, space.velocities[sample], space.turns[sample]};
    }
}

/// Adds a space's answer at a point; what no axis of it says about turning is `turn_deg`.
void add_space(Mix& mix, const LocomotionSpace& space, std::int32_t& hint, const SpacePoint& point, float turn_deg,
               float share) noexcept {
    const BlendWeights found = blend_weights(space.space, point, hint);
    hint = found.simplex;
    mix.clamped |= found.clamped;
    const int first = mix.count;
    add_samples(mix, space, found, share);
    for (int i = first; i < mix.count; ++i) {
        mix.velocity += mix.active[i].weight * mix.active[i].velocity;
        if (space.has_turn) mix.turn += mix.active[i].weight * mix.active[i].turn;
    }
    if (!space.has_turn) mix.turn += share * (turn_deg * k_radians_per_degree);
}

/// The style that a request asks for, if it asks for one.
const LocomotionStyle* style_of(const LocomotionGraph& graph, const LocomotionRequest& request) noexcept {
    const bool one = request.style >= 0 && static_cast<std::size_t>(request.style) < graph.styles.size();
    return one && request.style_weight > 0 ? &graph.styles[static_cast<std::size_t>(request.style)] : nullptr;
}

/// A style's samples at the pace of the mix, whatever its direction.
void add_style(Mix& styled, const LocomotionStyle& style, Vec3 velocity, float turn, float share) noexcept {
    const float pace = planar_length(velocity);
    const int first = styled.count;
    add_samples(styled, style.space, blend_weights(style.space.space, {velocity.z < 0 ? -pace : pace}), share);
    // Its clips are played as the root moves, not as theirs did.
    for (int i = first; i < styled.count; ++i) {
        styled.active[i].velocity = velocity;
        styled.active[i].turn = turn;
    }
}

/// How a velocity is shared between the two spaces: so that both asked at the same speed, one straight along the
/// facing and one along the lateral space's nearest direction, add up to it exactly.
struct Sharing {
    float lateral_share = 0;
    float facing_forward = 0;
    float lateral_forward = 0, lateral_side = 0;
};
Sharing share_out(const LocomotionGraph& graph, float forward, float side) noexcept {
    if (graph.lateral.empty()) return {0, forward, 0, 0};
    if (graph.facing.empty()) return {1, 0, forward, side};
    const float ahead = std::fabs(forward), aside = std::fabs(side);
    if (!(aside > 1e-6f)) return {0, forward, 0, 0};
    const float angle = graph.side_travel[(side < 0 ? 1u : 0u) + (forward < 0 ? 2u : 0u)];
    const float sine = sin(angle), cosine = cos(angle);
    if (ahead * sine <= aside * cosine) return {1, 0, forward, side};  // no nearer to the facing than the clips are
    const float oblique = aside / sine, straight = ahead - oblique * cosine, speed = oblique + straight;
    const float sign = forward < 0 ? -1.0f : 1.0f;
    return {oblique / speed, sign * speed, sign * speed * cosine, (side < 0 ? -speed : speed) * sine};
}

/// Rate of the shared phase, cycles a second (DESIGN: |sum w v| / |sum w s|; see graph/README.md).
float phase_rate(const LocomotionGraph& graph, const Mix& mix, float phase, std::uint32_t cycle) noexcept {
    Stride moved, stride;
    float stride_sizes = 0, weights = 0, taken_off = 0, mean = 0, slowest = 0, fastest = 0;
    for (int i = 0; i < mix.count; ++i) {
        const Active& a = mix.active[i];
        const PackedClip& clip = graph.clips[static_cast<std::size_t>(a.clip)];
        moved += stride_of(a.velocity, a.turn) * a.weight;
        if (clip.cycles == 0) continue;
        // Seconds a cycle just here: foot strikes are not evenly spaced in every clip.
        const float seconds = phase_time(clip, phase_in(clip, phase, cycle)).slope;
        const Stride own = stride_of(clip.velocity, clip.turn_rate) * seconds;
        stride += own * a.weight;
        const float share = std::fabs(a.weight);  // what is taken off paces the feet as much as what is added
        stride_sizes += own.length() * share;
        weights += share;
        taken_off += share - std::max(a.weight, 0.0f);
        // A clip placed at another speed than its own is played that much faster.
        const float own_speed = stride_of(clip.velocity, clip.turn_rate).length();
        const float placed = stride_of(a.velocity, a.turn).length();
        constexpr float k_standing = 0.02f;  // [m/s] slower ratios mean nothing
        const float ratio = own_speed > k_standing ? std::min(std::max(placed / own_speed, 0.5f), 2.0f) : 1.0f;
        const float rate = ratio / seconds;
        mean += rate * share;
        slowest = weights == share ? rate : std::min(slowest, rate);
        fastest = std::max(fastest, rate);
    }
    if (!(weights > 0)) return 0;
    mean /= weights;
    const float length = stride.length();
    // Strides that cancel (forward against backward) say nothing about the rate: fade to the mean rate there.
    const float told = stride_sizes > 0 ? length / stride_sizes : 0.0f;
    const float t = std::min(std::max((told - 0.2f) / 0.3f, 0.0f), 1.0f), trust = t * t * (3.0f - 2.0f * t);
    if (!(trust > 0)) return mean;
    // For velocities along one line this is a mean of the clips' own rates, or, extrapolated, beyond them; the bounds
    // only matter across directions.
    const float beyond = 2.0f * taken_off * (fastest - slowest);
    const float by_stride = std::min(std::max(moved.length() / length, slowest - beyond), fastest + beyond);
    return mean + (by_stride - mean) * trust;
}

void advance(LocomotionState& state, float rate, float dt) noexcept {
    state.clock += static_cast<double>(dt);
    const float phase = state.phase + rate * dt, whole = std::floor(phase);
    state.cycle += static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
    state.phase = phase - whole;
    if (state.phase >= 1.0f) {  // rounding of a tiny negative rest
        state.phase = 0;
        ++state.cycle;
    }
}

/// Time of a clip without steps on the character's clock: cyclic ones go round, others there and back.
float clock_time(const PackedClip& clip, double clock) noexcept {
    const double duration = clip.duration(), period = clip.cyclic ? duration : 2.0 * duration;
    const double time = clock - std::floor(clock / period) * period;
    return static_cast<float>(time <= duration ? time : period - time);
}

float leaf_time(const PackedClip& clip, const LocomotionState& state) noexcept {
    if (clip.cycles == 0) return clock_time(clip, state.clock);
    return time_at(clip, phase_in(clip, state.phase, state.cycle));
}

/// One leaf a clip, though several spaces may hold it (an idle). What is taken off comes last: signs of rotations are
/// told by what is there already. Returns how many.
int make_leaves(const LocomotionGraph& graph, const Mix& mix, const LocomotionState& state,
                std::span<Leaf> leaves) noexcept {
    int count = 0;
    const auto add = [&](const Active& a) noexcept {
        int at = 0;
        while (at < count && leaves[static_cast<std::size_t>(at)].clip != a.clip) ++at;
        if (at < count) {
            leaves[static_cast<std::size_t>(at)].weight += a.weight;
            return;
        }
        const PackedClip& clip = graph.clips[static_cast<std::size_t>(a.clip)];
        leaves[static_cast<std::size_t>(count++)] = {a.clip, leaf_time(clip, state), a.weight};
    };
    for (int i = 0; i < mix.count; ++i)
        if (mix.active[i].weight >= 0) add(mix.active[i]);
    for (int i = 0; i < mix.count; ++i)
        if (mix.active[i].weight < 0) add(mix.active[i]);
    return count;
}

bool any_steps(const LocomotionGraph& graph, std::span<const Leaf> leaves) noexcept {
    return std::any_of(leaves.begin(), leaves.end(),
                       [&](const Leaf& leaf) { return graph.clips[static_cast<std::size_t>(leaf.clip)].cycles > 0; });
}

/// The masked style's own pose over the finished one.
void lay_over(const LocomotionGraph& graph, const LocomotionFrame& frame, std::span<Transform> locals) noexcept {
    alignas(Transform) std::byte memory[k_max_joints * sizeof(Transform)];  // not worth constructing
    const std::size_t joints = graph.skeleton->rest.size();
    const std::span<Transform> layer{reinterpret_cast<Transform*>(memory), joints};
    sample_pose(*graph.skeleton, graph.clips, {frame.layer.data(), static_cast<std::size_t>(frame.layer_count)}, layer);
    const std::vector<float>& mask = graph.styles[static_cast<std::size_t>(frame.layer_style)].mask;
    for (std::size_t j = 0; j < joints; ++j) {
        const float share = frame.layer_weight * mask[j];
        if (!(share > 0)) continue;
        locals[j].rotation = nlerp(locals[j].rotation, layer[j].rotation, share);
        locals[j].translation = lerp(locals[j].translation, layer[j].translation, share);
    }
}

}  // namespace

RootFrame integrate(Vec3 velocity, float turn_rate, float seconds) noexcept {
    const float angle = turn_rate * seconds;
    float along, across;  // of the mean direction: sin(t)/t and (1 - cos t)/t
    if (std::fabs(angle) < 0.05f) {
        const float square = angle * angle;
        along = 1.0f - square / 6.0f * (1.0f - square / 20.0f);
        across = 0.5f * angle * (1.0f - square / 12.0f * (1.0f - square / 30.0f));
    } else {
        along = sin(angle) / angle;
        across = (1.0f - cos(angle)) / angle;
    }
    return {{seconds * (velocity.x * along + velocity.z * across), seconds * velocity.y,
             seconds * (velocity.z * along - velocity.x * across)},
            angle};
}

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
    const Sharing sharing = share_out(graph, request.speed, request.lateral);
    if (sharing.lateral_share < 1) {
        const SpacePoint point = point_in(graph.facing, request, sharing.facing_forward, 0);
        add_space(mix, graph.facing, state.facing_hint, point, request.turn, 1.0f - sharing.lateral_share);
    }
    if (sharing.lateral_share > 0) {
        const SpacePoint point = point_in(graph.lateral, request, sharing.lateral_forward, sharing.lateral_side);
        add_space(mix, graph.lateral, state.lateral_hint, point, request.turn, sharing.lateral_share);
    }
    if (graph.lateral.empty() && std::fabs(request.lateral) > 1e-3f) frame.clamped = true;
    frame.clamped |= mix.clamped;
    frame.velocity = mix.velocity;
    frame.turn = mix.turn * k_degrees_per_radian;
    const LocomotionStyle* style = style_of(graph, request);
    const float style_weight = std::min(request.style_weight, 1.0f);
    frame.styled = style != nullptr && style->mask.empty();
    if (frame.styled) {
        if (style_weight == 1) mix.count = 0;
        for (int i = 0; i < mix.count; ++i) mix.active[i].weight *= 1 - style_weight;
        add_style(mix, *style, mix.velocity, mix.turn, style_weight);
    }
    frame.phase_before = state.phase;
    frame.cycle_before = state.cycle;
    frame.phase_rate = phase_rate(graph, mix, state.phase, state.cycle);
    frame.root_delta = integrate(mix.velocity, mix.turn, dt);
    advance(state, frame.phase_rate, dt);
    frame.phase = state.phase;
    frame.cycle = state.cycle;
    frame.leaf_count = make_leaves(graph, mix, state, frame.leaf);
    frame.stepping = any_steps(graph, frame.leaves());
    if (style != nullptr && !frame.styled) {
        Mix layer;
        add_style(layer, *style, mix.velocity, mix.turn, 1);
        frame.layer_count = make_leaves(graph, layer, state, frame.layer);
        frame.layer_style = request.style;
        frame.layer_weight = style_weight;
    }
    return frame;
}

void pose(const LocomotionGraph& graph, const LocomotionFrame& frame, std::span<Transform> locals) noexcept {
    sample_pose(*graph.skeleton, graph.clips, frame.leaves(), locals);
    blend_feet(graph.legs, graph.clips, frame, locals);
    if (frame.layer_count > 0) lay_over(graph, frame, locals);
}

float foot_speed(Vec3 velocity, float turn_rate) noexcept { return stride_of(velocity, turn_rate).length(); }

}  // namespace surefoot
