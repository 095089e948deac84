#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>
#include <surefoot/host/progress.h>
#include <surefoot/probe/played_figures.h>
#include <surefoot/probe/probe.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot {
namespace {

constexpr int k_default_grid[k_max_dimensions] = {41, 21, 9, 5};
constexpr double k_most_cells = 100'000;  // of a space: a minute or two

ProbeSpace blank_space(const char* name, const LocomotionSpace& space, int grid) {
    ProbeSpace result;
    result.name = name;
    const int points = grid > 0 ? grid : k_default_grid[space.space.axes.size() - 1];
    double cells = 1;
    for (std::size_t k = 0; k < space.space.axes.size(); ++k) cells *= points;
    if (cells > k_most_cells)
        throw Error("a grid of " + std::to_string(points) + " points on each of " +
                        std::to_string(space.space.axes.size()) + " axes is too fine to be probed",
                    std::string("space '") + name + "'", "ask for fewer points");
    for (const Axis& axis : space.space.axes)
        result.axes.push_back({axis.name, axis.unit, axis.low, axis.high, points});
    std::vector<int> index(result.axes.size());
    do {
        ProbeCell cell;
        cell.grid = index;
        for (std::size_t k = 0; k < index.size(); ++k) cell.at.push_back(grid_value(result.axes[k], index[k]));
        result.cells.push_back(std::move(cell));
    } while (next_grid_point(index, result.axes));
    return result;
}

/// The clips alone, measured as blends are.
std::vector<PlayedFigures> measure_clips(const Character& character) {
    std::vector<PlayedFigures> result(character.graph.clips.size());
    parallel_for(result.size(), [&](std::size_t i) {
        const SteadyPlay play = play_clip(character, static_cast<int>(i));
        result[i] = measure_play(character, play, play.velocity, play.turn);
    });
    return result;
}

ProbeFigures weighted(std::span<const Leaf> leaves, const std::vector<PlayedFigures>& clips) {
    ProbeFigures sum;
    float gap = 1e9f;
    for (const Leaf& leaf : leaves) {
        const ProbeFigures& own = clips[static_cast<std::size_t>(leaf.clip)].figures;
        for (std::size_t f = 0; f < k_probe_figures; ++f) sum.value[f] += leaf.weight * own.value[f];
        gap = std::min(gap, own[ProbeFigure::leg_gap]);
    }
    sum[ProbeFigure::leg_gap] = gap;
    return sum;
}

/// Fills a cell whose place is known; shares name clips of the character for now. False where the clips do not reach.
bool measure_cell(const Character& character, const LocomotionSpace& space, const std::vector<PlayedFigures>& clips,
                  ProbeCell& cell) {
    const LocomotionRequest request = request_at(space, cell.at);
    const SteadyPlay play = play_request(character, request);
    if (play.clamped) return false;
    const PlayedFigures played = measure_play(character, play, {request.lateral, 0, request.speed}, request.turn);
    for (const Leaf& leaf : play.leaves) cell.shares.push_back({leaf.clip, rounded_figure(leaf.weight)});
    cell.standing = rounded_figure(played.standing);
    cell.forward = rounded_figure(played.velocity.z);
    cell.lateral = rounded_figure(played.velocity.x);
    cell.turn = rounded_figure(played.turn);
    cell.blend = played.figures;
    if (played.standing > 0) cell.sources = weighted(play.leaves, clips);
    for (float& value : cell.blend.value) value = rounded_figure(value);
    for (float& value : cell.sources.value) value = rounded_figure(value);
    return true;
}

/// Leaves out cells that are not `covered`, and names the clips of the others.
void finish(ProbeSpace& space, const std::vector<char>& covered, const std::vector<PackedClip>& clips) {
    std::vector<ProbeCell> cells;
    std::vector<int> place(clips.size(), -1);
    for (std::size_t i = 0; i < space.cells.size(); ++i) {
        if (!covered[i]) continue;
        for (const ProbeShare& share : space.cells[i].shares) place[static_cast<std::size_t>(share.clip)] = 0;
        cells.push_back(std::move(space.cells[i]));
    }
    for (std::size_t c = 0; c < clips.size(); ++c)
        if (place[c] == 0) {
            place[c] = static_cast<int>(space.clips.size());
            space.clips.push_back(clips[c].name);
        }
    for (ProbeCell& cell : cells)
        for (ProbeShare& share : cell.shares) share.clip = place[static_cast<std::size_t>(share.clip)];
    space.cells = std::move(cells);
}

}  // namespace

ProbeResult probe(const Character& character, const ProbeOptions& options) {
    if (options.grid != 0 && (options.grid < 2 || options.grid > k_finest_probe_grid))
        throw Error("a grid of " + std::to_string(options.grid) + " points an axis cannot be probed", "the probe",
                    "give 2 to " + std::to_string(k_finest_probe_grid));
    const std::vector<PlayedFigures> clips = measure_clips(character);
    ProbeResult result;
    const auto add = [&](const char* name, const LocomotionSpace& space) {
        if (space.empty()) return;
        ProbeSpace probed = blank_space(name, space, options.grid);
        std::vector<char> covered(probed.cells.size());
        Progress progress("probing", covered.size());
        parallel_for(covered.size(), [&](std::size_t i) {
            covered[i] = measure_cell(character, space, clips, probed.cells[i]);
            progress.advance();
        });
        finish(probed, covered, character.graph.clips);
        result.spaces.push_back(std::move(probed));
    };
    add("facing", character.graph.facing);
    add("lateral", character.graph.lateral);
    return result;
}

}  // namespace surefoot
