#include <surefoot/base/error.h>
#include <surefoot/io/joint_names.h>
#include <surefoot/io/node_skeleton.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

struct Rotation {
    double x = 0, y = 0, z = 0, w = 1;
};

Rotation product(const Rotation& a, const Rotation& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
Rotation conjugate(const Rotation& q) { return {-q.x, -q.y, -q.z, q.w}; }

struct Double3 {
    double x, y, z;
};
double dot(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Double3 cross(const Double3& a, const Double3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Double3 scaled(const Double3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }

Double3 turned(const Rotation& q, const Double3& v) {
    const Double3 u{q.x, q.y, q.z};
    const Double3 t = scaled(cross(u, v), 2);
    const Double3 c = cross(u, t);
    return {v.x + q.w * t.x + c.x, v.y + q.w * t.y + c.y, v.z + q.w * t.z + c.z};
}

/// Quaternion of a rotation given by its columns (Shepperd 1978: divide by the largest component).
Rotation from_columns(const Double3& x, const Double3& y, const Double3& z) {
    const double trace = x.x + y.y + z.z;
    Rotation q;
    if (trace >= x.x && trace >= y.y && trace >= z.z)
        q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
    else if (x.x >= y.y && x.x >= z.z)
        q = {1 + 2 * x.x - trace, y.x + x.y, z.x + x.z, y.z - z.y};
    else if (y.y >= z.z)
        q = {y.x + x.y, 1 + 2 * y.y - trace, z.y + y.z, z.x - x.z};
    else
        q = {z.x + x.z, z.y + y.z, 1 + 2 * z.z - trace, x.y - y.x};
    const double s = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x * s, q.y * s, q.z * s, q.w * s};
}

/// The rotation nearest to a matrix: columns to unit length, which undoes scale along the axes exactly, then Newton's
/// iteration for the polar decomposition (Higham 1986), which shares out what shear is left. A mirrored frame has its
/// x axis turned round. `otherwise` is for frames that scale has made flat.
Rotation nearest_rotation(const Affine& m, const Rotation& otherwise) {
    constexpr double k_flat = 1e-9, k_done = 1e-14;
    constexpr int k_most_steps = 30;
    Double3 c[3] = {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}};
    for (Double3& column : c) {
        const double size = std::sqrt(dot(column, column));
        if (!(size > 1e-30)) return otherwise;
        column = scaled(column, 1 / size);
    }
    if (dot(c[0], cross(c[1], c[2])) < 0) c[0] = scaled(c[0], -1);
    for (int step = 0; step < k_most_steps; ++step) {
        const double volume = dot(c[0], cross(c[1], c[2]));
        if (!(volume > k_flat)) return otherwise;
        const Double3 inverse[3] = {scaled(cross(c[1], c[2]), 1 / volume), scaled(cross(c[2], c[0]), 1 / volume),
                                    scaled(cross(c[0], c[1]), 1 / volume)};
        double moved = 0;
        for (int i = 0; i < 3; ++i) {
            const Double3 next{0.5 * (c[i].x + inverse[i].x), 0.5 * (c[i].y + inverse[i].y),
                               0.5 * (c[i].z + inverse[i].z)};
            moved += std::fabs(next.x - c[i].x) + std::fabs(next.y - c[i].y) + std::fabs(next.z - c[i].z);
            c[i] = next;
        }
        if (moved < k_done) break;
    }
    return from_columns(c[0], c[1], c[2]);
}

Transform rounded(const Rotation& q, const Double3& p) {
    return {normalized(Quat{static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                            static_cast<float>(q.w)}),
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}};
}

/// Who is whose child, checked: a forest, every index in range.
std::vector<int> parents_of(const NodeScene& scene, const std::string& where) {
    const int count = static_cast<int>(scene.nodes.size());
    std::vector<int> parents(scene.nodes.size(), k_no_joint);
    const auto named = [&](int node) {
        return "node " + std::to_string(node) + " " + shown(scene.nodes[static_cast<std::size_t>(node)].name);
    };
    for (int n = 0; n < count; ++n)
        for (const int child : scene.nodes[static_cast<std::size_t>(n)].children) {
            if (child < 0 || child >= count)
                throw Error(named(n) + " has child " + std::to_string(child) + ", but there are only " +
                                std::to_string(count) + " nodes",
                            where, "export the file again");
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent != k_no_joint)
                throw Error(named(child) + " has two parents, " + named(parent) + " and " + named(n), where,
                            "export the file again");
            parent = n;
        }
    // From each node upwards, stopping where an earlier walk has been: each node is visited once.
    std::vector<int> walk(scene.nodes.size(), -1);
    for (int n = 0; n < count; ++n)
        for (int at = n; at != k_no_joint && walk[static_cast<std::size_t>(at)] != n;
             at = parents[static_cast<std::size_t>(at)]) {
            if (walk[static_cast<std::size_t>(at)] != -1) break;
            walk[static_cast<std::size_t>(at)] = n;
            const int parent = parents[static_cast<std::size_t>(at)];
            if (parent != k_no_joint && walk[static_cast<std::size_t>(parent)] == n)
                throw Error("the node hierarchy is cyclic: " + named(parent) + " is its own ancestor", where,
                            "export the file again");
        }
    return parents;
}

/// What the animations move, and bare nodes below that (fingers that keep still, ends of toes).
std::vector<char> animated_and_below(const NodeScene& scene) {
    std::vector<char> taken(scene.nodes.size());
    std::vector<int> open;
    for (const NodeClip& clip : scene.clips)
        for (const NodeTrack& track : clip.tracks) open.push_back(track.node);
    while (!open.empty()) {
        const auto n = static_cast<std::size_t>(open.back());
        open.pop_back();
        if (taken[n]) continue;
        taken[n] = 1;
        for (const int child : scene.nodes[n].children)
            if (!scene.nodes[static_cast<std::size_t>(child)].has_mesh) open.push_back(child);
    }
    return taken;
}

/// The nodes that want to be joints, in the order the file gives them.
std::vector<int> wanted_joints(const NodeScene& scene, int root_motion, const std::string& where,
                               std::vector<std::string>& warnings) {
    const auto largest = std::max_element(scene.skins.begin(), scene.skins.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    std::vector<int> wanted;
    if (largest == scene.skins.end() || largest->empty()) {
        std::vector<char> taken = animated_and_below(scene);
        if (root_motion != k_no_joint) taken[static_cast<std::size_t>(root_motion)] = 0;
        for (std::size_t n = 0; n < taken.size(); ++n)
            if (taken[n] && !scene.nodes[n].helper) wanted.push_back(static_cast<int>(n));
        if (wanted.empty()) throw Error("no animation of the file moves a node", where, "export it with its skeleton");
        return wanted;
    }
    std::vector<char> taken(scene.nodes.size());
    const auto take = [&](const std::vector<int>& joints) {
        for (const int joint : joints) {
            char& known = taken[static_cast<std::size_t>(joint)];
            if (!known && joint != root_motion) wanted.push_back(joint);
            known = 1;
        }
    };
    take(*largest);
    // Bodies in several parts have a skin each, of one skeleton: they share joints.
    std::vector<char> used(scene.skins.size());
    used[static_cast<std::size_t>(largest - scene.skins.begin())] = 1;
    for (bool again = true; again;) {
        again = false;
        for (std::size_t s = 0; s < scene.skins.size(); ++s) {
            const auto shared = [&](int joint) { return taken[static_cast<std::size_t>(joint)] != 0; };
            if (used[s] || std::none_of(scene.skins[s].begin(), scene.skins[s].end(), shared)) continue;
            take(scene.skins[s]);
            used[s] = 1;
            again = true;
        }
    }
    const auto left = std::count(used.begin(), used.end(), 0);
    if (left > 0)
        warnings.push_back(std::to_string(left) + " more skin" + (left == 1 ? "" : "s") +
                           " with joints of another skeleton: only the largest is read");
    return wanted;
}

/// Adds what connects the wanted nodes: everything between them and their nearest common ancestor.
std::vector<int> connected(const NodeScene& scene, const std::vector<int>& parents, const std::vector<int>& wanted,
                           int root_motion) {
    // Wanted nodes at or below each node, and the root of each one's tree.
    std::vector<int> below(scene.nodes.size()), tree(scene.nodes.size(), -1);
    for (const int joint : wanted) {
        int top = joint;
        for (int n = joint; n != k_no_joint && n != root_motion; n = parents[static_cast<std::size_t>(n)]) {
            ++below[static_cast<std::size_t>(n)];
            top = n;
        }
        tree[static_cast<std::size_t>(joint)] = top;
    }
    std::vector<char> placed(scene.nodes.size());
    std::vector<int> order, climb;
    for (const int joint : wanted) {
        // The first node on the way up that has all joints of its tree below it is their nearest common ancestor.
        const int all = below[static_cast<std::size_t>(tree[static_cast<std::size_t>(joint)])];
        climb.clear();
        for (int n = joint;; n = parents[static_cast<std::size_t>(n)]) {
            climb.push_back(n);
            if (placed[static_cast<std::size_t>(n)] || below[static_cast<std::size_t>(n)] == all) break;
        }
        for (; !climb.empty(); climb.pop_back()) {
            if (!placed[static_cast<std::size_t>(climb.back())]) order.push_back(climb.back());
            placed[static_cast<std::size_t>(climb.back())] = 1;
        }
    }
    const auto is_helper = [&](int n) { return scene.nodes[static_cast<std::size_t>(n)].helper; };
    order.erase(std::remove_if(order.begin(), order.end(), is_helper), order.end());
    return order;
}

/// Where a leaf joint ends, if a single bare node below it says so ("toe_end"), in the joint's frame.
Vec3 end_of(const NodeScene& scene, const std::vector<int>& joints, int node) {
    const SceneNode& joint = scene.nodes[static_cast<std::size_t>(node)];
    if (scene.ours || joint.children.size() != 1) return joint.tip;
    if (std::find(joints.begin(), joints.end(), joint.children[0]) != joints.end()) return {};
    const SceneNode& child = scene.nodes[static_cast<std::size_t>(joint.children[0])];
    if (child.has_mesh || !child.children.empty() || child.matrix || joint.matrix) return {};
    return {child.translation.x * joint.scale.x, child.translation.y * joint.scale.y,
            child.translation.z * joint.scale.z};
}

void check_indices(const NodeScene& scene, const std::string& where) {
    const auto sound = [&](int node) { return node >= 0 && node < static_cast<int>(scene.nodes.size()); };
    const char* const remedy = "export the file again";
    for (std::size_t s = 0; s < scene.skins.size(); ++s)
        for (const int joint : scene.skins[s])
            if (!sound(joint))
                throw Error("skin " + std::to_string(s) + " has joint " + std::to_string(joint) +
                                ", but there are only " + std::to_string(scene.nodes.size()) + " nodes",
                            where, remedy);
    for (const NodeClip& clip : scene.clips)
        for (const NodeTrack& track : clip.tracks)
            if (!sound(track.node))
                throw Error("animation " + shown(clip.name) + " moves node " + std::to_string(track.node) +
                                ", but there are only " + std::to_string(scene.nodes.size()) + " nodes",
                            where, remedy);
}

void fill_rest(const NodeScene& scene, NodeSkeleton& picked, Skeleton& skeleton) {
    bool plain = true;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        plain = plain && (!picked.matters[n] || (!scene.nodes[n].matrix && scene.nodes[n].scale == Vec3{1, 1, 1}));
    const auto local_of = [&](int node) -> const SceneNode& { return scene.nodes[static_cast<std::size_t>(node)]; };
    if (!plain) {
        picked.rigid_locals(
            [&](int node) {
                const SceneNode& n = local_of(node);
                return n.matrix ? *n.matrix : to_affine({n.rotation, n.translation}, n.scale);
            },
            skeleton.rest);
        return;
    }
    for (std::size_t j = 0; j < picked.nodes.size(); ++j) {
        const SceneNode& node = local_of(picked.nodes[j]);
        skeleton.rest[j] = {node.rotation, node.translation};
        for (const int above : picked.above[j])
            skeleton.rest[j] = Transform{local_of(above).rotation, local_of(above).translation} * skeleton.rest[j];
    }
}

}  // namespace

Affine to_affine(const Transform& t, Vec3 scale) {
    const Rotation q{static_cast<double>(t.rotation.x), static_cast<double>(t.rotation.y),
                     static_cast<double>(t.rotation.z), static_cast<double>(t.rotation.w)};
    const Double3 x = scaled(turned(q, {1, 0, 0}), static_cast<double>(scale.x));
    const Double3 y = scaled(turned(q, {0, 1, 0}), static_cast<double>(scale.y));
    const Double3 z = scaled(turned(q, {0, 0, 1}), static_cast<double>(scale.z));
    return {x.x, y.x, z.x, static_cast<double>(t.translation.x), x.y, y.y, z.y, static_cast<double>(t.translation.y),
            x.z, y.z, z.z, static_cast<double>(t.translation.z)};
}

Affine product(const Affine& a, const Affine& b) {
    Affine c;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            c[4 * row + column] = a[4 * row] * b[column] + a[4 * row + 1] * b[4 + column] +
                                  a[4 * row + 2] * b[8 + column] + (column == 3 ? a[4 * row + 3] : 0);
    return c;
}

void NodeSkeleton::rigid_locals(const std::function<Affine(int node)>& local_of, std::span<Transform> locals) const {
    struct World {
        Affine scaled;
        Rotation rotation;
        Double3 position;
    };
    std::vector<World> worlds(nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j) {
        World& own = worlds[j];
        own.scaled = local_of(nodes[j]);
        for (const int ancestor : above[j]) own.scaled = product(local_of(ancestor), own.scaled);
        const int p = skeleton_parents[j];
        World parent{{}, {}, {0, 0, 0}};
        if (p != k_no_joint) {
            parent = worlds[static_cast<std::size_t>(p)];
            own.scaled = product(parent.scaled, own.scaled);
        }
        own.position = {own.scaled[3], own.scaled[7], own.scaled[11]};
        own.rotation = nearest_rotation(own.scaled, parent.rotation);
        const Rotation back = conjugate(parent.rotation);
        locals[j] = rounded(product(back, own.rotation),
                            turned(back, {own.position.x - parent.position.x, own.position.y - parent.position.y,
                                          own.position.z - parent.position.z}));
    }
}

NodeSkeleton pick_skeleton(const NodeScene& scene, const std::string& where, std::vector<std::string>& warnings) {
    check_indices(scene, where);
    const std::vector<int> parents = parents_of(scene, where);
    NodeSkeleton picked;
    for (std::size_t n = 0; n < scene.nodes.size() && scene.ours; ++n)
        if (scene.nodes[n].root_motion && parents[n] == k_no_joint) picked.root_motion = static_cast<int>(n);

    const std::vector<int> wanted = wanted_joints(scene, picked.root_motion, where, warnings);
    const auto check_count = [&](std::size_t count) {
        if (count > static_cast<std::size_t>(k_max_joints))
            throw Error("the skeleton has more than " + std::to_string(k_max_joints) + " joints", where,
                        "export fewer joints (no hair, no cloth)");
    };
    check_count(wanted.size());
    picked.nodes = connected(scene, parents, wanted, picked.root_motion);
    check_count(picked.nodes.size());

    std::vector<int> joint_of(scene.nodes.size(), k_no_joint);
    picked.matters.resize(scene.nodes.size());
    auto skeleton = std::make_shared<Skeleton>();
    for (const int node : picked.nodes) {
        const auto at = static_cast<std::size_t>(node);
        picked.matters[at] = 1;
        std::vector<int>& above = picked.above.emplace_back();
        int parent = k_no_joint;
        for (int n = parents[at]; n != k_no_joint && n != picked.root_motion;
             n = parents[static_cast<std::size_t>(n)]) {
            parent = joint_of[static_cast<std::size_t>(n)];
            if (parent != k_no_joint) break;
            above.push_back(n);
            picked.matters[static_cast<std::size_t>(n)] = 1;
        }
        joint_of[at] = skeleton->add(scene.nodes[at].name, parent, {}, end_of(scene, picked.nodes, node));
        picked.skeleton_parents.push_back(parent);
    }
    if (picked.root_motion != k_no_joint) picked.matters[static_cast<std::size_t>(picked.root_motion)] = 1;
    make_joint_names_unique(skeleton->names, warnings);
    fill_rest(scene, picked, *skeleton);
    picked.skeleton = std::move(skeleton);
    return picked;
}

}  // namespace surefoot
