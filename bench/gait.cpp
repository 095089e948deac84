// What a gait of expressions costs: eight lanes full, the scalar twin, and double precision; and on a body of 60
// joints.

#include <surefoot/gait_clip/gait_clip.h>
#include <surefoot/motion/stance.h>
#include <surefoot/preset/biped.h>

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

/// The generated biped with two chains of fingers a joint, up to 60 joints in all.
struct BodyStage : Stage {
    Skeleton skeleton = *make_biped().skeleton;
    Body body;
    BodyBinding binding = bind_gait(gait);
    std::vector<float> channels = std::vector<float>(8 * k_body_channels), posed;
    std::vector<Transform> locals;

    BodyStage() {
        const RoleMap roles = make_biped().roles;
        for (int i = 0; skeleton.joint_count() < 60; ++i) {
            const int hand = roles[i % 2 == 0 ? Role::left_hand : Role::right_hand];
            skeleton.add("finger" + std::to_string(i), i < 10 ? hand : skeleton.joint_count() - 10,
                         {{}, {0.03f, 0, 0}});
        }
        std::vector<Transform> rest(skeleton.rest.size());
        local_to_model(skeleton, skeleton.rest, rest);
        const Legs legs = make_legs(skeleton, roles, rest, 0);
        body = make_body(skeleton, roles, legs, standing_pose(skeleton, roles, legs, rest));
        posed.resize(body.pose_floats());
        locals.resize(rest.size());
    }
};

void body_alone(benchmark::State& state) {
    BodyStage stage;
    run(stage.gait.program, stage.inputs, stage.parameters, stage.outputs);
    for (auto _ : state) {
        apply(stage.binding, stage.body.scale, stage.outputs, stage.channels);
        solve(stage.body, stage.channels, stage.posed);
        benchmark::DoNotOptimize(stage.posed.data());
    }
    stage.report(state, 8);
}
BENCHMARK(body_alone);

/// Expressions, body, and the local transforms of all 60 joints of eight characters.
void expressions_and_body(benchmark::State& state) {
    BodyStage stage;
    for (auto _ : state) {
        run(stage.gait.program, stage.inputs, stage.parameters, stage.outputs);
        apply(stage.binding, stage.body.scale, stage.outputs, stage.channels);
        solve(stage.body, stage.channels, stage.posed);
        for (int lane = 0; lane < 8; ++lane) write_pose(stage.body, stage.posed, lane, stage.locals);
        benchmark::DoNotOptimize(stage.locals.data());
    }
    stage.report(state, 8);
    state.counters["joints"] = stage.skeleton.joint_count();
}
BENCHMARK(expressions_and_body);

void reading_the_text(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(read_gait(bundled_gait("bhatti2017"), "bhatti2017"));
}
BENCHMARK(reading_the_text);

}  // namespace

BENCHMARK_MAIN();
