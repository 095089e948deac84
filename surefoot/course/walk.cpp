#include <surefoot/base/error.h>
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

/// Model space of a walker's pose with its toes out of its own ground: all rows and the flat twin walk on the same
/// toes.
void clean_models(const Walker& walker, const FootRig& rig, std::span<Transform> locals,
                  std::span<Transform> models) noexcept {
    local_to_model(*walker.skeleton(), locals, models);
    lift_toe_tips(rig, models, locals);
    local_to_model(*walker.skeleton(), locals, models);
}

/// Looks ahead through a walker; scratch is made once.
class WalkerPreview final : public LegPreview {
  public:
    WalkerPreview(const Walker& walker, const FootRig& rig)
        : walker_(walker),
          rig_(rig),
          locals_(static_cast<std::size_t>(walker.skeleton()->joint_count())),
          models_(locals_.size()) {}
    void sample(std::span<const float> ahead, std::span<LegsPose> legs,
                std::span<RootFrame> roots) const noexcept override {
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            walker_.look(ahead[i], roots[i], locals_);
            clean_models(walker_, rig_, locals_, models_);
            legs[i] = read_legs(rig_, models_);
        }
    }

  private:
    const Walker& walker_;
    const FootRig& rig_;
    mutable std::vector<Transform> locals_, models_;
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
    const FootRig rig = make_foot_rig(*walker.skeleton(), walker.legs(), walker.standing(), settings);
    const WalkerPreview preview(walker, rig);
    walker.limit_speed(k_no_speed_limit);
    walker.start(request.speed_mps);

    Walked walked;
    walked.motion = make_motion(walker.skeleton(), "walk", frames, k_walk_fps);
    FootPlacementState state;
    FootOutput output;
    std::vector<Transform> models(static_cast<std::size_t>(walked.motion.joint_count()));
    for (int f = 0; f < frames; ++f) {
        const std::span<Transform> locals = walked.motion.frame(f);
        RootFrame& root = walked.motion.root[static_cast<std::size_t>(f)];
        if (f) walker.advance(k_dt);
        walked.requested.push_back(walker.requested());
        walker.look(0, root, locals);
        root.position.y = height_at(ground, root.position.x, root.position.z);
        clean_models(walker, rig, locals, models);
        FootInput input;
        input.dt = f ? k_dt : 0;
        input.root = root;
        input.weight = walker.feet();
        input.legs = read_legs(rig, models);
        place_feet(rig, state, input, ground, &preview, output);
        apply(rig, output, models, locals);
        walked.speed_limit.push_back(speed_limit ? (*speed_limit)[static_cast<std::size_t>(f)] : output.speed_limit);
        walker.limit_speed(walked.speed_limit.back());
        for (std::size_t side = 0; side < 2; ++side) {
            walked.planted[side].push_back(output.planted[side]);
            if (output.planted[side]) walker.stand_on(output.surface[side]);
        }
    }
    walked.plans = state.plans;
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
    result.twin = keeping_pace(Plane(), FootMode::none);
    result.twin_track = make_track(result.twin.motion, result.legs);
    result.twin_figures = measure_twin(result.twin_track);
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
