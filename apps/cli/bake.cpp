// surefoot bake PROJECT|GRAPH|GAIT|PACK: a character and all that it can do as one file for games, and what is in it.

#include "character_file.h"
#include "command.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

namespace surefoot::cli {

namespace {

using Json = nlohmann::ordered_json;
constexpr double k_metres_per_mm = 1e-3;

struct Options {
    std::string source, out;
    double error_mm = 0;
    bool json = false;
};

struct Baked {
    std::vector<std::byte> bytes;
    std::vector<PackPart> parts;
};

/// Nothing is written that could not be read.
Baked bake(const CharacterFile& file, const std::string& source) {
    if (const std::string text = problem(file.pack); !text.empty())
        throw Error(text, source, "a pack of it could not be opened");
    Baked baked;
    baked.bytes = pack_bytes(file.pack, &baked.parts);
    std::string why;
    const std::optional<Pack> read = Pack::open(baked.bytes, &why);
    if (!read) throw Error("its pack cannot be opened: " + why, source, "this is a fault of surefoot; report it");
    if (pack_bytes(*read) != baked.bytes)
        throw Error("its pack does not come back as it was", source, "this is a fault of surefoot; report it");
    return baked;
}

/// Rotation, translation and scale as floats, a joint and frame.
std::size_t raw_bytes(const PackedClip& clip) {
    return static_cast<std::size_t>(clip.frame_count) * static_cast<std::size_t>(clip.joint_count) * 40;
}

std::size_t state_bytes(const Pack& pack) {
    return pack.has_program() ? pack.program.state_size : sizeof(LocomotionState);
}

Json report_json(const CharacterFile& file, const Baked& baked) {
    const Program& program = file.pack.program;
    Json report{{"name", program.name},
                {"version", k_pack_version},
                {"bytes", baked.bytes.size()},
                {"joints", file.pack.skeleton().joint_count()},
                {"state_bytes", state_bytes(file.pack)},
                {"parts", Json::array()},
                {"clips", Json::array()},
                {"parameters", Json::array()}};
    for (const PackPart& part : baked.parts) report["parts"].push_back({{"name", part.name}, {"bytes", part.bytes}});
    for (std::size_t i = 0; i < program.body.clips.size(); ++i) {
        const PackedClip& clip = program.body.clips[i];
        Json entry{{"name", clip.name},
                   {"frames", clip.frame_count},
                   {"fps", clip.fps},
                   {"duration_s", clip.duration()},
                   {"bytes", memory_size(clip)},
                   {"raw_bytes", raw_bytes(clip)},
                   {"curves", !clip.small.empty()},
                   {"error_mm", nullptr}};
        if (i < file.packing.size()) entry["error_mm"] = file.packing[i].error * 1000;
        report["clips"].push_back(std::move(entry));
    }
    for (const Parameter& p : program.parameters)
        report["parameters"].push_back(
            {{"name", p.name}, {"unit", p.unit}, {"initial", p.initial}, {"low", p.low}, {"high", p.high}});
    report["nodes"] = program.nodes.size();
    report["live_gaits"] = program.rigs.size();
    report["styles"] = Json::array();
    for (const LocomotionStyle& style : program.body.styles) report["styles"].push_back(style.name);
    return report;
}

std::string total_line(const std::vector<PackedClip>& clips) {
    std::size_t bytes = 0, raw = 0;
    for (const PackedClip& clip : clips) bytes += memory_size(clip), raw += raw_bytes(clip);
    return fmt::format("{:<24} {:>32} {:>5.1f}x\n", "all clips", bytes,
                       static_cast<double>(raw) / static_cast<double>(bytes));
}

std::string report_text(const CharacterFile& file, const Baked& baked) {
    const Program& program = file.pack.program;
    const auto count = [](std::size_t n, const char* what) {
        return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    std::string text = fmt::format("{}: {} joints, {}, {}, {} bytes a character\n\n", program.name,
                                   file.pack.skeleton().joint_count(), count(program.body.clips.size(), "clip"),
                                   file.pack.has_program() ? count(program.nodes.size(), "node") + ", " +
                                                                 count(program.parameters.size(), "parameter")
                                                           : std::string("a project without a graph"),
                                   state_bytes(file.pack));
    if (!program.body.clips.empty())
        text += fmt::format("{:<24} {:>6} {:>6} {:>8} {:>9} {:>6} {:>9}\n", "clip", "frames", "fps", "s", "bytes",
                            "ratio", "error mm");
    for (std::size_t i = 0; i < program.body.clips.size(); ++i) {
        const PackedClip& clip = program.body.clips[i];
        text += fmt::format("{:<24} {:>6} {:>6g} {:>8.2f} {:>9} {:>5.1f}x {:>9}\n", clip.name, clip.frame_count,
                            clip.fps, clip.duration(), memory_size(clip),
                            static_cast<double>(raw_bytes(clip)) / static_cast<double>(memory_size(clip)),
                            i < file.packing.size() ? fmt::format("{:.3f}", file.packing[i].error * 1000) : "-");
    }
    if (!program.body.clips.empty()) text += total_line(program.body.clips) + "\n";
    for (const PackPart& part : baked.parts) text += fmt::format("{:<24} {:>9} bytes\n", part.name, part.bytes);
    return text + fmt::format("{:<24} {:>9} bytes, version {}\n", "in all", baked.bytes.size(), k_pack_version);
}

int run(const Options& options) {
    if (!options.out.empty() && !is_pack_file(options.out))
        throw Error("'" + options.out + "' is not named " + k_pack_extension, "--output",
                    "only packs are written here");
    const CharacterFile file =
        read_character_file(options.source, {static_cast<float>(options.error_mm * k_metres_per_mm)});
    const Baked baked = bake(file, options.source);
    if (!options.out.empty())
        write_file(options.out, {reinterpret_cast<const char*>(baked.bytes.data()), baked.bytes.size()});
    if (options.json)
        fmt::print("{}\n", report_json(file, baked).dump(2));
    else
        fmt::print("{}", report_text(file, baked));
    return 0;
}

}  // namespace

extern const Command k_bake;
const Command k_bake{
    "bake", "Write a project or graph as one file that a game loads at once", [](CLI::App& app) {
        auto options = std::make_shared<Options>();
        app.add_option(
               "PROJECT", options->source,
               "A project made by 'surefoot author' (its folder or file), a graph (docs/graphs.md), a live gait "
               "(human), or a pack, to see what it holds")
            ->required();
        app.add_option("-o,--output", options->out, "The pack (.sfpack); without, only what it would hold is told");
        app.add_option("--error", options->error_mm,
                       "How far clips may be from their motions (0.1mm): they then keep curves instead of every frame")
            ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"um", 0.001}, {"mm", 1.0}, {"cm", 10.0}},
                                              CLI::AsNumberWithUnit::UNIT_REQUIRED))
            ->check(CLI::Range(0.01, 100.0));
        app.add_flag("--json", options->json, "Tell it as JSON");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
