#include <surefoot/course/live_play.h>

namespace surefoot {
namespace {

class LiveWalker final : public Walker {
  public:
    LiveWalker(const LiveRig& rig, const LiveRequest& going, std::vector<PathLeg> path)
        : rig_(rig), going_(going), steering_(std::move(path)), scratch_(rig), standing_(rig.stand.size()) {
        local_to_model(*rig.skeleton, rig.stand, standing_);
    }
    const std::shared_ptr<const Skeleton>& skeleton() const override { return rig_.skeleton; }
    const Legs& legs() const override { return rig_.soles; }
    std::span<const Transform> standing() const override { return standing_; }
    void start(float speed_mps) override {
        going_.speed = speed_mps;
        steering_.restart();
        state_ = surefoot::start(rig_, wanted());
        root_ = {};
    }
    void advance(float dt) noexcept override {
        steering_.advance(dt);
        root_ = root_ * update(rig_, state_, wanted(), dt).root_delta * steering_.host().in(dt);
    }
    void limit_speed(float mps) noexcept override { steering_.limit_speed(mps); }
    /// Live gaits glide to what they are asked for, and the glide is what there is to obey.
    RootFrame requested() const noexcept override { return root_; }
    bool has_host() const noexcept override { return steering_.has_host(); }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        LiveState copy = state_;
        root = root_ * update(rig_, copy, wanted(), ahead).root_delta * steering_.host().in(ahead);
        pose(rig_, copy, scratch_, locals);
    }

  private:
    LiveRequest wanted() const noexcept {
        LiveRequest wanted = going_;
        wanted.speed = steering_.speed(going_.speed);
        wanted.turn = steering_.turn();
        return wanted;
    }

    const LiveRig& rig_;
    LiveRequest going_;
    Steering steering_;
    mutable LiveScratch scratch_;
    std::vector<Transform> standing_;
    LiveState state_;
    RootFrame root_;
};

}  // namespace

Motion play(const LiveRig& rig, const std::vector<LiveLeg>& legs, float fps, float phase) {
    int frames = 1;
    for (const LiveLeg& leg : legs) frames += static_cast<int>(leg.seconds * fps + 0.5f);
    Motion motion = make_motion(rig.skeleton, "live", frames, fps);
    LiveScratch scratch(rig);
    LiveState state = start(rig, legs.front().request, phase);
    pose(rig, state, scratch, motion.frame(0));
    int f = 1;
    for (const LiveLeg& leg : legs)
        for (int left = static_cast<int>(leg.seconds * fps + 0.5f); left > 0; --left, ++f) {
            const auto at = static_cast<std::size_t>(f);
            motion.root[at] = motion.root[at - 1] * update(rig, state, leg.request, 1 / fps).root_delta;
            pose(rig, state, scratch, motion.frame(f));
        }
    return motion;
}

std::unique_ptr<Walker> make_live_walker(const LiveRig& rig, const LiveRequest& going, std::vector<PathLeg> path) {
    return std::make_unique<LiveWalker>(rig, going, std::move(path));
}

}  // namespace surefoot
