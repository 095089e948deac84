#include <surefoot/author/lint_context.h>
#include <surefoot/author/place.h>
#include <surefoot/author/snap_grid.h>
#include <surefoot/base/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {
namespace {

float snapped(float value, const Axis& axis, int divisions) {
    const float step = (axis.high - axis.low) / static_cast<float>(divisions);
    const float at = std::clamp(std::round((value - axis.low) / step), 0.0f, static_cast<float>(divisions));
    // From the nearer end, so that both ends, and 0 in the middle of a symmetric axis, are exact.
    const float n = static_cast<float>(divisions);
    return 2 * at < n ? axis.low + at * step : 2 * at > n ? axis.high - (n - at) * step : 0.5f * (axis.low + axis.high);
}

std::string place_text(const std::vector<float>& values, const std::vector<Axis>& axes) {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k)
        text += fmt::format("{}{:.2f} {}", k ? ", " : "", values[k], axes[k].unit);
    return text;
}

}  // namespace

GridSnap snap_to_grid(Project& project, int divisions, std::vector<std::string>& warnings) {
    if (divisions < k_coarsest_grid || divisions > k_finest_grid)
        throw Error(fmt::format("engines have no grid of {} divisions", divisions), "--grid",
                    fmt::format("give {} to {}", k_coarsest_grid, k_finest_grid));
    GridSnap snap;
    for (ProjectSpace& space : project.spaces) {
        const PercentSpace percent(space);
        const auto count = static_cast<std::size_t>(space.space.dimensions());
        std::map<SpacePoint, std::vector<std::string>> at;
        for (std::size_t i = 0; i < static_cast<std::size_t>(space.space.original_count()); ++i) {
            SpacePoint& point = space.space.samples[i];
            const SpacePoint from = point;
            for (std::size_t k = 0; k < count; ++k) point[k] = snapped(point[k], space.space.axes[k], divisions);
            const std::string& clip = project.clips[space.clips[i]].name;
            snap.samples.push_back({space.name,
                                    clip,
                                    {from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count)},
                                    {point.begin(), point.begin() + static_cast<std::ptrdiff_t>(count)},
                                    static_cast<float>(percent.distance(from, point))});
            at[point].push_back(clip);
        }
        for (const auto& [point, clips] : at)
            if (clips.size() > 1) snap.collisions.push_back(clips);
        triangulate_locked(project, space, warnings);
    }
    return snap;
}

std::string snap_table(const Project& project, const GridSnap& snap) {
    std::vector<SnappedSample> samples = snap.samples;
    std::stable_sort(samples.begin(), samples.end(),
                     [](const SnappedSample& a, const SnappedSample& b) { return a.percent > b.percent; });
    std::size_t width = 4;
    for (const SnappedSample& sample : samples) width = std::max(width, sample.clip.size());
    std::string text = fmt::format("{:<{}}  {:<8}  {:>5}  {}\n", "clip", width, "space", "moved", "from -> to");
    for (const SnappedSample& sample : samples) {
        const std::vector<Axis>& axes = project.find_space(sample.space)->space.axes;
        text += fmt::format("{:<{}}  {:<8}  {:>4.1f}%  {} -> {}\n", sample.clip, width, sample.space, sample.percent,
                            place_text(sample.from, axes), place_text(sample.to, axes));
    }
    for (const std::vector<std::string>& clips : snap.collisions) {
        text += fmt::format("on one grid point: \"{}\"", clips.front());
        for (std::size_t i = 1; i < clips.size(); ++i) text += fmt::format(", \"{}\" (never played)", clips[i]);
        text += "\n";
    }
    return text;
}

}  // namespace surefoot
