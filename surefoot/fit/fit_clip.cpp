#include <surefoot/clip/sample.h>
#include <surefoot/fit/cycle_samples.h>
#include <surefoot/host/parallel.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Sums of how far a gait is from a clip, joint by joint.
class ErrorSums {
  public:
    explicit ErrorSums(const HarmonicGait& gait) : gait_(gait), degrees_(gait.mean.size()), moves_(gait.mean.size()) {}

    void add(std::span<const Transform> wanted, std::span<const Transform> got) {
        constexpr float k_holds_still = 0.1f;  // [deg] from the mean
        const std::size_t joints = wanted.size();
        for (std::size_t j = 0; j < joints; ++j) {
            degrees_[j] += angle(wanted[j].rotation, got[j].rotation);
            moves_[j] = moves_[j] || angle(wanted[j].rotation, gait_.mean[j]) > static_cast<double>(k_holds_still);
        }
        std::vector<Transform> a(joints), b(joints);
        local_to_model(*gait_.skeleton, wanted, a);
        local_to_model(*gait_.skeleton, got, b);
        for (const Leg& leg : gait_.soles.side) {
            const float off = 100 * distance(a[at(leg.foot)].translation, b[at(leg.foot)].translation);
            ankles_ += static_cast<double>(off);
            result_.ankle_max_cm = std::max(result_.ankle_max_cm, off);
        }
        ++frames_;
    }

    FitError result() {
        result_.harmonics = gait_.harmonics;
        double sum = 0, all = 0;
        int moving = 0;
        for (std::size_t j = 0; j < degrees_.size(); ++j) {
            const double mean = degrees_[j] / frames_;
            all += mean;
            if (!moves_[j]) continue;
            sum += mean;
            ++moving;
            if (static_cast<float>(mean) <= result_.worst_joint_deg) continue;
            result_.worst_joint_deg = static_cast<float>(mean);
            result_.worst_joint = gait_.skeleton->names[j];
        }
        result_.joint_deg = moving > 0 ? static_cast<float>(sum / moving) : 0.0f;
        result_.all_joints_deg = static_cast<float>(all / static_cast<double>(degrees_.size()));
        result_.ankle_cm = static_cast<float>(ankles_ / (2.0 * frames_));
        return result_;
    }

  private:
    static double angle(Quat a, Quat b) {
        return static_cast<double>(rotation_angle(conjugate(a) * b) * k_degrees_per_radian);
    }
    const HarmonicGait& gait_;
    std::vector<double> degrees_;
    std::vector<bool> moves_;
    FitError result_;
    double ankles_ = 0;
    int frames_ = 0;
};

}  // namespace

HarmonicGait fit_clip(const AnalyzedClip& clip, const FitOptions& options) {
    const PackedClip packed = pack_for_fit(clip);
    HarmonicGait gait = gait_of_body(clip, options);
    gait.foot_lift = mean_lift(packed);
    const CycleSamples samples = sample_cycles(packed, gait);
    set_means(gait, {&samples, 1});
    gait.coefficients = values_of(samples, gait);
    fit_mean_angles(samples, gait, gait.coefficients);
    round_coefficients(gait);
    gait.cycles = {{packed.velocity.z, packed.turn_rate * k_degrees_per_radian}};
    return gait;
}

FitError measure_fit(const AnalyzedClip& clip, const HarmonicGait& gait, std::span<const float> values) {
    const PackedClip packed = pack_for_fit(clip);
    const std::size_t joints = gait.mean.size();
    std::vector<Transform> wanted(joints), got(joints);
    ErrorSums sums(gait);
    for (int f = 0; f + 1 < packed.frame_count; ++f) {  // the last is the first again
        const float time = static_cast<float>(f) / packed.fps;
        const Leaf leaf{0, time, 1};
        sample_pose(*gait.skeleton, {&packed, 1}, {&leaf, 1}, wanted);
        const float phase = packed.cycles > 0 ? phase_at(packed, time) : time / packed.duration();
        pose(gait, values, phase, got, {.feet = false});
        sums.add(wanted, got);
    }
    return sums.result();
}

std::vector<FitError> errors_by_harmonics(const AnalyzedClip& clip, int most) {
    std::vector<FitError> errors(at(most));
    parallel_for(errors.size(), [&](std::size_t i) {
        FitOptions options;
        options.harmonics = static_cast<int>(i) + 1;
        const HarmonicGait gait = fit_clip(clip, options);
        errors[i] = measure_fit(clip, gait, gait.coefficients);
    });
    return errors;
}

}  // namespace surefoot
