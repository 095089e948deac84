#include <surefoot/author/page.h>
#include <surefoot/author/report_parts.h>
#include <surefoot/author/report_style.h>

#include <fmt/format.h>

#include <algorithm>

namespace surefoot {
namespace {

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

std::string footer(const Project& project, const ReportExtras& extras) {
    std::string html = "<footer>\n";
    if (!project.lint.empty()) {
        html += "<p>Lint settings of this project differ from the defaults:";
        for (const auto& [rule, setting] : project.lint) {
            html += " <code>" + escape_html(rule) + "</code>";
            if (setting.enabled && !*setting.enabled) html += " off";
            if (setting.severity) html += fmt::format(" is {}", severity_name(*setting.severity));
            for (const auto& [name, value] : setting.thresholds)
                html += fmt::format(" {} {:g}", escape_html(name), value);
            html += ";";
        }
        html += "</p>\n";
    }
    for (const std::string& warning : extras.warnings) html += "<p>" + escape_html(warning) + "</p>\n";
    html +=
        "<p>Distances in a space are in percent of each axis\xe2\x80\x99 range, 0 included. Speed is signed: negative "
        "is backward. Turn is positive to the character\xe2\x80\x99s left.</p>\n</footer>\n";
    return html;
}

}  // namespace

std::string counted(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

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
    static const ClipFigures k_none;
    const ClipFigures& figures = extras.figures != nullptr ? *extras.figures : k_none;
    const std::string preview = preview_json(project, figures);
    HtmlPage page;
    page.title = project.name;
    page.lead = "What these clips do, where they stand, and what will go wrong when they are blended.";
    page.main = tiles(project);
    for (std::size_t s = 0; s < project.spaces.size(); ++s) page.main += space_section(project, s, !preview.empty());
    page.main += findings_section(project) + repairs_section(project) + clips_section(project, figures) +
                 left_out_section(project, extras) + footer(project, extras);
    if (!preview.empty())
        page.tail = "<script type=\"application/json\" id=\"preview-data\">" + preview + "</script>\n";
    page.styles = {page_style()};
    page.scripts = {{report_script(), report_script_sha256()}};
    return html_page(page);
}

}  // namespace surefoot
