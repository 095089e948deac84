#include <surefoot/harmonic/series.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace

std::span<float> GaitSeries::rotation(int joint, int axis) const noexcept {
    const std::size_t length = at(1 + 2 * gait_->harmonics);
    return values_.subspan(at(3 * joint + axis) * length, length);
}

std::span<float> GaitSeries::translation(int moving, int axis) const noexcept {
    return rotation(static_cast<int>(gait_->mean.size()) + moving, axis);
}

std::span<float> GaitSeries::foot(std::size_t side, FootPart part, int axis) const noexcept {
    const std::size_t before = 3 * (gait_->mean.size() + gait_->moving.size()) * at(1 + 2 * gait_->harmonics);
    const std::size_t length = at(1 + 2 * gait_->foot_harmonics);
    const std::size_t index = side * k_foot_series + 3 * static_cast<std::size_t>(part) + at(axis);
    return values_.subspan(before + index * length, length);
}

int GaitSeries::moving_index(int joint) const noexcept {
    const auto found = std::find(gait_->moving.begin(), gait_->moving.end(), joint);
    return found == gait_->moving.end() ? -1 : static_cast<int>(found - gait_->moving.begin());
}

float series_at(std::span<const float> series, float phase) noexcept {
    const SinCos first = sin_cos(2 * k_pi * static_cast<double>(phase));
    double c = first.cos, s = first.sin, sum = static_cast<double>(series[0]);
    for (std::size_t i = 1; i + 1 < series.size(); i += 2) {
        sum += c * static_cast<double>(series[i]) + s * static_cast<double>(series[i + 1]);
        const double next = c * first.cos - s * first.sin;
        s = s * first.cos + c * first.sin;
        c = next;
    }
    return static_cast<float>(sum);
}

void scale_waves(std::span<float> series, float factor) noexcept {
    for (std::size_t i = 1; i < series.size(); ++i) series[i] *= factor;
}

void scale_about(std::span<float> series, float phase, float factor) noexcept {
    const float fixed = series_at(series, phase);
    scale_waves(series, factor);
    series[0] = fixed + factor * (series[0] - fixed);
}

void delay(std::span<float> series, float lag) noexcept {
    for (std::size_t i = 1, k = 1; i + 1 < series.size(); i += 2, ++k) {
        const SinCos turn = sin_cos(2 * k_pi * static_cast<double>(k) * static_cast<double>(lag));
        const auto c = static_cast<float>(turn.cos), s = static_cast<float>(turn.sin);
        const float a = series[i], b = series[i + 1];
        series[i] = a * c - b * s;
        series[i + 1] = a * s + b * c;
    }
}

void sharpen(std::span<float> series, float factor) noexcept {
    float power = 1;
    for (std::size_t i = 1; i + 1 < series.size(); i += 2, power *= factor) {
        series[i] *= power;
        series[i + 1] *= power;
    }
}

void add_turn(const GaitSeries& series, int joint, Quat model, Vec3 turn) noexcept {
    const Vec3 own = rotate(conjugate(model), turn);
    series.rotation(joint, 0)[0] += own.x;
    series.rotation(joint, 1)[0] += own.y;
    series.rotation(joint, 2)[0] += own.z;
}

void add_foot_turn(const HarmonicGait& gait, const GaitSeries& series, std::size_t side, Vec3 turn) noexcept {
    const Vec3 own = rotate(conjugate(gait.foot_mean[side]), turn);
    series.foot(side, GaitSeries::FootPart::rotation, 0)[0] += own.x;
    series.foot(side, GaitSeries::FootPart::rotation, 1)[0] += own.y;
    series.foot(side, GaitSeries::FootPart::rotation, 2)[0] += own.z;
}

void scale_steps(const HarmonicGait& gait, const GaitSeries& series, float factor) noexcept {
    const float standing = 0.5f * gait.foot_lift;
    for (std::size_t side = 0; side < 2; ++side) {
        for (const GaitSeries::FootPart part : {GaitSeries::FootPart::heel, GaitSeries::FootPart::ball})
            scale_about(series.foot(side, part, 1), standing, factor);
        for (int axis = 0; axis < 3; ++axis)
            scale_about(series.foot(side, GaitSeries::FootPart::rotation, axis), standing, factor);
    }
}

std::vector<Quat> mean_models(const HarmonicGait& gait) {
    std::vector<Quat> models;
    for (std::size_t j = 0; j < gait.mean.size(); ++j) {
        const int parent = gait.skeleton->parents[j];
        models.push_back(parent == k_no_joint ? gait.mean[j] : normalized(models[at(parent)] * gait.mean[j]));
    }
    return models;
}

}  // namespace surefoot
