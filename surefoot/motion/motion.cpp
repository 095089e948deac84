#include <surefoot/motion/motion.h>

namespace surefoot {

Motion make_motion(std::shared_ptr<const Skeleton> skeleton, std::string name, int frames, float fps) {
    Motion motion;
    motion.name = std::move(name);
    motion.skeleton = std::move(skeleton);
    motion.fps = fps;
    motion.root.resize(static_cast<std::size_t>(frames));
    motion.locals.reserve(motion.root.size() * motion.skeleton->rest.size());
    for (int f = 0; f < frames; ++f)
        motion.locals.insert(motion.locals.end(), motion.skeleton->rest.begin(), motion.skeleton->rest.end());
    return motion;
}

void world_pose(const Motion& motion, int frame, std::span<Transform> world) {
    local_to_model(*motion.skeleton, motion.frame(frame), world);
    const Transform root = to_transform(motion.root[static_cast<std::size_t>(frame)]);
    for (Transform& joint : world.first(static_cast<std::size_t>(motion.joint_count()))) joint = root * joint;
}

std::string problem(const Motion& motion) {
    if (!motion.skeleton) return "the clip has no skeleton";
    if (std::string text = problem(*motion.skeleton); !text.empty()) return text;
    if (motion.frame_count() < 1) return "the clip has no frames";
    if (!(motion.fps > 0) || !std::isfinite(motion.fps)) return "the frame rate is not a positive number";
    if (motion.locals.size() != motion.root.size() * motion.skeleton->rest.size())
        return "the clip's poses do not match its frame count";
    for (int f = 0; f < motion.frame_count(); ++f) {
        const RootFrame& root = motion.root[static_cast<std::size_t>(f)];
        if (!is_finite(root.position) || !std::isfinite(root.yaw))
            return "the root of frame " + std::to_string(f) + " is not a finite number";
        const auto pose = motion.frame(f);
        for (std::size_t j = 0; j < pose.size(); ++j)
            if (!is_finite(pose[j].rotation) || !is_finite(pose[j].translation))
                return "frame " + std::to_string(f) + ", joint '" + motion.skeleton->names[j] +
                       "' is not a finite number";
    }
    return {};
}

float largest_distance(const Motion& a, const Motion& b) {
    std::vector<Transform> one(static_cast<std::size_t>(a.joint_count())), other = one;
    float largest = 0;
    for (int f = 0; f < a.frame_count(); ++f) {
        world_pose(a, f, one);
        world_pose(b, f, other);
        for (std::size_t j = 0; j < one.size(); ++j)
            largest = std::max(largest, distance(one[j].translation, other[j].translation));
    }
    return largest;
}

}  // namespace surefoot
