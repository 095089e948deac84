#pragma once
// The rigid skeleton inside a tree of nodes: which nodes are its joints, and joints' transforms where nodes are scaled.

#include <surefoot/io/node_scene.h>

#include <functional>

namespace surefoot {

struct NodeSkeleton {
    std::shared_ptr<const Skeleton> skeleton;
    std::vector<int> nodes;               ///< node of each joint
    std::vector<int> skeleton_parents;    ///< parent joint of each joint
    std::vector<std::vector<int>> above;  ///< of each joint: its ancestors up to the next joint, nearest first
    std::vector<char> matters;            ///< of each node: a joint, or above one, or the root motion
    int root_motion = k_no_joint;         ///< node whose tracks are Motion::root, in files of ours

    /// Joint transforms from node transforms that may hold scale: world positions exactly, rotations made orthonormal
    /// (a mirrored frame has its x axis turned round). `local_of` gives a node's transform.
    void rigid_locals(const std::function<Affine(int node)>& local_of, std::span<Transform> locals) const;
};

Affine to_affine(const Transform& transform, Vec3 scale);
Affine product(const Affine& a, const Affine& b);

/// Picks the joints (see read_gltf). Throws Error where the nodes are no forest or there is nothing to pick.
NodeSkeleton pick_skeleton(const NodeScene& scene, const std::string& where, std::vector<std::string>& warnings);

}  // namespace surefoot
