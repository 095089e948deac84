// A clip of a pack, sampled: no graph, no blend space, only keyframes and a time.

#include "read_pack.h"

#include <surefoot/clip/sample.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: play_a_clip X.sfpack CLIP\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Pack& hero = loaded.pack;
    const std::vector<surefoot::PackedClip>& clips = hero.graph().clips;
    const int index = hero.clip(argv[2]);
    if (index < 0) {
        std::fprintf(stderr, "%s has no clip '%s'; it has", argv[1], argv[2]);
        for (const surefoot::PackedClip& clip : clips) std::fprintf(stderr, " %s", clip.name.c_str());
        return std::fprintf(stderr, "\n"), 2;
    }
    const surefoot::PackedClip& clip = clips[static_cast<std::size_t>(index)];
    std::printf("%s: %.2f s, %d frames, goes %.2f m/s and turns %.0f deg/s\n", clip.name.c_str(),
                static_cast<double>(clip.duration()), clip.frame_count, static_cast<double>(clip.velocity.z),
                static_cast<double>(clip.turn_rate) * 57.29578);

    const surefoot::Skeleton& skeleton = hero.skeleton();
    std::vector<surefoot::Transform> locals(skeleton.rest.size()), models(locals.size());
    const int hips = hero.roles[surefoot::Role::hips];
    for (int i = 0; i <= 4; ++i) {
        const surefoot::Leaf leaf{index, clip.duration() * static_cast<float>(i) / 4, 1};
        surefoot::sample_pose(skeleton, clips, {&leaf, 1}, locals);
        surefoot::local_to_model(skeleton, locals, models);
        const surefoot::RootFrame root = surefoot::clip_root(clip, leaf.time);
        if (hips != surefoot::k_no_joint)
            std::printf("at %.2f s the root has gone %.2f m and the hips are %.3f m high\n",
                        static_cast<double>(leaf.time), static_cast<double>(root.position.z),
                        static_cast<double>(models[static_cast<std::size_t>(hips)].translation.y));
    }
    return 0;
}
