// Plans that make clips which nobody recorded.

#include <surefoot/analysis/measure.h>
#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>
#include <surefoot/author/repair_planner.h>
#include <surefoot/math/trig.h>
#include <surefoot/motion/edit.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace surefoot {
namespace {

constexpr double k_near = 8;         // [%] how far from the place asked for a whole clip may lie that is made for it
constexpr float k_most_turn = 60;    // [deg/s] by which a path may be bent
constexpr double k_most_pace = 0.2;  // share by which steps may be stretched
constexpr float k_spot_turn = 90;    // [deg/s] of a turn on the spot, where none is asked for
constexpr std::size_t k_most_plans = 6;

ClipFacts doing(const ClipFacts& facts, float forward, float lateral, float turn) {
    ClipFacts result = facts;
    set_travel(result, forward, lateral);
    result.turn = turn;
    return result;
}

double percent_apart(const ProjectSpace& space, std::span<const float> a, std::span<const float> b) {
    const PercentSpace percent(space);
    double square = 0;
    for (int k = 0; k < percent.dimensions(); ++k) {
        const double off = percent.percent(
            static_cast<double>(a[static_cast<std::size_t>(k)]) - static_cast<double>(b[static_cast<std::size_t>(k)]),
            k);
        square += off * off;
    }
    return std::sqrt(square);
}

struct Ranked {
    double cost;
    RepairPlan plan;
};

void keep_best(std::vector<Ranked>& ranked, std::vector<RepairPlan>& plans) {
    std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
    for (std::size_t i = 0; i < ranked.size() && i < k_most_plans; ++i) plans.push_back(std::move(ranked[i].plan));
}

/// Mirrored, reversed, or both: what a clip does then is known beforehand. `free_axis` (or -1) is the axis along which
/// a clip may stand elsewhere than asked: the end of an axis is where its farthest clip is.
void plan_images(const Workbench& bench, const ProjectSpace& space, std::span<const float> target, int free_axis,
                 std::vector<Ranked>& ranked) {
    for (const RepairSource& source : sources(bench)) {
        const ClipFacts& f = source.clip->facts;
        if (is_idle(f)) continue;
        for (const bool reversed : {false, true})
            for (const bool mirrored : {true, false}) {
                if (!reversed && !mirrored) continue;
                const float along = reversed ? -1.0f : 1.0f, side = (mirrored ? -1.0f : 1.0f) * along;
                const ClipFacts image = doing(f, along * f.forward, side * f.lateral, side * f.turn);
                if (is_facing(image) != (space.name != "lateral") && space.name == "facing") continue;
                const std::vector<float> place = place_of(space, image);
                std::vector<float> asked(target.begin(), target.end());
                double cost = 0;
                if (free_axis >= 0) {
                    const auto k = static_cast<std::size_t>(free_axis);
                    if (place[k] * asked[k] <= 0) continue;
                    cost = 0.1 * percent_apart(space, place, asked);
                    asked[k] = place[k];
                }
                const double off = percent_apart(space, place, asked);
                if (!(off <= k_near)) continue;
                cost += off + (reversed ? 4.0 : 0.0) + (reversed && mirrored ? 4.0 : 0.0);
                Planner planner(bench);
                std::string from = source.clip->name;
                if (mirrored) from = planner.make("mirror", {from}, {});
                const std::string image_name = from;
                if (reversed) from = planner.make("reverse", {from}, {});
                planner.expect(space.space.axes, place);
                if (mirrored && reversed)
                    planner.exclude(image_name, fmt::format("only made to make \"{}\" of it", from));
                ranked.push_back({cost, planner.done(fmt::format("\"{}\" made by {} \"{}\"", from,
                                                                 mirrored && reversed ? "mirroring and reversing"
                                                                 : mirrored           ? "mirroring"
                                                                                      : "playing backwards",
                                                                 source.clip->name))});
            }
    }
}

/// A clip that nearly does it, played faster or slower, or on another path.
void plan_changes(const Workbench& bench, const ProjectSpace& space, std::span<const float> target,
                  std::vector<Ranked>& ranked) {
    const auto asked = [&](const char* axis) -> std::optional<float> {
        for (std::size_t k = 0; k < space.space.axes.size(); ++k)
            if (space.space.axes[k].name == axis) return target[k];
        return {};
    };
    for (const RepairSource& source : sources(bench)) {
        const ClipFacts& f = source.clip->facts;
        if (is_idle(f)) continue;
        // "speed" is along the facing in the one space, "forward" and "lateral" are apart in the other.
        const auto forward = asked("speed") ? asked("speed") : asked("forward");
        const auto lateral = asked("lateral");
        const auto turn = asked("turn");
        const float pace = std::fabs(f.speed);
        if (forward && lateral && is_facing(f) == false && pace > 0.1f) {
            const float wanted = std::sqrt(*forward * *forward + *lateral * *lateral);
            const float rate = wanted / pace;
            const ClipFacts then = doing(f, rate * f.forward, rate * f.lateral, rate * f.turn);
            if (rate >= k_slowest_retime && rate <= k_fastest_retime &&
                percent_apart(space, place_of(space, then), target) <= k_near) {
                Planner planner(bench);
                const std::string made = planner.make("retime", {source.clip->name}, {{"rate", rate}});
                planner.expect(space.space.axes, place_of(space, then));
                ranked.push_back({10 + 10 * std::fabs(static_cast<double>(rate) - 1),
                                  planner.done(fmt::format("\"{}\" made by playing \"{}\" {:.2f} times as fast", made,
                                                           source.clip->name, rate))});
            }
        }
        std::map<std::string, double> path;
        double bend = 0;
        if (turn && std::fabs(*turn - f.turn) > 0.5f) {
            bend += static_cast<double>(std::fabs(*turn - f.turn) / k_most_turn);
            if (std::fabs(*turn - f.turn) > k_most_turn) continue;
            path["turn_deg_s"] = static_cast<double>(*turn);
        }
        if (forward && std::fabs(*forward - f.forward) > 0.01f) {
            const double share =
                static_cast<double>(std::fabs(*forward - f.forward)) / std::max(static_cast<double>(pace), 0.1);
            if (share > k_most_pace) continue;
            bend += share / k_most_pace;
            path["forward_mps"] = static_cast<double>(*forward);
        }
        const float aside = lateral.value_or(0);
        if (std::fabs(aside - f.lateral) > 0.01f && (lateral || std::fabs(f.lateral) < 0.2f * pace)) {
            const double share =
                static_cast<double>(std::fabs(aside - f.lateral)) / std::max(static_cast<double>(pace), 0.1);
            if (share > k_most_pace) continue;
            bend += share / k_most_pace;
            path["lateral_mps"] = static_cast<double>(aside);
        }
        if (path.empty() || bend > 1.5) continue;
        Planner planner(bench);
        const std::string made = planner.make("steer", {source.clip->name}, path);
        planner.expect(space.space.axes, target);
        ranked.push_back({12 + 8 * bend, planner.done(fmt::format("\"{}\" made by bending the path of \"{}\"", made,
                                                                  source.clip->name))});
    }
}

/// Delicado & Pelechano, §3.2.1: between the two nearest samples on the axis on either side, by their distances.
void plan_interpolation(const Workbench& bench, const ProjectSpace& space, std::span<const float> target, int axis,
                        double on_axis, std::vector<RepairPlan>& plans) {
    const PercentSpace percent(space);
    SpacePoint at{};
    std::copy(target.begin(), target.end(), at.begin());
    std::array<int, 2> best{-1, -1};
    double shortest = std::numeric_limits<double>::infinity();
    for (int a = 0; a < percent.count(); ++a)
        for (int b = a + 1; b < percent.count(); ++b) {
            if (std::fabs(percent.at(a, axis)) > on_axis || std::fabs(percent.at(b, axis)) > on_axis) continue;
            const SpacePoint &p = space.space.samples[static_cast<std::size_t>(a)],
                             &q = space.space.samples[static_cast<std::size_t>(b)];
            const double whole = percent.distance(p, q), to_a = percent.distance(p, at), to_b = percent.distance(q, at);
            // On either side, and the place is on the way from one to the other.
            const bool between = to_a < whole && to_b < whole && to_a + to_b < whole + on_axis;
            if (between && whole < shortest) shortest = whole, best = {a, b};
        }
    if (best[0] < 0) return;
    const auto sample = [&](int i) { return space.space.samples[static_cast<std::size_t>(i)]; };
    const double to_a = percent.distance(sample(best[0]), at), to_b = percent.distance(sample(best[1]), at);
    const auto name = [&](int i) {
        return bench.project.clips[static_cast<std::size_t>(space.clips[static_cast<std::size_t>(i)])].name;
    };
    for (const bool planted : {false, true}) {
        Planner planner(bench);
        std::string made = planner.make("interpolate", {name(best[0]), name(best[1])},
                                        {{"weight_0", to_b / (to_a + to_b)}, {"weight_1", to_a / (to_a + to_b)}});
        if (planted) {
            const std::string mixed = made;
            made = planner.make("plant", {mixed}, {});
            planner.exclude(mixed, fmt::format("only made to make \"{}\" of it", made));
        }
        std::vector<float> promised;
        for (int k = 0; k < percent.dimensions(); ++k) {
            const auto i = static_cast<std::size_t>(k);
            promised.push_back(static_cast<float>(static_cast<double>(sample(best[0])[i]) * to_b / (to_a + to_b) +
                                                  static_cast<double>(sample(best[1])[i]) * to_a / (to_a + to_b)));
        }
        planner.expect(space.space.axes, promised);
        plans.push_back(planner.done(
            fmt::format("\"{}\" interpolated between \"{}\" and \"{}\"", made, name(best[0]), name(best[1]))));
    }
}

/// The straight walk that is nearest to a person's usual pace.
const RepairSource* walk_of(const std::vector<RepairSource>& all) {
    const RepairSource* best = nullptr;
    const auto unusual = [](const RepairSource& s) {
        constexpr float k_usual = 1.4f;  // [m/s]
        return std::fabs(s.clip->facts.speed - k_usual) + 0.02f * std::fabs(s.clip->facts.turn);
    };
    for (const RepairSource& source : all) {
        const ClipFacts& f = source.clip->facts;
        if (f.speed < 0.3f || std::fabs(f.travel) > 20 || !(f.cadence > 0)) continue;
        if (!best || unusual(source) < unusual(*best)) best = &source;
    }
    return best;
}

std::string idle_of(const std::vector<RepairSource>& all) {
    const auto idle =
        std::find_if(all.begin(), all.end(), [](const RepairSource& s) { return is_idle(s.clip->facts); });
    return idle != all.end() ? idle->clip->name : "";
}

/// A walk and its reverse, half and half, tread on the spot; with their feet held there and bent, they turn. Edges from
/// `idle` (empty: there is none) keep what goes forward apart from what goes backward. Returns the reverse, which is
/// left out unless the plan keeps it.
std::string make_turns_on_the_spot(Planner& planner, const std::string& space, const std::string& walk,
                                   const std::string& idle, float rate, bool keep_reverse) {
    const std::string back = planner.make("reverse", {walk}, {});
    const std::string mixed = planner.make("interpolate", {walk, back}, {{"weight_0", 0.5}, {"weight_1", 0.5}});
    const std::string treading = planner.make("plant", {mixed}, {});
    const std::vector<Axis> axes{make_axis("speed"), make_axis("turn")};
    for (const float side : {1.0f, -1.0f}) {
        const std::string turn = planner.make(
            "steer", {treading}, {{"turn_deg_s", side * rate}, {"forward_mps", 0.0}, {"lateral_mps", 0.0}});
        const float place[] = {0, side * rate};
        planner.expect(axes, place);
        if (!idle.empty()) planner.lock(space, idle, turn);
    }
    for (const std::string& ingredient : {back, mixed, treading})
        if (ingredient != back || !keep_reverse)
            planner.exclude(ingredient, "only made to make turns on the spot of it");
    return back;
}

bool is_in(const Workbench& bench, const ProjectSpace& space, const ProjectClip& clip) {
    return std::any_of(space.clips.begin(), space.clips.end(),
                       [&](int c) { return bench.project.clips[static_cast<std::size_t>(c)].name == clip.name; });
}

/// Both sides of a straight clip, exactly abreast of it: an edge past it by a hair would cross the axis. Who runs fast
/// cannot turn fast.
void bend_to_both_sides(Planner& planner, const std::string& clip, float speed, float most_turn) {
    constexpr float k_most_sideways = 4;  // [m/s^2] a runner leans by 22 degrees
    const float turn = std::min(most_turn, k_most_sideways / std::fabs(speed) * k_degrees_per_radian);
    const std::vector<Axis> axes{make_axis("speed"), make_axis("turn")};
    for (const float side : {1.0f, -1.0f}) {
        planner.make("steer", {clip},
                     {{"turn_deg_s", side * turn}, {"forward_mps", static_cast<double>(speed)}, {"lateral_mps", 0.0}});
        const float place[] = {speed, side * turn};
        planner.expect(axes, place);
    }
}

void plan_spot_turns(const Workbench& bench, const ProjectSpace& space, std::span<const float> target,
                     std::vector<RepairPlan>& plans) {
    const PercentSpace percent(space);
    const int turn = percent.axis("turn"), speed = percent.axis("speed");
    if (turn < 0 || speed < 0 || std::fabs(target[static_cast<std::size_t>(speed)]) > 0.1f) return;
    const std::vector<RepairSource> all = sources(bench);
    const RepairSource* walk = walk_of(all);
    const float rate = std::fabs(target[static_cast<std::size_t>(turn)]);
    if (!walk || rate < 20) return;
    Planner planner(bench);
    make_turns_on_the_spot(planner, space.name, walk->clip->name, idle_of(all), rate, false);
    plans.push_back(
        planner.done(fmt::format("turns on the spot made of \"{}\" and its reverse, half and half", walk->clip->name)));
}

}  // namespace

std::vector<RepairSource> sources(const Workbench& bench) {
    std::vector<RepairSource> result;
    for (std::size_t i = 0; i < bench.clips.size(); ++i) {
        const ProjectClip& clip = bench.project.clips[i];
        if (bench.clips[i] && !clip.excluded && clip.facts.cyclic) result.push_back({&clip, bench.clips[i].get()});
    }
    return result;
}

std::vector<float> place_of(const ProjectSpace& space, const ClipFacts& facts) {
    std::vector<float> place;
    for (const Axis& axis : space.space.axes) place.push_back(axis_value(facts, axis.name));
    return place;
}

void plan_second_dimension(const Workbench& bench, const ProjectSpace& space, std::vector<RepairPlan>& plans) {
    if (space.space.dimensions() != 1 || space.space.axes[0].name != "speed") return;
    const std::vector<RepairSource> all = sources(bench);
    const RepairSource* walk = walk_of(all);
    if (!walk) return;
    std::vector<RepairSource> straight;
    bool goes_back = false;
    for (const RepairSource& source : all)
        if (!is_idle(source.clip->facts) && is_in(bench, space, *source.clip)) {
            straight.push_back(source);
            goes_back |= source.clip->facts.speed < 0;
        }
    for (const bool every : {true, false})
        for (const float turn : {45.0f, 30.0f}) {
            Planner planner(bench);
            for (const RepairSource& source : every ? straight : std::vector<RepairSource>{*walk})
                bend_to_both_sides(planner, source.clip->name, source.clip->facts.speed, turn);
            const bool make_back = every && !goes_back;
            const std::string back =
                make_turns_on_the_spot(planner, space.name, walk->clip->name, idle_of(all), k_spot_turn, make_back);
            if (make_back) bend_to_both_sides(planner, back, -walk->clip->facts.speed, turn);
            plans.push_back(
                planner.done(fmt::format("turns of {:.0f} deg/s to either side bent from {}, and turns on the spot{}",
                                         turn, every ? "all clips that go straight" : "\"" + walk->clip->name + "\"",
                                         make_back ? ", and the walk played backwards" : "")));
        }
}

void plan_clip_at(const Workbench& bench, const ProjectSpace& space, const Finding& finding,
                  std::vector<RepairPlan>& plans) {
    const std::vector<float>& target = finding.fix->target;
    if (target.size() != space.space.axes.size()) return;
    const PercentSpace percent(space);
    constexpr double k_on_axis = 5;  // [%] the paper's tau_chi
    int free_axis = -1;
    for (int k = 0; k < percent.dimensions(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (finding.rule == "crossing-axis" && std::fabs(percent.percent(static_cast<double>(target[i]), k)) < 0.01)
            plan_interpolation(bench, space, target, k, k_on_axis, plans);
        if (finding.rule == "missing-axis-end" && target[i] != 0) free_axis = k;
    }
    std::vector<Ranked> ranked;
    plan_images(bench, space, target, free_axis, ranked);
    // A sliver is no reason to bend a clip: it would come to lie beside the one it was bent from.
    if (finding.rule != "acute-triangle") plan_changes(bench, space, target, ranked);
    keep_best(ranked, plans);
    plan_spot_turns(bench, space, target, plans);
}

}  // namespace surefoot
