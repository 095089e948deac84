#pragma once
// What the probe (probe/probe.h) found: a blend space played at the points of a grid and measured again from its
// standing feet (DESIGN §6). Plain data, kept in the project file and drawn by the report.
//
// A figure of a cell stands beside the same figure of the cell's own sources, measured in the same way on each clip
// alone and averaged by the blend's weights: the difference is what blending did.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// The figures of a cell. All are rounded to 1e-4 of their unit, so that a result survives its file.
enum class ProbeFigure : unsigned char {
    speed,           ///< [%] obtained against asked along the direction asked, over max(|v|, 0.5 m/s); + is too fast
    lateral,         ///< [%] the same across that direction, + to the character's left
    turn,            ///< [deg/s] obtained minus asked, + too far to the left
    skate,           ///< [cm/s] mean horizontal speed of planted sole points (course/metrics.h)
    skate_share,     ///< [1] share of standing frames in which a planted point moves faster than 10 cm/s
    skate_weighted,  ///< [cm] mean over planted frames of displacement * (2 - 2^(h/H)), H = 2.5 cm (Zhang et al. 2018)
    knee_peak,       ///< [deg/s^2] largest angular acceleration of a knee
    leg_gap,         ///< [cm] smallest distance of the shanks' and feet's capsules; negative where they intersect
};
inline constexpr int k_probe_figures = 8;
/// "speed_error_pct", …: the keys of the file.
const char* figure_key(ProbeFigure figure) noexcept;

struct ProbeFigures {
    std::array<float, k_probe_figures> value{};
    float operator[](ProbeFigure f) const noexcept { return value[static_cast<std::size_t>(f)]; }
    float& operator[](ProbeFigure f) noexcept { return value[static_cast<std::size_t>(f)]; }
    friend bool operator==(const ProbeFigures&, const ProbeFigures&) = default;
};

/// A clip that makes a cell.
struct ProbeShare {
    int clip = 0;      ///< index into ProbeSpace::clips
    float weight = 0;  ///< the shares of a cell add up to 1
    friend bool operator==(const ProbeShare&, const ProbeShare&) = default;
};

/// A point of the grid inside what the clips cover.
struct ProbeCell {
    std::vector<int> grid;           ///< [0, points) on each axis
    std::vector<float> at;           ///< what was asked for, in axis units
    std::vector<ProbeShare> shares;  ///< heaviest first
    float standing = 0;  ///< share of frames in which a foot stands; 0: nothing could be measured, figures are null
    float forward = 0, lateral = 0;  ///< [m/s] obtained, as the standing feet say
    float turn = 0;                  ///< [deg/s] likewise
    ProbeFigures blend;              ///< of the cell
    ProbeFigures sources;            ///< of its clips by weight; leg_gap: the smallest of them
    friend bool operator==(const ProbeCell&, const ProbeCell&) = default;
};

struct ProbeAxis {
    std::string name, unit;
    float low = 0, high = 0;
    int points = 0;  ///< grid points from low to high, both included
    friend bool operator==(const ProbeAxis&, const ProbeAxis&) = default;
};

/// The value at a grid point of an axis, rounded as figures are.
float grid_value(const ProbeAxis& axis, int point) noexcept;
/// The next point of a grid, the last axis fastest; false after the last one.
bool next_grid_point(std::vector<int>& index, const std::vector<ProbeAxis>& axes) noexcept;
/// To 1e-4: what is beyond says nothing, and files stay short.
float rounded_figure(float value) noexcept;

struct ProbeSpace {
    std::string name;
    std::vector<ProbeAxis> axes;
    std::vector<std::string> clips;  ///< names of all clips that make any cell, ascending
    std::vector<ProbeCell> cells;    ///< in grid order, the last axis fastest; points outside the hull are left out
    friend bool operator==(const ProbeSpace&, const ProbeSpace&) = default;
};

struct ProbeResult {
    std::vector<ProbeSpace> spaces;
    bool empty() const noexcept { return spaces.empty(); }
    friend bool operator==(const ProbeResult&, const ProbeResult&) = default;
};

/// Mean and worst of one figure over cells.
struct ProbeStat {
    double mean = 0;   ///< of absolute values (leg_gap: of values)
    double worst = 0;  ///< the value farthest from 0, with its sign (leg_gap: the smallest)
    int space = -1;    ///< where the worst is; -1 without cells
    int cell = -1;
    double source = 0;  ///< mean of the sources'
    double added = 0;   ///< mean distance from the sources': what blending did
    int cells = 0;      ///< measured ones
};
ProbeStat probe_stat(const std::vector<ProbeSpace>& spaces, ProbeFigure figure);

/// Cells in which no foot stands: nothing measured there is a failure, not a pass.
int unmeasured_cells(const std::vector<ProbeSpace>& spaces);

/// Mean skate of the cells over the mean of their sources' weighted skate; 0 without cells. A source skate below
/// 0.1 cm/s counts as that: less cannot be seen.
double skate_ratio(const std::vector<ProbeSpace>& spaces);

/// "walk 60 %, walk_left 40 %", heaviest first; what rounds to 0 % is left out. `quote` stands around the names.
std::string describe_shares(const ProbeSpace& space, const ProbeCell& cell, const char* quote = "");

/// "facing: 1.4 m/s, 30 deg/s (walk 60 %, walk_left 40 %)".
std::string describe_cell(const ProbeSpace& space, const ProbeCell& cell);

/// The result in a few lines: mean and worst of each figure, and the worst cells with the clips that make them. With
/// `before`, both side by side.
std::string probe_table(const ProbeResult& result, const ProbeResult* before = nullptr);

/// The shape under "probe" in a project file and in `surefoot lint --json`:
/// {"summary": {figure: {"mean", "worst", "source_mean", "added_mean", "worst_cell": {"space", "at"}}, "skate_ratio"},
///  "spaces": [{"name", "axes": [{"name", "unit", "low", "high", "points"}], "clips": [..],
///   "cells": [{"grid": [..], "at": [..], "clips": [..], "weights": [..], "obtained": {"forward_mps", "lateral_mps",
///   "turn_deg_s"}, "blend": {figure: value}, "sources": {figure: value}}]}], "before": {the same}|absent}.
/// `before` may be null. An empty result gives "{}".
std::string probe_json(const ProbeResult& result, const ProbeResult* before = nullptr);

}  // namespace surefoot
