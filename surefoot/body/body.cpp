#include <surefoot/body/body.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace surefoot {

namespace {

constexpr float k_straightest = 0.995f;      // share of a limb's length at which stretching begins to be resisted
constexpr float k_straightest_arm = 0.985f;  // arms have nothing to stand on: they may give earlier
constexpr Vec3 k_ahead{0, 0, 1}, k_down{0, -1, 0};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3 perpendicular(Vec3 v, Vec3 unit) { return v - unit * dot(v, unit); }

/// Distance between the ends of two bones with the hinge between them bent by `flexion` from straight.
float reach(float a, float b, float flexion) { return std::sqrt(a * a + b * b + 2 * a * b * cos(flexion)); }

class Maker {
  public:
    Maker(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs, std::span<const Transform> stance,
          const RoleLimits& limits)
        : skeleton_(skeleton), roles_(roles), legs_(legs), stance_(stance), limits_(limits) {}

    Body make() {
        body_.locals.resize(stance_.size());
        model_to_local(skeleton_, stance_, body_.locals);
        const int hips = roles_[Role::hips];
        if (const int above = skeleton_.parents[at(hips)]; above != k_no_joint) body_.above_hips = stance_[at(above)];
        move(hips);
        trunk();
        for (const Side side : {Side::left, Side::right}) {
            arm(side);
            leg(side);
        }
        body_.hip_width = width(Role::left_upper_leg);
        body_.shoulder_width = width(Role::left_upper_arm);
        scale();
        body_.most_hunch = std::min(1.2f, limits_[Role::spine].high.x);
        body_.most_nod = std::min(1.0f, -limits_[Role::neck].low.x);
        body_.girdle_lift = std::min(0.45f, limits_[Role::left_shoulder].high.z);
        return std::move(body_);
    }

  private:
    Vec3 place(int joint) const { return stance_[at(joint)].translation; }
    int joint(Role left, Side side) const { return roles_[side == Side::left ? left : mirrored(left)]; }

    /// Takes a joint among those that are moved; returns its index, or -1 where there is none or too many.
    int move(int joint) {
        if (joint == k_no_joint || body_.joints.size() >= at(k_most_body_joints)) return -1;
        BodyJoint moved;
        moved.joint = static_cast<std::int16_t>(joint);
        const int parent = skeleton_.parents[at(joint)];
        if (parent != k_no_joint) moved.to_parent = conjugate(stance_[at(parent)].rotation);
        moved.stance = stance_[at(joint)].rotation;
        moved.place = place(joint);
        for (int above = parent; above != k_no_joint && moved.base < 0; above = skeleton_.parents[at(above)])
            moved.base = static_cast<std::int16_t>(index_of(above));
        body_.joints.push_back(moved);
        return body_.joint_count() - 1;
    }
    int index_of(int joint) const {
        for (int i = 0; i < body_.joint_count(); ++i)
            if (body_.joints[at(i)].joint == joint) return i;
        return -1;
    }

    /// The joints below `top` down to `joint`; empty where it is not below.
    std::vector<int> path(int top, int joint) const {
        std::vector<int> joints;
        for (; joint != k_no_joint && joint != top; joint = skeleton_.parents[at(joint)]) joints.push_back(joint);
        if (joint != top) return {};
        std::reverse(joints.begin(), joints.end());
        return joints;
    }

    /// The joint that carries arms and neck: the lowest one above all of them.
    int chest_joint() const {
        int common = k_no_joint;
        for (const Role role : {Role::left_shoulder, Role::right_shoulder, Role::left_upper_arm, Role::right_upper_arm,
                                Role::neck, Role::head}) {
            if (!roles_.has(role)) continue;
            int above = skeleton_.parents[at(roles_[role])];
            if (common == k_no_joint) {
                common = above;
                continue;
            }
            while (above != k_no_joint && !is_within(skeleton_, common, above)) above = skeleton_.parents[at(above)];
            if (above != k_no_joint) common = above;
        }
        if (common != k_no_joint && is_within(skeleton_, common, roles_[Role::hips])) return common;
        for (const Role role : {Role::upper_chest, Role::chest, Role::spine})
            if (roles_.has(role)) return roles_[role];
        return roles_[Role::hips];
    }

    void trunk() {
        // Room for all that is no trunk: 16 joints of limbs, two girdles, the hips.
        constexpr std::size_t k_most_trunk = k_most_body_joints - 19;
        const int chest = chest_joint();
        std::vector<int> spine = path(roles_[Role::hips], chest);
        const int head = roles_.has(Role::head) ? roles_[Role::head] : roles_[Role::neck];
        std::vector<int> neck = head == k_no_joint ? std::vector<int>{} : path(chest, head);
        // Of too many joints the lower ones of the neck and the middle ones of the spine ride along.
        if (neck.size() > 8) neck.erase(neck.begin(), neck.end() - 8);
        while (spine.size() + neck.size() > k_most_trunk)
            spine.erase(spine.begin() + static_cast<std::ptrdiff_t>(spine.size() / 2));
        body_.first_spine = body_.joint_count();
        body_.spine = static_cast<int>(spine.size());
        for (const int joint : spine) move(joint);
        body_.chest = body_.joint_count() - 1;
        body_.first_neck = body_.joint_count();
        body_.neck = static_cast<int>(neck.size());
        for (const int joint : neck) move(joint);
        const Vec3 base = place(spine.empty() ? roles_[Role::hips] : spine.front());
        Vec3 top = base + Vec3{0, 0.5f, 0};
        if (roles_.has(Role::left_upper_arm) && roles_.has(Role::right_upper_arm))
            top = lerp(place(roles_[Role::left_upper_arm]), place(roles_[Role::right_upper_arm]), 0.5f);
        else if (!neck.empty())
            top = place(neck.front());
        body_.spine_line = top - base;
        if (!(body_.spine_line.y > 0.01f)) body_.spine_line = {0, 0.5f, 0};
    }

    BodyBone bone(int from, int to, Vec3 front) const {
        BodyBone bone;
        bone.along = normalized(place(to) - place(from), k_down);
        const Vec3 aside = perpendicular(front, bone.along);
        bone.front = normalized(length(aside) > 1e-3f ? aside : perpendicular({0, 1, 0}, bone.along));
        return bone;
    }

    BodyLimb limb(int upper, int lower, int end, Vec3 front, float share, float most_flexion) {
        BodyLimb limb;
        limb.upper = move(upper);
        limb.lower = move(lower);
        limb.end = move(end);
        limb.upper_bone = bone(upper, lower, front);
        limb.lower_bone = bone(lower, end, front);
        limb.upper_length = std::max(1e-4f, distance(place(upper), place(lower)));
        limb.lower_length = std::max(1e-4f, distance(place(lower), place(end)));
        limb.farthest = limb.upper_length + limb.lower_length;
        limb.soft = share * limb.farthest;
        limb.nearest = std::min(0.9f * limb.soft, reach(limb.upper_length, limb.lower_length, most_flexion));
        return limb;
    }

    void arm(Side side) {
        const int girdle = joint(Role::left_shoulder, side), upper = joint(Role::left_upper_arm, side),
                  lower = joint(Role::left_lower_arm, side), hand = joint(Role::left_hand, side);
        const std::size_t s = static_cast<std::size_t>(side);
        if (girdle != k_no_joint && upper != k_no_joint && is_within(skeleton_, upper, girdle)) {
            body_.girdle[s] = move(girdle);
            body_.girdle_length = std::max(0.01f, distance(place(girdle), place(upper)));
        }
        if (upper == k_no_joint || lower == k_no_joint || hand == k_no_joint || !is_within(skeleton_, lower, upper) ||
            !is_within(skeleton_, hand, lower))
            return;
        const float flexion = std::min(2.6f, -limits_[Role::left_lower_arm].low.x);
        BodyLimb& arm = body_.arm[s] = limb(upper, lower, hand, k_ahead, k_straightest_arm, flexion);
        // A forearm that hangs: along it down, and its bend ahead.
        const Quat down = rotation_between(arm.lower_bone.along, k_down);
        body_.hanging[s] = normalized(rotation_between(rotate(down, arm.lower_bone.front), k_ahead) * down);
    }

    void leg(Side side) {
        const std::size_t s = static_cast<std::size_t>(side);
        const Leg& from = legs_[side];
        const Vec3 ankle = place(from.foot);
        const Transform& foot_at = stance_[at(from.foot)];
        const SolePoints sole = sole_points(from, foot_at, from.toes == k_no_joint ? foot_at : stance_[at(from.toes)]);
        const Vec3 ahead = rotate(foot_at.rotation, from.forward);
        const Vec3 front = normalized({ahead.x, 0, ahead.z}, k_ahead);
        const float flexion = std::min(2.75f, limits_[Role::left_lower_leg].high.x);
        body_.leg[s] = limb(from.upper, from.lower, from.foot, front, k_straightest, flexion);
        BodyFoot& foot = body_.foot[s];
        foot.toes = move(from.toes);
        foot.across = cross({0, 1, 0}, front);
        foot.height = std::max(0.001f, ankle.y - sole.heel.y);
        const auto on_ground = [&](Vec3 point) { return Vec3{point.x - ankle.x, -foot.height, point.z - ankle.z}; };
        foot.heel = on_ground(sole.heel);
        foot.ball = on_ground(sole.ball);
        foot.tip = on_ground(sole.toe_tip);
        if (foot.toes < 0) foot.ball = foot.tip;
        foot.toe_length = std::max(0.01f, distance(foot.ball, foot.tip));
        foot.toes_up = std::clamp(-limits_[Role::left_toes].low.x, 0.0f, 1.2f);
        foot.toes_down = std::clamp(limits_[Role::left_toes].high.x, 0.0f, 1.2f);
    }

    float width(Role left) const {
        if (!roles_.has(left) || !roles_.has(mirrored(left))) return 0.3f;
        return std::max(0.02f, std::fabs(place(roles_[left]).x - place(roles_[mirrored(left)]).x));
    }

    void scale() {
        float hips = 0, arms = 0;
        int count = 0;
        for (const std::size_t s : {0u, 1u}) {
            hips += 0.5f * (body_.leg[s].farthest + body_.foot[s].height);
            if (body_.arm[s].upper < 0) continue;
            arms += body_.arm[s].farthest;
            ++count;
        }
        body_.scale.leg = std::max(0.01f, hips / k_gait_hip_height);
        body_.scale.arm = count > 0 ? arms / static_cast<float>(count) / k_gait_arm_length : body_.scale.leg;
        body_.scale.time = std::sqrt(body_.scale.leg);
    }

    const Skeleton& skeleton_;
    const RoleMap& roles_;
    const Legs& legs_;
    std::span<const Transform> stance_;
    const RoleLimits& limits_;
    Body body_;
};

}  // namespace

Body make_body(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs, std::span<const Transform> stance,
               const RoleLimits& limits) {
    assert(roles.has_legs() && stance.size() == skeleton.rest.size());
    return Maker(skeleton, roles, legs, stance, limits).make();
}

void write_pose(const Body& body, std::span<const float> pose, int lane, std::span<Transform> locals) noexcept {
    std::copy(body.locals.begin(), body.locals.end(), locals.begin());
    const float* from = pose.data() + lane;
    for (const BodyJoint& joint : body.joints) {
        locals[at(joint.joint)].rotation = {from[0], from[8], from[16], from[24]};
        from += 32;
    }
    locals[at(body.joints.front().joint)].translation = {from[0], from[8], from[16]};
}

RootRate root_rate(std::span<const float> channels, int lane) noexcept {
    const auto value = [&](BodyChannel c) { return channels[8 * static_cast<std::size_t>(c) + at(lane)]; };
    return {{value(BodyChannel::root_lateral), value(BodyChannel::root_climb), value(BodyChannel::root_speed)},
            value(BodyChannel::root_turn)};
}

}  // namespace surefoot
