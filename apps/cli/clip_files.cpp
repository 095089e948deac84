#include "clip_files.h"

#include "gait_clips.h"

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/mannequin/mannequin.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

namespace surefoot::cli {

namespace {

std::string lower_extension(const std::string& path) {
    std::string text = std::filesystem::path(path).extension().string();
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// Ankles and toes of both sides, as far as there are any.
std::vector<std::size_t> foot_joints(const RoleMap& roles) {
    std::vector<std::size_t> joints;
    for (const Role role : {Role::left_foot, Role::left_toes, Role::right_foot, Role::right_toes})
        if (roles.has(role)) joints.push_back(static_cast<std::size_t>(roles[role]));
    return joints;
}

/// A body for clips whose skeleton has legs, so that viewers show more than bones. Soles that are not known are taken
/// where the higher foot comes lowest.
std::optional<Mesh> body_for(const Motion& motion, const Legs& legs) {
    constexpr float k_joint_above_sole = 0.015f;  // metres; a toe joint or tip lies that far inside a foot
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count())), standing;
    world_pose(motion, 0, models);
    const RoleMap roles = find_roles(*motion.skeleton, models).roles;
    if (!roles.has_legs()) return {};
    if (legs.known()) return make_mannequin(motion, roles, legs);
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

std::string as_bvh(const std::vector<LoadedClip>& clips, const std::string& file, const WriteOptions& options) {
    if (clips.size() != 1) {
        std::string names;
        for (std::size_t i = 0; i < clips.size() && i < 10; ++i) names += (i > 0 ? ", " : "") + clips[i].motion.name;
        throw Error(fmt::format("a BVH file holds one clip, and there are {}", clips.size()), file,
                    "pick one with IN#NAME, or write a .glb; they are " + names + (clips.size() > 10 ? ", …" : ""));
    }
    BvhWriteOptions bvh;
    if (clips.front().rotation_order.size() == 3) bvh.rotation_order = clips.front().rotation_order;
    if (!options.rotation_order.empty()) bvh.rotation_order = options.rotation_order;
    return write_bvh(clips.front().motion, bvh);
}

std::string as_glb(const std::vector<LoadedClip>& clips, const std::string& file, const WriteOptions& options) {
    GltfScene scene;
    for (const LoadedClip& clip : clips) {
        if (!(*clip.motion.skeleton == *clips.front().motion.skeleton))
            throw Error(fmt::format("the clips '{}' and '{}' are of different skeletons", clips.front().motion.name,
                                    clip.motion.name),
                        file, "give one character's clips at a time");
        scene.motions.push_back(clip.motion);
        scene.motion_extras.push_back(clip.extras);
    }
    if (options.mesh) scene.mesh = body_for(scene.motions.front(), options.legs);
    return write_glb(scene);
}

}  // namespace

std::vector<LoadedClip> read_clip_files(const std::string& path, const LoadOptions& options) {
    const std::string paths[] = {path};
    LoadResult loaded = load_clips_and_gaits(paths, options);
    if (loaded.clips.empty() && loaded.failed.size() == 1) throw Error(loaded.failed.front().error, {}, {});
    for (const LoadFailure& failure : loaded.failed) fmt::print(stderr, "surefoot: {}\n", failure.error);
    if (loaded.clips.empty()) throw Error("there are no clips in it", path, "give a .bvh, .glb, .gltf or .fbx file");
    std::string last;  // clips of one file share most warnings
    for (const LoadedClip& clip : loaded.clips)
        for (const std::string& warning : clip.warnings)
            if (warning != last) fmt::print(stderr, "{}: {}\n", clip.file, last = warning);
    return std::move(loaded.clips);
}

void check_clip_output(const std::string& file) {
    const std::string format = lower_extension(file);
    if (format != ".bvh" && format != ".glb")
        throw Error("the extension '" + format + "' is not one to write", file.empty() ? "OUT" : file,
                    "name a .bvh or .glb file");
}

void write_clip_file(const std::vector<LoadedClip>& clips, const std::string& file, const WriteOptions& options) {
    check_clip_output(file);
    write_file(file, lower_extension(file) == ".bvh" ? as_bvh(clips, file, options) : as_glb(clips, file, options));
}

}  // namespace surefoot::cli
