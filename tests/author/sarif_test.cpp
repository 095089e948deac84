#include "support.h"

#include <surefoot/author/sarif.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>
#include <sstream>

namespace surefoot {
namespace {

using Json = nlohmann::json;
using test::make_clip;

/// A project with findings of all severities, as its file and as a SARIF run.
struct Linted {
    Project project = test::make_plane({make_clip("idle", 0, 0), make_clip("walk \"1\"", 1.4f, 0),
                                        make_clip("run_left", 3, 90), make_clip("run_right", 3, -90)},
                                       -2, 4, 90);
    std::vector<Finding> findings;
    std::string text;
    Json run;

    explicit Linted(const std::string& path = "game/my project/project.json") {
        project.clips[1].facts.skate = 0.5f;
        findings = lint(project).findings;
        text = project_json(project);
        const std::vector<std::string> warnings{"a clip could not be read"};
        run = Json::parse(sarif_json(findings, {path, text, "1.2.3", warnings}))["runs"][0];
    }
};

const Json* result_of(const Json& run, const std::string& rule) {
    for (const Json& result : run["results"])
        if (result["ruleId"] == rule) return &result;
    return nullptr;
}

TEST(sarif, every_finding_is_a_result_of_a_rule_that_the_driver_lists) {
    const Linted linted;
    const Json& rules = linted.run["tool"]["driver"]["rules"];
    EXPECT_EQ(rules.size(), lint_rules().size());
    ASSERT_EQ(linted.run["results"].size(), linted.findings.size());
    std::set<std::string> levels;
    for (std::size_t i = 0; i < linted.findings.size(); ++i) {
        const Json& result = linted.run["results"][i];
        EXPECT_EQ(result["ruleId"], linted.findings[i].rule);
        EXPECT_EQ(rules.at(result["ruleIndex"].get<std::size_t>())["id"], linted.findings[i].rule);
        EXPECT_TRUE(result["message"]["text"].get<std::string>().starts_with(linted.findings[i].message));
        levels.insert(result["level"]);
    }
    EXPECT_EQ(levels, (std::set<std::string>{"error", "warning", "note"}));
    EXPECT_EQ(rules[0]["help"]["markdown"], lint_page(lint_rules()[0].id));
}

TEST(sarif, results_point_at_the_lines_of_their_space_and_clips) {
    const Linted linted;
    const auto line_text = [&](const Json& location) {
        std::istringstream lines(linted.text);
        std::string line;
        for (int n = location["physicalLocation"]["region"]["startLine"]; n > 0; --n) std::getline(lines, line);
        return line;
    };
    const Json* crossing = result_of(linted.run, "crossing-axis");
    ASSERT_NE(crossing, nullptr);
    EXPECT_NE(line_text((*crossing)["locations"][0]).find("\"name\": \"facing\""), std::string::npos);
    ASSERT_EQ((*crossing)["relatedLocations"].size(), 2u);
    EXPECT_NE(line_text((*crossing)["relatedLocations"][0]).find("\"name\": \"run_left\""), std::string::npos);
    const Json* skating = result_of(linted.run, "skating-clip");
    ASSERT_NE(skating, nullptr);
    EXPECT_NE(line_text((*skating)["locations"][0]).find(R"("name": "walk \"1\"")"), std::string::npos);
    EXPECT_EQ((*skating)["locations"][0]["logicalLocations"][0]["fullyQualifiedName"], "clips/walk \"1\"");
    EXPECT_FALSE(skating->contains("relatedLocations"));
}

TEST(sarif, lines_are_found_in_a_file_that_was_written_by_hand) {
    const Linted linted;
    const std::string compact = "\n\n" + Json::parse(linted.text).dump();
    const Json run = Json::parse(sarif_json(linted.findings, {"p.json", compact, "1", {}}))["runs"][0];
    for (const Json& result : run["results"])
        EXPECT_EQ(result["locations"][0]["physicalLocation"]["region"]["startLine"], 3);
}

TEST(sarif, a_path_becomes_a_uri) {
    const auto uri = [](const char* path) {
        const Linted linted(path);
        return linted.run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
    };
    EXPECT_EQ(uri("game/my project/project.json"), "game/my%20project/project.json");
    EXPECT_EQ(uri("./project.json"), "project.json");
    EXPECT_EQ(uri("/home/\xc3\xa4/project.json"), "file:///home/%C3%A4/project.json");
}

TEST(sarif, a_finding_keeps_its_fingerprint_when_its_figures_change) {
    Linted linted;
    const auto fingerprints = [](const Json& run) {
        std::vector<Json> all;
        for (const Json& result : run["results"]) all.push_back(result["partialFingerprints"]);
        return all;
    };
    const auto before = fingerprints(linted.run);
    for (Finding& finding : linted.findings) finding.message += " More.";
    const Json run = Json::parse(sarif_json(linted.findings, {"p.json", linted.text, "1", {}}))["runs"][0];
    EXPECT_EQ(fingerprints(run), before);
    EXPECT_EQ(linted.run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"],
              "a clip could not be read");
}

}  // namespace
}  // namespace surefoot
