#include <surefoot/graph/mix.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

/// A clip's stride is measured where the feet are: turning counts by this lever, the distance of a foot from the root.
constexpr float k_foot_lever = 0.15f;  // [m]
/// A sample weighing less adds nothing that can be seen (a thousandth of a pose), and costs a leaf.
constexpr float k_least_weight = 1e-4f;

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

}  // namespace

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

void add_locomotion(Mix& mix, const LocomotionGraph& graph, std::int32_t& facing_hint, std::int32_t& lateral_hint,
                    const LocomotionRequest& request) noexcept {
    const Sharing sharing = share_out(graph, request.speed, request.lateral);
    if (sharing.lateral_share < 1) {
        const SpacePoint point = point_in(graph.facing, request, sharing.facing_forward, 0);
        add_space(mix, graph.facing, facing_hint, point, request.turn, 1.0f - sharing.lateral_share);
    }
    if (sharing.lateral_share > 0) {
        const SpacePoint point = point_in(graph.lateral, request, sharing.lateral_forward, sharing.lateral_side);
        add_space(mix, graph.lateral, lateral_hint, point, request.turn, sharing.lateral_share);
    }
    if (graph.lateral.empty() && std::fabs(request.lateral) > 1e-3f) mix.clamped = true;
}

const LocomotionStyle* style_of(const LocomotionGraph& graph, const LocomotionRequest& request) noexcept {
    const bool one = request.style >= 0 && static_cast<std::size_t>(request.style) < graph.styles.size();
    return one && request.style_weight > 0 ? &graph.styles[static_cast<std::size_t>(request.style)] : nullptr;
}

void mix_in_style(Mix& mix, const LocomotionStyle& style, float weight) noexcept {
    if (weight >= 1) mix.count = 0;
    for (int i = 0; i < mix.count; ++i) mix.active[i].weight *= 1 - weight;
    add_style(mix, style, mix.velocity, mix.turn, weight);
}

Mix style_layer(const LocomotionStyle& style, Vec3 velocity, float turn) noexcept {
    Mix layer;
    add_style(layer, style, velocity, turn, 1);
    return layer;
}

float SharedPace::Stride::length() const noexcept { return std::sqrt(x * x + z * z + turn * turn); }

SharedPace::Stride SharedPace::stride_of(Vec3 velocity, float turn_rate) noexcept {
    return {velocity.x, velocity.z, turn_rate * k_foot_lever};
}

float foot_speed(Vec3 velocity, float turn_rate) noexcept {
    return SharedPace::stride_of(velocity, turn_rate).length();
}

void SharedPace::add(const Active& active, const PackedClip& clip, float phase, std::uint32_t cycle) noexcept {
    moved_ += stride_of(active.velocity, active.turn) * active.weight;
    if (clip.cycles == 0) return;
    // Seconds a cycle just here: foot strikes are not evenly spaced in every clip.
    const float seconds = phase_time(clip, phase_in(clip, phase, cycle)).slope;
    const Stride own = stride_of(clip.velocity, clip.turn_rate) * seconds;
    stride_ += own * active.weight;
    const float share = std::fabs(active.weight);  // what is taken off paces the feet as much as what is added
    stride_sizes_ += own.length() * share;
    weights_ += share;
    taken_off_ += share - std::max(active.weight, 0.0f);
    // A clip placed at another speed than its own is played that much faster.
    const float own_speed = foot_speed(clip.velocity, clip.turn_rate);
    const float placed = foot_speed(active.velocity, active.turn);
    constexpr float k_standing = 0.02f;  // [m/s] slower ratios mean nothing
    const float ratio = own_speed > k_standing ? std::min(std::max(placed / own_speed, 0.5f), 2.0f) : 1.0f;
    const float rate = ratio / seconds;
    mean_ += rate * share;
    slowest_ = weights_ == share ? rate : std::min(slowest_, rate);
    fastest_ = std::max(fastest_, rate);
}

float SharedPace::rate() const noexcept {
    if (!(weights_ > 0)) return 0;
    const float mean = mean_ / weights_, length = stride_.length();
    // Strides that cancel (forward against backward) say nothing about the rate: fade to the mean rate there.
    const float told = stride_sizes_ > 0 ? length / stride_sizes_ : 0.0f;
    const float t = std::min(std::max((told - 0.2f) / 0.3f, 0.0f), 1.0f), trust = t * t * (3.0f - 2.0f * t);
    if (!(trust > 0)) return mean;
    // For velocities along one line this is a mean of the clips' own rates, or, extrapolated, beyond them; the bounds
    // only matter across directions.
    const float beyond = 2.0f * taken_off_ * (fastest_ - slowest_);
    const float by_stride = std::min(std::max(moved_.length() / length, slowest_ - beyond), fastest_ + beyond);
    return mean + (by_stride - mean) * trust;
}

void advance_phase(float& phase, std::uint32_t& cycle, float step) noexcept {
    phase += step;
    const float whole = std::floor(phase);
    cycle += static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
    phase -= whole;
    if (phase >= 1.0f) {  // rounding of a tiny negative rest
        phase = 0;
        ++cycle;
    }
}

float clock_time(const PackedClip& clip, double clock) noexcept {
    const double duration = clip.duration(), period = clip.cyclic ? duration : 2.0 * duration;
    const double time = clock - std::floor(clock / period) * period;
    return static_cast<float>(time <= duration ? time : period - time);
}

int make_leaves(std::span<const PackedClip> clips, std::span<const Active> active, double clock, float phase,
                std::uint32_t cycle, std::span<Leaf> leaves) noexcept {
    int count = 0;
    const auto add = [&](const Active& a) noexcept {
        int at = 0;
        while (at < count && leaves[static_cast<std::size_t>(at)].clip != a.clip) ++at;
        if (at < count) {
            leaves[static_cast<std::size_t>(at)].weight += a.weight;
            return;
        }
        const PackedClip& clip = clips[static_cast<std::size_t>(a.clip)];
        const float time = clip.cycles == 0 ? clock_time(clip, clock) : time_at(clip, phase_in(clip, phase, cycle));
        leaves[static_cast<std::size_t>(count++)] = {a.clip, time, a.weight};
    };
    for (const Active& a : active)
        if (a.weight >= 0) add(a);
    for (const Active& a : active)
        if (a.weight < 0) add(a);
    return count;
}

void lay_over(std::span<Transform> base, std::span<const Transform> above, float weight, const float* mask) noexcept {
    for (std::size_t j = 0; j < base.size(); ++j) {
        const float share = weight * (mask == nullptr ? 1.0f : mask[j]);
        if (!(share > 0)) continue;
        base[j].rotation = nlerp(base[j].rotation, above[j].rotation, share);
        base[j].translation = lerp(base[j].translation, above[j].translation, share);
    }
}

}  // namespace surefoot
