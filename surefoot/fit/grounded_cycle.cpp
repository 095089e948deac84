#include <surefoot/base/error.h>
#include <surefoot/fit/fit_gait.h>
#include <surefoot/fit/grounded_cycle.h>
#include <surefoot/fit/rolling_foot.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_fps = 60;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Where the hips are over the root, in the mean over the cycle.
Vec3 mean_hips(const HarmonicGait& gait, std::span<const float> values, int frames) {
    std::vector<Transform> locals(gait.skeleton->rest.size()), models(locals.size());
    Vec3 mean;
    for (int f = 0; f < frames; ++f) {
        const float phase = static_cast<float>(f) / static_cast<float>(frames);
        joint_pose(gait, values, {}, {&phase, 1}, locals);
        local_to_model(*gait.skeleton, locals, models);
        mean += models[at(gait.soles.hips)].translation / static_cast<float>(frames);
    }
    return {mean.x, 0, mean.z};
}

}  // namespace

Motion grounded_cycle(const HarmonicGait& gait, float speed, float turn_deg, const GaitStyle& style) {
    check_request(gait, speed, turn_deg, k_fps);
    if (gait.legs.count == 0) throw Error("the gait has no feet", gait.name, "fit it to a clip with both legs");
    if (gait.basis.climb != 0) throw Error("the gait is made for stairs", gait.name, "bake it as it is");
    std::vector<float> values(at(value_count(gait)));
    values_at(gait, speed, turn_deg, values);
    apply_style(gait, make_style_body(gait), style, values);
    GaitRhythm rhythm = rhythm_of(gait, values);
    const int frames = std::max(8, 2 * static_cast<int>(0.5f * k_fps / rhythm.frequency + 0.5f));
    rhythm.frequency = k_fps / static_cast<float>(frames);
    rhythm.right_strike = 0.5f;
    const Vec3 origin = mean_hips(gait, values, frames);
    const GroundedBody body(gait, values, rhythm, origin);
    Motion motion = make_motion(gait.skeleton, gait.name, frames + 1, k_fps);
    motion.cyclic = true;
    for (int f = 0; f <= frames; ++f) {
        body.pose(static_cast<float>(f % frames) / static_cast<float>(frames), motion.frame(f));
        motion.root[at(f)] = integrate(rhythm.velocity, rhythm.turn_rate, static_cast<float>(f) / k_fps);
    }
    return motion;
}

}  // namespace surefoot
