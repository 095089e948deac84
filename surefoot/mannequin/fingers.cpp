#include <surefoot/mannequin/sculpt.h>

#include <algorithm>

namespace surefoot {

namespace {

/// A finger's joints that have roles, from the hand outward.
std::vector<int> finger(const Measures& body, Side side, Role first) {
    std::vector<int> joints;
    for (int i = 0; i < 3; ++i) {
        const auto role = static_cast<Role>(static_cast<int>(first) + i);
        const int joint = body.roles[side == Side::left ? role : mirrored(role)];
        if (joint != k_no_joint) joints.push_back(joint);
    }
    return joints;
}

/// A closed tube through points, slimmer towards its end; `girth` is its radius at the base [m].
void add_tube(Mesh& mesh, const std::vector<Vec3>& points, const SkinChain& chain, Axes axes, float girth) {
    float whole = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) whole += distance(points[i], points[i + 1]);
    std::vector<Ring> rings;
    float place = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const bool first = i == 0, last = i + 2 == points.size();
        const float length = distance(points[i], points[i + 1]);
        axes = axes.turned_to(normalized(points[i + 1] - points[i], axes.along));
        // Rings on either side of a joint, and a round tip.
        for (const float share : {first ? 0.0f : 0.08f, 0.5f, last ? 0.8f : 0.9f, 1.0f}) {
            if (share == 1 && !last) continue;
            const float along = place + share * length;
            const float radius = girth * (1 - 0.28f * along / std::max(whole, 1e-6f)) * (share == 1 ? 0.55f : 1.0f);
            rings.push_back({lerp(points[i], points[i + 1], share), axes.across * (0.9f * radius),
                             axes.forward * radius, chain.at(along)});
        }
        place += length;
    }
    add_loft(mesh, rings, k_limb_corners);
}

}  // namespace

void add_fingers(Mesh& mesh, const Measures& body, Side side) {
    const ArmBones arm = arm_bones(body, side);
    if (!arm.there() || arm.hand == k_no_joint) return;
    const float s = std::clamp(dot(arm.tip - arm.wrist, arm.lower_axes.along) / body.size(0.108f), 0.5f, 2.0f);
    const auto size = [&](float share) { return s * body.size(share); };
    bool thumb = false;
    for (const Role first : {Role::left_thumb_metacarpal, Role::left_index_proximal, Role::left_middle_proximal,
                             Role::left_ring_proximal, Role::left_little_proximal}) {
        const std::vector<int> joints = finger(body, side, first);
        if (joints.empty()) continue;
        const bool is_thumb = first == Role::left_thumb_metacarpal;
        thumb = thumb || is_thumb;
        // It begins inside the hand.
        const Vec3 base = body.pose(joints[0]).translation;
        const Vec3 inward =
            joints.size() > 1 ? normalized(base - body.pose(joints[1]).translation) : -arm.lower_axes.along;
        std::vector<Vec3> points{base + inward * size(is_thumb ? 0.004f : 0.012f)};
        SkinChain chain{{{arm.hand, 0, 0}}};
        float place = distance(points[0], base);
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (i > 0) place += distance(body.pose(joints[i - 1]).translation, body.pose(joints[i]).translation);
            points.push_back(body.pose(joints[i]).translation);
            chain.links.push_back({joints[i], place, size(0.006f)});
        }
        const Vec3 along = normalized(points.back() - points[points.size() - 2], arm.lower_axes.along);
        points.push_back(body.tip_of(joints.back(), along, 0.012f * s));
        const float girth = size(is_thumb ? 0.0072f : first == Role::left_little_proximal ? 0.0052f : 0.0060f);
        add_tube(mesh, points, chain, arm.lower_axes, girth);
    }
    if (thumb) return;
    const Axes& axes = arm.lower_axes;
    const float length = std::max(dot(arm.tip - arm.wrist, axes.along), body.size(0.03f));
    const Vec3 base = arm.wrist + axes.along * (0.14f * length) + axes.forward * size(0.006f);
    const Vec3 along = normalized(axes.along * 0.78f + axes.forward * 0.62f);
    add_tube(mesh, {base, base + along * (0.26f * length), base + along * (0.50f * length)}, {{{arm.hand, 0, 0}}}, axes,
             size(0.0085f));
}

}  // namespace surefoot
