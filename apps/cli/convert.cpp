// surefoot convert IN OUT: any clip format we read to BVH or GLB.

#include "clip_files.h"
#include "command.h"

#include <memory>
#include <string>

namespace surefoot::cli {

namespace {

struct Options {
    std::string in, out, order;
    double unit_scale = 0;
    bool mesh = true;
};

int run(const Options& options) {
    check_clip_output(options.out);
    write_clip_file(read_clip_files(options.in, {options.unit_scale}), options.out, {options.order, options.mesh});
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
            ->check(CLI::Range(1e-9, 1e9))
            ->check(is_number);
        app.add_option("--order", options->order, "Order of rotations of a .bvh, such as ZXY (default: that of IN)")
            ->check(CLI::IsMember({"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}));
        app.add_flag("!--no-mesh", options->mesh, "Leave out the mannequin that a .glb wears");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
