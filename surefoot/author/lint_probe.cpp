// Rules about what the probe measured. One finding a rule and set of clips: its worst cell, and how many there are.

#include <surefoot/author/lint_context.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>

namespace surefoot {
namespace {

/// How far a cell is beyond its rule's threshold, 0 or less where it is not.
using Excess = std::function<double(const ProbeCell&)>;
using Message = std::function<std::string(const ProbeCell&)>;

/// A clip that goes wrong all but alone is to be mended itself; a blend wants a clip where it goes wrong.
std::optional<Fix> fix_for(const LintContext& context, const Finding& finding, const ProbeCell& cell) {
    constexpr float k_alone = 0.9f;
    if (cell.shares.front().weight > k_alone)
        return Fix{"remove", fmt::format("clean \"{}\", or replace it", finding.clips[0]), {}, {}, {finding.clips[0]}};
    const ProjectSpace* space = context.project().find_space(finding.space);
    if (space == nullptr || finding.at.size() != space->space.axes.size()) return {};
    return Fix{"add-clip", "add " + describe_clip(space->space.axes, finding.at), finding.space, finding.at,
               finding.clips};
}

void add_findings(LintContext& context, const ProbeSpace& space, const char* rule, const Excess& excess,
                  const Message& message) {
    struct Group {
        const ProbeCell* worst = nullptr;
        double excess = 0;
        int cells = 0;
    };
    std::map<std::vector<int>, Group> groups;  // by clips, ascending
    for (const ProbeCell& cell : space.cells) {
        const double over = excess(cell);
        if (!(over > 0)) continue;
        std::vector<int> clips;
        for (const ProbeShare& share : cell.shares) clips.push_back(share.clip);
        std::sort(clips.begin(), clips.end());
        Group& group = groups[clips];
        ++group.cells;
        if (over > group.excess) group.worst = &cell, group.excess = over;
    }
    for (const auto& [clips, group] : groups) {
        Finding finding;
        finding.rule = rule;
        finding.space = space.name;
        finding.at = group.worst->at;
        for (const ProbeShare& share : group.worst->shares) finding.clips.push_back(space.clips[share.clip]);
        finding.fix = fix_for(context, finding, *group.worst);
        finding.message = fmt::format("{} ({}; {} of {} blends probed)", message(*group.worst),
                                      describe_shares(space, *group.worst, "\""), group.cells, space.cells.size());
        context.add(std::move(finding));
    }
}

std::string place(const ProbeSpace& space, const ProbeCell& cell) {
    std::string text;
    for (std::size_t k = 0; k < cell.at.size(); ++k)
        text += fmt::format("{}{} {:.3g} {}", k ? ", " : "", space.axes[k].name, cell.at[k], space.axes[k].unit);
    return text;
}

/// What the blend adds to a figure of its clips: their own faults are found by other rules (root-disagrees).
double added(const ProbeCell& cell, ProbeFigure figure) {
    return std::fabs(static_cast<double>(cell.blend[figure]) - cell.sources[figure]);
}

void probe_speed(LintContext& context, const ProbeSpace& space) {
    const double most = context.threshold("probe-speed", "error");
    const auto slips = [](const ProbeCell& cell) {
        return added(cell, ProbeFigure::lateral) > added(cell, ProbeFigure::speed);
    };
    add_findings(
        context, space, "probe-speed",
        [&](const ProbeCell& cell) {
            return added(cell, slips(cell) ? ProbeFigure::lateral : ProbeFigure::speed) - most;
        },
        [&](const ProbeCell& cell) {
            const ProbeFigure figure = slips(cell) ? ProbeFigure::lateral : ProbeFigure::speed;
            const float error = cell.blend[figure];
            const char* way = slips(cell) ? (error > 0 ? "too far to the left" : "too far to the right")
                              : error > 0 ? "faster than asked"
                                          : "slower than asked";
            return fmt::format(
                "At {} the feet go {:.0f} % {} ({:+.0f} % in the clips alone): they slide by the difference",
                place(space, cell), std::fabs(error), way, cell.sources[figure]);
        });
}

void probe_turn(LintContext& context, const ProbeSpace& space) {
    const double most = context.threshold("probe-turn", "error");
    add_findings(
        context, space, "probe-turn", [&](const ProbeCell& cell) { return added(cell, ProbeFigure::turn) - most; },
        [&](const ProbeCell& cell) {
            return fmt::format(
                "At {} the feet turn {:.0f} deg/s too far to the {} ({:+.0f} in the clips alone): they "
                "twist on the ground",
                place(space, cell), std::fabs(cell.blend[ProbeFigure::turn]),
                cell.blend[ProbeFigure::turn] > 0 ? "left" : "right", cell.sources[ProbeFigure::turn]);
        });
}

void probe_skate(LintContext& context, const ProbeSpace& space) {
    const double ratio = context.threshold("probe-skate", "ratio"), least = context.threshold("probe-skate", "more");
    add_findings(
        context, space, "probe-skate",
        [&](const ProbeCell& cell) {
            if (!(cell.standing > 0)) return 1e9;  // nothing stands: as bad as can be
            const double own = cell.blend[ProbeFigure::skate], sources = cell.sources[ProbeFigure::skate];
            return std::min(own - ratio * sources, own - sources - least);
        },
        [&](const ProbeCell& cell) {
            if (!(cell.standing > 0)) return fmt::format("At {} no foot ever stands", place(space, cell));
            return fmt::format("At {} planted feet slide at {:.0f} cm/s; those of its clips alone at {:.0f} cm/s",
                               place(space, cell), cell.blend[ProbeFigure::skate], cell.sources[ProbeFigure::skate]);
        });
}

void probe_knee(LintContext& context, const ProbeSpace& space) {
    const double ratio = context.threshold("probe-knee", "ratio"), least = context.threshold("probe-knee", "more");
    add_findings(
        context, space, "probe-knee",
        [&](const ProbeCell& cell) {
            const double own = cell.blend[ProbeFigure::knee_peak], sources = cell.sources[ProbeFigure::knee_peak];
            return cell.standing > 0 ? std::min(own - ratio * sources, own - sources - least) : 0.0;
        },
        [&](const ProbeCell& cell) {
            return fmt::format(
                "At {} a knee jerks {:.1f} times as hard as in its clips ({:.0f} deg/s^2)", place(space, cell),
                cell.blend[ProbeFigure::knee_peak] / std::max(cell.sources[ProbeFigure::knee_peak], 1.0f),
                cell.blend[ProbeFigure::knee_peak]);
        });
}

void probe_legs_cross(LintContext& context, const ProbeSpace& space) {
    const double depth = context.threshold("probe-legs-cross", "depth");
    add_findings(
        context, space, "probe-legs-cross",
        [&](const ProbeCell& cell) {
            const double own = cell.blend[ProbeFigure::leg_gap], sources = cell.sources[ProbeFigure::leg_gap];
            return cell.standing > 0 ? std::min(-own, sources - own) - depth : 0.0;
        },
        [&](const ProbeCell& cell) {
            return fmt::format("At {} one leg passes {:.1f} cm through the other", place(space, cell),
                               -cell.blend[ProbeFigure::leg_gap]);
        });
}

}  // namespace

void lint_probe(LintContext& context) {
    for (const auto rule : {probe_speed, probe_turn, probe_skate, probe_knee, probe_legs_cross})
        for (const ProbeSpace& space : context.project().probe.spaces) rule(context, space);
}

}  // namespace surefoot
