#include <surefoot/author/author.h>
#include <surefoot/author/live_rigs.h>
#include <surefoot/base/error.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/host/files.h>
#include <surefoot/program/evaluate.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/allocations.h"
#include "tests/support/damage.h"
#include "tests/support/drag.h"
#include "tests/support/folder.h"

#include <gtest/gtest.h>

#include <cstring>

namespace surefoot {
namespace {

const char* const k_graph = R"({
  "surefoot_graph": 1,
  "name": "hero",
  "project": ".",
  "parameters": {
    "speed": {"unit": "m/s", "low": -1, "high": 5, "rate_per_s": 2.5},
    "turn": {"unit": "deg/s", "low": -90, "high": 90, "rate_per_s": 240},
    "look": {"low": 0, "high": 1},
    "wave": {"type": "trigger", "lasts_s": 0.5}
  },
  "clips": {"greeting": "run", "stand": "idle"},
  "groups": {"legs": {"events": {"left_strike": 0, "right_strike": 0.5}}},
  "masks": {"arms": {"left_shoulder": 1, "right_shoulder": 1}},
  "nodes": {
    "move": {"type": "locomotion", "speed": "speed", "turn": "turn"},
    "greet": {"type": "clip", "clip": "greeting", "loop": false, "events": {"hello": 0.2}},
    "arms": {"type": "machine", "initial": "free",
      "states": {"free": "move", "greeting": {"type": "layer", "base": "move", "over": "greet", "mask": "arms"}},
      "transitions": {
        "begin": {"from": "free", "to": "greeting", "kind": "inertialize", "seconds": 0.3, "when": [{"trigger": "wave"}]},
        "end": {"from": "greeting", "to": "free", "curve": "cubic_out", "when": [{"remaining_s": 0.2}]}
      }}
  },
  "root": "arms"
})";

class GraphFile : public testing::Test {
  protected:
    GraphFile() { author_motions(make_synthetic_set().clips, folder_.path); }
    std::filesystem::path write(const std::string& text, const std::string& name = "hero.json") {
        write_file(folder_.path / name, text);
        return folder_.path / name;
    }
    std::string error_of(const std::string& text) {
        try {
            load_graph(write(text));
        } catch (const Error& error) {
            std::string what = error.what();
            const std::string path = folder_.path.string() + "/";
            for (std::size_t at; (at = what.find(path)) != std::string::npos;) what.erase(at, path.size());
            return what;
        }
        return {};
    }
    static std::string with(const std::string& from, const std::string& to) {
        std::string text = k_graph;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    }
    test::Folder folder_;
};

TEST_F(GraphFile, walks_as_asked_and_takes_its_transitions) {
    std::vector<std::string> warnings;
    const Pack hero = load_graph(write(k_graph), &warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    const Program& program = hero.program;
    EXPECT_EQ(program.name, "hero");
    EXPECT_EQ(problem(program), "");
    GraphScratch scratch(program);
    GraphFrame frame(program);
    std::vector<std::byte> state(program.state_size);
    std::vector<Transform> locals(program.body.skeleton->rest.size());
    start(program, state);
    set(program, state, program.parameter("speed"), 1.4f);
    RootFrame root;
    int strikes = 0, hellos = 0;
    std::string seen;
    const long allocations = test::allocation_count();
    for (int i = 0; i < 600; ++i) {
        if (i == 200) set(program, state, program.parameter("wave"), 1);
        GraphInput input;
        input.dt = 1.0f / 60;
        update(program, state, input, scratch, frame);
        pose(program, state, frame, scratch, locals);
        root = root * frame.root_delta;
        for (const GraphEvent& event : frame.events()) {
            strikes += event.event == program.event("left_strike") || event.event == program.event("right_strike");
            hellos += event.event == program.event("hello");
        }
        if (i == 210) {
            EXPECT_EQ(machine_state(program, state, find_node(program, "/nodes/arms")), "greeting");
        }
    }
    EXPECT_EQ(test::allocation_count(), allocations);
    EXPECT_EQ(machine_state(program, state, find_node(program, "/nodes/arms")), "free");
    EXPECT_EQ(hellos, 1);
    EXPECT_GT(strikes, 15);
    EXPECT_LT(strikes, 25);
    // Ten seconds at 1.4 m/s, but for the time of getting there.
    EXPECT_NEAR(root.position.z, 14 - 0.5f * 1.4f * 1.4f / 2.5f, 0.1f);
    EXPECT_NEAR(root.position.x, 0, 0.1f);
}

/// Stands, goes, curves, and stands again; greets meanwhile. Returns how far a lying foot goes, in metres.
float longest_drag(const Pack& hero, const Program& program) {
    GraphScratch scratch(program);
    GraphFrame frame(program);
    std::vector<std::byte> state(program.state_size);
    const Skeleton& skeleton = *program.body.skeleton;
    std::vector<Transform> locals(skeleton.rest.size()), models(skeleton.rest.size());
    start(program, state);
    const int speed = program.parameter("speed"), turn = program.parameter("turn"), wave = program.parameter("wave");
    RootFrame root;
    test::DragMeter drag;
    for (int i = 0; i < 480; ++i) {
        set(program, state, speed, i > 60 && i < 360 ? 1.4f : 0.0f);
        set(program, state, turn, i > 180 && i < 300 ? 40.0f : 0.0f);
        if (wave >= 0 && (i == 70 || i == 190)) set(program, state, wave, 1);
        GraphInput input;
        input.dt = 1.0f / 60;
        update(program, state, input, scratch, frame);
        root = root * frame.root_delta;
        pose(program, state, frame, scratch, locals);
        local_to_model(skeleton, locals, models);
        drag.see(hero.legs, to_transform(root), models);
    }
    EXPECT_GT(root.position.z, 2);
    return drag.longest();
}

TEST_F(GraphFile, standing_feet_stay_while_weights_change) {
    const std::string machine = R"({
  "surefoot_graph": 1, "name": "stander", "project": ".",
  "parameters": {
    "speed": {"low": -1, "high": 5, "rate_per_s": 2.5}, "turn": {"low": -90, "high": 90, "rate_per_s": 240}
  },
  "groups": {"legs": {}},
  "nodes": {
    "stand": {"type": "clip", "clip": "idle"},
    "move": {"type": "locomotion", "speed": "speed", "turn": "turn"},
    "whole": {"type": "machine", "initial": "stand", "states": {"stand": "stand", "go": "move"},
      "transitions": {
        "begin": {"from": "stand", "to": "go", "kind": "feather", "seconds": 0.3, "when": [{"parameter": "speed", ">": 0.1}]},
        "end": {"from": "go", "to": "stand", "kind": "feather", "seconds": 0.3, "when": [{"parameter": "speed", "<": 0.1}]}
      }}
  },
  "root": "whole"
})";
    const std::pair<std::string, float> graphs[] = {
        {machine, 0.04f},                                           // an idle that is in no group
        {with("\"root\": \"arms\"", "\"root\": \"move\""), 0.04f},  // one node
        {with("\"kind\": \"inertialize\", ", ""), 0.04f},           // two sums of one group while states change
        {k_graph, 0.06f},  // what is carried of the old pose moves the legs a little
    };
    for (const auto& [text, most] : graphs) {
        const Pack hero = load_graph(write(text));
        ASSERT_TRUE(hero.program.holds_feet);
        EXPECT_LT(longest_drag(hero, hero.program), most) << text;
        Program forgets = hero.program;
        forgets.holds_feet = false;
        EXPECT_GT(longest_drag(hero, forgets), 2 * most) << text;
    }
}

TEST_F(GraphFile, who_stands_goes_off_with_the_foot_that_trails) {
    for (const Side ahead : {Side::left, Side::right}) {
        Program program = load_graph(write(k_graph)).program;
        for (PackedClip& clip : program.body.clips)
            if (clip.name == "idle") test::put_ahead(clip, ahead, 0.15f);
        GraphScratch scratch(program);
        GraphFrame frame(program);
        std::vector<std::byte> state(program.state_size);
        start(program, state);
        GraphInput input;
        input.dt = 1.0f / 60;
        int first_strike = -1;
        for (int i = 0; i < 120 && first_strike < 0; ++i) {
            if (i == 1) set(program, state, program.parameter("speed"), 1.4f);
            update(program, state, input, scratch, frame);
            // That of the frame in which the group has begun is nobody's step.
            if (i > 0 && !frame.events().empty()) first_strike = frame.events()[0].event;
        }
        EXPECT_EQ(first_strike, program.event(ahead == Side::left ? "right_strike" : "left_strike"));
    }
}

TEST_F(GraphFile, extends_another_and_exchanges_what_it_names) {
    write(k_graph, "base.json");
    const Pack heavy = load_graph(write(R"({"surefoot_graph": 1, "extends": "base.json", "name": "heavy",
        "clips": {"greeting": "walk"}, "parameters": {"speed": {"high": 2}, "look": null}})"));
    EXPECT_EQ(heavy.program.name, "heavy");
    EXPECT_EQ(heavy.program.parameter("look"), -1);
    EXPECT_EQ(heavy.program.parameters[0].high, 2);
    EXPECT_EQ(heavy.program.parameters[0].low, -1);
    const Node& greet = heavy.program.nodes[static_cast<std::size_t>(find_node(heavy.program, "/nodes/greet"))];
    const int clip = std::get<ClipNode>(greet.data).clip;
    EXPECT_EQ(heavy.program.body.clips[static_cast<std::size_t>(clip)].name, "walk");
    EXPECT_EQ(error_of(R"({"surefoot_graph": 1, "extends": "hero.json", "project": "."})").substr(0, 46),
              "hero.json: graphs extend one another more than");
}

TEST_F(GraphFile, says_what_is_wrong_and_where) {
    const auto starts = [](const std::string& text, const std::string& with) {
        EXPECT_EQ(text.substr(0, with.size()), with);
    };
    starts(error_of("{"), "hero.json: it is no JSON");
    starts(error_of("{}"), "hero.json: /: the key \"surefoot_graph\" is missing");
    starts(error_of(with("\"type\": \"locomotion\"", "\"type\": \"loco\"")),
           "hero.json: /nodes/move/type: there are no nodes of type 'loco'");
    starts(error_of(with("\"speed\": \"speed\"", "\"speed\": \"sped\"")),
           "hero.json: /nodes/move/speed: there is no parameter 'sped'");
    starts(error_of(with("\"run\", \"stand\"", "\"rum\", \"stand\"")),
           "hero.json: /clips/greeting: the project has no clip 'rum'");
    starts(error_of(with("\"mask\": \"arms\"", "\"mask\": \"legs\"")),
           "hero.json: /nodes/arms/states/greeting/mask: there is no mask 'legs'");
    starts(error_of(with("\"trigger\": \"wave\"", "\"trigger\": \"look\"")),
           "hero.json: /nodes/arms/transitions/begin/when/0/trigger: the parameter 'look' is no trigger");
    starts(error_of(with("\"to\": \"free\"", "\"to\": \"nowhere\"")),
           "hero.json: /nodes/arms/transitions/end/to: there is no state 'nowhere'");
    starts(error_of(with("\"cubic_out\"", "\"bouncy\"")),
           "hero.json: /nodes/arms/transitions/end/curve: 'bouncy' is not known here");
    starts(error_of(with("\"root\": \"arms\"", "\"root\": \"arm\"")), "hero.json: /root: there is no node 'arm'");
    starts(error_of(with("{\"legs\": {", "{\"legs\": {\"leader\": \"feet\", ")),
           "hero.json: /groups/legs/leader: there is no node 'feet'");
    starts(error_of(with("{\"legs\": {", "{\"legs\": {\"leader\": \"greet\", ")),
           "hero.json: /nodes/greet: it shall lead sync group 'legs', and plays nothing of it");
    starts(error_of(with("\"base\": \"move\"", "\"base\": \"arms\"")),
           "hero.json: /nodes/arms/states/free: nodes lie more than 32 deep");
    starts(error_of(with("\"hello\": 0.2", "\"hello\": 20")),
           "hero.json: /nodes/greet: its events are out of order, or beyond the clip's end");
    starts(error_of(with("\"left_shoulder\"", "\"tail\"")), "hero.json: /masks/arms/tail: there is no joint or role");
}

TEST_F(GraphFile, unknown_keys_are_reported) {
    std::vector<std::string> warnings;
    load_graph(write(with("\"loop\": false", "\"lop\": false")), &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("/nodes/greet: the key \"lop\" is not known"), std::string::npos) << warnings[0];
}

TEST_F(GraphFile, damaged_files_are_refused_or_sound) {
    Random random(7);
    int refused = 0;
    for (int i = 0; i < 150; ++i) {
        try {
            const Pack hero = load_graph(write(test::damaged(k_graph, random)));
            EXPECT_EQ(problem(hero.program), "");
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 50);
    EXPECT_LT(refused, 150);
}

TEST_F(GraphFile, a_live_gait_needs_no_project) {
    const Pack character = load_graph(write(R"({"surefoot_graph": 1,
        "parameters": {"speed": {"low": 0, "high": 5}}, "gaits": {"legs": "human"},
        "nodes": {"go": {"type": "gait", "gait": "legs", "speed": "speed", "manner": 0}}, "root": "go"})"));
    const Program& program = character.program;
    EXPECT_TRUE(character.legs.known());
    EXPECT_NEAR(character.hip_height, 0.95f, 0.15f);
    std::vector<std::byte> state(program.state_size);
    GraphScratch scratch(program);
    GraphFrame frame(program);
    std::vector<Transform> locals(program.body.skeleton->rest.size());
    start(program, state);
    set(program, state, program.parameter("speed"), 1.4f);
    for (int f = 0; f < 240; ++f) {
        GraphInput input;
        input.dt = 1.0f / 60;
        update(program, state, input, scratch, frame);
    }
    EXPECT_NEAR(frame.velocity.z, 1.4f, 1e-3f);
    pose(program, state, frame, scratch, locals);
    EXPECT_NEAR(locals[static_cast<std::size_t>(character.legs.hips)].translation.y, character.hip_height, 0.1f);
}

TEST_F(GraphFile, a_live_gait_joins_a_project_of_the_same_skeleton_only) {
    const auto graph = [](const std::string& gait) {
        return R"({"surefoot_graph": 1, "project": ".", "parameters": {"live": {"type": "flag"}},
            "nodes": {"both": {"type": "lerp", "weight": "live",
                "from": {"type": "locomotion", "speed": 1}, "to": {"type": "gait", "gait": ")" +
               gait + R"(", "speed": 1}}}, "root": "both"})";
    };
    EXPECT_EQ(load_graph(write(graph("walk"))).program.rigs.size(), 1u);
    EXPECT_EQ(error_of(graph("wlk")),
              "hero.json: /nodes/both/to/gait: wlk: there is no fitted gait of that name; see surefoot gait list");
    ClipSet set = make_synthetic_set();
    Skeleton renamed = *set.skeleton;
    renamed.names.back() += "_end";
    const auto skeleton = std::make_shared<const Skeleton>(renamed);
    for (Motion& clip : set.clips) clip.skeleton = skeleton;
    author_motions(set.clips, folder_.path);
    EXPECT_EQ(error_of(graph("walk")),
              "hero.json: the gait 'walk' is of another skeleton than the project's clips; fit one to it: surefoot fit "
              "CLIPS --to CHARACTER -o gait.json");
}

TEST(GaitGraph, is_a_live_gait_that_goes_as_its_parameters_say) {
    const auto rig = std::make_shared<const LiveRig>(read_live_rig("human"));
    const Pack human = gait_graph(rig, "human", 0);
    EXPECT_EQ(problem(human), "");
    const Program& program = human.program;
    GraphScratch scratch(program);
    GraphFrame frame(program);
    std::vector<std::byte> state(program.state_size);
    start(program, state);
    set(program, state, program.parameter("speed"), 1.4f);
    RootFrame root;
    for (int i = 0; i < 600; ++i) {
        GraphInput input;
        input.dt = 1.0f / 60;
        update(program, state, input, scratch, frame);
        root = root * frame.root_delta;
    }
    EXPECT_NEAR(frame.velocity.z, 1.4f, 1e-3f);
    EXPECT_GT(root.position.z, 12);
    EXPECT_EQ(program.parameters[static_cast<std::size_t>(program.parameter("manner"))].high, 1);  // it can crouch
}

TEST_F(GraphFile, every_key_of_the_schema_is_known) {
    std::vector<std::string> warnings;
    const std::string text = read_file(std::filesystem::path(SUREFOOT_SOURCE_DIR) / "tests/graph_text/whole.json");
    const Pack character = load_graph(write(text), &warnings);
    EXPECT_EQ(character.program.name, "whole");
    EXPECT_EQ(warnings, std::vector<std::string>{});
    std::string slip = text;
    slip.replace(slip.find("rate_per_s"), 10, "rate_per_h");
    load_graph(write(slip), &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("rate_per_h"), std::string::npos) << warnings[0];
}

TEST_F(GraphFile, is_read_from_memory_for_a_character_that_is_there_already) {
    const Pack from_file = load_graph(write(k_graph));
    const Character character = bake_character(load_project(folder_.path / "project.json"), folder_.path);
    const Pack read = read_graph(k_graph, "page", character);
    EXPECT_EQ(read.program.name, from_file.program.name);
    EXPECT_EQ(read.hip_height, from_file.hip_height);
    const auto play = [](const Program& program) {
        std::vector<std::byte> state(program.state_size);
        GraphScratch scratch(program);
        GraphFrame frame(program);
        start(program, state);
        set(program, state, program.parameter("speed"), 1.4f);
        for (int f = 0; f < 90; ++f) {
            if (f == 30) set(program, state, program.parameter("wave"), 1);
            GraphInput input;
            input.dt = 1.0f / 60;
            update(program, state, input, scratch, frame);
        }
        std::vector<Transform> locals(program.body.skeleton->rest.size());
        pose(program, state, frame, scratch, locals);
        return std::pair(state, locals);
    };
    EXPECT_EQ(play(read.program), play(from_file.program));
    const auto error = [&](const std::string& text) {
        try {
            read_graph(text, "page", character);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(error(R"({"surefoot_graph": 1, "extends": "other.json"})").find("page: /extends"), std::string::npos);
    EXPECT_NE(error("{").find("page"), std::string::npos);
    EXPECT_NE(error(R"({"surefoot_graph": 1, "nodes": {}, "root": "x"})").find("there is no node 'x'"),
              std::string::npos);
}

}  // namespace
}  // namespace surefoot
