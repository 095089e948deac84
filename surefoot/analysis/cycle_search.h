#pragma once
// Where in a take steady cycles are. find_cycles (analyze.h) cuts and closes what this finds.

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/pose_match.h>

namespace surefoot {

struct CycleCandidate {
    int first = 0, last = 0;                   ///< frames of the take; `last` shows the pose of `first` again
    int strike = 0;                            ///< frame of the left foot strike in [first, last), where phase is 0
    RootFrame step;                            ///< the move over the ground from the first pose to the last
    float seam = 0;                            ///< [m] largest joint mismatch once the step is taken out
    float seam_speed = 0;                      ///< [m/s]
    float forward = 0, lateral = 0, turn = 0;  ///< [m/s], [m/s], [deg/s] mean over the cycle, in the body's frame
    float unsteadiness = 0;  ///< [m/s] how much speed and turn vary within the cycle (1 m/s is worth 60 deg/s)
    bool idle = false;

    /// Lower is better: what a viewer would notice at the seam.
    float cost() const noexcept { return seam + 0.02f * seam_speed + 0.05f * unsteadiness; }
};

/// True where the two are two cycles and not one found twice: they overlap by at most half of the shorter one, or
/// differ by 0.1 m/s or 10 deg/s.
bool distinct(const CycleCandidate& a, const CycleCandidate& b) noexcept;

/// One or two strides of alternating feet that loop well enough, and stretches of standing; overlapping and unsorted.
/// A stride may be cut at any phase: hands that swing unlike at one phase often meet at another. The number of
/// candidates tried a stride is bounded, so the cost is linear in the frames.
std::vector<CycleCandidate> cycle_candidates(const AnalyzedClip& take, const KeyPoses& poses);

/// The best of each group that is not distinct, in order of speed, then turn, then time.
std::vector<CycleCandidate> best_distinct(std::vector<CycleCandidate> candidates);

/// Root frames of constant velocity and turn from `first` on, arriving at step * first after `frames` - 1 steps.
std::vector<RootFrame> steady_path(const RootFrame& first, const RootFrame& step, int frames);

}  // namespace surefoot
