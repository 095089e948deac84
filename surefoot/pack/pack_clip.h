#pragma once
// Editable motion to the runtime's packed clips, and how far the packed form is from the motion.
//
// The error is ACL's metric (Frechette 2017): virtual vertices stand off from each joint along three axes, and the
// error is the largest distance in model space between where motion and packed clip put them, over all frames.

#include <surefoot/analysis/clip_facts.h>
#include <surefoot/clip/packed_clip.h>
#include <surefoot/motion/motion.h>
#include <surefoot/rig/leg.h>

namespace surefoot {

struct PackOptions {
    /// The root moves steadily, and what it did beside that goes into the pose: blends then obey their parameters at
    /// every moment and planted feet stay planted. World poses do not change. Off: the root as it is.
    bool steady_root = true;
    /// The steady root heads exactly along its travel (forward, or backward for a clip that walks backward), the pose
    /// turning the other way by the few degrees between: for clips of a space without a sideways axis. [Limit: only
    /// where travel is within 45 degrees of ahead or behind]
    bool along_travel = false;
    float moving_translation = 1e-5f;  ///< [m] a translation that strays no farther from rest is dropped
    /// The character's legs: the clip then knows where its feet stand (clip/foot_prints.h). Null, or a root that is not
    /// steady: it does not, and its blends have no feet of their own.
    const Legs* legs = nullptr;
    /// [m] How far the clip may be from the motion (PackReport::error): it is then kept in the small form where there
    /// is one within that (small_form.h). 0: every frame is kept.
    float error = 0;
};

struct PackReport {
    float error = 0;      ///< [m] largest displacement of a virtual vertex, of pose and footprints
    int error_frame = 0;  ///< where
    int error_joint = 0;
    float root_deviation = 0;      ///< [m] largest distance between the steady root and the motion's own
    float root_deviation_yaw = 0;  ///< [rad] the same for headings
    std::size_t bytes = 0;         ///< of memory (memory_size)
    std::size_t raw_bytes = 0;     ///< 40 bytes a joint and frame: rotation, translation, scale as floats
};

inline constexpr float k_virtual_vertex_distance = 0.03f;  ///< [m] skin and shoes are about this far from a joint

/// Packs a motion; facts give the foot strikes (`facts.events`). Throws Error for a motion that is not sound.
PackedClip pack_clip(const Motion& motion, const ClipFacts& facts, const PackOptions& options = {},
                     PackReport* report = nullptr);

/// Measures a packed clip against the motion it was made from (world poses, the first frame's root at the origin), and
/// with `legs` its footprints, too.
PackReport measure_packing(const Motion& motion, const PackedClip& clip, const Legs* legs = nullptr);

}  // namespace surefoot
