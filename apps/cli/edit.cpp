// surefoot mirror | reverse | cut | resample | retime | straighten | clean IN OUT, and surefoot roles FILE.

#include "clip_files.h"
#include "command.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/footing.h>
#include <surefoot/analysis/measure.h>
#include <surefoot/analysis/repair.h>
#include <surefoot/base/error.h>
#include <surefoot/io/clip_extras.h>
#include <surefoot/motion/clean.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/plant.h>
#include <surefoot/motion/steer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace surefoot::cli {

namespace {

std::vector<Transform> shape_of(const Motion& motion) {
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.skeleton->rest, models);
    return models;
}

struct Paths {
    std::string in, out;
};

std::shared_ptr<Paths> add_paths(CLI::App& app) {
    auto paths = std::make_shared<Paths>();
    app.add_option("IN", paths->in, "clip to read: .bvh, .glb, .gltf, .fbx, or FILE#NAME")->required();
    app.add_option("OUT", paths->out, "file to write: .bvh or .glb")->required();
    return paths;
}

// Reads, applies `edit` to every clip, writes. `edit` changes the motion and says what it did.
template <typename Edit>
int edit_clips(const Paths& paths, const Edit& edit) {
    check_clip_output(paths.out);
    std::vector<LoadedClip> clips = read_clip_files(paths.in);
    for (LoadedClip& clip : clips) {
        ClipEdit done = edit(clip.motion);
        done.duration = clip.motion.duration();
        done.cyclic = clip.motion.cyclic;
        clip.extras = edited_extras(clip.extras, done);
    }
    write_clip_file(clips, paths.out);
    return 0;
}

ClipEdit edit_done(ClipEdit::Kind kind, std::string text) {
    ClipEdit done;
    done.kind = kind;
    done.text = std::move(text);
    return done;
}

int frame_at(const Motion& motion, double seconds) {
    const double frame = std::floor(seconds * static_cast<double>(motion.fps) + 0.5);
    return static_cast<int>(std::clamp(frame, 0.0, static_cast<double>(motion.frame_count() - 1)));
}

struct CutRange {
    int first_frame = 0, last_frame = -1;
    double from = -1, to = -1;  // seconds; below 0: not given
};

ClipEdit cut_range(Motion& motion, const CutRange& range) {
    const int first = range.from >= 0 ? frame_at(motion, range.from) : range.first_frame;
    int last = range.to >= 0 ? frame_at(motion, range.to) : range.last_frame;
    if (last < 0) last = motion.frame_count() - 1;
    if (first > last || first >= motion.frame_count())
        throw Error(
            "the cut is empty: it would run from frame " + std::to_string(first) + " to " + std::to_string(last),
            motion.name, "the clip has frames 0 to " + std::to_string(motion.frame_count() - 1));
    last = std::min(last, motion.frame_count() - 1);
    ClipEdit done = edit_done(ClipEdit::Kind::cut, fmt::format("cut to frames {} to {}", first, last));
    done.from = static_cast<float>(first) / motion.fps;
    motion = cut(motion, first, last);
    start_at_origin(motion);
    return done;
}

struct StraightenOptions {
    std::optional<double> turn_deg_s, lateral_mps, forward_mps;
    bool plant = false;
};

/// Measures the clip, gives its root the path asked for, and says what that did to the feet.
ClipEdit straighten(Motion& motion, const StraightenOptions& options) {
    const AnalyzedClip before = analyze_clip(motion, motion.name);
    PathTarget target;
    const auto number = [](double value) { return static_cast<float>(value); };
    if (options.turn_deg_s) target.turn = number(*options.turn_deg_s) * k_radians_per_degree;
    if (options.lateral_mps) target.lateral = number(*options.lateral_mps);
    if (options.forward_mps) target.forward = number(*options.forward_mps);
    if (!options.plant && !options.turn_deg_s && !options.lateral_mps && !options.forward_mps) target.turn = 0.0f;
    SteerReport report;
    motion = steer(before.motion, before.roles.roles, stance_flags(before.facts), target, &report);
    if (options.plant) {
        ClipFacts steered = before.facts;
        measure(motion, before.roles.roles, before.legs, steered);
        motion = plant(motion, before.roles.roles, before.legs, stance_flags(steered));
    }
    ClipFacts after = before.facts;
    measure(motion, before.roles.roles, before.legs, after);
    if (std::fabs(after.turn) < 0.05f) after.turn = 0;  // no "-0.0"
    if (std::fabs(after.lateral) < 0.005f) after.lateral = 0;
    fmt::print("{}: turn {:.1f} -> {:.1f} deg/s, forward {:.2f} -> {:.2f} m/s, lateral {:.2f} -> {:.2f} m/s\n",
               motion.name, before.facts.turn, after.turn, before.facts.forward, after.forward, before.facts.lateral,
               after.lateral);
    fmt::print("  planted feet slide at {:.1f} cm/s, {:.1f} before; feet moved by up to {:.1f} cm and {:.0f} deg\n",
               100 * after.skate, 100 * before.facts.skate, 100 * report.foot_moved,
               report.foot_turned * k_degrees_per_radian);
    return edit_done(ClipEdit::Kind::posed,
                     fmt::format("straightened: turn {:.1f} to {:.1f} deg/s, lateral {:.2f} to {:.2f} m/s",
                                 before.facts.turn, after.turn, before.facts.lateral, after.lateral));
}

/// Mends glitches; frames that a capture dropped at the ends are cut off.
ClipEdit clean_clip(Motion& motion) {
    const RoleMap roles = find_roles(*motion.skeleton, shape_of(motion)).roles;
    ClipEdit done = edit_done(ClipEdit::Kind::posed, "");
    CleanOptions options;
    Footing footing;
    std::vector<std::string> lines;
    if (roles.has_legs()) {
        const Repair dropped = repair_dropped_frames(motion, roles);
        lines = dropped.warnings;
        if (dropped.first > 0) {
            done.kind = ClipEdit::Kind::cut;
            done.from = static_cast<float>(dropped.first) / motion.fps;
        }
        footing = find_footing(motion, roles, make_tracks(motion, roles));
        options.legs = &footing.legs;
        options.floor = footing.floor;
    }
    for (const GlitchRepair& repair : clean(motion, options)) lines.push_back(describe(repair, *motion.skeleton));
    for (const std::string& line : lines) fmt::print("{}: {}\n", motion.name, line);
    if (lines.empty()) fmt::print("{}: nothing to mend\n", motion.name);
    done.text = fmt::format("cleaned: {} repairs", lines.size());
    return done;
}

int print_roles(const std::string& file) {
    bool legs = true;
    const Skeleton* shown = nullptr;
    LoadOptions load;
    load.still = true;
    const std::vector<LoadedClip> clips = read_clip_files(file, load);
    for (const LoadedClip& clip : clips) {
        const Motion& motion = clip.motion;
        if (shown && *shown == *motion.skeleton) continue;  // one answer a skeleton
        shown = motion.skeleton.get();
        const RoleReport report = find_roles(*motion.skeleton, shape_of(motion));
        std::printf("%s: %d joints\n", clip.file.c_str(), motion.joint_count());
        for (const std::string& line : report.lines) std::printf("  %s\n", line.c_str());
        legs = legs && report.roles.has_legs();
    }
    return legs ? 0 : 1;
}

}  // namespace

extern const Command k_mirror, k_reverse, k_cut, k_resample, k_retime, k_straighten, k_clean, k_roles;

const Command k_mirror{"mirror", "exchange left and right", [](CLI::App& app) -> std::function<int()> {
                           const auto paths = add_paths(app);
                           return [paths] {
                               return edit_clips(*paths, [](Motion& motion) {
                                   motion = mirror(motion, find_roles(*motion.skeleton, shape_of(motion)).roles);
                                   return edit_done(ClipEdit::Kind::mirrored, "mirrored");
                               });
                           };
                       }};

const Command k_reverse{"reverse", "play backwards", [](CLI::App& app) -> std::function<int()> {
                            const auto paths = add_paths(app);
                            return [paths] {
                                return edit_clips(*paths, [](Motion& motion) {
                                    motion = reverse(motion);
                                    return edit_done(ClipEdit::Kind::reversed, "reversed");
                                });
                            };
                        }};

const Command k_cut{
    "cut", "keep a range of frames", [](CLI::App& app) -> std::function<int()> {
        const auto paths = add_paths(app);
        const auto range = std::make_shared<CutRange>();
        // CLI::NonNegativeNumber lets NaN pass and prints its upper bound with 300 digits.
        const CLI::Range frames(0, 1000000000), seconds(0.0, 1e6);
        const auto first = app.add_option("--first", range->first_frame, "first frame kept")->check(frames);
        const auto last = app.add_option("--last", range->last_frame, "last frame kept")->check(frames);
        app.add_option("--from", range->from, "start in seconds")->check(seconds)->check(is_number)->excludes(first);
        app.add_option("--to", range->to, "end in seconds")->check(seconds)->check(is_number)->excludes(last);
        return [paths, range] { return edit_clips(*paths, [&](Motion& motion) { return cut_range(motion, *range); }); };
    }};

const Command k_resample{"resample", "change the frame rate", [](CLI::App& app) -> std::function<int()> {
                             const auto paths = add_paths(app);
                             const auto fps = std::make_shared<float>(30.0f);
                             app.add_option("--fps", *fps, "frames a second (default 30)");
                             return [paths, fps] {
                                 return edit_clips(*paths, [&](Motion& motion) {
                                     motion = resample(motion, *fps);
                                     return edit_done(ClipEdit::Kind::resampled,
                                                      fmt::format("resampled to {:g} frames a second", *fps));
                                 });
                             };
                         }};

const Command k_retime{"retime", "play faster or slower", [](CLI::App& app) -> std::function<int()> {
                           const auto paths = add_paths(app);
                           const auto rate = std::make_shared<float>(1.0f);
                           app.add_option("--rate", *rate, "times as fast, 0.8 to 1.25")->required()->check(is_number);
                           return [paths, rate] {
                               return edit_clips(*paths, [&](Motion& motion) {
                                   motion = retime(motion, *rate);
                                   ClipEdit done = edit_done(ClipEdit::Kind::retimed,
                                                             fmt::format("played {:g} times as fast", *rate));
                                   done.rate = *rate;
                                   return done;
                               });
                           };
                       }};

const Command k_straighten{
    "straighten", "take out a residual turn, or give the path another turn, drift or pace",
    [](CLI::App& app) -> std::function<int()> {
        const auto paths = add_paths(app);
        const auto options = std::make_shared<StraightenOptions>();
        const CLI::Range turns(-180.0, 180.0), speeds(-10.0, 10.0);
        app.add_option("--turn", options->turn_deg_s, "mean turn to have, deg/s, + to the left (default 0)")
            ->check(turns)
            ->check(is_number);
        app.add_option("--lateral", options->lateral_mps, "mean sideways speed to have, m/s, + to the left")
            ->check(speeds)
            ->check(is_number);
        app.add_option("--forward", options->forward_mps, "mean forward speed to have, m/s: the steps grow or shrink")
            ->check(speeds)
            ->check(is_number);
        app.add_flag("--plant", options->plant, "hold standing feet to the ground (alone: leave the path as it is)");
        return [paths, options] {
            return edit_clips(*paths, [&](Motion& motion) { return straighten(motion, *options); });
        };
    }};

const Command k_clean{"clean", "mend motion-capture glitches: spikes, flips, dropped frames, jitter, toes in the floor",
                      [](CLI::App& app) -> std::function<int()> {
                          const auto paths = add_paths(app);
                          return [paths] { return edit_clips(*paths, clean_clip); };
                      }};

const Command k_roles{"roles", "which joint is which, and how that was found",
                      [](CLI::App& app) -> std::function<int()> {
                          const auto file = std::make_shared<std::string>();
                          app.add_option("FILE", *file, "a clip or character")->required();
                          return [file] { return print_roles(*file); };
                      }};

}  // namespace surefoot::cli
