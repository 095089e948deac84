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

/// A change of where a foot is: its middle moves [m, world], and it turns about that [rad].
struct Correction {
    Vec3 move;
    float yaw = 0;
};

Vec3 middle(const std::array<Vec3, 4>& sole) { return sole[1]; }

/// What the touching part of the sole does from one frame to the next, as a rigid move over the ground: it turns by
/// `yaw` about `centre`, which goes by `move`. Where little more than a point touches, the foot may pivot about it.
struct Slip {
    Vec3 centre, move;
    float yaw = 0;

    /// Where a point was that the slip has brought here.
    Vec3 before(Vec3 here) const { return centre + rotate(from_yaw(-yaw), here - centre - move); }
};

Slip slip(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b) {
    constexpr float k_touches = 0.015f;                // [m] above the lowest point of the sole
    constexpr float k_pivot_square = 0.015f * 0.015f;  // [m^2] what touches within this radius pivots freely
    float low_a = a[0].y, low_b = b[0].y;
    for (std::size_t p = 1; p < 4; ++p) low_a = std::min(low_a, a[p].y), low_b = std::min(low_b, b[p].y);
    std::array<float, 4> weights{};
    float total = 0;
    Slip result;
    for (std::size_t p = 0; p < 4; ++p) {
        const float high = std::max(a[p].y - low_a, b[p].y - low_b);
        weights[p] = std::max(0.0f, 1 - high / k_touches);
        result.centre += weights[p] * a[p];
        result.move += weights[p] * (b[p] - a[p]);
        total += weights[p];
    }
    if (!(total > 0)) return {};
    result.centre = result.centre / total;
    result.move = Vec3{result.move.x / total, 0, result.move.z / total};
    float cross = 0, square = k_pivot_square * total;
    for (std::size_t p = 0; p < 4; ++p) {
        const Vec3 r = a[p] - result.centre, d = b[p] - a[p] - result.move;
        cross += weights[p] * (r.z * d.x - r.x * d.z);
        square += weights[p] * (r.x * r.x + r.z * r.z);
    }
    result.yaw = cross / square;
    return result;
}

/// The corrections over a stance, one a frame of it: they hold still what touches the ground, at the mean of its
/// places.
std::vector<Correction> corrections(const SoleTrack& sole, const Stance& stance) {
    const int first = static_cast<int>(std::floor(stance.first)), last = static_cast<int>(std::floor(stance.last));
    std::vector<Correction> result(1);
    Vec3 mean_place = middle(sole.at_frame(first));
    float mean_yaw = 0;
    for (int f = first; f < last; ++f) {
        const Correction& before = result.back();
        const Vec3 here = middle(sole.at_frame(f)), next = middle(sole.at_frame(f + 1));
        const Slip slipped = slip(sole.at_frame(f), sole.at_frame(f + 1));
        const Vec3 held = here + before.move + rotate(from_yaw(before.yaw), slipped.before(next) - here);
        result.push_back({{held.x - next.x, 0, held.z - next.z}, before.yaw - slipped.yaw});
        mean_place += held;
        mean_yaw += result.back().yaw;
    }
    const auto count = static_cast<float>(result.size());
    mean_place = mean_place / count;
    mean_yaw /= count;
    Vec3 mean_move;
    for (int f = first; f <= last; ++f) {
        Correction& c = result[at(f - first)];
        const Vec3 here = middle(sole.at_frame(f));
        const Vec3 turned = mean_place + rotate(from_yaw(-mean_yaw), here + c.move - mean_place);
        c = {{turned.x - here.x, 0, turned.z - here.z}, c.yaw - mean_yaw};
        mean_move += c.move / count;
    }
    for (Correction& c : result) c.move = c.move - mean_move;
    return result;
}

/// The correction at each frame: that of its stance, and in the swing between two.
std::vector<Correction> all_corrections(const SoleTrack& sole, const std::vector<Stance>& stances,
                                        const Motion& motion) {
    const int frames = motion.frame_count();
    std::vector<Correction> result(at(frames));
    std::vector<std::vector<Correction>> of(stances.size());
    for (std::size_t s = 0; s < stances.size(); ++s)
        if (stances[s].last >= -frames && stances[s].first <= 2 * frames) of[s] = corrections(sole, stances[s]);
    for (int f = 0; f < frames; ++f) {
        std::size_t next = 0;
        while (next < stances.size() && stances[next].last < f) ++next;
        if (next < stances.size() && stances[next].first <= f) {
            result[at(f)] = of[next][at(f - static_cast<int>(stances[next].first))];
            continue;
        }
        const Correction from = next > 0 && !of[next - 1].empty() ? of[next - 1].back() : Correction{};
        const Correction to = next < stances.size() && !of[next].empty() ? of[next].front() : Correction{};
        const double begin = next > 0 ? stances[next - 1].last : 0;
        const double end = next < stances.size() ? stances[next].first : frames - 1;
        const auto t = end > begin ? static_cast<float>((f - begin) / (end - begin)) : 0.0f;
        const float share = smooth_step(t);
        result[at(f)] = {lerp(from.move, to.move, share), from.yaw + share * (to.yaw - from.yaw)};
    }
    return result;
}

/// The correction as a move of root space.
RootFrame in_root_space(const Correction& correction, Vec3 middle, const RootFrame& root) {
    const Quat to_root = from_yaw(-root.yaw);
    const Vec3 about = rotate(to_root, middle - root.position);
    const Vec3 moved = about + rotate(to_root, correction.move) - rotate(from_yaw(correction.yaw), about);
    return {{moved.x, 0, moved.z}, correction.yaw};
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
        const SoleTrack sole(motion, legs.side[side]);
        const std::vector<Correction> all = all_corrections(sole, standing, motion);
        for (int f = 0; f < motion.frame_count(); ++f) {
            const Correction& correction = all[at(f)];
            if (correction.move == Vec3{} && correction.yaw == 0) continue;
            done.moved = std::max(done.moved, length(correction.move));
            done.turned = std::max(done.turned, std::fabs(correction.yaw));
            const RootFrame change = in_root_space(correction, middle(sole.at_frame(f)), motion.root[at(f)]);
            done.missed = std::max(done.missed, move_foot(*motion.skeleton, leg, change, result.frame(f)));
        }
    }
    join_ends(result);
    if (report) *report = done;
    return result;
}

}  // namespace surefoot
