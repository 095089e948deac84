// Heat maps of what the probe found: one for each figure, with the state before the repairs beside it where there were
// any.
//
// The scale is cividis (Nuñez, Anderton and Renslow 2018): its lightness rises evenly and it looks the same to
// colour-blind eyes. Numbers stand in each cell's title. Of more than two axes, a cell shows the worst over those that
// are not drawn.

#include <surefoot/author/probe_result.h>
#include <surefoot/author/report_parts.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace surefoot {
namespace {

constexpr const char* k_scale[] = {"#00224e", "#123570", "#3b496c", "#575d6d", "#707173",
                                   "#8a8678", "#a59c74", "#c3b369", "#e1cc55", "#fee838"};
constexpr int k_steps = static_cast<int>(std::size(k_scale));
constexpr double k_left = 46, k_right = 8, k_top = 8, k_bottom = 34, k_width = 330, k_height = 250;  // [px]

/// A figure as something that is better the smaller it is.
struct Heat {
    ProbeFigure figure;
    const char *title, *unit;
    double least;  // bottom of the scale: as good as can be
    double full;   // top of the scale, where nothing is worse: cells of good spaces should not look alarming
    int decimals;
    double (*badness)(const ProbeCell&);
};

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

bool is_measured(const ProbeCell& cell, const Heat& heat) {
    return cell.standing > 0 && std::isfinite(cell.blend[heat.figure]) && std::isfinite(heat.badness(cell));
}

const ProbeSpace* space_of(const ProbeResult* result, const std::string& name) {
    if (result == nullptr) return nullptr;
    for (const ProbeSpace& space : result->spaces)
        if (space.name == name) return &space;
    return nullptr;
}

/// The cell that stands for each place of the drawing.
class HeatMap {
  public:
    HeatMap(const ProbeSpace& space, const Heat& heat, double full) : space_(space), heat_(heat), full_(full) {
        across_ = space.axes.size() > 1 ? 1 : 0;
        up_ = space.axes.size() > 1 ? 0 : -1;
        for (const ProbeCell& cell : space.cells) {
            const std::pair<int, int> at{cell.grid[static_cast<std::size_t>(across_)],
                                         up_ < 0 ? 0 : cell.grid[static_cast<std::size_t>(up_)]};
            const ProbeCell*& shown = shown_[at];
            if (shown == nullptr || badness(cell) > badness(*shown)) shown = &cell;
            if (worst_ == nullptr || badness(cell) > badness(*worst_)) worst_ = &cell;
        }
    }

    std::string draw() const {
        std::string svg = fmt::format(
            "<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" aria-label=\"{2}: {3}\"><title>{2}: {3}</title>",
            k_width, k_height, heat_.title, escape_html(summary()));
        svg += fmt::format("<rect class=\"heat-frame\" x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", k_left,
                           k_top, plot_width(), plot_height());
        for (const auto& [at, cell] : shown_) svg += rectangle(at, *cell);
        if (worst_ != nullptr && is_measured(*worst_, heat_)) svg += mark_worst();
        return svg + ticks() + "</svg>";
    }

    std::string summary() const {
        double sum = 0;
        int measured = 0;
        for (const ProbeCell& cell : space_.cells)
            if (is_measured(cell, heat_)) sum += heat_.badness(cell), ++measured;
        if (measured == 0) return "nothing could be measured";
        return fmt::format("mean {:.{}f}, worst {:.{}f} {} at {}", sum / measured, heat_.decimals,
                           heat_.badness(*worst_), heat_.decimals, heat_.unit, describe_cell(space_, *worst_));
    }

  private:
    double badness(const ProbeCell& cell) const { return is_measured(cell, heat_) ? heat_.badness(cell) : -1; }
    static double plot_width() { return k_width - k_left - k_right; }
    static double plot_height() { return k_height - k_top - k_bottom; }
    const ProbeAxis& axis(int slot) const { return space_.axes[static_cast<std::size_t>(slot)]; }
    /// What goes to the character's left is drawn on the left.
    bool reversed() const { return axis(across_).name == "turn" || axis(across_).name == "lateral"; }
    double cell_width() const { return plot_width() / std::max(axis(across_).points, 1); }
    double cell_height() const { return up_ < 0 ? plot_height() : plot_height() / std::max(axis(up_).points, 1); }
    double left_of(int column) const {
        return k_left + cell_width() * (reversed() ? axis(across_).points - 1 - column : column);
    }
    double top_of(int row) const { return k_top + plot_height() - cell_height() * (row + 1); }

    std::string rectangle(std::pair<int, int> at, const ProbeCell& cell) const {
        const double x = left_of(at.first), y = top_of(at.second), w = cell_width(), h = cell_height();
        const std::string where = escape_html(describe_cell(space_, cell));
        if (!is_measured(cell, heat_))
            return fmt::format(
                "<path class=\"heat-none\" d=\"M{0:.1f} {1:.1f}l{2:.1f} {3:.1f}m0 -{3:.1f}l-{2:.1f} "
                "{3:.1f}\"><title>{4}: no foot stands, nothing can be measured</title></path>",
                x + 0.2 * w, y + 0.2 * h, 0.6 * w, 0.6 * h, where);
        return fmt::format(
            "<rect class=\"heat-cell\" fill=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
            "height=\"{:.1f}\"><title>{}: {}</title></rect>",
            colour(heat_.badness(cell)), x, y, w, h, where, numbers(cell));
    }

    const char* colour(double badness) const {
        const double share = (badness - heat_.least) / (full_ - heat_.least);
        return k_scale[std::clamp(static_cast<int>(share * k_steps), 0, k_steps - 1)];
    }

    std::string numbers(const ProbeCell& cell) const {
        const float blend = cell.blend[heat_.figure], alone = cell.sources[heat_.figure];
        if (heat_.figure == ProbeFigure::knee_peak)
            return fmt::format("{:.0f} deg/s\xc2\xb2, the clips alone {:.0f}", blend, alone);
        return fmt::format("{:.{}f} {}, the clips alone {:.{}f}", blend, heat_.decimals, heat_.unit, alone,
                           heat_.decimals);
    }

    std::string mark_worst() const {
        const int column = worst_->grid[static_cast<std::size_t>(across_)];
        const int row = up_ < 0 ? 0 : worst_->grid[static_cast<std::size_t>(up_)];
        const double r = std::clamp(0.5 * std::min(cell_width(), cell_height()), 4.0, 9.0);
        std::string svg;
        for (const char* style : {"heat-worst", "heat-worst-core"})
            svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", style,
                               left_of(column) + 0.5 * cell_width(), top_of(row) + 0.5 * cell_height(), r);
        return svg;
    }

    std::string ticks() const {
        const auto name = [](const ProbeAxis& axis) {
            return escape_html(axis.name + (axis.unit.empty() ? "" : ", " + axis.unit));
        };
        const ProbeAxis& across = axis(across_);
        const double bottom = k_top + plot_height(), right = k_left + plot_width();
        std::string svg = fmt::format(
            "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">{:g}</text><text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{:g}</text><text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" "
            "text-anchor=\"middle\">{}</text>",
            k_left, bottom + 14, reversed() ? across.high : across.low, right, bottom + 14,
            reversed() ? across.low : across.high, 0.5 * (k_left + right), bottom + 28, name(across));
        if (up_ < 0) return svg;
        return svg + fmt::format(
                         "<text class=\"tick\" x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"end\">{2:g}</text><text "
                         "class=\"tick\" x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"end\">{4:g}</text><text "
                         "class=\"tick\" transform=\"translate(13 {5:.1f}) rotate(-90)\" "
                         "text-anchor=\"middle\">{6}</text>",
                         k_left - 5, k_top + 10, axis(up_).high, bottom, axis(up_).low, k_top + 0.5 * plot_height(),
                         name(axis(up_)));
    }

    const ProbeSpace& space_;
    const Heat& heat_;
    double full_;
    int across_ = 0, up_ = -1;
    std::map<std::pair<int, int>, const ProbeCell*> shown_;
    const ProbeCell* worst_ = nullptr;
};

double full_scale(const Heat& heat, const ProbeSpace& now, const ProbeSpace* before) {
    double full = heat.full;
    for (const ProbeSpace* space : {&now, before})
        for (std::size_t i = 0; space != nullptr && i < space->cells.size(); ++i)
            if (is_measured(space->cells[i], heat)) full = std::max(full, heat.badness(space->cells[i]));
    return full;
}

std::string scale_key(const Heat& heat, double full) {
    std::string svg = "<svg viewBox=\"0 0 330 26\" role=\"img\" aria-label=\"colour scale\">";
    for (int i = 0; i < k_steps; ++i)
        svg +=
            fmt::format("<rect fill=\"{}\" x=\"{}\" y=\"0\" width=\"28.4\" height=\"10\"/>", k_scale[i], 46 + 27.6 * i);
    return svg + fmt::format(
                     "<text class=\"tick\" x=\"46\" y=\"23\">{:.{}f} {}</text><text class=\"tick\" x=\"322\" y=\"23\" "
                     "text-anchor=\"end\">{:.{}f} {}</text></svg>",
                     heat.least, heat.decimals, heat.unit, full, heat.decimals, heat.unit);
}

std::string heat_figure(const ProbeSpace& space, const Heat& heat, double full, const char* when) {
    const HeatMap map(space, heat, full);
    return fmt::format("<figure class=\"heat\"><figcaption><b>{}</b>{}<br>{}</figcaption>", heat.title, when,
                       escape_html(map.summary())) +
           map.draw() + scale_key(heat, full) + "</figure>\n";
}

}  // namespace

std::span<const char* const> heat_scale() { return k_scale; }

std::string probe_section(const Project& project, const ProjectSpace& space) {
    const ProbeSpace* now = space_of(&project.probe, space.name);
    if (now == nullptr || now->cells.empty() || now->axes.empty()) return {};
    const ProbeSpace* before = space_of(project.probe_before ? &*project.probe_before : nullptr, space.name);
    std::string html = fmt::format(
        "<h3>What the blends really do</h3>\n<p>{} blends were played and measured again from their standing feet. The "
        "ring "
        "marks the worst; each cell names its numbers and clips under the pointer.{}{}</p>\n<div class=\"heats{}\">\n",
        now->cells.size(), before != nullptr ? " Left: before the repairs; right: as it is now." : "",
        now->axes.size() > 2 ? " A cell shows the worst over the axes that are not drawn." : "",
        before != nullptr ? " paired" : "");
    for (const Heat& heat : k_heats) {
        const double full = full_scale(heat, *now, before);
        if (before != nullptr) html += heat_figure(*before, heat, full, ", before");
        html += heat_figure(*now, heat, full, before != nullptr ? ", now" : "");
    }
    return html + "</div>\n";
}

}  // namespace surefoot
