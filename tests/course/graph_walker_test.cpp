#include <surefoot/author/author.h>
#include <surefoot/course/walk.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/host/files.h>
#include <surefoot/program/evaluate.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/folder.h"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

TEST(GraphWalker, a_graph_that_plays_a_projects_spaces_walks_as_the_project_does) {
    test::Folder folder;
    author_motions(make_synthetic_set().clips, folder.path);
    write_file(folder.path / "walk.json", R"({"surefoot_graph": 1, "project": ".",
        "parameters": {"speed": {"low": -1, "high": 5, "rate_per_s": 2.5},
                       "turn": {"low": -90, "high": 90, "rate_per_s": 240}},
        "nodes": {"move": {"type": "locomotion", "speed": "speed", "turn": "turn"}}, "root": "move"})");
    const Pack graph = load_graph(folder.path / "walk.json");
    const Project project = load_project(folder.path / "project.json");
    const Character character = bake_character(project, folder.path);
    const Plane flat;
    for (const char* path : {"straight", "start-stop"}) {
        const auto by_graph = make_graph_walker(graph, {}, walk_path(path, 8));
        const auto by_project = make_character_walker(character, {}, walk_path(path, 8));
        const Walked a = walk(*by_graph, flat, {1.4f, 8, FootMode::surefoot});
        const Walked b = walk(*by_project, flat, {1.4f, 8, FootMode::surefoot});
        for (std::size_t f = 0; f < a.motion.root.size(); ++f) {
            ASSERT_LT(distance(a.motion.root[f].position, b.motion.root[f].position), 0.01f) << path << " " << f;
            ASSERT_LT(distance(a.requested[f].position, a.motion.root[f].position), 0.01f) << path << " " << f;
        }
        EXPECT_EQ(a.motion.root.front(), RootFrame{}) << "it walks already when it starts";
    }
}

/// Flat, then a platform of another surface.
class Platform final : public Ground {
  public:
    static constexpr float k_begins = 4, k_height = 0.05f;
    void query(std::span<const GroundQuery> queries, std::span<GroundHit> hits) const noexcept override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const bool on = queries[i].origin.z > k_begins;
            hits[i] = {true, on ? k_height : 0.0f, {0, 1, 0}, on ? 7u : 0u, {}};
        }
    }
};

TEST(GraphWalker, what_it_stands_on_and_how_feet_are_placed_go_round_by_the_graph) {
    test::Folder folder;
    author_motions(make_synthetic_set().clips, folder.path);
    write_file(folder.path / "walk.json", R"({"surefoot_graph": 1, "project": ".",
        "parameters": {"speed": {"low": -1, "high": 5}, "surface": {"low": 0, "high": 10}},
        "nodes": {"move": {"type": "locomotion", "speed": "speed"},
                  "all": {"type": "feet", "of": "move", "weight": {"parameter": "surface", "scale": -1, "offset": 1}}},
        "root": "all"})");
    const Pack graph = load_graph(folder.path / "walk.json");
    const auto walker = make_graph_walker(graph);
    const Walked placed = walk(*walker, Platform(), {1.4f, 8, FootMode::surefoot});
    const Walked own = walk(*walker, Platform(), {1.4f, 8, FootMode::none});
    int planted_before = 0, planted_after = 0;
    for (std::size_t f = 0; f < placed.motion.root.size(); ++f) {
        const float z = placed.motion.root[f].position.z;
        const int planted = placed.planted[0][f] || placed.planted[1][f];
        if (z < Platform::k_begins - 0.5f) planted_before += planted;
        if (z < Platform::k_begins + 1.5f) continue;
        planted_after += planted;
        const std::span<const Transform> a = placed.motion.frame(static_cast<int>(f));
        const std::span<const Transform> b = own.motion.frame(static_cast<int>(f));
        for (std::size_t j = 0; j < a.size(); ++j) {
            ASSERT_LT(distance(a[j].translation, b[j].translation), 1e-5f) << f << " " << j;
            ASSERT_LT(1 - std::fabs(dot(a[j].rotation, b[j].rotation)), 1e-5f) << f << " " << j;
        }
    }
    EXPECT_GT(planted_before, 60);
    EXPECT_EQ(planted_after, 0) << "the surface has put foot placement out of use";
}

TEST(GraphWalker, lets_itself_be_told_and_watched) {
    test::Folder folder;
    author_motions(make_synthetic_set().clips, folder.path);
    write_file(folder.path / "walk.json", R"({"surefoot_graph": 1, "project": ".",
        "parameters": {"speed": {"low": 0, "high": 4}, "wave": {"type": "trigger"}, "share": {"low": 0, "high": 1}},
        "groups": {"legs": {"events": {"left_strike": 0}}},
        "nodes": {"move": {"type": "locomotion", "speed": "speed", "group": "legs"},
                  "mixed": {"type": "lerp", "from": "move", "to": {"type": "clip", "clip": "idle"}, "weight": "share"},
                  "hero": {"type": "machine", "states": {"free": "mixed", "waving": "move"},
                    "transitions": {"begin": {"from": "free", "to": "waving", "seconds": 1, "curve": "linear",
                                              "when": [{"trigger": "wave"}]}}}}, "root": "hero"})");
    const Pack graph = load_graph(folder.path / "walk.json");
    const Program& program = graph.program;
    const int root = static_cast<int>(program.nodes.size()) - 1;
    const int states[] = {program.nodes.back().children[0], program.nodes.back().children[1]};
    std::vector<float> weights(program.nodes.size());
    int steps = 0, strikes = 0;
    const auto walker = make_watched_graph_walker(graph, [&](float dt, const GraphFrame& frame, const GraphScratch& s) {
        EXPECT_EQ(dt, 1 / k_walk_fps);
        for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = node_weight(s, static_cast<int>(i));
        for (const GraphEvent& event : frame.events())
            strikes += program.events[static_cast<std::size_t>(event.event)] == "left_strike";
        ++steps;
    });
    const auto weight = [&](int node) { return weights[static_cast<std::size_t>(node)]; };
    std::vector<Transform> locals(graph.standing.size());
    const auto play = [&](int frames) {
        for (int f = 0; f < frames; ++f) {
            walker->advance(1 / k_walk_fps);
            RootFrame ahead;
            walker->look(0.3f, ahead, locals);  // looking ahead is not told of
        }
    };
    walker->start(1.4f);
    EXPECT_EQ(steps, 0) << "its run-up is nobody's business";
    walker->ask({program.parameter("share"), 0.25f});
    play(120);
    EXPECT_EQ(steps, 120);
    EXPECT_GE(strikes, 1);
    EXPECT_LE(strikes, 3);
    EXPECT_EQ(weight(root), 1);
    EXPECT_EQ(weight(states[0]), 1);
    EXPECT_EQ(weight(states[1]), 0);
    EXPECT_NEAR(weight(program.nodes[static_cast<std::size_t>(states[0])].children[1]), 0.25f, 1e-6f);
    EXPECT_EQ(machine_status(program, walker->state(), root).transition, -1);
    EXPECT_EQ(machine_status(program, walker->state(), states[1]).state, -1) << "no machine";
    walker->ask({program.parameter("wave"), 1});
    play(30);
    const MachineStatus status = machine_status(program, walker->state(), root);
    EXPECT_EQ(status.state, 1);
    EXPECT_EQ(status.transition, 0);
    EXPECT_NEAR(status.elapsed, 0.5f, 0.02f);
    EXPECT_NEAR(weight(states[1]), 0.5f, 0.02f);
    EXPECT_NEAR(weight(states[0]) + weight(states[1]), 1, 1e-6f);
    play(40);
    EXPECT_EQ(machine_status(program, walker->state(), root).transition, -1);
    EXPECT_EQ(weight(states[1]), 1);
    walker->start(1.4f);
    play(1);
    EXPECT_EQ(machine_status(program, walker->state(), root).state, 0) << "a trigger is pulled once";
    EXPECT_NEAR(get(program, walker->state(), program.parameter("share")), 0.25f, 1e-6f);
}

}  // namespace
}  // namespace surefoot
