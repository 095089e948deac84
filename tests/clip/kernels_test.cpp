#include <surefoot/clip/kernels.h>

#include <surefoot/base/random.h>

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace surefoot {
namespace {

/// Every build of the kernels that this machine can run.
std::vector<const ClipKernels*> builds() {
    std::vector<const ClipKernels*> list{&k_baseline_kernels};
#if defined(SUREFOOT_HAS_KERNELS_V3)
    if (__builtin_cpu_supports("avx2")) list.push_back(&k_v3_kernels);
#endif
    return list;
}

TEST(ClipKernels, every_build_blends_to_the_scalar_twins_bits) {
    Random random(1);
    for (const int joints : {1, 8, 23, 67}) {
        const std::size_t blocks = static_cast<std::size_t>((joints + 7) / 8), frame = blocks * 32;
        std::vector<std::int16_t> frames(frame * 8);
        for (std::int16_t& x : frames) x = static_cast<std::int16_t>(static_cast<int>(random.below(65535)) - 32767);
        std::vector<std::uint8_t> turning(blocks, 0);
        turning[blocks / 2] = 1;
        std::vector<KeyPair> pairs;
        for (std::size_t i = 0; i < 4; ++i)
            pairs.push_back({&frames[2 * i * frame], &frames[(2 * i + 1) * frame], i == 1 ? turning.data() : nullptr,
                             random.unit(), random.unit()});
        std::vector<float> wanted(static_cast<std::size_t>(joints) * 7, -1.0f);
        k_scalar_kernels.blend_rotations(pairs.data(), 4, joints, wanted.data(), 7);
        for (const ClipKernels* kernels : builds()) {
            std::vector<float> got(wanted.size(), -1.0f);
            kernels->blend_rotations(pairs.data(), 4, joints, got.data(), 7);
            EXPECT_EQ(std::memcmp(got.data(), wanted.data(), got.size() * sizeof(float)), 0)
                << kernels->name << ", " << joints << " joints";
        }
    }
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
    const std::vector<float> wanted = run(k_scalar_kernels);
    for (const ClipKernels* kernels : builds())
        EXPECT_EQ(std::memcmp(run(*kernels).data(), wanted.data(), wanted.size() * sizeof(float)), 0) << kernels->name;
}

TEST(ClipKernels, the_chosen_build_runs_here) {
    const auto list = builds();
    EXPECT_EQ(&clip_kernels(), list.back());
}

}  // namespace
}  // namespace surefoot
