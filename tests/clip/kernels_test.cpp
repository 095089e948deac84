#include <surefoot/clip/kernels.h>

#include <surefoot/base/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using Builds = KernelBuilds<ClipKernels>;

TEST(ClipKernels, every_build_blends_to_the_scalar_twins_bits) {
    Random random(1);
    for (const int joints : {1, 8, 23, 67}) {
        const std::size_t blocks = static_cast<std::size_t>((joints + 7) / 8), frame = blocks * 32;
        std::vector<std::int16_t> frames(frame * 8);
        for (std::int16_t& x : frames) x = static_cast<std::int16_t>(static_cast<int>(random.below(65535)) - 32767);
        std::vector<std::uint8_t> turning(blocks, 0);
        turning[blocks / 2] = 1;
        std::vector<KeyPair> pairs;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto share = static_cast<std::int32_t>(random.below(k_whole_share + 1));
            pairs.push_back({&frames[2 * i * frame], &frames[(2 * i + 1) * frame], i == 1 ? turning.data() : nullptr,
                             k_whole_share - share, share, random.unit() * (i == 3 ? -0.1f : 1.0f) / k_whole_share});
        }
        std::vector<float> wanted(static_cast<std::size_t>(joints) * 7, -1.0f);
        Builds::scalar.blend_rotations(pairs.data(), 4, nullptr, joints, wanted.data(), 7);
        for (const ClipKernels* kernels : Builds::here()) {
            std::vector<float> got(wanted.size(), -1.0f);
            kernels->blend_rotations(pairs.data(), 4, nullptr, joints, got.data(), 7);
            EXPECT_EQ(std::memcmp(got.data(), wanted.data(), got.size() * sizeof(float)), 0)
                << kernels->name << ", " << joints << " joints";
        }
    }
}

TEST(ClipKernels, every_build_adds_turns_and_blends_them_to_the_scalar_twins_bits) {
    Random random(5);
    for (const int joints : {1, 8, 23, 67}) {
        const std::size_t blocks = static_cast<std::size_t>((joints + 7) / 8);
        std::vector<std::int16_t> middle(blocks * 32);
        for (std::int16_t& x : middle) x = static_cast<std::int16_t>(static_cast<int>(random.below(65535)) - 32767);
        std::vector<float> turns(blocks * 24), sums(blocks * 32);
        for (float& x : turns) x = random.between(-0.7f, 0.7f);  // some longer than one
        for (float& x : sums) x = random.between(-1, 1);
        const KeyPair pair{middle.data(), middle.data(), nullptr, 0, k_whole_share, 0.4f / k_whole_share};
        const auto blended = [&](const ClipKernels& kernels) {
            std::vector<float> added = sums, out(static_cast<std::size_t>(joints) * 7, -1.0f);
            kernels.add_turns(turns.data(), middle.data(), joints, 0.6f, added.data());
            kernels.blend_rotations(&pair, 1, added.data(), joints, out.data(), 7);
            return out;
        };
        const std::vector<float> wanted = blended(Builds::scalar);
        for (const ClipKernels* kernels : Builds::here()) {
            const std::vector<float> got = blended(*kernels);
            EXPECT_EQ(std::memcmp(got.data(), wanted.data(), got.size() * sizeof(float)), 0)
                << kernels->name << ", " << joints << " joints";
        }
    }
}

// The widest products there are: 16-bit integers and shares at their ends must not overflow on any build.
TEST(ClipKernels, keys_at_the_ends_of_their_range_blend_without_overflow) {
    const std::vector<std::int16_t> low(32, INT16_MIN), high(32, INT16_MAX);
    for (const std::int32_t share : {0, 1, k_whole_share / 2, k_whole_share})
        for (const auto* keys : {&low, &high}) {
            const KeyPair pair{keys->data(), keys->data(), nullptr, k_whole_share - share, share, 1.0f / k_whole_share};
            float wanted[8 * 7] = {};
            Builds::scalar.blend_rotations(&pair, 1, nullptr, 8, wanted, 7);
            EXPECT_EQ(wanted[0], keys == &low ? -0.5f : 0.5f);
            for (const ClipKernels* kernels : Builds::here()) {
                float got[8 * 7] = {};
                kernels->blend_rotations(&pair, 1, nullptr, 8, got, 7);
                EXPECT_EQ(std::memcmp(got, wanted, sizeof got), 0) << kernels->name << ", share " << share;
            }
        }
}

// Against a blend in double precision from the same keys: shares of 15 bits cost less than the keys' own 16.
TEST(ClipKernels, shares_of_15_bits_cost_less_than_keys_of_16) {
    Random random(3);
    double worst = 0;
    for (int round = 0; round < 200; ++round) {
        std::int16_t keys[2][32];
        double q[2][4], norm[2] = {0, 0};
        for (int k = 0; k < 4; ++k) {  // up to some 40 degrees between the keys
            q[0][k] = static_cast<double>(random.between(-1, 1));
            q[1][k] = q[0][k] + 0.25 * static_cast<double>(random.between(-1, 1));
        }
        for (int i = 0; i < 2; ++i)
            for (const double x : q[i]) norm[i] += x * x;
        for (int i = 0; i < 2; ++i)
            for (int n = 0; n < 32; ++n)
                keys[i][n] = static_cast<std::int16_t>(std::lround(q[i][n / 8] / std::sqrt(norm[i]) * 32767));
        const float wanted_share = random.unit();
        const auto share = static_cast<std::int32_t>(wanted_share * k_whole_share + 0.5f);
        const KeyPair pair{keys[0], keys[1], nullptr, k_whole_share - share, share, 1.0f / k_whole_share};
        float got[8 * 7];
        Builds::fastest().blend_rotations(&pair, 1, nullptr, 8, got, 7);
        double wanted[4], square = 0;
        for (int k = 0; k < 4; ++k) {
            wanted[k] = keys[0][8 * k] + static_cast<double>(wanted_share) * (keys[1][8 * k] - keys[0][8 * k]);
            square += wanted[k] * wanted[k];
        }
        for (int k = 0; k < 4; ++k)
            worst = std::max(worst, std::abs(static_cast<double>(got[k]) - wanted[k] / std::sqrt(square)));
    }
    EXPECT_LT(worst, 0.5 / 32767);
    EXPECT_GT(worst, 0);
}

TEST(ClipKernels, every_build_makes_the_scalar_twins_matrices) {
    Random random(2);
    constexpr int k_joints = 31;
    std::vector<std::int16_t> parents{-1};
    for (int j = 1; j < k_joints; ++j)
        parents.push_back(static_cast<std::int16_t>(random.below(static_cast<std::uint32_t>(j))));
    std::vector<float> locals(8 * k_joints * 7), scratch(k_joints * 56);
    for (float& x : locals) x = random.between(-0.7f, 0.7f);
    const auto run = [&](const ClipKernels& kernels) {
        std::vector<float> models(8 * k_joints * 12);
        const float* in[8];
        float* out[8];
        for (int c = 0; c < 8; ++c) {
            in[c] = &locals[static_cast<std::size_t>(c * k_joints * 7)];
            out[c] = &models[static_cast<std::size_t>(c * k_joints * 12)];
        }
        kernels.local_to_model(parents.data(), k_joints, in, out, scratch.data());
        return models;
    };
    const std::vector<float> wanted = run(Builds::scalar);
    for (const ClipKernels* kernels : Builds::here())
        EXPECT_EQ(std::memcmp(run(*kernels).data(), wanted.data(), wanted.size() * sizeof(float)), 0) << kernels->name;
}

TEST(ClipKernels, the_builds_are_those_of_this_machines_level_and_the_highest_is_chosen) {
    std::vector<std::string> wanted{"baseline"}, got;
#if defined(SUREFOOT_HAS_KERNELS_X86_64)
    if (processor_level() >= ProcessorLevel::v3) wanted.emplace_back("x86-64-v3");
    if (processor_level() >= ProcessorLevel::v4) wanted.emplace_back("x86-64-v4");
#endif
    for (const ClipKernels* kernels : Builds::here()) got.emplace_back(kernels->name);
    EXPECT_EQ(got, wanted);
    EXPECT_EQ(Builds::fastest().name, wanted.back());
}

}  // namespace
}  // namespace surefoot
