#pragma once
// A plane that may be tilted while somebody goes on it.

#include <surefoot/ground/shapes.h>

namespace surefoot::wasm {

class Floor final : public Ground {
  public:
    float rise() const noexcept { return rise_; }
    /// From now on it rises by so much a metre along +Z, and goes on through the place that is kept.
    void tilt(float rise, Vec3 kept) noexcept {
        rise_ = rise;
        plane_ = Plane(0, rise, kept.y - rise * kept.z);
    }
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
        plane_.query(queries, hits);
    }
    SurfaceMesh mesh(const Extent& extent) const { return plane_.mesh(extent); }

  private:
    float rise_ = 0;
    Plane plane_;
};

}  // namespace surefoot::wasm
