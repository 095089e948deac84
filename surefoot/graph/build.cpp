// Building and checking a locomotion graph: the only part of the room that allocates.

#include <surefoot/graph/locomotion.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

RequestAxis axis_of(const std::string& name) noexcept {
    if (name == "speed") return RequestAxis::speed;
    if (name == "turn") return RequestAxis::turn;
    if (name == "forward") return RequestAxis::forward;
    if (name == "lateral") return RequestAxis::lateral;
    if (name == "slope") return RequestAxis::slope;
    if (name == "pace") return RequestAxis::pace;
    if (name == "travel") return RequestAxis::travel;
    return RequestAxis::custom;
}

/// A sample moves the root as its place says; what its place does not say, as its clip does.
void declare_motion(LocomotionSpace& space, const std::vector<PackedClip>& clips) {
    const std::size_t count = std::min(space.space.samples.size(), space.clips.size());
    const auto reads = [&](RequestAxis axis) {
        return std::find(space.axes.begin(), space.axes.end(), axis) != space.axes.end();
    };
    const bool has_direction = reads(RequestAxis::pace) || reads(RequestAxis::travel);
    space.velocities.resize(count);
    space.turns.resize(count);
    for (std::size_t s = 0; s < count; ++s) {
        const auto at = static_cast<std::size_t>(space.clips[s]);
        if (at >= clips.size()) continue;  // `problem` tells
        Vec3& velocity = space.velocities[s] = clips[at].velocity;
        float& turn = space.turns[s] = clips[at].turn_rate;
        float pace = planar_length(velocity), travel = pace > 0 ? atan2(velocity.x, velocity.z) : 0.0f;
        for (std::size_t d = 0; d < space.space.axes.size() && d < space.axes.size(); ++d) {
            const float value = space.space.samples[s][d];
            switch (space.axes[d]) {
                case RequestAxis::speed:  // of a space without a sideways axis: straight along the facing
                    velocity = {0, velocity.y, value};
                    break;
                case RequestAxis::forward:
                    velocity.z = value;
                    break;
                case RequestAxis::lateral:
                    velocity.x = value;
                    break;
                case RequestAxis::turn:
                    turn = value * k_radians_per_degree;
                    break;
                case RequestAxis::pace:
                    pace = value;
                    break;
                case RequestAxis::travel:
                    travel = value * k_radians_per_degree;
                    break;
                case RequestAxis::slope:  // a clip climbs as it does
                case RequestAxis::custom:
                case RequestAxis::none:
                    break;
            }
        }
        if (has_direction) velocity = {pace * sin(travel), velocity.y, pace * cos(travel)};
    }
}

LocomotionSpace join(SpaceDefinition definition, const std::vector<PackedClip>& clips,
                     std::vector<std::string>& custom_names) {
    LocomotionSpace space;
    space.space = std::move(definition.space);
    space.clips = std::move(definition.clips);
    for (std::size_t d = 0; d < space.space.axes.size() && d < space.axes.size(); ++d) {
        space.axes[d] = axis_of(space.space.axes[d].name);
        space.has_turn |= space.axes[d] == RequestAxis::turn;
        if (space.axes[d] != RequestAxis::custom) continue;
        const std::string& name = space.space.axes[d].name;
        const auto known = std::find(custom_names.begin(), custom_names.end(), name);
        space.custom_slots[d] = static_cast<std::uint8_t>(known - custom_names.begin());
        if (known == custom_names.end()) custom_names.push_back(name);
    }
    declare_motion(space, clips);
    return space;
}
LocomotionSpace join(SpaceDefinition definition, LocomotionGraph& graph) {
    return join(std::move(definition), graph.clips, graph.custom_names);
}

/// In each quadrant of directions the smallest angle between the facing (or its opposite) and a sample's velocity.
std::array<float, 4> measure_side_travel(const LocomotionSpace& lateral) {
    constexpr float k_half_pi = static_cast<float>(0.5 * k_pi);
    constexpr float k_least = 0.26f;  // [rad] 15 degrees: nearer to ahead, a clip belongs to the facing space
    std::array<float, 4> angles;
    angles.fill(k_half_pi);
    for (const Vec3 v : lateral.velocities) {
        const float forward = v.z, side = v.x;
        if (planar_length(v) < 0.1f) continue;  // stands
        const float angle = atan2(std::fabs(side), std::fabs(forward));
        if (angle < k_least) continue;
        float& smallest = angles[(side < 0 ? 1u : 0u) + (forward < 0 ? 2u : 0u)];
        smallest = std::min(smallest, angle);
    }
    return angles;
}

std::string problem_of(const LocomotionSpace& space, std::size_t clips, const char* name) {
    const std::string where = std::string("space '") + name + "' ";
    if (space.empty()) return {};
    if (std::string text = problem(space.space); !text.empty()) return where + "is unsound: " + text;
    if (space.clips.size() != space.space.samples.size()) return where + "has samples without clips";
    for (const std::int32_t clip : space.clips)
        if (clip < 0 || static_cast<std::size_t>(clip) >= clips) return where + "names a clip that is not there";
    for (std::size_t d = 0; d < space.space.axes.size(); ++d)
        if (space.axes[d] == RequestAxis::none || space.custom_slots[d] >= k_max_custom_axes)
            return where + "has an axis '" + space.space.axes[d].name + "' that no request can set";
    if (space.velocities.size() != space.clips.size() || space.turns.size() != space.clips.size())
        return where + "has samples without velocities";
    return {};
}

std::string problem_of(const LocomotionStyle& style, const LocomotionGraph& graph) {
    const std::string where = "style '" + style.name + "' ";
    if (style.space.empty()) return where + "has no clips";
    if (std::string text = problem_of(style.space, graph.clips.size(), style.name.c_str()); !text.empty()) return text;
    if (style.space.space.dimensions() != 1 || style.space.axes[0] != RequestAxis::speed)
        return where + "is not a space over speed alone";
    if (style.mask.empty()) return {};
    if (style.mask.size() != graph.skeleton->rest.size()) return where + "has a mask that does not match the joints";
    for (const float share : style.mask)
        if (!(share >= 0 && share <= 1)) return where + "has a mask with values outside 0 to 1";
    for (std::size_t i = 0; i < static_cast<std::size_t>(graph.legs.count); ++i)
        if (style.mask[static_cast<std::size_t>(graph.legs.joint[i])] > 0)
            return where + "masks '" + graph.skeleton->names[static_cast<std::size_t>(graph.legs.joint[i])] +
                   "': hips and legs are the locomotion's, or the whole body is the style's";
    return {};
}

}  // namespace

LocomotionGraph make_locomotion_graph(std::shared_ptr<const Skeleton> skeleton, std::vector<PackedClip> clips,
                                      SpaceDefinition facing, SpaceDefinition lateral) {
    LocomotionGraph graph;
    graph.skeleton = std::move(skeleton);
    graph.clips = std::move(clips);
    graph.facing = join(std::move(facing), graph);
    graph.lateral = join(std::move(lateral), graph);
    graph.side_travel = measure_side_travel(graph.lateral);
    return graph;
}

LocomotionSpace join_clips(SpaceDefinition definition, const std::vector<PackedClip>& clips) {
    std::vector<std::string> names;
    return join(std::move(definition), clips, names);
}

void add_style(LocomotionGraph& graph, std::string name, SpaceDefinition definition, std::vector<float> mask) {
    graph.styles.push_back({std::move(name), join(std::move(definition), graph), std::move(mask)});
}

void set_legs(LocomotionGraph& graph, const Legs& legs, std::span<const Transform> standing) {
    graph.legs = make_leg_paths(*graph.skeleton, legs, standing);
}

std::string problem(const LocomotionGraph& graph) {
    if (!graph.skeleton) return "the graph has no skeleton";
    if (std::string text = problem(*graph.skeleton); !text.empty()) return text;
    for (const PackedClip& clip : graph.clips) {
        if (std::string text = problem(clip); !text.empty()) return text;
        if (clip.joint_count != graph.skeleton->joint_count())
            return "clip '" + clip.name + "' has another number of joints than the skeleton";
    }
    if (std::string text = problem(graph.legs, *graph.skeleton); !text.empty()) return text;
    if (graph.custom_names.size() > static_cast<std::size_t>(k_max_custom_axes))
        return "the graph's spaces have " + std::to_string(graph.custom_names.size()) + " axes of their own, from '" +
               graph.custom_names.front() + "' to '" + graph.custom_names.back() + "', and a request has room for " +
               std::to_string(k_max_custom_axes);
    if (graph.facing.empty() && graph.lateral.empty()) return "the graph has no blend space with samples";
    if (std::string text = problem_of(graph.facing, graph.clips.size(), "facing"); !text.empty()) return text;
    if (std::string text = problem_of(graph.lateral, graph.clips.size(), "lateral"); !text.empty()) return text;
    for (const LocomotionStyle& style : graph.styles)
        if (std::string text = problem_of(style, graph); !text.empty()) return text;
    return {};
}

}  // namespace surefoot
