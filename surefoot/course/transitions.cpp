#include <surefoot/analysis/leg_track.h>
#include <surefoot/base/error.h>
#include <surefoot/course/transitions.h>
#include <surefoot/host/parallel.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace surefoot {
namespace {

constexpr float k_lead = 0.5f;    // [s] of the old gait before the other is asked for
constexpr float k_tail = 4.5f;    // [s] after the glide: a stop has taken its steps by then
constexpr float k_steady = 4.0f;  // [s] of a gait alone: some cycles
/// Joints that hardly move in either gait count as though they moved so much: a hundredth of a degree a frame and
/// frame.
constexpr double k_least_deg_s2 = 300;

using Series = std::array<std::vector<double>, 3>;

void smooth(Series& track, double fps) {
    for (std::vector<double>& axis : track) axis = smoothed_series(axis, fps);
}
void push(Series& track, Vec3 v) {
    track[0].push_back(static_cast<double>(v.x));
    track[1].push_back(static_cast<double>(v.y));
    track[2].push_back(static_cast<double>(v.z));
}
/// The largest length of the central difference within [first, end).
double fastest(const Series& track, double fps, int first, int end) {
    double most = 0;
    for (auto i = static_cast<std::size_t>(std::max(first, 1)); i < static_cast<std::size_t>(end); ++i) {
        if (i + 1 >= track[0].size()) break;
        double square = 0;
        for (const std::vector<double>& axis : track) {
            const double rate = (axis[i + 1] - axis[i - 1]) * 0.5 * fps;
            square += rate * rate;
        }
        most = std::max(most, square);
    }
    return std::sqrt(most);
}

double foot_peak(const WalkTrack& track, std::size_t side, std::size_t point, int first, int end) {
    Series path;
    for (const TrackFrame& frame : track.frames) push(path, frame.legs[side].sole[point]);
    const auto fps = static_cast<double>(track.fps);
    smooth(path, fps);
    return fastest(path, fps, first, end);
}

/// Peak of the angular acceleration of a joint against its parent, deg/s^2.
double joint_peak(const Motion& motion, int joint, int first, int end) {
    Series rate;
    const auto fps = static_cast<double>(motion.fps);
    for (int f = 0; f + 1 < motion.frame_count(); ++f) {
        const Quat a = motion.frame(f)[static_cast<std::size_t>(joint)].rotation;
        const Quat b = motion.frame(f + 1)[static_cast<std::size_t>(joint)].rotation;
        push(rate, to_rotation_vector(conjugate(a) * b) * motion.fps);
    }
    smooth(rate, fps);
    return fastest(rate, fps, first, end) * 180 / k_pi;
}

/// Mean speed of planted sole points, cm/s; 0 where none is planted.
double slide_of(const Motion& motion, const Legs& legs, int first, int end) {
    const WalkTrack track = make_track(motion, legs);
    const double mean =
        measure_skate(track, track, {static_cast<std::size_t>(first), static_cast<std::size_t>(end)}).mean_cm_s;
    return std::isnan(mean) ? 0 : mean;
}

/// The larger of two gaits' peaks.
MotionPeaks either(const MotionPeaks& a, const MotionPeaks& b) {
    MotionPeaks both = a;
    both.foot_mps = std::max(a.foot_mps, b.foot_mps);
    for (std::size_t j = 0; j < both.joint_deg_s2.size(); ++j)
        both.joint_deg_s2[j] = std::max({a.joint_deg_s2[j], b.joint_deg_s2[j], k_least_deg_s2});
    return both;
}

struct Ratios {
    double foot = 0, joint = 0;
    std::size_t worst_joint = 0;
};
Ratios ratios(const MotionPeaks& peaks, const MotionPeaks& limits) {
    Ratios out;
    out.foot = peaks.foot_mps / std::max(limits.foot_mps, 1e-6);
    for (std::size_t j = 0; j < peaks.joint_deg_s2.size(); ++j)
        if (const double ratio = peaks.joint_deg_s2[j] / limits.joint_deg_s2[j]; ratio > out.joint)
            out = {out.foot, ratio, j};
    return out;
}

/// The first of two motions up to a frame, then the other from its own beginning, from where the first was.
Motion cut(const Motion& first, int frames, const Motion& then) {
    Motion all = make_motion(first.skeleton, "cut", frames + then.frame_count(), first.fps);
    for (int f = 0; f < all.frame_count(); ++f) {
        const bool before = f < frames;
        const auto at = static_cast<std::size_t>(before ? f : f - frames);
        const std::span<const Transform> from = (before ? first : then).frame(static_cast<int>(at));
        std::copy(from.begin(), from.end(), all.frame(f).begin());
        all.root[static_cast<std::size_t>(f)] =
            before ? first.root[at] : first.root[static_cast<std::size_t>(frames - 1)] * then.root[at];
    }
    return all;
}

class PairMeasurement {
  public:
    PairMeasurement(const LiveRig& rig, const LiveTask& from, const LiveTask& to, const MotionPeaks& limits,
                    const TransitionOptions& options)
        : rig_(rig), from_(from), to_(to), limits_(limits), options_(options) {
        figure.from = from.name;
        figure.to = to.name;
        figure.cut_foot_ratio = figure.cut_joint_ratio = 1e9;
    }

    void run() {
        for (int p = 0; p < options_.phases; ++p) {
            const float phase = static_cast<float>(p) / static_cast<float>(options_.phases);
            for (const float duration : options_.durations_s) glide(phase, duration);
            plain_cut(phase);
        }
    }
    TransitionFigure figure;

  private:
    Ratios measure(const Motion& motion, int first) const {
        const int end = motion.frame_count() - static_cast<int>(0.1f * motion.fps);
        return ratios(measure_peaks(motion, rig_.soles, first, end), limits_);
    }
    void glide(float phase, float duration) {
        LiveRequest other = to_.request;
        other.glide = duration;
        const Motion motion = play(rig_, {{from_.request, k_lead}, {other, duration + k_tail}}, options_.fps, phase);
        const int first = static_cast<int>(k_lead * options_.fps) - 2;
        const Ratios found = measure(motion, first);
        if (found.foot > figure.foot_ratio) {
            figure.foot_ratio = found.foot;
            figure.foot_phase = phase, figure.foot_duration_s = duration;
        }
        if (found.joint > figure.joint_ratio) {
            figure.joint_ratio = found.joint;
            figure.joint = rig_.skeleton->names[found.worst_joint];
            figure.joint_phase = phase, figure.joint_duration_s = duration;
        }
        figure.slide_cm_s = std::max(figure.slide_cm_s, slide_of(motion, rig_.soles, first, motion.frame_count()));
    }
    void plain_cut(float phase) {
        const Motion before = play(rig_, {{from_.request, k_lead}}, options_.fps, phase);
        const Motion after = play(rig_, {{to_.request, k_lead}}, options_.fps, phase);
        const Ratios found =
            measure(cut(before, before.frame_count(), after), static_cast<int>(k_lead * options_.fps) - 2);
        figure.cut_foot_ratio = std::min(figure.cut_foot_ratio, found.foot);
        figure.cut_joint_ratio = std::min(figure.cut_joint_ratio, found.joint);
    }

    const LiveRig& rig_;
    const LiveTask &from_, &to_;
    const MotionPeaks& limits_;
    const TransitionOptions& options_;
};

std::string pair_json(const TransitionFigure& p) {
    return fmt::format(
        "{{\"from\": \"{}\", \"to\": \"{}\", \"foot_ratio\": {:.4g}, \"foot_phase\": {:.4g}, \"foot_glide_s\": {:.4g}, "
        "\"joint_ratio\": {:.4g}, \"joint\": \"{}\", \"joint_phase\": {:.4g}, \"joint_glide_s\": {:.4g}, "
        "\"slide_cm_s\": {:.4g}, \"steady_slide_cm_s\": {:.4g}, \"cut_foot_ratio\": {:.4g}, \"cut_joint_ratio\": "
        "{:.4g}}}",
        p.from, p.to, p.foot_ratio, p.foot_phase, p.foot_duration_s, p.joint_ratio, p.joint, p.joint_phase,
        p.joint_duration_s, p.slide_cm_s, p.steady_slide_cm_s, p.cut_foot_ratio, p.cut_joint_ratio);
}

}  // namespace

MotionPeaks measure_peaks(const Motion& motion, const Legs& legs, int first, int end) {
    MotionPeaks peaks;
    const WalkTrack track = make_track(motion, legs);
    constexpr std::size_t k_heel = 0, k_ball = 2;
    for (std::size_t side = 0; side < 2; ++side)
        for (const std::size_t point : {k_heel, k_ball})
            peaks.foot_mps = std::max(peaks.foot_mps, foot_peak(track, side, point, first, end));
    for (int j = 0; j < motion.joint_count(); ++j) peaks.joint_deg_s2.push_back(joint_peak(motion, j, first, end));
    return peaks;
}

std::vector<LiveTask> usual_tasks(const LiveRig& rig) {
    std::vector<LiveTask> tasks{{"stand", {}}};
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        const LiveManner& manner = rig.manners[m];
        const GaitBasis& basis = manner.gait->basis;
        const int index = static_cast<int>(m);
        const std::string name = m == 0 ? "" : manner.name + " ";
        if (!manner.gait->family()) {
            const Vec3 own = rhythm_at(*manner.gait, 0, 0).velocity;
            tasks.push_back({name + "at its pace", {planar_length(own), 0, index}});
            continue;
        }
        tasks.push_back({name + "slow walk", {std::max(0.7f, basis.least_speed), 0, index}});
        tasks.push_back({name + "walk", {1.4f, 0, index}});
        tasks.push_back({name + "turn", {1.4f, 60, index}});
        if (basis.modes > 1) tasks.push_back({name + "run", {3.2f, 0, index}});
    }
    return tasks;
}

const TransitionFigure& TransitionReport::worst() const {
    return *std::max_element(pairs.begin(), pairs.end(),
                             [](const auto& a, const auto& b) { return a.worst() < b.worst(); });
}

TransitionReport measure_transitions(const LiveRig& rig, const std::vector<LiveTask>& tasks,
                                     const TransitionOptions& options) {
    if (tasks.size() < 2) throw Error("transitions need two tasks to go between", "transitions", "");
    std::vector<MotionPeaks> steady(tasks.size());
    std::vector<double> slides(tasks.size());
    parallel_for(tasks.size(), [&](std::size_t i) {
        const Motion motion = play(rig, {{tasks[i].request, k_steady}}, options.fps);
        const int margin = static_cast<int>(0.2f * options.fps);
        steady[i] = measure_peaks(motion, rig.soles, margin, motion.frame_count() - margin);
        slides[i] = slide_of(motion, rig.soles, margin, motion.frame_count() - margin);
    });
    TransitionReport report;
    report.pairs.resize(tasks.size() * (tasks.size() - 1));
    parallel_for(report.pairs.size(), [&](std::size_t i) {
        const std::size_t from = i / (tasks.size() - 1), other = i % (tasks.size() - 1);
        const std::size_t to = other < from ? other : other + 1;
        const MotionPeaks limits = either(steady[from], steady[to]);
        PairMeasurement pair(rig, tasks[from], tasks[to], limits, options);
        pair.figure.steady_slide_cm_s = std::max(slides[from], slides[to]);
        pair.run();
        report.pairs[i] = pair.figure;
    });
    report.runs = static_cast<int>(report.pairs.size() * options.durations_s.size()) * options.phases;
    return report;
}

std::string transitions_table(const TransitionReport& report) {
    std::string out =
        "from         to           feet x  at phase, glide   joints x  at phase, glide  joint            slide "
        "(steady)   "
        "plain cut\n";
    for (const TransitionFigure& p : report.pairs)
        fmt::format_to(std::back_inserter(out),
                       "{:<12} {:<12} {:6.2f}  {:8.3f} {:4.1f} s   {:8.2f}  {:8.3f} {:4.1f} s  {:<16} {:4.1f} "
                       "({:4.1f}) cm/s {:5.1f} "
                       "{:6.1f}\n",
                       p.from, p.to, p.foot_ratio, p.foot_phase, p.foot_duration_s, p.joint_ratio, p.joint_phase,
                       p.joint_duration_s, p.joint, p.slide_cm_s, p.steady_slide_cm_s, p.cut_foot_ratio,
                       p.cut_joint_ratio);
    const TransitionFigure& worst = report.worst();
    fmt::format_to(std::back_inserter(out), "worst of {} runs: {} to {}, {:.2f} times the two gaits ({} at most)\n",
                   report.runs, worst.from, worst.to, worst.worst(), k_most_transition_ratio);
    return out;
}

std::string transitions_json(const TransitionReport& report) {
    std::string out = fmt::format("{{\"runs\": {}, \"limit\": {}, \"smooth\": {}, \"worst\": {}, \"pairs\": [",
                                  report.runs, k_most_transition_ratio, report.smooth(), pair_json(report.worst()));
    for (std::size_t i = 0; i < report.pairs.size(); ++i)
        fmt::format_to(std::back_inserter(out), "{}\n {}", i > 0 ? "," : "", pair_json(report.pairs[i]));
    return out + "\n]}\n";
}

}  // namespace surefoot
