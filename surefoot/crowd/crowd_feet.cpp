#include <surefoot/crowd/crowd_feet.h>
#include <surefoot/ik/hips.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

static_assert(k_ground_lanes == k_foot_lanes);
static_assert(sizeof(CrowdFoot) == k_foot_floats * sizeof(float), "kernels see a foot as its planes and its share");

template <std::size_t N>
void set(float (&rows)[N][k_ground_lanes], std::size_t lane, const float* values) noexcept {
    for (std::size_t k = 0; k < N; ++k) rows[k][lane] = values[k];
}

constexpr std::size_t lane_of(std::size_t character, std::size_t side) noexcept { return 2 * character + side; }

}  // namespace

CrowdFeetStep::CrowdFeetStep(const LegPaths& paths, const LegChains& chains, const CrowdFeetSettings& settings) noexcept
    : settings_(settings), legs_(chains), lanes_{} {
    for (std::size_t c = 0; c < k_most; ++c)
        for (std::size_t side = 0; side < 2; ++side) {
            set(lanes_.heel, lane_of(c, side), &paths.side[side].heel.x);
            set(lanes_.ball, lane_of(c, side), &paths.side[side].ball.x);
        }
}

void CrowdFeetStep::add(const FootPlans& plans, CrowdFeet& feet, RootFrame& root, float dt,
                        std::span<Transform> locals) noexcept {
    const auto c = static_cast<std::size_t>(legs_.add(locals));
    const bool is_new = feet.foot[0].share < 0;
    character_[c] = {&feet, &root, dt, is_new};
    for (std::size_t side = 0; side < 2; ++side) {
        const FootPlan& plan = plans.side[side];
        const std::size_t lane = lane_of(c, side);
        set(lanes_.root, lane, &root.position.x);
        lanes_.yaw[lane] = root.yaw;
        set(lanes_.now, lane, &plan.now.foot.rotation.x);
        set(lanes_.next, lane, &(plan.swings() ? plan.next : plan.now).foot.rotation.x);
        set(legs_.goals().toes, lane, &plan.now.toes.x);
        lanes_.share[lane] = plan.share;
        lanes_.stance[lane] = plan.stance;
        lanes_.is_stepping[lane] = plan.steps;
        lanes_.is_new[lane] = is_new;
        set(lanes_.foot, lane, &feet.foot[side].from.x);
    }
}

std::size_t CrowdFeetStep::ask(std::span<GroundQuery> queries) noexcept {
    KernelBuilds<GroundKernels>::fastest().ask(lanes_);
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < lane_of(static_cast<std::size_t>(legs_.count()), 0); ++lane)
        if (lanes_.is_asking[lane] != 0)
            queries[count++] = {
                {lanes_.asked[0][lane], lanes_.asked[1][lane], lanes_.asked[2][lane]}, settings_.up, settings_.down};
    return count;
}

void CrowdFeetStep::take(std::span<const GroundHit> hits) noexcept {
    std::size_t answer = 0;
    for (std::size_t lane = 0; lane < lane_of(static_cast<std::size_t>(legs_.count()), 0); ++lane) {
        if (lanes_.is_asking[lane] == 0) continue;
        const GroundHit& hit = hits[answer++];
        lanes_.is_hit[lane] = hit.hit;
        lanes_.height[lane] = hit.height;
        set(lanes_.normal, lane, &hit.normal.x);
    }
}

/// Bodies follow the mean of the ground under both feet, and sink for legs that would not reach.
void CrowdFeetStep::follow_ground() noexcept {
    constexpr float k_reach = 0.99f;
    LegGoalLanes& goals = legs_.goals();
    const auto count = static_cast<std::size_t>(legs_.count());
    std::array<float, k_most> middle;
    for (std::size_t c = 0; c < count; ++c)
        middle[c] = 0.5f * (lanes_.ground[lane_of(c, 0)] + lanes_.ground[lane_of(c, 1)]);
    std::copy(&lanes_.goal[0][0], &lanes_.goal[0][0] + 7 * k_ground_lanes, &goals.foot[0][0]);
    for (std::size_t lane = 0; lane < lane_of(count, 0); ++lane) goals.foot[5][lane] -= middle[lane / 2];
    float sinks[k_foot_lanes];
    legs_.sink_to_reach(k_reach, sinks);
    for (std::size_t c = 0; c < count; ++c) {
        const Character& character = character_[c];
        const float target = middle[c] - std::max(sinks[lane_of(c, 0)], sinks[lane_of(c, 1)]);
        HeightSpring height{character.is_new ? target : character.root->position.y, character.feet->rise};
        const float stiffness = 2 / settings_.rise;
        if (character.dt != decay_dt_) {  // mostly they are all posed as often
            decay_dt_ = character.dt;
            decay_ = exp(-stiffness * decay_dt_);
        }
        if (!character.is_new) height.step(target, stiffness, decay_dt_, decay_);
        character.root->position.y = height.value;
        character.feet->rise = height.rate;
        for (std::size_t side = 0; side < 2; ++side)
            goals.foot[5][lane_of(c, side)] += middle[c] - character.root->position.y;
    }
}

void CrowdFeetStep::place(std::span<const GroundHit> hits) noexcept {
    take(hits);
    KernelBuilds<GroundKernels>::fastest().lay(lanes_, settings_.steepest);
    legs_.run_forward();
    follow_ground();
    legs_.reach();
    for (std::size_t c = 0; c < static_cast<std::size_t>(legs_.count()); ++c)
        for (std::size_t side = 0; side < 2; ++side) {
            float* foot = &character_[c].feet->foot[side].from.x;
            for (std::size_t k = 0; k < k_foot_floats; ++k) foot[k] = lanes_.foot[k][lane_of(c, side)];
        }
    legs_.clear();
}

}  // namespace surefoot
