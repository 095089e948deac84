#pragma once
// Closed skinned surfaces from rings: the clay of which the mannequin is made.

#include <surefoot/io/mesh.h>

#include <span>

namespace surefoot {

/// Up to four joints with weights that sum to 1.
struct SkinWeights {
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{1, 0, 0, 0};

    static SkinWeights rigid(int joint) noexcept;
    /// `share` of b, the rest of a.
    static SkinWeights mix(const SkinWeights& a, const SkinWeights& b, float share) noexcept;
};

/// An ellipse of the loft.
struct Ring {
    Vec3 center;   ///< [m]
    Vec3 across;   ///< half-axis [m]
    Vec3 forward;  ///< half-axis [m]
    SkinWeights skin;
    float flat_at = -1;  ///< share of `forward`, -1 to 0, below which the ring is cut flat; -1: round
};

/// Adds a tube through the rings, closed at both ends by a point in the middle of the first and last ring. Turns its
/// faces outward whichever way the rings run. Normals are smooth.
void add_loft(Mesh& mesh, std::span<const Ring> rings, int segments);

/// Chain of joints at places along a path: whose skin a point of the path wears. Weights change smoothly over
/// `reach` to either side of a joint.
struct SkinChain {
    struct Link {
        int joint = 0;
        float place = 0;  ///< [m] along the path where this joint takes over; ignored for the first
        float reach = 0;  ///< [m] half-width of the change
    };
    std::vector<Link> links;

    SkinWeights at(float place) const noexcept;
};

}  // namespace surefoot
