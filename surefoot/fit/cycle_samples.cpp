#include <surefoot/base/error.h>
#include <surefoot/clip/sample.h>
#include <surefoot/fit/cycle_samples.h>
#include <surefoot/fit/ridge.h>
#include <surefoot/harmonic/series.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr int k_samples = 128;  // a cycle: five times the fastest wave's two samples

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Adds up rotations on one hemisphere.
class MeanRotation {
  public:
    void add(Quat q) {
        q = aligned(q, sum_);
        sum_ = {sum_.x + q.x, sum_.y + q.y, sum_.z + q.z, sum_.w + q.w};
    }
    Quat mean() const { return normalized(sum_); }

  private:
    Quat sum_{0, 0, 0, 0};
};

/// Fourier sums of evenly spaced samples.
class SeriesWriter {
  public:
    SeriesWriter(std::vector<float>& values, int harmonics, std::size_t samples)
        : values_(values), harmonics_(harmonics), samples_(samples) {
        for (std::size_t i = 0; i < samples; ++i) {
            const double cycles = static_cast<double>(i) / k_samples;
            for (int k = 1; k <= harmonics; ++k) waves_.push_back(sin_cos(2 * k_pi * k * cycles));
        }
    }
    template <typename Sample>  // Vec3 sample(std::size_t)
    void write(const Sample& sample) {
        const std::size_t length = at(1 + 2 * harmonics_);
        std::vector<double> sums(3 * length, 0.0);
        for (std::size_t i = 0; i < samples_; ++i) {
            const Vec3 v = sample(i);
            const float part[3] = {v.x, v.y, v.z};
            for (std::size_t c = 0; c < 3; ++c) {
                double* sum = sums.data() + c * length;
                sum[0] += static_cast<double>(part[c]);
                for (int k = 1; k <= harmonics_; ++k) {
                    const SinCos& wave = waves_[i * at(harmonics_) + at(k - 1)];
                    sum[2 * k - 1] += 2 * wave.cos * static_cast<double>(part[c]);
                    sum[2 * k] += 2 * wave.sin * static_cast<double>(part[c]);
                }
            }
        }
        for (const double sum : sums) values_.push_back(static_cast<float>(sum / static_cast<double>(samples_)));
    }

  private:
    std::vector<float>& values_;
    int harmonics_;
    std::size_t samples_;
    std::vector<SinCos> waves_;
};

GaitRhythm rhythm_of(const PackedClip& clip) {
    GaitRhythm rhythm;
    if (clip.cycles == 0) {  // stands; what its feet do does not depend on any stance
        rhythm.frequency = 1 / clip.duration();
        return rhythm;
    }
    rhythm.velocity = clip.velocity;
    rhythm.turn_rate = clip.turn_rate;
    rhythm.frequency = static_cast<float>(clip.cycles) / clip.duration();
    rhythm.right_strike = 0;
    for (int c = 0; c < clip.cycles; ++c) {
        const float half = phase_time(clip, static_cast<float>(c) + 0.25f).slope;
        const float other = phase_time(clip, static_cast<float>(c) + 0.75f).slope;
        rhythm.right_strike += half / (half + other) / static_cast<float>(clip.cycles);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        rhythm.lift[side] = 0;
        for (const FootStep& step : clip.feet[side].steps)
            rhythm.lift[side] += step.lift / static_cast<float>(clip.cycles);
    }
    return rhythm;
}

FootSample foot_sample(const PackedClip& clip, const HarmonicGait& gait, std::size_t side, int sample) {
    const int cycle = sample / k_samples;
    const float share = static_cast<float>(sample % k_samples) / k_samples, strike = side == 0 ? 0.0f : 0.5f;
    const auto time = [&] {
        if (clip.cycles == 0) return (share + strike - (share + strike >= 1 ? 1.0f : 0.0f)) * clip.duration();
        const float own = foot_series_phase(share, gait.foot_lift, clip.feet[side].steps[at(cycle)].lift);
        return time_at(clip, strike + static_cast<float>(cycle) + own);
    };
    const FootKey key = foot_key_at(clip, static_cast<Side>(side), time());
    const LegPaths::Side& leg = gait.legs.side[side];
    return {key.print.rotation, key.toes, transform_point(key.print, leg.heel), transform_point(key.print, leg.ball)};
}

}  // namespace

PackedClip pack_for_fit(const AnalyzedClip& clip) {
    const float travel = std::fabs(clip.facts.travel);
    PackOptions options;
    options.along_travel = travel < 30 || travel > 150;
    options.legs = &clip.legs;
    PackedClip packed = pack_clip(clip.motion, clip.facts, options);
    if (packed.cycles == 0 && !is_standing(packed))
        throw Error("it is no cycle of steps that alternate between the feet", "clip '" + clip.facts.name + "'",
                    "cut one cycle out of it: surefoot cut, or give the whole take");
    if (!packed.feet[0].known() || !packed.feet[1].known())
        throw Error("its legs are not known", "clip '" + clip.facts.name + "'", "name their joints: --roles");
    return packed;
}

bool is_standing(const PackedClip& clip) {
    constexpr float k_still = 0.02f;  // [m/s] and [rad/s]
    return clip.cycles == 0 && clip.cyclic && length(clip.velocity) < k_still && std::fabs(clip.turn_rate) < k_still;
}

HarmonicGait gait_of_body(const AnalyzedClip& clip, const FitOptions& options) {
    HarmonicGait gait;
    gait.name = clip.facts.name;
    gait.skeleton = clip.motion.skeleton;
    gait.soles = clip.legs;
    std::vector<Transform> standing(at(clip.motion.joint_count()));
    local_to_model(*gait.skeleton, clip.motion.frame(0), standing);
    gait.legs = make_leg_paths(*gait.skeleton, clip.legs, standing);
    gait.harmonics = options.harmonics;
    gait.foot_harmonics = options.foot_harmonics;
    return gait;
}

void fit_mean_angles(const CycleSamples& samples, const HarmonicGait& gait, std::span<float> values) {
    constexpr int k_rounds = 8;
    constexpr float k_exact = 1e-4f;  // [rad] what is off by less counts no more
    const std::size_t count = samples.poses.size(), terms = at(1 + 2 * gait.harmonics);
    std::vector<float> waves(count * terms, 1.0f);
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 1; k <= gait.harmonics; ++k) {
            const SinCos wave = sin_cos(2 * k_pi * k * static_cast<double>(i) / k_samples);
            waves[i * terms + at(2 * k - 1)] = static_cast<float>(wave.cos);
            waves[i * terms + at(2 * k)] = static_cast<float>(wave.sin);
        }
    const GaitSeries series(gait, values);
    for (std::size_t j = 0; j < gait.mean.size(); ++j) {
        const int joint = static_cast<int>(j);
        const auto carries = [&](const Leg& leg) {
            return joint != leg.foot && is_within(*gait.skeleton, leg.foot, joint);
        };
        if (carries(gait.soles.side[0]) || carries(gait.soles.side[1])) continue;
        for (int round = 0; round < k_rounds; ++round) {
            RidgeProblem problem(terms, 3);
            for (std::size_t i = 0; i < count; ++i) {
                const std::span<const float> wave(waves.data() + i * terms, terms);
                const Vec3 wanted = to_rotation_vector(conjugate(gait.mean[j]) * samples.poses[i][j].rotation);
                const auto at_axis = [&](int axis) {
                    const std::span<const float> s = series.rotation(joint, axis);
                    float sum = 0;
                    for (std::size_t t = 0; t < terms; ++t) sum += s[t] * wave[t];
                    return sum;
                };
                const Vec3 got{at_axis(0), at_axis(1), at_axis(2)};
                const float target[3] = {wanted.x, wanted.y, wanted.z};
                problem.add_sample(wave, target, 1 / static_cast<double>(std::max(k_exact, distance(wanted, got))));
            }
            const std::vector<float> solved = problem.solve();  // [term][axis]
            for (int axis = 0; axis < 3; ++axis)
                for (std::size_t t = 0; t < terms; ++t) series.rotation(joint, axis)[t] = solved[3 * t + at(axis)];
        }
    }
}

void round_coefficients(HarmonicGait& gait) {
    constexpr double k_steps = 1e5;
    for (float& c : gait.coefficients)
        c = static_cast<float>(std::floor(static_cast<double>(c) * k_steps + 0.5) / k_steps);
}

float mean_lift(const PackedClip& clip) {
    const GaitRhythm rhythm = rhythm_of(clip);
    return 0.5f * (rhythm.lift[0] + rhythm.lift[1]);
}

CycleSamples sample_cycles(const PackedClip& clip, const HarmonicGait& gait) {
    CycleSamples samples;
    samples.rhythm = rhythm_of(clip);
    for (int i = 0; i < k_samples * std::max(1, clip.cycles); ++i) {
        const float phase = static_cast<float>(i) / k_samples;
        const Leaf leaf{0, clip.cycles > 0 ? time_at(clip, phase) : phase * clip.duration(), 1};
        samples.poses.emplace_back(at(clip.joint_count));
        sample_pose(*gait.skeleton, {&clip, 1}, {&leaf, 1}, samples.poses.back());
        for (std::size_t side = 0; side < 2; ++side) samples.feet[side].push_back(foot_sample(clip, gait, side, i));
    }
    return samples;
}

void set_means(HarmonicGait& gait, std::span<const CycleSamples> all) {
    const std::size_t joints = gait.skeleton->rest.size();
    constexpr float k_moves = 1e-4f;  // [m] from rest
    std::vector<MeanRotation> mean(joints);
    std::array<MeanRotation, 2> foot, toes;
    std::vector<bool> moves(joints);
    for (const CycleSamples& samples : all) {
        for (const std::vector<Transform>& pose : samples.poses)
            for (std::size_t j = 0; j < joints; ++j) {
                mean[j].add(pose[j].rotation);
                if (distance(pose[j].translation, gait.skeleton->rest[j].translation) > k_moves) moves[j] = true;
            }
        for (std::size_t side = 0; side < 2; ++side)
            for (const FootSample& sample : samples.feet[side]) {
                foot[side].add(sample.rotation);
                toes[side].add(sample.toes);
            }
    }
    gait.mean.clear();
    gait.moving.clear();
    for (std::size_t j = 0; j < joints; ++j) {
        gait.mean.push_back(mean[j].mean());
        if (moves[j]) gait.moving.push_back(static_cast<std::int16_t>(j));
    }
    for (std::size_t side = 0; side < 2; ++side) {
        gait.foot_mean[side] = foot[side].mean();
        gait.toes_mean[side] = toes[side].mean();
    }
}

std::vector<float> values_of(const CycleSamples& samples, const HarmonicGait& gait) {
    std::vector<float> values;
    SeriesWriter joints(values, gait.harmonics, samples.poses.size());
    for (std::size_t j = 0; j < gait.mean.size(); ++j)
        joints.write(
            [&](std::size_t i) { return to_rotation_vector(conjugate(gait.mean[j]) * samples.poses[i][j].rotation); });
    for (const std::int16_t joint : gait.moving)
        joints.write([&](std::size_t i) { return samples.poses[i][at(joint)].translation; });
    SeriesWriter feet(values, gait.foot_harmonics, samples.poses.size());
    for (std::size_t side = 0; side < 2; ++side) {
        const std::vector<FootSample>& foot = samples.feet[side];
        feet.write(
            [&](std::size_t i) { return to_rotation_vector(conjugate(gait.foot_mean[side]) * foot[i].rotation); });
        feet.write([&](std::size_t i) { return foot[i].heel; });
        feet.write([&](std::size_t i) { return foot[i].ball; });
        feet.write([&](std::size_t i) { return to_rotation_vector(conjugate(gait.toes_mean[side]) * foot[i].toes); });
    }
    const GaitRhythm& r = samples.rhythm;
    values.insert(values.end(), {r.velocity.x, r.velocity.y, r.velocity.z, r.turn_rate, r.frequency, r.right_strike,
                                 r.lift[0], r.lift[1]});
    return values;
}

}  // namespace surefoot
