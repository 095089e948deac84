#pragma once
// How fast the ground runs under a clip whose hips do not travel: what the standing feet say.

#include <surefoot/analysis/tracks.h>

#include <span>
#include <vector>

namespace surefoot {

/// The character's motion over the ground, constant in the frame of the file.
struct GroundMotion {
    Vec3 velocity;       ///< [m/s] of the character's `centre`; y is 0
    float turn = 0;      ///< [rad/s] to the left
    Vec3 centre;         ///< [m] mean place of the hips on the ground; the rotation is about it
    float coverage = 0;  ///< share of frames in which some sole point stands
    float residual = 0;  ///< [m/s] weighted mean speed of standing points over the ground so found

    float speed() const noexcept { return planar_length(velocity); }
};

/// Solves v = -(V + omega x r) over the standing sole points of both feet by iteratively reweighted least squares
/// (weights fall with height, vertical speed and disagreement), then averages V evenly over time, not over samples. The
/// speed rests on feet that lie flat, since rolling ones creep forward; on whole stances where the hips were held still
/// frame by frame (a pelvis is slowest at mid-stance) or the feet never lie flat. Needs soles and the ground at y = 0.
/// Turn: what the feet do to opposite sides (a body sways to and fro, feet twist) or all at once (it surges) is told
/// apart from it. `given_turn` [rad/s]: known, and not sought.
GroundMotion estimate_ground_motion(const Tracks& tracks, float leg_length, const float* given_turn = nullptr);

/// What the standing feet of a clip with root motion slip over the ground: the same estimate, as seen from the root
/// (one frame a frame of `tracks`, which are in the world), about its origin. The feet say that the root moves by that
/// much more than it does. Nothing (coverage 0) where the frames do not match.
GroundMotion estimate_slip(const Tracks& tracks, std::span<const RootFrame> root, float leg_length);

/// The path of a frame that starts at the origin and moves with constant velocity [m/s] and turn [rad/s] in its own
/// space, about `centre`, sampled at `fps`: multiply a motion in place by it and it travels.
std::vector<RootFrame> constant_path(const GroundMotion& motion, float fps, int frames);

}  // namespace surefoot
