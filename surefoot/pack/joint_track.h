#pragma once
// A joint's rotations over a clip, and how rotations lie in blocks of eight: what a clip's two forms share. Private to
// pack/.

#include <surefoot/clip/packed_clip.h>
#include <surefoot/math/transform.h>

#include <cstdint>
#include <span>
#include <vector>

namespace surefoot {

inline constexpr float k_rotation_scale = 32767.0f;  ///< of a rotation's numbers as 16-bit integers

/// One joint's rotations over the clip, continuous; on the hemisphere of rest for most of it.
struct JointTrack {
    std::vector<Quat> rotations;
    bool turning = false;  ///< some frame is on the other hemisphere
};
/// `locals`: [frame * joints + joint].
JointTrack joint_track(std::span<const Transform> locals, std::size_t joints, std::size_t joint, Quat rest);

/// Writes a joint's rotation among [block][x8 y8 z8 w8].
void put_rotation(std::int16_t* blocks, std::size_t joint, Quat q);

}  // namespace surefoot
