#include <surefoot/motion/foot_edit.h>
#include <surefoot/motion/plant.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// One foot's sole points in the world, one set a frame; beyond the ends of a cyclic clip its travel is added.
class SoleTrack {
  public:
    SoleTrack(const Motion& motion, const Leg& leg) : cyclic_(motion.cyclic) {
        std::vector<Transform> world(at(motion.joint_count()));
        for (int f = 0; f < motion.frame_count(); ++f) {
            world_pose(motion, f, world);
            const SolePoints sole =
                sole_points(leg, world[at(leg.foot)], world[at(leg.toes == k_no_joint ? leg.foot : leg.toes)]);
            points_.push_back({sole.heel, sole.mid, sole.ball, sole.toe_tip});
        }
        step_ = motion.root.back() * between(motion.root.front(), RootFrame{});
    }
    std::array<Vec3, 4> at_frame(int f) const {
        const int last = static_cast<int>(points_.size()) - 1;
        if (!cyclic_ || (f >= 0 && f <= last)) return points_[at(std::clamp(f, 0, last))];
        const int cycles = f < 0 ? -((last - 1 - f) / last) : f / last;
        std::array<Vec3, 4> result = points_[at(f - cycles * last)];
        const Transform by = to_transform(cycles < 0 ? between(step_, RootFrame{}) : step_);
        for (int n = 0; n < std::abs(cycles); ++n)
            for (Vec3& p : result) p = transform_point(by, p);
        return result;
    }

  private:
    bool cyclic_;
    RootFrame step_;  // one cycle's move in the world
    std::vector<std::array<Vec3, 4>> points_;
};

/// What the touching part of the sole travels from one frame to the next.
Vec3 slip(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b) {
    constexpr float k_touches = 0.015f;  // [m] above the lowest point of the sole
    float low_a = a[0].y, low_b = b[0].y;
    for (std::size_t p = 1; p < 4; ++p) low_a = std::min(low_a, a[p].y), low_b = std::min(low_b, b[p].y);
    Vec3 sum;
    float weight = 0;
    for (std::size_t p = 0; p < 4; ++p) {
        const float high = std::max(a[p].y - low_a, b[p].y - low_b);
        const float w = std::max(0.0f, 1 - high / k_touches);
        sum += w * (b[p] - a[p]);
        weight += w;
    }
    if (!(weight > 0)) return {};
    return {sum.x / weight, 0, sum.z / weight};
}

/// The correction [m, world] at either end of a stance and in between, one a frame of it.
std::vector<Vec3> corrections(const SoleTrack& sole, const Stance& stance) {
    const int first = static_cast<int>(std::floor(stance.first)), last = static_cast<int>(std::floor(stance.last));
    std::vector<Vec3> result(1);
    for (int f = first; f < last; ++f) result.push_back(result.back() - slip(sole.at_frame(f), sole.at_frame(f + 1)));
    Vec3 mean;
    for (const Vec3 v : result) mean += v / static_cast<float>(result.size());
    for (Vec3& v : result) v = v - mean;
    return result;
}

/// The correction at each frame: that of its stance, and in the swing between two.
std::vector<Vec3> all_corrections(const SoleTrack& sole, const std::vector<Stance>& stances, const Motion& motion) {
    const int frames = motion.frame_count();
    std::vector<Vec3> result(at(frames));
    std::vector<std::vector<Vec3>> of(stances.size());
    for (std::size_t s = 0; s < stances.size(); ++s)
        if (stances[s].last >= -frames && stances[s].first <= 2 * frames) of[s] = corrections(sole, stances[s]);
    for (int f = 0; f < frames; ++f) {
        std::size_t next = 0;
        while (next < stances.size() && stances[next].last < f) ++next;
        if (next < stances.size() && stances[next].first <= f) {
            result[at(f)] = of[next][at(f - static_cast<int>(stances[next].first))];
            continue;
        }
        const Vec3 from = next > 0 && !of[next - 1].empty() ? of[next - 1].back() : Vec3{};
        const Vec3 to = next < stances.size() && !of[next].empty() ? of[next].front() : Vec3{};
        const double begin = next > 0 ? stances[next - 1].last : 0;
        const double end = next < stances.size() ? stances[next].first : frames - 1;
        const auto t = end > begin ? static_cast<float>((f - begin) / (end - begin)) : 0.0f;
        result[at(f)] = lerp(from, to, t * t * (3 - 2 * t));
    }
    return result;
}

}  // namespace

Motion plant(const Motion& motion, const RoleMap& roles, const Legs& legs, const StanceFlags& stances,
             PlantReport* report) {
    PlantReport done;
    Motion result = motion;
    for (std::size_t side = 0; side < 2 && motion.frame_count() > 1; ++side) {
        const LegJoints leg = leg_joints(roles, side);
        if (!leg.complete()) continue;
        const std::vector<Stance> standing = stances_of(stances[side], motion);
        if (standing.empty()) continue;
        const std::vector<Vec3> moves = all_corrections(SoleTrack(motion, legs.side[side]), standing, motion);
        for (int f = 0; f < motion.frame_count(); ++f) {
            const Vec3 move = rotate(from_yaw(-motion.root[at(f)].yaw), moves[at(f)]);
            if (move == Vec3{}) continue;
            done.moved = std::max(done.moved, length(move));
            done.missed = std::max(done.missed, move_foot(*motion.skeleton, leg, {move, 0}, result.frame(f)));
        }
    }
    join_ends(result);
    if (report) *report = done;
    return result;
}

}  // namespace surefoot
