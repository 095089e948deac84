#pragma once
// The runtime form of a clip: 16-bit rotations in blocks of eight joints, the few translations that move, root motion
// and phase apart. Immutable, shared by all characters. Made by bake/pack.h, which also measures the error.

#include <surefoot/math/transform.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr int k_lanes = 8;  ///< joints a block

struct PackedClip {
    std::string name;
    float fps = 30;
    int frame_count =
        0;  ///< [Limit: >= 2; a pose is two equal frames] the last one is the first one cycle later if cyclic
    int joint_count = 0;
    bool cyclic = false;

    /// [frame][block][x8 y8 z8 w8], value = q * 32767, hemisphere-aligned to the skeleton's rest rotation.
    std::vector<std::int16_t> rotations;
    /// Joints whose translation differs from rest somewhere in the clip, ascending; the others are at rest.
    std::vector<std::int16_t> moving;
    /// [frame][moving joint] metres.
    std::vector<Vec3> translations;

    /// [frame] relative to the first frame; within the clip continuous, over the cycle it accumulates `travel`.
    std::vector<RootFrame> root;
    RootFrame travel;  ///< root of the last frame seen from the first: what one pass adds

    /// Foot strikes in clip phase: pairs of (time share in [0,1], phase in [0,1]), ascending, that map time to phase
    /// piecewise linearly; phase 0 is a left foot strike. Empty for acyclic clips.
    std::vector<std::array<float, 2>> phase_map;

    int block_count() const noexcept { return (joint_count + k_lanes - 1) / k_lanes; }
    float duration() const noexcept { return static_cast<float>(frame_count - 1) / fps; }
};

}  // namespace surefoot
