#include <surefoot/author/place.h>
#include <surefoot/base/error.h>
#include <surefoot/space/lock_edge.h>
#include <surefoot/space/triangulate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

bool is_standing(const ClipFacts& facts) { return std::fabs(facts.speed) < k_standing_speed; }

/// Below this a turn may be measurement: in-place clips give up their turn to within 8 deg/s walking and 30 running.
float turn_doubt(const ClipFacts& facts) {
    constexpr float k_running = 2.5f, k_doubt_running = 30;  // [m/s], [deg/s]
    return facts.in_place && std::fabs(facts.speed) > k_running ? k_doubt_running : k_standing_turn;
}

std::vector<Axis> parse_axes(const std::string& text) {
    std::vector<Axis> axes;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        axes.push_back(make_axis(text.substr(from, comma - from)));
        from = comma + 1;
    }
    if (axes.size() > static_cast<std::size_t>(k_max_dimensions))
        throw Error("a blend space has at most four axes, \"" + text + "\" names more", "--axes", "leave some out");
    for (std::size_t i = 0; i < axes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (axes[i].name == axes[j].name)
                throw Error("\"" + text + "\" names an axis twice", "--axes", "name each axis once");
    return axes;
}

std::string space_name(const std::vector<Axis>& axes) {
    for (const Axis& axis : axes)
        if (axis.name == "lateral" || axis.name == "forward") return "lateral";
    return "facing";
}

std::vector<float> values_of(const Project& project, const std::vector<int>& clips, const std::string& axis) {
    std::vector<float> values;
    for (const int c : clips) values.push_back(axis_value(project.clips[c].facts, axis));
    return values;
}

float largest(const std::vector<float>& values) {
    float most = 0;
    for (const float v : values) most = std::max(most, std::fabs(v));
    return most;
}

/// Drops the axis along which the clips do not differ enough to span it.
void drop_flat_axis(std::vector<Axis>& axes, const Project& project, const std::vector<int>& clips) {
    if (axes.size() != 2) return;
    const float first = largest(values_of(project, clips, axes[0].name));
    const float second = largest(values_of(project, clips, axes[1].name));
    if (axes[0].name == "speed") {
        const bool turns = std::any_of(clips.begin(), clips.end(), [&](int c) {
            return std::fabs(project.clips[c].facts.turn) >= turn_doubt(project.clips[c].facts);
        });
        if (!turns)
            axes.pop_back();
        else if (first < k_standing_speed)
            axes.erase(axes.begin());
    } else {
        // Strafes drift: sideways within about 11 degrees is on the axis.
        constexpr float k_drift = 0.2f;
        if (first <= k_drift * second) axes.erase(axes.begin());
    }
}

void locked_edges_from(const Project& project, const Project& before, const ProjectSpace& old, ProjectSpace& space,
                       std::vector<std::string>& warnings) {
    for (const auto& [a, b] : old.locked_edges) {
        const std::string names[2] = {before.clips[old.clips[a]].name, before.clips[old.clips[b]].name};
        int sample[2] = {-1, -1};
        for (int e = 0; e < 2; ++e)
            for (std::size_t i = 0; i < space.clips.size(); ++i)
                if (project.clips[space.clips[i]].name == names[e]) sample[e] = static_cast<int>(i);
        const bool kept =
            sample[0] >= 0 && sample[1] >= 0 && lock_edge(space.space, sample[0], sample[1], space.locked_edges);
        if (kept)
            space.locked_edges.push_back({sample[0], sample[1]});
        else
            warnings.push_back(
                fmt::format("the locked edge between \"{}\" and \"{}\" could not be kept in space \"{}\"", names[0],
                            names[1], space.name));
    }
}

ProjectSpace build_space(const Project& project, std::string name, std::vector<Axis> axes, std::vector<int> clips,
                         const Project* before, std::vector<std::string>& warnings) {
    ProjectSpace space;
    space.name = std::move(name);
    space.clips = std::move(clips);
    const ProjectSpace* old = before ? before->find_space(space.name) : nullptr;
    for (Axis& axis : axes) {
        const std::vector<float> values = values_of(project, space.clips, axis.name);
        set_limits(axis, values);
        if (!old || !old->axes_pinned) continue;
        for (const Axis& pinned : old->space.axes)
            if (pinned.name == axis.name) axis = pinned, space.axes_pinned = true;
    }
    space.space.axes = std::move(axes);
    for (const int c : space.clips) {
        const ProjectClip& clip = project.clips[c];
        SpacePoint point{};
        for (int k = 0; k < space.space.dimensions(); ++k)
            // Whatever an idle drifts is no travel: it stands exactly at the origin.
            point[k] = is_idle(clip.facts) ? 0 : axis_value(clip.facts, space.space.axes[k].name);
        for (const PinnedPlace& pin : clip.pins) {
            if (pin.space != space.name) continue;
            if (pin.values.size() == space.space.axes.size())
                std::copy(pin.values.begin(), pin.values.end(), point.begin());
            else
                warnings.push_back(fmt::format("\"{}\" is pinned with {} values but space \"{}\" has {} axes: not used",
                                               clip.name, pin.values.size(), space.name, space.space.axes.size()));
        }
        space.space.samples.push_back(point);
    }
    triangulate(space.space);
    if (old) locked_edges_from(project, *before, *old, space, warnings);
    return space;
}

}  // namespace

bool is_facing(const ClipFacts& facts) {
    const float off = std::fabs(facts.travel);
    return is_standing(facts) || off <= k_facing_travel || off >= 180 - k_facing_travel;
}

bool is_idle(const ClipFacts& facts) { return is_standing(facts) && std::fabs(facts.turn) < k_standing_turn; }

float axis_value(const ClipFacts& facts, std::string_view axis) {
    if (axis == "speed") return facts.speed;
    if (axis == "turn") return facts.turn;
    if (axis == "forward") return facts.forward;
    if (axis == "lateral") return facts.lateral;
    if (axis == "slope") return facts.slope;
    return std::nanf("");
}

Axis make_axis(std::string_view name) {
    for (const char* speed : {"speed", "forward", "lateral"})
        if (name == speed) return {speed, "m/s", 0, 1, false};
    if (name == "turn") return {"turn", "deg/s", -90, 90, false};
    if (name == "slope") return {"slope", "deg", -15, 15, false};
    throw Error("there is no axis \"" + std::string(name) + "\"", "--axes",
                "use speed, turn, forward, lateral or slope, with commas between");
}

void set_limits(Axis& axis, std::span<const float> values) {
    // Steps a person would choose, and the least range that an axis is drawn with.
    const bool is_turn = axis.name == "turn", is_slope = axis.name == "slope";
    const float step = is_turn ? 30.0f : is_slope ? 5.0f : 0.5f;
    const bool symmetric = is_turn || is_slope || axis.name == "lateral";
    float low = 0, high = is_turn ? 90.0f : is_slope ? 5.0f : 0.5f;
    for (const float v : values) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    constexpr float k_rounding = 1e-3f;  // of a step: 1.5000001 stays 1.5
    low = std::floor(low / step + k_rounding) * step;
    high = std::ceil(high / step - k_rounding) * step;
    if (symmetric) high = std::max(high, -low), low = -high;
    axis.low = low + 0.0f;  // no -0
    axis.high = high;
}

namespace {

/// One space over speed for each style that clips show.
void place_styles(Project& project, const Project* before, std::vector<std::string>& warnings) {
    std::map<std::string, std::vector<int>> styles;
    for (std::size_t c = 0; c < project.clips.size(); ++c)
        if (const ProjectClip& clip = project.clips[c]; !clip.excluded && !clip.style.empty())
            styles[clip.style].push_back(static_cast<int>(c));
    for (auto& [name, clips] : styles) {
        const bool upper_body = project.clips[static_cast<std::size_t>(clips.front())].upper_body;
        ProjectSpace space = build_space(project, std::string(k_style_prefix) + name, {make_axis("speed")},
                                         std::move(clips), before, warnings);
        space.upper_body = upper_body;
        project.spaces.push_back(std::move(space));
    }
}

void place_locomotion(Project& project, std::span<const std::string> axes, const Project* before,
                      std::vector<std::string>& warnings) {
    std::vector<int> all, facing, sideways, idles;
    for (std::size_t c = 0; c < project.clips.size(); ++c) {
        if (project.clips[c].excluded || !project.clips[c].style.empty()) continue;
        const ClipFacts& facts = project.clips[c].facts;
        const auto index = static_cast<int>(c);
        all.push_back(index);
        if (is_idle(facts)) idles.push_back(index);
        (is_facing(facts) ? facing : sideways).push_back(index);
    }
    if (all.empty()) return;
    if (!axes.empty()) {
        for (const std::string& text : axes) {
            std::vector<Axis> parsed = parse_axes(text);
            const std::string name = space_name(parsed);
            if (project.find_space(name))
                throw Error("two of the spaces asked for would both be \"" + name + "\"", "--axes",
                            "ask for one of them");
            project.spaces.push_back(build_space(project, name, std::move(parsed), all, before, warnings));
        }
        return;
    }
    if (!facing.empty() && (sideways.empty() || facing.size() > idles.size())) {
        std::vector<Axis> pair{make_axis("speed"), make_axis("turn")};
        drop_flat_axis(pair, project, facing);
        project.spaces.push_back(build_space(project, "facing", std::move(pair), facing, before, warnings));
    }
    if (!sideways.empty()) {
        std::vector<int> members = idles;
        members.insert(members.end(), sideways.begin(), sideways.end());
        std::sort(members.begin(), members.end());
        std::vector<Axis> pair{make_axis("forward"), make_axis("lateral")};
        drop_flat_axis(pair, project, members);
        project.spaces.push_back(build_space(project, "lateral", std::move(pair), members, before, warnings));
    }
}

}  // namespace

void place_clips(Project& project, std::span<const std::string> axes, const Project* before,
                 std::vector<std::string>& warnings) {
    project.spaces.clear();
    place_locomotion(project, axes, before, warnings);
    if (!project.spaces.empty()) place_styles(project, before, warnings);
}

float liveliness(const ClipFacts& facts) {
    constexpr float k_metres_per_degree = 0.01f;  // turning 100 deg/s is as lively as walking 1 m/s
    return std::fabs(facts.forward) + std::fabs(facts.lateral) + k_metres_per_degree * std::fabs(facts.turn);
}

bool moves_along_facing(std::span<const ProjectSpace> spaces, std::int32_t clip, const ClipFacts& facts) {
    bool along = false;
    for (const ProjectSpace& space : spaces) {
        if (std::find(space.clips.begin(), space.clips.end(), clip) == space.clips.end()) continue;
        const auto& axes = space.space.axes;
        if (std::none_of(axes.begin(), axes.end(), [](const Axis& a) { return a.name == "speed"; })) return false;
        along = true;
    }
    const float off = std::fabs(facts.travel);
    return along && (off < 45.0f || off > 135.0f);
}

std::string describe_place(std::span<const Axis> axes, std::span<const float> values) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    for (std::size_t k = 0; k < axes.size() && k < values.size(); ++k) {
        const float v = values[k];
        const std::string& name = axes[k].name;
        const bool zero = std::fabs(v) < (name == "turn" ? 0.05f : 0.005f);
        if (name == "speed" || name == "forward") {
            if (!zero)
                add(fmt::format("{:.2f} m/s {}", std::fabs(v), v < 0 ? "backward" : "forward"));
            else
                add(name == "speed" ? "on the spot" : "neither forward nor backward");
        } else if (name == "lateral") {
            if (!zero) add(fmt::format("{:.2f} m/s to its {}", std::fabs(v), v < 0 ? "right" : "left"));
        } else if (name == "turn") {
            if (!zero)
                add(fmt::format("turning {:.0f} deg/s to its {}", std::fabs(v), v < 0 ? "right" : "left"));
            else
                add("without turning");
        } else {
            add(fmt::format("{} {:.1f} {}", name, v, axes[k].unit));
        }
    }
    return text;
}

}  // namespace surefoot
