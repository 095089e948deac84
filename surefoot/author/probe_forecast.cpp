#include <surefoot/author/lint_context.h>
#include <surefoot/author/probe_forecast.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

constexpr double k_worst_error = 3;  // of one blend: beyond, it is broken, and more broken is no worse

/// How wrong the feet of a blend are beside those of its clips: 1 where a lint rule about it would speak.
double error_of(const LintContext& rules, const ProbeCell& cell) {
    if (!(cell.standing > 0)) return k_worst_error;
    const auto added = [&](ProbeFigure figure) {
        return std::fabs(static_cast<double>(cell.blend[figure]) - cell.sources[figure]);
    };
    const double skate = cell.blend[ProbeFigure::skate] - cell.sources[ProbeFigure::skate];
    return std::min(k_worst_error, std::max({added(ProbeFigure::speed) / rules.threshold("probe-speed", "error"),
                                             added(ProbeFigure::lateral) / rules.threshold("probe-speed", "error"),
                                             added(ProbeFigure::turn) / rules.threshold("probe-turn", "error"),
                                             std::max(0.0, skate) / rules.threshold("probe-skate", "more")}));
}

SpacePoint point_of(const std::vector<float>& values) {
    SpacePoint point{};
    std::copy(values.begin(), values.end(), point.begin());
    return point;
}

/// Spread of the samples that a blend is made of, in shares of the axes' ranges.
double spread(const BlendSpace& space, const BlendWeights& weights) {
    double sum = 0;
    for (int i = 0; i < weights.count; ++i)
        for (int k = 0; k < space.dimensions(); ++k) {
            const Axis& axis = space.axes[k];
            const double off = (static_cast<double>(space.samples[weights.samples[i]][k]) - weights.point[k]) /
                               (static_cast<double>(axis.high) - axis.low);
            sum += std::fabs(weights.weights[i]) * off * off;
        }
    return sum;
}

double forecast_cell(const LintContext& rules, const ProjectSpace& before, const ProjectSpace& after,
                     const ProbeCell& cell) {
    const SpacePoint point = point_of(cell.at);
    const BlendWeights now = blend_weights(before.space, point), then = blend_weights(after.space, point);
    if (then.clamped) return 1;
    const double was = spread(before.space, now), is = spread(after.space, then);
    constexpr double k_one_clip = 1e-9;  // no spread: what is wrong there is not the blend's fault
    return error_of(rules, cell) * (was > k_one_clip ? is / was : 1);
}

double forecast_space(const LintContext& rules, const ProjectSpace& before, const ProjectSpace& after,
                      const ProbeSpace& probe) {
    std::map<std::vector<int>, const ProbeCell*> cells;
    for (const ProbeCell& cell : probe.cells) cells[cell.grid] = &cell;
    double sum = 0;
    std::vector<int> index(probe.axes.size());
    do {
        if (const auto found = cells.find(index); found != cells.end()) {
            sum += forecast_cell(rules, before, after, *found->second);
            continue;
        }
        SpacePoint point{};
        for (std::size_t k = 0; k < index.size(); ++k) point[k] = grid_value(probe.axes[k], index[k]);
        sum += blend_weights(after.space, point).clamped;
    } while (next_grid_point(index, probe.axes));
    return sum;
}

}  // namespace

double forecast_error(const Project& probed, const Project& after) {
    const LintContext rules(probed, {});
    double sum = 0;
    for (const ProbeSpace& probe : probed.probe.spaces) {
        const ProjectSpace *now = probed.find_space(probe.name), *then = after.find_space(probe.name);
        const auto same = [&](const ProjectSpace* space) {
            return space &&
                   std::equal(space->space.axes.begin(), space->space.axes.end(), probe.axes.begin(), probe.axes.end(),
                              [](const Axis& a, const ProbeAxis& b) { return a.name == b.name; });
        };
        if (same(now)) sum += forecast_space(rules, *now, same(then) ? *then : *now, probe);
    }
    return sum;
}

}  // namespace surefoot
