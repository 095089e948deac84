#include "support.h"

#include <surefoot/author/labels.h>
#include <surefoot/author/report.h>

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
    const std::string html = report_html(linted(project), {{evil}, {evil}});
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("<b onload"), std::string::npos);
    EXPECT_TRUE(is_balanced(html));
}

TEST(report, the_page_refers_to_nothing_outside_itself) {
    const std::string html =
        report_html(linted(make_project({make_clip("idle", 0, 0), make_clip("walk", 1.4f, 0), make_clip("l", 1, 60)})));
    std::string rest = html;
    for (std::size_t at; (at = rest.find("http://www.w3.org/2000/svg")) != std::string::npos;) rest.erase(at, 26);
    for (const char* forbidden : {"http:", "https:", "src=", "@import", "<link", "<script"})
        EXPECT_EQ(rest.find(forbidden), std::string::npos) << forbidden;
    EXPECT_TRUE(is_balanced(html));
    EXPECT_EQ(html.find("nan"), std::string::npos);
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
