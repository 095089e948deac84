// What is made from definitions, and the checks that both need.

#include <surefoot/pack_file/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace surefoot {

namespace {

bool is_unit(Quat q) noexcept { return std::fabs(dot(q, q) - 1) < 1e-2f; }

/// Keys ([key][block][x8 y8 z8 w8]) that a blend can be normalised from. Idle lanes of the last block are nobody's.
bool are_rotations(std::span<const std::int16_t> keys, const PackedClip& clip) {
    constexpr float k_unit = 32767.0f * 32767.0f;
    const auto width = static_cast<std::size_t>(clip.block_count()) * 4 * k_lanes;
    for (std::size_t at = 0; at < keys.size(); at += width)
        for (std::size_t j = 0; j < static_cast<std::size_t>(clip.joint_count); ++j) {
            const std::int16_t* key = keys.data() + at + j / k_lanes * 4 * k_lanes + j % k_lanes;
            float square = 0;
            for (std::size_t c = 0; c < 4; ++c) {
                const float value = key[c * k_lanes];
                square += value * value;
            }
            if (!(std::fabs(square / k_unit - 1) < 0.1f)) return false;
        }
    return true;
}
bool is_rotation(const FootKey& key) noexcept { return is_unit(key.print.rotation) && is_unit(key.toes); }

/// Each table once: clips may share theirs.
std::string problem_of_keys(const std::vector<PackedClip>& clips) {
    std::set<const void*> seen;
    for (const PackedClip& clip : clips) {
        bool fine = are_rotations(clip.small.middle, clip);
        if (seen.insert(clip.rotations.data()).second) fine = fine && are_rotations(clip.rotations, clip);
        for (const FootPrints& foot : clip.feet) {
            fine = fine && is_rotation(foot.small.middle);
            if (seen.insert(foot.keys.data()).second)
                fine = fine && std::all_of(foot.keys.begin(), foot.keys.end(), is_rotation);
        }
        if (!fine) return "clip '" + clip.name + "' has a key that is no rotation";
    }
    return {};
}

/// Poses have to be there in full before anything looks at them.
std::string problem_of_poses(const Pack& pack) {
    const std::size_t joints = pack.skeleton().rest.size();
    const auto sound = [&](const std::vector<Transform>& pose) {
        bool fine = pose.size() == joints;
        for (const Transform& t : pose) fine = fine && is_unit(t.rotation) && is_finite(t.translation);
        return fine;
    };
    if (!sound(pack.standing)) return "the standing pose does not match the joints";
    for (const auto& reference : pack.program.references)
        if (!sound(reference)) return "a reference pose does not match the joints";
    for (const std::int16_t joint : pack.roles.joints)
        if (joint < k_no_joint || joint >= static_cast<int>(joints)) return "a role names a joint that is not there";
    if (!(pack.hip_height >= 0 && std::isfinite(pack.hip_height))) return "the hips have no height";
    return {};
}

std::string problem_of_body(const Pack& pack) {
    const Program& program = pack.program;
    if (!program.body.skeleton) return "there is no skeleton";
    std::string text = pack.has_program() ? definition_problem(program) : problem(program.body);
    if (!text.empty()) return text;
    if (pack.legs.known())
        if (text = problem(pack.legs, pack.skeleton()); !text.empty()) return text;
    if (!program.mirror.empty())
        if (text = problem(program.mirror, pack.skeleton()); !text.empty()) return text;
    if (text = problem_of_keys(program.body.clips); !text.empty()) return text;
    return problem_of_poses(pack);
}

SpaceDefinition definition_of(LocomotionSpace& space) { return {std::move(space.space), std::move(space.clips)}; }

void rebuild_body(LocomotionGraph& body) {
    LocomotionGraph made = make_locomotion_graph(std::move(body.skeleton), std::move(body.clips),
                                                 definition_of(body.facing), definition_of(body.lateral));
    for (LocomotionStyle& style : body.styles)
        add_style(made, std::move(style.name), definition_of(style.space), std::move(style.mask));
    made.legs = body.legs;
    body = std::move(made);
}

/// False where a node hangs on one that does not come before it.
bool rebuild_nodes(Program& program) {
    std::vector<Node> read = std::move(program.nodes);
    program.nodes.clear();
    for (Node& node : read) {
        for (const std::int16_t child : node.children)
            if (child < 0 || static_cast<std::size_t>(child) >= program.nodes.size()) return false;
        if (auto* space = std::get_if<SpaceNode>(&node.data))
            space->space = join_clips(definition_of(space->space), program.body.clips);
        add_node(program, std::move(node.path), std::move(node.data), {node.children.begin(), node.children.end()});
    }
    return true;
}

}  // namespace

bool rebuild(Pack& pack, std::string& text) {
    Program& program = pack.program;
    if (!program.body.skeleton) return text = "there is no skeleton", false;
    if (program.nodes.size() > k_max_nodes) return text = "there are more nodes than 1024", false;
    if (program.rigs.size() > k_max_pack_gaits) return text = "there are more live gaits than 64", false;
    rebuild_body(program.body);
    for (auto& rig : program.rigs) rig = std::make_shared<const LiveRig>(make_live_rig(rig->manners, rig->idle));
    if (!rebuild_nodes(program)) return text = "a node hangs on one that does not come before it", false;
    text = problem_of_body(pack);
    if (!text.empty()) return false;
    if (pack.has_program()) lay_out(program);
    return true;
}

std::string problem(const Pack& pack) {
    if (std::string text = problem_of_body(pack); !text.empty()) return text;
    return pack.has_program() ? problem(pack.program) : std::string();
}

}  // namespace surefoot
