#include <surefoot/bake/character.h>
#include <surefoot/course/walk.h>

namespace surefoot {
namespace {

class CharacterWalker final : public Walker {
  public:
    CharacterWalker(const Character& character, const LocomotionRequest& asked)
        : character_(character), request_(asked) {}
    const std::shared_ptr<const Skeleton>& skeleton() const override { return character_.skeleton; }
    const Legs& legs() const override { return character_.legs; }
    std::span<const Transform> standing() const override { return character_.standing; }
    void start(float speed_mps) override {
        request_.speed = speed_mps;
        request_.turn = request_.lateral = 0;
        state_ = {};
        root_ = {};
    }
    void advance(float dt) noexcept override {
        root_ = root_ * update(character_.graph, state_, request_, dt).root_delta;
        root_.position.y = 0;
    }
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        LocomotionState copy = state_;
        const LocomotionFrame frame = update(character_.graph, copy, request_, ahead);
        root = root_ * frame.root_delta;
        root.position.y = 0;
        pose(character_.graph, frame, locals);
    }

  private:
    const Character& character_;
    LocomotionRequest request_;
    LocomotionState state_;
    RootFrame root_;
};

}  // namespace

std::unique_ptr<Walker> make_character_walker(const Character& character, const LocomotionRequest& asked) {
    return std::make_unique<CharacterWalker>(character, asked);
}

}  // namespace surefoot
