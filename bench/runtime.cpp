// Speed of the runtime, per character. `us_per_character` is the figure to compare; `calibrate` tells how fast the
// machine is today.

#include <benchmark/benchmark.h>

#include <surefoot/clip/sample.h>
#include <surefoot/crowd/crowd.h>

#include <algorithm>

#include "stage.h"

namespace surefoot::bench {
namespace {

const LocomotionGraph& graph() {
    static const LocomotionGraph made = make_graph();
    return made;
}

/// Microseconds a character: the inverse of a rate of millions of characters a second.
void per_character(benchmark::State& state, double characters = 1) {
    state.counters["us_per_character"] = benchmark::Counter(
        characters * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Leaves at times that do not repeat, as in play; `random` seeks anywhere, else frames follow one another.
std::vector<Leaf> leaves_at(int count, int step, bool random) {
    std::vector<Leaf> leaves;
    for (int i = 0; i < count; ++i) {
        const int frame = random ? step * 37 % 60 : step % 60;
        leaves.push_back({i, (static_cast<float>(frame) + 0.3f) / 60, 1.0f / static_cast<float>(i + 2)});
    }
    return leaves;
}

void sample_blend(benchmark::State& state, bool scalar, bool random) {
    std::vector<Transform> locals(k_joints);
    std::vector<std::vector<Leaf>> plays;
    for (int step = 0; step < 240; ++step) plays.push_back(leaves_at(static_cast<int>(state.range(0)), step, random));
    std::size_t at = 0;
    for (auto _ : state) {
        const auto& leaves = plays[at];
        at = at + 1 < plays.size() ? at + 1 : 0;
        if (scalar)
            sample_pose_scalar(*graph().skeleton, graph().clips, leaves, locals);
        else
            sample_pose(*graph().skeleton, graph().clips, leaves, locals);
        benchmark::DoNotOptimize(locals.data());
        benchmark::ClobberMemory();
    }
    per_character(state);
}
BENCHMARK_CAPTURE(sample_blend, vector, false, false)
    ->ArgName("clips")
    ->Arg(1)
    ->Arg(2)
    ->Arg(3)
    ->Arg(6)
    ->Arg(9)
    ->Arg(12);
BENCHMARK_CAPTURE(sample_blend, vector_random_access, false, true)->ArgName("clips")->Arg(3);
BENCHMARK_CAPTURE(sample_blend, scalar, true, false)->ArgName("clips")->Arg(3);

void local_to_model_one(benchmark::State& state) {
    std::vector<Transform> locals = graph().skeleton->rest, models(k_joints);
    std::vector<Matrix34> matrices(k_joints);
    for (auto _ : state) {
        local_to_model(*graph().skeleton, locals, models);
        std::transform(models.begin(), models.end(), matrices.begin(), to_matrix);
        benchmark::DoNotOptimize(matrices.data());
        benchmark::ClobberMemory();
    }
    per_character(state);
}
BENCHMARK(local_to_model_one);

void local_to_model_eight(benchmark::State& state, bool scalar) {
    std::vector<Transform> locals[k_lanes];
    std::vector<Matrix34> models[k_lanes];
    std::vector<float> scratch(model_scratch_floats(k_joints));
    const Transform* in[k_lanes];
    Matrix34* out[k_lanes];
    for (int c = 0; c < k_lanes; ++c) {
        locals[c] = graph().skeleton->rest;
        models[c].resize(k_joints);
        in[c] = locals[c].data();
        out[c] = models[c].data();
    }
    for (auto _ : state) {
        if (scalar)
            local_to_model_8_scalar(*graph().skeleton, in, out, scratch.data());
        else
            local_to_model_8(*graph().skeleton, in, out, scratch.data());
        benchmark::ClobberMemory();
    }
    per_character(state, k_lanes);
}
BENCHMARK_CAPTURE(local_to_model_eight, vector, false);
BENCHMARK_CAPTURE(local_to_model_eight, scalar, true);

void update_of(benchmark::State& state, const LocomotionGraph& graph) {
    LocomotionState character;
    std::vector<LocomotionRequest> wishes;
    for (int f = 0; f < 1024; ++f) wishes.push_back(wish(1, f));
    std::size_t at = 0;
    for (auto _ : state) {
        LocomotionFrame frame = update(graph, character, wishes[at], 1.0f / 60);
        at = (at + 1) % wishes.size();
        benchmark::DoNotOptimize(frame);
    }
    per_character(state);
}
void update_only(benchmark::State& state) { update_of(state, graph()); }
BENCHMARK(update_only);
void update_by_dimensions(benchmark::State& state) {
    update_of(state, make_graph(k_joints, static_cast<int>(state.range(0))));
}
BENCHMARK(update_by_dimensions)->ArgName("dimensions")->Arg(2)->Arg(3)->Arg(4);

/// Update, pose and 3x4 matrices of a whole crowd, written out; this character's graph knows no legs, so its feet are
/// neither blended as feet nor placed.
void frames_of(benchmark::State& state, const LocomotionGraph& graph, std::size_t count) {
    std::vector<LocomotionState> characters(count);
    for (std::size_t c = 0; c < count; ++c) characters[c].phase = 0.01f * static_cast<float>(c % 97);
    std::vector<LocomotionRequest> wishes(count);
    std::vector<RootFrame> roots(count);
    std::vector<Matrix34> matrices(count * graph.skeleton->rest.size());
    CrowdScratch scratch(graph);
    Crowd crowd{characters, wishes, roots};
    crowd.matrices = matrices;
    for (auto _ : state) {
        ++crowd.frame;
        for (std::size_t c = 0; c < count; ++c) wishes[c] = wish(c, static_cast<int>(crowd.frame));
        evaluate(graph, crowd, {0, count}, 1.0f / 60, scratch);
        benchmark::ClobberMemory();
    }
    per_character(state, static_cast<double>(count));
    state.counters["state_bytes"] = sizeof(LocomotionState);
}
void crowd_frame(benchmark::State& state) { frames_of(state, graph(), static_cast<std::size_t>(state.range(0))); }
BENCHMARK(crowd_frame)->ArgName("characters")->Arg(1)->Arg(8)->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);

void crowd_frame_by_joints(benchmark::State& state) {
    const LocomotionGraph made = make_graph(static_cast<int>(state.range(0)));
    frames_of(state, made, 104);
}
void crowd_frame_by_dimensions(benchmark::State& state) {
    frames_of(state, make_graph(k_joints, static_cast<int>(state.range(0))), 104);
}
BENCHMARK(crowd_frame_by_dimensions)->ArgName("dimensions")->Arg(2)->Arg(3)->Arg(4);
BENCHMARK(crowd_frame_by_joints)->ArgName("joints")->Arg(20)->Arg(40)->Arg(80)->Arg(120)->Arg(200);

/// Multiply-adds in registers: what this machine does today, whatever it is.
void calibrate(benchmark::State& state) {
    float a[16];
    const float b = 1.0000001f;
    for (int i = 0; i < 16; ++i) a[i] = static_cast<float>(i);
    for (auto _ : state) {
        for (int k = 0; k < 1000; ++k)
            for (float& x : a) x = x * b + 1e-7f;
        benchmark::DoNotOptimize(a);
    }
}
BENCHMARK(calibrate);
/// Streaming writes of 32 MB, what 10,000 characters' matrices take.
void calibrate_writes(benchmark::State& state) {
    std::vector<Matrix34> out(670000);
    for (auto _ : state) {
        for (Matrix34& m : out)
            for (float& x : m.m) x = 1;
        benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(out.size() * sizeof(Matrix34)));
}
BENCHMARK(calibrate_writes);

}  // namespace
}  // namespace surefoot::bench

int main(int argc, char** argv) {
    benchmark::AddCustomContext("kernels", surefoot::kernels_name());
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
