// Roles by shape, for skeletons whose names say nothing ("joint_12", "Bone.003"). Lengths are compared with the body's
// mean proportions (Drillis and Contini 1966, as shares of stature), which decides between hip struts, thighs, twist
// joints and finger bones on one chain.

#include <surefoot/rig/role_search.h>

#include <algorithm>
#include <limits>

namespace surefoot {

namespace {

constexpr float k_thigh = 0.245f, k_shank = 0.246f, k_upper_arm = 0.186f, k_forearm = 0.146f;
constexpr float k_hip_half_width = 0.05f, k_shoulder_half_width = 0.12f;
constexpr float k_low = 0.15f;               // feet end below this share of the height, hips stand well above it
constexpr float k_hips_low = 0.3f;           // hips of long-bodied cartoon figures still stand above this
constexpr float k_lateral = 0.12f;           // arms reach farther than this from the middle
constexpr float k_toes_ahead = 0.03f;        // a joint nearer to the ankle than this is part of it
constexpr std::size_t k_most_low = 12;       // legs, and what else hangs to the ground from one joint: skirts, tails
constexpr std::size_t k_longest_chain = 32;  // tentacles are cut here

struct Limb {
    int upper = k_no_joint, lower = k_no_joint, end = k_no_joint;
    float misfit = std::numeric_limits<float>::max();
};

struct Shape {
    const Skeleton& skeleton;
    std::span<const Transform> models;
    std::vector<std::vector<int>> children;
    float floor = 0, height = 0;
    Vec3 forward{0, 0, 1};

    Shape(const Skeleton& s, std::span<const Transform> m) : skeleton(s), models(m), children(s.names.size()) {
        float top = at(0).y;
        floor = top;
        for (int j = 0; j < s.joint_count(); ++j) {
            if (s.parents[idx(j)] != k_no_joint) children[idx(s.parents[idx(j)])].push_back(j);
            for (const float y : {at(j).y, transform_point(m[idx(j)], s.tips[idx(j)]).y}) {
                top = std::fmax(top, y);
                floor = std::fmin(floor, y);
            }
        }
        height = top - floor;
    }
    static std::size_t idx(int j) { return static_cast<std::size_t>(j); }
    Vec3 at(int j) const { return models[idx(j)].translation; }
    float level(int j) const { return (at(j).y - floor) / height; }
    Vec3 left() const { return cross(k_up, forward); }

    // The joint at or below `top` for which `score` is highest; the first of equals.
    template <typename Score>
    int best_below(int top, const Score& score) const {
        int best = top;
        for (int j = top; j < skeleton.joint_count(); ++j)
            if (is_within(skeleton, j, top) && score(j) > score(best)) best = j;
        return best;
    }
    // From `top` down to `end`, both included; the upper part only of very long chains.
    std::vector<int> path(int top, int end) const {
        std::vector<int> result;
        for (int j = end; j != k_no_joint; j = skeleton.parents[idx(j)]) {
            result.push_back(j);
            if (j == top) break;
        }
        std::reverse(result.begin(), result.end());
        if (result.size() > k_longest_chain) result.resize(k_longest_chain);
        return result;
    }

    // The three joints of a chain that are most like two bones of these lengths starting at this half width.
    template <typename Accept>
    Limb fit(const std::vector<int>& chain, Vec3 middle, float first, float second, float half_width,
             const Accept& accept_end) const {
        Limb best;
        for (std::size_t a = 0; a < chain.size(); ++a)
            for (std::size_t b = a + 1; b < chain.size(); ++b)
                for (std::size_t c = b + 1; c < chain.size(); ++c) {
                    if (!accept_end(chain[c])) continue;
                    const float width = planar_length(at(chain[a]) - middle) / height;
                    const float misfit = std::fabs(distance(at(chain[a]), at(chain[b])) / height - first) +
                                         std::fabs(distance(at(chain[b]), at(chain[c])) / height - second) +
                                         0.5f * std::fabs(width - half_width);
                    if (misfit < best.misfit - 1e-6f) best = {chain[a], chain[b], chain[c], misfit};
                }
        return best;
    }

    float lowest(int top) const {
        return level(best_below(top, [&](int j) { return -level(j); }));
    }
};

struct LegPair {
    int branch = k_no_joint;
    Limb first, second;
    float misfit = std::numeric_limits<float>::max();
};

Limb leg_below(const Shape& shape, int branch, int child) {
    const int foot = shape.best_below(child, [&](int j) { return -shape.level(j); });
    return shape.fit(shape.path(child, foot), shape.at(branch), k_thigh, k_shank, k_hip_half_width,
                     [&](int j) { return shape.level(j) < k_low; });
}

// The two children of one high joint whose chains go down to the floor and look most like legs.
LegPair find_legs(const Shape& shape) {
    LegPair best;
    for (int branch = 0; branch < shape.skeleton.joint_count(); ++branch) {
        if (shape.level(branch) < k_hips_low) continue;
        std::vector<Limb> low;
        for (const int child : shape.children[Shape::idx(branch)])
            if (shape.lowest(child) < k_low && low.size() < k_most_low) low.push_back(leg_below(shape, branch, child));
        for (std::size_t a = 0; a < low.size(); ++a)
            for (std::size_t b = a + 1; b < low.size(); ++b) {
                LegPair pair{branch, low[a], low[b], 0};
                if (pair.first.upper == k_no_joint || pair.second.upper == k_no_joint) continue;
                // Legs are as long as each other.
                const float unequal = std::fabs(distance(shape.at(pair.first.upper), shape.at(pair.first.end)) -
                                                distance(shape.at(pair.second.upper), shape.at(pair.second.end))) /
                                      shape.height;
                pair.misfit = pair.first.misfit + pair.second.misfit + 2 * unequal;
                if (pair.misfit < best.misfit - 1e-6f) best = pair;
            }
    }
    return best;
}

// The next joint of the foot that lies ahead of the ankle, or k_no_joint.
int toes_of(const Shape& shape, int ankle) {
    const int front = shape.best_below(ankle, [&](int j) { return planar_length(shape.at(j) - shape.at(ankle)); });
    for (const int j : shape.path(ankle, front))
        if (planar_length(shape.at(j) - shape.at(ankle)) > k_toes_ahead * shape.height) return j;
    return k_no_joint;
}

// Where the figure looks: along its feet, else where its knees bend to, else along +Z.
Vec3 facing(const Shape& shape, const LegPair& legs) {
    Vec3 feet, knees;
    for (const Limb& leg : {legs.first, legs.second}) {
        const Vec3 ankle = shape.at(leg.end);
        const int front = shape.best_below(leg.end, [&](int j) { return planar_length(shape.at(j) - ankle); });
        const Vec3 tip = transform_point(shape.models[Shape::idx(front)], shape.skeleton.tips[Shape::idx(front)]);
        feet += tip - ankle;
        knees += shape.at(leg.lower) - 0.5f * (shape.at(leg.upper) + ankle);
    }
    const Vec3 across = shape.at(legs.first.upper) - shape.at(legs.second.upper);
    const Vec3 axis = normalized(cross({across.x, 0, across.z}, k_up));  // forward or backward
    for (const Vec3 hint : {feet, knees})
        if (std::fabs(dot(hint, axis)) > 0.01f * shape.height) return dot(hint, axis) < 0 ? -axis : axis;
    return axis.z < 0 ? -axis : axis;
}

void set_limb(RoleMap& roles, bool left, Role upper, Role lower, Role end, const Limb& limb) {
    roles.set(left ? upper : mirrored(upper), limb.upper);
    roles.set(left ? lower : mirrored(lower), limb.lower);
    roles.set(left ? end : mirrored(end), limb.end);
}

void add_legs(Shape& shape, RoleMap& roles) {
    const LegPair legs = find_legs(shape);
    if (legs.branch == k_no_joint) return;
    shape.forward = facing(shape, legs);
    const bool first_left = dot(shape.at(legs.first.upper) - shape.at(legs.second.upper), shape.left()) > 0;
    for (const bool left : {true, false}) {
        const Limb& leg = left == first_left ? legs.first : legs.second;
        set_limb(roles, left, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot, leg);
        roles.set(left ? Role::left_toes : Role::right_toes, toes_of(shape, leg.end));
    }
    if (!roles.has(Role::hips)) roles.set(Role::hips, legs.branch);
}

// The end of the upward chain: high and near the middle.
int crown(const Shape& shape, int hips) {
    const Vec3 middle = shape.at(hips);
    return shape.best_below(hips, [&](int j) { return shape.at(j).y - planar_length(shape.at(j) - middle); });
}

// Hips that carry the legs only (a pelvis beside the waist) make way for the joint that carries the spine as well.
void raise_hips(const Shape& shape, RoleMap& roles) {
    int hips = roles[Role::hips];
    const auto has_trunk = [&](int j) { return shape.level(crown(shape, j)) > shape.level(j) + 0.15f; };
    while (!has_trunk(hips) && shape.skeleton.parents[Shape::idx(hips)] != k_no_joint)
        hips = shape.skeleton.parents[Shape::idx(hips)];
    if (has_trunk(hips)) roles.set(Role::hips, hips);
}

struct ArmPair {
    int branch = k_no_joint;
    int first_root = k_no_joint, second_root = k_no_joint;
    Limb first, second;
    float misfit = std::numeric_limits<float>::max();
};

void add_arms(const Shape& shape, RoleMap& roles) {
    const int hips = roles[Role::hips];
    const Vec3 middle = shape.at(hips), left = shape.left();
    const auto reach = [&](int j) { return dot(shape.at(j) - middle, left); };
    const std::vector<int> trunk = shape.path(hips, crown(shape, hips));
    ArmPair best;
    for (const int branch : trunk) {
        if (shape.level(branch) < shape.level(hips)) continue;
        Limb arms[2];
        int roots[2] = {k_no_joint, k_no_joint};
        for (const int child : shape.children[Shape::idx(branch)]) {
            if (std::find(trunk.begin(), trunk.end(), child) != trunk.end()) continue;
            for (const int side : {0, 1}) {
                const float sign = side == 0 ? 1.0f : -1.0f;
                const int end = shape.best_below(child, [&](int j) { return sign * reach(j); });
                if (sign * reach(end) < k_lateral * shape.height) continue;
                const Limb arm = shape.fit(shape.path(child, end), middle, k_upper_arm, k_forearm,
                                           k_shoulder_half_width, [](int) { return true; });
                if (arm.misfit < arms[side].misfit) arms[side] = arm, roots[side] = child;
            }
        }
        if (roots[0] == k_no_joint || roots[1] == k_no_joint || roots[0] == roots[1]) continue;
        if (arms[0].upper == k_no_joint || arms[1].upper == k_no_joint) continue;
        const float misfit = arms[0].misfit + arms[1].misfit;
        if (misfit < best.misfit) best = {branch, roots[0], roots[1], arms[0], arms[1], misfit};
    }
    if (best.branch == k_no_joint) return;
    set_limb(roles, true, Role::left_upper_arm, Role::left_lower_arm, Role::left_hand, best.first);
    set_limb(roles, false, Role::left_upper_arm, Role::left_lower_arm, Role::left_hand, best.second);
    if (best.first_root != best.first.upper) roles.set(Role::left_shoulder, best.first_root);
    if (best.second_root != best.second.upper) roles.set(Role::right_shoulder, best.second_root);
}

void add_head(const Shape& shape, RoleMap& roles) {
    const int hips = roles[Role::hips];
    const std::vector<int> trunk = shape.path(hips, crown(shape, hips));
    int chest = hips;
    if (roles.has(Role::left_upper_arm) && roles.has(Role::right_upper_arm))
        chest = common_ancestor(shape.skeleton, roles[Role::left_upper_arm], roles[Role::right_upper_arm]);
    std::vector<int> above;
    for (const int j : trunk)
        if (j != chest && is_within(shape.skeleton, j, chest)) above.push_back(j);
    if (above.empty()) return;
    std::size_t head = above.size() - 1;
    // Neck, head and the top of the skull: the last bone is the head's and the longer one.
    if (head >= 2 && distance(shape.at(above[head]), shape.at(above[head - 1])) >
                         distance(shape.at(above[head - 1]), shape.at(above[head - 2])))
        --head;
    roles.set(Role::head, above[head]);
}

}  // namespace

std::vector<Role> add_roles_by_shape(const Skeleton& skeleton, std::span<const Transform> models, RoleMap& roles) {
    std::vector<Role> filled;
    if (models.size() < skeleton.parents.size() || skeleton.joint_count() == 0) return filled;
    const bool arms = roles.has(Role::left_upper_arm) && roles.has(Role::right_upper_arm);
    if (roles.has_legs() && arms && roles.has(Role::head)) return filled;
    Shape shape(skeleton, models);
    if (!(shape.height > 1e-3f) || !std::isfinite(shape.height)) return filled;
    RoleMap found = roles;
    if (!found.has_legs()) {
        add_legs(shape, found);
        if (!found.has_legs()) return filled;  // without legs nothing else is certain
        if (!roles.has(Role::hips)) raise_hips(shape, found);
    } else {
        const Vec3 across = shape.at(found[Role::left_upper_leg]) - shape.at(found[Role::right_upper_leg]);
        shape.forward = normalized(cross({across.x, 0, across.z}, k_up));
    }
    if (!arms) add_arms(shape, found);
    if (!found.has(Role::head)) add_head(shape, found);
    fill_trunk(skeleton, found);
    for (int r = 0; r < k_role_count; ++r) {
        const Role role = static_cast<Role>(r);
        if (found[role] != roles[role]) filled.push_back(role);
    }
    roles = found;
    return filled;
}

}  // namespace surefoot
