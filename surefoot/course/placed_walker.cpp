#include <surefoot/course/placed_walker.h>
#include <surefoot/ground/shapes.h>

#include <utility>

namespace surefoot {
namespace {

/// Model space of a walker's pose with its toes out of its own ground: all rows and the flat twin walk on the same
/// toes.
void clean_models(const Walker& walker, const FootRig& rig, std::span<Transform> locals,
                  std::span<Transform> models) noexcept {
    local_to_model(*walker.skeleton(), locals, models);
    lift_toe_tips(rig, models, locals);
    local_to_model(*walker.skeleton(), locals, models);
}

}  // namespace

/// Looks ahead through a walker; scratch is made once.
class PlacedWalker::Preview final : public LegPreview {
  public:
    Preview(const Walker& walker, const FootRig& rig)
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

PlacedWalker::PlacedWalker(Walker& walker, const Ground& ground, const FootSettings& settings)
    : walker_(walker),
      ground_(ground),
      rig_(make_foot_rig(*walker.skeleton(), walker.legs(), walker.standing(), settings)),
      preview_(std::make_unique<Preview>(walker, rig_)),
      locals_(static_cast<std::size_t>(walker.skeleton()->joint_count())),
      models_(locals_.size()) {}

PlacedWalker::~PlacedWalker() = default;

void PlacedWalker::start(float speed_mps, float speed_limit) {
    walker_.limit_speed(k_no_speed_limit);
    walker_.start(speed_mps);
    state_ = {};
    output_ = {};
    forget_ = false;
    place(0, speed_limit);
}

void PlacedWalker::advance(float dt, float speed_limit) noexcept {
    walker_.advance(dt);
    place(dt, speed_limit);
}

void PlacedWalker::set_mode(FootMode mode) noexcept {
    if (rig_.settings.mode == mode) return;
    rig_.settings.mode = mode;
    output_ = {};
    forget_ = true;
}

void PlacedWalker::place(float dt, float speed_limit) noexcept {
    walker_.look(0, root_, locals_);
    root_.position.y = height_at(ground_, root_.position.x, root_.position.z);
    clean_models(walker_, rig_, locals_, models_);
    FootInput input;
    input.dt = dt;
    input.root = root_;
    input.weight = walker_.feet();
    input.legs = read_legs(rig_, models_);
    input.teleport = std::exchange(forget_, false);
    place_feet(rig_, state_, input, ground_, preview_.get(), output_);
    apply(rig_, output_, models_, locals_);
    limit_ = speed_limit == k_own_limit ? output_.speed_limit : speed_limit;
    walker_.limit_speed(limit_);
    for (std::size_t side = 0; side < 2; ++side)
        if (output_.planted[side]) walker_.stand_on(output_.surface[side]);
}

}  // namespace surefoot
