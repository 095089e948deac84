#include <surefoot/author/author.h>
#include <surefoot/course/walk.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/host/files.h>
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

}  // namespace
}  // namespace surefoot
