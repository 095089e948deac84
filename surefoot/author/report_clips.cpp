// The report's tables of clips.

#include <surefoot/author/report_parts.h>

#include <fmt/format.h>

#include <cmath>

namespace surefoot {
namespace {

std::string cell(double value, int decimals) {
    const double small = decimals == 0 ? 0.5 : decimals == 1 ? 0.05 : 0.005;
    return fmt::format("<td>{:.{}f}</td>", std::fabs(value) < small ? 0.0 : value, decimals);
}

/// Where a clip comes from and what was done to it.
std::string history(const ProjectClip& clip) {
    std::string steps;
    for (const std::string& step : clip.provenance) steps += (steps.empty() ? "" : "; ") + step;
    if (!clip.pins.empty()) steps += std::string(steps.empty() ? "" : "; ") + "placed by hand";
    const std::string file = clip.source.substr(clip.source.find_last_of('/') + 1);  // npos + 1 is 0
    return fmt::format("<span class=\"from\" title=\"{}\">{}{}{}</span>", escape_html(clip.source), escape_html(file),
                       steps.empty() ? "" : ": ", escape_html(steps));
}

std::string clip_row(std::size_t index, const ProjectClip& clip, const ClipFigure& figure) {
    const ClipFacts& f = clip.facts;
    std::string html = fmt::format("<tr id=\"clip-{0}\"><td>{0}</td><td class=\"w\"><b>{1}</b>{2}</td>", index + 1,
                                   escape_html(clip.name), history(clip));
    html += "<td class=\"plot-cell\">" + foot_plot(f, figure) + "</td><td class=\"plot-cell\">" +
            phase_plot(f, figure) + "</td>";
    html += cell(f.speed, 2) + cell(f.forward, 2) + cell(f.lateral, 2) + cell(f.turn, 0);
    html += f.cadence > 0 ? cell(f.cadence, 0) + cell(f.stride, 2) : "<td>\xe2\x80\x93</td><td>\xe2\x80\x93</td>";
    html += cell(f.duration, 2) + cell(100 * f.skate, 1) + cell(100 * f.seam, 1) + cell(100 * f.closing, 1);
    return html + "</tr>\n";
}

/// How to read the plots.
const char* plot_key() {
    return "<ul class=\"legend\">"
           "<li><svg viewBox=\"0 0 30 22\" aria-hidden=\"true\"><line class=\"foot-left\" x1=\"1\" y1=\"11\" x2=\"29\" "
           "y2=\"11\"/></svg>left sole\xe2\x80\x99s height</li>"
           "<li><svg viewBox=\"0 0 30 22\" aria-hidden=\"true\"><line class=\"foot-right\" x1=\"1\" y1=\"11\" "
           "x2=\"29\" "
           "y2=\"11\"/></svg>right sole\xe2\x80\x99s height</li>"
           "<li><svg viewBox=\"0 0 30 22\" aria-hidden=\"true\"><line class=\"foot-line\" x1=\"0\" y1=\"11\" x2=\"30\" "
           "y2=\"11\"/><rect class=\"stand-left\" x=\"1\" y=\"12.4\" width=\"7\" height=\"3.6\"/><rect "
           "class=\"stand-left\" "
           "x=\"8\" y=\"7\" width=\"12\" height=\"8.5\"/><rect class=\"stand-left\" x=\"20\" y=\"7\" width=\"8\" "
           "height=\"3.6\"/></svg>stands on heel, flat, toe</li>"
           "<li><svg viewBox=\"0 0 30 22\" aria-hidden=\"true\"><circle class=\"strike-left\" cx=\"15\" cy=\"11\" "
           "r=\"4.5\"/></svg>left foot strikes</li>"
           "<li><svg viewBox=\"0 0 30 22\" aria-hidden=\"true\"><circle class=\"strike-right\" cx=\"15\" cy=\"11\" "
           "r=\"4.5\"/></svg>right foot strikes</li></ul>\n";
}

}  // namespace

std::string clips_section(const Project& project, const ClipFigures& figures) {
    std::string html =
        "<section class=\"clips\"><h2>Clips in use</h2>\n<p>Each clip over one pass: how high the soles go and when "
        "the "
        "feet stand, left above right; then the phase that blending aligns, from left strike to left strike.</p>\n" +
        std::string(plot_key()) +
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Clips in use\"><table><thead><tr><th "
        "scope=\"col\">no.</th><th scope=\"col\" class=\"t\">name, origin</th><th scope=\"col\" "
        "class=\"t\">feet</th><th "
        "scope=\"col\" class=\"t\">phase</th><th scope=\"col\">speed<br>m/s</th><th "
        "scope=\"col\">forward<br>m/s</th><th "
        "scope=\"col\">to left<br>m/s</th><th scope=\"col\">turn<br>deg/s</th><th scope=\"col\">steps<br>a min</th><th "
        "scope=\"col\">stride<br>m</th><th scope=\"col\">length<br>s</th><th scope=\"col\">skate<br>cm/s</th><th "
        "scope=\"col\">seam<br>cm</th><th scope=\"col\">closing<br>cm</th></tr></thead><tbody>\n";
    const ClipFigure none;
    for (std::size_t i = 0; i < project.clips.size(); ++i)
        if (!project.clips[i].excluded)
            html += clip_row(i, project.clips[i], i < figures.clips.size() ? figures.clips[i] : none);
    return html + "</tbody></table></div></section>\n";
}

std::string left_out_section(const Project& project, const ReportExtras& extras) {
    std::string rows;
    for (const ProjectClip& clip : project.clips)
        if (clip.excluded)
            rows += fmt::format("<tr><td class=\"t\">{}</td><td class=\"w\">{}{}</td></tr>\n", escape_html(clip.name),
                                clip.excluded_by_user ? "by hand. " : "", escape_html(clip.reason));
    for (const std::string& failed : extras.failed)
        rows += fmt::format("<tr><td class=\"t\">not read</td><td class=\"w\">{}</td></tr>\n", escape_html(failed));
    if (rows.empty()) return {};
    return "<section><h2>Clips left out</h2>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Clips "
           "left "
           "out\"><table><thead><tr><th scope=\"col\" class=\"t\">name</th><th scope=\"col\" "
           "class=\"t\">reason</th></tr></thead><tbody>\n" +
           rows + "</tbody></table></div></section>\n";
}

}  // namespace surefoot
