#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>
#include <surefoot/rig/joint_name.h>

#include <algorithm>
#include <map>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// One parsed key for both sides: "thigh_twist_01_l" and "thigh_twist_01_r" give the same.
std::string sideless(const JointName& name) { return name.stem + "#" + name.number; }

void pair_by_name(const Skeleton& skeleton, std::vector<int>& pairs, const std::vector<bool>& done) {
    std::map<std::string, std::vector<int>> sides[2];
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        if (done[at(j)]) continue;
        const JointName name = parse_joint_name(skeleton.names[at(j)]);
        if (name.side != NameSide::none) sides[name.side == NameSide::left ? 0 : 1][sideless(name)].push_back(j);
    }
    // Equal names on one side ("J_Sec_L_Hair1", …) pair in order; what has no partner stays its own.
    for (const auto& [key, left] : sides[0]) {
        const auto right = sides[1].find(key);
        if (right == sides[1].end()) continue;
        for (std::size_t i = 0; i < std::min(left.size(), right->second.size()); ++i) {
            pairs[at(left[i])] = right->second[i];
            pairs[at(right->second[i])] = left[i];
        }
    }
    // Glued sides: "lthumb" and "rthumb".
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        std::string name = skeleton.names[at(j)];
        if (done[at(j)] || pairs[at(j)] != j || name.empty() || (name[0] != 'l' && name[0] != 'L')) continue;
        name[0] = name[0] == 'l' ? 'r' : 'R';
        const int other = skeleton.find(name);
        if (other == k_no_joint || done[at(other)] || pairs[at(other)] != other) continue;
        pairs[at(j)] = other;
        pairs[at(other)] = j;
    }
}

struct CorrectionSearch {
    const Skeleton& skeleton;
    std::vector<int> pairs;
    // The mirrored joint's model rotation is reflected(partner's) * correction: what a joint's axes on one side differ
    // from the reflection of the other side's. For T-poses with any axes it is inverse(reflected(rest of partner)) *
    // rest.
    std::vector<Quat> correction;

    Vec3 offset(int j) const { return skeleton.rest[at(j)].translation; }

    // Whether the rest pose is its own mirror image (T-pose, A-pose), within 8 % of its size.
    bool rest_is_symmetric(const std::vector<Transform>& models, Quat facing) const {
        Vec3 low = models[0].translation, high = low, middle;
        for (const Transform& model : models) {
            const Vec3 p = model.translation;
            low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
            high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
        }
        const auto place = [&](std::size_t j) { return rotate(facing, models[j].translation); };
        // The plane of symmetry runs through the middle of the pairs.
        float count = 0;
        for (std::size_t j = 0; j < models.size(); ++j)
            if (pairs[j] != static_cast<int>(j)) middle += place(j), count += 1;
        if (count > 0) middle = middle / count;
        const float allowed = 0.08f * length(high - low);
        for (std::size_t j = 0; j < models.size(); ++j) {
            const Vec3 other = reflected(place(at(pairs[j])) - middle);
            if (pairs[j] != static_cast<int>(j) && distance(place(j) - middle, other) > allowed) return false;
        }
        return true;
    }

    // How far `c` fails to lay joint j's children over the reflected children of its partner: mean of 1 - cosine.
    float misfit(int j, Quat c) const {
        float sum = 0, weight = 1e-9f;
        for (int child = j + 1; child < skeleton.joint_count(); ++child) {
            const int partner = pairs[at(child)];
            if (skeleton.parents[at(child)] != j || skeleton.parents[at(partner)] != pairs[at(j)]) continue;
            const Vec3 mine = rotate(c, offset(child)), other = reflected(offset(partner));
            const float size = length(mine);
            sum += size - dot(mine, normalized(other));
            weight += size;
        }
        return sum / weight;
    }

    void find_corrections(const RoleMap& roles) {
        std::vector<Transform> models(skeleton.rest.size());
        local_to_model(skeleton, skeleton.rest, models);
        const Quat facing = from_yaw(-torso_yaw(roles, models));  // the plane of symmetry of the rest pose
        correction.assign(models.size(), Quat{});
        const bool symmetric = rest_is_symmetric(models, facing);
        for (int j = 0; j < skeleton.joint_count(); ++j) {
            const int partner = pairs[at(j)];
            if (partner < j) continue;
            const Quat mine = normalized(facing * models[at(j)].rotation);
            const Quat other = normalized(facing * models[at(partner)].rotation);
            const Quat from_rest = normalized(conjugate(reflected(other)) * mine);
            const Quat best = symmetric ? from_rest : axis_convention(j, from_rest);
            correction[at(j)] = best;
            // Mirroring twice gives the pose back: the partner's correction is the reflected inverse.
            if (partner != j) correction[at(partner)] = reflected(conjugate(best));
        }
    }

    // Where the rest pose is no help (a frame from the middle of a step): the convention of axes that lays the bones
    // best, and of equals the one nearest to what the rest pose says. Blender's and Godot's tools give both sides the
    // same axes reflected; Unreal's turn them by half a turn.
    Quat axis_convention(int j, Quat from_rest) const {
        constexpr float k_rest_weight = 0.05f;  // a radian against the rest pose weighs as 18 degrees of a bone
        Quat best;
        float least = 1e9f;
        for (const Quat c : {Quat{0, 0, 0, 1}, Quat{1, 0, 0, 0}, Quat{0, 1, 0, 0}, Quat{0, 0, 1, 0}}) {
            // Joints on the middle line may only turn within their plane, or mirroring twice would not be identity.
            if (pairs[at(j)] == j && c.x != 0) continue;
            const float cost = misfit(j, c) + k_rest_weight * rotation_angle(conjugate(c) * from_rest);
            if (cost < least) least = cost, best = c;
        }
        return best;
    }
};

}  // namespace

std::vector<int> mirror_pairs(const Skeleton& skeleton, const RoleMap& roles) {
    std::vector<int> pairs(skeleton.names.size());
    std::vector<bool> done(pairs.size(), false);
    for (int j = 0; j < skeleton.joint_count(); ++j) pairs[at(j)] = j;
    for (int r = 0; r < k_role_count; ++r) {
        const Role role = static_cast<Role>(r);
        if (!roles.has(role) || !roles.has(mirrored(role))) continue;
        pairs[at(roles[role])] = roles[mirrored(role)];
        done[at(roles[role])] = true;
    }
    pair_by_name(skeleton, pairs, done);
    return pairs;
}

MirrorMap mirror_map(const Skeleton& skeleton, const RoleMap& roles) {
    CorrectionSearch search{skeleton, mirror_pairs(skeleton, roles), {}};
    search.find_corrections(roles);
    const int hips = roles[Role::hips];
    MirrorMap map;
    map.correction = std::move(search.correction);
    for (int j = 0; j < skeleton.joint_count(); ++j) {
        map.partner.push_back(static_cast<std::int16_t>(search.pairs[at(j)]));
        const bool carries = hips == k_no_joint ? skeleton.parents[at(j)] == k_no_joint : is_within(skeleton, hips, j);
        map.carries.push_back(carries ? 1 : 0);
    }
    return map;
}

Motion mirror(const Motion& motion, const RoleMap& roles) {
    const Skeleton& skeleton = *motion.skeleton;
    const MirrorMap map = mirror_map(skeleton, roles);
    Motion result = motion;
    for (RootFrame& frame : result.root) frame = reflected(frame);
    std::vector<Transform> scratch(2 * at(motion.joint_count()));
    for (int f = 0; f < motion.frame_count(); ++f)
        mirror_pose(skeleton, map, motion.frame(f), result.frame(f), scratch);
    return result;
}

}  // namespace surefoot
