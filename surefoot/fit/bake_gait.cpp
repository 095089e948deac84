#include <surefoot/analysis/measure.h>
#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/fit/rolling_foot.h>
#include <surefoot/graph/locomotion.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace surefoot {

void check_request(const HarmonicGait& gait, float speed, float turn_deg, float fps) {
    if (!(fps >= 10 && fps <= 240))
        throw Error("the frame rate is not between 10 and 240", gait.name, "ask for 30 or 60");
    if (!gait.family()) return;
    const GaitBasis& basis = gait.basis;
    if (!(speed >= basis.least_speed && speed <= basis.most_speed))
        throw Error(fmt::format("{:g} m/s is not a speed of this family", speed), gait.name,
                    fmt::format("ask for {:g} to {:g} m/s", basis.least_speed, basis.most_speed));
    if (!(std::fabs(turn_deg) <= basis.most_turn))
        throw Error(fmt::format("{:g} deg/s is not a turn of this family", turn_deg), gait.name,
                    fmt::format("ask for {:g} to {:g} deg/s", -basis.most_turn, basis.most_turn));
}

namespace {

std::string name_of(const HarmonicGait& gait, float speed, float turn_deg) {
    if (!gait.family()) return gait.name;
    return turn_deg == 0 ? fmt::format("{}_{:.2f}mps", gait.name, speed)
                         : fmt::format("{}_{:.2f}mps_{}_{:.0f}", gait.name, speed, turn_deg > 0 ? "left" : "right",
                                       std::fabs(turn_deg));
}

/// The gait's own strikes and toe-offs, in order of time.
std::vector<PhaseEvent> events_of(const GaitRhythm& rhythm, float duration) {
    std::vector<PhaseEvent> events;
    for (const Side side : {Side::left, Side::right}) {
        const float strike = side == Side::left ? 0.0f : 0.5f, lift = rhythm.lift[static_cast<std::size_t>(side)];
        const auto time = [&](float phase) { return time_share(rhythm, phase - std::floor(phase)) * duration; };
        events.push_back({side, StrideEvent::strike, time(strike)});
        events.push_back({side, StrideEvent::toe_off, time(strike + lift)});
    }
    std::sort(events.begin(), events.end(), [](const PhaseEvent& a, const PhaseEvent& b) { return a.time < b.time; });
    return events;
}

}  // namespace

AnalyzedClip bake_gait(const HarmonicGait& gait, float speed, float turn_deg, float fps) {
    GaitBakeOptions options;
    options.fps = fps;
    return bake_gait(gait, speed, turn_deg, options);
}

AnalyzedClip bake_gait(const HarmonicGait& gait, float speed, float turn_deg, const GaitBakeOptions& options) {
    const float fps = options.fps;
    check_request(gait, speed, turn_deg, fps);
    std::vector<float> values(static_cast<std::size_t>(value_count(gait)));
    values_at(gait, speed, turn_deg, values);
    const StyleBody body = make_style_body(gait);
    apply_style(gait, body, options.style, values);
    apply_slope(gait, body, options.slope_deg, values);
    const GaitRhythm rhythm = rhythm_of(gait, values);
    const int steps = std::max(8, static_cast<int>(fps / rhythm.frequency + 0.5f));
    AnalyzedClip clip;
    Motion& motion = clip.motion = make_motion(gait.skeleton, name_of(gait, speed, turn_deg), steps + 1,
                                               static_cast<float>(steps) * rhythm.frequency);
    motion.cyclic = true;
    std::optional<GroundedBody> grounded;
    if (options.grounded && options.slope_deg == 0 && gait.basis.climb == 0 && gait.legs.count > 0)
        grounded.emplace(gait, values, rhythm);
    for (int f = 0; f <= steps; ++f) {
        const float share = static_cast<float>(f) / static_cast<float>(steps);
        motion.root[static_cast<std::size_t>(f)] =
            integrate(rhythm.velocity, rhythm.turn_rate, share / rhythm.frequency);
        const float phase = f == steps ? 0.0f : phase_of(rhythm, share);
        if (grounded)
            grounded->pose(phase, motion.frame(f));
        else
            pose(gait, values, phase, motion.frame(f));
    }
    std::vector<Transform> models(gait.skeleton->rest.size());
    local_to_model(*gait.skeleton, motion.frame(0), models);
    clip.roles = find_roles(*gait.skeleton, models);
    clip.legs = gait.soles;
    clip.facts.name = motion.name;
    clip.facts.file = gait.name;
    clip.facts.frames = motion.frame_count();
    clip.facts.joints = motion.joint_count();
    clip.facts.fps = motion.fps;
    clip.facts.duration = motion.duration();
    clip.facts.cyclic = true;
    measure(motion, clip.roles.roles, clip.legs, clip.facts);
    clip.facts.events = events_of(rhythm, motion.duration());
    clip.source = gait.name;
    return clip;
}

}  // namespace surefoot
