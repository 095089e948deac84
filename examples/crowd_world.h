#pragma once
// A thousand characters on hills that share everything but a few hundred bytes: what both crowd examples play, each
// with threads of its own. Far characters are posed in every third frame.

#include <surefoot/crowd/crowd.h>
#include <surefoot/ground/height_field.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <vector>

inline constexpr std::size_t k_crowd = 1000;
inline constexpr int k_frames = 60;
inline constexpr float k_dt = 1.0f / 60;

struct World {
    std::vector<surefoot::LocomotionState> states = std::vector<surefoot::LocomotionState>(k_crowd);
    std::vector<surefoot::LocomotionRequest> wishes = std::vector<surefoot::LocomotionRequest>(k_crowd);
    std::vector<surefoot::RootFrame> roots = std::vector<surefoot::RootFrame>(k_crowd);
    std::vector<surefoot::CrowdFeet> feet = std::vector<surefoot::CrowdFeet>(k_crowd);
    std::vector<std::uint8_t> periods = std::vector<std::uint8_t>(k_crowd, 1);
    surefoot::HeightField hills = surefoot::make_hills();
    std::vector<surefoot::Matrix34> matrices;  // what the renderer takes

    explicit World(const surefoot::LocomotionGraph& graph) : matrices(k_crowd * graph.skeleton->rest.size()) {
        for (std::size_t i = 0; i < k_crowd; ++i) {
            wishes[i].speed = 0.5f + 2.5f * static_cast<float>(i) / static_cast<float>(k_crowd);
            if (i >= k_crowd / 2) periods[i] = 3;
        }
    }

    /// Plays all frames with `evaluate_all(crowd)`. Returns microseconds a character and frame.
    template <class EvaluateAll>
    double play(EvaluateAll&& evaluate_all) {
        const auto begin = std::chrono::steady_clock::now();
        for (std::uint32_t frame = 0; frame < k_frames; ++frame) {
            surefoot::Crowd crowd{states, wishes, roots};
            crowd.periods = periods;
            crowd.frame = frame;
            crowd.matrices = matrices;
            crowd.ground = &hills;
            crowd.feet = feet;
            evaluate_all(crowd);
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        return seconds.count() * 1e6 / (k_frames * static_cast<double>(k_crowd));
    }
};

/// Whoever shares the work, the same comes out. Returns the program's exit code.
inline int compare(const World& alone, double alone_us, const World& shared, double shared_us, std::size_t threads) {
    std::printf("%zu characters, %zu bytes each: %.2f us a character and frame, %.2f us on %zu threads\n", k_crowd,
                sizeof(surefoot::LocomotionState) + sizeof(surefoot::CrowdFeet), alone_us, shared_us, threads);
    std::printf("the slowest went %.2f m in a second, the fastest %.2f m\n",
                static_cast<double>(alone.roots.front().position.z),
                static_cast<double>(alone.roots.back().position.z));
    const std::size_t bytes = alone.matrices.size() * sizeof(surefoot::Matrix34);
    if (std::memcmp(alone.matrices.data(), shared.matrices.data(), bytes) == 0) return 0;
    return std::fprintf(stderr, "threads changed what came out\n"), 1;
}
