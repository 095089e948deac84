// A tool's view: the authoring library. Makes a motion on a skeleton of its own and reads it back in world space.
#include <surefoot/host/parallel.h>
#include <surefoot/motion/motion.h>

#include <cstdio>
#include <vector>

int main() {
    auto skeleton = std::make_shared<surefoot::Skeleton>();
    skeleton->add("hips", surefoot::k_no_joint, {});
    const surefoot::Motion motion = surefoot::make_motion(skeleton, "still", 8, 30);

    std::vector<surefoot::Transform> world(8);
    surefoot::parallel_for(
        8, [&](std::size_t f) { surefoot::world_pose(motion, static_cast<int>(f), std::span(world).subspan(f, 1)); });
    const bool fine = surefoot::problem(motion).empty() && world[7] == world[0];
    std::puts(fine ? "authoring works" : "authoring is broken");
    return fine ? 0 : 1;
}
