#include <surefoot/mannequin/cage.h>
#include <surefoot/mannequin/loft.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {

namespace {

std::uint32_t add_vertex(Mesh& mesh, Vec3 position, const SkinWeights& skin) {
    mesh.positions.push_back(position);
    mesh.joints.push_back(skin.joints);
    mesh.weights.push_back(skin.weights);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

}  // namespace

void add_loft(Mesh& mesh, std::span<const Ring> rings, int segments) {
    const std::size_t first_vertex = mesh.positions.size(), first_index = mesh.indices.size();
    const auto n = static_cast<std::uint32_t>(segments);
    float handed = 0;
    for (std::size_t i = 0; i + 1 < rings.size(); ++i)
        handed += dot(cross(rings[i].across, rings[i].forward), rings[i + 1].center - rings[i].center);
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (handed > 0) std::swap(b, c);
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    const std::uint32_t start = add_vertex(mesh, rings.front().center, rings.front().skin);
    for (const Ring& ring : rings)
        for (std::uint32_t k = 0; k < n; ++k) {
            const float angle = static_cast<float>(2 * k_pi) * static_cast<float>(k) / static_cast<float>(n);
            add_vertex(mesh, ring.center + ring.across * cos(angle) + ring.forward * sin(angle), ring.skin);
        }
    const std::uint32_t end = add_vertex(mesh, rings.back().center, rings.back().skin);
    const auto at = [&](std::size_t ring, std::uint32_t k) {
        return start + 1 + static_cast<std::uint32_t>(ring) * n + k % n;
    };
    for (std::uint32_t k = 0; k < n; ++k) {
        triangle(start, at(0, k), at(0, k + 1));
        for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
            triangle(at(i, k), at(i + 1, k), at(i, k + 1));
            triangle(at(i, k + 1), at(i + 1, k), at(i + 1, k + 1));
        }
        triangle(end, at(rings.size() - 1, k + 1), at(rings.size() - 1, k));
    }
    add_normals(mesh, first_vertex, first_index);
}

}  // namespace surefoot
