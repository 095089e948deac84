#include "space_desk.h"

#include <surefoot/base/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot::wasm {
namespace {

using Json = nlohmann::ordered_json;

std::vector<float> values_of(const BlendSpace& space, const SpacePoint& point) {
    return {point.begin(), point.begin() + space.dimensions()};
}

Json space_json(const Project& project, const ProjectSpace& space) {
    Json out = {{"name", space.name}, {"axes", Json::array()}, {"samples", Json::array()}, {"cells", Json::array()}};
    for (const Axis& axis : space.space.axes)
        out["axes"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"low", axis.low}, {"high", axis.high}});
    for (std::size_t s = 0; s < space.clips.size(); ++s)
        out["samples"].push_back({{"clip", project.clips[static_cast<std::size_t>(space.clips[s])].name},
                                  {"at", values_of(space.space, space.space.samples[s])}});
    for (const Simplex& simplex : space.space.simplices) {
        Json corners = Json::array();
        for (const std::int32_t corner : simplex)
            if (corner >= 0) corners.push_back(corner);
        out["cells"].push_back(std::move(corners));
    }
    return out;
}

/// What a threshold is now: the user's number or the default.
double threshold_of(const LintSettings& settings, const LintRule& rule, const RuleThreshold& threshold) {
    const auto setting = settings.find(rule.id);
    if (setting == settings.end()) return threshold.value;
    const auto value = setting->second.thresholds.find(threshold.name);
    return value == setting->second.thresholds.end() ? threshold.value : value->second;
}

Json rule_json(const LintSettings& settings, const LintRule& rule) {
    Json thresholds = Json::array();
    for (const RuleThreshold& threshold : rule.thresholds)
        thresholds.push_back({{"name", threshold.name},
                              {"unit", threshold.unit},
                              {"help", threshold.help},
                              {"initial", threshold.value},
                              {"value", threshold_of(settings, rule, threshold)}});
    return {{"id", rule.id}, {"title", rule.title}, {"help", rule.help}, {"thresholds", std::move(thresholds)}};
}

Json finding_json(const Finding& finding) {
    return {{"rule", finding.rule},       {"severity", severity_name(finding.severity)},
            {"message", finding.message}, {"space", finding.space},
            {"clips", finding.clips},     {"at", finding.at}};
}

Json placeholder_json(const Placeholder& placeholder) {
    return {{"space", placeholder.space}, {"needed", placeholder.kind == PlaceholderKind::needed},
            {"axes", placeholder.axes},   {"at", placeholder.target},
            {"rule", placeholder.rule},   {"text", placeholder.text}};
}

}  // namespace

SpaceDesk::SpaceDesk(Project project, std::vector<PoseTable> poses)
    : project_(std::move(project)), given_(project_.lint), poses_(std::move(poses)), result_(lint(project_, poses_)) {}

std::string SpaceDesk::describe() const {
    Json out = {{"spaces", Json::array()},
                {"rules", Json::array()},
                {"findings", Json::array()},
                {"placeholders", Json::array()}};
    for (const ProjectSpace& space : project_.spaces) out["spaces"].push_back(space_json(project_, space));
    for (const LintRule& rule : lint_rules()) out["rules"].push_back(rule_json(project_.lint, rule));
    for (const Finding& finding : result_.findings) out["findings"].push_back(finding_json(finding));
    for (const Placeholder& each : result_.placeholders) out["placeholders"].push_back(placeholder_json(each));
    return out.dump();
}

void SpaceDesk::set_threshold(const std::string& text) {
    LintSettings settings = text.empty() ? given_ : project_.lint;
    if (!text.empty()) set_lint_threshold(settings, text, "");
    project_.lint = std::move(settings);
    result_ = lint(project_, poses_);
}

std::string SpaceDesk::weights(int space, std::span<const float> at) const {
    if (space < 0 || static_cast<std::size_t>(space) >= project_.spaces.size())
        throw Error("there is no such blend space", std::to_string(space), "");
    const ProjectSpace& asked = project_.spaces[static_cast<std::size_t>(space)];
    SpacePoint point{};
    for (std::size_t d = 0; d < std::min(at.size(), asked.space.axes.size()); ++d) point[d] = at[d];
    const BlendWeights found = blend_weights(asked.space, point);
    std::vector<std::pair<float, std::int32_t>> order;
    for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k)
        order.push_back({-found.weights[k], found.samples[k]});
    std::sort(order.begin(), order.end());
    Json out = Json::array();
    for (const auto& [negative, sample] : order) {
        const int clip = asked.clips[static_cast<std::size_t>(sample)];
        out.push_back({{"clip", project_.clips[static_cast<std::size_t>(clip)].name}, {"weight", -negative}});
    }
    return out.dump();
}

}  // namespace surefoot::wasm
