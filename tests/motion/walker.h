#pragma once
// A small biped that walks by a few sines, for tests: joints with turned axes, so that nothing can rely on identity.

#include <surefoot/motion/motion.h>
#include <surefoot/rig/roles.h>

namespace surefoot::test {

struct Walker {
    std::shared_ptr<const Skeleton> skeleton;
    RoleMap roles;

    /// `dedicated_root`: a joint on the ground above the hips that carries the travel, turned like Blender's.
    /// `symmetric`: else the right thigh is 2 cm longer.
    explicit Walker(bool dedicated_root = false, bool symmetric = true) {
        Skeleton s;
        std::vector<Transform> models;
        // Every joint gets its own axes; the mirrored joint gets the reflected ones with an extra half turn.
        const auto add = [&](const char* name, int parent, Vec3 position, Quat axes) {
            const Transform model{normalized(axes), position};
            const Transform local = parent < 0 ? model : inverse(models[static_cast<std::size_t>(parent)]) * model;
            models.push_back(model);
            return s.add(name, parent, local);
        };
        const Quat odd = normalized(Quat{0.2f, 0.5f, -0.3f, 0.7f});
        const Quat half_turn{0, 0, 1, 0};
        const auto pair_axes = [&](bool left, Quat q) {
            return left ? q : normalized(Quat{q.x, -q.y, -q.z, q.w} * half_turn);
        };
        int top = k_no_joint;
        if (dedicated_root) top = add("root", top, {}, axis_angle({1, 0, 0}, -0.5f * static_cast<float>(k_pi)));
        const auto set = [&](Role role, int joint) { roles.set(role, joint); };
        const int hips = add("hips", top, {0, 0.95f, 0}, axis_angle({1, 0, 0}, 0.4f));
        set(Role::hips, hips);
        const int spine = add("spine", hips, {0, 1.1f, 0}, axis_angle({1, 0, 0}, -0.3f));
        const int chest = add("chest", spine, {0, 1.3f, 0}, {});
        const int head = add("head", chest, {0, 1.6f, 0.02f}, {});
        set(Role::spine, spine), set(Role::chest, chest), set(Role::head, head);
        for (const bool left : {true, false}) {
            const float x = left ? 1.0f : -1.0f;
            const float extra = left || symmetric ? 0.0f : 0.02f;
            const auto name = [&](const char* part) { return std::string(part) + (left ? ".L" : ".R"); };
            const auto sided = [&](Role role) { return left ? role : mirrored(role); };
            const int thigh = add(name("thigh").c_str(), hips, {0.1f * x, 0.9f, 0}, pair_axes(left, odd));
            const int shin =
                add(name("shin").c_str(), thigh, {0.1f * x, 0.5f - extra, 0.02f}, pair_axes(left, odd * odd));
            const int foot = add(name("foot").c_str(), shin, {0.1f * x, 0.08f - extra, 0}, pair_axes(left, odd));
            const int toes = add(name("toe").c_str(), foot, {0.1f * x, 0.02f - extra, 0.13f}, pair_axes(left, {}));
            const int arm = add(name("upper_arm").c_str(), chest, {0.2f * x, 1.45f, 0}, pair_axes(left, odd));
            const int forearm = add(name("forearm").c_str(), arm, {0.45f * x, 1.45f, 0}, pair_axes(left, odd));
            const int hand = add(name("hand").c_str(), forearm, {0.7f * x, 1.45f, 0}, pair_axes(left, odd));
            const int pocket = add(name("pocket_thing").c_str(), hips, {0.15f * x, 0.92f, 0.1f}, pair_axes(left, odd));
            (void)pocket;
            set(sided(Role::left_upper_leg), thigh), set(sided(Role::left_lower_leg), shin);
            set(sided(Role::left_foot), foot), set(sided(Role::left_toes), toes);
            set(sided(Role::left_upper_arm), arm), set(sided(Role::left_lower_arm), forearm);
            set(sided(Role::left_hand), hand);
        }
        skeleton = std::make_shared<const Skeleton>(s);
    }

    /// Walks at `speed` m/s turning at `turn` deg/s, two steps a second, hips swaying by 2.5 cm, travel in the pose.
    Motion walk(float speed, float turn, float seconds, float fps = 60) const {
        const int frames = static_cast<int>(std::floor(seconds * fps + 0.5f)) + 1;
        Motion m = make_motion(skeleton, "walk", frames, fps);
        std::vector<Transform> models(skeleton->rest.size());
        const float rate = turn * k_radians_per_degree;
        for (int f = 0; f < frames; ++f) {
            const float t = static_cast<float>(f) / fps, phase = 2 * static_cast<float>(k_pi) * t;
            // Straight: along +Z. Turning: a circle of radius speed / rate about (radius, 0, 0).
            const float yaw = rate * t;
            const float radius = rate != 0 ? speed / rate : 0;
            const Vec3 path = rate != 0 ? Vec3{radius * (1 - cos(yaw)), 0, radius * sin(yaw)} : Vec3{0, 0, speed * t};
            const Transform root{from_yaw(yaw), path};
            local_to_model(*skeleton, skeleton->rest, models);
            // Each limb turns about the model's axes at its joint.
            const auto turn_joint = [&](Role role, Vec3 axis, float angle) {
                turn_model(models, roles[role], axis, angle);
            };
            const float swing = 0.5f * sin(phase);
            turn_joint(Role::left_upper_leg, {1, 0, 0}, -swing);
            turn_joint(Role::right_upper_leg, {1, 0, 0}, swing);
            turn_joint(Role::left_lower_leg, {1, 0, 0}, 0.3f + 0.3f * cos(phase));
            turn_joint(Role::right_lower_leg, {1, 0, 0}, 0.3f - 0.3f * cos(phase));
            turn_joint(Role::left_upper_arm, {0.1f, 0.9f, 0.3f}, swing);
            turn_joint(Role::right_upper_arm, {0, 1, 0}, 0.4f + 0.2f * swing);
            turn_joint(Role::spine, {0, 1, 0}, 0.1f * sin(phase));
            turn_joint(Role::head, {0.3f, 1, 0.2f}, 0.2f * cos(phase));
            const Vec3 sway{0.025f * sin(phase), 0.02f * cos(2 * phase), 0.01f * sin(2 * phase)};
            for (std::size_t j = 0; j < models.size(); ++j) {
                if (skeleton->names[j] != "root") models[j].translation += sway;
                models[j] = root * models[j];
            }
            model_to_local(*skeleton, models, m.frame(f));
        }
        return m;
    }

    void turn_model(std::span<Transform> models, int joint, Vec3 axis, float angle) const {
        const Vec3 pivot = models[static_cast<std::size_t>(joint)].translation;
        const Quat q = axis_angle(normalized(axis), angle);
        for (int j = joint; j < skeleton->joint_count(); ++j)
            if (is_within(*skeleton, j, joint)) {
                Transform& t = models[static_cast<std::size_t>(j)];
                t = {normalized(q * t.rotation), pivot + rotate(q, t.translation - pivot)};
            }
    }
};

/// Largest distance between the joints' world positions of two clips of equal length; joints from `first` on.
inline float worst_world_distance(const Motion& a, const Motion& b, int first = 0) {
    std::vector<Transform> x(static_cast<std::size_t>(a.joint_count())), y = x;
    float worst = 0;
    for (int f = 0; f < a.frame_count(); ++f) {
        world_pose(a, f, x);
        world_pose(b, f, y);
        for (std::size_t j = static_cast<std::size_t>(first); j < x.size(); ++j)
            worst = std::fmax(worst, distance(x[j].translation, y[j].translation));
    }
    return worst;
}

}  // namespace surefoot::test
