// Settings of rules as words: what the command line overrides for one run.

#include <surefoot/author/lint.h>
#include <surefoot/base/error.h>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>

namespace surefoot {
namespace {

const LintRule& named_rule(std::string_view id, const std::string& option) {
    if (const LintRule* rule = find_lint_rule(id)) return *rule;
    std::string all;
    for (const LintRule& rule : lint_rules()) all += fmt::format("{}{}", all.empty() ? "" : ", ", rule.id);
    throw Error(fmt::format("there is no lint rule \"{}\"", id), option, "the rules are " + all);
}

/// "left=right" taken apart; `shape` shows what was expected.
std::pair<std::string_view, std::string_view> halves(std::string_view text, const std::string& option,
                                                     const char* shape) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
        throw Error(fmt::format("\"{}\" sets nothing", text), option, fmt::format("write it as {}", shape));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

void set_lint_rule(LintSettings& settings, std::string_view text, const std::string& option) {
    const auto [id, level] = halves(text, option, "RULE=off|info|warning|error");
    RuleSetting& setting = settings[named_rule(id, option).id];
    if (level == "off") {
        setting.enabled = false;
        return;
    }
    const std::optional<Severity> severity = severity_from_name(level);
    if (!severity)
        throw Error(fmt::format("\"{}\" is no level for a rule", level), option, "use off, info, warning or error");
    setting.enabled = true;
    setting.severity = severity;
}

void set_lint_threshold(LintSettings& settings, std::string_view text, const std::string& option) {
    const auto [path, number] = halves(text, option, "RULE.NAME=VALUE");
    const std::size_t dot = path.find('.');
    const LintRule& rule = named_rule(path.substr(0, dot), option);
    const std::string name(dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1));
    std::string all;
    bool known = false;
    for (const RuleThreshold& threshold : rule.thresholds) {
        known = known || name == threshold.name;
        all += fmt::format("{}{}.{}", all.empty() ? "" : ", ", rule.id, threshold.name);
    }
    if (!known)
        throw Error(fmt::format("rule \"{}\" has no threshold \"{}\"", rule.id, name), option,
                    all.empty() ? "it has none" : "it has " + all);
    double value = 0;
    const auto [end, error] = fast_float::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || !(value >= 0) || std::isinf(value))
        throw Error(fmt::format("\"{}\" is no threshold", number), option, "give a number from 0 up");
    settings[rule.id].thresholds[name] = value;
}

}  // namespace surefoot
