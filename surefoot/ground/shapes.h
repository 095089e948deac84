#pragma once
// Grounds given by a formula: planes, ramps, stairs, bands, tiles. All answer at any x, z; all are level in their
// first stretch, so that a character can start walking on the flat.

#include <surefoot/ground/ground.h>
#include <surefoot/ground/surface_mesh.h>

namespace surefoot {

/// A plane through (0, height, 0) that rises along x and z.
class Plane final : public Ground {
  public:
    /// Rise a metre along +X and along +Z.
    explicit Plane(float rise_x = 0, float rise_z = 0, float height = 0) noexcept;
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;
    SurfaceMesh mesh(const Extent& extent) const;

  private:
    float rise_x_, rise_z_, height_;
};

/// Level up to z = start, then `rise` a metre up to z = end, then level again.
class Ramp final : public Ground {
  public:
    Ramp(float rise, float start, float end) noexcept;
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;
    SurfaceMesh mesh(const Extent& extent) const;

  private:
    float rise_, start_, end_;
};

/// Stairs along +Z: `count` risers, the first at z = start; a negative riser leads down.
class Stairs final : public Ground {
  public:
    Stairs(float riser, float tread, float start, int count) noexcept;
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;
    SurfaceMesh mesh(const Extent& extent) const;

  private:
    float riser_, tread_, start_;
    int count_;
};

/// Level ground with raised straight bands: ledges, kerbs. The bands lie across the direction (skew, 1) of the plane.
class Bands final : public Ground {
  public:
    struct Band {
        float from = 0, to = 0;  ///< [m] along the direction
    };
    Bands(float height, float skew, std::vector<Band> bands) noexcept;
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;
    SurfaceMesh mesh(const Extent& extent) const;

  private:
    float height_, skew_;
    std::vector<Band> bands_;
};

/// Square tiles of random height, level ground before z = start: rubble.
class Tiles final : public Ground {
  public:
    Tiles(float size, float highest, float start, std::uint64_t seed);
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override;
    SurfaceMesh mesh(const Extent& extent) const;

  private:
    float height_at(int column, int row) const noexcept;
    float size_, start_;
    std::vector<float> heights_;
};

/// Height at one place, searched 100 m up and down: for tools and tests. 0 where there is no ground.
float height_at(const Ground& ground, float x, float z) noexcept;

}  // namespace surefoot
