#include <surefoot/author/lint.h>
#include <surefoot/author/place.h>
#include <surefoot/author/report.h>
#include <surefoot/author/report_style.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot {
namespace {

std::string escaped(const std::string& text) { return escape_html(text); }

std::string plural(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::size_t count_of(const Project& project, Severity severity) {
    return static_cast<std::size_t>(std::count_if(project.findings.begin(), project.findings.end(),
                                                  [&](const Finding& f) { return f.severity == severity; }));
}

std::string tiles(const Project& project) {
    const auto used = static_cast<std::size_t>(
        std::count_if(project.clips.begin(), project.clips.end(), [](const ProjectClip& c) { return !c.excluded; }));
    std::string html = "<ul class=\"tiles\">";
    const auto tile = [&](std::size_t count, const char* one, const char* many) {
        html += fmt::format("<li><b>{}</b><span>{}</span></li>", count, count == 1 ? one : many);
    };
    tile(used, "clip in use", "clips in use");
    tile(project.spaces.size(), "blend space", "blend spaces");
    tile(count_of(project, Severity::error), "error", "errors");
    tile(count_of(project, Severity::warning), "warning", "warnings");
    tile(count_of(project, Severity::info), "note", "notes");
    tile(project.clips.size() - used, "clip left out", "clips left out");
    return html + "</ul>\n";
}

struct LegendEntry {
    const char *rule, *text;
    std::string drawing;
};

/// Only what the drawing really shows.
std::string legend(const Project& project, const ProjectSpace& space) {
    const auto svg = [](const std::string& inside) {
        return "<svg viewBox=\"0 0 30 22\" aria-hidden=\"true\">" + inside + "</svg>";
    };
    const LegendEntry entries[] = {
        {"crossing-axis", "crosses an axis",
         "<line class=\"crossing\" x1=\"1\" y1=\"18\" x2=\"29\" y2=\"4\"/><line class=\"cross\" x1=\"10\" y1=\"6\" "
         "x2=\"20\" "
         "y2=\"16\"/><line class=\"cross\" x1=\"10\" y1=\"16\" x2=\"20\" y2=\"6\"/>"},
        {"opposite-directions", "blends opposite directions",
         "<line class=\"opposite\" x1=\"2\" y1=\"11\" x2=\"28\" y2=\"11\"/>"},
        {"acute-triangle", "sliver",
         "<polygon class=\"acute\" points=\"1,17 29,17 23,8\"/><circle class=\"dot\" cx=\"17\" cy=\"14\" "
         "r=\"1.3\"/><circle "
         "class=\"dot\" cx=\"22\" cy=\"13\" r=\"1.3\"/>"},
        {"misaligned", "misaligned",
         diamond("misaligned", 15, 11, 9.5) + "<circle class=\"sample\" cx=\"15\" cy=\"11\" r=\"4\"/>"},
        {"too-close", "too close to each other",
         "<rect class=\"close\" x=\"2\" y=\"4\" width=\"26\" height=\"14\" rx=\"7\"/>"},
        {"duplicate", "the same clip twice",
         "<rect class=\"close\" x=\"6\" y=\"2\" width=\"18\" height=\"18\" rx=\"9\"/>"},
        {"dissimilar-neighbours", "poses far apart",
         "<line class=\"dissimilar\" x1=\"2\" y1=\"11\" x2=\"28\" y2=\"11\"/>"},
    };
    std::string html =
        "<ul class=\"legend\"><li>" + svg("<circle class=\"sample\" cx=\"15\" cy=\"11\" r=\"6.5\"/>") + "a clip</li>";
    for (const LegendEntry& entry : entries)
        if (std::any_of(project.findings.begin(), project.findings.end(),
                        [&](const Finding& f) { return f.rule == entry.rule && f.space == space.name; }))
            html += "<li>" + svg(entry.drawing) + entry.text + "</li>";
    for (const PlaceholderKind kind : {PlaceholderKind::needed, PlaceholderKind::suggested})
        if (std::any_of(project.placeholders.begin(), project.placeholders.end(), [&](const Placeholder& p) {
                return p.kind == kind && p.space == space.name && p.rule != "too-close";
            }))
            html += "<li>" + svg(placeholder_mark(kind, 15, 11)) +
                    (kind == PlaceholderKind::needed ? "a clip is needed here" : "a clip would help here") + "</li>";
    if (space.space.dimensions() > 1)
        html += "<li>" + svg("<path class=\"hatch\" d=\"M2 20L20 2M9 20L27 2M16 20L29 7M2 13L13 2\"/>") +
                "not covered</li>";
    return html + "</ul>";
}

std::string wanted(const Project& project, const ProjectSpace& space) {
    std::string html;
    for (const PlaceholderKind kind : {PlaceholderKind::needed, PlaceholderKind::suggested})
        for (const Placeholder& placeholder : project.placeholders) {
            if (placeholder.space != space.name || placeholder.kind != kind || placeholder.rule == "too-close")
                continue;
            html += "<li><svg viewBox=\"0 0 24 22\" aria-hidden=\"true\">" + placeholder_mark(kind, 12, 11) +
                    "</svg><span>" + escaped(placeholder.text) + " <span class=\"count\">(" +
                    (kind == PlaceholderKind::needed ? "needed" : "suggested") + ", " + escaped(placeholder.rule) +
                    ")</span></span></li>";
        }
    if (html.empty()) return {};
    return "<h3>Clips that are missing</h3>\n<ul class=\"wanted\">" + html + "</ul>\n";
}

std::string space_section(const Project& project, const ProjectSpace& space) {
    std::string axes;
    for (const Axis& axis : space.space.axes) axes += (axes.empty() ? "" : " \xc3\x97 ") + axis.name;
    std::string html =
        fmt::format("<h2>Space \xe2\x80\x9c{}\xe2\x80\x9d: {}</h2>\n", escaped(space.name), escaped(axes));
    const auto edges = space.space.simplices.size();
    html += fmt::format(
        "<p>{}, {}. The character is steered by naming a point; it then blends the clips at the corners "
        "around it. Outside, it takes the nearest point.</p>\n",
        plural(space.clips.size(), "clip", "clips"),
        space.space.dimensions() == 1   ? plural(edges, "segment", "segments")
        : space.space.dimensions() == 2 ? plural(edges, "triangle", "triangles")
                                        : plural(edges, "simplex", "simplices"));
    html += "<figure>\n" + space_svg(project, space) + legend(project, space) + "</figure>\n";
    return html + wanted(project, space);
}

std::string finding_line(const Finding& finding) {
    std::string html = escaped(finding.message);
    if (finding.fix) html += " <span class=\"fix\"><b>Mend it:</b> " + escaped(finding.fix->text) + ".</span>";
    return html;
}

std::string findings_section(const Project& project) {
    std::string html = "<h2>Findings</h2>\n";
    if (project.findings.empty()) return html + "<p>None: nothing stands in the way of smooth blends.</p>\n";
    html += "<ul class=\"findings\">\n";
    // By rule, the worst first; findings of one rule may differ in severity.
    std::set<std::pair<std::string, Severity>> done;
    for (const Finding& first : project.findings) {
        if (!done.insert({first.rule, first.severity}).second) continue;
        std::vector<const Finding*> group;
        for (const Finding& finding : project.findings)
            if (finding.rule == first.rule && finding.severity == first.severity) group.push_back(&finding);
        const auto& rules = lint_rules();
        const auto rule =
            std::find_if(rules.begin(), rules.end(), [&](const LintRule& r) { return r.id == first.rule; });
        const std::string title = rule == rules.end() ? first.rule : rule->title;
        const std::string help = rule == rules.end() ? std::string() : rule->help;
        html += fmt::format(
            "<li class=\"{0}\"><span class=\"chip {0}\">{0}</span><span class=\"rule\">{1}</span> <span "
            "class=\"count\"><code>{2}</code>{3}</span><br>\n",
            severity_name(first.severity), escaped(title), escaped(first.rule),
            group.size() > 1 ? fmt::format(" \xc3\x97 {}", group.size()) : "");
        constexpr std::size_t k_shown_openly = 3;
        if (group.size() == 1) {
            html += finding_line(first);
        } else {
            html += escaped(help);
            html += group.size() > k_shown_openly ? "<details><summary>Show all</summary><ul>"
                                                  : "<details open><summary>"
                                                    "Each</summary><ul>";
            for (const Finding* finding : group) html += "<li>" + finding_line(*finding) + "</li>\n";
            html += "</ul></details>";
        }
        html += "</li>\n";
    }
    return html + "</ul>\n";
}

std::string cell(double value, int decimals) {
    const double small = decimals == 0 ? 0.5 : decimals == 1 ? 0.05 : 0.005;
    return fmt::format("<td>{:.{}f}</td>", std::fabs(value) < small ? 0.0 : value, decimals);
}

std::string clip_row(std::size_t index, const ProjectClip& clip) {
    const ClipFacts& f = clip.facts;
    std::string html = fmt::format("<tr><td>{}</td><td class=\"t\">{}</td>", index + 1, escaped(clip.name));
    html += cell(f.speed, 2) + cell(f.forward, 2) + cell(f.lateral, 2) + cell(f.turn, 0);
    html += f.cadence > 0 ? cell(f.cadence, 0) + cell(f.stride, 2) : "<td>\xe2\x80\x93</td><td>\xe2\x80\x93</td>";
    html += cell(f.duration, 2) + cell(100 * f.skate, 1) + cell(100 * f.seam, 1) + cell(100 * f.closing, 1);
    std::string history;
    for (const std::string& step : clip.provenance) history += (history.empty() ? "" : "; ") + step;
    if (!clip.pins.empty()) history += std::string(history.empty() ? "" : "; ") + "placed by hand";
    const std::string file = clip.source.substr(clip.source.find_last_of('/') + 1);  // npos + 1 is 0
    return html + fmt::format("<td class=\"w\" title=\"{}\">{}{}{}</td></tr>\n", escaped(clip.source), escaped(file),
                              history.empty() ? "" : ": ", escaped(history));
}

std::string clips_section(const Project& project) {
    std::string html =
        "<h2>Clips in use</h2>\n<div class=\"scroll\"><table><thead><tr><th>no.</th><th "
        "class=\"t\">name</th><th>speed<br>"
        "m/s</th><th>forward<br>m/s</th><th>to left<br>m/s</th><th>turn<br>deg/s</th><th>steps<br>a "
        "min</th><th>stride<br>"
        "m</th><th>length<br>s</th><th>skate<br>cm/s</th><th>seam<br>cm</th><th>closing<br>cm</th><th "
        "class=\"t\">comes "
        "from</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < project.clips.size(); ++i)
        if (!project.clips[i].excluded) html += clip_row(i, project.clips[i]);
    return html + "</tbody></table></div>\n";
}

std::string left_out_section(const Project& project, const ReportExtras& extras) {
    std::string rows;
    for (const ProjectClip& clip : project.clips)
        if (clip.excluded)
            rows += fmt::format("<tr><td class=\"t\">{}</td><td class=\"w\">{}{}</td></tr>\n", escaped(clip.name),
                                clip.excluded_by_user ? "by hand. " : "", escaped(clip.reason));
    for (const std::string& failed : extras.failed)
        rows += fmt::format("<tr><td class=\"t\">not read</td><td class=\"w\">{}</td></tr>\n", escaped(failed));
    if (rows.empty()) return {};
    return "<h2>Clips left out</h2>\n<div class=\"scroll\"><table><thead><tr><th class=\"t\">name</th><th "
           "class=\"t\">reason"
           "</th></tr></thead><tbody>\n" +
           rows + "</tbody></table></div>\n";
}

std::string footer(const Project& project, const ReportExtras& extras) {
    std::string html = "<footer>\n";
    if (!project.lint.empty()) {
        html += "<p>Lint settings of this project differ from the defaults:";
        for (const auto& [rule, setting] : project.lint) {
            html += " <code>" + escaped(rule) + "</code>";
            if (setting.enabled && !*setting.enabled) html += " off";
            if (setting.severity) html += fmt::format(" is {}", severity_name(*setting.severity));
            for (const auto& [name, value] : setting.thresholds) html += fmt::format(" {} {:g}", escaped(name), value);
            html += ";";
        }
        html += "</p>\n";
    }
    for (const std::string& warning : extras.warnings) html += "<p>" + escaped(warning) + "</p>\n";
    html +=
        "<p>Distances in a space are in percent of each axis\xe2\x80\x99 range, 0 included. Speed is signed: negative "
        "is "
        "backward. Turn is positive to the character\xe2\x80\x99s left.</p>\n</footer>\n";
    return html;
}

}  // namespace

std::string escape_html(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                // Control characters have no place in HTML.
                if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
                    result += c;
                else
                    result += ' ';
        }
    }
    return result;
}

std::string report_html(const Project& project, const ReportExtras& extras) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n<style>{1}</style></head><body>\n"
        "<h1>{0}</h1>\n<p class=\"lead\">What these clips do, where they stand, and what will go wrong when they are "
        "blended.</p>\n",
        escaped(project.name), report_style());
    html += tiles(project);
    for (const ProjectSpace& space : project.spaces) html += space_section(project, space);
    html += findings_section(project) + clips_section(project) + left_out_section(project, extras);
    return html + footer(project, extras) + "</body></html>\n";
}

}  // namespace surefoot
