#include <surefoot/bake/character.h>
#include <surefoot/course/foresight.h>
#include <surefoot/course/walk.h>
#include <surefoot/math/trig.h>

#include <cstring>

namespace surefoot {
namespace {

/// A character on its way: what it is asked for is approached, and the rest follows.
struct Going {
    LocomotionState state;
    LocomotionRequest request, wanted;
    HostWay host;
    RootFrame root;

    LocomotionFrame go(const LocomotionGraph& graph, float dt) noexcept {
        request = approach(request, wanted, dt);
        const LocomotionFrame frame = update(graph, state, request, dt);
        root = root * frame.root_delta * host.in(dt);
        root.position.y = 0;
        return frame;
    }
    friend bool operator==(const Going& a, const Going& b) noexcept { return std::memcmp(&a, &b, sizeof a) == 0; }
};
static_assert(sizeof(Going) ==
                  sizeof(LocomotionState) + 2 * sizeof(LocomotionRequest) + sizeof(HostWay) + sizeof(RootFrame),
              "no padding: compared as bytes");

class CharacterWalker final : public Walker {
  public:
    CharacterWalker(const Character& character, const LocomotionRequest& asked, std::vector<PathLeg> path)
        : character_(character), asked_(asked), steering_(std::move(path)) {}
    const std::shared_ptr<const Skeleton>& skeleton() const override { return character_.skeleton; }
    const Legs& legs() const override { return character_.legs; }
    std::span<const Transform> standing() const override { return character_.standing; }
    void start(float speed_mps) override {
        asked_.speed = speed_mps;
        asked_.lateral = 0;
        steering_.restart();
        now_ = {};
        requested_ = {};
        now_.request = wanted();
        ask();
        plays_ = Going(now_).go(character_.graph, 0);
    }
    void advance(float dt) noexcept override {
        steering_.advance(dt);
        ask();
        plays_ = now_.go(character_.graph, dt);
        const LocomotionRequest& asked = now_.request;
        requested_ = requested_ * integrate({asked.lateral, 0, asked.speed}, asked.turn * k_radians_per_degree, dt) *
                     now_.host.in(dt);
        foresight_.go_on(now_);
    }
    void limit_speed(float mps) noexcept override {
        steering_.limit_speed(mps);
        ask();
    }
    void steer(const LocomotionRequest& asked) noexcept override {
        asked_ = asked;
        steering_.take_over(asked.turn);
        ask();
    }
    void put(const RootFrame& root) noexcept override {
        now_.root = root;
        now_.root.position.y = 0;
        requested_ = now_.root;
        foresight_.begin(now_);
    }
    RootFrame requested() const noexcept override { return requested_; }
    bool has_host() const noexcept override { return steering_.has_host(); }
    std::span<const Leaf> playing() const noexcept override { return plays_.leaves(); }
    /// What comes is foreseen from what is asked for now: no later leg of the path is known.
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        LocomotionFrame frame;
        const Going& there =
            foresight_.at(ahead, [&](Going& going, float dt) noexcept { frame = going.go(character_.graph, dt); });
        root = there.root;
        pose(character_.graph, frame, locals);
    }
    std::uint64_t moment(float ahead) const noexcept override { return foresight_.number(ahead); }

  private:
    /// Tells who is on the way what it is to do from now on.
    void ask() noexcept {
        now_.wanted = wanted();
        now_.host = steering_.host();
        foresight_.go_on(now_);
    }
    LocomotionRequest wanted() const noexcept {
        LocomotionRequest wanted = asked_;
        wanted.speed = steering_.speed(asked_.speed);
        wanted.lateral = steering_.speed(asked_.lateral);
        wanted.turn = steering_.turn();
        return wanted;
    }

    const Character& character_;
    LocomotionRequest asked_;
    Steering steering_;
    Going now_;
    LocomotionFrame plays_;
    RootFrame requested_;
    mutable Foresight<Going> foresight_;
};

}  // namespace

std::unique_ptr<Walker> make_character_walker(const Character& character, const LocomotionRequest& asked,
                                              std::vector<PathLeg> path) {
    return std::make_unique<CharacterWalker>(character, asked, std::move(path));
}

}  // namespace surefoot
