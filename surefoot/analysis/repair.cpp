#include <surefoot/analysis/repair.h>
#include <surefoot/motion/edit.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_impossible_speed = 20;  // [m/s] of the hips between two frames

std::vector<Vec3> hips_path(const Motion& motion, int hips) {
    std::vector<Vec3> path;
    std::vector<Transform> world(motion.skeleton->rest.size());
    for (int f = 0; f < motion.frame_count(); ++f) {
        world_pose(motion, f, world);
        path.push_back(world[static_cast<std::size_t>(hips)].translation);
    }
    return path;
}

/// The longest stretch without an impossible step.
std::pair<int, int> longest_run(const std::vector<Vec3>& path, float limit) {
    std::pair<int, int> best{0, 0};
    int begin = 0;
    for (int f = 1; f <= static_cast<int>(path.size()); ++f) {
        const std::size_t i = static_cast<std::size_t>(f);
        if (i < path.size() && distance(path[i], path[i - 1]) <= limit) continue;
        if (f - 1 - begin > best.second - best.first) best = {begin, f - 1};
        begin = f;
    }
    return best;
}

/// Walks from a sound frame in one direction and keeps what a body can reach from the last sound one.
void keep_reachable(const std::vector<Vec3>& path, float limit, int from, int step, std::vector<char>& sound) {
    int last = from;
    for (int f = from + step; f >= 0 && f < static_cast<int>(path.size()); f += step) {
        const float steps = static_cast<float>(std::min(std::abs(f - last), 3));  // a long gap is no licence to jump
        if (distance(path[static_cast<std::size_t>(f)], path[static_cast<std::size_t>(last)]) > limit * steps) continue;
        sound[static_cast<std::size_t>(f)] = 1;
        last = f;
    }
}

void fill(Motion& motion, int before, int after) {
    for (int f = before + 1; f < after; ++f) {
        const float t = static_cast<float>(f - before) / static_cast<float>(after - before);
        const auto a = motion.frame(before), b = motion.frame(after);
        const auto pose = motion.frame(f);
        for (std::size_t j = 0; j < pose.size(); ++j)
            pose[j] = {slerp(a[j].rotation, b[j].rotation, t), lerp(a[j].translation, b[j].translation, t)};
    }
}

std::string frames_text(int first, int last) {
    return first == last ? "frame " + std::to_string(first)
                         : "frames " + std::to_string(first) + " to " + std::to_string(last);
}

}  // namespace

Repair repair_dropped_frames(Motion& motion, const RoleMap& roles) {
    Repair repair;
    const int n = motion.frame_count();
    repair.last = n - 1;
    const std::vector<Vec3> path = hips_path(motion, roles[Role::hips]);
    const float limit = k_impossible_speed / motion.fps;
    const auto [begin, end] = longest_run(path, limit);
    if (end - begin == n - 1) return repair;

    std::vector<char> sound(path.size());
    std::fill(sound.begin() + begin, sound.begin() + end + 1, char{1});
    keep_reachable(path, limit, end, 1, sound);
    keep_reachable(path, limit, begin, -1, sound);
    const auto dropped = std::count(sound.begin(), sound.end(), char{0});
    if (dropped * 3 > n) {
        repair.warnings.push_back("the hips jump from place to place (" + std::to_string(dropped) + " of " +
                                  std::to_string(n) + " frames do not fit the rest); nothing was repaired");
        return repair;
    }
    while (!sound[static_cast<std::size_t>(repair.first)]) ++repair.first;
    while (!sound[static_cast<std::size_t>(repair.last)]) --repair.last;
    for (int f = repair.first; f < repair.last; ++f) {
        int next = f + 1;
        while (!sound[static_cast<std::size_t>(next)]) ++next;
        if (next == f + 1) continue;
        fill(motion, f, next);
        repair.warnings.push_back(frames_text(f + 1, next - 1) + " were dropped by the capture; filled in");
        f = next - 1;
    }
    if (repair.first > 0)
        repair.warnings.push_back(frames_text(0, repair.first - 1) + " were dropped by the capture; cut off");
    if (repair.last < n - 1)
        repair.warnings.push_back(frames_text(repair.last + 1, n - 1) + " were dropped by the capture; cut off");
    if (repair.first > 0 || repair.last < n - 1) motion = cut(motion, repair.first, repair.last);
    return repair;
}

}  // namespace surefoot
