// surefoot analyze CLIPS...: what each clip does, as a table, JSON or CSV.

#include "command.h"
#include "gait_clips.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/facts_json.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/host/progress.h>
#include <surefoot/io/load.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace surefoot::cli {
namespace {

using Json = nlohmann::ordered_json;

struct AnalyzeOptions {
    std::vector<std::string> clips, roles;
    bool json = false, cycles = false, strict = false;
    std::string csv;
    double unit_scale = 0;
};

struct Result {
    std::vector<ClipFacts> facts;
    std::vector<LoadFailure> failed;
};

RoleOverrides overrides_of(const std::vector<std::string>& pairs) {
    RoleOverrides overrides;
    for (const std::string& pair : pairs) {
        const std::size_t equal = pair.find('=');
        if (equal == std::string::npos || role_from_name(pair.substr(0, equal)) == Role::count)
            throw Error("'" + pair + "' names no role", "--role", "write it as left_foot=JOINT");
        overrides.push_back({pair.substr(0, equal), pair.substr(equal + 1)});
    }
    return overrides;
}

/// What one loaded clip gives: facts of itself and, on request, of its cycles; or the reason why not.
struct Measured {
    std::vector<ClipFacts> facts;
    std::string error;
};

Measured measure_one(LoadedClip& loaded, const AnalyzeOptions& options, const RoleOverrides& overrides) {
    Measured result;
    try {
        AnalyzedClip clip = analyze_clip(std::move(loaded.motion), loaded.file, loaded.unit_scale, overrides);
        clip.facts.warnings.insert(clip.facts.warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());
        result.facts.push_back(clip.facts);
        if (options.cycles && !clip.facts.cyclic)
            for (AnalyzedClip& cycle : find_cycles(clip)) result.facts.push_back(std::move(cycle.facts));
    } catch (const Error& error) {
        result.error = error.what();
    }
    return result;
}

Result analyze(const AnalyzeOptions& options) {
    const RoleOverrides overrides = overrides_of(options.roles);
    LoadOptions load;
    load.unit_scale = options.unit_scale;
    LoadResult loaded = load_clips_and_gaits(options.clips, load);
    std::vector<Measured> measured(loaded.clips.size());
    Progress progress("measuring", loaded.clips.size());
    parallel_for(loaded.clips.size(), [&](std::size_t i) {
        measured[i] = measure_one(loaded.clips[i], options, overrides);
        progress.advance();
    });
    Result result;
    result.failed = std::move(loaded.failed);
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (!measured[i].error.empty()) result.failed.push_back({loaded.clips[i].file, measured[i].error});
        for (ClipFacts& facts : measured[i].facts) result.facts.push_back(std::move(facts));
    }
    return result;
}

Json result_json(const Result& result) {
    Json json = {{"clips", Json::array()}, {"failed", Json::array()}};
    for (const ClipFacts& facts : result.facts) json["clips"].push_back(facts_to_json(facts, FactsDetail::listed));
    for (const LoadFailure& failure : result.failed)
        json["failed"].push_back({{"file", failure.file}, {"error", failure.error}});
    return json;
}

// --- table

using Row = std::vector<std::string>;

std::string fixed(bool present, float value, int digits) {
    if (!present || !std::isfinite(value)) return "-";
    std::string text = fmt::format("{:.{}f}", value, digits);
    // A minus before nothing but zeros says nothing.
    if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
    return text;
}

Row table_row(const ClipFacts& f) {
    const bool steps = f.cadence > 0, travels = std::fabs(f.speed) > 0.1f;
    std::string kind = !f.locomotion ? "left out" : f.cyclic ? "cycle" : "take";
    if (f.in_place) kind += ", in place";
    return {f.name,
            fmt::format("{}", f.frames),
            fixed(true, f.fps, 0),
            fixed(true, f.duration, 2),
            fixed(f.frames > 1, f.speed, 2),
            fixed(f.frames > 1, f.forward, 2),
            fixed(f.frames > 1, f.lateral, 2),
            fixed(f.frames > 1, f.turn, 1),
            fixed(travels, f.travel, 0),
            fixed(f.frames > 1, f.slope, 0),
            fixed(steps, f.cadence, 0),
            fixed(steps, f.stride, 2),
            fixed(f.frames > 1, 100 * f.skate, 1),
            fixed(f.cyclic, 100 * f.seam, 1),
            kind};
}

/// Code points of a UTF-8 text: what a terminal shows of it, near enough.
std::size_t shown_width(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

void print_table(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const Row& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], shown_width(row[c]));
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string blanks(widths[c] - shown_width(row[c]), ' ');
            const bool text = c == 0 || c + 1 == row.size();
            line += (c ? "  " : "") + (text ? row[c] + blanks : blanks + row[c]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        std::printf("%s\n", line.c_str());
    }
}

void print_result(const Result& result) {
    std::vector<Row> rows = {
        {"clip", "frames", "fps", "time", "speed", "forward", "lateral", "turn", "travel", "slope", "cadence", "stride",
         "skate", "seam", "kind"},
        {"", "", "1/s", "s", "m/s", "m/s", "m/s", "deg/s", "deg", "deg", "1/min", "m", "cm/s", "cm", ""}};
    for (const ClipFacts& facts : result.facts) rows.push_back(table_row(facts));
    print_table(rows);
    bool first = true;
    for (const ClipFacts& facts : result.facts)
        for (const std::string& warning : facts.warnings) {
            std::printf("%s%s: %s\n", first ? "\n" : "", facts.name.c_str(), warning.c_str());
            first = false;
        }
}

// --- CSV (RFC 4180): the same keys as the JSON, lists joined

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv_value(const Json& value) {
    if (value.is_null()) return "";
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string joined;
    for (const Json& item : value) {
        if (!joined.empty()) joined += "; ";
        joined += item.is_object() ? item["foot"].get<std::string>() + " " + item["kind"].get<std::string>() + " " +
                                         item["time_s"].dump()
                                   : csv_value(item);
    }
    return joined;
}

std::string result_csv(const Result& result) {
    std::string text;
    const Json header = facts_to_json(ClipFacts{}, FactsDetail::listed);
    for (const auto& [key, value] : header.items()) text += (text.empty() ? "" : ",") + key;
    text += "\r\n";
    for (const ClipFacts& facts : result.facts) {
        std::string line;
        bool first = true;
        const Json values = facts_to_json(facts, FactsDetail::listed);
        for (const auto& [key, value] : values.items()) {
            line += (first ? "" : ",") + csv_field(csv_value(value));
            first = false;
        }
        text += line + "\r\n";
    }
    return text;
}

int run(const AnalyzeOptions& options) {
    const Result result = analyze(options);
    for (const LoadFailure& failure : result.failed) {
        // A message names the file, though not which clip of it was asked for.
        const bool named = failure.error.find(failure.file.substr(0, failure.file.rfind('#'))) != std::string::npos;
        std::fprintf(stderr, "surefoot: %s%s%s\n", named ? "" : failure.file.c_str(), named ? "" : ": ",
                     failure.error.c_str());
    }
    if (!options.csv.empty()) write_file(options.csv, result_csv(result));
    if (options.json)
        std::printf("%s\n", result_json(result).dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    else if (!result.facts.empty())
        print_result(result);
    if (result.facts.empty() && result.failed.empty())
        throw Error("no clips were found", options.clips.front(), "give files or folders of .bvh, .glb, .gltf or .fbx");
    return result.facts.empty() || (options.strict && !result.failed.empty()) ? 2 : 0;
}

}  // namespace

extern const Command k_analyze;
const Command k_analyze{
    "analyze", "Say what each clip does: speed, turn, steps, loop quality", [](CLI::App& app) {
        const auto options = std::make_shared<AnalyzeOptions>();
        app.add_option("CLIPS", options->clips,
                       "Files or folders of .bvh, .glb, .gltf, .fbx; FILE#NAME or FILE#3 picks one")
            ->required();
        app.add_flag("--json", options->json, "Print JSON instead of the table");
        app.add_option("--csv", options->csv, "Write the facts to this file as comma-separated values");
        app.add_flag("--cycles", options->cycles, "List the cycles found inside longer takes, too");
        app.add_flag("--strict", options->strict, "Exit with 2 when any clip cannot be read");
        app.add_option("--unit-scale", options->unit_scale,
                       "Metres a file unit (default: guessed from the character's size)")
            ->check(CLI::Range(1e-9, 1e9))
            ->check(is_number);
        app.add_option("--role", options->roles, "Name a joint by hand, as left_foot=JOINT (may be repeated)");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
