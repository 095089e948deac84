#include <surefoot/author/place.h>
#include <surefoot/base/error.h>
#include <surefoot/space/lock_edge.h>
#include <surefoot/space/triangulate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

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
        if (axis.name == "lateral" || axis.name == "forward" || axis.name == "travel") return "lateral";
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

/// The sample of the clip of that name, or -1.
int sample_named(const Project& project, const ProjectSpace& space, const std::string& name) {
    for (std::size_t i = 0; i < space.clips.size(); ++i)
        if (project.clips[space.clips[i]].name == name) return static_cast<int>(i);
    return -1;
}

std::string quoted(const Project& project, const ProjectSpace& space, std::span<const int> samples) {
    std::string text;
    for (const int s : samples) text += (text.empty() ? "\"" : ", \"") + project.clips[space.clips[s]].name + "\"";
    return text;
}

/// What the user set about the space, on the samples that it has now.
void take_choices(const Project& project, const Project& before, const ProjectSpace& old, ProjectSpace& space,
                  std::vector<std::string>& warnings) {
    space.space.weighting = old.space.weighting;
    space.space.outside = old.space.outside;
    space.space.extrapolation_bound = old.space.extrapolation_bound;
    const auto found_again = [&](std::span<const int> samples, const char* what, auto& kept) {
        std::vector<int> now;
        for (const int s : samples) now.push_back(sample_named(project, space, before.clips[old.clips[s]].name));
        if (std::find(now.begin(), now.end(), -1) == now.end())
            std::copy(now.begin(), now.end(), kept.begin());
        else
            warnings.push_back(fmt::format("the locked {} between {} could not be kept in space \"{}\": a clip is gone",
                                           what, quoted(before, old, samples), space.name));
        return std::find(now.begin(), now.end(), -1) == now.end();
    };
    for (const auto& edge : old.locked_edges)
        if (std::array<int, 2> kept{}; found_again(edge, "edge", kept)) space.locked_edges.push_back(kept);
    for (const auto& simplex : old.locked_simplices)
        if (std::vector<int> kept(simplex.size()); found_again(simplex, "simplex", kept))
            space.locked_simplices.push_back(kept);
}

bool is_motion_axis(const std::string& name) {
    return name == "speed" || name == "turn" || name == "forward" || name == "lateral" || name == "pace";
}

/// Standing has no direction: an idle is there in each direction that some clip moves in.
void spread_standing(const Project& project, ProjectSpace& space) {
    const auto& axes = space.space.axes;
    const auto found = std::find_if(axes.begin(), axes.end(), [](const Axis& axis) { return axis.name == "travel"; });
    if (found == axes.end()) return;
    const auto travel = static_cast<std::size_t>(found - axes.begin());
    std::set<float> directions;
    for (std::size_t i = 0; i < space.clips.size(); ++i)
        if (!is_standing(project.clips[space.clips[i]].facts)) directions.insert(space.space.samples[i][travel]);
    const std::size_t count = space.clips.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_standing(project.clips[space.clips[i]].facts)) continue;
        SpacePoint point = space.space.samples[i];
        for (const float direction : directions) {
            if (direction == *directions.begin()) {
                space.space.samples[i][travel] = direction;
                continue;
            }
            point[travel] = direction;
            space.space.samples.push_back(point);
            space.clips.push_back(space.clips[i]);
        }
    }
}

/// An axis of the user's own that is spelt otherwise than in the sidecars must not pass for one where all clips are 0.
void check_values(const Project& project, const std::vector<int>& clips, const Axis& axis,
                  std::vector<std::string>& warnings) {
    std::set<std::string> known;
    std::string without;
    std::size_t missing = 0;
    for (const int c : clips) {
        for (const auto& [name, value] : project.clips[c].facts.custom) known.insert(name);
        if (!std::isnan(axis_value(project.clips[c].facts, axis.name))) continue;
        if (++missing <= 5) without += (without.empty() ? "\"" : ", \"") + project.clips[c].name + "\"";
    }
    if (missing == 0) return;
    if (missing == clips.size()) {
        std::string names = "speed, turn, forward, lateral, slope, pace, travel";
        for (const std::string& name : known) names += ", " + name;
        throw Error("no clip has a number \"" + axis.name + "\"", "--axes",
                    "use " + names + ", or write {\"" + axis.name + "\": 0.5} into CLIP.surefoot.json beside a clip");
    }
    if (missing > 5) without += fmt::format(" and {} more", missing - 5);
    warnings.push_back(fmt::format("{} of {} clips have no number \"{}\" and count as 0: {}", missing, clips.size(),
                                   axis.name, without));
}

ProjectSpace build_space(const Project& project, std::string name, std::vector<Axis> axes, std::vector<int> clips,
                         const Project* before, std::vector<std::string>& warnings) {
    ProjectSpace space;
    space.name = std::move(name);
    space.clips = std::move(clips);
    const ProjectSpace* old = before ? before->find_space(space.name) : nullptr;
    for (Axis& axis : axes) {
        check_values(project, space.clips, axis, warnings);
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
        for (int k = 0; k < space.space.dimensions(); ++k) {
            const std::string& axis = space.space.axes[k].name;
            const float value = axis_value(clip.facts, axis);
            // Whatever an idle drifts is no travel: it stands exactly at the origin.
            point[k] = std::isnan(value) || (is_idle(clip.facts) && is_motion_axis(axis)) ? 0 : value;
        }
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
    spread_standing(project, space);
    if (old) take_choices(project, *before, *old, space, warnings);
    triangulate_locked(project, space, warnings);
    return space;
}

}  // namespace

void triangulate_locked(const Project& project, ProjectSpace& space, std::vector<std::string>& warnings) {
    const auto originals = static_cast<std::size_t>(space.space.original_count());
    space.space.samples.resize(originals);
    space.clips.resize(originals);
    add_wrap_copies(space.space);
    for (std::size_t i = originals; i < space.space.samples.size(); ++i)
        space.clips.push_back(space.clips[static_cast<std::size_t>(space.space.copy_of[i])]);
    triangulate(space.space);

    const auto wanted_edges = std::exchange(space.locked_edges, {});
    const auto wanted_simplices = std::exchange(space.locked_simplices, {});
    std::vector<std::array<std::int32_t, 2>> held;
    for (const auto& edge : wanted_edges) {
        if (!lock_edge(space.space, edge[0], edge[1], held)) {
            warnings.push_back(fmt::format("the locked edge between {} could not be kept in space \"{}\"",
                                           quoted(project, space, edge), space.name));
            continue;
        }
        space.locked_edges.push_back(edge);
        held.push_back(edge);
    }
    for (const auto& simplex : wanted_simplices) {
        if (!lock_simplex(space.space, simplex, held)) {
            warnings.push_back(
                fmt::format("the locked simplex between {} could not be kept in space \"{}\": {}",
                            quoted(project, space, simplex), space.name,
                            space.space.dimensions() == 2
                                ? "a sample lies in it, or another locked edge crosses it"
                                : "it is not among the simplices, and in more than two dimensions none can be forced"));
            continue;
        }
        space.locked_simplices.push_back(simplex);
        for (std::size_t i = 0; i < simplex.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) held.push_back({simplex[i], simplex[j]});
    }
}

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
    if (axis == "pace") return std::fabs(facts.speed);
    if (axis == "travel") return facts.travel;
    const auto own = facts.custom.find(std::string(axis));
    return own != facts.custom.end() ? own->second : std::nanf("");
}

Axis make_axis(std::string_view name) {
    for (const char* speed : {"speed", "forward", "lateral", "pace"})
        if (name == speed) return {speed, "m/s", 0, 1, false};
    if (name == "turn") return {"turn", "deg/s", -90, 90, false};
    if (name == "slope") return {"slope", "deg", -15, 15, false};
    if (name == "travel") return {"travel", "deg", -180, 180, true};
    if (name.empty())
        throw Error("an axis has no name", "--axes",
                    "use speed, turn, forward, lateral, slope, or a number of your own");
    return {std::string(name), "", 0, 1, false};
}

namespace {

/// 1, 2 or 5 times a power of ten, a fifth of `range` or a little less.
double round_step(double range) {
    double step = 1;
    while (step > 0.2 * range) step /= 10;
    while (10 * step <= 0.2 * range) step *= 10;
    return 5 * step <= 0.2 * range ? 5 * step : 2 * step <= 0.2 * range ? 2 * step : step;
}

}  // namespace

void set_limits(Axis& axis, std::span<const float> values) {
    if (axis.name == "travel") return;  // the whole circle
    // Steps a person would choose, and the least range that an axis is drawn with.
    const bool is_turn = axis.name == "turn", is_slope = axis.name == "slope", is_own = axis.unit.empty();
    const bool symmetric = is_turn || is_slope || axis.name == "lateral";
    double low = 0, high = is_turn ? 90 : is_slope ? 5 : is_own ? 0 : 0.5;
    for (const float v : values) {
        if (std::isnan(v)) continue;
        low = std::min<double>(low, v);
        high = std::max<double>(high, v);
    }
    if (is_own && !(high - low > 1e-6)) high = 1;
    const double step = is_turn ? 30 : is_slope ? 5 : is_own ? round_step(high - low) : 0.5;
    constexpr double k_rounding = 1e-3;  // of a step: 1.5000001 stays 1.5
    low = std::floor(low / step + k_rounding) * step;
    high = std::ceil(high / step - k_rounding) * step;
    if (symmetric) high = std::max(high, -low), low = -high;
    axis.low = static_cast<float>(low) + 0.0f;  // no -0
    axis.high = static_cast<float>(high);
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
        } else if (name == "slope") {
            add(zero ? "on the level" : fmt::format("{:.0f} deg {}", std::fabs(v), v < 0 ? "downhill" : "uphill"));
        } else if (name == "travel") {
            add(std::fabs(v) < 0.5f ? "straight ahead"
                                    : fmt::format("{:.0f} deg to its {}", std::fabs(v), v < 0 ? "right" : "left"));
        } else {
            const std::string unit = axes[k].unit.empty() ? "" : " " + axes[k].unit;
            add(name == "pace" ? fmt::format("at {:.2f} m/s", v) : fmt::format("{} {:.2f}{}", name, v, unit));
        }
    }
    return text;
}

}  // namespace surefoot
