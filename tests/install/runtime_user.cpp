// A game's view: only the runtime library. Blends three gaits and runs a skeleton forward.
#include <surefoot/math/trig.h>
#include <surefoot/rig/skeleton.h>
#include <surefoot/space/blend_space.h>

#include <cmath>
#include <cstdio>

int main() {
    surefoot::BlendSpace space;
    space.axes = {{"speed", "m/s", 0, 4, false}};
    space.samples = {{0}, {1.4f}, {4}};
    space.simplices = {{0, 1, -1, -1, -1}, {1, 2, -1, -1, -1}};
    space.neighbours = {{1, -1, -1, -1, -1}, {-1, 0, -1, -1, -1}};
    const surefoot::BlendWeights weights = surefoot::blend_weights(space, {0.7f});

    surefoot::Skeleton skeleton;
    skeleton.add("hips", surefoot::k_no_joint, {});
    skeleton.add("knee", 0, {});

    const bool fine = weights.count == 2 && std::fabs(weights.weights[0] - 0.5f) < 1e-6f &&
                      surefoot::problem(skeleton).empty() && surefoot::sin(0.0) == 0.0;
    std::puts(fine ? "runtime works" : "runtime is broken");
    return fine ? 0 : 1;
}
