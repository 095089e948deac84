#pragma once
// Gaits of expressions as clips: a text's controls on a body, frame by frame, measured like any other clip.
//
//     const GaitActor actor = make_gait_actor({skeleton, roles, legs, {}}, "hero.glb");
//     AnalyzedClip walk = play_gait(read_gait(text, "walk.gait"), values, actor, {.speed_mps = 1.4});
//
// A gait is written for an adult of 1.75 m (body/channels.h). On another body lengths go with its legs and arms, and
// times with the root of that, so speeds that are asked for hold in the world: the gait is asked for the speed that its
// own body would have to go at.

#include <surefoot/analysis/analyze.h>
#include <surefoot/body/body.h>
#include <surefoot/gait_text/gait.h>

#include <memory>
#include <string>
#include <vector>

namespace surefoot {

/// A character that gaits can be put on.
struct GaitActor {
    std::shared_ptr<const Skeleton> skeleton;
    RoleReport roles;
    Legs legs;
    Body body;
};

/// `shape` is a pose in model space that no bone is twisted in (motion/stance.h); empty: the rest pose. `name` is for
/// messages. Throws Error where the legs are missing or do not hang from the hips.
GaitActor make_gait_actor(std::shared_ptr<const Skeleton> skeleton, RoleReport roles, const Legs& legs,
                          std::span<const Transform> shape, const std::string& name);

struct GaitPlay {
    double speed_mps = 0;   ///< asked for; gaits take 0 for their own
    double turn_deg_s = 0;  ///< positive to the left
    double slope_deg = 0;   ///< positive uphill
    double fps = 60;        ///< [10 to 240] frames a second, of which a cycle takes a whole number: the nearest
    int cycles = 1;         ///< [1 to 1000] in the clip
};

/// What a gait's controls mean to a body; `unknown` are those that mean nothing.
BodyBinding bind_gait(const Gait& gait);

/// `values` as from gait_values. The clip is cyclic, starts at phase 0, and carries root motion, contacts and events.
/// Throws Error where the options are out of range or the gait has no period.
AnalyzedClip play_gait(const Gait& gait, std::span<const double> values, const GaitActor& actor,
                       const GaitPlay& play = {});

/// Its motion alone: nothing is measured, which takes most of the time.
Motion gait_motion(const Gait& gait, std::span<const double> values, const GaitActor& actor, const GaitPlay& play = {});

}  // namespace surefoot
