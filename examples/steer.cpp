// A blend space with a stick: speed and turn in, pose and root motion out.

#include "read_pack.h"

#include <surefoot/graph/locomotion.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: steer X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Pack& hero = loaded.pack;

    surefoot::LocomotionState state;      // all that the character remembers
    surefoot::LocomotionRequest request;  // what it is doing
    surefoot::RootFrame root;             // where it is
    std::vector<surefoot::Transform> locals(hero.skeleton().rest.size());
    constexpr float dt = 1.0f / 60;
    for (int frame = 0; frame < 600; ++frame) {
        // The stick: ahead, then ahead and to the left, then let go.
        surefoot::LocomotionRequest stick;
        if (frame < 400) stick.speed = 1.4f;
        if (frame >= 200 && frame < 400) stick.turn = 45;
        request = surefoot::approach(request, stick, dt);

        const surefoot::LocomotionFrame step = surefoot::update(hero.graph(), state, request, dt);
        root = root * step.root_delta;
        surefoot::pose(hero.graph(), step, locals);  // then foot placement, then local_to_model, then skinning

        if (frame % 100 == 99)
            std::printf("%4.1f s  at (%5.2f, %5.2f) m, heading %4.0f deg, %4.2f m/s, %d clips\n", (frame + 1) / 60.0,
                        static_cast<double>(root.position.x), static_cast<double>(root.position.z),
                        static_cast<double>(root.yaw) * 57.29578, static_cast<double>(step.velocity.z),
                        step.leaf_count);
    }
    return 0;
}
