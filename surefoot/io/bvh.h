#pragma once
// BVH (Biovision hierarchy), in and out. The format has no standard; what we hold to:
//
// - A joint's rotation is the product of its rotation channels in the order they are listed, in degrees.
// - Position channels, on any joint, *replace* the OFFSET (so do Blender, MotionBuilder and the CMU conversions).
// - All rotation channels zero is the rest pose. `End Site` becomes the joint's tip.
// - One line of the motion block is one frame. Keywords in any case, any blanks, any line ends.

#include <surefoot/io/clip_file.h>

#include <string>
#include <string_view>

namespace surefoot {

/// Reads a BVH text. `where` names it in messages; the motion is named after it. Throws Error with the line. Memory
/// taken is bounded by the length of the text, whatever its header promises.
LoadedClip read_bvh(std::string_view text, const std::string& where, const LoadOptions& options = {});

struct BvhWriteOptions {
    std::string rotation_order = "ZXY";  ///< three different letters of X, Y, Z
    double units_per_metre = 100;        ///< centimetres, as most programs expect
};

/// The motion as BVH text, root motion multiplied into the top joints. Joints whose translation moves get six channels;
/// the others keep their (constant) translation as OFFSET. Rest rotations have no place in the format. Throws Error
/// where the motion is not sound.
std::string write_bvh(const Motion& motion, const BvhWriteOptions& options = {});

}  // namespace surefoot
