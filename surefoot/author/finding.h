#pragma once
// What lint has to say: findings, and placeholders for the clips that are missing.

#include <surefoot/space/blend_space.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

enum class Severity : std::uint8_t { info, warning, error };

/// "info", "warning", "error".
std::string_view severity_name(Severity severity) noexcept;
std::optional<Severity> severity_from_name(std::string_view name) noexcept;

/// What would mend a finding.
struct Fix {
    std::string kind;           ///< "add-clip", "mirror", "remove", "straighten", "close-loop", "keep-one"
    std::string text;           ///< the same in words
    std::string space;          ///< where a clip is to be added; empty otherwise
    std::vector<float> target;  ///< what the added or straightened clip must do, one value an axis; empty otherwise
    std::vector<std::string> clips;  ///< what the fix works on

    friend bool operator==(const Fix&, const Fix&) = default;
};

struct Finding {
    std::string rule;  ///< stable id, as "crossing-axis"
    Severity severity = Severity::warning;
    std::string message;             ///< what is wrong and what the player will see, in plain language
    std::string space;               ///< name of the space; empty where the finding is about a clip alone
    std::vector<std::string> clips;  ///< names of the clips involved
    std::vector<float> at;           ///< where, in axis units, one value an axis; empty where there is no place
    std::optional<Fix> fix;

    friend bool operator==(const Finding&, const Finding&) = default;
};

/// Delicado & Pelechano 2019, §3.3: orange placeholders are necessary clips, green ones are suggestions.
enum class PlaceholderKind : std::uint8_t { needed, suggested };

struct Placeholder {
    std::string space;
    PlaceholderKind kind = PlaceholderKind::needed;
    /// Names of the target's axes: those of the space, and one more where the clip would open a new dimension.
    std::vector<std::string> axes;
    std::vector<float> target;  ///< in axis units, one value an axis
    std::string rule;           ///< of the finding that asks for it
    std::string text;           ///< "a clip at 1.4 m/s turning 90 deg/s to the left"
    float worth = 0;            ///< what a clip here would mend, in warnings (author/rank.h)
    float probe_gain = 0;       ///< share of what the probe found wrong that it would mend, 0 to 1; 0 without a probe

    friend bool operator==(const Placeholder&, const Placeholder&) = default;
};

/// What a user changed about a rule; everything absent is at its default (author/lint.h lists those).
struct RuleSetting {
    std::optional<bool> enabled;
    std::optional<Severity> severity;
    std::map<std::string, double> thresholds;  ///< by the threshold's name

    friend bool operator==(const RuleSetting&, const RuleSetting&) = default;
};
using LintSettings = std::map<std::string, RuleSetting>;  ///< by rule id

}  // namespace surefoot
