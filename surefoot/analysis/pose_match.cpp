#include <surefoot/analysis/pose_match.h>

#include <algorithm>

namespace surefoot {
namespace {

std::vector<int> main_joints(const RoleMap& roles) {
    std::vector<int> joints;
    for (int r = 0; r < static_cast<int>(Role::left_thumb_metacarpal); ++r) {
        const Role role = static_cast<Role>(r);
        if (role == Role::jaw || role == Role::left_eye || role == Role::right_eye || !roles.has(role)) continue;
        joints.push_back(roles[role]);
    }
    return joints;
}

}  // namespace

KeyPoses key_poses(const Motion& motion, const RoleMap& roles) {
    KeyPoses poses;
    const std::vector<int> joints = main_joints(roles);
    poses.joints = static_cast<int>(joints.size());
    std::vector<Transform> world(motion.skeleton->rest.size());
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        for (const int j : joints) poses.positions.push_back(world[static_cast<std::size_t>(j)].translation);
    }
    const std::size_t count = joints.size(), n = motion.root.size();
    poses.velocities.resize(poses.positions.size());
    for (std::size_t f = 0; n > 1 && f < n; ++f) {
        const std::size_t a = f > 0 ? f - 1 : 0, b = std::min(f + 1, n - 1);
        for (std::size_t j = 0; j < count; ++j)
            poses.velocities[f * count + j] = (poses.positions[b * count + j] - poses.positions[a * count + j]) *
                                              (motion.fps / static_cast<float>(b - a));
    }
    return poses;
}

namespace {

/// Weighted least squares in the plane; `weights` add up to 1.
RootFrame best_step(std::span<const Vec3> pa, std::span<const Vec3> pb, std::span<const float> weights) {
    Vec3 ca, cb;
    for (std::size_t j = 0; j < pa.size(); ++j) ca += pa[j] * weights[j], cb += pb[j] * weights[j];
    double along = 0, aside = 0;  // sums of dot and cross products on the ground plane
    for (std::size_t j = 0; j < pa.size(); ++j) {
        const Vec3 u = pa[j] - ca, v = pb[j] - cb;
        along += static_cast<double>(weights[j] * (u.x * v.x + u.z * v.z));
        aside += static_cast<double>(weights[j] * (u.z * v.x - u.x * v.z));
    }
    const float yaw = static_cast<float>(atan2(aside, along));
    return {cb - rotate(from_yaw(yaw), ca), yaw};
}

}  // namespace

PoseMatch match_poses(const KeyPoses& poses, int a, int b) {
    const auto pa = poses.pose(a), pb = poses.pose(b);
    const std::vector<float> weights(pa.size(), 1 / static_cast<float>(pa.size()));
    return match_poses(poses, a, b, best_step(pa, pb, weights));
}

PoseMatch match_poses_evenly(const KeyPoses& poses, int a, int b) {
    constexpr int k_rounds = 12;
    const auto pa = poses.pose(a), pb = poses.pose(b);
    std::vector<float> weights(pa.size(), 1 / static_cast<float>(pa.size()));
    PoseMatch best = match_poses(poses, a, b, best_step(pa, pb, weights));
    for (int round = 0; round < k_rounds; ++round) {
        const Transform move = to_transform(best_step(pa, pb, weights));
        float sum = 0;
        for (std::size_t j = 0; j < pa.size(); ++j) {
            weights[j] *= distance(transform_point(move, pa[j]), pb[j]) + 1e-6f;
            sum += weights[j];
        }
        for (float& weight : weights) weight /= sum;
        const PoseMatch match = match_poses(poses, a, b, best_step(pa, pb, weights));
        if (match.distance < best.distance) best = match;
    }
    return best;
}

PoseMatch match_poses(const KeyPoses& poses, int a, int b, const RootFrame& step) {
    PoseMatch match;
    match.step = step;
    const Transform move = to_transform(step);
    const auto pa = poses.pose(a), pb = poses.pose(b), va = poses.speeds(a), vb = poses.speeds(b);
    for (std::size_t j = 0; j < pa.size(); ++j) {
        match.distance = std::max(match.distance, distance(transform_point(move, pa[j]), pb[j]));
        match.speed = std::max(match.speed, distance(rotate(move.rotation, va[j]), vb[j]));
    }
    return match;
}

}  // namespace surefoot
