#include <surefoot/author/plot_frame.h>
#include <surefoot/author/report.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

bool runs_to_the_left(const Axis& axis) {
    return axis.name == "turn" || axis.name == "lateral" || axis.name == "travel";
}

double tick_step(const Axis& axis, double range) {
    const double rough = range / 8;
    const bool angle = axis.unit == "deg" || axis.unit == "deg/s";
    if (angle) {
        for (const double step : {1.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0})
            if (step >= rough) return step;
        return rough;
    }
    double decade = 1;
    while (decade > rough) decade /= 10;
    while (10 * decade < rough) decade *= 10;
    for (const double step : {1.0, 2.0, 5.0})
        if (step * decade >= rough) return step * decade;
    return 10 * decade;
}

template <typename Each>
void for_ticks(double low, double high, double step, const Each& each) {
    for (int n = static_cast<int>(std::ceil(low / step - 1e-9)); n * step <= high + 1e-9 * step; ++n) each(n * step);
}

std::string title(const Axis& axis, bool across) {
    const char* sides = across ? "   (\xe2\x86\x90 to its left, to its right \xe2\x86\x92)"
                               : "   (to its right \xe2\x86\x90 \xe2\x86\x92 to its left)";
    if (axis.name == "turn") return std::string("turn, deg/s") + sides;
    if (axis.name == "lateral") return std::string("sideways speed, m/s") + sides;
    if (axis.name == "travel") return std::string("direction of travel, deg") + sides;
    if (axis.name == "forward") return "forward speed, m/s";
    return axis.name + (axis.unit.empty() ? "" : ", " + axis.unit);
}

}  // namespace

std::string svg_line(const char* style, double x0, double y0, double x1, double y1) {
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", style, x0, y0,
                       x1, y1);
}

std::string svg_text(const char* style, double x, double y, const std::string& text, const char* anchor) {
    return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", style, x, y,
                       anchor, escape_html(text));
}

void PlotFrame::include(double x, double y) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
}

void PlotFrame::add_margin() {
    const double margin_x = 0.07 * (high_x - low_x), margin_y = 0.07 * (high_y - low_y);
    low_x -= margin_x, high_x += margin_x, low_y -= margin_y, high_y += margin_y;
}

double PlotFrame::x(double value) const {
    const double share = (value - low_x) / (high_x - low_x);
    return left + (runs_to_the_left(across) ? 1 - share : share) * (width - left - right);
}

double PlotFrame::y(double value) const {
    return height - bottom - (value - low_y) / (high_y - low_y) * (height - top - bottom);
}

std::string PlotFrame::background() const {
    const double x0 = x(low_x), x1 = x(high_x), y0 = y(low_y), y1 = y(high_y);
    return fmt::format("<rect class=\"plot\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                       std::min(x0, x1), y1, std::fabs(x1 - x0), y0 - y1);
}

std::string PlotFrame::grid() const {
    std::string out;
    const double x0 = x(low_x), x1 = x(high_x), y0 = y(low_y), y1 = y(high_y);
    for_ticks(low_x, high_x, tick_step(across, high_x - low_x), [&](double v) {
        out += svg_line("grid", x(v), y0, x(v), y1);
        if (has_across) out += svg_text("tick", x(v), y0 + 16, fmt::format("{:g}", v), "middle");
    });
    for_ticks(low_y, high_y, tick_step(up, high_y - low_y), [&](double v) {
        out += svg_line("grid", x0, y(v), x1, y(v));
        if (has_up) out += svg_text("tick", left - 8, y(v) + 4, fmt::format("{:g}", v), "end");
    });
    return out;
}

std::string PlotFrame::titles() const {
    const double middle_x = 0.5 * (left + width - right), middle_y = 0.5 * (top + height - bottom);
    return svg_text(has_across ? "title" : "title absent", middle_x, height - 14,
                    has_across ? title(across, true) : "no clip differs in " + across.name, "middle") +
           fmt::format(
               "<text class=\"{}\" transform=\"translate(20 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}"
               "</text>\n",
               has_up ? "title" : "title absent", middle_y,
               escape_html(has_up ? title(up, false) : "no clip differs in " + up.name));
}

}  // namespace surefoot
