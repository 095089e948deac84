#include <surefoot/course/foresight.h>
#include <surefoot/graph_text/graph_file.h>
#include <surefoot/program/evaluate.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_step = 1 / k_walk_fps;  // [s]

/// A character on its way.
struct Going {
    std::vector<std::byte> state;
    RootFrame root;
    RootFrame requested;
    float feet = 1;  ///< GraphFrame::feet
};

class GraphWalker final : public WatchedGraphWalker {
  public:
    GraphWalker(const Pack& character, std::vector<ParameterValue> values, std::vector<PathLeg> path, GraphWatch watch)
        : character_(character),
          program_(character.program),
          values_(std::move(values)),
          watch_(std::move(watch)),
          steering_(std::move(path)),
          scratch_(program_),
          frame_(program_),
          speed_(program_.parameter("speed")),
          turn_(program_.parameter("turn")),
          surface_(program_.parameter("surface")) {
        now_.state.resize(program_.state_size);
    }
    const std::shared_ptr<const Skeleton>& skeleton() const override { return program_.body.skeleton; }
    const Legs& legs() const override { return character_.legs; }
    std::span<const Transform> standing() const override { return character_.standing; }
    void start(float speed_mps) override {
        asked_speed_ = speed_mps;
        steering_.restart();
        surefoot::start(program_, now_.state);
        for (const ParameterValue& value : values_) set(program_, now_.state, value.parameter, value.value);
        constexpr float k_run_up = 3;  // [s] for parameters and states to get there: it walks already when it starts
        say();
        for (float time = 0; time < k_run_up; time += k_step) go(now_, k_step, true);
        now_.root = now_.requested = {};
        foresight_.begin(now_);
    }
    void advance(float dt) noexcept override {
        steering_.advance(dt);
        say();
        go(now_, dt, true);
        if (watch_) watch_(dt, frame_, scratch_);
        foresight_.begin(now_);
    }
    void limit_speed(float mps) noexcept override {
        steering_.limit_speed(mps);
        say();
        foresight_.begin(now_);
    }
    void stand_on(std::uint32_t surface) noexcept override {
        set(program_, now_.state, surface_, static_cast<float>(surface));
        foresight_.begin(now_);
    }
    void steer(const LocomotionRequest& asked) noexcept override {
        asked_speed_ = asked.speed;
        steering_.take_over(asked.turn);
        say();
        foresight_.begin(now_);
    }
    void ask(const ParameterValue& value) noexcept override {
        const auto same = [&](const ParameterValue& other) { return other.parameter == value.parameter; };
        const auto found = std::find_if(values_.begin(), values_.end(), same);
        // A trigger is pulled once, not at every start.
        const auto index = static_cast<std::size_t>(value.parameter);
        if (found != values_.end())
            found->value = value.value;
        else if (program_.parameters[index].kind != ParameterKind::trigger)
            values_.push_back(value);
        set(program_, now_.state, value.parameter, value.value);
        foresight_.begin(now_);
    }
    std::span<const std::byte> state() const noexcept override { return now_.state; }
    RootFrame requested() const noexcept override { return now_.requested; }
    bool has_host() const noexcept override { return steering_.has_host(); }
    float feet() const noexcept override { return now_.feet; }
    /// States stay as they are and parameters go where they are going: no later leg of the path is known.
    void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept override {
        const Going& there = foresight_.at(ahead, [this](Going& going, float dt) noexcept { go(going, dt, false); });
        root = there.root;
        pose(program_, there.state, frame_, scratch_, locals);
    }

  private:
    void say() noexcept {
        set(program_, now_.state, speed_, steering_.speed(asked_speed_));
        set(program_, now_.state, turn_, steering_.turn());
    }
    void go(Going& going, float dt, bool decide) const noexcept {
        GraphInput input;
        input.dt = dt;
        input.root = going.root;
        input.decide = decide;
        update(program_, going.state, input, scratch_, frame_);
        going.root = going.root * frame_.root_delta * steering_.host().in(dt);
        going.root.position.y = 0;
        going.feet = frame_.feet;
        const Vec3 velocity{0, 0, get(program_, going.state, speed_)};
        const float turn = get(program_, going.state, turn_) * k_radians_per_degree;
        going.requested = going.requested * integrate(velocity, turn, dt) * steering_.host().in(dt);
    }

    const Pack& character_;
    const Program& program_;
    std::vector<ParameterValue> values_;
    GraphWatch watch_;
    Steering steering_;
    mutable GraphScratch scratch_;
    mutable GraphFrame frame_;
    int speed_, turn_, surface_;
    float asked_speed_ = 0;  // [m/s]
    Going now_;
    mutable Foresight<Going> foresight_;
};

}  // namespace

std::unique_ptr<Walker> make_graph_walker(const Pack& character, std::vector<ParameterValue> values,
                                          std::vector<PathLeg> path) {
    return std::make_unique<GraphWalker>(character, std::move(values), std::move(path), nullptr);
}

std::unique_ptr<WatchedGraphWalker> make_watched_graph_walker(const Pack& character, GraphWatch watch) {
    return std::make_unique<GraphWalker>(character, std::vector<ParameterValue>{}, std::vector<PathLeg>{},
                                         std::move(watch));
}

}  // namespace surefoot
