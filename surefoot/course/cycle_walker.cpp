#include <surefoot/base/error.h>
#include <surefoot/course/cycle_walker.h>
#include <surefoot/motion/edit.h>

#include <cmath>
#include <utility>

namespace surefoot {
namespace {

Motion made_ready(Motion cycle) {
    if (cycle.frame_count() < 2)
        throw Error("a clip of one frame does not walk", "clip '" + cycle.name + "'", "choose a cycle");
    start_at_origin(cycle);
    cycle.cyclic = true;
    return cycle;
}

}  // namespace

CycleWalker::CycleWalker(Motion cycle, const Legs& legs) : cycle_(made_ready(std::move(cycle))), legs_(legs) {
    stand();
}

void CycleWalker::stand() {
    standing_.resize(static_cast<std::size_t>(cycle_.joint_count()));
    scratch_.resize(standing_.size());
    local_to_model(*cycle_.skeleton, cycle_.frame(0), standing_);
}

void CycleWalker::change(Motion cycle, const Legs& legs) {
    Motion next = made_ready(std::move(cycle));
    RootFrame here, there;
    look(0, here, scratch_);
    const double done = share();
    cycle_ = std::move(next);
    legs_ = legs;
    stand();
    time_ = done * static_cast<double>(cycle_.duration());
    sample(cycle_, static_cast<float>(time_), there, scratch_);
    origin_ = here * between(there, {});
    origin_.position.y = 0;
}

double CycleWalker::share() const noexcept {
    const double cycles = time_ / static_cast<double>(cycle_.duration());
    return cycles - std::floor(cycles);
}

void CycleWalker::start(float /*speed_mps*/) {
    origin_ = {};
    time_ = 0;
}

RootFrame CycleWalker::requested() const noexcept {
    RootFrame root;
    look(0, root, scratch_);
    return root;
}

void CycleWalker::look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept {
    sample(cycle_, static_cast<float>(time_ + static_cast<double>(ahead)), root, locals);
    root = origin_ * root;
    root.position.y = 0;
}

}  // namespace surefoot
