// What can be said about rules: their pages, and the settings that a command line changes.
#include "support.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

const fs::path k_pages = fs::path(SUREFOOT_SOURCE_DIR) / "docs" / "lint";

bool holds(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// The text of the error that `change` throws; empty where it throws none.
template <typename Change>
std::string refusal(Change change) {
    try {
        change();
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(lint_pages, each_rule_has_a_page_and_each_page_a_rule) {
    std::set<std::string> rules, pages;
    for (const LintRule& rule : lint_rules()) EXPECT_TRUE(rules.insert(rule.id).second) << rule.id << " twice";
    for (const auto& entry : fs::directory_iterator(k_pages))
        if (entry.path().stem() != "README") pages.insert(entry.path().stem().string());
    EXPECT_EQ(pages, rules);
    EXPECT_GE(rules.size(), 16u);
}

TEST(lint_pages, a_page_states_the_severity_and_the_thresholds_that_the_code_has) {
    for (const LintRule& rule : lint_rules()) {
        const std::string page = read_file(k_pages / (std::string(rule.id) + ".md"));
        EXPECT_TRUE(page.starts_with(fmt::format("# `{}`: {}\n", rule.id, rule.title))) << rule.id;
        EXPECT_TRUE(holds(page, fmt::format("\nSeverity: **{}**", severity_name(rule.severity)))) << rule.id;
        for (const char* part : {"What it is", "What the player sees", "How to mend it", "Where it comes from"})
            EXPECT_TRUE(holds(page, fmt::format("\n## {}\n", part))) << rule.id << ": " << part;
        std::size_t rows = 0;
        for (std::size_t at = page.find("\n| `"); at != std::string::npos; at = page.find("\n| `", at + 1)) ++rows;
        EXPECT_EQ(rows, rule.thresholds.size()) << rule.id;
        for (const RuleThreshold& threshold : rule.thresholds) {
            const std::string row = fmt::format("\n| `{}` | {} | {} | {} |\n", threshold.name, threshold.value,
                                                threshold.unit, threshold.help);
            EXPECT_TRUE(holds(page, row)) << rule.id << " lacks" << row;
        }
    }
}

TEST(lint_pages, the_index_lists_every_rule_with_its_severity) {
    const std::string index = read_file(k_pages / "README.md");
    for (const LintRule& rule : lint_rules())
        EXPECT_TRUE(holds(
            index, fmt::format("| [`{0}`]({0}.md) | {1} | {2} |\n", rule.id, severity_name(rule.severity), rule.title)))
            << rule.id;
}

TEST(lint_pages, the_program_carries_the_pages_as_they_are) {
    for (const LintRule& rule : lint_rules())
        EXPECT_EQ(lint_page(rule.id), read_file(k_pages / (std::string(rule.id) + ".md")));
    EXPECT_TRUE(lint_page("README").empty());
    EXPECT_TRUE(lint_page("no-such-rule").empty());
}

TEST(lint_pages, help_says_what_is_seen) {
    for (const LintRule& rule : lint_rules()) EXPECT_GT(std::string(rule.help).size(), 20u) << rule.id;
}

TEST(lint_settings, words_turn_rules_off_and_change_severities_and_thresholds) {
    LintSettings settings;
    set_lint_rule(settings, "uncovered=off", "--rule");
    set_lint_rule(settings, "misaligned=error", "--rule");
    set_lint_threshold(settings, "too-close.distance=6.5", "--threshold");
    EXPECT_EQ(settings["uncovered"].enabled, false);
    EXPECT_EQ(settings["misaligned"].severity, Severity::error);
    EXPECT_EQ(settings["too-close"].thresholds.at("distance"), 6.5);
    set_lint_rule(settings, "uncovered=info", "--rule");  // what a project turned off is on again
    EXPECT_EQ(settings["uncovered"].enabled, true);
}

TEST(lint_settings, what_is_not_known_is_refused_with_a_list_of_what_is) {
    LintSettings settings;
    const auto rule = [&](const char* text) { return refusal([&] { set_lint_rule(settings, text, "--rule"); }); };
    const auto threshold = [&](const char* text) {
        return refusal([&] { set_lint_threshold(settings, text, "--threshold"); });
    };
    EXPECT_TRUE(holds(rule("crossing=off"), "no lint rule \"crossing\""));
    EXPECT_TRUE(holds(rule("crossing=off"), "crossing-axis"));
    EXPECT_TRUE(holds(rule("uncovered"), "RULE=off|info|warning|error"));
    EXPECT_TRUE(holds(rule("uncovered=fatal"), "off, info, warning or error"));
    EXPECT_TRUE(holds(threshold("too-close.near=1"), "too-close.distance, too-close.conflict"));
    EXPECT_TRUE(holds(threshold("too-close=1"), "too-close.distance"));
    EXPECT_TRUE(holds(threshold("phase-mismatch.steps=1"), "it has none"));
    EXPECT_TRUE(holds(threshold("nothing.at-all=1"), "the rules are"));
    for (const char* text : {"too-close.distance=", "too-close.distance=6x", "too-close.distance=nan",
                             "too-close.distance=inf", "too-close.distance=-1"})
        EXPECT_TRUE(holds(threshold(text), "is no threshold")) << text;
    EXPECT_TRUE(settings["too-close"].thresholds.empty());
}

}  // namespace
}  // namespace surefoot
