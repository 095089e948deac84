#pragma once
// Which joints a vertex follows. Private to the room.

#include <array>
#include <cstdint>
#include <vector>

namespace surefoot {

/// Up to four joints with weights that sum to 1.
struct SkinWeights {
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{1, 0, 0, 0};

    static SkinWeights rigid(int joint) noexcept;
    /// `share` of b, the rest of a.
    static SkinWeights mix(const SkinWeights& a, const SkinWeights& b, float share) noexcept;
};

/// A weighted sum of skins, of which the four strongest joints remain.
class SkinSum {
  public:
    void add(const SkinWeights& skin, float share) noexcept;
    SkinWeights result() const noexcept;

  private:
    static constexpr std::size_t k_most = 32;  // more joints meet at no vertex; what comes after them is dropped

    void add(std::uint16_t joint, float weight) noexcept;

    std::array<std::uint16_t, k_most> joints_{};
    std::array<float, k_most> weights_{};
    std::size_t count_ = 0;
};

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
