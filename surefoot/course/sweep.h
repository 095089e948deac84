#pragma once
// Every course, walked every way: what `surefoot walk --all` does.

#include <surefoot/course/figures.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace surefoot {

inline constexpr std::array k_sweep_speeds{0.8f, 1.4f, 2.5f, 4.0f};  ///< [m/s]

/// What is left empty is everything that makes sense; what is named is walked as asked.
struct SweepRequest {
    std::vector<std::string> courses, paths;
    std::vector<float> speeds_mps;
    std::vector<float> usual_speeds_mps{k_sweep_speeds.begin(), k_sweep_speeds.end()};  ///< where none are named
    std::vector<bool> reverse;  ///< {false}: from the near end only
    std::string character;
    float grade_deg = 15;
    float seconds = 0;  ///< 0: 16, 30 with turns on the spot, 60 on an eight
    bool limit_pace = true;
};

/// The walks of a request: courses, then paths, speeds, directions. By itself: the usual speeds, on steps no more than
/// 1.4 m/s, nor before turns on the spot; eights only where the ground is alike in every direction; flat and level
/// ground from one end only.
std::vector<WalkInfo> plan_sweep(const SweepRequest& request);

/// A curve to be drawn: one value every `k_trace_stride` frames.
using Trace = std::vector<float>;
inline constexpr int k_trace_stride = 3;

/// What a page draws of a walk in one mode.
struct WalkTraces {
    std::array<Trace, 2> foot_cm;   ///< by Side: the lowest sole point over the ground under it; negative is inside it
    std::array<Trace, 2> knee_deg;  ///< by Side: interior angle
    Trace hips_cm;                  ///< above the world's zero
};

struct SweptWalk {
    WalkInfo info;
    std::vector<MeasuredWalk> rows;  ///< one a mode
    std::vector<WalkTraces> traces;  ///< one a row
    WalkTraces twin;                 ///< on flat ground
    Trace ground_cm;                 ///< under the root
};

/// A new walker for a walk, on its way. Called from several threads.
using MakeWalker = std::function<std::unique_ptr<Walker>(const WalkInfo&)>;

/// Walks them all, in parallel, with a bar on a terminal. The result does not depend on the number of threads.
std::vector<SweptWalk> sweep(const std::vector<WalkInfo>& walks, const MakeWalker& make,
                             std::span<const FootMode> modes = k_foot_modes);

/// The rows of all walks in order.
std::vector<MeasuredWalk> all_rows(std::span<const SweptWalk> walks);

/// True where no judged walk misses a mark, and some walk is judged.
bool meets_all_marks(std::span<const SweptWalk> walks);

}  // namespace surefoot
