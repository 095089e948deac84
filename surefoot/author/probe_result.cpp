#include <surefoot/author/probe_result.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// What a figure is called on screens, in its unit.
struct FigureText {
    const char* key;
    const char* name;
    const char* unit;
    int decimals;
};
constexpr FigureText k_figures[k_probe_figures] = {
    {"speed_error_pct", "speed error", "%", 1},
    {"lateral_error_pct", "sideways error", "%", 1},
    {"turn_error_deg_s", "turn error", "deg/s", 1},
    {"skate_cm_s", "planted skate", "cm/s", 1},
    {"skate_share", "frames skating", "share", 3},
    {"skate_weighted_cm", "skate by height", "cm", 3},
    {"knee_peak_deg_s2", "knee acceleration", "deg/s^2", 0},
    {"leg_gap_cm", "gap of the legs", "cm", 1},
};
const FigureText& text_of(ProbeFigure figure) { return k_figures[static_cast<std::size_t>(figure)]; }

constexpr double k_least_skate = 0.1;  // [cm/s] what nobody sees

bool worse(ProbeFigure figure, double a, double b) {
    return figure == ProbeFigure::leg_gap ? a < b : std::fabs(a) > std::fabs(b);
}

std::string number(double value, int decimals) {
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    return text.find_first_not_of("-0.") == std::string::npos ? text.substr(text[0] == '-') : text;  // no "-0.0"
}

std::string stat_text(ProbeFigure figure, const std::vector<ProbeSpace>& spaces) {
    const ProbeStat stat = probe_stat(spaces, figure);
    const int decimals = text_of(figure).decimals;
    return fmt::format("{:>9} {:>9} {:>9} {:>9}", number(stat.mean, decimals), number(stat.source, decimals),
                       number(stat.added, decimals), number(stat.worst, decimals));
}

std::string worst_text(ProbeFigure figure, const ProbeResult& result) {
    const ProbeStat stat = probe_stat(result.spaces, figure);
    if (stat.cell < 0) return {};
    const ProbeSpace& space = result.spaces[static_cast<std::size_t>(stat.space)];
    return fmt::format("{:<18} {} {} at {}\n", text_of(figure).name, number(stat.worst, text_of(figure).decimals),
                       text_of(figure).unit, describe_cell(space, space.cells[static_cast<std::size_t>(stat.cell)]));
}

}  // namespace

const char* figure_key(ProbeFigure figure) noexcept { return text_of(figure).key; }

float rounded_figure(float value) noexcept {
    return static_cast<float>(std::round(static_cast<double>(value) * 1e4) / 1e4) + 0.0f;  // no -0
}

float grid_value(const ProbeAxis& axis, int point) noexcept {
    if (axis.points < 2) return axis.low;
    const float share = static_cast<float>(point) / static_cast<float>(axis.points - 1);
    return rounded_figure(axis.low + share * (axis.high - axis.low));
}

bool next_grid_point(std::vector<int>& index, const std::vector<ProbeAxis>& axes) noexcept {
    for (std::size_t k = index.size(); k-- > 0;) {
        if (++index[k] < axes[k].points) return true;
        index[k] = 0;
    }
    return false;
}

ProbeStat probe_stat(const std::vector<ProbeSpace>& spaces, ProbeFigure figure) {
    ProbeStat stat;
    for (std::size_t s = 0; s < spaces.size(); ++s)
        for (std::size_t c = 0; c < spaces[s].cells.size(); ++c) {
            const ProbeCell& cell = spaces[s].cells[c];
            if (!(cell.standing > 0)) continue;
            const double value = cell.blend[figure], source = cell.sources[figure];
            stat.mean += figure == ProbeFigure::leg_gap ? value : std::fabs(value);
            stat.source += figure == ProbeFigure::leg_gap ? source : std::fabs(source);
            stat.added += std::fabs(value - source);
            if (stat.cells++ == 0 || worse(figure, value, stat.worst))
                stat.worst = value, stat.space = static_cast<int>(s), stat.cell = static_cast<int>(c);
        }
    if (stat.cells > 0) stat.mean /= stat.cells, stat.source /= stat.cells, stat.added /= stat.cells;
    return stat;
}

int unmeasured_cells(const std::vector<ProbeSpace>& spaces) {
    int count = 0;
    for (const ProbeSpace& space : spaces)
        for (const ProbeCell& cell : space.cells) count += !(cell.standing > 0);
    return count;
}

double skate_ratio(const std::vector<ProbeSpace>& spaces) {
    const ProbeStat skate = probe_stat(spaces, ProbeFigure::skate);
    return skate.cells > 0 ? skate.mean / std::max(skate.source, k_least_skate) : 0;
}

std::string describe_shares(const ProbeSpace& space, const ProbeCell& cell, const char* quote) {
    constexpr float k_seen = 0.005f;
    std::string text;
    for (const ProbeShare& share : cell.shares)
        if (text.empty() || share.weight >= k_seen)
            text += fmt::format("{}{}{}{} {:.0f} %", text.empty() ? "" : ", ", quote,
                                space.clips[static_cast<std::size_t>(share.clip)], quote, 100 * share.weight);
    return text;
}

std::string describe_cell(const ProbeSpace& space, const ProbeCell& cell) {
    std::string text = space.name + ": ";
    for (std::size_t k = 0; k < cell.at.size(); ++k)
        text += fmt::format("{}{} {}", k ? ", " : "", number(cell.at[k], 2), space.axes[k].unit);
    return text + " (" + describe_shares(space, cell) + ")";
}

std::string probe_table(const ProbeResult& result, const ProbeResult* before) {
    std::size_t cells = 0;
    for (const ProbeSpace& space : result.spaces) cells += space.cells.size();
    std::string text = fmt::format("probe of {} blends, measured from the standing feet", cells);
    if (before) text += "; before and after";
    text += fmt::format("\n{:<18} {:<7}", "", "");
    for (int column = before ? 2 : 1; column > 0; --column)
        text += fmt::format(" {:>9} {:>9} {:>9} {:>9}", "mean", "sources'", "added", "worst");
    text += "\n";
    for (int f = 0; f < k_probe_figures; ++f) {
        const auto figure = static_cast<ProbeFigure>(f);
        text += fmt::format("{:<18} {:<7}", text_of(figure).name, text_of(figure).unit);
        if (before) text += " " + stat_text(figure, before->spaces);
        text += " " + stat_text(figure, result.spaces) + "\n";
    }
    text += "planted skate against the sources': ";
    if (before) text += fmt::format("{:.2f} before, ", skate_ratio(before->spaces));
    text += fmt::format("{:.2f}\n", skate_ratio(result.spaces));
    if (const int lost = unmeasured_cells(result.spaces); lost > 0)
        text += fmt::format("in {} blends no foot ever stands: nothing could be measured there\n", lost);
    text += "worst blends:\n";
    for (const ProbeFigure figure : {ProbeFigure::speed, ProbeFigure::lateral, ProbeFigure::turn, ProbeFigure::skate,
                                     ProbeFigure::knee_peak, ProbeFigure::leg_gap})
        text += "  " + worst_text(figure, result);
    return text;
}

}  // namespace surefoot
