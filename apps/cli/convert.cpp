// surefoot convert IN OUT: any clip format we read to BVH or GLB.

#include "command.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>
#include <surefoot/io/mannequin.h>

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

namespace surefoot::cli {

namespace {

struct Options {
    std::string in, out, order;
    double unit_scale = 0;
    bool mesh = true;
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

/// Ankles and toes of both sides, as far as there are any.
std::vector<std::size_t> foot_joints(const RoleMap& roles) {
    std::vector<std::size_t> joints;
    for (const Role role : {Role::left_foot, Role::left_toes, Role::right_foot, Role::right_toes})
        if (roles.has(role)) joints.push_back(static_cast<std::size_t>(roles[role]));
    return joints;
}

/// A body for clips whose skeleton has legs, so that viewers show more than bones. The soles are taken where the higher
/// foot comes lowest.
std::optional<Mesh> body_for(const Motion& motion) {
    constexpr float k_joint_above_sole = 0.015f;  // metres; a toe joint or tip lies that far inside a foot
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count())), standing;
    world_pose(motion, 0, models);
    const RoleMap roles = find_roles(*motion.skeleton, models).roles;
    if (!roles.has_legs()) return {};
    float least = 0, floor = 0;
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, models);
        float low = models[static_cast<std::size_t>(roles[Role::left_foot])].translation.y, high = low;
        for (const std::size_t joint : foot_joints(roles)) {
            const float tip = transform_point(models[joint], motion.skeleton->tips[joint]).y;
            low = std::fmin(low, std::fmin(tip, models[joint].translation.y));
            high = std::fmax(high, models[joint].translation.y);
        }
        if (!standing.empty() && high >= least) continue;
        least = high, floor = low - k_joint_above_sole, standing = models;
    }
    return make_mannequin(motion, roles, make_legs(*motion.skeleton, roles, standing, floor));
}

void write_as_glb(const LoadResult& loaded, const Options& options) {
    GltfScene scene;
    for (const LoadedClip& clip : loaded.clips) {
        scene.motions.push_back(clip.motion);
        scene.motion_extras.push_back(clip.extras);
    }
    if (options.mesh) scene.mesh = body_for(scene.motions.front());
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
        app.add_flag("!--no-mesh", options->mesh, "Leave out the mannequin that a .glb wears");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
