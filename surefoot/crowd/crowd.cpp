#include <surefoot/crowd/crowd.h>

#include <cassert>
#include <memory>

namespace surefoot {
namespace {

constexpr std::size_t k_eight = k_lanes, k_alignment = 64;

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
    CrowdLanes(const LocomotionGraph& graph, const Crowd& crowd, CrowdScratch& scratch) noexcept
        : graph_(graph), crowd_(crowd), scratch_(scratch), joints_(graph.skeleton->rest.size()) {}

    void add(std::size_t character, const LocomotionFrame& frame) noexcept {
        const std::span<Transform> mine =
            crowd_.locals.empty() ? of(scratch_.locals_, count_) : crowd_.locals.subspan(character * joints_, joints_);
        pose(graph_, frame, mine);
        if (crowd_.matrices.empty()) return;
        from_[count_] = mine.data();
        to_[count_] = crowd_.matrices.data() + character * joints_;
        if (++count_ == k_eight) flush();
    }
    void flush() noexcept {
        if (count_ == 0) return;
        for (std::size_t idle = count_; idle < k_eight; ++idle) {
            from_[idle] = from_[0];
            to_[idle] = scratch_.idle_.data();
        }
        void* models = scratch_.models_.data();
        std::size_t space = scratch_.models_.size() * sizeof(float);
        std::align(k_alignment, sizeof(float), models, space);
        local_to_model_8(*graph_.skeleton, from_, to_, static_cast<float*>(models));
        if (!crowd_.inverse_bind.empty())
            for (std::size_t lane = 0; lane < count_; ++lane)
                for (std::size_t j = 0; j < joints_; ++j) {
                    const Matrix34 model = to_[lane][j];
                    multiply(model, crowd_.inverse_bind[j], to_[lane][j]);
                }
        count_ = 0;
    }

  private:
    std::span<Transform> of(std::vector<Transform>& poses, std::size_t lane) const noexcept {
        return {poses.data() + lane * joints_, joints_};
    }

    const LocomotionGraph& graph_;
    const Crowd& crowd_;
    CrowdScratch& scratch_;
    std::size_t joints_, count_ = 0;
    const Transform* from_[k_lanes] = {};
    Matrix34* to_[k_lanes] = {};
};

CrowdScratch::CrowdScratch(const LocomotionGraph& graph)
    : locals_(k_eight * graph.skeleton->rest.size()),
      idle_(graph.skeleton->rest.size()),
      models_(model_scratch_floats(graph.skeleton->joint_count()) + k_alignment / sizeof(float)) {}

bool is_due(const Crowd& crowd, std::size_t character) noexcept {
    if (crowd.frame == 0 || crowd.periods.empty() || crowd.periods[character] < 2) return true;
    return (crowd.frame + character) % crowd.periods[character] == 0;
}

void evaluate(const LocomotionGraph& graph, const Crowd& crowd, CrowdRange range, float dt,
              CrowdScratch& scratch) noexcept {
    assert(range.first + range.count <= crowd.states.size());
    const bool posed = !crowd.locals.empty() || !crowd.matrices.empty();
    CrowdLanes lanes(graph, crowd, scratch);
    for (std::size_t c = range.first; c < range.first + range.count; ++c) {
        const LocomotionFrame frame = update(graph, crowd.states[c], crowd.wishes[c], dt);
        crowd.roots[c] = crowd.roots[c] * frame.root_delta;
        if (posed && is_due(crowd, c)) lanes.add(c, frame);
    }
    lanes.flush();
}

}  // namespace surefoot
