#include <surefoot/harmonic/harmonic_lanes.h>
#include <surefoot/harmonic/kernels.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

static_assert(sizeof(Transform) == 7 * sizeof(float), "kernels see a transform as qx qy qz qw tx ty tz");

std::size_t size(int i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace

HarmonicLanes::HarmonicLanes(const HarmonicGait& gait, std::span<const std::uint8_t> limb)
    : gait_(&gait),
      kernels_(&KernelBuilds<HarmonicKernels>::fastest()),
      length_(1 + 2 * gait.harmonics),
      foot_length_(1 + 2 * gait.foot_harmonics) {
    std::array<std::vector<std::int16_t>, 8> by_column;
    for (std::size_t j = 0; j < gait.mean.size(); ++j)
        by_column[limb.empty() ? 0 : limb[j]].push_back(static_cast<std::int16_t>(j));
    for (std::uint8_t column = 0; column < 8; ++column)
        for (std::span<const std::int16_t> rest = by_column[column]; !rest.empty();) {
            const std::size_t some = std::min<std::size_t>(rest.size(), 8);
            add_block(rest.first(some), column);
            rest = rest.subspan(some);
        }
    for (const std::int16_t joint : gait.moving) {
        moving_.push_back(count_);
        moving_column_.push_back(limb.empty() ? std::uint8_t{0} : limb[static_cast<std::size_t>(joint)]);
        count_ += 8 * size(length_);
    }
    for (std::size_t& foot : feet_) {
        foot = count_;
        count_ += 2 * 8 * size(foot_length_);
    }
    lay_out();
    const std::array<float, 8> middle{0.5f * gait.foot_lift};
    waves_at(middle, middle_);
}

void HarmonicLanes::add_block(std::span<const std::int16_t> joints, std::uint8_t column) {
    Block block;
    block.column = column;
    block.at = count_;
    block.joint.fill(-1);
    for (std::size_t lane = 0; lane < 8; ++lane) {
        Quat mean;
        if (lane < joints.size()) {
            block.joint[lane] = joints[lane];
            mean = gait_->mean[static_cast<std::size_t>(joints[lane])];
        }
        block.mean[lane] = mean.x, block.mean[8 + lane] = mean.y;
        block.mean[16 + lane] = mean.z, block.mean[24 + lane] = mean.w;
    }
    blocks_.push_back(block);
    count_ += 3 * 8 * size(length_);
}

/// Puts each series of the gait into its lane.
void HarmonicLanes::lay_out() {
    const HarmonicGait& gait = *gait_;
    const std::size_t all = size(surefoot::value_count(gait)), terms = size(gait.basis.terms());
    coefficients_.assign(terms * count_, 0.0f);
    const auto put = [&](std::size_t from, int length, std::size_t block, std::size_t lane) {
        for (std::size_t t = 0; t < terms; ++t)
            for (std::size_t i = 0; i < size(length); ++i)
                coefficients_[t * count_ + block + i * 8 + lane] = gait.coefficients[t * all + from + i];
    };
    const std::size_t length = size(length_), foot_length = size(foot_length_);
    for (const Block& block : blocks_)
        for (std::size_t lane = 0; lane < 8; ++lane)
            for (std::size_t axis = 0; axis < 3 && block.joint[lane] >= 0; ++axis)
                put((3 * size(block.joint[lane]) + axis) * length, length_, block.at + axis * 8 * length, lane);
    for (std::size_t m = 0; m < moving_.size(); ++m)
        for (std::size_t axis = 0; axis < 3; ++axis)
            put((3 * (gait.mean.size() + m) + axis) * length, length_, moving_[m], axis);
    const std::size_t feet = 3 * (gait.mean.size() + gait.moving.size()) * length;
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t s = 0; s < k_foot_series; ++s)
            put(feet + (side * k_foot_series + s) * foot_length, foot_length_, feet_[side] + s / 8 * 8 * foot_length,
                s % 8);
}

void HarmonicLanes::values_at(float speed, float turn_deg, std::span<float> values) const noexcept {
    std::array<float, k_most_basis_terms> weights;
    const GaitBasis& basis = gait_->basis;
    term_weights(basis, speed, turn_deg, weights);
    // Far from the speeds at which walking goes over into running one of them weighs nothing.
    const float running = share_of_running(basis, speed);
    const int of_mode = basis.terms_of_mode(), first = running == 1 && basis.modes == 2 ? of_mode : 0;
    const int terms = running == 0 || running == 1 ? of_mode : basis.terms();
    kernels_->weigh(coefficients_.data() + size(first) * count_, weights.data() + first, terms, count_, values.data());
}

void HarmonicLanes::waves_at(std::span<const float, 8> phases, Waves& waves) const noexcept {
    kernels_->waves(phases.data(), std::max(gait_->harmonics, gait_->foot_harmonics), waves.data());
}

void HarmonicLanes::joint_pose(std::span<const float> values, const Waves& waves,
                               std::span<Transform> locals) const noexcept {
    float* out = &locals[0].rotation.x;
    for (const Block& block : blocks_)
        kernels_->rotate_joints(values.data() + block.at, waves.data() + block.column, 8, length_, block.mean.data(),
                                block.joint.data(), out);
    for (std::size_t j = 0; j < locals.size(); ++j) locals[j].translation = gait_->skeleton->rest[j].translation;
    for (std::size_t m = 0; m < moving_.size(); ++m) {
        std::array<float, 8> sum;
        kernels_->sum_series(values.data() + moving_[m], waves.data() + moving_column_[m], 8, length_, sum.data());
        locals[static_cast<std::size_t>(gait_->moving[m])].translation = {sum[0], sum[1], sum[2]};
    }
}

FootPrint HarmonicLanes::print_of(std::span<const float> values, const float* wave, std::size_t side) const noexcept {
    std::array<float, 16> sum;
    const float* numbers = values.data() + feet_[side];
    kernels_->sum_series(numbers, wave, 8, foot_length_, sum.data());
    kernels_->sum_series(numbers + 8 * foot_length_, wave, 8, foot_length_, sum.data() + 8);
    return {gait_->foot_mean[side] * from_rotation_vector({sum[0], sum[1], sum[2]}),
            {sum[3], sum[4], sum[5]},
            {sum[6], sum[7], sum[8]},
            normalized(gait_->toes_mean[side] * from_rotation_vector({sum[9], sum[10], sum[11]}))};
}

FootPrint HarmonicLanes::foot_print(std::span<const float> values, const Waves& waves, std::size_t side,
                                    std::size_t column) const noexcept {
    return print_of(values, waves.data() + column, side);
}

FootPrint HarmonicLanes::middle_print(std::span<const float> values, std::size_t side) const noexcept {
    return print_of(values, middle_.data(), side);
}

void HarmonicLanes::use_kernels(const HarmonicKernels& kernels) noexcept { kernels_ = &kernels; }

}  // namespace surefoot
