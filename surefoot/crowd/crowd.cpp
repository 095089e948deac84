#include <surefoot/crowd/crowd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>

namespace surefoot {
namespace {

constexpr std::size_t k_eight = k_lanes, k_alignment = 64;

/// [frames] that a character's pose lasts.
std::size_t period(const Crowd& crowd, std::size_t character) noexcept {
    return crowd.periods.empty() ? 1 : std::max<std::size_t>(crowd.periods[character], 1);
}

/// a * b as rigid or affine matrices.
void multiply(const Matrix34& a, const Matrix34& b, Matrix34& out) noexcept {
    for (int row = 0; row < 3; ++row) {
        const float *m = a.m + 4 * row, x = m[0], y = m[1], z = m[2], w = m[3];
        float* to = out.m + 4 * row;
        for (int column = 0; column < 4; ++column)
            to[column] = (x * b.m[column] + y * b.m[4 + column] + z * b.m[8 + column]) + (column == 3 ? w : 0.0f);
    }
}

}  // namespace

/// Gathers characters that are due until eight are together.
class CrowdLanes {
  public:
    CrowdLanes(const LocomotionGraph& graph, const Crowd& crowd, float dt, CrowdScratch& scratch) noexcept
        : graph_(graph),
          crowd_(crowd),
          scratch_(scratch),
          joints_(graph.skeleton->rest.size()),
          dt_(dt),
          steps_{{graph.legs, scratch.legs_, crowd.feet_settings}, {graph.legs, scratch.legs_, crowd.feet_settings}},
          lays_feet_(crowd.ground != nullptr && !crowd.feet.empty()) {}

    void add(std::size_t character, const LocomotionFrame& frame) noexcept {
        const std::span<Transform> mine =
            crowd_.locals.empty() ? of(scratch_.locals_, count_) : crowd_.locals.subspan(character * joints_, joints_);
        scratch_.frames_[count_] = frame;
        character_[count_] = character;
        pose_[count_] = mine.data();
        if (++count_ == k_eight) flush();
    }
    void flush() noexcept {
        if (count_ == 0) return;
        if (lays_feet_)
            pose_on_ground();
        else
            poses(graph_, std::span(scratch_.frames_).first(count_), std::span(pose_).first(count_));
        if (!crowd_.matrices.empty()) write_matrices();
        count_ = 0;
    }

  private:
    std::span<Transform> of(std::vector<Transform>& poses, std::size_t lane) const noexcept {
        return {poses.data() + lane * joints_, joints_};
    }
    void pose_on_ground() noexcept {
        std::array<FootBlend, k_eight> blends;
        std::array<FootPlans, k_eight> plans;
        for (std::size_t lane = 0; lane < count_; ++lane) {
            blends[lane] = foot_blend_of(scratch_.frames_[lane]);
            pose_without_feet(graph_, scratch_.frames_[lane], {pose_[lane], joints_});
        }
        plan_feet(graph_.legs, graph_.clips, std::span(blends).first(count_), plans);
        lay_feet(plans);
    }
    /// Four characters at a time; the ground is asked for all eight at once.
    void lay_feet(const std::array<FootPlans, k_eight>& plans) noexcept {
        for (std::size_t lane = 0; lane < count_; ++lane) {
            const std::size_t c = character_[lane];
            if (!plans[lane].known) continue;
            CrowdFeetStep& step = steps_[steps_[0].full() ? 1 : 0];
            step.add(plans[lane], crowd_.feet[c], crowd_.roots[c], dt_ * static_cast<float>(period(crowd_, c)),
                     {pose_[lane], joints_});
        }
        std::array<GroundQuery, 2 * k_eight> queries;
        std::array<GroundHit, 2 * k_eight> hits;
        const std::size_t first = steps_[0].count() > 0 ? steps_[0].ask(queries) : 0;
        const std::size_t count =
            first + (steps_[1].count() > 0 ? steps_[1].ask(std::span(queries).subspan(first)) : 0);
        crowd_.ground->query(std::span(queries).first(count), std::span(hits).first(count));
        if (steps_[0].count() > 0) steps_[0].place(std::span(hits).first(first));
        if (steps_[1].count() > 0) steps_[1].place(std::span(hits).subspan(first, count - first));
    }
    void write_matrices() noexcept {
        const Transform* from[k_lanes];
        Matrix34* to[k_lanes];
        for (std::size_t lane = 0; lane < k_eight; ++lane) {
            const bool idle = lane >= count_;
            from[lane] = pose_[idle ? 0 : lane];
            to[lane] = idle ? scratch_.idle_.data() : crowd_.matrices.data() + character_[lane] * joints_;
        }
        void* models = scratch_.models_.data();
        std::size_t space = scratch_.models_.size() * sizeof(float);
        std::align(k_alignment, sizeof(float), models, space);
        local_to_model_8(*graph_.skeleton, from, to, static_cast<float*>(models));
        if (crowd_.inverse_bind.empty()) return;
        for (std::size_t lane = 0; lane < count_; ++lane)
            for (std::size_t j = 0; j < joints_; ++j) {
                const Matrix34 model = to[lane][j];
                multiply(model, crowd_.inverse_bind[j], to[lane][j]);
            }
    }

    const LocomotionGraph& graph_;
    const Crowd& crowd_;
    CrowdScratch& scratch_;
    std::size_t joints_, count_ = 0;
    float dt_;
    CrowdFeetStep steps_[2];
    bool lays_feet_;
    std::array<std::size_t, k_eight> character_{};
    std::array<Transform*, k_eight> pose_{};
};

CrowdScratch::CrowdScratch(const LocomotionGraph& graph)
    : legs_(make_leg_chains(graph.legs)),
      frames_(k_eight),
      locals_(k_eight * graph.skeleton->rest.size()),
      idle_(graph.skeleton->rest.size()),
      models_(model_scratch_floats(graph.skeleton->joint_count()) + k_alignment / sizeof(float)) {}

bool is_due(const Crowd& crowd, std::size_t character) noexcept {
    return crowd.frame == 0 || (crowd.frame + character) % period(crowd, character) == 0;
}

void evaluate(const LocomotionGraph& graph, const Crowd& crowd, CrowdRange range, float dt,
              CrowdScratch& scratch) noexcept {
    assert(range.first + range.count <= crowd.states.size());
    const bool posed = !crowd.locals.empty() || !crowd.matrices.empty();
    CrowdLanes lanes(graph, crowd, dt, scratch);
    for (std::size_t c = range.first; c < range.first + range.count; ++c) {
        const LocomotionFrame frame = update(graph, crowd.states[c], crowd.wishes[c], dt);
        crowd.roots[c] = crowd.roots[c] * frame.root_delta;
        if (posed && is_due(crowd, c)) lanes.add(c, frame);
    }
    lanes.flush();
}

}  // namespace surefoot
