#include <surefoot/io/mesh_loft.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {

SkinWeights SkinWeights::rigid(int joint) noexcept { return {{static_cast<std::uint16_t>(joint)}, {1, 0, 0, 0}}; }

SkinWeights SkinWeights::mix(const SkinWeights& a, const SkinWeights& b, float share) noexcept {
    struct Entry {
        std::uint16_t joint;
        float weight;
    };
    std::array<Entry, 8> entries{};
    std::size_t count = 0;
    const auto add = [&](const SkinWeights& skin, float part) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (!(skin.weights[i] * part > 0)) continue;
            const auto end = entries.begin() + static_cast<std::ptrdiff_t>(count);
            const auto found =
                std::find_if(entries.begin(), end, [&](const Entry& e) { return e.joint == skin.joints[i]; });
            if (found != end)
                found->weight += skin.weights[i] * part;
            else
                entries[count++] = {skin.joints[i], skin.weights[i] * part};
        }
    };
    add(a, 1 - share);
    add(b, share);
    std::stable_sort(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const Entry& x, const Entry& y) { return x.weight > y.weight; });
    SkinWeights out;
    float sum = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 4); ++i) sum += entries[i].weight;
    for (std::size_t i = 0; i < 4; ++i) {
        const bool used = i < count && sum > 0;
        out.joints[i] = used ? entries[i].joint : std::uint16_t{0};
        out.weights[i] = used ? entries[i].weight / sum : 0.0f;
    }
    return out;
}

SkinWeights SkinChain::at(float place) const noexcept {
    SkinWeights skin = SkinWeights::rigid(links.front().joint);
    for (std::size_t i = 1; i < links.size(); ++i) {
        const Link& link = links[i];
        const float t = link.reach > 0 ? std::clamp(0.5f + 0.5f * (place - link.place) / link.reach, 0.0f, 1.0f)
                                       : (place >= link.place ? 1.0f : 0.0f);
        skin = SkinWeights::mix(skin, SkinWeights::rigid(link.joint), t * t * (3 - 2 * t));
    }
    return skin;
}

namespace {

std::uint32_t add_vertex(Mesh& mesh, Vec3 position, const SkinWeights& skin) {
    mesh.positions.push_back(position);
    mesh.joints.push_back(skin.joints);
    mesh.weights.push_back(skin.weights);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// Normals of the vertices from `first_vertex` on: sums of the triangles around each, larger ones counting more.
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
            const float up = std::max(sin(angle), ring.flat_at);
            add_vertex(mesh, ring.center + ring.across * cos(angle) + ring.forward * up, ring.skin);
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
