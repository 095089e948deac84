#include <surefoot/graph/locomotion.h>
#include <surefoot/live/mixture.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace surefoot {
namespace {

void add(Quat& sum, Quat q, float weight) noexcept {
    q = aligned(q, sum);
    sum = {sum.x + weight * q.x, sum.y + weight * q.y, sum.z + weight * q.z, sum.w + weight * q.w};
}

/// What all that follows reads: the numbers of each manner, kept for as long as speed and turn stay, and the waves of
/// all limbs and both feet.
void prepare(const LiveRig& rig, const LiveState& state, const Mixture& now, LiveScratch& scratch) noexcept {
    std::array<float, 8> phases{};
    for (std::size_t l = 0; l < k_limbs; ++l)
        phases[l] = wrap_phase(series_phase(now, state.limbs, static_cast<Limb>(l)));
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        if (now.share[m] == 0) continue;
        LiveScratch::Manner& kept = scratch.manners[m];
        const HarmonicLanes& lanes = rig.lanes[m];
        if (kept.lanes != &lanes || kept.speed != now.posture_speed || kept.turn != now.posture_turn) {
            lanes.values_at(now.posture_speed, now.posture_turn, kept.values);
            kept.lanes = &lanes;
            kept.speed = now.posture_speed;
            kept.turn = now.posture_turn;
            for (std::size_t side = 0; side < 2; ++side) kept.middle[side] = lanes.middle_print(kept.values, side);
        }
        for (std::size_t side = 0; side < 2; ++side)
            phases[k_limbs + side] = foot_phase(state.feet[side], *rig.manners[m].gait,
                                                own_share(now, state.limbs, side), now.rhythm.lift[side]);
        lanes.waves_at(phases, kept.waves);
    }
}

/// Adds `from`, weighted, to the sum of poses.
void add_pose(std::span<Transform> sum, std::span<const Transform> from, float weight, bool first) noexcept {
    for (std::size_t j = 0; j < sum.size(); ++j) {
        if (first) sum[j] = {{0, 0, 0, 0}, {}};
        add(sum[j].rotation, from[j].rotation, weight);
        sum[j].translation += weight * from[j].translation;
    }
}

/// The stand as it breathes just now: in the scratch, or as it is.
std::span<const Transform> stand_at(const LiveRig& rig, float breath, LiveScratch& scratch) noexcept {
    if (!rig.idle) return rig.stand;
    rig.idle_lanes.waves_at(std::array<float, 8>{breath}, scratch.idle_waves);
    rig.idle_lanes.joint_pose(rig.idle_values, scratch.idle_waves, scratch.locals);
    for (std::size_t j = 0; j < scratch.locals.size(); ++j) {
        Transform& local = scratch.locals[j];
        local = {rig.idle_to_stand[j].rotation * local.rotation, rig.idle_to_stand[j].translation + local.translation};
    }
    return scratch.locals;
}

/// The joints of all that is done at once.
void blend_joints(const LiveRig& rig, const LiveState& state, const Mixture& now, LiveScratch& scratch,
                  std::span<Transform> locals) noexcept {
    bool first = true;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        const float weight = now.share[m] * (1 - now.standing);
        if (weight == 0) continue;
        const bool alone = weight == 1;
        const LiveScratch::Manner& kept = scratch.manners[m];
        rig.lanes[m].joint_pose(kept.values, kept.waves, alone ? locals : std::span<Transform>(scratch.locals));
        if (alone) return;
        add_pose(locals, scratch.locals, weight, first);
        first = false;
    }
    if (now.standing > 0) add_pose(locals, stand_at(rig, state.breath, scratch), now.standing, first);
    for (Transform& local : locals) local.rotation = normalized(local.rotation);
}

struct BlendedPrint {
    FootPrint print{{0, 0, 0, 0}, {}, {}, {0, 0, 0, 0}};
    Vec3 middle_heel, middle_ball;  ///< in the middle of the stance
};

BlendedPrint blend_print(const LiveRig& rig, const Mixture& now, const LiveScratch& scratch,
                         std::size_t side) noexcept {
    BlendedPrint sum;
    for (std::size_t m = 0; m < rig.manners.size(); ++m) {
        const float weight = now.share[m];
        if (weight == 0) continue;
        const LiveScratch::Manner& kept = scratch.manners[m];
        const FootPrint print = rig.lanes[m].foot_print(kept.values, kept.waves, side, k_limbs + side);
        const FootPrint& middle = kept.middle[side];
        add(sum.print.rotation, print.rotation, weight);
        add(sum.print.toes, print.toes, weight);
        sum.print.heel += weight * print.heel;
        sum.print.ball += weight * print.ball;
        sum.middle_heel += weight * middle.heel;
        sum.middle_ball += weight * middle.ball;
    }
    sum.print.rotation = normalized(sum.print.rotation);
    sum.print.toes = normalized(sum.print.toes);
    return sum;
}

/// Goes over to the flat foot of a stand.
void flatten(FootPrint& print, const FootPrint& stand, const RootFrame& stand_place, const RootFrame& place,
             float share) noexcept {
    if (share <= 0) return;
    const Transform there = to_transform(place) * inverse(to_transform(stand_place));
    print.rotation = nlerp(print.rotation, there.rotation * stand.rotation, share);
    print.toes = nlerp(print.toes, stand.toes, share);
    print.heel = lerp(print.heel, transform_point(there, stand.heel), share);
    print.ball = lerp(print.ball, transform_point(there, stand.ball), share);
}

/// The frame that lies `share` of the way along the arc to `to`, seen from where it begins.
RootFrame along_arc(const RootFrame& to, float share) noexcept {
    const float half = 0.5f * to.yaw;
    const float bent = std::fabs(half) > 1e-4f ? sin(half) / half : 1 - half * half / 6;
    const Vec3 velocity = rotate(from_yaw(-half), to.position) / bent;
    return integrate(velocity, to.yaw, share);
}

/// How flat a foot is kept: as flat as the body stands; on its way, at first as flat as it left. A step between two
/// stands stays low, and has a height of its own.
float flatness(const LiveFoot& foot, const Mixture& now, float swung) noexcept {
    constexpr float k_over = 0.8f;  // share of the swing that each takes
    if (!foot.swings) return now.standing;
    return foot.flat * (1 - smooth_step(swung / k_over)) + now.standing * smooth_step((swung - 1) / k_over + 1);
}

/// Of its way, more than 1 once it is there. Who comes down flat arrives before: there is no heel to roll on.
float way_share(float flat, float swung) noexcept {
    constexpr float k_sooner = 0.15f;
    return swung / (1 - k_sooner * flat);
}

FootGoal goal_of(const LiveRig& rig, const LiveState& state, const Mixture& now, const LiveScratch& scratch,
                 std::size_t side) noexcept {
    const LiveFoot& foot = state.feet[side];
    const float share = own_share(now, state.limbs, side), swung = swing_share(foot, share);
    BlendedPrint blended = blend_print(rig, now, scratch, side);
    const RootFrame place = place_of(blended.middle_heel, blended.middle_ball);
    const float flat = flatness(foot, now, swung);
    flatten(blended.print, rig.stand_print[side], rig.stand_place[side], place, flat);
    // The root in the middle of the stance, seen from where it is now.
    RootFrame middle = foot.plant * between(place, {});
    if (foot.swings)
        middle = middle * along_arc(between(middle, foot.plant * foot.coming), smooth_step(way_share(flat, swung)));
    Transform print = stand_on(rig.legs.side[side], blended.print.rotation, blended.print.heel, blended.print.ball);
    // As far as it is kept flat it would slide.
    if (foot.swings) print.translation.y += flat * step_height(rig.legs.side[side], swung);
    return {to_transform(middle) * print, blended.print.toes};
}

/// Where a straight knee would bend to was measured in each gait's own posture, and is blended as that is: with the
/// first's alone, crouching knees were off by 5 mm.
LegPaths blend_legs(const LiveRig& rig, const Mixture& now) noexcept {
    LegPaths legs = rig.legs;
    if (now.share[0] == 1) return legs;
    for (std::size_t side = 0; side < 2; ++side) {
        Vec3 forward = now.standing * rig.legs.side[side].knee_forward;
        for (std::size_t m = 0; m < rig.manners.size(); ++m)
            forward += (1 - now.standing) * now.share[m] * rig.manners[m].gait->legs.side[side].knee_forward;
        legs.side[side].knee_forward = normalized(forward, rig.legs.side[side].knee_forward);
    }
    return legs;
}

}  // namespace

void pose(const LiveRig& rig, const LiveState& state, LiveScratch& scratch, std::span<Transform> locals) noexcept {
    const Mixture now = mixture_of(rig, state);
    prepare(rig, state, now, scratch);
    blend_joints(rig, state, now, scratch, locals);
    std::array<FootGoal, 2> goals{goal_of(rig, state, now, scratch, 0), goal_of(rig, state, now, scratch, 1)};
    settle_on_feet(*rig.skeleton, rig.soles, blend_legs(rig, now), goals, locals);
}

}  // namespace surefoot
