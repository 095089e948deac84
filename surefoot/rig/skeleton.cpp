#include <surefoot/rig/skeleton.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace surefoot {

int Skeleton::find(std::string_view name) const noexcept {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? k_no_joint : static_cast<int>(at - names.begin());
}

int Skeleton::add(std::string name, int parent, const Transform& rest_local, Vec3 tip) {
    names.push_back(std::move(name));
    parents.push_back(static_cast<std::int16_t>(parent));
    rest.push_back(rest_local);
    tips.push_back(tip);
    return joint_count() - 1;
}

std::string problem(const Skeleton& s) {
    const std::size_t count = s.parents.size();
    if (count == 0) return "the skeleton has no joints";
    if (count > static_cast<std::size_t>(k_max_joints))
        return "the skeleton has " + std::to_string(count) + " joints; at most " + std::to_string(k_max_joints) +
               " are supported";
    if (s.names.size() != count || s.rest.size() != count || s.tips.size() != count)
        return "the skeleton's arrays differ in length";
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return s.names[a] < s.names[b]; });
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && s.names[order[i]] == s.names[order[i - 1]])
            return "two joints are named '" + s.names[order[i]] + "'";
        if (s.names[i].empty()) return "joint " + std::to_string(i) + " has no name";
        if (s.parents[i] < k_no_joint || s.parents[i] >= static_cast<int>(i))
            return "joint '" + s.names[i] + "' does not come after its parent";
        const Quat q = s.rest[i].rotation;
        if (!is_finite(q) || !is_finite(s.rest[i].translation) || !is_finite(s.tips[i]))
            return "the rest pose of joint '" + s.names[i] + "' is not a finite number";
        if (std::fabs(dot(q, q) - 1.0f) > 1e-3f) return "the rest rotation of joint '" + s.names[i] + "' is not a unit";
    }
    return {};
}

bool same_joints(const Skeleton& a, const Skeleton& b) noexcept { return a.names == b.names && a.parents == b.parents; }

void local_to_model(const Skeleton& skeleton, std::span<const Transform> locals, std::span<Transform> models) noexcept {
    assert(locals.size() >= skeleton.parents.size() && models.size() >= skeleton.parents.size());
    for (std::size_t j = 0; j < skeleton.parents.size(); ++j) {
        const int parent = skeleton.parents[j];
        models[j] = parent < 0 ? locals[j] : models[static_cast<std::size_t>(parent)] * locals[j];
    }
}

void model_to_local(const Skeleton& skeleton, std::span<const Transform> models, std::span<Transform> locals) noexcept {
    for (std::size_t j = skeleton.parents.size(); j-- > 0;) {
        const int parent = skeleton.parents[j];
        locals[j] = parent < 0 ? models[j] : inverse(models[static_cast<std::size_t>(parent)]) * models[j];
    }
}

bool is_within(const Skeleton& skeleton, int joint, int ancestor) noexcept {
    while (joint > ancestor) joint = skeleton.parents[static_cast<std::size_t>(joint)];
    return joint == ancestor;
}

}  // namespace surefoot
