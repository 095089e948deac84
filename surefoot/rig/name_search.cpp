// Roles by name: one table of stems, priced by how clearly they mean a role, and a search for the cheapest chain that
// the hierarchy allows. There is no table per rig: "hip" is a pelvis without a side and a thigh with one,
// "LeftShoulder" is a clavicle beside "LeftArm" and an upper arm beside "LeftCollar", and the chain decides.

#include <surefoot/rig/role_search.h>

#include <algorithm>
#include <array>

namespace surefoot {

namespace {

struct Synonym {
    std::string_view stem;
    Role role;  // the left one of sided roles
    int cost;   // 0: says so plainly; more: only where nothing plainer is there
};

constexpr Synonym k_limbs[] = {
    {"thigh", Role::left_upper_leg, 0},
    {"upleg", Role::left_upper_leg, 0},
    {"upperleg", Role::left_upper_leg, 0},
    {"femur", Role::left_upper_leg, 0},
    {"legupper", Role::left_upper_leg, 0},
    {"legup", Role::left_upper_leg, 0},
    {"hip", Role::left_upper_leg, 2},
    {"hips", Role::left_upper_leg, 3},
    {"leg", Role::left_upper_leg, 4},
    {"calf", Role::left_lower_leg, 0},
    {"shin", Role::left_lower_leg, 0},
    {"lowerleg", Role::left_lower_leg, 0},
    {"tibia", Role::left_lower_leg, 0},
    {"leglower", Role::left_lower_leg, 0},
    {"lowleg", Role::left_lower_leg, 0},
    {"legdown", Role::left_lower_leg, 0},
    {"knee", Role::left_lower_leg, 1},
    {"leg", Role::left_lower_leg, 2},
    {"foot", Role::left_foot, 0},
    {"ankle", Role::left_foot, 0},
    {"feet", Role::left_foot, 1},
    {"toes", Role::left_toes, 0},
    {"toe", Role::left_toes, 0},
    {"toebase", Role::left_toes, 0},
    {"ball", Role::left_toes, 0},
    {"foottoe", Role::left_toes, 0},
    {"foot", Role::left_toes, 4},
    {"clavicle", Role::left_shoulder, 0},
    {"collar", Role::left_shoulder, 0},
    {"collarbone", Role::left_shoulder, 0},
    {"shldr", Role::left_shoulder, 1},
    {"loleg", Role::left_lower_leg, 0},
    {"loarm", Role::left_lower_arm, 0},
    {"shoulder", Role::left_shoulder, 1},
    {"upperarm", Role::left_upper_arm, 0},
    {"uparm", Role::left_upper_arm, 0},
    {"humerus", Role::left_upper_arm, 0},
    {"armupper", Role::left_upper_arm, 0},
    {"arm", Role::left_upper_arm, 2},
    {"shoulder", Role::left_upper_arm, 3},
    {"forearm", Role::left_lower_arm, 0},
    {"lowerarm", Role::left_lower_arm, 0},
    {"radius", Role::left_lower_arm, 0},
    {"armlower", Role::left_lower_arm, 0},
    {"lowarm", Role::left_lower_arm, 0},
    {"elbow", Role::left_lower_arm, 1},
    {"hand", Role::left_hand, 0},
    {"wrist", Role::left_hand, 0},
    {"eye", Role::left_eye, 0},
    {"eyeball", Role::left_eye, 1},
};

constexpr Synonym k_trunk[] = {
    {"hips", Role::hips, 0},      {"hip", Role::hips, 0},  {"pelvis", Role::hips, 0}, {"hipcenter", Role::hips, 0},
    {"spinebase", Role::hips, 0}, {"root", Role::hips, 3}, {"torso", Role::hips, 4},  {"head", Role::head, 0},
    {"skull", Role::head, 1},     {"jaw", Role::jaw, 0},   {"jawroot", Role::jaw, 0}, {"lowerjaw", Role::jaw, 1},
};

constexpr int k_missing = 20;          // a limb without this joint is hardly one
constexpr int k_missing_toes = 6;      // dearer than calling the joint below an ankle, named "foot", the toes
constexpr int k_missing_shoulder = 2;  // cheaper than calling an only "shoulder" a clavicle

// One candidate of the chain search; at most k_candidates a role keep hostile skeletons from costing time.
struct Candidate {
    int joint;
    int cost;
};
constexpr std::size_t k_candidates = 12;

struct Chain {
    std::array<int, 4> joints = {k_no_joint, k_no_joint, k_no_joint, k_no_joint};
    int cost = 0;
};

struct ChainSearch {
    const Skeleton& skeleton;
    std::array<std::vector<Candidate>, 4> candidates;
    std::array<int, 4> missing{};

    // The cheapest choice for roles from `role` on, each strictly below the joint chosen before; the earliest joint
    // wins ties, so that twist segments after a bone's first joint are passed over.
    Chain best(std::size_t role, int above) const {
        Chain result;
        if (role == candidates.size()) return result;
        bool first = true;
        const auto offer = [&](int joint, int cost) {
            Chain rest = best(role + 1, joint == k_no_joint ? above : joint);
            rest.cost += cost;
            if (joint != k_no_joint) rest.joints[role] = joint;
            if (first || rest.cost < result.cost) result = rest;
            first = false;
        };
        for (const Candidate& c : candidates[role])
            if (above == k_no_joint || (c.joint != above && is_within(skeleton, c.joint, above)))
                offer(c.joint, c.cost);
        offer(k_no_joint, missing[role]);
        return result;
    }
};

struct Names {
    const Skeleton& skeleton;
    std::vector<JointName> parsed;

    explicit Names(const Skeleton& s) : skeleton(s) {
        const auto known = [](const std::string& stem) {
            const auto is = [&](const Synonym& synonym) { return synonym.stem == stem; };
            return std::any_of(std::begin(k_limbs), std::end(k_limbs), is) ||
                   std::any_of(std::begin(k_trunk), std::end(k_trunk), is) || stem == "thumb" || stem == "lowerback" ||
                   stem == "lowerneck";
        };
        parsed.reserve(s.names.size());
        for (const std::string& name : s.names) {
            parsed.push_back(parse_joint_name(name));
            split_glued_side(parsed.back(), known);
        }
    }
    const JointName& operator[](int joint) const { return parsed[static_cast<std::size_t>(joint)]; }
    int count() const { return static_cast<int>(parsed.size()); }

    std::vector<Candidate> candidates(Role left_role, NameSide side, std::span<const Synonym> table) const {
        std::vector<Candidate> found;
        for (int j = 0; j < count(); ++j)
            for (const Synonym& synonym : table)
                if (synonym.role == left_role && (*this)[j].side == side && (*this)[j].stem == synonym.stem)
                    found.push_back({j, synonym.cost});
        std::stable_sort(found.begin(), found.end(),
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
        if (found.size() > k_candidates) found.resize(k_candidates);
        return found;
    }

    // Limbs that are only numbered ("leg_joint_L_1" … "_5"): the longest descending run of joints with that stem.
    std::vector<int> sequence(std::string_view stem, NameSide side) const {
        std::vector<int> run;
        for (int j = 0; j < count(); ++j)
            if ((*this)[j].side == side && (*this)[j].stem == stem &&
                (run.empty() || is_within(skeleton, j, run.back())))
                run.push_back(j);
        return run;
    }
};

void find_limb(const Names& names, NameSide side, std::array<Role, 4> left_roles, std::array<int, 4> missing,
               std::string_view generic_stem, bool optional_first, RoleMap& roles) {
    std::array<int, 4> chosen = {k_no_joint, k_no_joint, k_no_joint, k_no_joint};
    std::vector<int> run = names.sequence(generic_stem, side);
    if (run.size() >= 3) {
        const std::size_t start = optional_first && run.size() == 3 ? 1 : 0;
        for (std::size_t i = 0; i < run.size() && start + i < 4; ++i) chosen[start + i] = run[i];
    } else {
        ChainSearch search{names.skeleton, {}, missing};
        for (std::size_t r = 0; r < 4; ++r) search.candidates[r] = names.candidates(left_roles[r], side, k_limbs);
        chosen = search.best(0, k_no_joint).joints;
    }
    for (std::size_t r = 0; r < 4; ++r)
        if (chosen[r] != k_no_joint) roles.set(role_on(left_roles[r], side), chosen[r]);
}

void find_limbs(const Names& names, RoleMap& roles) {
    for (const NameSide side : {NameSide::left, NameSide::right}) {
        find_limb(names, side, {Role::left_upper_leg, Role::left_lower_leg, Role::left_foot, Role::left_toes},
                  {k_missing, k_missing, k_missing, k_missing_toes}, "leg", false, roles);
        find_limb(names, side, {Role::left_shoulder, Role::left_upper_arm, Role::left_lower_arm, Role::left_hand},
                  {k_missing_shoulder, k_missing, k_missing, k_missing}, "arm", true, roles);
        if (const auto eye = names.candidates(Role::left_eye, side, k_limbs); !eye.empty())
            roles.set(role_on(Role::left_eye, side), eye.front().joint);
    }
}

int first_of(const RoleMap& roles, Role a, Role b) { return roles.has(a) ? roles[a] : roles[b]; }

// Where both arms branch off; k_no_joint without them.
int arms_meet(const Skeleton& skeleton, const RoleMap& roles) {
    const int left = first_of(roles, Role::left_shoulder, Role::left_upper_arm);
    const int right = first_of(roles, Role::right_shoulder, Role::right_upper_arm);
    return left == k_no_joint || right == k_no_joint ? k_no_joint : common_ancestor(skeleton, left, right);
}

void find_hips(const Names& names, RoleMap& roles) {
    if (!roles.has(Role::left_upper_leg) || !roles.has(Role::right_upper_leg)) {
        for (const Candidate& c : names.candidates(Role::hips, NameSide::none, k_trunk))
            if (!roles.has(Role::hips)) roles.set(Role::hips, c.joint);
        return;
    }
    const Skeleton& skeleton = names.skeleton;
    int meet = common_ancestor(skeleton, roles[Role::left_upper_leg], roles[Role::right_upper_leg]);
    const int arms = arms_meet(skeleton, roles);
    const int all = arms == k_no_joint || meet == k_no_joint ? meet : common_ancestor(skeleton, meet, arms);
    // A named joint that carries legs and arms, else one that carries the legs, else the joint where they meet.
    int best = k_no_joint, best_cost = 0;
    for (const Candidate& c : names.candidates(Role::hips, NameSide::none, k_trunk)) {
        if (meet == k_no_joint || !is_within(skeleton, meet, c.joint)) continue;
        const int cost = c.cost + (all != k_no_joint && is_within(skeleton, all, c.joint) ? 0 : 2);
        if (best == k_no_joint || cost < best_cost || (cost == best_cost && c.joint > best))
            best = c.joint, best_cost = cost;
    }
    if (best == k_no_joint || best_cost >= 3) best = all != k_no_joint ? all : meet;
    if (best != k_no_joint) roles.set(Role::hips, best);
}

void find_head(const Names& names, RoleMap& roles) {
    const Skeleton& skeleton = names.skeleton;
    const int hips = roles[Role::hips];
    const auto above_hips = [&](int joint) { return hips == k_no_joint || is_within(skeleton, joint, hips); };
    for (const Candidate& c : names.candidates(Role::head, NameSide::none, k_trunk))
        if (!roles.has(Role::head) && above_hips(c.joint)) roles.set(Role::head, c.joint);
    for (const Candidate& c : names.candidates(Role::jaw, NameSide::none, k_trunk))
        if (!roles.has(Role::jaw) && above_hips(c.joint)) roles.set(Role::jaw, c.joint);
    // Without a "head": the last of a run of necks, or of spine joints above the arms (Rigify's spine.004 to .006).
    const int top = arms_meet(skeleton, roles);
    std::vector<int> run;
    for (int j = 0; j < names.count(); ++j) {
        const std::string& stem = names[j].stem;
        if (names[j].side != NameSide::none || !above_hips(j)) continue;
        const bool neck = stem == "neck" || stem == "lowerneck" || stem == "upperneck" || stem == "necktwist";
        const bool high_spine = stem == "spine" && top != k_no_joint && j != top && is_within(skeleton, j, top);
        if ((neck || high_spine) && (run.empty() || is_within(skeleton, j, run.back()))) run.push_back(j);
    }
    if (roles.has(Role::head) && !run.empty() && !is_within(skeleton, roles[Role::head], run.front())) return;
    if (!roles.has(Role::head) && run.size() >= 2) {
        roles.set(Role::head, run.back());
        run.pop_back();
    }
    if (!run.empty()) roles.set(Role::neck, run.front());
}

// --- fingers

constexpr std::string_view k_fingers[] = {"thumb", "index", "middle", "ring", "little"};
constexpr Role k_finger_roles[] = {Role::left_thumb_metacarpal, Role::left_index_proximal, Role::left_middle_proximal,
                                   Role::left_ring_proximal, Role::left_little_proximal};

struct FingerName {
    int finger = -1;        // of k_fingers
    std::string_view part;  // "proximal", …, or empty: numbered
};

FingerName parse_finger(const JointName& name) {
    FingerName result;
    std::string_view stem = name.stem;
    for (const std::string_view part : {"metacarpal", "proximal", "intermediate", "distal"})
        if (stem.size() > part.size() && stem.ends_with(part)) {
            result.part = part;
            stem.remove_suffix(part.size());
        }
    if (stem == "finger" && !name.number.empty()) {  // Biped: Finger0, Finger01, Finger02, Finger1, Finger11, …
        const int finger = name.number[0] - '0';
        if (finger < 5 && name.number.size() <= 2) result.finger = finger;
        return result;
    }
    if (stem.starts_with("hand")) stem.remove_prefix(4);
    if (stem.starts_with("f") && stem != "finger") stem.remove_prefix(1);
    if (stem.ends_with("finger")) stem.remove_suffix(6);
    if (stem == "mid") stem = "middle";
    if (stem == "pinky" || stem == "small") stem = "little";
    for (int i = 0; i < 5; ++i)
        if (stem == k_fingers[i]) result.finger = i;
    return result;
}

void find_fingers(const Names& names, RoleMap& roles) {
    for (const NameSide side : {NameSide::left, NameSide::right}) {
        const int hand = roles[role_on(Role::left_hand, side)];
        if (hand == k_no_joint) continue;
        for (int finger = 0; finger < 5; ++finger) {
            const auto role_at = [&](int segment) {
                return role_on(static_cast<Role>(static_cast<int>(k_finger_roles[finger]) + segment), side);
            };
            std::array<int, 4> by_part = {k_no_joint, k_no_joint, k_no_joint, k_no_joint};
            std::vector<int> run;
            for (int j = hand + 1; j < names.count(); ++j) {
                if (names[j].side != side || !is_within(names.skeleton, j, hand)) continue;
                const FingerName parsed = parse_finger(names[j]);
                if (parsed.finger != finger) continue;
                if (parsed.part == "metacarpal") by_part[0] = j;
                if (parsed.part == "proximal") by_part[1] = j;
                if (parsed.part == "intermediate") by_part[2] = j;
                if (parsed.part == "distal") by_part[3] = j;
                if (parsed.part.empty() && (run.empty() || is_within(names.skeleton, j, run.back()))) run.push_back(j);
            }
            // A VRM 1.0 thumb is metacarpal, proximal, distal; VRM 0.x and Unity call the same joints proximal,
            // intermediate, distal. Other fingers' metacarpals have no role.
            if (finger == 0 && by_part[2] != k_no_joint)
                by_part = {k_no_joint, by_part[1], by_part[2], by_part[3]};
            else if (finger == 0)
                by_part = {k_no_joint, by_part[0], by_part[1], by_part[3]};
            for (int segment = 0; segment < 3; ++segment) {
                const auto s = static_cast<std::size_t>(segment);
                const int joint = by_part[s + 1] != k_no_joint ? by_part[s + 1] : s < run.size() ? run[s] : k_no_joint;
                if (joint != k_no_joint) roles.set(role_at(segment), joint);
            }
        }
    }
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace

int common_ancestor(const Skeleton& skeleton, int a, int b) noexcept {
    while (a != k_no_joint && b != k_no_joint && a != b) {
        int& deeper = a > b ? a : b;
        deeper = skeleton.parents[static_cast<std::size_t>(deeper)];
    }
    return a == b ? a : k_no_joint;
}

void fill_trunk(const Skeleton& skeleton, RoleMap& roles) {
    const int hips = roles[Role::hips];
    if (hips == k_no_joint) return;
    const auto parent = [&](int j) { return static_cast<int>(skeleton.parents[static_cast<std::size_t>(j)]); };
    int top = arms_meet(skeleton, roles);
    const int up = first_of(roles, Role::neck, Role::head);
    // Old Bipeds hang the clavicles from the neck.
    if (top != k_no_joint && up != k_no_joint && top != up && is_within(skeleton, top, up)) top = parent(up);
    if (top == k_no_joint || top == up) top = up == k_no_joint ? k_no_joint : parent(up);
    if (top == k_no_joint || top == hips || !is_within(skeleton, top, hips)) return;
    std::vector<int> path;
    for (int j = top; j != hips; j = parent(j)) path.insert(path.begin(), j);
    const std::size_t n = path.size();
    const auto fill = [&](Role role, int joint) {
        const bool taken = std::find(roles.joints.begin(), roles.joints.end(), joint) != roles.joints.end();
        if (!roles.has(role) && !taken) roles.set(role, joint);
    };
    fill(Role::spine, path[0]);
    if (n == 2) fill(Role::chest, path[1]);
    if (n >= 3) fill(Role::chest, path[n == 3 ? 1 : n / 2]);  // of five, the third; of four, the third
    if (n >= 3) fill(Role::upper_chest, path[n - 1]);
    if (!roles.has(Role::neck) && roles.has(Role::head)) {
        int neck = parent(roles[Role::head]);
        while (neck != k_no_joint && neck != top && parent(neck) != top) neck = parent(neck);
        if (neck != k_no_joint && neck != top) fill(Role::neck, neck);
    }
}

RoleMap roles_by_name(const Skeleton& skeleton) {
    const Names names(skeleton);
    RoleMap roles;
    find_limbs(names, roles);
    find_hips(names, roles);
    find_head(names, roles);
    fill_trunk(skeleton, roles);
    find_fingers(names, roles);
    return roles;
}

std::string naming_convention(const Skeleton& skeleton, const RoleMap& roles) {
    for (const std::string& name : skeleton.names) {
        if (contains(name, "mixamorig")) return "Mixamo";
        if (name.starts_with("CC_Base_")) return "Character Creator";
        if (name.starts_with("J_Bip_")) return "VRoid";
        if (name.starts_with("DEF-")) return "Blender DEF";
        if (name.starts_with("Bip") || name.starts_with("ValveBiped")) return "Biped";
        if (name == "lfemur" || name == "lhipjoint" || name == "LHipJoint") return "CMU";
    }
    if (!roles.has(Role::left_upper_leg)) return "generic names";
    const std::string& thigh = skeleton.names[static_cast<std::size_t>(roles[Role::left_upper_leg])];
    if (thigh == "leftUpperLeg") return "VRM";
    if (thigh == "LeftUpperLeg") return "Unity / Godot humanoid";
    if (thigh == "LeftUpLeg") return "Mixamo";
    if (thigh == "thigh_l" || thigh == "thigh.l") return "Unreal";
    return "generic names";
}

}  // namespace surefoot
