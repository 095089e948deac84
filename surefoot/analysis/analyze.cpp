#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/footing.h>
#include <surefoot/analysis/ground_fit.h>
#include <surefoot/analysis/locomotion.h>
#include <surefoot/analysis/pose_match.h>
#include <surefoot/analysis/repair.h>
#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/treadmill.h>
#include <surefoot/base/error.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>

#include <fmt/format.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_loop_seam = 0.05f;       // [m] first and last pose of a clip made to loop agree this well …
constexpr float k_in_place_speed = 0.25f;  // [m/s] feet that run slower than this under the body only shift about
constexpr float k_in_place_turn = 20;      // [deg/s]
constexpr float k_skating = 0.10f;         // [m/s]

RoleReport roles_of(const Motion& motion, const std::string& file, const RoleOverrides& overrides) {
    const Skeleton& skeleton = *motion.skeleton;
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    RoleReport report = find_roles(skeleton, models, overrides);
    if (!report.roles.has_legs()) {  // a rest pose without shape: the first frame has one
        local_to_model(skeleton, motion.frame(0), models);
        RoleReport other = find_roles(skeleton, models, overrides);
        if (other.roles.has_legs()) report = std::move(other);
    }
    if (report.roles.has_legs()) return report;
    std::string missing;
    for (const Role role : {Role::hips, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot,
                            Role::right_upper_leg, Role::right_lower_leg, Role::right_foot})
        if (!report.roles.has(role)) missing += (missing.empty() ? "" : ", ") + std::string(role_name(role));
    throw Error("the skeleton of '" + motion.name + "' has no two legs: no joint was found for " + missing, file,
                "name the joints by hand (role=joint), or leave this clip out");
}

bool has_root_motion(const Motion& motion) {
    return std::any_of(motion.root.begin(), motion.root.end(), [](const RootFrame& r) { return r != RootFrame{}; });
}

constexpr float k_steepest_tilt = 0.05f;    // of a capture volume that was meant to be level: 3 degrees
constexpr float k_level_loop = 0.02f;       // [leg lengths] a loop that ends less higher than it began is level
constexpr float k_smallest_tilt = 0.0015f;  // [1] below this, levelling would only change bits

void transform_clip(Motion& motion, int frame, const Transform& by) {
    const auto pose = motion.frame(frame);
    for (std::size_t j = 0; j < pose.size(); ++j)
        if (motion.skeleton->parents[j] == k_no_joint) pose[j] = by * pose[j];
}

/// Takes the tilt out of a capture whose floor is one nearly level plane, and brings that plane to y = 0.
bool level_ground(Motion& motion, const Tracks& tracks, float leg_length) {
    const GroundFit ground = fit_ground(tracks, leg_length);
    if (ground.samples < 3 || !ground.planar || ground.steepness() > k_steepest_tilt) return false;
    if (ground.steepness() < k_smallest_tilt && std::fabs(ground.height) < 0.004f) return false;
    Vec3 centre;
    for (const Transform& hips : tracks.hips) centre += hips.translation / static_cast<float>(tracks.hips.size());
    centre.y = ground.at(centre);
    const Quat turn = rotation_between({-ground.slope_x, 1, -ground.slope_z}, k_up);
    const Vec3 moved = Vec3{centre.x, 0, centre.z} - rotate(turn, centre);
    for (int f = 0; f < motion.frame_count(); ++f) transform_clip(motion, f, {turn, moved});
    return true;
}

/// The same for a clip on a treadmill, where tilt shows as a rise in time.
bool level_in_time(Motion& motion, const Tracks& tracks) {
    const float rise = ground_trend(tracks), time = motion.duration();
    if (std::fabs(rise) * time < 0.02f || std::fabs(rise) > 0.15f) return false;
    for (int f = 0; f < motion.frame_count(); ++f) {
        const float t = static_cast<float>(f) / motion.fps - 0.5f * time;
        transform_clip(motion, f, {{}, {0, -rise * t, 0}});
    }
    return true;
}

/// [m] from the first frame to the last.
float rise_of_hips(const Tracks& tracks) {
    return tracks.hips.back().translation.y - tracks.hips.front().translation.y;
}

/// First and last pose agree, and the motion runs through the seam no more abruptly than elsewhere.
bool loops(const Motion& motion, const RoleMap& roles, float leg_length) {
    const int last = motion.frame_count() - 1;
    if (last < 3 || motion.duration() < 0.25f) return false;
    const KeyPoses poses = key_poses(motion, roles);
    const PoseMatch seam = match_poses(poses, 0, last);
    if (seam.distance > k_loop_seam * leg_length) return false;
    float roughest = 0;  // the largest change of velocity over two frames, which is what the seam's differences span
    for (int f = 1; f + 2 <= last; ++f) {
        const auto a = poses.speeds(f), b = poses.speeds(f + 1);
        for (std::size_t j = 0; j < a.size(); ++j) roughest = std::max(roughest, distance(a[j], b[j]));
    }
    return seam.speed < 0.3f + 2 * roughest;
}

/// Planar extent of the hips' smooth path.
float hips_extent(const Tracks& tracks) {
    std::vector<Vec3> path;
    for (const Transform& hips : tracks.hips) path.push_back(hips.translation);
    Vec3 low{1e30f, 0, 1e30f}, high{-1e30f, 0, -1e30f};
    for (const Vec3 p : smoothed(path, 0.2f * tracks.fps)) {
        low = {std::min(low.x, p.x), 0, std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), 0, std::max(high.z, p.z)};
    }
    return planar_length(high - low);
}

/// [deg/s] What standing feet cannot tell from no turn at all: 8 at a walk, 30 and more in a run, whose stances are
/// short (measured on captured walks and runs made in place), and more where next to no frame shows a stance.
float turn_doubt(const GroundMotion& ground) {
    const float sparse = 1 + 10 * std::max(0.0f, 0.4f - ground.coverage);
    return sparse * (8 + 6 * std::max(0.0f, ground.speed() - 1.4f));
}

/// Does the clip tread in place? Then `found` says how the character moves over its ground.
bool treads_in_place(const Tracks& tracks, bool looping, float leg_length, GroundMotion& found) {
    if (tracks.frame_count() < 4) return false;
    const Tracks three = looping ? repeated(tracks, {}, {}) : tracks;
    found = estimate_ground_motion(three, leg_length);
    const float straight = 0;
    if (std::fabs(found.turn) * k_degrees_per_radian < turn_doubt(found))
        found = estimate_ground_motion(three, leg_length, &straight);
    const float time = static_cast<float>(tracks.frame_count() - 1) / tracks.fps;
    const float tempo = std::sqrt(leg_length / 0.9f);
    const bool runs = found.speed() > k_in_place_speed * tempo;
    const bool turns = std::fabs(found.turn) * k_degrees_per_radian > k_in_place_turn;
    if (!(runs || turns) || found.coverage < 0.06f) return false;
    if (found.residual > 0.35f * found.speed() + 0.15f * tempo) return false;  // the feet do not agree on a ground
    return hips_extent(tracks) < std::max(0.3f * found.speed() * time, 0.1f * leg_length);
}

void add_warnings(const Measured& measured, const BodyFeatures& body, AnalyzedClip& clip) {
    ClipFacts& facts = clip.facts;
    std::vector<std::string>& warnings = facts.warnings;
    if (facts.hip_height < 0.3f || facts.hip_height > 2)
        warnings.push_back(fmt::format("the hips are {:.3g} m above the ground: are the units right? (--unit-scale)",
                                       facts.hip_height));
    const std::size_t head =
        std::min<std::size_t>(measured.tracks.hips.size(), static_cast<std::size_t>(facts.fps * 0.1f) + 1);
    std::vector<Vec3> hips;
    for (const Transform& joint : measured.tracks.hips) hips.push_back(joint.translation);
    const std::vector<Vec3> speed = derivative(smoothed(hips, 0.1f * facts.fps), facts.fps);
    const auto raised = [&](std::size_t f) {
        const auto &hand = measured.tracks.hand, &arm = measured.tracks.upper_arm;
        if (hand[0].empty() || hand[1].empty() || arm[0].empty() || arm[1].empty()) return false;
        const float margin = 0.1f * facts.hip_height;
        if (length(speed[f]) > 0.2f) return false;
        return hand[0][f].y > arm[0][f].y - margin && hand[1][f].y > arm[1][f].y - margin;
    };
    std::size_t calibration = 0;
    while (calibration < measured.tracks.hips.size() && raised(calibration)) ++calibration;
    if (calibration >= head && body.arms_up < 0.9f)
        warnings.push_back(fmt::format("starts with raised arms (a calibration pose) until {:.2f} s",
                                       static_cast<float>(calibration) / facts.fps));
    if (facts.skate > k_skating)
        warnings.push_back(fmt::format("planted feet slide at {:.0f} cm/s", 100 * facts.skate));
    if (facts.locomotion && std::fabs(facts.speed) > 0.3f &&
        facts.root_disagreement_speed > 0.1f * std::fabs(facts.speed))
        warnings.push_back(
            fmt::format("root motion and standing feet disagree by {:.2f} m/s", facts.root_disagreement_speed));
    if (!facts.locomotion) warnings.push_back("not locomotion: " + facts.not_locomotion);
}

}  // namespace

AnalyzedClip analyze_clip(Motion motion, const std::string& file, float unit_scale, const RoleOverrides& overrides) {
    if (const std::string fault = problem(motion); !fault.empty()) throw Error(fault, file, "export the clip again");
    AnalyzedClip clip;
    clip.roles = roles_of(motion, file, overrides);
    const RoleMap& roles = clip.roles.roles;
    const bool own_root = motion.cyclic || has_root_motion(motion);  // ours, come back from a file

    const Repair repair = repair_dropped_frames(motion, roles);
    Tracks tracks = make_tracks(motion, roles);
    const Footing footing = find_footing(motion, roles, tracks);
    clip.legs = footing.legs;
    const float leg = 0.5f * (clip.legs[Side::left].length() + clip.legs[Side::right].length());
    if (!(leg > 1e-4f))
        throw Error("the legs of '" + motion.name + "' have no length", file, "export the clip with its bone offsets");
    if (footing.floor != 0) {
        shift_pose(motion, roles, {0, -footing.floor, 0});
        tracks = make_tracks(motion, roles);
    }
    add_soles(tracks, clip.legs);
    if (!own_root) {
        const bool travels = fit_ground(tracks, leg).samples > 0;
        const bool level = loops(motion, roles, leg) && std::fabs(rise_of_hips(tracks)) < k_level_loop * leg;
        if (travels ? level_ground(motion, tracks, leg) : !level && level_in_time(motion, tracks)) {
            tracks = make_tracks(motion, roles);
            add_soles(tracks, clip.legs);
        }
    }

    const bool looping = motion.cyclic || loops(motion, roles, leg);
    GroundMotion ground;
    clip.facts.in_place = !has_root_motion(motion) && treads_in_place(tracks, looping, leg, ground);
    if (clip.facts.in_place) {
        motion.root = constant_path(ground, motion.fps, motion.frame_count());
        move_tracks(tracks, motion.root);
    }
    motion.cyclic = looping;
    if (!own_root) {
        RootMotionOptions options;
        options.follow_climb = find_contacts(tracks, leg).uneven;
        extract_root_motion(motion, roles, options);
    }

    clip.motion = std::move(motion);
    clip.facts.name = clip.motion.name;
    clip.facts.file = clip.source = file;
    clip.facts.unit_scale = unit_scale;
    clip.facts.warnings = repair.warnings;
    clip.source_first = repair.first;
    clip.source_last = repair.last;
    Measured measured = measure(clip.motion, roles, clip.legs, clip.facts);
    const BodyFeatures body = body_features(measured, clip.facts, leg);
    clip.facts.not_locomotion = why_not_locomotion(body, clip.facts, leg);
    clip.facts.locomotion = clip.facts.not_locomotion.empty();
    add_warnings(measured, body, clip);
    return clip;
}

}  // namespace surefoot
