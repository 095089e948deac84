#include "scenario.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/base/hash.h>
#include <surefoot/base/random.h>
#include <surefoot/course/walk.h>
#include <surefoot/crowd/crowd.h>
#include <surefoot/ground/height_field.h>
#include <surefoot/io/bvh.h>
#include <surefoot/math/trig.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/program/evaluate.h>
#include <surefoot/space/triangulate.h>
#include <surefoot/synthetic/synthetic_set.h>

#include <cstdio>
#include <memory>
#include <vector>

namespace surefoot::wasm {

namespace {

std::string hex(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%08x%08x", static_cast<unsigned>(value >> 32u), static_cast<unsigned>(value));
    return text;
}

std::uint64_t hash_worlds(const Motion& motion) {
    std::vector<Transform> world(static_cast<std::size_t>(motion.joint_count()));
    std::uint64_t hash = hash_bytes({});
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        hash = hash_span<Transform>(world, hash);
    }
    return hash;
}

const Motion& clip_named(const ClipSet& set, const std::string& name) {
    for (const Motion& clip : set.clips)
        if (clip.name == name) return clip;
    throw Error("the default set has no clip of that name", name, "");
}

/// A biped that travels in a curve and swings every joint: not a gait, but every bit of it counts.
Motion swinging_biped(const ClipSet& set) {
    Motion motion = make_motion(set.skeleton, "swinging", 180, 60);
    for (int f = 0; f < motion.frame_count(); ++f) {
        const double t = static_cast<double>(f) / 60;
        const auto frame = motion.frame(f);
        for (std::size_t j = 0; j < frame.size(); ++j) {
            const double angle = 0.5 * sin(2 * k_pi * t + 0.7 * static_cast<double>(j));
            const Vec3 axis = j % 2 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
            frame[j].rotation = frame[j].rotation * from_rotation_vector(axis * static_cast<float>(angle));
        }
        const auto heading = static_cast<float>(0.4 * t);
        frame[0].translation = frame[0].translation + Vec3{sin(heading), 0, 1.4f * static_cast<float>(t)};
        frame[0].rotation = from_rotation_vector({0, heading, 0}) * frame[0].rotation;
    }
    return motion;
}

/// The clips of a set, every joint of every frame.
std::uint64_t set_scenario(const ClipSet& set) {
    std::uint64_t hash = hash_bytes({});
    for (const Motion& clip : set.clips) hash = hash * 31 + hash_worlds(clip);
    return hash;
}

/// Clip through BVH text and back, its root motion extracted and mirrored.
std::uint64_t motion_scenario() {
    const ClipSet set = make_synthetic_set();
    const std::string text = write_bvh(swinging_biped(set));
    Motion motion = read_bvh(text, "swinging.bvh").motion;
    extract_root_motion(motion, set.roles);
    return hash_worlds(mirror(motion, set.roles)) ^ hash_bytes(text);
}

/// Random spaces of one to four dimensions, triangulated, and weights all over them.
std::uint64_t space_scenario() {
    std::uint64_t hash = hash_bytes({});
    Random random(7);
    for (int dimensions = 1; dimensions <= k_max_dimensions; ++dimensions) {
        BlendSpace space;
        const auto anywhere = [&] {
            SpacePoint point{};
            for (int d = 0; d < dimensions; ++d) point[static_cast<std::size_t>(d)] = random.between(-2, 5);
            return point;
        };
        for (int d = 0; d < dimensions; ++d) space.axes.push_back({"axis", "m/s", -2, 5, false});
        for (int s = 0; s < 24; ++s) space.samples.push_back(anywhere());
        triangulate(space);
        hash = hash_span<Simplex>(space.simplices, hash);
        for (int q = 0; q < 500; ++q) {
            const BlendWeights weights = blend_weights(space, anywhere());
            hash = hash_span<float>(weights.weights, hash);
            hash = hash_span<std::int32_t>(weights.samples, hash);
        }
    }
    return hash;
}

/// The generated clips measured and baked.
Character scenario_character(const BakeOptions& options = {}) {
    const ClipSet set = make_synthetic_set();
    std::vector<AnalyzedClip> clips;
    ProjectSpace facing;
    facing.name = "facing";
    facing.space.axes = {{"speed", "m/s", -2, 6, false}, {"turn", "deg/s", -180, 180, false}};
    for (const char* name : {"idle", "walk", "walk_left", "walk_right", "jog", "run"}) {
        AnalyzedClip clip = analyze_clip(clip_named(set, name), name);
        facing.space.samples.push_back({clip.facts.speed, clip.facts.turn});
        facing.clips.push_back(static_cast<int>(clips.size()));
        clips.push_back(std::move(clip));
    }
    triangulate(facing.space);
    return bake_character(clips, {&facing, 1}, "scenario", options);
}

/// Steered over hills with the feet on the ground, ten seconds.
std::uint64_t walk_scenario(const Character& character) {
    const std::unique_ptr<Walker> walker = make_character_walker(character);
    const Walked walked = walk(*walker, *make_course("hills").ground, {1.4f, 10, FootMode::surefoot});
    return hash_worlds(walked.motion);
}

/// Between the blend space and a clip that plays in step, by an inertialized transition there and a feathered one back;
/// mirrored at times.
Program scenario_program(const Character& character) {
    Program program;
    program.body = character.graph;
    program.mirror = mirror_map(*character.skeleton, character.roles);
    program.parameters = {{"speed", "m/s", ParameterKind::number, 0, -1, 5, 2.5f, 0},
                          {"turn", "deg/s", ParameterKind::number, 0, -90, 90, 240, 0},
                          {"left", "", ParameterKind::flag, 0, 0, 1, 0, 0}};
    program.groups = {{"legs", {}}};
    LocomotionNode move;
    move.speed = {0, 1, 0};
    move.turn = {0, 1, 1};
    ClipNode step;
    step.clip = 2;
    step.group = 0;
    Condition fast{ConditionKind::compare, 0, Comparison::greater, 1.5f, 0}, slow = fast;
    slow.comparison = Comparison::less;
    Transition there{"there", 0, 1, 0.4f, Curve::smoothstep, TransitionKind::inertialize, {}, {}, -1, 0, {fast}};
    Transition back{"back", 1, 0, 0.3f, Curve::linear, TransitionKind::feather, {}, {}, -1, 0, {slow}};
    const int from = add_node(program, "/move", move, {}), to = add_node(program, "/step", step, {});
    const int machine = add_node(program, "/machine", MachineNode{{"move", "step"}, {there, back}, 0}, {from, to});
    add_node(program, "/mirror", MirrorNode{{0, 1, 2}}, {machine});
    lay_out(program);
    if (const std::string text = problem(program); !text.empty()) throw Error(text, "the scenario", "");
    return program;
}

/// Ten seconds, states and poses.
std::uint64_t program_scenario(const Program& program) {
    GraphScratch scratch(program);
    GraphFrame frame(program);
    std::vector<std::byte> state(program.state_size);
    std::vector<Transform> locals(program.body.skeleton->rest.size());
    start(program, state);
    RootFrame root;
    std::uint64_t hash = hash_bytes({});
    for (int f = 0; f < 600; ++f) {
        set(program, state, 0, f / 100 % 2 == 0 ? 2.5f : 0.8f);
        set(program, state, 1, f / 150 % 2 == 0 ? 30.0f : -20.0f);
        set(program, state, 2, f / 220 % 2 == 0 ? 0.0f : 1.0f);
        GraphInput input;
        input.dt = 1.0f / 60;
        input.root = root;
        update(program, state, input, scratch, frame);
        root = root * frame.root_delta;
        pose(program, state, frame, scratch, locals);
        hash = hash_span<Transform>(locals, hash_span<std::byte>(state, hash_span<RootFrame>({&root, 1}, hash)));
    }
    return hash;
}

/// Curves instead of frames, by a crowd with its feet on hills, five seconds.
std::uint64_t crowd_scenario(const Character& character) {
    constexpr std::size_t k_count = 11;
    const HeightField hills = make_hills();
    std::vector<LocomotionState> states(k_count);
    std::vector<LocomotionRequest> wishes(k_count);
    std::vector<RootFrame> roots(k_count);
    std::vector<Transform> locals(k_count * character.skeleton->rest.size());
    std::vector<CrowdFeet> feet(k_count);
    for (std::size_t c = 0; c < k_count; ++c) wishes[c] = {0.3f * static_cast<float>(c), 5 * static_cast<float>(c), 0};
    CrowdScratch scratch(character.graph);
    Crowd crowd{states, wishes, roots};
    crowd.locals = locals;
    crowd.ground = &hills;
    crowd.feet = feet;
    std::uint64_t hash = hash_bytes({});
    for (; crowd.frame < 300; ++crowd.frame) {
        evaluate(character.graph, crowd, {0, k_count}, 1.0f / 60, scratch);
        hash = hash_span<Transform>(locals, hash_span<CrowdFeet>(feet, hash_span<RootFrame>(roots, hash)));
    }
    return hash;
}

/// As bytes, and played from them.
std::uint64_t pack_scenario(const Character& character, Program program) {
    Pack pack = to_pack(character);
    pack.program = std::move(program);
    const std::vector<std::byte> bytes = pack_bytes(pack);
    std::string why;
    const std::optional<Pack> opened = Pack::open(bytes, &why);
    if (!opened) throw Error(why, "the scenario's pack", "");
    return hash_span<std::byte>(bytes) ^ program_scenario(opened->program);
}

}  // namespace

std::string run_scenarios() {
    std::string text;
    text += "synthetic " + hex(set_scenario(make_synthetic_set())) + "\n";
    text += "default " + hex(set_scenario(make_default_set())) + "\n";
    text += "motion " + hex(motion_scenario()) + "\n";
    const Character character = scenario_character();
    text += "walk " + hex(walk_scenario(character)) + "\n";
    const Program program = scenario_program(character);
    text += "program " + hex(program_scenario(program)) + "\n";
    text += "pack " + hex(pack_scenario(character, program)) + "\n";
    constexpr float k_limit = 1e-4f;
    text += "crowd " + hex(crowd_scenario(scenario_character({k_limit}))) + "\n";
    text += "space " + hex(space_scenario()) + "\n";
    return text;
}

std::string example_bvh() { return write_bvh(clip_named(make_synthetic_set(), "walk")); }

}  // namespace surefoot::wasm
