// A graph: parameters, a trigger, events, and the state it is in.

#include "read_pack.h"

#include <surefoot/program/evaluate.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: state_machine X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Program& program = loaded.pack.program;  // shared by all characters of its kind

    if (!loaded.pack.has_program()) return std::fprintf(stderr, "%s was baked from no graph\n", argv[1]), 2;
    surefoot::GraphScratch scratch(program);  // one a thread
    surefoot::GraphFrame frame(program);
    std::vector<std::byte> state(program.state_size);  // one a character
    std::vector<surefoot::Transform> locals(program.body.skeleton->rest.size());
    surefoot::start(program, state);
    const int speed = program.parameter("speed"), pump = program.parameter("pump");
    const int machine = surefoot::find_node(program, "/nodes/hero");
    std::printf("%u bytes a character\n", program.state_size);

    surefoot::RootFrame root;
    std::string before;
    for (int i = 0; i < 300; ++i) {
        if (i == 0) surefoot::set(program, state, speed, 1.4f);
        if (i == 100) surefoot::set(program, state, pump, 1);
        surefoot::GraphInput input;
        input.dt = 1.0f / 60;
        input.root = root;
        surefoot::update(program, state, input, scratch, frame);
        root = root * frame.root_delta;
        surefoot::pose(program, state, frame, scratch, locals);

        const std::string now(surefoot::machine_state(program, state, machine));
        if (now != before) std::printf("%4.2f s  state %s\n", i / 60.0, now.c_str());
        before = now;
        for (const surefoot::GraphEvent& event : frame.events())
            std::printf("%4.2f s  %s\n", std::max(0.0, (i + 1) / 60.0 - static_cast<double>(event.ago)),
                        program.events[static_cast<std::size_t>(event.event)].c_str());
    }
    std::printf("walked %.2f m\n", static_cast<double>(root.position.z));
    return 0;
}
