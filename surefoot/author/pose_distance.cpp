#include <surefoot/analysis/clip_facts.h>
#include <surefoot/author/pose_distance.h>
#include <surefoot/motion/edit.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

/// Time of each left strike; one cycle lies between two of them.
std::vector<float> left_strikes(const ClipFacts& facts) {
    std::vector<float> times;
    for (const PhaseEvent& event : facts.events)
        if (event.foot == Side::left && event.kind == StrideEvent::strike) times.push_back(event.time);
    return times;
}

}  // namespace

PoseTable make_pose_table(const Motion& motion, const ClipFacts& facts, const RoleMap& roles) {
    std::vector<int> joints;
    // Fingers, eyes and jaw would drown the limbs in joints that hardly move.
    for (int r = 0; r < static_cast<int>(Role::left_thumb_metacarpal); ++r)
        if (const auto role = static_cast<Role>(r);
            roles.has(role) && role != Role::jaw && role != Role::left_eye && role != Role::right_eye)
            joints.push_back(roles[role]);

    PoseTable table;
    table.joints = static_cast<int>(joints.size());
    const std::vector<float> strikes = left_strikes(facts);
    table.stepping = !strikes.empty() && facts.cadence > 0;
    const float start = strikes.empty() ? 0.0f : strikes.front();
    float cycle = motion.duration();
    if (strikes.size() > 1) cycle = strikes[1] - strikes[0];

    std::vector<Transform> locals(static_cast<std::size_t>(motion.joint_count())), models(locals.size());
    for (int n = 0; n < k_pose_phases; ++n) {
        RootFrame root;
        float time = start + cycle * static_cast<float>(n) / k_pose_phases;
        if (motion.cyclic && time > motion.duration()) time -= motion.duration();
        sample(motion, time, root, locals);
        local_to_model(*motion.skeleton, locals, models);
        for (const int joint : joints) table.positions.push_back(models[static_cast<std::size_t>(joint)].translation);
    }
    return table;
}

float pose_distance(const PoseTable& a, const PoseTable& b) {
    if (a.joints != b.joints || a.joints == 0) return std::nanf("");
    const auto apart = [&](int m, int n) {
        float sum = 0;
        for (int j = 0; j < a.joints; ++j)
            sum += distance(a.positions[static_cast<std::size_t>(m * a.joints + j)],
                            b.positions[static_cast<std::size_t>(n * b.joints + j)]);
        return sum / static_cast<float>(a.joints);
    };
    float sum = 0;
    if (a.stepping && b.stepping) {
        for (int n = 0; n < k_pose_phases; ++n) sum += apart(n, n);
        return sum / k_pose_phases;
    }
    for (int m = 0; m < k_pose_phases; ++m)
        for (int n = 0; n < k_pose_phases; ++n) sum += apart(m, n);
    return sum / (k_pose_phases * k_pose_phases);
}

}  // namespace surefoot
