#pragma once
// The ground as foot placement sees it: a batch of vertical queries, answered by the host or by one of the grounds
// here.

#include <surefoot/math/vec.h>

#include <cstdint>
#include <span>

namespace surefoot {

struct GroundQuery {
    Vec3 origin;     ///< [m] world; the search is vertical through it
    float up = 1;    ///< [m] [Limit: >= 0] how far above the origin to look
    float down = 1;  ///< [m] [Limit: >= 0] how far below
};

struct GroundHit {
    bool hit = false;           ///< false: nothing within reach; the rest is then unspecified
    float height = 0;           ///< [m] world y of the surface
    Vec3 normal{0, 1, 0};       ///< unit, upward
    std::uint32_t surface = 0;  ///< the host's id: ice, mud, wood
    Vec3 velocity;              ///< [m/s] of the surface at the hit: platforms, escalators
};

/// Supplied by the host. Must be safe to call from several threads at once, and must answer the same query alike within
/// one update.
class Ground {
  public:
    virtual ~Ground() = default;
    /// Answers queries[i] in hits[i]; both have the same length.
    virtual void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept = 0;
};

}  // namespace surefoot
