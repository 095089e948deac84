// Heat maps of what the probe found: one for each figure, with the state before the repairs beside it where there were
// any.
//
// Numbers stand in each cell's title. Of more than two axes, a cell shows the worst over those that are not drawn.

#include <surefoot/author/heat.h>
#include <surefoot/author/report_parts.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace surefoot {
namespace {

constexpr double k_left = 46, k_right = 8, k_top = 8, k_bottom = 34, k_width = 330;  // [px]
constexpr double k_height = 250, k_flat_height = 90;                                 // [px]

struct Summary {
    double mean = 0;
    const ProbeCell* worst = nullptr;  ///< null where nothing could be measured
};

Summary summarise(const ProbeSpace& space, const Heat& heat) {
    Summary result;
    int measured = 0;
    for (const ProbeCell& cell : space.cells) {
        if (!is_measured(cell, heat)) continue;
        result.mean += heat.badness(cell), ++measured;
        if (result.worst == nullptr || heat.badness(cell) > heat.badness(*result.worst)) result.worst = &cell;
    }
    if (measured > 0) result.mean /= measured;
    return result;
}

const ProbeSpace* space_of(const ProbeResult* result, const std::string& name) {
    if (result == nullptr) return nullptr;
    for (const ProbeSpace& space : result->spaces)
        if (space.name == name) return &space;
    return nullptr;
}

double step_of(const ProbeAxis& axis) {
    return axis.points > 1 ? (static_cast<double>(axis.high) - axis.low) / (axis.points - 1) : 1;
}

/// What a drawing shows: grid points of the axes across and up, and room for half a cell beyond the outermost.
struct Window {
    double low_x = 0, high_x = 1, room_x = 0;
    double low_y = 0, high_y = 1, room_y = 0;
};

int across_slot(const ProbeSpace& space) { return space.axes.size() > 1 ? 1 : 0; }

Window window_of(const ProbeSpace& space) {
    const ProbeAxis& across = space.axes[static_cast<std::size_t>(across_slot(space))];
    Window window{across.low, across.high, 0.5 * step_of(across), 0, 1, 0};
    if (space.axes.size() < 2) return window;
    const ProbeAxis& up = space.axes[0];
    window.low_y = up.low, window.high_y = up.high, window.room_y = 0.5 * step_of(up);
    return window;
}

/// Room for both, so that places can be compared by eye.
Window window_of(const ProbeSpace& a, const ProbeSpace& b) {
    const Window first = window_of(a), second = window_of(b);
    return {std::min(first.low_x, second.low_x),   std::max(first.high_x, second.high_x),
            std::max(first.room_x, second.room_x), std::min(first.low_y, second.low_y),
            std::max(first.high_y, second.high_y), std::max(first.room_y, second.room_y)};
}

bool has_same_axes(const ProbeSpace& a, const ProbeSpace& b) {
    return std::equal(a.axes.begin(), a.axes.end(), b.axes.begin(), b.axes.end(),
                      [](const ProbeAxis& x, const ProbeAxis& y) { return x.name == y.name; });
}

/// The cell that stands for each place of the drawing.
class HeatMap {
  public:
    HeatMap(const ProbeSpace& space, const Heat& heat, double full, const Window& window)
        : space_(space), heat_(heat), full_(full), window_(window), summary_(summarise(space, heat)) {
        across_ = across_slot(space);
        up_ = space.axes.size() > 1 ? 0 : -1;
        for (const ProbeCell& cell : space.cells) {
            const std::pair<int, int> at{cell.grid[static_cast<std::size_t>(across_)],
                                         up_ < 0 ? 0 : cell.grid[static_cast<std::size_t>(up_)]};
            const ProbeCell*& shown = shown_[at];
            if (shown == nullptr || badness(cell) > badness(*shown)) shown = &cell;
        }
    }

    std::string draw() const {
        std::string svg = fmt::format(
            "<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" aria-label=\"{2}: {3}\"><title>{2}: {3}</title>",
            k_width, height(), heat_.title, escape_html(summary()));
        svg += fmt::format("<rect class=\"heat-frame\" x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", k_left,
                           k_top, plot_width(), plot_height());
        for (const auto& [at, cell] : shown_) svg += rectangle(at, *cell);
        if (summary_.worst != nullptr) svg += mark_worst(*summary_.worst);
        return svg + ticks() + "</svg>";
    }

    std::string summary() const {
        if (summary_.worst == nullptr) return "nothing could be measured";
        return fmt::format("mean {:.{}f}, worst {:.{}f} {} at {}", summary_.mean, heat_.decimals,
                           heat_.badness(*summary_.worst), heat_.decimals, heat_.unit,
                           describe_cell(space_, *summary_.worst));
    }

  private:
    double badness(const ProbeCell& cell) const { return is_measured(cell, heat_) ? heat_.badness(cell) : -1; }
    double height() const { return up_ < 0 ? k_flat_height : k_height; }
    static double plot_width() { return k_width - k_left - k_right; }
    double plot_height() const { return height() - k_top - k_bottom; }
    const ProbeAxis& axis(int slot) const { return space_.axes[static_cast<std::size_t>(slot)]; }
    /// What goes to the character's left is drawn on the left.
    bool reversed() const { return axis(across_).name == "turn" || axis(across_).name == "lateral"; }
    double x(double value) const {
        const double low = window_.low_x - window_.room_x, high = window_.high_x + window_.room_x;
        const double share = (value - low) / (high - low);
        return k_left + plot_width() * (reversed() ? 1 - share : share);
    }
    double y(double value) const {
        const double low = window_.low_y - window_.room_y, high = window_.high_y + window_.room_y;
        const double share = (value - low) / (high - low);
        return k_top + plot_height() * (1 - share);
    }
    double middle_x(int column) const { return x(grid_value(axis(across_), column)); }
    double middle_y(int row) const { return up_ < 0 ? y(0.5) : y(grid_value(axis(up_), row)); }
    double cell_width() const { return std::fabs(x(step_of(axis(across_))) - x(0)); }
    double cell_height() const { return up_ < 0 ? plot_height() : std::fabs(y(step_of(axis(up_))) - y(0)); }

    std::string rectangle(std::pair<int, int> at, const ProbeCell& cell) const {
        const double w = cell_width(), h = cell_height();
        const double left = middle_x(at.first) - 0.5 * w, top = middle_y(at.second) - 0.5 * h;
        const std::string where = escape_html(describe_cell(space_, cell));
        if (!is_measured(cell, heat_))
            return fmt::format(
                "<path class=\"heat-none\" d=\"M{0:.1f} {1:.1f}l{2:.1f} {3:.1f}m0 -{3:.1f}l-{2:.1f} "
                "{3:.1f}\"><title>{4}: no foot stands, nothing can be measured</title></path>",
                left + 0.2 * w, top + 0.2 * h, 0.6 * w, 0.6 * h, where);
        return fmt::format(
            "<rect class=\"heat-cell\" fill=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
            "height=\"{:.1f}\"><title>{}: {}</title></rect>",
            colour(heat_.badness(cell)), left, top, w, h, where, numbers(cell));
    }

    const char* colour(double badness) const {
        const double share = (badness - heat_.least) / (full_ - heat_.least);
        return heat_scale()[static_cast<std::size_t>(
            std::clamp(static_cast<int>(share * k_heat_steps), 0, k_heat_steps - 1))];
    }

    std::string numbers(const ProbeCell& cell) const {
        const float blend = cell.blend[heat_.figure], alone = cell.sources[heat_.figure];
        if (heat_.figure == ProbeFigure::knee_peak)
            return fmt::format("{:.0f} deg/s\xc2\xb2, the clips alone {:.0f}", blend, alone);
        return fmt::format("{:.{}f} {}, the clips alone {:.{}f}", blend, heat_.decimals, heat_.unit, alone,
                           heat_.decimals);
    }

    std::string mark_worst(const ProbeCell& worst) const {
        const int column = worst.grid[static_cast<std::size_t>(across_)];
        const int row = up_ < 0 ? 0 : worst.grid[static_cast<std::size_t>(up_)];
        const double r = std::clamp(0.5 * std::min(cell_width(), cell_height()), 4.0, 9.0);
        std::string svg;
        for (const char* style : {"heat-worst", "heat-worst-core"})
            svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", style,
                               middle_x(column), middle_y(row), r);
        return svg;
    }

    std::string ticks() const {
        const auto name = [](const ProbeAxis& axis) {
            return escape_html(axis.name + (axis.unit.empty() ? "" : ", " + axis.unit));
        };
        const ProbeAxis& across = axis(across_);
        const double bottom = k_top + plot_height(), middle = k_left + 0.5 * plot_width();
        const auto tick = [](double at_x, double at_y, const char* anchor, const std::string& text) {
            return fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", at_x,
                               at_y, anchor, text);
        };
        const auto value = [](double shown) { return fmt::format("{:.4g}", shown); };
        const double low = window_.low_x, high = window_.high_x;
        std::string svg = tick(x(low), bottom + 14, "middle", value(low)) +
                          tick(x(high), bottom + 14, "middle", value(high)) +
                          tick(middle, bottom + 28, "middle", name(across));
        if (up_ < 0) return svg;
        const double least = window_.low_y, most = window_.high_y;
        return svg + tick(k_left - 5, y(most) + 4, "end", value(most)) +
               tick(k_left - 5, y(least) + 4, "end", value(least)) +
               fmt::format(
                   "<text class=\"tick\" transform=\"translate(13 {:.1f}) rotate(-90)\" "
                   "text-anchor=\"middle\">{}</text>",
                   k_top + 0.5 * plot_height(), name(axis(up_)));
    }

    const ProbeSpace& space_;
    const Heat& heat_;
    double full_;
    Window window_;
    int across_ = 0, up_ = -1;
    std::map<std::pair<int, int>, const ProbeCell*> shown_;
    Summary summary_;
};

std::string scale_key(const Heat& heat, double full) {
    std::string svg = "<svg viewBox=\"0 0 330 26\" role=\"img\" aria-label=\"colour scale\">";
    for (int i = 0; i < k_heat_steps; ++i)
        svg += fmt::format("<rect fill=\"{}\" x=\"{}\" y=\"0\" width=\"28.4\" height=\"10\"/>",
                           heat_scale()[static_cast<std::size_t>(i)], 46 + 27.6 * i);
    return svg + fmt::format(
                     "<text class=\"tick\" x=\"46\" y=\"23\">{:.{}f} {}</text><text class=\"tick\" x=\"322\" y=\"23\" "
                     "text-anchor=\"end\">{:.{}f} {}</text></svg>",
                     heat.least, heat.decimals, heat.unit, full, heat.decimals, heat.unit);
}

std::string heat_figure(const ProbeSpace& space, const Heat& heat, double full, const Window& window,
                        const char* when) {
    return fmt::format("<figure class=\"heat\"><figcaption><b>{}</b>{}</figcaption>", heat.title, when) +
           HeatMap(space, heat, full, window).draw() + scale_key(heat, full) + "</figure>\n";
}

std::string numbers_of(const ProbeSpace& space, const Heat& heat, const char* style) {
    const Summary of = summarise(space, heat);
    if (of.worst == nullptr) return fmt::format("<td{0}>\xe2\x80\x93</td><td{0}>\xe2\x80\x93</td>", style);
    return fmt::format("<td{0}>{1:.{3}f}</td><td{0}>{2:.{3}f}</td>", style, of.mean, heat.badness(*of.worst),
                       heat.decimals);
}

/// Mean and worst of each figure in numbers, and where the worst is.
std::string figures_table(const ProbeSpace& now, const ProbeSpace* before) {
    std::string html = fmt::format(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Figures of the probe, {}\"><table><thead>"
        "<tr><th scope=\"col\" class=\"t\">figure</th><th scope=\"col\" class=\"t\">unit</th>",
        escape_html(now.name));
    for (const char* when : {"before, ", ""})
        if (*when == 0 || before != nullptr)
            html += fmt::format("<th scope=\"col\">{0}mean</th><th scope=\"col\">{0}worst</th>", when);
    html += "<th scope=\"col\" class=\"t\">where the worst is</th></tr></thead><tbody>\n";
    for (const Heat& heat : heats()) {
        const Summary of = summarise(now, heat);
        html += fmt::format("<tr><th scope=\"row\" class=\"t\">{}</th><td class=\"t\">{}</td>", heat.title, heat.unit);
        if (before != nullptr) html += numbers_of(*before, heat, " class=\"before\"");
        html += numbers_of(now, heat, "") + fmt::format("<td class=\"w\">{}</td></tr>\n",
                                                        of.worst != nullptr ? escape_html(describe_cell(now, *of.worst))
                                                                            : "nothing could be measured");
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace

std::string probe_section(const Project& project, const ProjectSpace& space) {
    const ProbeSpace* now = space_of(&project.probe, space.name);
    if (now == nullptr || now->cells.empty() || now->axes.empty()) return {};
    const ProbeSpace* before = space_of(project.probe_before ? &*project.probe_before : nullptr, space.name);
    if (before != nullptr && before->axes.empty()) before = nullptr;
    std::string html = fmt::format(
        "<h3>What the blends really do</h3>\n<p>{} blends were played and measured again from their standing feet. The "
        "ring marks the worst; each cell names its numbers and clips under the pointer.{}{}</p>\n",
        now->cells.size(), before != nullptr ? " Left: before the repairs; right: as it is now." : "",
        now->axes.size() > 2 ? " A cell shows the worst over the axes that are not drawn." : "");
    html += figures_table(*now, before) + fmt::format("<div class=\"heats{}\">\n", before != nullptr ? " paired" : "");
    const bool comparable = before != nullptr && has_same_axes(*now, *before);
    const Window window = comparable ? window_of(*now, *before) : window_of(*now);
    for (const Heat& heat : heats()) {
        const double full = std::max(full_scale(heat, *now), before != nullptr ? full_scale(heat, *before) : 0);
        if (before != nullptr)
            html += heat_figure(*before, heat, full, comparable ? window : window_of(*before), ", before");
        html += heat_figure(*now, heat, full, window, before != nullptr ? ", now" : "");
    }
    return html + "</div>\n";
}

}  // namespace surefoot
