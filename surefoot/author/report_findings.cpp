// The report's list of findings: by rule, the worst first, each with its fix and the way to its mark.

#include <surefoot/author/lint.h>
#include <surefoot/author/report_parts.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

namespace surefoot {
namespace {

/// Where a finding can be seen: its mark in a drawing, and the rows of its clips.
std::string ways(const Project& project, const Finding& finding, std::size_t index) {
    std::string links;
    if (!finding.space.empty())
        links += fmt::format(" <a class=\"way\" href=\"#spot-{}\">show in \xe2\x80\x9c{}\xe2\x80\x9d</a>", index,
                             escape_html(finding.space));
    for (const std::string& name : finding.clips)
        if (const int clip = project.find_clip(name);
            clip >= 0 && !project.clips[static_cast<std::size_t>(clip)].excluded)
            links += fmt::format(" <a class=\"way\" href=\"#clip-{}\">{}</a>", clip + 1, escape_html(name));
    return links;
}

std::string finding_text(const Project& project, const Finding& finding) {
    const auto index = static_cast<std::size_t>(&finding - project.findings.data());
    std::string html = fmt::format("<div class=\"finding\" id=\"finding-{0}\" data-finding=\"{0}\">", index);
    html += escape_html(finding.message);
    if (finding.fix) html += " <span class=\"fix\"><b>Mend it:</b> " + escape_html(finding.fix->text) + ".</span>";
    return html + ways(project, finding, index) + "</div>";
}

std::string rule_help(const std::string& id) {
    const auto& rules = lint_rules();
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const LintRule& r) { return r.id == id; });
    return rule == rules.end() ? std::string() : rule->help;
}

std::string rule_title(const std::string& id) {
    const auto& rules = lint_rules();
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const LintRule& r) { return r.id == id; });
    return rule == rules.end() ? id : rule->title;
}

std::string group_of(const Project& project, const std::vector<const Finding*>& group) {
    const Finding& first = *group.front();
    std::string html = fmt::format(
        "<li class=\"{0}\"><h3><span class=\"chip {0}\">{0}</span><span class=\"rule\">{1}</span> <span "
        "class=\"count\"><code>{2}</code>{3}</span></h3>\n",
        severity_name(first.severity), escape_html(rule_title(first.rule)), escape_html(first.rule),
        group.size() > 1 ? fmt::format(" \xc3\x97 {}", group.size()) : "");
    const std::string help = rule_help(first.rule);
    if (!help.empty()) html += "<p class=\"help\">" + escape_html(help) + "</p>\n";
    constexpr std::size_t k_shown_openly = 3;
    const bool folded = group.size() > k_shown_openly;
    if (folded) html += fmt::format("<details><summary>All {}</summary>", group.size());
    for (const Finding* finding : group) html += finding_text(project, *finding) + "\n";
    return html + (folded ? "</details></li>\n" : "</li>\n");
}

}  // namespace

std::string findings_section(const Project& project) {
    std::string html = "<section><h2>Findings</h2>\n";
    if (project.findings.empty()) return html + "<p>None: nothing stands in the way of smooth blends.</p></section>\n";
    html += "<ul class=\"findings\">\n";
    // Findings of one rule may differ in severity.
    std::set<std::pair<std::string, Severity>> done;
    for (const Finding& first : project.findings) {
        if (!done.insert({first.rule, first.severity}).second) continue;
        std::vector<const Finding*> group;
        for (const Finding& finding : project.findings)
            if (finding.rule == first.rule && finding.severity == first.severity) group.push_back(&finding);
        html += group_of(project, group);
    }
    return html + "</ul></section>\n";
}

std::string repairs_section(const Project& project) {
    if (project.repairs.empty()) return {};
    std::string html =
        "<section><h2>Repairs</h2>\n<p>Made by <code>--fix</code>; each can be taken back with the command beside it, "
        "run "
        "with this project\xe2\x80\x99s folder, all of them with <code>surefoot fix PROJECT "
        "--undo-all</code>.</p>\n<ul>\n";
    for (const ProjectRepair& repair : project.repairs)
        html +=
            fmt::format("<li>{} <span class=\"count\">({})</span> <code>surefoot fix PROJECT --undo {}</code></li>\n",
                        escape_html(repair.text), escape_html(repair.rule), escape_html(repair.id));
    return html + "</ul></section>\n";
}

}  // namespace surefoot
