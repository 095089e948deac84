// Saving, rolling back and replaying, as netcode does: a state is copied like a number.

#include "read_pack.h"

#include <cstdio>
#include <cstring>
#include <vector>

namespace {

struct Snapshot {
    surefoot::LocomotionState state;
    surefoot::LocomotionRequest request;
    surefoot::RootFrame root;
};

/// One frame of the game; `stick` is what the player did in it.
void play(const surefoot::LocomotionGraph& graph, Snapshot& now, float stick,
          std::span<surefoot::Transform> locals) noexcept {
    constexpr float dt = 1.0f / 60;
    now.request = surefoot::approach(now.request, {.speed = stick, .turn = 20 * stick}, dt);
    const surefoot::LocomotionFrame frame = surefoot::update(graph, now.state, now.request, dt);
    now.root = now.root * frame.root_delta;
    surefoot::pose(graph, frame, locals);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: rollback X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Pack& hero = loaded.pack;
    std::vector<surefoot::Transform> first(hero.skeleton().rest.size()), again(first.size());

    const auto stick = [](int frame) { return frame % 120 < 60 ? 1.5f : 0.3f; };
    Snapshot now, saved;
    for (int frame = 0; frame < 600; ++frame) {
        if (frame == 500) saved = now;  // 248 bytes and what the game adds
        play(hero.graph(), now, stick(frame), first);
    }
    Snapshot replayed = saved;
    for (int frame = 500; frame < 600; ++frame) play(hero.graph(), replayed, stick(frame), again);

    const bool same = std::memcmp(first.data(), again.data(), first.size() * sizeof(first[0])) == 0 &&
                      now.state == replayed.state && now.root == replayed.root;
    std::printf("rolled back 100 frames and played again: %s\n", same ? "the same to the bit" : "DIFFERENT");
    return same ? 0 : 1;
}
