// Frames of the synthetic hero, without a benchmark library: as a WebAssembly module whose `play` JavaScript calls, and
// as a program that times the same call. scripts/bench_wasm.mjs runs both in turns.

#include <surefoot/crowd/crowd.h>

#include <ctime>
#include <memory>

#include "../stage.h"

namespace surefoot::bench {
namespace {

struct Played {
    LocomotionGraph graph = make_graph();
    std::vector<LocomotionState> states;
    std::vector<LocomotionRequest> wishes;
    std::vector<RootFrame> roots;
    std::vector<Matrix34> matrices;
    CrowdScratch scratch{graph};
    Crowd crowd;

    explicit Played(std::size_t count)
        : states(count), wishes(count), roots(count), matrices(count * k_joints), crowd{states, wishes, roots} {
        for (std::size_t c = 0; c < count; ++c) states[c].phase = 0.01f * static_cast<float>(c % 97);
        crowd.matrices = matrices;
    }
    /// Update, pose and matrices of everybody.
    void frame() {
        ++crowd.frame;
        for (std::size_t c = 0; c < wishes.size(); ++c) wishes[c] = wish(c, static_cast<int>(crowd.frame));
        evaluate(graph, crowd, {0, wishes.size()}, 1.0f / 60, scratch);
    }
};

/// Frames of one crowd; it is made anew where the number of characters changes. A number of what was written, which
/// keeps the work from being left out and is the same in every build.
float play(int characters, int frames) {
    static std::unique_ptr<Played> played;
    const auto count = static_cast<std::size_t>(characters);
    if (!played || played->states.size() != count) played = std::make_unique<Played>(count);
    for (int f = 0; f < frames; ++f) played->frame();
    float sum = 0;
    for (const Matrix34& m : played->matrices) sum += m.m[3] + m.m[5];
    return sum;
}

}  // namespace
}  // namespace surefoot::bench

#ifdef __EMSCRIPTEN__
extern "C" __attribute__((export_name("play"))) float play(int characters, int frames) {
    return surefoot::bench::play(characters, frames);
}
#else
#include <surefoot/clip/sample.h>

#include <cstdio>
#include <cstdlib>

/// CHARACTERS FRAMES → a line of JSON: [us] of processor time a character and frame, after as many to warm up.
int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const int characters = std::atoi(argv[1]), frames = std::atoi(argv[2]);
    if (characters < 1 || frames < 1) return 2;
    const float warm = surefoot::bench::play(characters, frames);
    const std::clock_t began = std::clock();
    const float sum = surefoot::bench::play(characters, frames);
    const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    std::printf("{\"kernels\": \"%s\", \"us\": %.4f, \"warm\": %.9g, \"sum\": %.9g}\n", surefoot::kernels_name(),
                seconds * 1e6 / characters / frames, static_cast<double>(warm), static_cast<double>(sum));
}
#endif
