// What a gait of expressions costs: eight lanes full, the scalar twin, and double precision.

#include <surefoot/gait_text/gait.h>

#include <benchmark/benchmark.h>

namespace {

using namespace surefoot;

struct Stage {
    Gait gait = read_gait(bundled_gait("bhatti2017"), "bhatti2017");
    std::vector<float> inputs = std::vector<float>(8 * k_gait_inputs), parameters;
    std::vector<float> outputs = std::vector<float>(8 * gait.program.outputs.size());

    Stage() {
        for (const GaitParameter& p : gait.parameters)
            parameters.insert(parameters.end(), 8, static_cast<float>(p.value));
        for (std::size_t lane = 0; lane < 8; ++lane) inputs[lane] = 0.13f * static_cast<float>(lane);
    }
    void report(benchmark::State& state, double lanes) const {
        state.counters["instructions"] = static_cast<double>(gait.program.instructions.size());
        state.counters["ns_per_character"] = benchmark::Counter(
            lanes * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    }
};

void eight_lanes(benchmark::State& state) {
    Stage stage;
    for (auto _ : state) {
        run(stage.gait.program, stage.inputs, stage.parameters, stage.outputs);
        benchmark::DoNotOptimize(stage.outputs.data());
    }
    stage.report(state, 8);
}
BENCHMARK(eight_lanes);

void scalar_twin(benchmark::State& state) {
    Stage stage;
    for (auto _ : state) {
        run_scalar(stage.gait.program, stage.inputs, stage.parameters, stage.outputs);
        benchmark::DoNotOptimize(stage.outputs.data());
    }
    stage.report(state, 8);
}
BENCHMARK(scalar_twin);

void double_precision(benchmark::State& state) {
    const Stage stage;
    const double inputs[k_gait_inputs] = {0.3, 0.3, 0, 0, 0};
    const std::vector<double> values = gait_values(stage.gait, "", {});
    std::vector<double> outputs(stage.gait.program.outputs.size());
    for (auto _ : state) {
        run_exactly(stage.gait.program, inputs, values, outputs);
        benchmark::DoNotOptimize(outputs.data());
    }
    stage.report(state, 1);
}
BENCHMARK(double_precision);

void reading_the_text(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(read_gait(bundled_gait("bhatti2017"), "bhatti2017"));
}
BENCHMARK(reading_the_text);

}  // namespace

BENCHMARK_MAIN();
