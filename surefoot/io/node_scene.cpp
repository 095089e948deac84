#include <surefoot/base/error.h>
#include <surefoot/io/clip_name.h>
#include <surefoot/io/node_scene.h>
#include <surefoot/io/node_skeleton.h>
#include <surefoot/io/node_track.h>
#include <surefoot/io/unit_scale.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot {

namespace {

// Exporters write scales such as 1.0000001 on every joint: that is 1. Five such joints in a chain of 2 m are 10 um off.
constexpr float k_scale_noise = 2e-6f;
constexpr float k_scale_seen = 1e-3f;  // a person may see that the mesh lacks this scale

bool is_about_one(Vec3 scale, float tolerance) noexcept {
    return std::fabs(scale.x - 1) <= tolerance && std::fabs(scale.y - 1) <= tolerance &&
           std::fabs(scale.z - 1) <= tolerance;
}

/// The tracks of one node in one clip.
struct NodePlayers {
    std::optional<TrackPlayer> translation, rotation, scale;
};

/// Plays one clip on the nodes that matter: the skeleton's joints and what stands above them.
class ClipReader {
  public:
    ClipReader(const NodeScene& scene, const NodeSkeleton& picked, const NodeClip& clip, bool rigid)
        : scene_(scene), picked_(picked), clip_(clip), rigid_(rigid), players_(scene.nodes.size()) {
        for (const NodeTrack& track : clip.tracks) {
            NodePlayers& own = players_[static_cast<std::size_t>(track.node)];
            auto& slot = track.path == NodeTrack::Path::translation ? own.translation
                         : track.path == NodeTrack::Path::rotation  ? own.rotation
                                                                    : own.scale;
            if (!slot) slot.emplace(track);
        }
    }

    Motion read(std::size_t& transforms_left, const std::string& where);

  private:
    TimeGrid grid(std::size_t most_frames) const;
    Transform local_at(int node, double time);
    Vec3 scale_at(int node, double time);
    void read_rigid(double time, std::span<Transform> locals);
    void read_scaled(double time, std::span<Transform> locals);

    const NodeScene& scene_;
    const NodeSkeleton& picked_;
    const NodeClip& clip_;
    bool rigid_;
    std::vector<NodePlayers> players_;
};

TimeGrid ClipReader::grid(std::size_t most_frames) const {
    TimeGrid own;
    if (clip_.fps > 0 && clip_.frames > 0) {
        own.fps = clip_.fps;
        own.step = 1 / clip_.fps;
        own.frames = static_cast<std::size_t>(clip_.frames) <= most_frames ? clip_.frames : 0;
        return own;
    }
    std::vector<float> times;
    std::set<const void*> seen;
    for (const NodeTrack& track : clip_.tracks) {
        if (!picked_.matters[static_cast<std::size_t>(track.node)]) continue;
        if (!seen.insert(track.times.get()).second) continue;
        times.insert(times.end(), track.times->begin(), track.times->end());
        if (times.size() > k_max_transforms_per_file) break;
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return fit_time_grid(times, most_frames);
}

Transform ClipReader::local_at(int node, double time) {
    const SceneNode& rest = scene_.nodes[static_cast<std::size_t>(node)];
    NodePlayers& own = players_[static_cast<std::size_t>(node)];
    return {own.rotation ? own.rotation->rotation_at(time) : rest.rotation,
            own.translation ? own.translation->vector_at(time) : rest.translation};
}

Vec3 ClipReader::scale_at(int node, double time) {
    NodePlayers& own = players_[static_cast<std::size_t>(node)];
    return own.scale ? own.scale->vector_at(time) : scene_.nodes[static_cast<std::size_t>(node)].scale;
}

/// No scale anywhere: joints are the nodes' own transforms, bit for bit.
void ClipReader::read_rigid(double time, std::span<Transform> locals) {
    for (std::size_t j = 0; j < picked_.nodes.size(); ++j) {
        locals[j] = local_at(picked_.nodes[j], time);
        for (const int above : picked_.above[j]) locals[j] = local_at(above, time) * locals[j];
    }
}

void ClipReader::read_scaled(double time, std::span<Transform> locals) {
    picked_.rigid_locals(
        [&](int node) {
            const SceneNode& rest = scene_.nodes[static_cast<std::size_t>(node)];
            const NodePlayers& own = players_[static_cast<std::size_t>(node)];
            if (rest.matrix && !own.translation && !own.rotation && !own.scale) return *rest.matrix;
            return to_affine(local_at(node, time), scale_at(node, time));
        },
        locals);
}

Motion ClipReader::read(std::size_t& transforms_left, const std::string& where) {
    const std::size_t joints = picked_.nodes.size();
    const TimeGrid times = grid(transforms_left / joints);
    if (times.frames == 0)
        throw Error("its clips are too long: more than " + std::to_string(k_max_transforms_per_file) +
                        " joint transforms (frames times joints)",
                    where + "#" + clip_.name, "cut them into several files");
    Motion motion = make_motion(picked_.skeleton, clip_.name, times.frames, static_cast<float>(times.fps));
    transforms_left -= motion.locals.size();
    motion.cyclic = clip_.cyclic;
    for (int f = 0; f < times.frames; ++f) {
        const double time = times.start + f * times.step;
        rigid_ ? read_rigid(time, motion.frame(f)) : read_scaled(time, motion.frame(f));
        if (picked_.root_motion == k_no_joint) continue;
        RootFrame& root = motion.root[static_cast<std::size_t>(f)];
        const Transform t = local_at(picked_.root_motion, time);
        root.position = t.translation;
        if (clip_.root_yaw && static_cast<int>(clip_.root_yaw->size()) == times.frames) {
            root.yaw = (*clip_.root_yaw)[static_cast<std::size_t>(f)];
        } else {
            const float yaw = 2 * atan2(t.rotation.y, t.rotation.w);
            const float before = f > 0 ? motion.root[static_cast<std::size_t>(f - 1)].yaw : 0;
            root.yaw = before + wrap_angle(yaw - before);
        }
    }
    return motion;
}

/// True where no node that matters is ever scaled, and none is given as a matrix.
bool is_rigid(const NodeScene& scene, const NodeSkeleton& picked) {
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        if (picked.matters[n] && (scene.nodes[n].matrix || !is_about_one(scene.nodes[n].scale, k_scale_noise)))
            return false;
    for (const NodeClip& clip : scene.clips)
        for (const NodeTrack& track : clip.tracks) {
            if (track.path != NodeTrack::Path::scale || !picked.matters[static_cast<std::size_t>(track.node)]) continue;
            if (track.curve == NodeTrack::Curve::cubic) return false;
            for (const float s : *track.values)
                if (!(std::fabs(s - 1) <= k_scale_noise)) return false;
        }
    return true;
}

/// What of a mesh's look is lost with the scale: says so once.
void warn_of_lost_scale(const NodeScene& scene, const NodeSkeleton& picked, std::vector<std::string>& warnings) {
    std::vector<char> lost(scene.nodes.size());
    const auto look = [&](std::size_t node, Vec3 scale, Vec3 first) {
        const bool uneven = std::fabs(scale.x - scale.y) > k_scale_seen || std::fabs(scale.x - scale.z) > k_scale_seen;
        if (uneven || length(scale - first) > k_scale_seen) lost[node] = 1;
    };
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) look(n, scene.nodes[n].scale, scene.nodes[n].scale);
    for (const NodeClip& clip : scene.clips)
        for (const NodeTrack& track : clip.tracks) {
            if (track.path != NodeTrack::Path::scale || track.values->size() < 3) continue;
            const std::vector<float>& v = *track.values;
            const bool cubic = track.curve == NodeTrack::Curve::cubic;
            for (std::size_t i = cubic ? 3 : 0; i + 2 < v.size(); i += cubic ? 9 : 3)
                look(static_cast<std::size_t>(track.node), {v[i], v[i + 1], v[i + 2]},
                     {v[cubic ? 3 : 0], v[cubic ? 4 : 1], v[cubic ? 5 : 2]});
        }
    std::size_t count = 0, first = 0;
    for (std::size_t n = 0; n < lost.size(); ++n)
        if (lost[n] && picked.matters[n] && count++ == 0) first = n;
    if (count == 0) return;
    warnings.push_back("node '" + scene.nodes[first].name + "'" +
                       (count > 1 ? " and " + std::to_string(count - 1) + " more are" : " is") +
                       " scaled unevenly or over time: joint positions are kept, the mesh's squash and stretch is not");
}

}  // namespace

std::vector<LoadedClip> clips_from_nodes(const NodeScene& scene, const std::string& where, const LoadOptions& options) {
    if (scene.clips.empty()) {
        if (!options.still || scene.skins.empty())
            throw Error("the file has no animation", where, "export it with its animation, or name another file");
        NodeScene still = scene;
        NodeClip& pose = still.clips.emplace_back();
        pose.fps = 30;
        pose.frames = 1;
        return clips_from_nodes(still, where, options);
    }
    std::vector<std::string> warnings = scene.warnings;
    const NodeSkeleton picked = pick_skeleton(scene, where, warnings);
    const bool rigid = is_rigid(scene, picked);
    if (!rigid) warn_of_lost_scale(scene, picked, warnings);

    std::vector<LoadedClip> clips;
    std::vector<Motion*> motions;
    std::size_t transforms_left = k_max_transforms_per_file;
    for (const NodeClip& source : scene.clips) {
        LoadedClip& clip = clips.emplace_back();
        clip.motion = ClipReader(scene, picked, source, rigid).read(transforms_left, where);
        clip.file = where;
        clip.warnings = warnings;
        clip.extras = source.extras;
        if (clip.motion.frame_count() == 1 && !source.tracks.empty())
            clip.warnings.push_back("only one frame: a pose, not a motion");
        if (std::string text = problem(clip.motion); !text.empty())
            throw Error(text, where + "#" + source.name, "export the clip again");
    }
    for (LoadedClip& clip : clips) motions.push_back(&clip.motion);
    const UnitGuess unit = apply_unit_scale(motions, scene.ours && !(options.unit_scale > 0) ? 1 : options.unit_scale);
    for (LoadedClip& clip : clips) {
        clip.unit_scale = static_cast<float>(unit.scale);
        if (!unit.warning.empty()) clip.warnings.push_back(unit.warning);
    }
    return clips;
}

}  // namespace surefoot
