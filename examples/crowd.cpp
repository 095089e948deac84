// A thousand characters on hills that share everything but 116 bytes, on all cores: the library owns no threads, the
// host's own take ranges of the crowd. Far characters are posed in every third frame.

#include "read_pack.h"

#include <surefoot/crowd/crowd.h>
#include <surefoot/ground/height_field.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

namespace {

constexpr std::size_t k_crowd = 1000;
constexpr int k_frames = 60;

struct World {
    std::vector<surefoot::LocomotionState> states = std::vector<surefoot::LocomotionState>(k_crowd);
    std::vector<surefoot::LocomotionRequest> wishes = std::vector<surefoot::LocomotionRequest>(k_crowd);
    std::vector<surefoot::RootFrame> roots = std::vector<surefoot::RootFrame>(k_crowd);
    std::vector<surefoot::CrowdFeet> feet = std::vector<surefoot::CrowdFeet>(k_crowd);
    surefoot::HeightField hills = surefoot::make_hills();
    std::vector<std::uint8_t> periods = std::vector<std::uint8_t>(k_crowd, 1);
    std::vector<surefoot::Matrix34> matrices;  // what the renderer takes

    explicit World(std::size_t joints) : matrices(k_crowd * joints) {
        for (std::size_t i = 0; i < k_crowd; ++i) {
            wishes[i].speed = 0.5f + 2.5f * static_cast<float>(i) / static_cast<float>(k_crowd);
            if (i >= k_crowd / 2) periods[i] = 3;
        }
    }
};

/// Microseconds a character and frame.
double run(const surefoot::LocomotionGraph& graph, World& world, std::size_t threads) {
    std::vector<surefoot::CrowdScratch> scratch(threads, surefoot::CrowdScratch(graph));
    const auto begin = std::chrono::steady_clock::now();
    for (std::uint32_t frame = 0; frame < k_frames; ++frame) {
        surefoot::Crowd crowd{world.states, world.wishes, world.roots};
        crowd.periods = world.periods;
        crowd.frame = frame;
        crowd.matrices = world.matrices;
        crowd.ground = &world.hills;
        crowd.feet = world.feet;
        std::vector<std::thread> team;  // a game keeps its threads and hands them jobs
        for (std::size_t t = 0; t < threads; ++t)
            team.emplace_back([&, t] {
                const std::size_t first = k_crowd * t / threads, end = k_crowd * (t + 1) / threads;
                surefoot::evaluate(graph, crowd, {first, end - first}, 1.0f / 60, scratch[t]);
            });
        for (std::thread& one : team) one.join();
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    return seconds.count() * 1e6 / (k_frames * static_cast<double>(k_crowd));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: crowd X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Pack& hero = loaded.pack;
    World alone(hero.skeleton().rest.size()), shared(hero.skeleton().rest.size());
    const std::size_t threads = std::max(2u, std::thread::hardware_concurrency());
    std::printf("%zu characters, %zu bytes each: %.2f us a character and frame", k_crowd,
                sizeof(surefoot::LocomotionState) + sizeof(surefoot::CrowdFeet), run(hero.graph(), alone, 1));
    std::printf(", %.2f us on %zu threads\n", run(hero.graph(), shared, threads), threads);
    std::printf("the slowest went %.2f m in a second, the fastest %.2f m\n",
                static_cast<double>(alone.roots.front().position.z),
                static_cast<double>(alone.roots.back().position.z));
    const std::size_t bytes = alone.matrices.size() * sizeof(surefoot::Matrix34);
    if (std::memcmp(alone.matrices.data(), shared.matrices.data(), bytes) != 0)
        return std::fprintf(stderr, "threads changed what came out\n"), 1;
    return 0;
}
