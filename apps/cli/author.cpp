// surefoot author CLIPS... -o DIR: from clips to a placed, triangulated, linted blend space with a report.

#include "actor.h"
#include "command.h"
#include "gait_clips.h"
#include "repairs.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/author.h>
#include <surefoot/author/rank.h>
#include <surefoot/base/error.h>
#include <surefoot/motion/motion.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/probe/probe.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace surefoot::cli {
namespace {

struct Options {
    std::vector<std::string> clips;
    std::string folder, name, skeleton, weighting;
    std::vector<std::string> axes, styles, upper_styles;
    float extrapolate = -1;
    double unit_scale = 0;
    bool strict = false, use_default = false, synthetic = false, no_mannequin = false, no_retarget = false,
         json = false, probe = false, fix = false;
    int grid = 0, probe_grid = 0;
};

void print_table(const Project& project) {
    std::size_t width = 4;
    for (const ProjectClip& clip : project.clips)
        if (!clip.excluded) width = std::max(width, clip.name.size());
    width = std::min<std::size_t>(width, 40);
    fmt::print("{:<{}}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}  {}\n", "clip", width, "speed", "to left", "turn",
               "steps", "length", "skate", "space");
    fmt::print("{:<{}}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}\n", "", width, "m/s", "m/s", "deg/s", "a min", "s",
               "cm/s");
    for (std::size_t c = 0; c < project.clips.size(); ++c) {
        const ProjectClip& clip = project.clips[c];
        if (clip.excluded) continue;
        std::string spaces;
        for (const ProjectSpace& space : project.spaces)
            if (std::find(space.clips.begin(), space.clips.end(), static_cast<int>(c)) != space.clips.end())
                spaces += (spaces.empty() ? "" : ", ") + space.name;
        const ClipFacts& f = clip.facts;
        const auto zero = [](float v, float small) { return std::fabs(v) < small ? 0.0f : v; };  // no "-0.00"
        fmt::print("{:<{}}  {:>7.2f}  {:>7.2f}  {:>7.1f}  {:>7.0f}  {:>7.2f}  {:>7.1f}  {}\n", clip.name, width,
                   zero(f.speed, 0.005f), zero(f.lateral, 0.005f), zero(f.turn, 0.05f), f.cadence, f.duration,
                   100 * f.skate, spaces);
    }
}

void print_left_out(const Project& project) {
    const auto count =
        std::count_if(project.clips.begin(), project.clips.end(), [](const ProjectClip& c) { return c.excluded; });
    if (count == 0) return;
    fmt::print("\nleft out ({}):\n", count);
    for (const ProjectClip& clip : project.clips)
        if (clip.excluded) fmt::print("  {}: {}\n", clip.name, clip.reason);
}

/// Errors and warnings in full, but no more than a few of a kind; the report has them all.
void print_findings(const Project& project) {
    constexpr int k_most_of_a_kind = 3;
    fmt::print("\n");
    if (project.findings.empty()) fmt::print("no findings\n");
    std::map<std::string, int> shown;
    for (const Finding& finding : project.findings) {
        if (++shown[finding.rule] > k_most_of_a_kind) continue;
        fmt::print("{}: {}: {}\n", severity_name(finding.severity), finding.rule, finding.message);
        if (finding.fix) fmt::print("    mend it: {}\n", finding.fix->text);
    }
    for (const auto& [rule, count] : shown)
        if (count > k_most_of_a_kind) fmt::print("... and {} more of {}\n", count - k_most_of_a_kind, rule);
}

SpaceProbe make_probe(const Options& options) {
    if (!options.probe && options.probe_grid == 0) return {};
    return [grid = options.probe_grid](std::span<const AnalyzedClip> clips, std::span<const ProjectSpace> spaces) {
        return probe(bake_character(clips, spaces), {grid});
    };
}

/// What the grid moved, and what the probe found: where there is a grid, beside the space without it.
void print_probe(const AuthorResult& result) {
    if (!result.snap.samples.empty()) fmt::print("\nsnapped to the grid:\n{}", snap_table(result.project, result.snap));
    if (result.project.probe.empty()) return;
    if (!result.unsnapped.empty()) fmt::print("\nbefore and after snapping to the grid:");
    fmt::print("\n{}", probe_table(result.project.probe, result.unsnapped.empty() ? nullptr : &result.unsnapped));
}

int run(const Options& options) {
    if (options.clips.empty() && !options.use_default && !options.synthetic)
        throw Error("no clips were given", "author", "name files or folders, or use --default for the built-in set");
    AuthorOptions author;
    author.name = options.name;
    author.axes = options.axes;
    for (const std::string& style : options.styles) author.styles.push_back(StyleOption::parse(style, false));
    for (const std::string& style : options.upper_styles) author.styles.push_back(StyleOption::parse(style, true));
    if (!options.weighting.empty()) author.weighting = weighting_named(options.weighting);
    if (options.extrapolate >= 0) author.extrapolate = options.extrapolate;
    author.unit_scale = options.unit_scale;
    author.mannequin = !options.no_mannequin;
    author.grid = options.grid;
    author.probe = make_probe(options);
    author.retarget = !options.no_retarget;
    if (!options.skeleton.empty()) author.actor = read_actor(options.skeleton);
    author.fix = options.fix;
    const auto loaded = [&] {
        return load_clips_and_gaits(options.clips, {options.unit_scale}, author.actor ? &*author.actor : nullptr);
    };
    const auto built_in = [&] { return options.synthetic ? make_synthetic_set() : make_default_set(); };
    const AuthorResult result = options.clips.empty() ? author_motions(built_in().clips, options.folder, author)
                                                      : author_loaded(loaded(), options.folder, author);
    for (const std::string& failure : result.failed) fmt::print(stderr, "surefoot: {}\n", failure);
    for (const std::string& warning : result.warnings) fmt::print(stderr, "surefoot: {}\n", warning);
    if (options.json) {
        std::fputs(findings_json(result.project.findings, result.project.probe).c_str(), stdout);
    } else {
        print_table(result.project);
        if (result.takes > 0)
            fmt::print("\n{} cycles found in {} of {} takes, {} of them in the spaces\n", result.cycles_found,
                       result.takes_with_cycles, result.takes, result.cycles_placed);
        print_left_out(result.project);
        if (options.fix) print_repairs(result.repairs);
        print_findings(result.project);
        if (const Placeholder* wanted = most_wanted(result.project))
            fmt::print("the single clip that would help most: {} ({})\n", wanted->text, describe_worth(*wanted));
        print_probe(result);
        fmt::print("\nproject: {}\nreport:  {}\n", result.project_file.string(), result.report_file.string());
    }
    return options.strict && !result.failed.empty() ? 2 : 0;
}

}  // namespace

extern const Command k_author;
const Command k_author{
    "author", "make a blend space from clips: place, triangulate, lint, report", [](CLI::App& app) {
        auto options = std::make_shared<Options>();
        app.add_option("clips", options->clips, "files or folders of .bvh, .glb, .gltf, .fbx; FILE#NAME for one clip");
        app.add_option("-o,--output", options->folder, "folder for project.json, report.html and clips")->required();
        app.add_flag("--default", options->use_default,
                     "use the built-in clips, of gaits learnt from people, where none is given");
        app.add_flag("--synthetic", options->synthetic, "use clips made from numbers alone where none is given");
        app.add_option("--axes", options->axes,
                       "axes of a space, up to four, as speed,turn or forward,lateral,style (repeatable)")
            ->allow_extra_args(false);
        app.add_option(
               "--style", options->styles,
               "NAME=PATTERN: clips so called show a style, laid over the locomotion of the others (repeatable)")
            ->allow_extra_args(false);
        app.add_option("--upper-style", options->upper_styles, "the same, for the upper body alone")
            ->allow_extra_args(false);
        app.add_option("--weighting", options->weighting, "how samples are weighed (default: barycentric)")
            ->check(CLI::IsMember({"barycentric", "gradient-band", "gradient-band-polar", "axis-distance"}));
        app.add_option("--extrapolate", options->extrapolate,
                       "outside the clips let weights go on by so much, at most (default: 0, they are clamped)")
            ->check(CLI::Range(0.0, 1.0))
            ->check(is_number);
        app.add_option("--name", options->name, "title of the project");
        app.add_option("--unit-scale", options->unit_scale, "metres per unit of the files (default: guessed)")
            ->check(CLI::Range(1e-9, 1e9))
            ->check(is_number);
        app.add_option("--skeleton", options->skeleton,
                       "whose skeleton the space uses: a clip or character, or `default` (else: that which most clips "
                       "share, the first of equals); clips of others are retargeted to it");
        app.add_flag("--no-retarget", options->no_retarget, "leave clips of other skeletons out");
        app.add_flag("--fix", options->fix, "make the clips that are missing, and mend what else can be mended");
        app.add_flag("--no-mannequin", options->no_mannequin, "write the clips without a body");
        app.add_flag("--strict", options->strict, "exit with 2 where a clip could not be read");
        app.add_option("--grid", options->grid, "snap samples to an engine's grid of that many divisions an axis")
            ->check(CLI::Range(k_coarsest_grid, k_finest_grid));
        app.add_flag("--probe", options->probe, "play the spaces on a grid and measure each blend from its feet");
        app.add_option("--probe-grid", options->probe_grid, "grid points an axis of the probe (default: by dimensions)")
            ->check(CLI::Range(2, k_finest_probe_grid));
        app.add_flag("--json", options->json, "print the findings as JSON");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
