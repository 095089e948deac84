// Roles by shape, for skeletons whose names say nothing ("joint_12", "Bone.003"). Lengths are compared with the body's
// mean proportions (Drillis and Contini 1966, as shares of stature), which decides between hip struts, thighs, twist
// joints and finger bones on one chain.

#include <surefoot/rig/role_search.h>

#include <algorithm>

namespace surefoot {

namespace {

constexpr float k_thigh = 0.245f, k_shank = 0.246f, k_upper_arm = 0.186f, k_forearm = 0.146f;
constexpr float k_hip_half_width = 0.05f, k_shoulder_half_width = 0.12f;
constexpr float k_low = 0.15f;               // feet end below this share of the height, hips stand well above it
constexpr float k_hips_low = 0.3f;           // hips of long-bodied cartoon figures still stand above this
constexpr float k_toes_away = 0.03f;         // a joint nearer to the ankle than this is part of it
constexpr std::size_t k_most_chains = 12;    // limbs, and what else hangs from one joint: skirts, hair, pouches
constexpr float k_unequal = 0.04f;           // left and right differ in length by less than this
constexpr float k_unlike_arms = 0.6f;        // two chains less like arms than this are none
constexpr std::size_t k_longest_chain = 32;  // tentacles are cut here

constexpr float k_no_likeness = 1e9f;

struct LimbKind {
    float first, second;  // bone lengths
    float half_width;     // of the body where the limb starts
    float end_cost;
};
constexpr LimbKind k_leg = {k_thigh, k_shank, k_hip_half_width, 0.05f};
constexpr LimbKind k_arm = {k_upper_arm, k_forearm, k_shoulder_half_width, 0.0f};

struct Limb {
    int root = k_no_joint;  // where the chain leaves the trunk
    int upper = k_no_joint, lower = k_no_joint, end = k_no_joint;
};
struct LimbPair {
    int branch = k_no_joint;
    Limb first, second;
    float misfit = k_no_likeness;
};

struct Shape {
    const Skeleton& skeleton;
    std::span<const Transform> models;
    std::vector<std::vector<int>> children;
    float floor = 0, height = 0;  // of this pose
    float stature = 0;            // of the body: the height, until the legs tell
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
        stature = height;
    }
    // Arms raised, a bow or a crouch do not change the legs' bones.
    void stature_from_legs(const RoleMap& roles) {
        float bones = 0;
        for (const Role upper : {Role::left_upper_leg, Role::right_upper_leg}) {
            const bool left = upper == Role::left_upper_leg;
            const Vec3 knee = at(roles[left ? Role::left_lower_leg : Role::right_lower_leg]);
            bones += distance(at(roles[upper]), knee);
            bones += distance(knee, at(roles[left ? Role::left_foot : Role::right_foot]));
        }
        stature = 0.5f * bones / (k_thigh + k_shank);
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

    // From `top` down to the end of its longest chain of bones: the same on both sides of a body in any pose.
    std::vector<int> longest_chain(int top) const {
        std::vector<float> length(models.size(), 0.0f);
        int end = top;
        for (int j = top + 1; j < skeleton.joint_count(); ++j) {
            const int parent = skeleton.parents[idx(j)];
            if (!is_within(skeleton, j, top)) continue;
            length[idx(j)] = length[idx(parent)] + distance(at(parent), at(j));
            if (length[idx(j)] > length[idx(end)] * 1.0001f + 1e-5f) end = j;
        }
        return path(top, end);
    }
    float length_of(const std::vector<int>& chain) const {
        float sum = 0;
        for (std::size_t i = 1; i < chain.size(); ++i) sum += distance(at(chain[i - 1]), at(chain[i]));
        return sum;
    }

    // How little three joints of a chain are like two bones of these lengths (shares of stature) that start `width`
    // from the middle; 0 is a perfect likeness.
    float misfit(const std::vector<int>& chain, std::size_t a, std::size_t b, std::size_t c, const LimbKind& kind,
                 float width) const {
        const float first = distance(at(chain[a]), at(chain[b])), second = distance(at(chain[b]), at(chain[c]));
        const float scale = (first + second) / (kind.first + kind.second);
        if (!(scale > 1e-4f * height)) return k_no_likeness;
        float path_length = 0;
        for (std::size_t i = a; i < c; ++i) path_length += distance(at(chain[i]), at(chain[i + 1]));
        float result = std::fabs(first / scale - kind.first) + std::fabs(second / scale - kind.second);
        result += 0.25f * std::fabs(scale / stature - 1);       // limbs of one body have one scale
        result += 0.3f * (path_length / (first + second) - 1);  // only straight twist joints are skipped
        result += 0.5f * std::fabs(width / stature - kind.half_width);
        result += 0.02f * static_cast<float>(c - a - 2);       // and rather none than some
        const bool last = c + 1 == chain.size() && c > b + 1;  // the end of the foot is no ankle
        return result + (last ? kind.end_cost : 0.0f);
    }

    float lowest(int top) const {
        return level(best_below(top, [&](int j) { return -level(j); }));
    }
};

// Two chains from one joint as a pair of limbs: the same places on both, or nothing where they differ in build.
LimbPair fit_pair(const Shape& shape, int branch, const std::vector<int>& one, const std::vector<int>& two,
                  const LimbKind& kind) {
    LimbPair best;
    if (one.size() != two.size() || one.size() < 3) return best;
    const float unequal = std::fabs(shape.length_of(one) - shape.length_of(two)) / shape.height;
    if (unequal > k_unequal) return best;
    for (std::size_t a = 0; a < one.size(); ++a) {
        const float width = 0.5f * distance(shape.at(one[a]), shape.at(two[a]));
        for (std::size_t b = a + 1; b < one.size(); ++b)
            for (std::size_t c = b + 1; c < one.size(); ++c) {
                const float misfit = shape.misfit(one, a, b, c, kind, width) + shape.misfit(two, a, b, c, kind, width);
                if (misfit + unequal < best.misfit - 1e-6f)
                    best = {
                        branch, {one[0], one[a], one[b], one[c]}, {two[0], two[a], two[b], two[c]}, misfit + unequal};
            }
    }
    return best;
}

// The best pair of limbs among the children of `branch` that `accept` admits.
template <typename Accept>
LimbPair best_pair(const Shape& shape, int branch, const LimbKind& kind, const Accept& accept) {
    std::vector<std::vector<int>> chains;
    for (const int child : shape.children[Shape::idx(branch)])
        if (chains.size() < k_most_chains && accept(child)) chains.push_back(shape.longest_chain(child));
    LimbPair best;
    for (std::size_t a = 0; a < chains.size(); ++a)
        for (std::size_t b = a + 1; b < chains.size(); ++b)
            if (const LimbPair pair = fit_pair(shape, branch, chains[a], chains[b], kind); pair.misfit < best.misfit)
                best = pair;
    return best;
}

// The two chains from one high joint that go down to the floor and are most like legs.
LimbPair find_legs(const Shape& shape) {
    LimbPair best;
    for (int branch = 0; branch < shape.skeleton.joint_count(); ++branch) {
        if (shape.level(branch) < k_hips_low || shape.children[Shape::idx(branch)].size() < 2) continue;
        const LimbPair pair = best_pair(shape, branch, k_leg, [&](int child) { return shape.lowest(child) < k_low; });
        // One foot at least is on the ground; the other may be in the air.
        if (pair.branch == k_no_joint) continue;
        if (std::fmin(shape.level(pair.first.end), shape.level(pair.second.end)) > k_low) continue;
        if (pair.misfit < best.misfit) best = pair;
    }
    return best;
}

// The next joint of the foot, or k_no_joint.
int toes_of(const Shape& shape, int ankle) {
    const int front = shape.best_below(ankle, [&](int j) { return planar_length(shape.at(j) - shape.at(ankle)); });
    for (const int j : shape.path(ankle, front))
        if (distance(shape.at(j), shape.at(ankle)) > k_toes_away * shape.height) return j;
    return k_no_joint;
}

// Where the figure looks: along its feet, else where its knees bend to, else along +Z.
Vec3 facing(const Shape& shape, const LimbPair& legs) {
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
    const LimbPair legs = find_legs(shape);
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

// The end of the upward chain: high and near the middle, and not in an arm.
int crown(const Shape& shape, const RoleMap& roles, int base) {
    const Vec3 middle = shape.at(base);
    const auto in_arm = [&](int j) {
        for (const Role role : {Role::left_shoulder, Role::right_shoulder, Role::left_upper_arm, Role::right_upper_arm})
            if (roles.has(role) && is_within(shape.skeleton, j, roles[role])) return true;
        return false;
    };
    return shape.best_below(base, [&](int j) {
        return in_arm(j) ? -k_no_likeness : shape.at(j).y - 0.5f * planar_length(shape.at(j) - middle);
    });
}

// Hips that carry the legs only (a pelvis beside the waist) make way for the joint that carries the spine as well.
void raise_hips(const Shape& shape, RoleMap& roles) {
    int hips = roles[Role::hips];
    const auto has_trunk = [&](int j) { return shape.level(crown(shape, roles, j)) > shape.level(j) + 0.15f; };
    while (!has_trunk(hips) && shape.skeleton.parents[Shape::idx(hips)] != k_no_joint)
        hips = shape.skeleton.parents[Shape::idx(hips)];
    if (has_trunk(hips)) roles.set(Role::hips, hips);
}

void add_arms(const Shape& shape, RoleMap& roles) {
    const int hips = roles[Role::hips];
    LimbPair best;
    for (int branch = hips; branch < shape.skeleton.joint_count(); ++branch) {
        if (shape.children[Shape::idx(branch)].size() < 2 || !is_within(shape.skeleton, branch, hips)) continue;
        if (shape.level(branch) < shape.level(hips) - 0.02f) continue;
        const LimbPair pair = best_pair(shape, branch, k_arm, [&](int child) {
            return !is_within(shape.skeleton, roles[Role::left_upper_leg], child) &&
                   !is_within(shape.skeleton, roles[Role::right_upper_leg], child);
        });
        if (pair.branch != k_no_joint && pair.misfit < best.misfit) best = pair;
    }
    if (best.branch == k_no_joint || best.misfit > k_unlike_arms) return;
    const bool first_left = dot(shape.at(best.first.upper) - shape.at(best.second.upper), shape.left()) > 0;
    for (const bool left : {true, false}) {
        const Limb& arm = left == first_left ? best.first : best.second;
        set_limb(roles, left, Role::left_upper_arm, Role::left_lower_arm, Role::left_hand, arm);
        if (arm.root != arm.upper) roles.set(left ? Role::left_shoulder : Role::right_shoulder, arm.root);
    }
}

void add_head(const Shape& shape, RoleMap& roles) {
    int chest = roles[Role::hips];
    if (roles.has(Role::left_upper_arm) && roles.has(Role::right_upper_arm))
        chest = common_ancestor(shape.skeleton, roles[Role::left_upper_arm], roles[Role::right_upper_arm]);
    if (chest == k_no_joint) return;
    std::vector<int> above = shape.path(chest, crown(shape, roles, chest));
    above.erase(above.begin());
    if (above.empty()) return;
    // Face bones and hair are not the head: it is the joint with the face below it, where the chain first branches.
    std::size_t head = 0;
    while (head + 1 < above.size() && shape.children[Shape::idx(above[head])].size() < 2) ++head;
    while (head > 0 && distance(shape.at(above[head]), shape.at(above[head - 1])) < 0.01f * shape.height) --head;
    // Neck, head and an end joint at the top of the skull: the last bone is the head's and much the longest.
    const bool bare_end =
        shape.children[Shape::idx(above[head])].empty() && length(shape.skeleton.tips[Shape::idx(above[head])]) < 1e-4f;
    if (bare_end && head >= 2 &&
        distance(shape.at(above[head]), shape.at(above[head - 1])) >
            1.5f * distance(shape.at(above[head - 1]), shape.at(above[head - 2])))
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
    shape.stature_from_legs(found);
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
