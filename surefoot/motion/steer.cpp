#include <surefoot/motion/foot_edit.h>
#include <surefoot/motion/steer.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A root path that can be read between frames and, where the clip repeats, beyond its ends.
class Path {
  public:
    Path(std::vector<RootFrame> frames, bool cyclic) : frames_(std::move(frames)), cyclic_(cyclic) {}

    RootFrame at_frame(double where) const {
        const auto last = static_cast<double>(frames_.size() - 1);
        if (!cyclic_ || (where >= 0 && where <= last)) return within(std::clamp(where, 0.0, last));
        // A stance reaches over the seam by less than a cycle.
        const RootFrame step = between(frames_.front(), frames_.back());
        const RootFrame local = between(frames_.front(), within(where < 0 ? where + last : where - last));
        return frames_.front() * (where < 0 ? between(step, RootFrame{}) : step) * local;
    }

  private:
    RootFrame within(double where) const {
        const std::size_t f =
            std::min(static_cast<std::size_t>(std::max(where, 0.0)), frames_.size() < 2 ? 0 : frames_.size() - 2);
        if (frames_.size() < 2) return frames_.front();
        const auto t = static_cast<float>(where - static_cast<double>(f));
        const RootFrame &a = frames_[f], &b = frames_[f + 1];
        return {lerp(a.position, b.position, t), a.yaw + (b.yaw - a.yaw) * t};
    }

    std::vector<RootFrame> frames_;
    bool cyclic_;
};

struct Means {
    double turn = 0, lateral = 0, forward = 0;
};

Vec3 body_step(const RootFrame& a, const RootFrame& b) {
    return rotate(from_yaw(-0.5f * (a.yaw + b.yaw)), b.position - a.position);
}

Means means_of(const Motion& motion) {
    Means means;
    const double time = static_cast<double>(motion.duration());
    for (std::size_t f = 1; f < motion.root.size(); ++f) {
        const Vec3 step = body_step(motion.root[f - 1], motion.root[f]);
        means.lateral += static_cast<double>(step.x) / time;
        means.forward += static_cast<double>(step.z) / time;
    }
    means.turn = static_cast<double>(motion.root.back().yaw - motion.root.front().yaw) / time;
    return means;
}

/// The root path with constant velocities added in the body's frame.
std::vector<RootFrame> changed_path(const Motion& motion, const Means& added) {
    std::vector<RootFrame> path = motion.root;
    const double dt = 1 / static_cast<double>(motion.fps);
    double x = static_cast<double>(path[0].position.x), z = static_cast<double>(path[0].position.z);
    for (std::size_t f = 1; f < path.size(); ++f) {
        const Vec3 step = body_step(motion.root[f - 1], motion.root[f]);
        path[f].yaw =
            static_cast<float>(static_cast<double>(motion.root[f].yaw) + added.turn * dt * static_cast<double>(f));
        const double middle = 0.5 * (static_cast<double>(path[f].yaw) + static_cast<double>(path[f - 1].yaw));
        const double aside = static_cast<double>(step.x) + added.lateral * dt;
        const double ahead = static_cast<double>(step.z) + added.forward * dt;
        x += cos(middle) * aside + sin(middle) * ahead;
        z += cos(middle) * ahead - sin(middle) * aside;
        path[f].position.x = static_cast<float>(x);
        path[f].position.z = static_cast<float>(z);
    }
    return path;
}

/// At which moment of the path a foot sees the bend: the middle of its stance, and in the swing from one to the next.
std::vector<double> foot_times(const std::vector<char>& down, const Motion& motion) {
    const int frames = motion.frame_count();
    const std::vector<Stance> stances = stances_of(down, motion);
    std::vector<double> times(at(frames));
    std::size_t next = 0;  // first stance that ends at f or later
    for (int f = 0; f < frames; ++f) {
        const double now = f;
        while (next < stances.size() && stances[next].last < now) ++next;
        if (stances.empty())
            times[at(f)] = now;
        else if (next == stances.size())
            times[at(f)] = stances.back().middle();
        else if (next == 0 || stances[next].first <= now)
            times[at(f)] = stances[next].middle();
        else {
            const Stance &a = stances[next - 1], &b = stances[next];
            const double t = (now - a.last) / (b.first - a.last);
            times[at(f)] = a.middle() + (b.middle() - a.middle()) * t * t * (3 - 2 * t);
        }
    }
    return times;
}

}  // namespace

Motion steer(const Motion& motion, const RoleMap& roles, const StanceFlags& stances, const PathTarget& target,
             SteerReport* report) {
    SteerReport done;
    Motion result = motion;
    if (motion.frame_count() < 2) return result;
    const Means is = means_of(motion);
    done.turn_before = static_cast<float>(is.turn);
    done.lateral_before = static_cast<float>(is.lateral);
    done.forward_before = static_cast<float>(is.forward);
    const auto missing = [](const std::optional<float>& wanted, double have) {
        return wanted ? static_cast<double>(*wanted) - have : 0.0;
    };
    result.root = changed_path(motion, {missing(target.turn, is.turn), missing(target.lateral, is.lateral),
                                        missing(target.forward, is.forward)});
    const Path before(motion.root, motion.cyclic), after(result.root, motion.cyclic);
    std::vector<Transform> models(at(motion.joint_count()));
    for (std::size_t side = 0; side < 2; ++side) {
        const LegJoints leg = leg_joints(roles, side);
        if (!leg.complete()) continue;
        const std::vector<double> times = foot_times(stances[side], motion);
        for (int f = 0; f < motion.frame_count(); ++f) {
            // Where the foot was in the world, moved as the path has moved at the foot's own moment, seen from the
            // body's new place.
            const RootFrame seen_before = between(before.at_frame(times[at(f)]), motion.root[at(f)]);
            RootFrame change = between(result.root[at(f)], after.at_frame(times[at(f)])) * seen_before;
            change.position.y = 0;  // heights stay: root paths may climb
            if (change.yaw == 0 && change.position == Vec3{}) continue;
            local_to_model(*motion.skeleton, motion.frame(f), models);
            const Vec3 foot = models[at(leg.foot)].translation;
            done.missed = std::max(done.missed, move_foot(*motion.skeleton, leg, change, result.frame(f)));
            done.foot_moved = std::max(done.foot_moved, distance(foot, transform_point(to_transform(change), foot)));
            done.foot_turned = std::max(done.foot_turned, std::fabs(change.yaw));
        }
    }
    join_ends(result);
    if (report) *report = done;
    return result;
}

}  // namespace surefoot
