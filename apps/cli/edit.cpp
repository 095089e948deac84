// surefoot mirror | reverse | cut | resample IN OUT, and surefoot roles FILE.

#include "command.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/clip_name.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>
#include <surefoot/motion/edit.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace surefoot::cli {

namespace {

std::string extension_of(const std::string& path) {
    const std::size_t dot = path.find_last_of('.');
    std::string text = dot == std::string::npos ? std::string{} : path.substr(dot);
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

std::vector<LoadedClip> load_all(const std::string& path) {
    const std::string paths[] = {path};
    LoadResult result = load_clips(paths);
    if (!result.failed.empty()) throw Error(result.failed[0].error, "", "");
    if (result.clips.empty()) throw Error("there are no clips in it", path, "give a .bvh, .glb, .gltf or .fbx file");
    for (const LoadedClip& clip : result.clips)
        for (const std::string& warning : clip.warnings)
            std::fprintf(stderr, "%s: %s\n", clip.file.c_str(), warning.c_str());
    return std::move(result.clips);
}

// Writes by the extension of `out`: BVH holds one clip, GLB as many as there are.
void write_all(std::span<const LoadedClip> clips, const std::string& out) {
    const std::string extension = extension_of(out);
    if (extension == ".bvh") {
        if (clips.size() > 1)
            throw Error("a BVH file holds one clip, and there are " + std::to_string(clips.size()), out,
                        "pick one with IN#NAME, or write a .glb");
        BvhWriteOptions options;
        if (!clips[0].rotation_order.empty()) options.rotation_order = clips[0].rotation_order;
        write_file(out, write_bvh(clips[0].motion, options));
        return;
    }
    if (extension != ".glb") throw Error("this kind of file cannot be written", out, "name it .bvh or .glb");
    GltfScene scene;
    for (const LoadedClip& clip : clips) {
        if (!(*clip.motion.skeleton == *clips[0].motion.skeleton))
            throw Error("the clips are of different skeletons", out, "give one character's clips at a time");
        scene.motions.push_back(clip.motion);
    }
    write_file(out, write_glb(scene));
}

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

// Reads, applies `edit` to every clip, writes.
template <typename Edit>
int edit_clips(const Paths& paths, const Edit& edit) {
    std::vector<LoadedClip> clips = load_all(paths.in);
    for (LoadedClip& clip : clips) clip.motion = edit(clip.motion);
    write_all(clips, paths.out);
    return 0;
}

int frame_at(const Motion& motion, double seconds) {
    const double frame = std::floor(seconds * static_cast<double>(motion.fps) + 0.5);
    return static_cast<int>(std::clamp(frame, 0.0, static_cast<double>(motion.frame_count() - 1)));
}

struct CutRange {
    int first_frame = 0, last_frame = -1;
    double from = -1, to = -1;  // seconds; below 0: not given
};

Motion cut_range(const Motion& motion, const CutRange& range) {
    const int first = range.from >= 0 ? frame_at(motion, range.from) : range.first_frame;
    int last = range.to >= 0 ? frame_at(motion, range.to) : range.last_frame;
    if (last < 0) last = motion.frame_count() - 1;
    if (first > last || first >= motion.frame_count())
        throw Error(
            "the cut is empty: it would run from frame " + std::to_string(first) + " to " + std::to_string(last),
            motion.name, "the clip has frames 0 to " + std::to_string(motion.frame_count() - 1));
    Motion result = cut(motion, first, last);
    start_at_origin(result);
    return result;
}

int print_roles(const std::string& file) {
    bool legs = true;
    const Skeleton* shown = nullptr;
    std::vector<LoadedClip> clips = load_all(file);
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

extern const Command k_mirror, k_reverse, k_cut, k_resample, k_roles;

const Command k_mirror{"mirror", "exchange left and right", [](CLI::App& app) -> std::function<int()> {
                           const auto paths = add_paths(app);
                           return [paths] {
                               return edit_clips(*paths, [](const Motion& motion) {
                                   return mirror(motion, find_roles(*motion.skeleton, shape_of(motion)).roles);
                               });
                           };
                       }};

const Command k_reverse{"reverse", "play backwards", [](CLI::App& app) -> std::function<int()> {
                            const auto paths = add_paths(app);
                            return [paths] { return edit_clips(*paths, reverse); };
                        }};

const Command k_cut{
    "cut", "keep a range of frames", [](CLI::App& app) -> std::function<int()> {
        const auto paths = add_paths(app);
        const auto range = std::make_shared<CutRange>();
        app.add_option("--first", range->first_frame, "first frame kept")->check(CLI::NonNegativeNumber);
        app.add_option("--last", range->last_frame, "last frame kept")->check(CLI::NonNegativeNumber);
        app.add_option("--from", range->from, "start in seconds")->check(CLI::NonNegativeNumber);
        app.add_option("--to", range->to, "end in seconds")->check(CLI::NonNegativeNumber);
        return [paths, range] {
            return edit_clips(*paths, [&](const Motion& motion) { return cut_range(motion, *range); });
        };
    }};

const Command k_resample{
    "resample", "change the frame rate", [](CLI::App& app) -> std::function<int()> {
        const auto paths = add_paths(app);
        const auto fps = std::make_shared<float>(30.0f);
        app.add_option("--fps", *fps, "frames a second (default 30)");
        return
            [paths, fps] { return edit_clips(*paths, [&](const Motion& motion) { return resample(motion, *fps); }); };
    }};

const Command k_roles{"roles", "which joint is which, and how that was found",
                      [](CLI::App& app) -> std::function<int()> {
                          const auto file = std::make_shared<std::string>();
                          app.add_option("FILE", *file, "a clip or character")->required();
                          return [file] { return print_roles(*file); };
                      }};

}  // namespace surefoot::cli
