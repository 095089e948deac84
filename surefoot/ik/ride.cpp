#include <surefoot/ik/ride.h>

namespace surefoot {
namespace {

/// Where there is nothing, nothing moves.
template <std::size_t N>
std::array<GroundHit, N> hits_at(const GroundProbe& probe, const std::array<Vec3, N>& places) noexcept {
    std::array<GroundHit, N> hits;
    probe.look(places, hits);
    for (GroundHit& hit : hits)
        if (!hit.hit) hit = {};
    return hits;
}

void move(Plant& plant, Vec3 root_way, Vec3 way) noexcept {
    plant.centre += Vec3{root_way.x, 0, root_way.z};
    plant.foothold += way;
}

}  // namespace

void ride(FootPlacementState& state, const GroundProbe& probe, float dt) noexcept {
    const auto& feet = state.feet;
    const std::array<GroundHit, 4> hits = hits_at<4>(
        probe, {feet[0].plant.foothold, feet[1].plant.foothold, feet[0].next.foothold, feet[1].next.foothold});
    const Vec3 root_way = state.ground_velocity * dt;
    for (std::size_t side = 0; side < 2; ++side) {
        FootState& foot = state.feet[side];
        move(foot.plant, root_way, hits[side].velocity * dt);
        move(foot.next, root_way, hits[side + 2].velocity * dt);
        foot.foreseen += Vec3{root_way.x, 0, root_way.z};
    }
    state.base.value += root_way.y;
    for (FootholdPass& pass : state.line.passes) pass.height += root_way.y;
}

void feel_ground(const FootRig& rig, FootPlacementState& state, const FootInput& input, const GroundProbe& probe,
                 FootOutput& output) noexcept {
    std::array<Vec3, 2> places;
    for (std::size_t side = 0; side < 2; ++side)
        places[side] = output.planted[side]
                           ? state.feet[side].plant.foothold
                           : world_leg(rig.legs.side[side], input.legs.side[side], input.root).points.ankle;
    const std::array<GroundHit, 2> hits = hits_at<2>(probe, places);
    Vec3 sum;
    float standing = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        output.surface[side] = hits[side].surface;
        output.surface_velocity[side] = hits[side].velocity;
        if (!output.planted[side]) continue;
        sum += hits[side].velocity;
        standing += 1;
    }
    if (standing > 0) state.ground_velocity = sum * (1 / standing);  // who flies goes on as it went
    output.ground_velocity = state.ground_velocity;
}

}  // namespace surefoot
