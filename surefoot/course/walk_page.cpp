#include <surefoot/author/page.h>
#include <surefoot/author/report.h>
#include <surefoot/course/walk_page.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace surefoot {

const char* walk_page_style();
const char* walk_page_style_sha256();
const char* walk_page_script();
const char* walk_page_script_sha256();

namespace {

using Out = std::back_insert_iterator<std::string>;
using Rows = std::vector<MeasuredWalk>;

Rows judged_rows(std::span<const SweptWalk> walks, const std::string& course = {}) {
    Rows rows;
    for (const MeasuredWalk& row : all_rows(walks))
        if (row.judged && (course.empty() || row.info.course == course)) rows.push_back(row);
    return rows;
}

/// The courses of a sweep in its order.
std::vector<std::string> courses_of(std::span<const SweptWalk> walks) {
    std::vector<std::string> courses;
    for (const SweptWalk& walk : walks)
        if (std::find(courses.begin(), courses.end(), walk.info.course) == courses.end())
            courses.push_back(walk.info.course);
    return courses;
}

template <class Holds>
std::size_t count(const Rows& rows, const Holds& holds) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), holds));
}

std::string tile(std::size_t number, const char* what) {
    return fmt::format("<li><b>{}</b><span>{}</span></li>", number, what);
}

std::string tiles(const Rows& rows, std::size_t courses) {
    std::size_t missed = 0;
    for (const MeasuredWalk& row : rows) missed += static_cast<std::size_t>(missed_marks(row));
    return "<ul class=\"tiles\">" + tile(courses, "courses") + tile(rows.size(), "walks judged") +
           tile(count(rows, [](const MeasuredWalk& row) { return missed_marks(row) == 0; }), "meet every mark") +
           tile(missed, "marks missed") + "</ul>\n";
}

/// How many walks of a course miss each mark.
std::string summary(std::span<const SweptWalk> walks) {
    std::string html =
        "<h2 id=\"marks\">Marks</h2>\n<p>How many walks of a course miss a mark. ✓ is none.</p>\n<div "
        "class=\"scroll\"><table class=\"summary\"><thead><tr><th class=\"t\">course</th><th>walks</th>";
    for (const WalkFigure& figure : walk_figures())
        if (figure.mark) fmt::format_to(Out(html), "<th title=\"{}\">{}</th>", figure.mark, figure.head);
    html += "</tr></thead><tbody>\n";
    for (const CourseMisses& course : misses_by_course(all_rows(walks))) {
        fmt::format_to(Out(html), "<tr><th class=\"t\"><a href=\"#{0}\">{0}</a></th><td>{1}</td>", course.course,
                       course.walks);
        for (std::size_t i = 0; i < course.misses.size(); ++i)
            if (walk_figures()[i].mark)
                html += course.misses[i] > 0 ? fmt::format("<td class=\"miss\">✗ {}</td>", course.misses[i])
                                             : "<td class=\"met\">✓</td>";
        html += "</tr>\n";
    }
    html += "</tbody></table></div>\n<details><summary>What each mark asks</summary><dl class=\"marks\">";
    for (const WalkFigure& figure : walk_figures())
        if (figure.mark)
            fmt::format_to(Out(html), "<dt>{}{}{}</dt><dd>{}</dd>", figure.head, *figure.unit ? ", " : "", figure.unit,
                           figure.mark);
    return html + "</dl></details>\n";
}

std::string row_html(const SweptWalk& walk, const MeasuredWalk& row, std::size_t number) {
    std::string html = fmt::format(
        "<tr class=\"{}\"><th class=\"t\"><a href=\"#walk-{}\">{}</a></th><td>{:g}</td><td class=\"t\">{}</td><td "
        "class=\"t\">{}</td>",
        row.judged ? "judged" : "compared", number, walk.info.path, walk.info.speed_mps,
        walk.info.reverse ? "far end" : "near end", foot_mode_name(row.mode));
    for (const WalkFigure& figure : walk_figures())
        html += (row.judged && figure.missed(row) ? "<td class=\"miss\">✗ " : "<td>") + figure.text(row) + "</td>";
    return html + "</tr>\n";
}

std::string course_table(std::span<const SweptWalk> walks, const std::string& course) {
    std::string html =
        "<div class=\"scroll\"><table class=\"walks\"><thead><tr><th class=\"t\">path</th><th>m/s</th><th "
        "class=\"t\">from</th><th class=\"t\">mode</th>";
    for (const WalkFigure& figure : walk_figures())
        fmt::format_to(Out(html), "<th>{}<span class=\"from\">{}</span></th>", figure.head, figure.unit);
    html += "</tr></thead><tbody>\n";
    for (std::size_t i = 0; i < walks.size(); ++i)
        if (walks[i].info.course == course)
            for (const MeasuredWalk& row : walks[i].rows) html += row_html(walks[i], row, i);
    return html + "</tbody></table></div>\n";
}

std::string misses_of(const SweptWalk& walk) {
    std::string names;
    for (const MeasuredWalk& row : walk.rows)
        for (const WalkFigure& figure : walk_figures())
            if (row.judged && figure.missed(row))
                fmt::format_to(Out(names), "{}{} {}", names.empty() ? "" : ", ", figure.head, figure.text(row));
    return names.empty() ? "<span class=\"met\">✓</span>" : "<span class=\"miss\">✗ " + names + "</span>";
}

std::string course_section(std::span<const SweptWalk> walks, const std::string& course) {
    const Rows rows = judged_rows(walks, course);
    std::string html =
        fmt::format("<section><h2 id=\"{0}\">{0} <span class=\"count\">{1} of {2} walks meet every mark</span></h2>\n",
                    course, count(rows, [](const MeasuredWalk& row) { return missed_marks(row) == 0; }), rows.size()) +
        course_table(walks, course);
    for (std::size_t i = 0; i < walks.size(); ++i)
        if (walks[i].info.course == course)
            fmt::format_to(Out(html),
                           "<details class=\"walk\" id=\"walk-{}\"><summary>{} {}</summary><div class=\"wide\">{}</div>"
                           "</details>\n",
                           i, walk_title(walks[i].info), misses_of(walks[i]), walk_plots(walks[i]));
    return html + "</section>\n";
}

std::string legend() {
    const auto item = [](const char* style, const char* what) {
        return fmt::format("<li><svg viewBox=\"0 0 30 22\"><path class=\"{}\" d=\"M1 11h28\"/></svg>{}</li>", style,
                           what);
    };
    return "<ul class=\"legend\">" + item("foot-left", "left foot, left knee") + item("foot-right", "right") +
           item("mode-none", "hips: no foot placement") + item("mode-colvin2013", "hips: Colvin &amp; Kajala") +
           item("mode-surefoot", "hips: Surefoot") + item("limit", "least knee angle allowed") + "</ul>\n";
}

std::string paper_section(const ColvinStudy& study, const RoleMap& roles) {
    return fmt::format(
               "<h2 id=\"paper\">How Colvin &amp; Kajala place a leg</h2>\n<p>Figures 7 to 10 of their paper, "
               "drawn from this character on {} in mode colvin2013: {:.2f} s after its start, and {:.2f} s.</p>\n",
               walk_title(study.info), study.sunk.time_s, study.turned.time_s) +
           colvin_figures(study, roles);
}

}  // namespace

std::string walk_page(const std::string& character, std::span<const SweptWalk> walks, const ColvinStudy* study,
                      const RoleMap& roles) {
    const std::vector<std::string> courses = courses_of(walks);
    const Rows rows = judged_rows(walks);
    HtmlPage page;
    page.title = character + ": how its feet stand";
    page.lead = "Every course walked, measured against the same walk on flat ground, and what misses its mark.";
    page.main = tiles(rows, courses.size()) + summary(walks);
    if (study) page.main += paper_section(*study, roles);
    page.main +=
        "<h2 id=\"walks\">Walks</h2>\n<p>A click on a head sorts; a path leads to its plots. Misses are red and have a "
        "✗.</p>\n<label class=\"switch\"><input type=\"checkbox\" id=\"compare\"> show the modes to compare "
        "with</label>\n" +
        legend();
    for (const std::string& course : courses) page.main += course_section(walks, course);
    page.styles = {page_style(), {walk_page_style(), walk_page_style_sha256()}};
    page.scripts = {{walk_page_script(), walk_page_script_sha256()}};
    return html_page(page);
}

}  // namespace surefoot
