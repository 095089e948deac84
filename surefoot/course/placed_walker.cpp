#include <surefoot/course/placed_walker.h>
#include <surefoot/ground/shapes.h>

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

/// Joints that legs are read from, and all above them, parents first.
std::vector<int> leg_chain(const FootRig& rig) {
    std::vector<bool> wanted(rig.parents.size(), false);
    for (const Leg& leg : rig.legs.side)
        for (const int end : {leg.foot, leg.toes})
            for (int j = end; j >= 0; j = rig.parents[static_cast<std::size_t>(j)])
                wanted[static_cast<std::size_t>(j)] = true;
    std::vector<int> chain;
    for (std::size_t j = 0; j < wanted.size(); ++j)
        if (wanted[j]) chain.push_back(static_cast<int>(j));
    return chain;
}

}  // namespace

/// Looks ahead through a walker, at each moment once; scratch is made once.
class PlacedWalker::Preview final : public LegPreview {
  public:
    Preview(const Walker& walker, const FootRig& rig)
        : walker_(walker),
          rig_(rig),
          chain_(leg_chain(rig)),
          locals_(static_cast<std::size_t>(walker.skeleton()->joint_count())),
          models_(locals_.size()),
          seen_(k_seen) {}
    void sample(std::span<const float> ahead, std::span<LegsPose> legs,
                std::span<RootFrame> roots) const noexcept override {
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            const std::uint64_t moment = walker_.moment(ahead[i]);
            Seen& seen = seen_[moment % k_seen];
            if (moment == 0 || seen.moment != moment) {
                look(ahead[i], seen);
                seen.moment = moment;
            }
            legs[i] = seen.legs;
            roots[i] = seen.root;
        }
    }

  private:
    struct Seen {
        std::uint64_t moment = 0;
        RootFrame root;
        LegsPose legs;
    };
    static constexpr std::size_t k_seen = 128;  // more than foot placement looks at between two frames

    void look(float ahead, Seen& seen) const noexcept {
        walker_.look(ahead, seen.root, locals_);
        run_forward();
        lift_toe_tips(rig_, models_, locals_);
        for (const Leg& leg : rig_.legs.side)
            if (leg.toes != k_no_joint) run_forward(leg.toes);
        seen.legs = read_legs(rig_, models_);
    }
    void run_forward() const noexcept {
        for (const int joint : chain_) run_forward(joint);
    }
    void run_forward(int joint) const noexcept {
        const auto at = static_cast<std::size_t>(joint);
        const int parent = rig_.parents[at];
        models_[at] = parent < 0 ? locals_[at] : models_[static_cast<std::size_t>(parent)] * locals_[at];
    }

    const Walker& walker_;
    const FootRig& rig_;
    const std::vector<int> chain_;  ///< nothing else of what comes is read
    mutable std::vector<Transform> locals_, models_;
    mutable std::vector<Seen> seen_;
};

PlacedWalker::PlacedWalker(Walker& walker, const Ground& ground, const FootSettings& settings)
    : walker_(walker),
      ground_(ground),
      rig_(make_foot_rig(*walker.skeleton(), walker.legs(), walker.standing(), settings)),
      preview_(std::make_unique<Preview>(walker, rig_)),
      locals_(static_cast<std::size_t>(walker.skeleton()->joint_count())),
      models_(locals_.size()),
      mode_(settings.mode) {}

PlacedWalker::~PlacedWalker() = default;

void PlacedWalker::start(float speed_mps, float speed_limit) {
    walker_.limit_speed(k_no_speed_limit);
    walker_.start(speed_mps);
    take_up(speed_limit);
}

void PlacedWalker::take_up(float speed_limit) {
    state_ = {};
    output_ = {};
    rig_.settings.mode = mode_;
    takes_hold_ = false;
    place(0, speed_limit);
}

void PlacedWalker::advance(float dt, float speed_limit) noexcept {
    walker_.advance(dt);
    place(dt, speed_limit);
}

/// To another mode goes who has let go: nothing is placed, as without placement.
void PlacedWalker::approach_mode() noexcept {
    const float weight = rig_.settings.mode == FootMode::none ? 0 : state_.weight.value;
    if (rig_.settings.mode != mode_ && weight == 0) {
        rig_.settings.mode = mode_;
        state_ = {};
        if (mode_ != FootMode::none) state_.weight = {0, 0};
        takes_hold_ = mode_ != FootMode::none;
    }
    takes_hold_ = takes_hold_ && state_.weight.value < walker_.feet();
}

void PlacedWalker::place(float dt, float speed_limit) noexcept {
    approach_mode();
    walker_.look(0, root_, locals_);
    root_.position.y = height_at(ground_, root_.position.x, root_.position.z);
    clean_models(walker_, rig_, locals_, models_);
    FootInput input;
    input.dt = dt;
    input.root = root_;
    input.weight = rig_.settings.mode == mode_ ? walker_.feet() : 0;
    input.legs = read_legs(rig_, models_);
    place_feet(rig_, state_, input, ground_, preview_.get(), output_);
    apply(rig_, output_, models_, locals_);
    limit_ = speed_limit == k_own_limit ? output_.speed_limit : speed_limit;
    walker_.limit_speed(limit_);
    for (std::size_t side = 0; side < 2; ++side)
        if (output_.planted[side]) walker_.stand_on(output_.surface[side]);
}

}  // namespace surefoot
