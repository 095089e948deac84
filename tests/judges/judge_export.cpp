// Writes .glb files, and beside each animation the world positions that we mean, for judge.mjs to compare.
//
//   judge_export FOLDER [CLIPS...]     the default set, and those of files in any format
//   judge_export FOLDER wrong          what the judges must object to
//   judge_export FOLDER read PATHS...  copies of .glb files of ours, with the positions that we read from them
//
// `wrong` writes one clip whose stated positions are off by a millimetre in one place, and one file with a broken
// accessor: the judges must see both.

#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>
#include <surefoot/mannequin/mannequin.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/rig_text/rig_template.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace surefoot;

/// World positions of every joint in every frame of animation `index` of a file.
std::string stated_places(const Motion& motion, std::size_t index) {
    std::vector<Transform> world(static_cast<std::size_t>(motion.joint_count()));
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        nlohmann::ordered_json row = nlohmann::ordered_json::array();
        for (const Transform& joint : world) {
            row.push_back(joint.translation.x);
            row.push_back(joint.translation.y);
            row.push_back(joint.translation.z);
        }
        frames.push_back(std::move(row));
    }
    return nlohmann::ordered_json{
        {"animation", index}, {"fps", motion.fps}, {"joints", motion.skeleton->names}, {"frames", std::move(frames)}}
        .dump();
}

/// A body where the skeleton has roles for one: skins and meshes are judged too.
std::optional<Mesh> body_of(const Motion& motion) {
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.skeleton->rest, models);
    const RoleReport report = find_roles(*motion.skeleton, models);
    if (!report.roles.has_legs()) return std::nullopt;
    return make_mannequin(*motion.skeleton, report.roles, models);
}

/// One .glb of all `motions`, and NAME.INDEX.json for each.
void write_case(const std::filesystem::path& folder, const std::string& name, std::vector<Motion> motions) {
    for (std::size_t i = 0; i < motions.size(); ++i)
        write_file(folder / (name + "." + std::to_string(i) + ".json"), stated_places(motions[i], i));
    GltfScene scene;
    scene.mesh = body_of(motions.front());
    scene.motions = std::move(motions);
    write_file(folder / (name + ".glb"), write_glb(scene));
}

/// A character without motions, and one that stands, of which the places can be judged.
void write_rig(const std::filesystem::path& folder, const std::string& name, const std::vector<std::string>& set) {
    const Rig rig = make_rig(name, set);
    GltfScene scene;
    scene.skeleton = rig.skeleton;
    scene.mesh = make_mannequin(*rig.skeleton, rig.roles, rig.legs);
    write_file(folder / (name + "_still.glb"), write_glb(scene));
    write_case(folder, name, {make_motion(rig.skeleton, name, 2, 30)});
}

void write_wrong(const std::filesystem::path& folder) {
    Motion motion = make_synthetic_set().clips.front();
    GltfScene scene;
    scene.motions = {motion};
    std::string bytes = write_glb(scene);
    write_file(folder / "wrong.glb", bytes);
    motion.root.back().position.x += 0.001f;
    write_file(folder / "wrong.0.json", stated_places(motion, 0));
    const std::size_t type = bytes.find("\"VEC3\"");
    if (type == std::string::npos) throw Error("the file has no positions to spoil", "wrong.glb", "");
    bytes.replace(type, 6, "\"VEC4\"");
    write_file(folder / "broken.glb", bytes);
}

/// A file may hold many clips; they come one after the other.
void state_files(const std::filesystem::path& folder, const std::vector<std::string>& paths) {
    LoadResult loaded = load_clips(paths);
    for (const LoadFailure& failure : loaded.failed) throw Error(failure.error, failure.file, "");
    std::string file;
    std::size_t files = 0, index = 0;
    for (const LoadedClip& clip : loaded.clips) {
        const std::string of = clip.file.substr(0, clip.file.rfind(".glb") + 4);
        index = of == file ? index + 1 : 0;
        if (of != file) write_file(folder / ("file_" + std::to_string(files++) + ".glb"), read_file(of));
        file = of;
        write_file(folder / ("file_" + std::to_string(files - 1) + "." + std::to_string(index) + ".json"),
                   stated_places(clip.motion, index));
    }
    if (files == 0) throw Error("no .glb to read", folder.string(), "");
}

/// The beginning of a clip: the judges need not see minutes.
Motion beginning(Motion motion) {
    const std::size_t frames = std::min<std::size_t>(motion.root.size(), 240);
    motion.root.resize(frames);
    motion.locals.resize(frames * static_cast<std::size_t>(motion.joint_count()));
    return motion;
}

int run(int argc, char** argv) {
    const std::filesystem::path folder = argv[1];
    std::filesystem::remove_all(folder);
    if (argc > 2 && std::string(argv[2]) == "wrong") {
        write_wrong(folder);
        return 0;
    }
    if (argc > 2 && std::string(argv[2]) == "read") {
        state_files(folder, {argv + 3, argv + argc});
        return 0;
    }
    write_case(folder, "default", make_default_set().clips);
    write_rig(folder, "toe_walker", {"spine=7", "fingers=1"});
    const std::vector<std::string> paths(argv + 2, argv + argc);
    LoadResult loaded = load_clips(paths);
    for (const LoadFailure& failure : loaded.failed) throw Error(failure.error, failure.file, "");
    for (std::size_t i = 0; i < loaded.clips.size(); ++i)
        write_case(folder, "clip_" + std::to_string(i), {beginning(std::move(loaded.clips[i].motion))});
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: judge_export FOLDER [wrong | read] [PATHS...]\n");
        return 2;
    }
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "judge_export: %s\n", error.what());
        return 1;
    }
}
