#pragma once
// A tree of nodes with animation tracks: what glTF, FBX and Collada have in common. Their readers fill one of these;
// clips_from_nodes makes rigid skeletons and uniformly sampled motions of it.

#include <surefoot/io/clip_file.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {

/// 3x4 affine matrix in double precision, row-major rows of (linear part | translation).
using Affine = std::array<double, 12>;

struct SceneNode {
    std::string name;  ///< may be empty or taken
    std::vector<int> children;
    Vec3 translation, scale{1, 1, 1};
    Quat rotation;
    std::optional<Affine> matrix;  ///< instead of translation, rotation and scale, for nodes no track moves
    bool has_mesh = false;
    bool helper = false;       ///< only ever part of the joint below it (pivots of an FBX)
    bool root_motion = false;  ///< written by us: this node's tracks are Motion::root
    Vec3 tip;                  ///< written by us: Skeleton::tips
};

struct NodeTrack {
    enum class Path : std::uint8_t { translation, rotation, scale };
    enum class Curve : std::uint8_t { linear, step, cubic };

    int node = 0;
    Path path = Path::translation;
    Curve curve = Curve::linear;
    std::shared_ptr<const std::vector<float>> times;   ///< [s] not falling, one at least
    std::shared_ptr<const std::vector<float>> values;  ///< 3 or 4 a key; cubic: in-tangent, value, out-tangent
};

struct NodeClip {
    std::string name;
    std::vector<NodeTrack> tracks;
    double fps = 0;  ///< [1/s] as the file says, 0: found from the keys
    int frames = 0;  ///< as the file says, 0: found from the keys
    bool cyclic = false;
    std::shared_ptr<const std::vector<float>> root_yaw;  ///< written by us: RootFrame::yaw of every frame
    std::string extras;                                  ///< JSON text
};

struct NodeScene {
    std::vector<SceneNode> nodes;
    std::vector<std::vector<int>> skins;  ///< joints of each
    std::vector<NodeClip> clips;
    bool ours = false;  ///< written by us: metres, joints in the order of the skin
    std::vector<std::string> warnings;
};

/// What clips_from_nodes takes of one file at most, so that a small file cannot ask for all memory.
inline constexpr std::size_t k_max_transforms_per_file = std::size_t{32} << 20;

/// Throws Error where nodes form no forest (a cycle, two parents, an index out of range), nothing is animated, or the
/// clips are larger than k_max_transforms_per_file.
std::vector<LoadedClip> clips_from_nodes(const NodeScene& scene, const std::string& where, const LoadOptions& options);

}  // namespace surefoot
