#pragma once
// Packs of every kind of thing, and characters that play them.

#include <surefoot/author/author.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/host/files.h>
#include <surefoot/ik/foot_placement.h>
#include <surefoot/motion/edit.h>
#include <surefoot/pack_file/pack.h>
#include <surefoot/program/evaluate.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/folder.h"

#include <gtest/gtest.h>

#include <cstring>

namespace surefoot::test {

/// The graph that uses every key of the schema, on few and short clips of the synthetic set.
inline Pack whole_pack() {
    const Folder folder;
    std::vector<Motion> clips;
    for (const Motion& motion : make_synthetic_set().clips)
        for (const char* name : {"idle", "walk", "walk_left", "walk_right", "jog", "run"})
            if (motion.name == name) clips.push_back(resample(motion, 30));
    author_motions(clips, folder.path);
    const auto file = std::filesystem::path(SUREFOOT_SOURCE_DIR) / "tests/graph_text/whole.json";
    write_file(folder.path / "whole.json", read_file(file));
    Pack pack = load_graph(folder.path / "whole.json");
    // One clip in the small form beside the others.
    const Pack small = load_graph(folder.path / "whole.json", nullptr, nullptr, {1e-4f});
    pack.program.body.clips.at(static_cast<std::size_t>(pack.clip("jog"))) =
        small.program.body.clips.at(static_cast<std::size_t>(small.clip("jog")));
    // What a graph file alone does not bring: styles, and joints that turn far.
    SpaceDefinition straight;
    straight.space.axes = {{"speed", "m/s", 0, 4, false}};
    straight.space.samples = {{1.4f}, {3.5f}};
    straight.space.simplices = {{0, 1, -1, -1, -1}};
    straight.space.neighbours = {{-1, -1, -1, -1, -1}};
    straight.clips = {pack.clip("walk"), pack.clip("run")};
    add_style(pack.program.body, "proud", straight);
    std::vector<float> head(pack.skeleton().rest.size(), 0.0f);
    head.at(static_cast<std::size_t>(pack.roles[Role::head])) = 0.75f;
    add_style(pack.program.body, "looking", straight, head);
    PackedClip& clip = pack.program.body.clips.front();
    clip.turning_blocks.assign(static_cast<std::size_t>(clip.block_count()), 0);
    clip.turning_blocks.back() = 1;
    return pack;
}

/// The same with next to no keyframes: every clip has those of a walk, and the live gait is of one speed.
inline Pack small_pack() {
    Pack pack = whole_pack();
    std::vector<PackedClip>& clips = pack.program.body.clips;
    const PackedClip walk = clips[static_cast<std::size_t>(pack.clip("walk"))];
    for (PackedClip& clip : clips) {
        if (!clip.small.empty()) continue;
        std::string name = clip.name;
        clip = walk;
        clip.name = std::move(name);
    }
    HarmonicGait gait = *pack.program.rigs[0]->manners[0].gait;
    gait.basis.modes = 1;
    gait.basis.degree = 0;
    gait.coefficients.resize(static_cast<std::size_t>(value_count(gait)));
    LiveManner manner{"going", std::make_shared<const HarmonicGait>(gait), find_footfall_pattern("amble")};
    pack.program.rigs[0] = std::make_shared<const LiveRig>(make_live_rig({manner}, manner.gait));
    lay_out(pack.program);
    EXPECT_EQ(problem(pack), "");
    return pack;
}

/// The pack's body alone, as of a project.
inline Pack body_of(Pack pack) {
    Program program;
    program.name = pack.program.name;
    program.body = std::move(pack.program.body);
    pack.program = std::move(program);
    return pack;
}

/// Plays what a pack has, with parameters that change, and keeps every pose, root and state.
class Played {
  public:
    explicit Played(const Pack& pack, int frames) {
        pack.has_program() ? graph(pack, frames) : body(pack, frames);
        if (pack.legs.known()) make_foot_rig(pack.skeleton(), pack.legs, pack.standing);
    }
    std::vector<Transform> poses;
    std::vector<RootFrame> roots;
    std::vector<std::byte> states;

    bool operator==(const Played& other) const {
        const auto same = [](const auto& a, const auto& b) {
            return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
        };
        return same(poses, other.poses) && same(roots, other.roots) && same(states, other.states);
    }

  private:
    void graph(const Pack& pack, int frames) {
        const Program& program = pack.program;
        GraphScratch scratch(program);
        GraphFrame frame(program);
        std::vector<std::byte> state(program.state_size);
        std::vector<Transform> locals(pack.skeleton().rest.size());
        const std::vector<RootFrame> targets(program.targets.size(), {{0.3f, 0.2f, 1}, 0.4f});
        start(program, state);
        for (int f = 0; f < frames; ++f) {
            if (f % 30 == 0)
                for (std::size_t p = 0; p < program.parameters.size(); ++p) {
                    const Parameter& parameter = program.parameters[p];
                    const float share = static_cast<float>((f / 30 * 7 + static_cast<int>(p) * 3) % 11) / 10;
                    set(program, state, static_cast<int>(p), parameter.low + share * (parameter.high - parameter.low));
                }
            GraphInput input;
            input.dt = 1.0f / 60;
            input.root = roots.empty() ? RootFrame{} : roots.back();
            input.targets = targets;
            update(program, state, input, scratch, frame);
            pose(program, state, frame, scratch, locals);
            keep(locals, input.root * frame.root_delta, state);
        }
    }
    void body(const Pack& pack, int frames) {
        LocomotionState state;
        std::vector<Transform> locals(pack.skeleton().rest.size());
        RootFrame root;
        for (int f = 0; f < frames; ++f) {
            LocomotionRequest request;
            request.speed = static_cast<float>(f % 90) / 20 - 0.5f;
            request.turn = static_cast<float>(f % 50) - 25;
            request.style = f / 40 % 3 - 1 < static_cast<int>(pack.graph().styles.size()) ? f / 40 % 3 - 1 : -1;
            request.style_weight = 0.7f;
            const LocomotionFrame frame = update(pack.graph(), state, request, 1.0f / 60);
            pose(pack.graph(), frame, locals);
            root = root * frame.root_delta;
            keep(locals, root, std::as_bytes(std::span(&state, 1)));
        }
    }
    void keep(const std::vector<Transform>& locals, const RootFrame& root, std::span<const std::byte> state) {
        poses.insert(poses.end(), locals.begin(), locals.end());
        roots.push_back(root);
        states.insert(states.end(), state.begin(), state.end());
    }
};

}  // namespace surefoot::test
