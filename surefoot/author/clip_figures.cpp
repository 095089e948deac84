#include <surefoot/author/clip_figures.h>
#include <surefoot/author/place.h>
#include <surefoot/host/parallel.h>
#include <surefoot/motion/edit.h>
#include <surefoot/pack/pack_clip.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr int k_most_sole_samples = 96;  // more than a small plot has pixels

std::array<std::vector<float>, 2> sole_heights(const AnalyzedClip& clip) {
    std::array<std::vector<float>, 2> heights;
    const Motion& motion = clip.motion;
    const int count = std::clamp(motion.frame_count(), 2, k_most_sole_samples);
    std::vector<Transform> locals(static_cast<std::size_t>(motion.joint_count())), models(locals.size());
    for (int n = 0; n < count; ++n) {
        RootFrame root;
        // A hair before the end, where a cyclic clip would begin anew.
        const float share = std::min(static_cast<float>(n) / static_cast<float>(count - 1), 0.9999f);
        sample(motion, share * motion.duration(), root, locals);
        local_to_model(*motion.skeleton, locals, models);
        for (std::size_t side = 0; side < 2; ++side) {
            const Leg& leg = clip.legs.side[side];
            const Transform& foot = models[static_cast<std::size_t>(leg.foot)];
            const Transform& toes = leg.toes == k_no_joint ? foot : models[static_cast<std::size_t>(leg.toes)];
            const SolePoints sole = sole_points(leg, foot, toes);
            heights[side].push_back(std::min({sole.heel.y, sole.mid.y, sole.ball.y, sole.toe_tip.y}));
        }
    }
    return heights;
}

PackedClip packed_for(const Project& project, std::int32_t index, const AnalyzedClip& clip,
                      const ClipFigures& figures) {
    const Skeleton& skeleton = *figures.skeleton;
    if (!same_joints(*clip.motion.skeleton, skeleton)) return {};
    Motion motion = clip.motion;
    motion.skeleton = figures.skeleton;  // rest poses may differ: translations then move
    PackOptions options;
    options.legs = &figures.legs;
    options.along_travel = moves_along_facing(project.spaces, index, clip.facts);
    return pack_clip(motion, clip.facts, options);
}

/// The clip that stands most nearly still, of those that the spaces use.
const AnalyzedClip* calmest(const Project& project, std::span<const AnalyzedClip* const> clips) {
    std::vector<bool> used(clips.size());
    for (const ProjectSpace& space : project.spaces)
        for (const int clip : space.clips)
            if (static_cast<std::size_t>(clip) < used.size()) used[static_cast<std::size_t>(clip)] = true;
    const AnalyzedClip* best = nullptr;
    for (std::size_t i = 0; i < clips.size(); ++i)
        if (used[i] && clips[i] != nullptr &&
            (best == nullptr || liveliness(clips[i]->facts) < liveliness(best->facts)))
            best = clips[i];
    return best;
}

void take_body(ClipFigures& figures, const AnalyzedClip& clip) {
    figures.roles = clip.roles.roles;
    figures.legs = clip.legs;
    figures.standing.resize(static_cast<std::size_t>(clip.motion.joint_count()));
    local_to_model(*clip.motion.skeleton, clip.motion.frame(0), figures.standing);
}

}  // namespace

ClipFigures make_clip_figures(const Project& project, std::span<const AnalyzedClip* const> clips) {
    ClipFigures figures;
    figures.clips.resize(project.clips.size());
    const AnalyzedClip* body = calmest(project, clips);
    const auto first =
        std::find_if(clips.begin(), clips.end(), [](const AnalyzedClip* clip) { return clip != nullptr; });
    if (first == clips.end() || body == nullptr) return figures;
    figures.skeleton = (*first)->motion.skeleton;
    take_body(figures, *body);
    float tallest = 0;  // one may crouch
    for (const AnalyzedClip* clip : clips)
        if (clip != nullptr) tallest = std::max(tallest, clip->facts.height);
    if (tallest > 0) figures.height = tallest;
    parallel_for(std::min(clips.size(), figures.clips.size()), [&](std::size_t i) {
        if (clips[i] == nullptr) return;
        figures.clips[i].sole = sole_heights(*clips[i]);
        figures.clips[i].packed = packed_for(project, static_cast<std::int32_t>(i), *clips[i], figures);
    });
    return figures;
}

}  // namespace surefoot
