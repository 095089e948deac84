// Plots of one walk over time, one above the other. Left is solid and right dashed, as in the report; modes differ by
// dash as well as by colour.

#include <surefoot/course/walk_page.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace surefoot {
namespace {

using Out = std::back_insert_iterator<std::string>;

constexpr float k_width = 1000, k_left = 52, k_right = 8;  // [px]
constexpr float k_time_row = 26, k_gap = 30;
constexpr float k_longest = 24;     // [s] shown: an eight, once
constexpr float k_knee_least = 40;  // [deg] the mark

/// A plot's place and range: y0 is the value at its bottom.
struct Panel {
    float top, height, y0, y1, seconds;

    bool shows(std::size_t sample) const {
        return static_cast<float>(sample) * k_trace_stride / k_walk_fps <= seconds + 1e-3f;
    }
    float x(std::size_t sample) const {
        return k_left +
               static_cast<float>(sample) * k_trace_stride / k_walk_fps / seconds * (k_width - k_left - k_right);
    }
    float y(float value) const { return top + height * (1 - (std::clamp(value, y0, y1) - y0) / (y1 - y0)); }
};

/// Whole pixels across, tenths down, each relative to the one before: short.
std::string path_of(const Panel& panel, const Trace& trace) {
    std::string path;
    int last_x = 0, last_y = 0;
    for (std::size_t i = 0; i < trace.size() && panel.shows(i); ++i) {
        const auto x = static_cast<int>(std::lround(10 * panel.x(i))),
                   y = static_cast<int>(std::lround(10 * panel.y(trace[i])));
        if (i == 0)
            fmt::format_to(Out(path), "M{:g} {:g}", x / 10.0, y / 10.0);
        else
            fmt::format_to(Out(path), "l{:g} {:g}", (x - last_x) / 10.0, (y - last_y) / 10.0);
        last_x = x, last_y = y;
    }
    return path;
}

void curve(std::string& svg, const Panel& panel, const Trace& trace, const std::string& style) {
    if (trace.size() > 1) fmt::format_to(Out(svg), "<path class=\"{}\" d=\"{}\"/>\n", style, path_of(panel, trace));
}

/// A round step that cuts `range` into five at most.
float tick_step(float range) {
    for (float power = 0.1f;; power *= 10)
        for (const float step : {1.0f, 2.0f, 5.0f})
            if (step * power * 5 >= range) return step * power;
}

void frame(std::string& svg, const Panel& panel, const char* title) {
    fmt::format_to(Out(svg), "<text class=\"title\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", k_left, panel.top - 8,
                   title);
    const float step = tick_step(panel.y1 - panel.y0);
    for (float value = std::ceil(panel.y0 / step) * step; value <= panel.y1 + 1e-3f; value += step) {
        const float y = panel.y(value);
        fmt::format_to(Out(svg),
                       "<line class=\"{0}\" x1=\"{1:.0f}\" x2=\"{2:.0f}\" y1=\"{3:.1f}\" y2=\"{3:.1f}\"/><text "
                       "class=\"tick\" text-anchor=\"end\" x=\"{4:.0f}\" y=\"{5:.1f}\">{6:g}</text>\n",
                       std::fabs(value) < 1e-4f ? "base" : "grid", k_left, k_width - k_right, y, k_left - 6, y + 4,
                       std::fabs(value) < 1e-4f ? 0.0f : value);
    }
}

void widen(float& low, float& high, const Trace& trace) {
    for (const float value : trace) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
}

/// The row that the page judges: the last, which is mode surefoot where it is walked.
const WalkTraces& judged(const SweptWalk& walk) { return walk.traces.back(); }

void feet(std::string& svg, Panel panel, const SweptWalk& walk) {
    for (const Trace& trace : judged(walk).foot_cm) widen(panel.y0, panel.y1, trace);
    panel.y1 += 1;
    frame(svg, panel, "Lowest point of each sole over the ground, cm");
    const float ground = panel.y(0);
    fmt::format_to(Out(svg), "<rect class=\"inside\" x=\"{:.0f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"{:.1f}\"/>\n",
                   k_left, ground, k_width - k_left - k_right, panel.top + panel.height - ground);
    curve(svg, panel, judged(walk).foot_cm[0], "foot-left");
    curve(svg, panel, judged(walk).foot_cm[1], "foot-right");
}

/// Less what the twin's hips are above flat ground on average: on level ground all stay near its line.
void hips(std::string& svg, Panel panel, const SweptWalk& walk) {
    double sum = 0;
    for (const float height : walk.twin.hips_cm) sum += static_cast<double>(height);
    const auto stand =
        static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(walk.twin.hips_cm.size(), 1)));
    std::vector<Trace> lowered;
    for (const WalkTraces& traces : walk.traces) {
        lowered.push_back(traces.hips_cm);
        for (float& height : lowered.back()) height -= stand;
        widen(panel.y0, panel.y1, lowered.back());
    }
    widen(panel.y0, panel.y1, walk.ground_cm);
    frame(svg, panel, "Hips, less their height on flat ground, and the ground under the root, cm");
    fmt::format_to(Out(svg), "<path class=\"earth\" d=\"{}V{:.1f}H{:.1f}z\"/>\n", path_of(panel, walk.ground_cm),
                   panel.top + panel.height, k_left);
    for (std::size_t i = 0; i < lowered.size(); ++i)
        curve(svg, panel, lowered[i], fmt::format("mode-{}", foot_mode_name(walk.rows[i].mode)));
}

void knees(std::string& svg, const Panel& panel, const SweptWalk& walk) {
    frame(svg, panel, "Knees, degrees (180: straight); thin: on flat ground");
    const float least = panel.y(k_knee_least);
    fmt::format_to(Out(svg), "<line class=\"limit\" x1=\"{0:.0f}\" x2=\"{1:.0f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n",
                   k_left, k_width - k_right, least);
    curve(svg, panel, walk.twin.knee_deg[0], "twin");
    curve(svg, panel, walk.twin.knee_deg[1], "twin right");
    curve(svg, panel, judged(walk).knee_deg[0], "foot-left");
    curve(svg, panel, judged(walk).knee_deg[1], "foot-right");
}

void seconds_axis(std::string& svg, const Panel& panel) {
    const float step = panel.seconds > 40 ? 10 : panel.seconds > 12 ? 2 : 1;
    for (float t = 0; t <= panel.seconds + 1e-3f; t += step)
        fmt::format_to(Out(svg),
                       "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.0f}\" y=\"{:.0f}\">{:g}{}</text>\n",
                       std::min(k_left + t / panel.seconds * (k_width - k_left - k_right), k_width - 14),
                       panel.top + panel.height + 16, t, t + step > panel.seconds + 1e-3f ? " s" : "");
}

}  // namespace

std::string walk_plots(const SweptWalk& walk) {
    if (walk.traces.empty()) return {};
    constexpr float k_feet = 110, k_hips = 110, k_knees = 130;  // [px] heights
    float top = 22;
    const float seconds = std::min(walk.info.seconds, k_longest);
    const Panel feet_panel{top, k_feet, -2, 12, seconds};
    top += k_feet + k_gap;
    const Panel hips_panel{top, k_hips, -6, 6, seconds};
    top += k_hips + k_gap;
    const Panel knees_panel{top, k_knees, 20, 180, seconds};
    top += k_knees;
    std::string svg =
        fmt::format("<svg class=\"walk-plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", k_width,
                    top + k_time_row, walk_title(walk.info));
    feet(svg, feet_panel, walk);
    hips(svg, hips_panel, walk);
    knees(svg, knees_panel, walk);
    seconds_axis(svg, knees_panel);
    return svg + "</svg>\n";
}

}  // namespace surefoot
