#include <surefoot/course/rolling_metrics.h>

#include <cmath>

namespace surefoot {
namespace {

constexpr float k_least_seconds = 2;

void keep(std::deque<TrackFrame>& frames, const TrackFrame& frame, std::size_t most) {
    frames.push_back(frame);
    if (frames.size() > most) frames.pop_front();
}

WalkTrack track_of(const std::deque<TrackFrame>& frames) { return {k_walk_fps, {frames.begin(), frames.end()}}; }

}  // namespace

RollingMetrics::RollingMetrics(float seconds)
    : most_(static_cast<std::size_t>(std::lround(std::fmax(seconds, k_least_seconds) * k_walk_fps))) {}

void RollingMetrics::clear() noexcept {
    walked_.clear();
    twin_.clear();
}

void RollingMetrics::add(const PlacedWalker& placed, const Legs& legs) {
    const RootFrame& root = placed.root();
    const Skeleton& skeleton = placed.skeleton();
    const auto frame_of = [&](const RootFrame& at) {
        const Transform frame = to_transform(at);
        for (Transform& joint : world_) joint = frame * joint;
        return track_frame(at, world_, legs);
    };
    world_.resize(placed.locals().size());
    local_to_model(skeleton, placed.locals(), world_);
    keep(walked_, frame_of(root), most_);
    RootFrame flat = root;
    flat.position.y = 0;
    world_.assign(placed.unplaced().begin(), placed.unplaced().end());
    keep(twin_, frame_of(flat), most_);
}

std::optional<MeasuredWalk> RollingMetrics::measure(const Ground& ground, const WalkInfo& info, FootMode mode) const {
    if (static_cast<float>(walked_.size()) < k_least_seconds * k_walk_fps) return {};
    const WalkTrack walked = track_of(walked_), twin = track_of(twin_);
    MeasuredWalk measured;
    measured.info = info;
    measured.mode = mode;
    measured.metrics = measure_walk(walked, twin, ground, walked.frames.back().root);
    measured.twin = measure_twin(twin);
    return measured;
}

}  // namespace surefoot
