#include <surefoot/analysis/facts_json.h>
#include <surefoot/author/json_node.h>
#include <surefoot/author/probe_json.h>
#include <surefoot/author/project.h>
#include <surefoot/host/files.h>
#include <surefoot/space/triangulate.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot {
namespace {

Json numbers(const std::vector<float>& values) {
    Json result = Json::array();
    for (const float value : values) result.push_back(short_number(value));
    return result;
}

bool same_axes(const BlendSpace& a, const BlendSpace& b) {
    return a.axes == b.axes && a.samples == b.samples && a.simplices == b.simplices && a.neighbours == b.neighbours &&
           a.copy_of == b.copy_of && a.weighting == b.weighting && a.outside == b.outside &&
           a.extrapolation_bound == b.extrapolation_bound;
}

// --- writing

Json to_json(const RoleOverrides& roles) {
    Json result = Json::object();
    for (const auto& [role, joint] : roles) result[role] = joint;
    return result;
}

Json to_json(const LintSettings& settings) {
    Json result = Json::object();
    for (const auto& [rule, setting] : settings) {
        Json entry = Json::object();
        if (setting.enabled) entry["enabled"] = *setting.enabled;
        if (setting.severity) entry["severity"] = severity_name(*setting.severity);
        if (!setting.thresholds.empty()) entry["thresholds"] = setting.thresholds;
        result[rule] = entry;
    }
    return result;
}

Json to_json(const ProjectClip& clip) {
    Json result;
    result["name"] = clip.name;
    result["file"] = clip.file.empty() ? Json() : Json(clip.file);
    result["source"] = {{"file", clip.source}, {"first_frame", clip.source_first}, {"last_frame", clip.source_last}};
    result["provenance"] = clip.provenance;
    if (clip.retargeted) result["retargeted"] = true;
    Json pins = Json::object();
    for (const PinnedPlace& pin : clip.pins) pins[pin.space] = numbers(pin.values);
    result["pins"] = pins;
    if (!clip.style.empty()) {
        result["style"] = clip.style;
        result["upper_body"] = clip.upper_body;
    }
    result["excluded"] = clip.excluded;
    if (clip.excluded) result["excluded_by"] = clip.excluded_by_user ? "user" : "surefoot";
    if (clip.excluded) result["reason"] = clip.reason;
    if (!clip.repair.empty()) result["repair"] = clip.repair;
    result["facts"] = facts_to_json(clip.facts, FactsDetail::full);
    return result;
}

Json indices(const Simplex& simplex, int count) {
    Json result = Json::array();
    for (int k = 0; k < count; ++k) result.push_back(simplex[k]);
    return result;
}

Json to_json(const Project& project, const ProjectSpace& space) {
    Json result;
    result["name"] = space.name;
    if (is_style(space)) result["upper_body"] = space.upper_body;
    result["axes_pinned"] = space.axes_pinned;
    result["axes"] = Json::array();
    for (const Axis& axis : space.space.axes)
        result["axes"].push_back({{"name", axis.name},
                                  {"unit", axis.unit},
                                  {"low", short_number(axis.low)},
                                  {"high", short_number(axis.high)},
                                  {"wraps", axis.wraps}});
    result["weighting"] = name_of(space.space.weighting);
    result["outside"] = name_of(space.space.outside);
    result["extrapolation_bound"] = short_number(space.space.extrapolation_bound);
    result["samples"] = Json::array();
    const auto clip_name = [&](int sample) { return project.clips[space.clips[sample]].name; };
    for (std::int32_t i = 0; i < space.space.original_count(); ++i) {  // copies are made again when read
        Json at = Json::array();
        for (int k = 0; k < space.space.dimensions(); ++k) at.push_back(short_number(space.space.samples[i][k]));
        result["samples"].push_back({{"clip", clip_name(i)}, {"at", at}});
    }
    result["simplices"] = Json::array();
    result["neighbours"] = Json::array();
    for (std::size_t s = 0; s < space.space.simplices.size(); ++s) {
        const Simplex& simplex = space.space.simplices[s];
        const auto corners = static_cast<int>(std::find(simplex.begin(), simplex.end(), -1) - simplex.begin());
        result["simplices"].push_back(indices(simplex, corners));
        result["neighbours"].push_back(indices(space.space.neighbours[s], corners));
    }
    result["locked_edges"] = Json::array();
    for (const auto& [a, b] : space.locked_edges) result["locked_edges"].push_back({clip_name(a), clip_name(b)});
    result["locked_simplices"] = Json::array();
    for (const std::vector<int>& simplex : space.locked_simplices) {
        Json names = Json::array();
        for (const int sample : simplex) names.push_back(clip_name(sample));
        result["locked_simplices"].push_back(names);
    }
    return result;
}

Json to_json(const Finding& finding) {
    Json result;
    result["rule"] = finding.rule;
    result["severity"] = severity_name(finding.severity);
    result["message"] = finding.message;
    result["space"] = finding.space.empty() ? Json() : Json(finding.space);
    result["clips"] = finding.clips;
    result["at"] = numbers(finding.at);
    result["fix"] = Json();
    if (finding.fix)
        result["fix"] = {{"kind", finding.fix->kind},
                         {"text", finding.fix->text},
                         {"space", finding.fix->space},
                         {"target", numbers(finding.fix->target)},
                         {"clips", finding.fix->clips}};
    return result;
}

Json to_json(const Placeholder& placeholder) {
    return {{"space", placeholder.space},
            {"kind", placeholder.kind == PlaceholderKind::needed ? "needed" : "suggested"},
            {"axes", placeholder.axes},
            {"target", numbers(placeholder.target)},
            {"rule", placeholder.rule},
            {"text", placeholder.text},
            {"worth", short_number(placeholder.worth)},
            {"probe_gain", short_number(placeholder.probe_gain)}};
}

Json to_json(const RepairStep& step) {
    Json result;
    result["kind"] = step.kind;
    result["clips"] = step.clips;
    result["numbers"] = step.numbers;
    if (!step.makes.empty()) result["makes"] = step.makes;
    if (!step.space.empty()) result["space"] = step.space;
    if (!step.reason.empty()) result["reason"] = step.reason;
    return result;
}

Json to_json(const ProjectRepair& repair) {
    Json result;
    result["id"] = repair.id;
    result["answers"] = {{"rule", repair.rule}, {"space", repair.space}, {"clips", repair.clips}};
    result["text"] = repair.text;
    result["steps"] = Json::array();
    for (const RepairStep& step : repair.steps) result["steps"].push_back(to_json(step));
    return result;
}

// --- reading

RoleOverrides read_roles(const JsonNode& node) {
    RoleOverrides roles;
    for (const auto& [role, joint] : node.entries()) {
        if (role_from_name(role) == Role::count)
            joint.fail("\"" + role + "\" is not a role", "use the VRM names, as \"left_upper_leg\"");
        roles.emplace_back(role, joint.text());
    }
    return roles;
}

Severity read_severity(const JsonNode& node) {
    const auto severity = severity_from_name(node.text());
    if (!severity) node.fail("\"" + node.text() + "\" is no severity", "use \"info\", \"warning\" or \"error\"");
    return *severity;
}

LintSettings read_lint(const JsonNode& node) {
    LintSettings settings;
    for (auto& [rule, entry] : node.entries()) {
        JsonNode value = entry;
        RuleSetting& setting = settings[rule];
        if (value.has("enabled")) setting.enabled = value.at("enabled").flag();
        if (value.has("severity")) setting.severity = read_severity(value.at("severity"));
        if (value.has("thresholds"))
            for (const auto& [name, threshold] : value.at("thresholds").entries())
                setting.thresholds[name] = threshold.number();
        value.finish();
    }
    return settings;
}

/// A clip's file stays inside the project's folder.
std::string read_relative_file(const JsonNode& node) {
    const std::string file = node.text();
    bool good = !file.empty() && file.front() != '/' && file.find('\\') == std::string::npos &&
                file.find(':') == std::string::npos && file.find('\0') == std::string::npos;
    for (const auto& part : std::filesystem::path(file)) good = good && part != "..";
    if (!good) node.fail("a clip's file must be a path inside the project's folder, found \"" + file + "\"");
    return file;
}

constexpr int k_most_frames = 1 << 30;

ProjectClip read_clip(JsonNode node) {
    ProjectClip clip;
    clip.name = node.at("name").text();
    if (clip.name.empty()) node.fail("a clip needs a name");
    if (node.has("file")) clip.file = read_relative_file(node.at("file"));
    if (node.has("source")) {
        JsonNode source = node.at("source");
        clip.source = source.at("file").text();
        clip.source_first = source.at("first_frame").integer(0, k_most_frames);
        clip.source_last = source.at("last_frame").integer(0, k_most_frames);
        source.finish();
    }
    if (node.has("provenance")) clip.provenance = node.at("provenance").texts();
    if (node.has("retargeted")) clip.retargeted = node.at("retargeted").flag();
    if (node.has("style")) clip.style = node.at("style").text();
    if (node.has("upper_body")) clip.upper_body = node.at("upper_body").flag();
    if (node.has("pins"))
        for (const auto& [space, at] : node.at("pins").entries()) clip.pins.push_back({space, at.reals()});
    if (node.has("excluded")) clip.excluded = node.at("excluded").flag();
    // A person who leaves a clip out writes "excluded": true and no more.
    clip.excluded_by_user = clip.excluded;
    if (node.has("excluded_by")) clip.excluded_by_user = clip.excluded && node.at("excluded_by").text() == "user";
    if (node.has("reason")) clip.reason = node.at("reason").text();
    if (node.has("repair")) clip.repair = node.at("repair").text();
    const JsonNode facts = node.at("facts");
    clip.facts = facts_from_json(facts.json(), facts.where());
    node.finish();
    return clip;
}

Axis read_axis(JsonNode node) {
    Axis axis;
    axis.name = node.at("name").text();
    if (node.has("unit")) axis.unit = node.at("unit").text();
    axis.low = node.at("low").real();
    axis.high = node.at("high").real();
    if (!(axis.low < axis.high)) node.fail("\"low\" must be below \"high\"");
    if (node.has("wraps")) axis.wraps = node.at("wraps").flag();
    node.finish();
    return axis;
}

Simplex read_indices(const JsonNode& node, int low, int high) {
    Simplex result;
    result.fill(-1);
    const auto items = node.items();
    if (items.size() > result.size()) node.fail("a simplex has at most five corners");
    for (std::size_t k = 0; k < items.size(); ++k) result[k] = items[k].integer(low, high);
    return result;
}

void read_weighting(JsonNode& node, BlendSpace& space) {
    if (node.has("weighting")) {
        const auto weighting = weighting_named(node.at("weighting").text());
        if (!weighting)
            node.at("weighting")
                .fail("\"" + node.at("weighting").text() + "\" is no weighting",
                      "use \"barycentric\", \"gradient-band\", \"gradient-band-polar\" or \"axis-distance\"");
        space.weighting = *weighting;
    }
    if (node.has("outside")) {
        const auto outside = outside_named(node.at("outside").text());
        if (!outside) node.at("outside").fail("use \"clamp\" or \"extrapolate\"");
        space.outside = *outside;
    }
    if (node.has("extrapolation_bound")) space.extrapolation_bound = node.at("extrapolation_bound").real();
}

ProjectSpace read_space(JsonNode node, const Project& project) {
    ProjectSpace space;
    space.name = node.at("name").text();
    if (node.has("upper_body")) space.upper_body = node.at("upper_body").flag();
    if (node.has("axes_pinned")) space.axes_pinned = node.at("axes_pinned").flag();
    for (const JsonNode& axis : node.at("axes").items()) space.space.axes.push_back(read_axis(axis));
    read_weighting(node, space.space);
    const std::size_t dimensions = space.space.axes.size();
    if (dimensions < 1 || dimensions > k_max_dimensions) node.fail("a blend space has 1 to 4 axes");

    const auto clip_named = [&](const JsonNode& name) {
        const int clip = project.find_clip(name.text());
        if (clip < 0) name.fail("there is no clip named \"" + name.text() + "\"");
        return clip;
    };
    for (JsonNode sample : node.at("samples").items()) {
        const JsonNode name = sample.at("clip");
        space.clips.push_back(clip_named(name));
        if (project.clips[space.clips.back()].file.empty()) name.fail("the clip \"" + name.text() + "\" has no file");
        const auto at = sample.at("at").reals();
        if (at.size() != dimensions) sample.fail("\"at\" needs one number for each axis");
        SpacePoint point{};
        std::copy(at.begin(), at.end(), point.begin());
        space.space.samples.push_back(point);
        sample.finish();
    }
    add_wrap_copies(space.space);
    for (std::size_t i = space.clips.size(); i < space.space.samples.size(); ++i)
        space.clips.push_back(space.clips[static_cast<std::size_t>(space.space.copy_of[i])]);
    const int samples = static_cast<int>(space.clips.size());
    for (const JsonNode& simplex : node.at("simplices").items())
        space.space.simplices.push_back(read_indices(simplex, 0, samples - 1));
    const int simplices = static_cast<int>(space.space.simplices.size());
    for (const JsonNode& neighbours : node.at("neighbours").items())
        space.space.neighbours.push_back(read_indices(neighbours, -1, simplices - 1));
    if (const std::string bad = problem(space.space); !bad.empty())
        node.fail(bad, "run `surefoot author` again to have the space made anew");

    const auto samples_named = [&](const JsonNode& list, std::size_t count, const char* what) {
        const auto names = list.items();
        if (names.size() != count) list.fail(what);
        std::vector<int> result;
        for (const JsonNode& name : names) {
            const auto sample = std::find(space.clips.begin(), space.clips.end(), clip_named(name));
            if (sample == space.clips.end()) name.fail("the clip \"" + name.text() + "\" is not in this space");
            result.push_back(static_cast<int>(sample - space.clips.begin()));
        }
        return result;
    };
    if (node.has("locked_edges"))
        for (const JsonNode& edge : node.at("locked_edges").items()) {
            const std::vector<int> ends = samples_named(edge, 2, "a locked edge names two clips");
            space.locked_edges.push_back({ends[0], ends[1]});
        }
    if (node.has("locked_simplices"))
        for (const JsonNode& simplex : node.at("locked_simplices").items())
            space.locked_simplices.push_back(
                samples_named(simplex, dimensions + 1, "a locked simplex names one clip more than there are axes"));
    node.finish();
    return space;
}

Finding read_finding(JsonNode node) {
    Finding finding;
    finding.rule = node.at("rule").text();
    finding.severity = read_severity(node.at("severity"));
    finding.message = node.at("message").text();
    if (node.has("space")) finding.space = node.at("space").text();
    finding.clips = node.at("clips").texts();
    finding.at = node.at("at").reals();
    if (node.has("fix")) {
        JsonNode fix = node.at("fix");
        finding.fix = Fix{fix.at("kind").text(), fix.at("text").text(), fix.at("space").text(),
                          fix.at("target").reals(), fix.at("clips").texts()};
        fix.finish();
    }
    node.finish();
    return finding;
}

Placeholder read_placeholder(JsonNode node) {
    Placeholder placeholder;
    placeholder.space = node.at("space").text();
    const std::string kind = node.at("kind").text();
    if (kind != "needed" && kind != "suggested") node.at("kind").fail("use \"needed\" or \"suggested\"");
    placeholder.kind = kind == "needed" ? PlaceholderKind::needed : PlaceholderKind::suggested;
    placeholder.axes = node.at("axes").texts();
    placeholder.target = node.at("target").reals();
    placeholder.rule = node.at("rule").text();
    placeholder.text = node.at("text").text();
    if (node.has("worth")) placeholder.worth = node.at("worth").real();
    if (node.has("probe_gain")) placeholder.probe_gain = node.at("probe_gain").real();
    node.finish();
    return placeholder;
}

RepairStep read_step(JsonNode node) {
    RepairStep step;
    step.kind = node.at("kind").text();
    step.clips = node.at("clips").texts();
    if (node.has("numbers"))
        for (const auto& [name, value] : node.at("numbers").entries()) step.numbers[name] = value.number();
    if (node.has("makes")) step.makes = node.at("makes").text();
    if (node.has("space")) step.space = node.at("space").text();
    if (node.has("reason")) step.reason = node.at("reason").text();
    node.finish();
    return step;
}

ProjectRepair read_repair(JsonNode node) {
    ProjectRepair repair;
    repair.id = node.at("id").text();
    if (node.has("answers")) {
        JsonNode answers = node.at("answers");
        repair.rule = answers.at("rule").text();
        repair.space = answers.at("space").text();
        repair.clips = answers.at("clips").texts();
        answers.finish();
    }
    if (node.has("text")) repair.text = node.at("text").text();
    for (const JsonNode& step : node.at("steps").items()) repair.steps.push_back(read_step(step));
    node.finish();
    return repair;
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

void check_clip_names(const JsonNode& clips, const Project& project) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < project.clips.size(); ++i)
        if (!names.insert(lower(project.clips[i].name)).second)
            clips.items()[i].fail("the name \"" + project.clips[i].name + "\" is taken by another clip");
}

Project read_project(JsonNode node) {
    if (!node.json().is_object()) node.fail("this is not a Surefoot project");
    Project project;
    if (!node.has("surefoot_project")) node.fail("this is not a Surefoot project: \"surefoot_project\" is missing");
    const JsonNode version = node.at("surefoot_project");
    project.version = version.integer(1, std::numeric_limits<int>::max());
    if (project.version > k_project_version)
        version.fail("the project was written by a newer version of Surefoot",
                     "install that version or author it again");
    if (node.has("name")) project.name = node.at("name").text();
    if (node.has("roles")) project.roles = read_roles(node.at("roles"));
    if (node.has("role_overrides")) project.role_overrides = read_roles(node.at("role_overrides"));
    if (node.has("lint")) project.lint = read_lint(node.at("lint"));
    const JsonNode clips = node.at("clips");
    for (const JsonNode& clip : clips.items()) project.clips.push_back(read_clip(clip));
    check_clip_names(clips, project);
    for (const JsonNode& space : node.at("spaces").items()) project.spaces.push_back(read_space(space, project));
    if (node.has("findings"))
        for (const JsonNode& finding : node.at("findings").items()) project.findings.push_back(read_finding(finding));
    if (node.has("placeholders"))
        for (const JsonNode& entry : node.at("placeholders").items())
            project.placeholders.push_back(read_placeholder(entry));
    if (node.has("probe")) project.probe = read_probe(node.at("probe"), project.probe_before);
    if (node.has("asked_axes")) project.asked_axes = node.at("asked_axes").texts();
    if (node.has("repairs"))
        for (const JsonNode& repair : node.at("repairs").items()) project.repairs.push_back(read_repair(repair));
    Json unknown = Json::object();
    for (const std::string& key : node.unknown()) unknown[key] = node.json()[key];
    if (!unknown.empty()) project.unknown = unknown.dump();
    return project;
}

}  // namespace

std::string_view severity_name(Severity severity) noexcept {
    return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

std::optional<Severity> severity_from_name(std::string_view name) noexcept {
    for (const Severity severity : {Severity::info, Severity::warning, Severity::error})
        if (name == severity_name(severity)) return severity;
    return std::nullopt;
}

bool operator==(const ProjectClip& a, const ProjectClip& b) {
    return a.name == b.name && a.file == b.file && a.source == b.source && a.source_first == b.source_first &&
           a.source_last == b.source_last && a.provenance == b.provenance && a.retargeted == b.retargeted &&
           a.pins == b.pins && a.style == b.style && a.upper_body == b.upper_body && a.excluded == b.excluded &&
           a.excluded_by_user == b.excluded_by_user && a.reason == b.reason && a.repair == b.repair &&
           facts_to_json(a.facts, FactsDetail::full) == facts_to_json(b.facts, FactsDetail::full);
}

bool operator==(const ProjectSpace& a, const ProjectSpace& b) {
    return a.name == b.name && same_axes(a.space, b.space) && a.clips == b.clips && a.axes_pinned == b.axes_pinned &&
           a.locked_edges == b.locked_edges && a.locked_simplices == b.locked_simplices && a.upper_body == b.upper_body;
}

int Project::find_clip(std::string_view clip) const noexcept {
    for (std::size_t i = 0; i < clips.size(); ++i)
        if (clips[i].name == clip) return static_cast<int>(i);
    return -1;
}

const ProjectSpace* Project::find_space(std::string_view space) const noexcept {
    for (const ProjectSpace& candidate : spaces)
        if (candidate.name == space) return &candidate;
    return nullptr;
}

Project parse_project(std::string_view json, const std::string& where, std::vector<std::string>* warnings) {
    Json parsed;
    try {
        parsed = Json::parse(json.begin(), json.end());
    } catch (const Json::exception& error) {
        std::string what = error.what();  // "[json.exception.parse_error.101] parse error at line 3, column 5: …"
        if (const auto bracket = what.find("] "); bracket != std::string::npos) what = what.substr(bracket + 2);
        throw Error("the project is not sound JSON: " + what, where, "mend that place, or run `surefoot author` again");
    }
    return read_project(JsonNode(parsed, where, "", warnings));
}

Project load_project(const std::filesystem::path& path, std::vector<std::string>* warnings) {
    std::error_code ignored;
    const auto file = std::filesystem::is_directory(path, ignored) ? path / "project.json" : path;
    return parse_project(read_file(file), file.string(), warnings);
}

std::string project_json(const Project& project) {
    Json json;
    json["surefoot_project"] = k_project_version;
    json["name"] = project.name;
    json["roles"] = to_json(project.roles);
    json["role_overrides"] = to_json(project.role_overrides);
    json["lint"] = to_json(project.lint);
    json["spaces"] = Json::array();
    for (const ProjectSpace& space : project.spaces) json["spaces"].push_back(to_json(project, space));
    json["findings"] = Json::array();
    for (const Finding& finding : project.findings) json["findings"].push_back(to_json(finding));
    json["placeholders"] = Json::array();
    for (const Placeholder& placeholder : project.placeholders) json["placeholders"].push_back(to_json(placeholder));
    if (!project.probe.empty() || project.probe_before)
        json["probe"] = to_json(project.probe, project.probe_before ? &*project.probe_before : nullptr);
    json["asked_axes"] = project.asked_axes;
    json["repairs"] = Json::array();
    for (const ProjectRepair& repair : project.repairs) json["repairs"].push_back(to_json(repair));
    json["clips"] = Json::array();
    for (const ProjectClip& clip : project.clips) json["clips"].push_back(to_json(clip));
    if (!project.unknown.empty()) {
        const Json unknown = Json::parse(project.unknown);
        for (const auto& [key, value] : unknown.items())
            if (!json.contains(key)) json[key] = value;
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void save_project(const std::filesystem::path& path, const Project& project) {
    write_file(path, project_json(project));
}

std::string clip_extras_json(const ProjectClip& clip) {
    Json events = Json::array();
    for (const PhaseEvent& event : clip.facts.events)
        events.push_back({{"foot", event.foot == Side::left ? "left" : "right"},
                          {"kind", event.kind == StrideEvent::strike ? "strike" : "toe_off"},
                          {"time_s", short_number(event.time)}});
    Json json;
    json["source"] = {{"file", clip.source}, {"first_frame", clip.source_first}, {"last_frame", clip.source_last}};
    json["provenance"] = clip.provenance;
    json["phase_events"] = events;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string findings_json(const std::vector<Finding>& findings, const ProbeResult& probe) {
    Json json;
    json["findings"] = Json::array();
    for (const Finding& finding : findings) json["findings"].push_back(to_json(finding));
    json["probe"] = to_json(probe, nullptr);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surefoot
