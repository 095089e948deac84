#include <surefoot/bake/character.h>
#include <surefoot/course/walk.h>
#include <surefoot/math/trig.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_step = 1 / k_walk_fps;  // [s] in which what comes is foreseen

/// A character on its way: what it is asked for is approached, and the rest follows.
struct Going {
    LocomotionState state;
    LocomotionRequest request;
    RootFrame root, requested;

    LocomotionFrame go(const LocomotionGraph& graph, const LocomotionRequest& wanted, float dt) noexcept {
        request = approach(request, wanted, dt);
        const LocomotionFrame frame = update(graph, state, request, dt);
        root = root * frame.root_delta;
        root.position.y = 0;
        const Vec3 velocity{request.lateral, 0, request.speed};
        requested = requested * integrate(velocity, request.turn * k_radians_per_degree, dt);
        return frame;
    }
};

class CharacterWalker final : public Walker {
  public:
    CharacterWalker(const Character& character, const LocomotionRequest& asked, std::vector<PathLeg> path)
        : character_(character), asked_(asked), path_(std::move(path)) {}
    const std::shared_ptr<const Skeleton>& skeleton() const override { return character_.skeleton; }
    const Legs& legs() const override { return character_.legs; }
    std::span<const Transform> standing() const override { return character_.standing; }
    void start(float speed_mps) override {
        asked_.speed = speed_mps;
        asked_.lateral = 0;
        clock_ = {};
        now_ = {};
        now_.request = wanted();
        foreseen_ = now_;
        ahead_ = 0;
    }
    void advance(float dt) noexcept override {
        clock_.advance(path_, dt);
        now_.go(character_.graph, wanted(), dt);
        foreseen_ = now_;
        ahead_ = 0;
    }
    RootFrame requested() const noexcept override { return now_.requested; }
    /// What comes is foreseen from what is asked for now: no later leg of the path is known.
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        if (ahead < ahead_) foreseen_ = now_, ahead_ = 0;
        for (; ahead_ + k_step <= ahead + k_rounding; ahead_ += k_step)
            foreseen_.go(character_.graph, wanted(), k_step);
        Going going = foreseen_;
        const LocomotionFrame frame = going.go(character_.graph, wanted(), std::max(ahead - ahead_, 0.0f));
        root = going.root;
        pose(character_.graph, frame, locals);
    }

  private:
    static constexpr float k_rounding = 1e-5f;  // [s]
    LocomotionRequest wanted() const noexcept {
        LocomotionRequest wanted = asked_;
        const PathLeg& leg = clock_.leg(path_);
        wanted.speed = leg.goes ? asked_.speed : 0;
        wanted.turn = leg.turn;
        return wanted;
    }

    const Character& character_;
    LocomotionRequest asked_;
    std::vector<PathLeg> path_;
    PathClock clock_;
    Going now_;
    mutable Going foreseen_;  // `now_` and `ahead_` seconds more: what is asked next mostly lies a little farther
    mutable float ahead_ = 0;
};

}  // namespace

std::unique_ptr<Walker> make_character_walker(const Character& character, const LocomotionRequest& asked,
                                              std::vector<PathLeg> path) {
    if (path.empty()) path.push_back({});
    return std::make_unique<CharacterWalker>(character, asked, std::move(path));
}

}  // namespace surefoot
