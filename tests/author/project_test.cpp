#include "support.h"

#include <surefoot/base/error.h>

#include <surefoot/space/triangulate.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

using test::make_clip;
using test::make_project;

/// A project with something in every field.
Project full_project() {
    Project project = make_project({make_clip("idle", 0, 0), make_clip("walk \"quoted\" <b>", 1.4f, 0.1f),
                                    make_clip("left", 1.3f, 60), make_clip("right", 1.3f, -60)});
    project.name = "A & B";
    project.roles = {{"hips", "Hips"}, {"left_foot", "LeftFoot"}};
    project.role_overrides = {{"left_foot", "LeftFoot"}};
    project.lint["too-close"].thresholds["distance"] = 6.5;
    project.lint["uncovered"].enabled = false;
    project.lint["acute-triangle"].severity = Severity::info;
    project.spaces[0].axes_pinned = true;
    project.spaces[0].locked_edges = {{0, 2}};
    project.spaces[0].locked_simplices = {{0, 2, 1}};
    project.spaces[0].space.weighting = Weighting::gradient_band_polar;
    project.spaces[0].space.outside = Outside::extrapolate;
    project.spaces[0].space.extrapolation_bound = 0.125f;
    project.clips[1].facts.custom = {{"load", -2.5f}, {"style", 0.3f}};
    ProjectClip& walk = project.clips[1];
    walk.source_first = 12, walk.source_last = 73;
    walk.provenance = {"cut from frames 12 to 73", "loop closed"};
    walk.pins = {{"facing", {1.5f, 0}}};
    walk.facts.warnings = {"a warning"};
    walk.facts.contacts[0] = {Contact::flat, Contact::heel, Contact::toe, Contact::lifted};
    walk.facts.contacts[1] = {Contact::lifted, Contact::lifted, Contact::flat, Contact::flat};
    walk.facts.skate = 0.034f;
    ProjectClip out = make_clip("jump", 0, 0);
    out.file.clear();
    out.excluded = true;
    out.reason = "it jumps";
    out.facts.locomotion = false;
    out.facts.not_locomotion = "it jumps";
    project.clips.push_back(out);
    out.name = "mine";
    out.excluded_by_user = true;
    project.clips.push_back(out);
    ProjectClip drunk = make_clip("drunk", 1.1f, 0);
    drunk.style = "drunk";
    drunk.upper_body = true;
    drunk.retargeted = true;
    project.clips.push_back(drunk);
    ProjectSpace style;
    style.name = "style:drunk";
    style.upper_body = true;
    style.clips = {static_cast<int>(project.clips.size()) - 1};
    style.space.axes = {{"speed", "m/s", 0, 1.5f, false}};
    style.space.samples = {{1.1f}};
    triangulate(style.space);
    project.spaces.push_back(style);
    LintResult found = lint(project);
    project.findings = found.findings;
    project.placeholders = found.placeholders;
    project.findings[0].fix = Fix{"add-clip", "add a clip", "facing", {1, 2}, {"idle"}};
    project.unknown = R"({"future":{"x":[1,2]}})";
    return project;
}

std::string message_of(const std::string& json) {
    try {
        parse_project(json, "p.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(project, every_field_comes_back_and_the_text_too) {
    const Project project = full_project();
    ASSERT_FALSE(project.findings.empty());
    ASSERT_FALSE(project.placeholders.empty());
    const std::string text = project_json(project);
    std::vector<std::string> warnings;
    const Project again = parse_project(text, "p.json", &warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    EXPECT_TRUE(again == project);
    EXPECT_EQ(project_json(again), text);
    EXPECT_NE(text.find("\"future\""), std::string::npos);
    EXPECT_NE(text.find("1.4,"), std::string::npos) << "floats are written short";
}

TEST(project, a_change_of_any_kind_is_seen_by_comparison) {
    const Project project = full_project();
    const auto differs = [&](auto change) {
        Project other = full_project();
        change(other);
        return !(other == project);
    };
    EXPECT_TRUE(differs([](Project& p) { p.clips[1].facts.skate += 0.01f; }));
    EXPECT_TRUE(differs([](Project& p) { p.clips[1].pins.clear(); }));
    EXPECT_TRUE(differs([](Project& p) { p.spaces[0].locked_edges.clear(); }));
    EXPECT_TRUE(differs([](Project& p) { p.spaces[0].locked_simplices.clear(); }));
    EXPECT_TRUE(differs([](Project& p) { p.spaces[0].space.weighting = Weighting::barycentric; }));
    EXPECT_TRUE(differs([](Project& p) { p.spaces[0].space.extrapolation_bound = 0.5f; }));
    EXPECT_TRUE(differs([](Project& p) { p.clips[1].facts.custom["style"] = 0.4f; }));
    EXPECT_TRUE(differs([](Project& p) { p.spaces[0].space.samples[0][0] = 9; }));
    EXPECT_TRUE(differs([](Project& p) { p.placeholders[0].target[0] += 1; }));
    EXPECT_TRUE(differs([](Project& p) { p.lint.clear(); }));
    EXPECT_TRUE(differs([](Project& p) { p.probe.spaces.emplace_back(); }));
    EXPECT_FALSE(differs([](Project&) {}));
}

TEST(project, messages_name_the_file_and_the_offending_node) {
    const std::string good = project_json(full_project());
    EXPECT_EQ(message_of(good), "no error");
    struct Case {
        std::string json, part;
    };
    const Case cases[] = {
        {"", "not sound JSON"},
        {"{", "not sound JSON"},
        {"[1]", "not a Surefoot project"},
        {"{}", "\"surefoot_project\" is missing"},
        {replaced(good, "\"surefoot_project\": 1", "\"surefoot_project\": 2"), "newer version"},
        {replaced(good, "\"surefoot_project\": 1", "\"surefoot_project\": \"1\""),
         "p.json: /surefoot_project: expected"},
        {replaced(good, "\"name\": \"left\"", "\"name\": \"idle\""), "/clips/2: the name \"idle\" is taken"},
        {replaced(good, "\"file\": \"clips/idle.glb\"", "\"file\": \"../../etc/passwd\""), "/clips/0/file"},
        {replaced(good, "\"file\": \"clips/idle.glb\"", "\"file\": \"/etc/passwd\""), "inside the project's folder"},
        {replaced(good, "\"clip\": \"left\"", "\"clip\": \"lost\""), "there is no clip named \"lost\""},
        {replaced(good, "\"low\": -90.0", "\"low\": 1e999"), "p.json"},
        {replaced(good, "\"low\": -90.0", "\"low\": 1e300"), "/spaces/0/axes/1/low"},
        {replaced(good, "\"low\": -90.0", "\"low\": 90.0"), "\"low\" must be below \"high\""},
        {replaced(good, "\"gradient-band-polar\"", "\"magic\""), "/spaces/0/weighting: \"magic\" is no weighting"},
        {replaced(good, "\"extrapolate\"", "\"fly\""), "/spaces/0/outside"},
        {replaced(good, "\"extrapolation_bound\": 0.125", "\"extrapolation_bound\": 7"), "bound of extrapolation"},
        {replaced(good, "\"hips\": \"Hips\"", "\"hipz\": \"Hips\""), "/roles/hipz"},
        {replaced(good, "\"severity\": \"info\"", "\"severity\": \"bad\""), "use \"info\", \"warning\" or \"error\""},
    };
    for (const Case& c : cases) {
        const std::string message = message_of(c.json);
        EXPECT_NE(message.find(c.part), std::string::npos) << "wanted: " << c.part << "\ngot: " << message;
        EXPECT_EQ(message.rfind("p.json", 0), 0u) << message;
    }
}

TEST(project, a_space_with_a_wrapping_axis_comes_back_with_its_copies_though_the_file_has_none) {
    const Project project = make_project({make_clip("idle", 0, 0), make_clip("walk", 1.2f, 0),
                                          make_clip("back", -1.2f, 0), make_clip("left", 0, 0, 1.2f)},
                                         {"travel,pace"});
    const std::string json = project_json(project);
    EXPECT_EQ(parse_project(json, "p.json"), project);
    EXPECT_EQ(project_json(parse_project(json, "p.json")), json);
    std::size_t samples = 0;
    for (std::size_t at = json.find("\"at\""); at != std::string::npos; at = json.find("\"at\"", at + 1)) ++samples;
    EXPECT_EQ(samples, static_cast<std::size_t>(project.spaces[0].space.original_count()));
}

TEST(project, unknown_keys_inside_a_node_are_reported) {
    const std::string text =
        replaced(project_json(full_project()), "\"axes_pinned\": true", "\"axes_pinned\": true, \"axis_pinned\": 1");
    std::vector<std::string> warnings;
    parse_project(text, "p.json", &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "p.json: /spaces/0: the key \"axis_pinned\" is not known and is ignored");
}

TEST(project, a_clip_that_a_person_marks_as_excluded_counts_as_excluded_by_them) {
    const std::string text = replaced(project_json(full_project()), "\"excluded_by\": \"surefoot\",\n", "");
    const Project project = parse_project(text, "p.json");
    EXPECT_TRUE(project.clips[project.find_clip("jump")].excluded_by_user);
}

TEST(project, damaged_files_never_do_worse_than_an_error) {
    const std::string good = project_json(full_project());
    for (std::size_t at = 0; at < good.size(); at += 97) {
        message_of(good.substr(0, at));
        std::string damaged = good;
        damaged[at] = damaged[at] == '1' ? '}' : '1';
        message_of(damaged);
    }
}

}  // namespace
}  // namespace surefoot
