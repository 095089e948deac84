// surefoot convert IN OUT: any clip format we read to BVH or GLB.

#include "command.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>

#include <fmt/format.h>

#include <memory>
#include <string>

namespace surefoot::cli {

namespace {

struct Options {
    std::string in, out, order;
    double unit_scale = 0;
};

std::string lower_extension(const std::string& path) {
    std::string text = std::filesystem::path(path).extension().string();
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

void write_as_bvh(const LoadResult& loaded, const Options& options) {
    if (loaded.clips.size() != 1) {
        std::string names;
        for (std::size_t i = 0; i < loaded.clips.size() && i < 10; ++i)
            names += (i > 0 ? ", " : "") + loaded.clips[i].motion.name;
        throw Error(fmt::format("a BVH file holds one clip, this has {}", loaded.clips.size()), options.in,
                    "name one as FILE#NAME: " + names + (loaded.clips.size() > 10 ? ", …" : ""));
    }
    const LoadedClip& clip = loaded.clips.front();
    BvhWriteOptions bvh;
    if (clip.rotation_order.size() == 3) bvh.rotation_order = clip.rotation_order;
    if (!options.order.empty()) bvh.rotation_order = options.order;
    write_file(options.out, write_bvh(clip.motion, bvh));
}

void write_as_glb(const LoadResult& loaded, const Options& options) {
    GltfScene scene;
    for (const LoadedClip& clip : loaded.clips) {
        scene.motions.push_back(clip.motion);
        scene.motion_extras.push_back(clip.extras);
    }
    write_file(options.out, write_glb(scene));
}

int run(const Options& options) {
    const std::string format = lower_extension(options.out);
    if (format != ".bvh" && format != ".glb")
        throw Error("the extension '" + format + "' is not one to write", options.out, "name a .bvh or .glb file");
    const std::string paths[] = {options.in};
    const LoadResult loaded = load_clips(paths, {options.unit_scale});
    for (const LoadFailure& failure : loaded.failed) fmt::print(stderr, "surefoot: {}\n", failure.error);
    if (loaded.clips.empty()) return 2;
    std::string last;
    for (const LoadedClip& clip : loaded.clips)
        for (const std::string& warning : clip.warnings)
            if (warning != last) fmt::print(stderr, "{}: {}\n", clip.file, last = warning);
    format == ".bvh" ? write_as_bvh(loaded, options) : write_as_glb(loaded, options);
    return 0;
}

}  // namespace

extern const Command k_convert;
const Command k_convert{
    "convert", "Convert clips: .bvh, .glb, .gltf, .fbx or .dae in, .bvh or .glb out", [](CLI::App& app) {
        auto options = std::make_shared<Options>();
        app.add_option("IN", options->in, "A clip file, FILE#NAME or FILE#3 for one clip of many, or a folder")
            ->required();
        app.add_option("OUT", options->out, "The file to write: .bvh or .glb")->required();
        app.add_option("--unit-scale", options->unit_scale, "Metres per unit of IN (default: guessed from the size)")
            ->check(CLI::PositiveNumber);
        app.add_option("--order", options->order, "Order of rotations of a .bvh, such as ZXY (default: that of IN)")
            ->check(CLI::IsMember({"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}));
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
