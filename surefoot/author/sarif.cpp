#include <surefoot/author/lint.h>
#include <surefoot/author/sarif.h>
#include <surefoot/base/hash.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;
using NamedLines = std::map<std::string, int>;  ///< "clips/walk" -> line of its "name", from 1

/// Where the objects of the file's lists ("clips", "spaces") say their names. `text` is JSON that has been read before.
NamedLines find_names(std::string_view text) {
    NamedLines lines;
    std::string list, key, last;  // key at the top level, key in an object of its list, last string seen
    int line = 1, depth = 0;
    bool is_value = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        line += c == '\n';
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        if (c == ':') {
            is_value = true;
            (depth == 1 ? list : key) = last;
        } else if (c == ',' || c == '{' || c == '[') {
            is_value = false;
        }
        if (c != '"') continue;
        std::size_t end = i + 1;
        while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
        if (end >= text.size()) break;
        last = Json::parse(text.substr(i, end + 1 - i), nullptr, false).get<std::string>();
        if (depth == 3 && is_value && key == "name") lines.insert({list + "/" + last, line});
        i = end;
    }
    return lines;
}

const char* level_of(Severity severity) {
    return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

/// A path as a URI reference: what may not stand in one is written as %XX.
std::string uri_of(const std::string& path) {
    const std::string generic = std::filesystem::path(path).lexically_normal().generic_string();
    std::string uri = generic.starts_with('/') ? "file://" : "";
    for (const char c : generic) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
}

Json physical_location(const std::string& uri, const NamedLines& lines, const std::string& name) {
    Json location{{"artifactLocation", {{"uri", uri}}}};
    if (const auto found = lines.find(name); found != lines.end()) location["region"] = {{"startLine", found->second}};
    return location;
}

Json to_sarif(const LintRule& rule) {
    Json entry{{"id", rule.id},
               {"name", rule.title},
               {"shortDescription", {{"text", rule.title}}},
               {"fullDescription", {{"text", rule.help}}},
               {"help", {{"text", rule.help}, {"markdown", lint_page(rule.id)}}},
               {"defaultConfiguration", {{"level", level_of(rule.severity)}}}};
    Json thresholds = Json::object();
    for (const RuleThreshold& threshold : rule.thresholds) thresholds[threshold.name] = threshold.value;
    entry["properties"] = {{"page", fmt::format("docs/lint/{}.md", rule.id)}, {"thresholds", thresholds}};
    return entry;
}

Json to_sarif(const Finding& finding, const std::string& uri, const NamedLines& lines) {
    Json result;
    result["ruleId"] = finding.rule;
    const auto& rules = lint_rules();
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const auto& r) { return r.id == finding.rule; });
    if (rule != rules.end()) result["ruleIndex"] = rule - rules.begin();
    result["level"] = level_of(finding.severity);
    result["message"] = {{"text", finding.message}};
    if (finding.fix) result["message"]["text"] = finding.message + " Mend it: " + finding.fix->text + ".";

    std::vector<std::string> names;
    if (!finding.space.empty()) names.push_back("spaces/" + finding.space);
    for (const std::string& clip : finding.clips) names.push_back("clips/" + clip);
    Json location{{"physicalLocation", physical_location(uri, lines, names.empty() ? "" : names.front())}};
    std::string fingerprint = finding.rule;
    for (const std::string& name : names) {
        location["logicalLocations"].push_back(
            {{"name", name.substr(name.find('/') + 1)}, {"fullyQualifiedName", name}, {"kind", "object"}});
        fingerprint += '\n' + name;
    }
    result["locations"] = Json::array({location});
    for (std::size_t i = 1; i < names.size(); ++i)
        result["relatedLocations"].push_back(
            {{"id", i},
             {"physicalLocation", physical_location(uri, lines, names[i])},
             {"message", {{"text", "the clip \"" + names[i].substr(names[i].find('/') + 1) + "\""}}}});
    result["partialFingerprints"] = {{"ruleSpaceAndClips/v1", fmt::format("{:016x}", hash_bytes(fingerprint))}};
    Json at = Json::array();
    for (const float value : finding.at) at.push_back(value);
    result["properties"] = {{"at", at}};
    if (finding.fix) result["properties"]["fix"] = {{"kind", finding.fix->kind}, {"text", finding.fix->text}};
    return result;
}

}  // namespace

std::string sarif_json(std::span<const Finding> findings, const SarifSource& source) {
    const NamedLines lines = find_names(source.text);
    const std::string uri = uri_of(source.path);
    Json driver{{"name", "Surefoot"}, {"version", source.version}, {"semanticVersion", source.version}};
    for (const LintRule& rule : lint_rules()) driver["rules"].push_back(to_sarif(rule));
    Json invocation{{"executionSuccessful", true}};
    for (const std::string& warning : source.warnings)
        invocation["toolExecutionNotifications"].push_back({{"level", "warning"}, {"message", {{"text", warning}}}});
    Json run{{"tool", {{"driver", driver}}}, {"invocations", Json::array({invocation})}, {"results", Json::array()}};
    for (const Finding& finding : findings) run["results"].push_back(to_sarif(finding, uri, lines));
    const Json log{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                   {"version", "2.1.0"},
                   {"runs", Json::array({run})}};
    return log.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surefoot
