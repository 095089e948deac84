#include <surefoot/base/error.h>
#include <surefoot/course/live_play.h>

#include <algorithm>

namespace surefoot {
namespace {

class LiveWalker final : public Walker {
  public:
    LiveWalker(const LiveRig& rig, std::vector<LiveLeg> legs)
        : rig_(rig), legs_(std::move(legs)), scratch_(rig), standing_(rig.stand.size()) {
        local_to_model(*rig.skeleton, rig.stand, standing_);
    }
    const std::shared_ptr<const Skeleton>& skeleton() const override { return rig_.skeleton; }
    const Legs& legs() const override { return rig_.soles; }
    std::span<const Transform> standing() const override { return standing_; }
    bool steered() const override { return legs_.size() > 1; }
    void start(float speed_mps) override {
        for (LiveLeg& leg : legs_)
            if (leg.request.speed != 0) leg.request.speed = speed_mps;
        leg_ = 0;
        spent_ = 0;
        state_ = surefoot::start(rig_, legs_.front().request);
        root_ = {};
    }
    void advance(float dt) noexcept override {
        constexpr float k_rounding = 1e-4f;  // [s]
        if (leg_ + 1 < legs_.size() && spent_ >= legs_[leg_].seconds - k_rounding) {
            ++leg_;
            spent_ = 0;
        }
        spent_ += dt;
        root_ = root_ * update(rig_, state_, legs_[leg_].request, dt).root_delta;
    }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        LiveState copy = state_;
        root = root_ * update(rig_, copy, legs_[leg_].request, ahead).root_delta;
        pose(rig_, copy, scratch_, locals);
    }

  private:
    const LiveRig& rig_;
    std::vector<LiveLeg> legs_;
    mutable LiveScratch scratch_;
    std::vector<Transform> standing_;
    LiveState state_;
    RootFrame root_;
    std::size_t leg_ = 0;
    float spent_ = 0;
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

std::vector<LiveLeg> live_path(const std::string& name, const LiveRequest& going, float seconds) {
    constexpr float k_turn = 30, k_circle = 360 / k_turn;  // [deg/s], [s]
    LiveRequest left = going, right = going, stand = going;
    left.turn = k_turn;
    right.turn = -k_turn;
    stand.speed = stand.turn = 0;
    std::vector<LiveLeg> legs;
    if (name == "straight") return {{going, seconds}};
    if (name == "curve") return {{left, seconds}};
    if (name == "eight") legs = {{left, k_circle}, {right, k_circle}};
    if (name == "start-stop") legs = {{stand, 1}, {going, 3}, {stand, 2.5f}};
    if (legs.empty())
        throw Error("there is no path '" + name + "'", "--path", "walk straight, curve, eight or start-stop");
    std::vector<LiveLeg> all;
    float whole = 0;
    for (const LiveLeg& leg : legs) whole += leg.seconds;
    for (float done = 0; done < seconds; done += whole) all.insert(all.end(), legs.begin(), legs.end());
    return all;
}

std::unique_ptr<Walker> make_live_walker(const LiveRig& rig, std::vector<LiveLeg> legs) {
    if (legs.empty()) throw Error("nothing is asked for", "live walker", "");
    return std::make_unique<LiveWalker>(rig, std::move(legs));
}

}  // namespace surefoot
