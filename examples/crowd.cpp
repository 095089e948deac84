// A thousand characters that share everything but 24 bytes, eight at a time where it pays.

#include "read_pack.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: crowd X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Pack& hero = loaded.pack;
    constexpr std::size_t k_crowd = 1000, k_lanes = surefoot::k_lanes;
    const std::size_t joints = hero.skeleton().rest.size();

    std::vector<surefoot::LocomotionState> states(k_crowd);
    std::vector<surefoot::RootFrame> roots(k_crowd);
    std::vector<surefoot::Transform> locals(k_lanes * joints);   // scratch, for eight
    std::vector<surefoot::Matrix34> matrices(k_crowd * joints);  // what the renderer takes
    const std::size_t floats = surefoot::model_scratch_floats(static_cast<int>(joints));
    auto* scratch = static_cast<float*>(std::aligned_alloc(64, (floats * sizeof(float) + 63) / 64 * 64));

    const auto begin = std::chrono::steady_clock::now();
    constexpr int k_frames = 60;
    for (int frame = 0; frame < k_frames; ++frame)
        for (std::size_t first = 0; first < k_crowd; first += k_lanes) {
            const surefoot::Transform* from[k_lanes];
            surefoot::Matrix34* to[k_lanes];
            for (std::size_t lane = 0; lane < k_lanes; ++lane) {
                const std::size_t i = first + lane;
                const float pace = 0.5f + 2.5f * static_cast<float>(i) / static_cast<float>(k_crowd);
                const surefoot::LocomotionFrame step =
                    surefoot::update(hero.graph(), states[i], {.speed = pace}, 1.0f / 60);
                roots[i] = roots[i] * step.root_delta;
                const std::span<surefoot::Transform> mine = std::span(locals).subspan(lane * joints, joints);
                surefoot::pose(hero.graph(), step, mine);
                from[lane] = mine.data();
                to[lane] = matrices.data() + i * joints;
            }
            surefoot::local_to_model_8(hero.skeleton(), from, to, scratch);
        }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::free(scratch);
    std::printf("%zu characters, %zu bytes each: %.2f us a character and frame\n", k_crowd,
                sizeof(surefoot::LocomotionState), seconds.count() * 1e6 / (k_frames * static_cast<double>(k_crowd)));
    std::printf("the slowest went %.2f m in a second, the fastest %.2f m\n",
                static_cast<double>(roots.front().position.z), static_cast<double>(roots.back().position.z));
    return 0;
}
