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
    const GraphCharacter graph = load_graph(folder.path / "walk.json");
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

}  // namespace
}  // namespace surefoot
