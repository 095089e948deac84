#include "support.h"

#include <surefoot/author/labels.h>
#include <surefoot/author/report.h>
#include <surefoot/author/report_parts.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <gtest/gtest.h>

#include <vector>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_project;

Project linted(Project project) {
    LintResult found = lint(project);
    project.findings = std::move(found.findings);
    project.placeholders = std::move(found.placeholders);
    return project;
}

/// Tags open and close in order: enough of a parser to catch a page torn by a name.
bool is_balanced(const std::string& html) {
    const std::vector<std::string> empty{"meta", "br", "!DOCTYPE"};
    std::vector<std::string> open;
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        const std::size_t end = html.find('>', at);
        if (end == std::string::npos) return false;
        std::string tag = html.substr(at + 1, end - at - 1);
        if (tag.back() == '/') continue;
        tag = tag.substr(0, tag.find_first_of(" \n"));
        if (std::find(empty.begin(), empty.end(), tag) != empty.end()) continue;
        if (tag[0] != '/') {
            open.push_back(tag);
        } else if (open.empty() || open.back() != tag.substr(1)) {
            return false;
        } else {
            open.pop_back();
        }
    }
    return open.empty();
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

/// The page without its script, which is not HTML.
std::string without_script(std::string html) {
    const std::size_t from = html.find("<script>"), to = html.find("</script>", from);
    return html.erase(from + 8, to - from - 8);
}

TEST(report, names_cannot_break_out_of_the_page) {
    const std::string evil = "</svg><script>alert('x')</script>\"&<b onload=\"y\">";
    Project project = make_project({make_clip(evil, 0, 0), make_clip("walk", 1.4f, 0), make_clip("left", 1.4f, 60)});
    project.name = evil;
    project.clips[1].source = evil;
    project.clips[1].provenance = {evil};
    ProjectClip out = make_clip(evil + "2", 0, 0);
    out.excluded = true;
    out.reason = evil;
    project.clips.push_back(out);
    const std::string html = without_script(report_html(linted(project), {{evil}, {evil}}));
    EXPECT_EQ(count_of(html, "<script"), 1u) << "the page's own";
    EXPECT_EQ(html.find("<b onload"), std::string::npos);
    EXPECT_TRUE(is_balanced(html));
}

TEST(report, the_page_refers_to_nothing_outside_itself) {
    const std::string page =
        report_html(linted(make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0), make_clip("l", 1, 60)})));
    std::string rest = page;
    for (std::size_t at; (at = rest.find("http://www.w3.org/2000/svg")) != std::string::npos;) rest.erase(at, 26);
    for (const char* forbidden :
         {"http:", "https:", "src=", "@import", "<link", "url(http", " style=\"", "fetch(", "import("})
        EXPECT_EQ(rest.find(forbidden), std::string::npos) << forbidden;
    const std::string html = without_script(page);
    EXPECT_TRUE(is_balanced(html));
    EXPECT_EQ(html.find("nan"), std::string::npos);
    EXPECT_NE(html.find("default-src 'none'; style-src 'sha256-"), std::string::npos);
}

TEST(report, every_finding_placeholder_and_clip_is_in_it) {
    const Project project =
        linted(make_project({make_clip("walk", 1.4f, 0), make_clip("left", 1.4f, 60), make_clip("back", -1, 30)}));
    const std::string html = report_html(project);
    ASSERT_FALSE(project.findings.empty());
    for (const Finding& finding : project.findings)
        EXPECT_NE(html.find(escape_html(finding.message)), std::string::npos) << finding.message;
    for (const Placeholder& placeholder : project.placeholders)
        EXPECT_NE(html.find(escape_html(placeholder.text)), std::string::npos) << placeholder.text;
    for (const ProjectClip& clip : project.clips) EXPECT_NE(html.find(">" + clip.name + "<"), std::string::npos);
}

TEST(report, every_mark_leads_to_its_finding_and_back) {
    const Project project =
        linted(make_project({make_clip("walk", 1.4f, 0), make_clip("left", 1.4f, 60), make_clip("back", -1, 30)}));
    const std::string html = report_html(project);
    std::size_t ways = 0;
    for (const char* kind : {"spot-", "finding-", "clip-"})
        for (std::size_t at = 0; (at = html.find(std::string("href=\"#") + kind, at)) != std::string::npos;
             ++at, ++ways) {
            const std::string id = html.substr(at + 7, html.find('"', at + 7) - at - 7);
            EXPECT_EQ(count_of(html, "id=\"" + id + "\""), 1u) << id;
        }
    EXPECT_GT(ways, 4u);
}

/// Clips of a biped that walks, and what the report plays of them.
struct Played {
    std::vector<AnalyzedClip> clips;
    Project project;
    ClipFigures figures;
};
Played played() {
    Played result;
    ClipSet set = make_synthetic_set();
    for (Motion& motion : set.clips)
        if (motion.name == "idle" || motion.name == "walk" || motion.name == "walk_left" || motion.name == "run")
            result.clips.push_back(analyze_clip(std::move(motion), "generated"));
    std::vector<ProjectClip> clips;
    std::vector<const AnalyzedClip*> pointers;
    for (const AnalyzedClip& clip : result.clips) {
        clips.emplace_back();
        clips.back().name = clip.facts.name;
        clips.back().facts = clip.facts;
        pointers.push_back(&clip);
    }
    result.project = make_project(std::move(clips));
    result.figures = make_clip_figures(result.project, pointers);
    return result;
}

TEST(report, plots_and_preview_stand_for_every_clip_and_a_script_in_a_name_stays_text) {
    Played p = played();
    ASSERT_GE(p.clips.size(), 3u);
    const std::string html = report_html(p.project, {{}, {}, &p.figures});
    EXPECT_EQ(count_of(html, "<svg class=\"foot-plot\""), p.clips.size());
    EXPECT_EQ(count_of(html, "<svg class=\"phase-plot\""), p.clips.size() - 1) << "all but the idle step";
    EXPECT_EQ(count_of(html, "\"rotations\":"), p.clips.size());
    EXPECT_EQ(html, report_html(p.project, {{}, {}, &p.figures})) << "the same bytes";
    EXPECT_LT(html.size(), 60000 * p.clips.size()) << "1.5 MB for 25 clips";

    p.figures.clips[0].packed.name = "</script><script>alert(1)</script>";
    const std::string evil = report_html(p.project, {{}, {}, &p.figures});
    EXPECT_EQ(count_of(evil, "</script>"), 2u);
}

TEST(report, soles_are_on_the_ground_where_a_foot_stands_and_above_it_where_it_swings) {
    const Played p = played();
    for (std::size_t i = 0; i < p.clips.size(); ++i)
        for (std::size_t side = 0; side < 2; ++side) {
            const std::vector<float>& heights = p.figures.clips[i].sole[side];
            ASSERT_GE(heights.size(), 2u);
            EXPECT_NEAR(*std::min_element(heights.begin(), heights.end()), 0, 0.02) << p.clips[i].facts.name;
            if (p.clips[i].facts.cadence > 0) {
                EXPECT_GT(*std::max_element(heights.begin(), heights.end()), 0.02) << p.clips[i].facts.name;
            }
        }
}

Project probed(bool with_before) {
    Project project = make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0), make_clip("l", 1, 60)});
    ProbeSpace space;
    space.name = project.spaces[0].name;
    space.axes = {{"speed", "m/s", 0, 2, 3}, {"turn", "deg/s", -90, 90, 3}};
    space.clips = {"idle", "l", "walk"};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 2; ++j) {
            ProbeCell cell;
            cell.grid = {i, j + 1}, cell.at = {static_cast<float>(i), 90.0f * static_cast<float>(j)};
            cell.shares = {{0, 1}};
            cell.standing = i == 0 && j == 1 ? 0.0f : 0.6f;
            cell.blend[ProbeFigure::speed] = static_cast<float>(i - 1);
            cell.blend[ProbeFigure::turn] = i == 2 && j == 0 ? -7.25f : 0.5f;
            cell.blend[ProbeFigure::knee_peak] = 1500, cell.sources[ProbeFigure::knee_peak] = 1000;
            space.cells.push_back(cell);
        }
    project.probe.spaces = {space};
    if (with_before) project.probe_before = project.probe;
    return project;
}

TEST(report, heat_maps_show_every_cell_mark_the_worst_and_are_absent_without_a_probe) {
    const Project none = make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0), make_clip("l", 1, 60)});
    EXPECT_EQ(report_html(none).find("<figure class=\"heat\""), std::string::npos);
    const std::string now = probe_section(probed(false), none.spaces[0]);
    EXPECT_TRUE(is_balanced(now));
    const std::size_t maps = count_of(now, "<figure class=\"heat\"");
    EXPECT_EQ(maps, 5u);
    EXPECT_EQ(count_of(now, "class=\"heat-cell\""), 5 * maps);
    EXPECT_EQ(count_of(now, "class=\"heat-none\""), maps) << "where no foot stands, no colour pretends";
    EXPECT_EQ(count_of(now, "class=\"heat-worst\""), maps);
    EXPECT_NE(now.find("mean 1.9, worst 7.2 deg/s at"), std::string::npos) << now.substr(0, 3000);
    EXPECT_NE(now.find("1500 deg/s\xc2\xb2, the clips alone 1000"), std::string::npos);
    EXPECT_EQ(count_of(probe_section(probed(true), none.spaces[0]), "<figure class=\"heat\""), 2 * maps);
}

TEST(report, spaces_of_every_dimension_are_drawn) {
    std::vector<ProjectClip> clips;
    for (int i = 0; i < 12; ++i)
        clips.push_back(make_clip("c" + std::to_string(i), static_cast<float>(i % 4),
                                  static_cast<float>(i * 37 % 120 - 60), 0.1f * static_cast<float>(i * 7 % 5)));
    for (const char* axes : {"speed", "turn", "lateral", "speed,turn", "forward,lateral", "speed,turn,lateral",
                             "speed,turn,lateral,slope"}) {
        const Project project = linted(make_project(clips, {axes}));
        const std::string svg = space_svg(project, project.spaces[0]);
        EXPECT_TRUE(is_balanced(svg)) << axes;
        EXPECT_EQ(svg.find("nan"), std::string::npos) << axes;
        EXPECT_EQ(svg.find("inf,"), std::string::npos) << axes;
    }
}

TEST(report, of_missing_clips_the_one_that_helps_most_comes_first_of_its_kind) {
    Project project = make_project({make_clip("walk", 1.4f, 0), make_clip("run", 3, 0)}, {"speed"});
    project.placeholders.clear();
    const auto want = [&](const char* text, PlaceholderKind kind, float worth) {
        Placeholder placeholder;
        placeholder.space = project.spaces[0].name;
        placeholder.rule = "uncovered";
        placeholder.text = text;
        placeholder.kind = kind;
        placeholder.worth = worth;
        project.placeholders.push_back(placeholder);
    };
    want("little", PlaceholderKind::needed, 0.2f);
    want("hint", PlaceholderKind::suggested, 1);
    want("most", PlaceholderKind::needed, 4);
    const std::string html = space_section(project, 0, false);
    EXPECT_TRUE(is_balanced(html));
    const std::size_t most = html.find("<span>most <"), little = html.find("<span>little <");
    const std::size_t hint = html.find("<span>hint <");
    ASSERT_NE(hint, std::string::npos);
    EXPECT_LT(most, little);
    EXPECT_LT(little, hint);
    EXPECT_EQ(count_of(html, "the single clip that would help most</b>: would settle as much as 4 warnings"), 1u);
}

TEST(report, repairs_are_listed_with_the_command_that_undoes_them) {
    Project project = make_project({make_clip("walk", 1.4f, 0), make_clip("run", 3, 0)}, {"speed"});
    EXPECT_EQ(report_html(project).find("<h2>Repairs"), std::string::npos);
    ProjectRepair repair;
    repair.id = "7", repair.rule = "crossing-axis", repair.text = "mirrored <left>";
    project.repairs.push_back(repair);
    const std::string html = report_html(project);
    EXPECT_TRUE(is_balanced(without_script(html)));
    EXPECT_NE(html.find("mirrored &lt;left&gt; <span class=\"count\">(crossing-axis)</span> <code>surefoot fix PROJECT "
                        "--undo 7</code>"),
              std::string::npos);
}

TEST(report, slices_show_what_has_more_than_two_dimensions) {
    std::vector<ProjectClip> clips;
    for (int i = 0; i < 24; ++i)
        clips.push_back(make_clip("c" + std::to_string(i), static_cast<float>(i % 4),
                                  static_cast<float>(i * 37 % 120 - 60), 0.1f * static_cast<float>(i * 7 % 5)));
    for (const auto& [axes, views] : {std::pair{"speed,turn", 0u}, {"speed,turn,lateral", 5u}}) {
        const Project project = make_project(clips, {axes});
        const std::string page = report_html(project);
        EXPECT_TRUE(is_balanced(without_script(page))) << axes;
        EXPECT_EQ(count_of(page, "<svg class=\"space slice\""), views) << axes;
        EXPECT_EQ(count_of(page, "tabindex=\"0\" role=\"group\" aria-label=\"Slice, held: "), views)
            << "scrolled by keyboard";
        EXPECT_EQ(count_of(page, "<details><summary>4 more slices"), views > 0 ? 1u : 0u) << axes;
        // Without a script the middle one is there to be seen, with what plays in it.
        const std::string lead = page.substr(0, std::min(page.find("more slices"), page.size()));
        EXPECT_EQ(count_of(lead, "<svg class=\"space slice\""), views > 0 ? 1u : 0u) << axes;
        if (views > 0) {
            EXPECT_GT(count_of(lead, "class=\"live-bar"), 0u);
        }
    }
}

TEST(labels, names_of_a_crowd_do_not_cover_each_other) {
    std::vector<LabelRequest> requests;
    std::vector<Box> marks;
    for (int i = 0; i < 24; ++i) {
        const double x = 80 + i % 6 * 120 + i / 6 * 13, y = 60 + i / 6 * 110 + i % 3 * 9;
        requests.push_back({"clip_with_name_" + std::to_string(i), x, y, 6, 11});
        marks.push_back({x - 6, y - 6, x + 6, y + 6});
    }
    const auto placed = place_labels(requests, marks, {}, {0, 0, 860, 520});
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_GE(placed[i].box.left, 0);
        EXPECT_LE(placed[i].box.right, 860);
        for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(placed[i].box.overlap(placed[j].box), 0) << i << " " << j;
        for (const Box& mark : marks) EXPECT_EQ(placed[i].box.overlap(mark), 0) << i;
    }
}

}  // namespace
}  // namespace surefoot
