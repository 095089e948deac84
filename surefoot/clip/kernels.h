#pragma once
// The kernels of this room, as raw as they are: plain pointers in, plain pointers out, so that a file compiled for
// another instruction set shares no inline function with the rest of the program (math/lanes.h says why that matters).
// Private to clip/; the public face is sample.h.

#include <surefoot/math/kernel_builds.h>

#include <cstddef>
#include <cstdint>

namespace surefoot {

inline constexpr std::int32_t k_whole_share = 32767;

/// Two neighbouring frames of one leaf and what each weighs.
struct KeyPair {
    const std::int16_t* from;           ///< [block][x8 y8 z8 w8]
    const std::int16_t* to;             ///< the frame after it
    const std::uint8_t* turning;        ///< one flag a block, or null
    std::int32_t from_share, to_share;  ///< [0, k_whole_share], together k_whole_share
    float weight;                       ///< of the leaf, over k_whole_share
};

struct ClipKernels {
    const char* name;
    /// Weighted sum of `count` key pairs and of `sums` (null: nothing), normalised; the rotation of joint j goes to
    /// out[j * stride] … + 3.
    void (*blend_rotations)(const KeyPair* pairs, int count, const float* sums, int joints, float* out,
                            std::size_t stride);
    /// Adds the rotations of a clip in its small form to sums, [block][x8 y8 z8 w8] in units of 1 / 32767.
    /// turns: [block][x8 y8 z8] from `middle`, [block][x8 y8 z8 w8].
    void (*add_turns)(const float* turns, const std::int16_t* middle, int joints, float weight, float* sums);
    /// Eight characters, lane = character: locals[c] is [joint][qx qy qz qw tx ty tz]; models[c] receives
    /// [joint][3x4]. scratch: [joint][7][8].
    void (*local_to_model)(const std::int16_t* parents, int joints, const float* const* locals, float* const* models,
                           float* scratch);
};

SUREFOOT_DECLARE_KERNELS(ClipKernels);

}  // namespace surefoot
