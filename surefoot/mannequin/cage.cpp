#include <surefoot/mannequin/cage.h>

#include <algorithm>
#include <map>

namespace surefoot {

std::uint32_t Cage::add(Vec3 position, const SkinWeights& skin) {
    positions.push_back(position);
    skins.push_back(skin);
    return static_cast<std::uint32_t>(positions.size() - 1);
}

void Cage::bridge(const Loop& from, const Loop& to, bool flip) {
    const std::size_t n = std::min(from.size(), to.size());
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t k = (i + 1) % n;
        if (flip)
            faces.push_back({from[i], to[i], to[k], from[k]});
        else
            faces.push_back({from[i], from[k], to[k], to[i]});
    }
}

void Cage::cap(const Loop& loop, bool flip) {
    faces.push_back(loop);
    if (flip) std::reverse(faces.back().begin(), faces.back().end());
}

namespace {

/// A sum of vertices in the making.
struct Blend {
    Vec3 position;
    SkinSum skin;
    float shares = 0;

    void add(Vec3 p, const SkinWeights& s, float share) {
        position += p * share;
        skin.add(s, share);
        shares += share;
    }
};

struct Edge {
    std::vector<std::uint32_t> faces;
    std::uint32_t point = 0;  // in the mesh
};

class Subdivision {
  public:
    explicit Subdivision(const Cage& cage) : cage_(cage) {}
    Mesh run();

  private:
    using Key = std::pair<std::uint32_t, std::uint32_t>;
    static Key key(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }
    std::uint32_t put(const Blend& blend);
    void add_old(Blend& blend, std::uint32_t v, float share) const {
        blend.add(cage_.positions[v], cage_.skins[v], share);
    }
    void add_new(Blend& blend, std::uint32_t v, float share) const {
        blend.add(mesh_.positions[v], {mesh_.joints[v], mesh_.weights[v]}, share);
    }
    void make_points();
    void make_triangles();

    const Cage& cage_;
    Mesh mesh_;
    std::vector<std::uint32_t> face_points_, vertex_points_;
    std::map<Key, Edge> edges_;
};

std::uint32_t Subdivision::put(const Blend& blend) {
    const SkinWeights skin = blend.skin.result();
    mesh_.positions.push_back(blend.position / blend.shares);
    mesh_.joints.push_back(skin.joints);
    mesh_.weights.push_back(skin.weights);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void Subdivision::make_points() {
    std::vector<std::vector<std::uint32_t>> faces_of(cage_.positions.size()), neighbours_of(cage_.positions.size());
    for (std::uint32_t f = 0; f < cage_.faces.size(); ++f) {
        const Loop& face = cage_.faces[f];
        Blend middle;
        for (std::size_t i = 0; i < face.size(); ++i) {
            add_old(middle, face[i], 1);
            faces_of[face[i]].push_back(f);
            edges_[key(face[i], face[(i + 1) % face.size()])].faces.push_back(f);
        }
        face_points_.push_back(put(middle));
    }
    for (auto& [ends, edge] : edges_) {
        Blend middle;
        add_old(middle, ends.first, 1);
        add_old(middle, ends.second, 1);
        for (const std::uint32_t f : edge.faces) add_new(middle, face_points_[f], 1);
        edge.point = put(middle);
        neighbours_of[ends.first].push_back(ends.second);
        neighbours_of[ends.second].push_back(ends.first);
    }
    // (Q + 2 R + (n - 3) V) / n: Q the mean of the faces around, R that of the middles of the edges.
    for (std::uint32_t v = 0; v < cage_.positions.size(); ++v) {
        if (faces_of[v].empty()) {  // a corner where a hole was made
            vertex_points_.push_back(0);
            continue;
        }
        const auto n = static_cast<float>(faces_of[v].size());
        Blend blend;
        for (const std::uint32_t f : faces_of[v]) add_new(blend, face_points_[f], 1 / (n * n));
        for (const std::uint32_t other : neighbours_of[v]) {
            add_old(blend, v, 1 / (n * n));
            add_old(blend, other, 1 / (n * n));
        }
        add_old(blend, v, std::max(0.0f, (n - 3) / n));
        vertex_points_.push_back(put(blend));
    }
}

void Subdivision::make_triangles() {
    for (std::uint32_t f = 0; f < cage_.faces.size(); ++f) {
        const Loop& face = cage_.faces[f];
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t before = face[(i + face.size() - 1) % face.size()], after = face[(i + 1) % face.size()];
            const std::uint32_t corner = vertex_points_[face[i]], middle = face_points_[f];
            const std::uint32_t out = edges_[key(face[i], after)].point, in = edges_[key(before, face[i])].point;
            mesh_.indices.insert(mesh_.indices.end(), {corner, out, middle, corner, middle, in});
        }
    }
}

Mesh Subdivision::run() {
    make_points();
    make_triangles();
    add_normals(mesh_, 0, 0);
    return std::move(mesh_);
}

}  // namespace

Mesh subdivided(const Cage& cage) { return Subdivision(cage).run(); }

void add_normals(Mesh& mesh, std::size_t first_vertex, std::size_t first_index) {
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = first_index; i < mesh.indices.size(); i += 3) {
        const auto a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const Vec3 n = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        for (const auto v : {a, b, c}) mesh.normals[v] += n;
    }
    for (std::size_t v = first_vertex; v < mesh.normals.size(); ++v)
        mesh.normals[v] = normalized(mesh.normals[v], k_up);
}

}  // namespace surefoot
