#pragma once
// A crowd of the character on the stage: what the studio's Crowd workspace shows. It goes in rings around one middle,
// each ring at a pace of its own and every other one the other way round, so that nobody meets anybody, and all speeds
// and turns are there to see. On flat ground or another one, on which feet are laid by crowd/crowd_feet.h.

#include "crowd_grounds.h"

#include <surefoot/bake/character.h>
#include <surefoot/crowd/crowd.h>
#include <surefoot/mannequin/mesh.h>

#include <span>
#include <string>
#include <vector>

namespace surefoot::wasm {

inline constexpr int k_max_crowd = 10000;

class CrowdStage {
  public:
    /// Keeps a reference to the character. `count` is brought into [1, k_max_crowd]. Throws Error for a ground that is
    /// none of crowd_ground_names().
    CrowdStage(const Character& character, int count, const std::string& ground);

    /// How many, of how many joints, out to where, and the levels of the mesh: one JSON object (surefoot.d.mts:
    /// CrowdFacts).
    std::string describe() const;
    /// One frame of `seconds`. With `lasting`, the poses of who is far from the eye last for several frames; with
    /// `feet`, feet are laid on ground that is not flat, else roots alone follow it. Returns how many were posed.
    int advance(float seconds, float eye_x, float eye_z, bool lasting, bool feet) noexcept;

    /// By character: on the ground, in the world.
    std::span<const RootFrame> roots() const noexcept { return roots_; }
    /// By character, then joint: what skinning takes.
    std::span<const Matrix34> matrices() const noexcept { return matrices_; }
    /// All levels one after the other, finest first: CrowdFacts::levels says which triangles are whose.
    const Mesh& mesh() const noexcept { return mesh_; }
    const SurfaceMesh& terrain() const noexcept { return ground_.mesh; }

  private:
    struct Ring {
        float radius, speed;  ///< [m], [m/s]
        float way;            ///< 1: to the left around the middle, -1: to the right
    };
    void add_level(const Mesh& level);
    void place(int count);
    void follow_ground() noexcept;
    LocomotionRequest ask(const RootFrame& root, const Ring& ring) const noexcept;

    const Character& character_;
    CrowdGround ground_;
    Mesh mesh_;
    std::vector<std::size_t> level_ends_;  ///< of each level's triangles, in indices
    std::vector<Matrix34> inverse_bind_;
    std::vector<Ring> rings_;
    std::vector<std::uint16_t> ring_of_;
    std::vector<LocomotionState> states_;
    std::vector<LocomotionRequest> wishes_;
    std::vector<RootFrame> roots_;
    std::vector<CrowdFeet> feet_;
    std::vector<std::uint8_t> periods_;
    std::vector<Matrix34> matrices_;
    CrowdScratch scratch_;
    std::uint32_t frame_ = 0;
};

}  // namespace surefoot::wasm
