#include <surefoot/graph/blended_feet.h>
#include <surefoot/graph/held_feet.h>
#include <surefoot/graph/kernels_impl.h>

namespace surefoot {

Transform stand_on(const LegPaths::Side& leg, Quat rotation, Vec3 heel, Vec3 ball) noexcept {
    const auto one = [](Vec3 v) noexcept { return Vec8<Single>::splat(v); };
    const Vec8<Single> place =
        stand_on(Quat8<Single>::splat(rotation), one(leg.heel), one(leg.ball), one(heel), one(ball));
    return {rotation, {place.x.part[0], place.y.part[0], place.z.part[0]}};
}

void reach_feet(const LegPaths& paths, const std::array<FootGoal, 2>& feet, std::span<Transform> locals) noexcept {
    if (paths.count == 0) return;
    const LegChains chains = make_leg_chains(paths);
    LegLanes legs(chains);
    legs.set_goals(legs.add(locals), feet);
    legs.run_forward();
    legs.reach();
}

void blend_feet(const LegPaths& paths, std::span<const PackedClip> clips, std::span<const BlendedPose> poses) noexcept {
    if (paths.count == 0 || poses.empty()) return;
    const LegChains chains = make_leg_chains(paths);
    LegLanes legs(chains);
    FootMeans means;
    std::array<std::array<FootGoal, 2>, LegLanes::k_poses> goals;
    std::array<const FootBlend*, LegLanes::k_poses> blends;
    const auto reach = [&]() noexcept {
        means.answer_all();
        legs.run_forward();
        for (int pose = 0; pose < legs.count(); ++pose) {
            const auto at = static_cast<std::size_t>(pose);
            for (std::size_t side = 0; side < 2; ++side) {
                const FootOffset& hold = blends[at]->hold[side];
                if (hold == FootOffset{}) continue;
                hold_at(paths.side[side], hold, goals[at][side]);
                rise_on_ball(paths.side[side], legs.pose(pose, side), goals[at][side]);
            }
            legs.set_goals(pose, goals[at]);
        }
        legs.reach();
        legs.clear();
    };
    for (const BlendedPose& pose : poses) {
        BlendedFeet blended(paths, pose.blend);
        if (!blended.gather(clips)) continue;
        const auto at = static_cast<std::size_t>(legs.add(pose.locals));
        blends[at] = &pose.blend;
        std::array<FootGoal, 2>& feet = goals[at];
        for (std::size_t side = 0; side < 2; ++side) {
            const float share = blended.turn_to(side);
            blended.ask(share, 0, feet[side], means);
        }
        if (legs.full()) reach();
    }
    if (legs.count() > 0) reach();
}

void blend_feet(const LegPaths& paths, std::span<const PackedClip> clips, const FootBlend& blend,
                std::span<Transform> locals) noexcept {
    const BlendedPose pose{blend, locals};
    blend_feet(paths, clips, {&pose, 1});
}

void plan_feet(const LegPaths& paths, std::span<const PackedClip> clips, std::span<const FootBlend> blends,
               std::span<FootPlans> plans) noexcept {
    FootMeans means;
    for (std::size_t i = 0; i < blends.size(); ++i) {
        const FootBlend& blend = blends[i];
        BlendedFeet blended(paths, blend);
        plans[i].known = paths.count > 0 && blended.gather(clips);
        for (std::size_t side = 0; plans[i].known && side < 2; ++side) {
            FootPlan& foot = plans[i].side[side];
            foot.share = blended.turn_to(side);
            blended.ask(foot.share, 0, foot.now, means);
            foot.stance = blended.duty();
            foot.steps = blended.steps() && blend.phase_rate > 0;
            if (!foot.swings()) continue;
            blended.turn_to_next_step();
            const float middle = 0.5f * blended.duty(), ahead = (1 + middle - foot.share) / blend.phase_rate;
            blended.ask(middle, ahead, foot.next, means);
        }
    }
    means.answer_all();
    for (std::size_t i = 0; i < blends.size(); ++i)
        for (std::size_t side = 0; plans[i].known && side < 2; ++side)
            hold_plan(paths.side[side], blends[i].hold[side], plans[i].side[side]);
}

}  // namespace surefoot
