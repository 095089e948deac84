// The same crowd with oneTBB, as many an engine's job system has it: pieces of the crowd are handed to whichever thread
// is free, and each thread has a scratch of its own.

#include "crowd_world.h"
#include "read_pack.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: crowd_tbb X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::LocomotionGraph& graph = loaded.pack.graph();
    tbb::enumerable_thread_specific<surefoot::CrowdScratch> scratch([&] { return surefoot::CrowdScratch(graph); });
    World alone(graph), shared(graph);
    const double alone_us = alone.play([&](const surefoot::Crowd& crowd) {
        surefoot::evaluate(graph, crowd, {0, k_crowd}, k_dt, scratch.local());
    });
    // Small enough that nobody waits long for the last piece; a multiple of eight, so that lanes are full.
    constexpr std::size_t k_piece = 64, k_pieces = (k_crowd + k_piece - 1) / k_piece;
    const double shared_us = shared.play([&](const surefoot::Crowd& crowd) {
        tbb::parallel_for(std::size_t{0}, k_pieces, [&](std::size_t piece) {
            const std::size_t first = piece * k_piece, count = std::min(k_piece, k_crowd - first);
            surefoot::evaluate(graph, crowd, {first, count}, k_dt, scratch.local());
        });
    });
    return compare(alone, alone_us, shared, shared_us,
                   static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
}
