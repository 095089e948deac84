#include <surefoot/analysis/measure.h>
#include <surefoot/base/error.h>
#include <surefoot/gait_clip/gait_clip.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/motion/stance.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr int k_moments = 8;  // lanes that are solved at once

void check(const GaitPlay& play, const std::string& gait) {
    if (!(play.fps >= 10 && play.fps <= 240))
        throw Error("the frame rate is not between 10 and 240", gait, "ask for 30 or 60");
    if (play.cycles < 1 || play.cycles > 1000)
        throw Error("the number of cycles is not between 1 and 1000", gait, "ask for 1");
}

/// The root's way over a frame, on an arc, so that feet planned on arcs stand still.
RootFrame step(const RootRate& from, const RootRate& to, float seconds) {
    return integrate(lerp(from.velocity, to.velocity, 0.5f), 0.5f * (from.turn + to.turn), seconds);
}

}  // namespace

GaitActor make_gait_actor(std::shared_ptr<const Skeleton> skeleton, RoleReport roles, const Legs& legs,
                          std::span<const Transform> shape, const std::string& name) {
    for (const Role role : {Role::left_upper_leg, Role::left_lower_leg, Role::left_foot, Role::right_upper_leg,
                            Role::right_lower_leg, Role::right_foot})
        if (!roles.roles.has(role) || !roles.roles.has(Role::hips) ||
            !is_within(*skeleton, roles.roles[role], roles.roles[Role::hips]))
            throw Error("its legs do not hang from its hips", name,
                        "name the joints by hand: --roles " + std::string(role_name(role)) + "=JOINT");
    std::vector<Transform> rest(skeleton->rest.size());
    if (shape.empty()) {
        local_to_model(*skeleton, skeleton->rest, rest);
        shape = rest;
    }
    const std::vector<Transform> stance = standing_pose(*skeleton, roles.roles, legs, shape);
    Body body = make_body(*skeleton, roles.roles, legs, stance);
    return {std::move(skeleton), std::move(roles), legs, std::move(body)};
}

BodyBinding bind_gait(const Gait& gait) {
    std::vector<ControlName> names;
    for (const GaitOutput& output : gait.outputs)
        names.push_back({output.control ? std::string_view(output.name) : std::string_view(), output.unit});
    BodyBinding binding = bind_controls(names);
    binding.unknown.erase(std::remove(binding.unknown.begin(), binding.unknown.end(), std::string()),
                          binding.unknown.end());
    return binding;
}

Motion gait_motion(const Gait& gait, std::span<const double> values, const GaitActor& actor, const GaitPlay& play) {
    check(play, gait.name);
    const Body& body = actor.body;
    const BodyBinding binding = bind_gait(gait);
    const double time_scale = static_cast<double>(body.scale.time);
    const double speed = play.speed_mps / static_cast<double>(body.scale.speed());
    const double turn = play.turn_deg_s * time_scale;
    const double period = gait_period(gait, values, speed, turn, play.slope_deg);
    const int steps = std::clamp(static_cast<int>(play.fps * period * time_scale + 0.5), 8, 100000);
    const double fps = steps / (period * time_scale);

    Motion motion = make_motion(actor.skeleton, gait.name, steps * play.cycles + 1, static_cast<float>(fps));
    motion.cyclic = true;
    const std::size_t controls = gait.program.outputs.size();
    std::vector<double> controlled(controls);
    std::vector<float> outputs(controls * k_moments), channels(std::size_t{k_body_channels} * k_moments);
    std::vector<float> pose(body.pose_floats());
    std::vector<RootRate> rates;
    for (int first = 0; first <= steps; first += k_moments) {
        for (int lane = 0; lane < k_moments; ++lane) {
            // The last frame is the first one again, to the bit.
            const double phase = static_cast<double>((first + lane) % steps) / steps;
            const double inputs[k_gait_inputs] = {phase * period, phase, speed, turn, play.slope_deg};
            run_exactly(gait.program, inputs, values, controlled);
            for (std::size_t c = 0; c < controls; ++c)
                outputs[c * k_moments + static_cast<std::size_t>(lane)] = static_cast<float>(controlled[c]);
        }
        apply(binding, body.scale, outputs, channels);
        solve(body, channels, pose);
        for (int lane = 0; lane < k_moments && first + lane <= steps; ++lane) {
            rates.push_back(root_rate(channels, lane));
            for (int cycle = 0; cycle < play.cycles; ++cycle)
                if (const int f = cycle * steps + first + lane; f < motion.frame_count())
                    write_pose(body, pose, lane, motion.frame(f));
        }
    }
    const float seconds = static_cast<float>(1 / fps);
    for (int f = 1; f < motion.frame_count(); ++f) {
        const std::size_t from = static_cast<std::size_t>((f - 1) % steps);
        motion.root[static_cast<std::size_t>(f)] =
            motion.root[static_cast<std::size_t>(f - 1)] * step(rates[from], rates[from + 1], seconds);
    }
    return motion;
}

AnalyzedClip play_gait(const Gait& gait, std::span<const double> values, const GaitActor& actor, const GaitPlay& play) {
    AnalyzedClip clip;
    const Motion& motion = clip.motion = gait_motion(gait, values, actor, play);
    clip.roles = actor.roles;
    clip.legs = actor.legs;
    clip.source = gait.name;
    clip.facts.name = motion.name;
    clip.facts.file = gait.name;
    clip.facts.frames = motion.frame_count();
    clip.facts.joints = motion.joint_count();
    clip.facts.fps = motion.fps;
    clip.facts.duration = motion.duration();
    clip.facts.cyclic = true;
    measure(motion, clip.roles.roles, clip.legs, clip.facts);
    return clip;
}

}  // namespace surefoot
