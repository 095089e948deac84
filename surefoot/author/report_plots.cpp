// Small plots of one clip: what the feet do over it. Left is drawn solid, right dashed, so that print without colour
// tells them apart; the four states of a foot differ by shape.

#include <surefoot/author/report_parts.h>
#include <surefoot/clip/sample.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double k_width = 200, k_height = 66, k_bar = 8;  // [px] the foot plot: heights above two bars of contacts
constexpr double k_curve_bottom = k_height - 2 * k_bar - 7, k_curve_top = 3;
constexpr double k_phase_size = 66, k_phase_edge = 4;
constexpr float k_least_full_scale = 0.10f;  // [m] so that an idle does not look like a leap

const char* side_name(std::size_t side) { return side == 0 ? "left" : "right"; }

std::string curve(const std::vector<float>& heights, float full_scale, std::size_t side) {
    if (heights.size() < 2) return {};
    std::string points;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const double share = std::clamp(static_cast<double>(heights[i] / full_scale), 0.0, 1.0);
        points +=
            fmt::format("{:.1f},{:.1f} ", k_width * static_cast<double>(i) / static_cast<double>(heights.size() - 1),
                        k_curve_bottom - share * (k_curve_bottom - k_curve_top));
    }
    return fmt::format("<polyline class=\"foot-{}\" points=\"{}\"/>", side_name(side), points);
}

/// A run of equal contacts: flat is a full block, heel the lower half, toe the upper half, lifted only the line.
std::string contact_run(Contact contact, double x0, double x1, double y, std::size_t side) {
    if (contact == Contact::lifted) return {};
    const bool full = contact == Contact::flat;
    return fmt::format("<rect class=\"stand-{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
                       side_name(side), x0, y + (contact == Contact::heel ? 0.55 * k_bar : 0.0), std::max(x1 - x0, 0.6),
                       full ? k_bar : 0.45 * k_bar);
}

std::string contact_bar(const std::vector<Contact>& contacts, std::size_t side) {
    const double y = k_curve_bottom + 4 + static_cast<double>(side) * (k_bar + 3);
    std::string svg = fmt::format("<line class=\"foot-line\" x1=\"0\" y1=\"{0:.1f}\" x2=\"{1:.0f}\" y2=\"{0:.1f}\"/>",
                                  y + 0.5 * k_bar, k_width);
    const auto n = static_cast<double>(contacts.size());
    for (std::size_t from = 0, to; from < contacts.size(); from = to) {
        for (to = from; to < contacts.size() && contacts[to] == contacts[from];) ++to;
        svg += contact_run(contacts[from], k_width * static_cast<double>(from) / n,
                           k_width * static_cast<double>(to) / n, y, side);
    }
    return svg;
}

double standing_share(const std::vector<Contact>& contacts) {
    if (contacts.empty()) return 0;
    const auto lifted = std::count(contacts.begin(), contacts.end(), Contact::lifted);
    return 1 - static_cast<double>(lifted) / static_cast<double>(contacts.size());
}

}  // namespace

std::string foot_plot(const ClipFacts& facts, const ClipFigure& figure) {
    float full_scale = k_least_full_scale;
    double highest[2] = {0, 0};
    for (std::size_t side = 0; side < 2; ++side)
        for (const float h : figure.sole[side]) {
            full_scale = std::max(full_scale, h);
            highest[side] = std::max(highest[side], static_cast<double>(h));
        }
    std::string what;
    for (std::size_t side = 0; side < 2; ++side) {
        what += fmt::format("{}{} sole up to {:.0f} cm", side == 0 ? "" : "; ", side_name(side), 100 * highest[side]);
        if (!facts.contacts[side].empty())
            what += fmt::format(", stands {:.0f} % of the time", 100 * standing_share(facts.contacts[side]));
    }
    if (figure.sole[0].empty() && facts.contacts[0].empty()) return {};
    return fmt::format(
               "<svg class=\"foot-plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\"><title>{} (full "
               "height {:.0f} cm, {:.2f} s)</title><line class=\"foot-line\" x1=\"0\" y1=\"{:.1f}\" x2=\"{:.0f}\" "
               "y2=\"{:.1f}\"/>",
               k_width, k_height, what, what, 100 * full_scale, facts.duration, k_curve_bottom, k_width,
               k_curve_bottom) +
           fmt::format("<text class=\"foot-scale\" x=\"1\" y=\"9\">{:.0f} cm</text>", 100 * full_scale) +
           curve(figure.sole[0], full_scale, 0) + curve(figure.sole[1], full_scale, 1) +
           contact_bar(facts.contacts[0], 0) + contact_bar(facts.contacts[1], 1) + "</svg>";
}

std::string phase_plot(const ClipFacts& facts, const ClipFigure& figure) {
    const PackedClip& clip = figure.packed;
    if (clip.phase_map.size() < 2) return "<span class=\"count\">no steps</span>";
    const double inner = k_phase_size - 2 * k_phase_edge;
    const auto x = [&](double share) { return k_phase_edge + share * inner; };
    const auto y = [&](double phase) { return k_phase_size - k_phase_edge - phase * inner; };
    std::string svg = fmt::format(
        "<svg class=\"phase-plot\" viewBox=\"0 0 {0:.0f} {0:.0f}\" role=\"img\" aria-label=\"phase over "
        "time\"><title>Phase "
        "over time; filled: left foot strikes, hollow: right foot strikes</title><rect class=\"phase-box\" "
        "x=\"{1:.0f}\" "
        "y=\"{1:.0f}\" width=\"{2:.0f}\" height=\"{2:.0f}\"/>",
        k_phase_size, k_phase_edge, inner);
    for (std::size_t i = 1; i < clip.phase_map.size(); ++i) {
        const auto &a = clip.phase_map[i - 1], &b = clip.phase_map[i];
        // Cut where the phase begins anew.
        double from = a[1], share = a[0];
        while (from < b[1] - 1e-6) {
            const double to = std::min(std::floor(from + 1e-6) + 1, static_cast<double>(b[1]));
            const double end = a[0] + (to - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), base = std::floor(from + 1e-6);
            svg += fmt::format("<line class=\"phase-line\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
                               x(share), y(from - base), x(end), y(to - base));
            from = to, share = end;
        }
    }
    for (const PhaseEvent& event : facts.events) {
        if (event.kind != StrideEvent::strike || !(facts.duration > 0)) continue;
        const double phase = phase_at(clip, event.time);
        svg += fmt::format("<circle class=\"strike-{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\"/>",
                           side_name(static_cast<std::size_t>(event.foot)),
                           x(std::clamp(static_cast<double>(event.time / facts.duration), 0.0, 1.0)),
                           y(phase + 1e-4 - std::floor(phase + 1e-4)));
    }
    return svg + "</svg>";
}

}  // namespace surefoot
