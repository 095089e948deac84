// What a gait of expressions costs: eight lanes full, the scalar twin, and double precision; and on a body of 60
// joints. What a fitted gait played live costs a character and frame, on its own rig and on one of 60 joints that all
// move.

#include <surefoot/author/fitted_gaits.h>
#include <surefoot/gait_clip/gait_clip.h>
#include <surefoot/gait_text/gait.h>
#include <surefoot/harmonic/kernels.h>
#include <surefoot/live/live.h>
#include <surefoot/motion/stance.h>
#include <surefoot/synthetic/biped.h>

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

/// The bundled walk, with further joints at its hands until there are `joints`; they move as the forearms do.
std::shared_ptr<const HarmonicGait> bundled_walk(int joints) {
    HarmonicGait gait = fitted_gait("human");
    const auto old = static_cast<int>(gait.mean.size());
    const int like = gait.skeleton->find("LeftLowerArm"),
              hands[] = {gait.skeleton->find("LeftHand"), gait.skeleton->find("RightHand")};
    auto skeleton = std::make_shared<Skeleton>(*gait.skeleton);
    for (int j = old; j < joints; ++j) skeleton->add("extra" + std::to_string(j), hands[j % 2], {{}, {0, 0.03f, 0}});
    const std::size_t series = static_cast<std::size_t>(3 * (1 + 2 * gait.harmonics));
    const std::size_t terms = static_cast<std::size_t>(gait.basis.terms()), count = gait.coefficients.size() / terms;
    std::vector<float> coefficients;
    for (std::size_t t = 0; t < terms; ++t) {
        const auto term = gait.coefficients.begin() + static_cast<std::ptrdiff_t>(t * count);
        const auto of_joints = term + static_cast<std::ptrdiff_t>(series) * old;
        coefficients.insert(coefficients.end(), term, of_joints);
        for (int j = old; j < joints; ++j)
            coefficients.insert(coefficients.end(), term + static_cast<std::ptrdiff_t>(series) * like,
                                term + static_cast<std::ptrdiff_t>(series) * (like + 1));
        coefficients.insert(coefficients.end(), of_joints, term + static_cast<std::ptrdiff_t>(count));
    }
    gait.coefficients = std::move(coefficients);
    gait.mean.resize(static_cast<std::size_t>(std::max(joints, old)));
    gait.skeleton = skeleton;
    return std::make_shared<const HarmonicGait>(std::move(gait));
}

struct LiveStage {
    explicit LiveStage(int joints) : rig(make_live_rig({{"human", bundled_walk(joints), nullptr}})), scratch(rig) {
        if (!problem(rig).empty()) std::abort();
        for (std::size_t c = 0; c < characters.size(); ++c)
            characters[c] = start(rig, {.speed = 1.4f}, static_cast<float>(c) / 64);
        locals.resize(rig.stand.size());
    }
    void report(benchmark::State& state, double characters_each) const {
        state.counters["joints"] = static_cast<double>(rig.stand.size());
        state.counters["us_per_character"] = benchmark::Counter(
            characters_each * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    }
    LiveRig rig;
    LiveScratch scratch;
    std::array<LiveState, 64> characters;
    std::vector<Transform> locals;
};

/// Update and pose of characters that keep their speed: its numbers are kept.
void live_steady(benchmark::State& state) {
    LiveStage stage(static_cast<int>(state.range(0)));
    for (auto _ : state)
        for (LiveState& character : stage.characters) {
            benchmark::DoNotOptimize(update(stage.rig, character, {.speed = 1.4f}, 1.0f / 60));
            pose(stage.rig, character, stage.scratch, stage.locals);
            benchmark::DoNotOptimize(stage.locals.data());
        }
    stage.report(state, 64);
}
BENCHMARK(live_steady)->Arg(23)->Arg(60);

/// The numbers anew for each frame, as for characters of many speeds: numbers, joints, feet and legs.
void live_pose_every_speed(benchmark::State& state) {
    LiveStage stage(static_cast<int>(state.range(0)));
    for (std::size_t c = 0; c < 64; ++c)
        stage.characters[c] = start(stage.rig, {.speed = 1.0f + 0.005f * static_cast<float>(c)}, 0.1f);
    for (auto _ : state)
        for (const LiveState& character : stage.characters) {
            pose(stage.rig, character, stage.scratch, stage.locals);
            benchmark::DoNotOptimize(stage.locals.data());
        }
    stage.report(state, 64);
}
BENCHMARK(live_pose_every_speed)->Arg(23)->Arg(60);

/// On the way from a walk to a run: everything changes, both modes have their share.
void live_changing(benchmark::State& state) {
    LiveStage stage(static_cast<int>(state.range(0)));
    int frame = 0;
    for (auto _ : state) {
        const float speed = ++frame / 60 % 2 ? 1.4f : 3;
        for (LiveState& character : stage.characters) {
            benchmark::DoNotOptimize(update(stage.rig, character, {.speed = speed}, 1.0f / 60));
            pose(stage.rig, character, stage.scratch, stage.locals);
            benchmark::DoNotOptimize(stage.locals.data());
        }
    }
    stage.report(state, 64);
}
BENCHMARK(live_changing)->Arg(23)->Arg(60);

/// The stages of a pose by themselves: numbers, waves and joints.
void lanes_only(benchmark::State& state) {
    const auto gait = bundled_walk(static_cast<int>(state.range(0)));
    HarmonicLanes lanes(*gait, {});
    if (state.range(1) != 0) lanes.use_kernels(KernelBuilds<HarmonicKernels>::scalar);
    std::vector<float> values(lanes.value_count());
    std::vector<Transform> locals(gait->mean.size());
    HarmonicLanes::Waves waves;
    float speed = 1;
    for (auto _ : state) {
        speed = speed < 1.3f ? speed + 0.001f : 1;
        lanes.values_at(speed, 0, values);
        lanes.waves_at(std::array<float, 8>{0.3f}, waves);
        lanes.joint_pose(values, waves, locals);
        benchmark::DoNotOptimize(locals.data());
    }
    state.counters["us"] =
        benchmark::Counter(1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(lanes_only)->ArgNames({"joints", "scalar"})->Args({60, 0})->Args({60, 1});

/// The formulas in plain sight, as tools use them.
void plain_pose(benchmark::State& state) {
    const auto gait = bundled_walk(static_cast<int>(state.range(0)));
    std::vector<float> values(static_cast<std::size_t>(value_count(*gait)));
    std::vector<Transform> locals(gait->mean.size());
    for (auto _ : state) {
        values_at(*gait, 1.4f, 0, values);
        pose(*gait, values, 0.3f, locals);
        benchmark::DoNotOptimize(locals.data());
    }
    state.counters["us"] =
        benchmark::Counter(1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(plain_pose)->Arg(23)->Arg(60);

}  // namespace

BENCHMARK_MAIN();
