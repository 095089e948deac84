#pragma once
// How smoothly a live character goes from one gait to another, at any moment: what its feet and joints do at their
// quickest on the way, against what they do in the two gaits when nothing changes.
//
// DESIGN §7 and issue "Gaits": no foot speed and no joint acceleration above 1.5 times that of the two gaits. A plain
// cut from one to the other is measured beside it, which must come out as bad: that keeps the measure honest.

#include <surefoot/course/live_play.h>

#include <string>
#include <vector>

namespace surefoot {

inline constexpr double k_most_transition_ratio = 1.5;

/// The quickest that a motion gets, over frames [first, end). Derivatives after a Gaussian of 25 ms.
struct MotionPeaks {
    double foot_mps = 0;               ///< of heel or ball in the world
    std::vector<double> joint_deg_s2;  ///< by joint: of its local rotation's angular velocity
};
MotionPeaks measure_peaks(const Motion& motion, const Legs& legs, int first, int end);

/// Something that a character may be asked for.
struct LiveTask {
    std::string name;
    LiveRequest request;
};
/// Stand, a slow walk, a walk, a run, a tight turn, and the last two again in every other manner.
std::vector<LiveTask> usual_tasks(const LiveRig& rig);

struct TransitionOptions {
    int phases = 8;                                    ///< moments of the cycle at which the other is asked for
    std::vector<float> durations_s{0.4f, 0.8f, 1.6f};  ///< in which to get there
    float fps = 60;
};

/// One pair of tasks at its worst moment.
struct TransitionFigure {
    std::string from, to;
    double foot_ratio = 0, joint_ratio = 0;  ///< the largest over phases and durations
    std::string joint;                       ///< of joint_ratio
    float foot_phase = 0, foot_duration_s = 0, joint_phase = 0, joint_duration_s = 0;
    double slide_cm_s = 0;                           ///< planted feet, mean, the worst of its runs
    double steady_slide_cm_s = 0;                    ///< the same of the two gaits by themselves, the larger
    double cut_foot_ratio = 0, cut_joint_ratio = 0;  ///< the same of a plain cut, at its mildest moment

    double worst() const { return foot_ratio > joint_ratio ? foot_ratio : joint_ratio; }
};

struct TransitionReport {
    std::vector<TransitionFigure> pairs;  ///< in order of tasks
    int runs = 0;
    const TransitionFigure& worst() const;
    bool smooth() const { return worst().worst() <= k_most_transition_ratio; }
};

/// Every ordered pair of tasks. Throws Error where there are fewer than two.
TransitionReport measure_transitions(const LiveRig& rig, const std::vector<LiveTask>& tasks,
                                     const TransitionOptions& options = {});

std::string transitions_table(const TransitionReport& report);
/// {"runs", "limit", "smooth", "worst": P, "pairs": [P, …]}; P = {"from", "to", "foot_ratio", "joint_ratio", "joint",
/// …}
std::string transitions_json(const TransitionReport& report);

}  // namespace surefoot
