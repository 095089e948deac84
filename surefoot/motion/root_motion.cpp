#include <surefoot/motion/root_motion.h>

#include <surefoot/motion/low_pass.h>

#include <algorithm>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Horizontal vector and its rotation by a heading, in double: paths are sums of thousands of steps.
struct Planar {
    double x = 0, z = 0;
};
Planar turned(Planar v, double yaw) {
    const double s = sin(yaw), c = cos(yaw);
    return {c * v.x + s * v.z, -s * v.x + c * v.z};
}

// Filters whole clips: periodic ones around the seam, others with their trend continued.
struct Filter {
    double sigma;  // frames
    bool cyclic;
    int intervals;

    // One value a frame.
    std::vector<double> frames(const std::vector<double>& v) const {
        return cyclic ? low_pass_periodic(v, intervals, v.back() - v.front(), sigma) : low_pass(v, sigma);
    }
    // One value an interval.
    std::vector<double> steps(const std::vector<double>& v) const {
        return cyclic ? low_pass_periodic(v, intervals, 0.0, sigma) : low_pass(v, sigma);
    }
};

struct Track {
    std::vector<double> x, y, z, yaw;  // of the hips and torso, one a frame; yaw unwrapped
};

Track track_body(const Motion& motion, const RoleMap& roles) {
    Track track;
    std::vector<Transform> world(at(motion.joint_count()));
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        const Vec3 hips = world[at(roles[Role::hips])].translation;
        track.x.push_back(static_cast<double>(hips.x));
        track.y.push_back(static_cast<double>(hips.y));
        track.z.push_back(static_cast<double>(hips.z));
        const double yaw = static_cast<double>(torso_yaw(roles, world));
        const double before = track.yaw.empty() ? 0.0 : track.yaw.back();
        track.yaw.push_back(before + wrap_angle(yaw - before));
    }
    return track;
}

// The path under the hips. A low-pass of positions alone would cut the corners of turns (a circle at 90 deg/s shrinks
// by 14 %), so the velocity is filtered in the turning frame of the body and summed up, and only what the hips do
// beside that (sway, and the slow drift of the sum) is filtered as a position, in the body's frame too.
std::vector<Planar> smooth_path(const Track& track, const std::vector<double>& yaw, const Filter& filter) {
    const std::size_t count = yaw.size();
    const auto middle = [&](std::size_t i) { return 0.5 * (yaw[i] + yaw[i + 1]); };
    std::vector<double> ahead, aside;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Planar step = turned({track.x[i + 1] - track.x[i], track.z[i + 1] - track.z[i]}, -middle(i));
        aside.push_back(step.x);
        ahead.push_back(step.z);
    }
    aside = filter.steps(aside);
    ahead = filter.steps(ahead);
    std::vector<Planar> path(count);
    path[0] = {track.x[0], track.z[0]};
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Planar step = turned({aside[i], ahead[i]}, middle(i));
        path[i + 1] = {path[i].x + step.x, path[i].z + step.z};
    }
    std::vector<double> rest_x, rest_z;
    for (std::size_t i = 0; i < count; ++i) {
        const Planar rest = turned({track.x[i] - path[i].x, track.z[i] - path[i].z}, -yaw[i]);
        rest_x.push_back(rest.x);
        rest_z.push_back(rest.z);
    }
    rest_x = filter.frames(rest_x);
    rest_z = filter.frames(rest_z);
    for (std::size_t i = 0; i < count; ++i) {
        const Planar rest = turned({rest_x[i], rest_z[i]}, yaw[i]);
        path[i].x += rest.x;
        path[i].z += rest.z;
    }
    return path;
}

// Joints above the hips, from the top down.
std::vector<int> above(const Skeleton& skeleton, int joint) {
    std::vector<int> chain;
    for (int j = skeleton.parents[at(joint)]; j != k_no_joint; j = skeleton.parents[at(j)])
        chain.insert(chain.begin(), j);
    return chain;
}

// Direction from the right joint to the left one on the ground; short where the pair is seen from above as a point.
Vec3 level_left(const RoleMap& roles, std::span<const Transform> models, Role left) {
    const Role right = mirrored(left);
    if (!roles.has(left) || !roles.has(right)) return {};
    const Vec3 d = models[at(roles[left])].translation - models[at(roles[right])].translation;
    return Vec3{d.x, 0, d.z} / std::fmax(length(d), 1e-6f);
}

}  // namespace

float torso_yaw(const RoleMap& roles, std::span<const Transform> models) {
    Vec3 left = level_left(roles, models, Role::left_upper_leg);
    const bool arms = roles.has(Role::left_upper_arm) && roles.has(Role::right_upper_arm);
    left += level_left(roles, models, arms ? Role::left_upper_arm : Role::left_shoulder);
    if (!(length_squared(left) > 1e-12f)) return 0;
    return atan2(-left.z, left.x);  // forward = left x up
}

void set_root_frames(Motion& motion, std::span<const RootFrame> frames) {
    for (int f = 0; f < motion.frame_count() && f < static_cast<int>(frames.size()); ++f) {
        const Transform change = inverse(to_transform(frames[at(f)])) * to_transform(motion.root[at(f)]);
        const auto pose = motion.frame(f);
        for (int j = 0; j < motion.joint_count(); ++j)
            if (motion.skeleton->parents[at(j)] == k_no_joint) {
                pose[at(j)] = change * pose[at(j)];
                pose[at(j)].rotation = normalized(pose[at(j)].rotation);
            }
        motion.root[at(f)] = frames[at(f)];
    }
}

void bake_root_motion(Motion& motion) {
    const std::vector<RootFrame> none(motion.root.size());
    set_root_frames(motion, none);
}

void extract_root_motion(Motion& motion, const RoleMap& roles, const RootMotionOptions& options) {
    const int hips = roles[Role::hips];
    if (hips == k_no_joint || motion.frame_count() < 1) return;
    const Track track = track_body(motion, roles);
    const int intervals = motion.frame_count() - 1;
    std::vector<RootFrame> frames(motion.root.size());
    const auto write = [&](std::size_t f, double x, double y, double z, double yaw) {
        frames[f] = {{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}, static_cast<float>(yaw)};
    };
    if (intervals < 1) {
        write(0, track.x[0], 0, track.z[0], track.yaw[0]);
    } else {
        // The widest kernel: 0.35 s at 2,800 frames a second. Files that claim a million must not cost hours.
        constexpr double k_most_frames = 1000;
        const double sigma = std::fmin(
            k_most_frames, std::fmax(1e-3, static_cast<double>(options.smoothing) * static_cast<double>(motion.fps)));
        const Filter filter{sigma, motion.cyclic, intervals};
        const std::vector<double> yaw = filter.frames(track.yaw);
        const std::vector<Planar> path = smooth_path(track, yaw, filter);
        const std::vector<double> height =
            options.follow_climb ? filter.frames(track.y) : std::vector<double>(track.y.size(), 0.0);
        for (std::size_t f = 0; f < frames.size(); ++f) write(f, path[f].x, height[f] - height[0], path[f].z, yaw[f]);
    }
    set_root_frames(motion, frames);
    fold_dedicated_root(motion, roles);
}

void fold_dedicated_root(Motion& motion, const RoleMap& roles) {
    const int hips = roles[Role::hips];
    if (hips == k_no_joint) return;
    const Skeleton& skeleton = *motion.skeleton;
    const std::vector<int> chain = above(skeleton, hips);
    if (chain.empty()) return;
    const auto in_chain = [&](int j) { return std::find(chain.begin(), chain.end(), j) != chain.end(); };
    std::vector<Transform> models(at(motion.joint_count()));
    for (int f = 0; f < motion.frame_count(); ++f) {
        const auto pose = motion.frame(f);
        local_to_model(skeleton, pose, models);
        for (const int j : chain) pose[at(j)] = skeleton.rest[at(j)];
        std::vector<Transform> resting(models.size());
        local_to_model(skeleton, pose, resting);
        for (int j = 0; j < motion.joint_count(); ++j) {
            const int parent = skeleton.parents[at(j)];
            if (parent != k_no_joint && in_chain(parent) && !in_chain(j)) {
                pose[at(j)] = inverse(resting[at(parent)]) * models[at(j)];
                pose[at(j)].rotation = normalized(pose[at(j)].rotation);
            }
        }
    }
}

void shift_pose(Motion& motion, const RoleMap& roles, Vec3 offset) {
    const Skeleton& skeleton = *motion.skeleton;
    const std::vector<int> chain = roles.has(Role::hips) ? above(skeleton, roles[Role::hips]) : std::vector<int>{};
    const auto in_chain = [&](int j) { return std::find(chain.begin(), chain.end(), j) != chain.end(); };
    std::vector<Transform> models(at(motion.joint_count()));
    for (int f = 0; f < motion.frame_count(); ++f) {
        const auto pose = motion.frame(f);
        local_to_model(skeleton, pose, models);
        for (int j = 0; j < motion.joint_count(); ++j) {
            const int parent = skeleton.parents[at(j)];
            if (in_chain(j) || !(parent == k_no_joint || in_chain(parent))) continue;
            const Quat to_parent = parent == k_no_joint ? Quat{} : conjugate(models[at(parent)].rotation);
            pose[at(j)].translation += rotate(to_parent, offset);
        }
    }
}

void move_clip(Motion& motion, const RootFrame& by) {
    for (RootFrame& frame : motion.root) frame = by * frame;
}

}  // namespace surefoot
