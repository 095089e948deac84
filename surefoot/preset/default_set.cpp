#include <surefoot/author/fitted_gaits.h>
#include <surefoot/fit/grounded_cycle.h>
#include <surefoot/motion/edit.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/preset/level_head.h>

#include <map>
#include <string>

namespace surefoot {
namespace {

/// A clip of the set, and which gait does it at what speed [m/s] and turn [deg/s]. What turns to its left, or goes
/// there, is there to its right, too.
struct Wanted {
    const char *name, *mirrored, *gait;
    float speed, turn_deg;
    float stride = 1;  ///< of the actor's, who ran in a small hall and in short quick steps
};

constexpr Wanted k_wanted[] = {
    {"idle", nullptr, "idle", 0, 0},
    {"walk", nullptr, "human", 1.4f, 0},
    {"walk_left", "walk_right", "human", 1.4f, 45},
    {"jog", nullptr, "human", 2.6f, 0, 1.08f},
    {"jog_left", "jog_right", "human", 2.6f, 70, 1.08f},
    {"run", nullptr, "human", 4.2f, 0, 1.2f},
    {"run_left", "run_right", "human", 4.2f, 45, 1.2f},
    {"back", nullptr, "back", 1.0f, 0},
    {"back_left", "back_right", "back", 1.0f, 30},
    {"strafe_left", "strafe_right", "strafe_left", 0.9f, 0},
    {"turn_left_slow", "turn_right_slow", "turn", 0, 45},
    {"turn_left", "turn_right", "turn", 0, 90},
};

/// The second half of the cycle becomes the mirror image of the first, which it is but for rounding where strides were
/// fitted together with their mirror images.
void mirror_second_half(Motion& motion, const RoleMap& roles) {
    const MirrorMap map = mirror_map(*motion.skeleton, roles);
    std::vector<Transform> scratch(2 * static_cast<std::size_t>(motion.joint_count()));
    const int half = (motion.frame_count() - 1) / 2;
    for (int f = 0; f < half; ++f) mirror_pose(*motion.skeleton, map, motion.frame(f), motion.frame(f + half), scratch);
}

}  // namespace

ClipSet make_default_set() {
    std::map<std::string, HarmonicGait> gaits;
    ClipSet set;
    for (const Wanted& wanted : k_wanted) {
        const auto [found, is_new] = gaits.try_emplace(wanted.gait);
        HarmonicGait& gait = found->second;
        if (is_new) gait = fitted_gait(wanted.gait);
        if (!set.skeleton) {
            set.skeleton = gait.skeleton;
            std::vector<Transform> rest(gait.skeleton->rest.size());
            local_to_model(*gait.skeleton, gait.skeleton->rest, rest);
            set.roles = find_roles(*gait.skeleton, rest).roles;
        }
        GaitStyle style;
        style.stride = wanted.stride;
        Motion clip = grounded_cycle(gait, wanted.speed, wanted.turn_deg, style);
        clip.skeleton = set.skeleton;  // all bundled gaits are of one body
        clip.name = wanted.name;
        level_head(clip, set.roles);
        if (!wanted.mirrored && wanted.speed > 0) mirror_second_half(clip, set.roles);
        if (wanted.mirrored) {
            Motion other = rotate_cycle(mirror(clip, set.roles), (clip.frame_count() - 1) / 2);
            start_at_origin(other);
            other.name = wanted.mirrored;
            set.clips.push_back(clip);
            set.clips.push_back(std::move(other));
        } else {
            set.clips.push_back(std::move(clip));
        }
    }
    return set;
}

}  // namespace surefoot
