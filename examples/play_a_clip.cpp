// A clip from a file, measured, packed for the runtime, and sampled.

#include <surefoot/analysis/analyze.h>
#include <surefoot/base/error.h>
#include <surefoot/clip/sample.h>
#include <surefoot/io/load.h>
#include <surefoot/pack/pack_clip.h>

#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) try {
    if (argc != 2) return std::fprintf(stderr, "usage: play_a_clip FILE\n"), 2;
    const std::string paths[] = {argv[1]};
    surefoot::LoadResult loaded = surefoot::load_clips(paths);
    if (!loaded.failed.empty()) return std::fprintf(stderr, "%s\n", loaded.failed.front().error.c_str()), 2;

    const surefoot::LoadedClip& source = loaded.clips.front();
    const surefoot::AnalyzedClip clip = surefoot::analyze_clip(source.motion, source.file, source.unit_scale);
    std::printf("%s goes %.2f m/s and turns %.0f deg/s\n", clip.motion.name.c_str(),
                static_cast<double>(clip.facts.speed), static_cast<double>(clip.facts.turn));

    surefoot::PackReport report;
    const std::vector<surefoot::PackedClip> clips{surefoot::pack_clip(clip.motion, clip.facts, {}, &report)};
    std::printf("packed %zu bytes into %zu, no farther off than %.3f mm\n", report.raw_bytes, report.bytes,
                static_cast<double>(report.error) * 1000);

    const surefoot::Skeleton& skeleton = *clip.motion.skeleton;
    std::vector<surefoot::Transform> locals(skeleton.rest.size()), models(locals.size());
    const int hips = clip.roles.roles[surefoot::Role::hips];
    for (int i = 0; i <= 4; ++i) {
        const surefoot::Leaf leaf{0, clips[0].duration() * static_cast<float>(i) / 4, 1};
        surefoot::sample_pose(skeleton, clips, {&leaf, 1}, locals);
        surefoot::local_to_model(skeleton, locals, models);
        if (hips != surefoot::k_no_joint)
            std::printf("at %.2f s the hips are %.3f m high\n", static_cast<double>(leaf.time),
                        static_cast<double>(models[static_cast<std::size_t>(hips)].translation.y));
    }
    return 0;
} catch (const surefoot::Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
}
