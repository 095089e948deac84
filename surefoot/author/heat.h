#pragma once
// Figures of the probe as colours: what the report and the studio draw.

#include <surefoot/author/probe_result.h>

#include <span>

namespace surefoot {

/// A figure as something that is better the smaller it is.
struct Heat {
    ProbeFigure figure;
    const char *title, *unit;
    double least;  ///< bottom of the scale: as good as can be
    double full;   ///< top of the scale, where nothing is worse: cells of good spaces should not look alarming
    int decimals;
    double (*badness)(const ProbeCell&);
};

std::span<const Heat> heats();

/// Whether the cell has that figure.
bool is_measured(const ProbeCell& cell, const Heat& heat);

/// The top of the scale for a space: Heat::full, or its worst cell.
double full_scale(const Heat& heat, const ProbeSpace& space);

/// Its colours, from good to bad: "#00224e", … Cividis (Nuñez, Anderton and Renslow 2018): its lightness rises evenly
/// and it looks the same to colour-blind eyes.
inline constexpr int k_heat_steps = 10;
std::span<const char* const, k_heat_steps> heat_scale();

}  // namespace surefoot
