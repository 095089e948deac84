#include <surefoot/author/heat.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr const char* k_scale[k_heat_steps] = {"#00224e", "#123570", "#3b496c", "#575d6d", "#707173",
                                               "#8a8678", "#a59c74", "#c3b369", "#e1cc55", "#fee838"};

double magnitude(const ProbeCell& cell, ProbeFigure figure) { return std::fabs(cell.blend[figure]); }

constexpr Heat k_heats[] = {
    {ProbeFigure::speed, "Speed error", "%", 0, 5, 1,
     [](const ProbeCell& cell) { return magnitude(cell, ProbeFigure::speed); }},
    {ProbeFigure::turn, "Turn error", "deg/s", 0, 5, 1,
     [](const ProbeCell& cell) { return magnitude(cell, ProbeFigure::turn); }},
    {ProbeFigure::skate, "Foot skate", "cm/s", 0, 10, 1,
     [](const ProbeCell& cell) { return magnitude(cell, ProbeFigure::skate); }},
    {ProbeFigure::knee_peak, "Knee jerk against the clips alone", "times", 1, 2, 2,
     [](const ProbeCell& cell) {
         const double alone = cell.sources[ProbeFigure::knee_peak];
         return alone > 0 ? cell.blend[ProbeFigure::knee_peak] / alone : 1.0;
     }},
    {ProbeFigure::leg_gap, "Legs inside each other", "cm", 0, 2, 1,
     [](const ProbeCell& cell) { return std::max(0.0, -static_cast<double>(cell.blend[ProbeFigure::leg_gap])); }},
};

}  // namespace

std::span<const Heat> heats() { return k_heats; }

std::span<const char* const, k_heat_steps> heat_scale() { return k_scale; }

bool is_measured(const ProbeCell& cell, const Heat& heat) {
    return cell.standing > 0 && std::isfinite(cell.blend[heat.figure]) && std::isfinite(heat.badness(cell));
}

double full_scale(const Heat& heat, const ProbeSpace& space) {
    double full = heat.full;
    for (const ProbeCell& cell : space.cells)
        if (is_measured(cell, heat)) full = std::max(full, heat.badness(cell));
    return full;
}

}  // namespace surefoot
