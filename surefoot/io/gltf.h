#pragma once
// glTF 2.0 and GLB, in and out. Metres, Y up: the file's axes are ours.

#include <surefoot/io/clip_file.h>
#include <surefoot/mannequin/mesh.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// All animations of a .glb or .gltf given as bytes. `where` names it in messages; buffers outside the file are read
/// from its folder only.
///
/// Joints are those of the skin and what connects them; without a skin, the animated nodes, bare nodes below them, and
/// what connects them. Nodes above are multiplied into the top joint. Joints are rigid here: where nodes are scaled,
/// joint positions come out exactly and translations may vary by frame. Files of ours come back as they were written,
/// root motion apart. Throws Error.
std::vector<LoadedClip> read_gltf(std::string_view bytes, const std::string& where, const LoadOptions& options = {});

struct GltfScene {
    std::vector<Motion> motions;  ///< all of one skeleton
    /// Of a character without motions, which stands in its rest pose; the motions' own where there are any.
    std::shared_ptr<const Skeleton> skeleton;
    /// Empty, or one JSON object as text for each motion: written as `extras` of its animation, and what
    /// LoadedClip::extras gives back.
    std::vector<std::string> motion_extras;
    std::string name = "character";  ///< of the node that carries the skinned mesh
    std::optional<Mesh> mesh;        ///< bound to the skeleton's rest pose
    std::array<float, 4> mesh_color{0.75f, 0.75f, 0.78f, 1};
    std::vector<StaticMesh> statics;  ///< "terrain" and other scenery
    std::string extras;               ///< empty, or a JSON object as text: `extras` of the scene
};

/// The scene as the bytes of a .glb. Root motion is the animation of a node `root` above the skeleton, so that any
/// viewer shows world motion. The same scene gives the same bytes. Throws Error where it is not sound.
std::string write_glb(const GltfScene& scene);

}  // namespace surefoot
