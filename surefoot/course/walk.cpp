#include <surefoot/base/error.h>
#include <surefoot/course/placed_walker.h>
#include <surefoot/course/walk.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/motion/edit.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_dt = 1 / k_walk_fps;

class ClipWalker final : public Walker {
  public:
    ClipWalker(const Motion& clip, const Legs& legs) : clip_(clip), legs_(legs) {
        start_at_origin(clip_);
        clip_.cyclic = true;
        standing_.resize(static_cast<std::size_t>(clip_.joint_count()));
        local_to_model(*clip_.skeleton, clip_.frame(0), standing_);
    }
    const std::shared_ptr<const Skeleton>& skeleton() const override { return clip_.skeleton; }
    const Legs& legs() const override { return legs_; }
    std::span<const Transform> standing() const override { return standing_; }
    void start(float speed_mps) override {
        constexpr float k_travels = 0.1f;  // [m/s]
        const float own = planar_length(clip_.root.back().position) / std::max(clip_.duration(), 1e-6f);
        rate_ = own > k_travels && speed_mps != 0 ? std::fabs(speed_mps) / own : 1;
        time_ = 0;
        speed_ = speed_mps;
    }
    RootFrame requested() const noexcept override {
        return {{0, 0, speed_ * static_cast<float>(time_ / static_cast<double>(rate_))}, 0};
    }
    void advance(float dt) noexcept override { time_ += static_cast<double>(dt * rate_); }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        sample(clip_, static_cast<float>(time_ + static_cast<double>(ahead * rate_)), root, locals);
        root.position.y = 0;
    }

  private:
    Motion clip_;
    Legs legs_;
    std::vector<Transform> standing_;
    float rate_ = 1, speed_ = 0;
    double time_ = 0;
};

}  // namespace

std::unique_ptr<Walker> make_clip_walker(const Motion& clip, const Legs& legs) {
    if (clip.frame_count() < 2)
        throw Error("a clip of one frame does not walk", "clip '" + clip.name + "'", "choose a cycle");
    return std::make_unique<ClipWalker>(clip, legs);
}

Walked walk(Walker& walker, const Ground& ground, const WalkRequest& request, const std::vector<float>* speed_limit) {
    constexpr float k_longest = 3600;  // [s]
    if (!(request.seconds > 0 && request.seconds <= k_longest))
        throw Error("a walk lasts more than 0 and at most 3600 seconds", "walk", "");
    const int frames = static_cast<int>(std::lround(request.seconds * k_walk_fps)) + 1;
    if (speed_limit && speed_limit->size() != static_cast<std::size_t>(frames))
        throw Error("a walk needs one speed limit a frame", "walk", "");
    FootSettings settings;
    settings.mode = request.mode;
    settings.limit_pace = request.limit_pace;
    settings.lean = request.lean;
    PlacedWalker placed(walker, ground, settings);
    const auto limit_of = [&](std::size_t f) { return speed_limit ? (*speed_limit)[f] : k_own_limit; };

    Walked walked;
    walked.motion = make_motion(walker.skeleton(), "walk", frames, k_walk_fps);
    for (int f = 0; f < frames; ++f) {
        const auto at = static_cast<std::size_t>(f);
        if (f)
            placed.advance(k_dt, limit_of(at));
        else
            placed.start(request.speed_mps, limit_of(at));
        std::copy(placed.locals().begin(), placed.locals().end(), walked.motion.frame(f).begin());
        walked.motion.root[at] = placed.root();
        walked.requested.push_back(walker.requested());
        walked.speed_limit.push_back(placed.speed_limit());
        for (std::size_t side = 0; side < 2; ++side) walked.planted[side].push_back(placed.feet().planted[side]);
    }
    walked.plans = placed.state().plans;
    return walked;
}

WalkComparison compare_modes(Walker& walker, const Ground& ground, float speed_mps, float seconds, bool limit_pace,
                             std::span<const FootMode> modes) {
    WalkComparison result;
    result.legs = walker.legs();
    const WalkRequest request{speed_mps, seconds, FootMode::surefoot, limit_pace};
    const Walked ours = walk(walker, ground, request);
    const auto keeping_pace = [&](const Ground& over, FootMode mode) {
        return walk(walker, over, {speed_mps, seconds, mode, limit_pace}, &ours.speed_limit);
    };
    result.twin = keeping_pace(Plane(), walker.has_host() ? FootMode::surefoot : FootMode::none);
    result.twin_track = make_track(result.twin.motion, result.legs);
    result.twin_figures = measure_twin(result.twin_track);
    result.twin_metrics = measure_walk(result.twin_track, result.twin_track, Plane(), result.twin.requested.back());
    for (const FootMode mode : modes) {
        const auto i = static_cast<std::size_t>(mode);
        result.walked[i] = mode == FootMode::surefoot ? ours : keeping_pace(ground, mode);
        result.tracks[i] = make_track(result.walked[i].motion, result.legs);
        result.metrics[i] =
            measure_walk(result.tracks[i], result.twin_track, ground, result.walked[i].requested.back());
    }
    return result;
}

}  // namespace surefoot
