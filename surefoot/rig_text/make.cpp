// From guide points to a skeleton.

#include <surefoot/base/error.h>
#include <surefoot/rig/role_search.h>
#include <surefoot/rig_text/rig_template.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Point {
    double x = 0, y = 0, z = 0;
};
Point mix(Point a, Point b, double share) {
    return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share};
}
Vec3 metres(Point p, double scale) {
    return {static_cast<float>(p.x * scale), static_cast<float>(p.y * scale), static_cast<float>(p.z * scale)};
}

// Beyond this a body is a slip of the pen, and floats run out of digits.
constexpr float k_largest_m = 100;
constexpr float k_shortest_m = 1e-4f;

std::string right_name(std::string name) {
    if (name.starts_with("Left")) name.replace(0, 4, "Right");
    return name;
}

class Builder {
  public:
    Builder(const RigTemplate& rig, std::span<const double> values);
    Rig build();

  private:
    Point point(int first) const { return {outputs_[at(first)], outputs_[at(first + 1)], outputs_[at(first + 2)]}; }
    bool left_out(const RigPart& part) const { return part.when >= 0 && outputs_[at(part.when)] == 0; }
    std::size_t limb_end(std::size_t first) const;
    void add(const RigPart& part, bool mirror);
    Point point_along(const RigPart& part, int i, int count) const;
    int add_joint(const RigPart& part, const std::string& name, int parent, Point place, bool mirror);
    int chain_count(const RigPart& part) const;
    void set_limits();
    void check_legs() const;
    [[noreturn]] void fail(const std::string& problem, const std::string& place, const std::string& remedy) const {
        throw Error(problem + " in " + rig_.name, place, remedy);
    }

    const RigTemplate& rig_;
    std::vector<double> outputs_;
    double scale_ = 1;
    Skeleton skeleton_;
    std::vector<Vec3> places_;
    std::map<std::string, int> joints_;  // and the ends of chains
    Rig made_;
};

Builder::Builder(const RigTemplate& rig, std::span<const double> values)
    : rig_(rig), outputs_(rig.program.outputs.size()) {
    const double inputs[k_gait_inputs] = {};
    run_exactly(rig.program, inputs, values, outputs_);
    scale_ = outputs_[0];
    if (!(scale_ > 1e-3 && scale_ < k_largest_m))
        throw Error(fmt::format("its scale is {} metres", scale_), rig.name, "it must lie between 0.001 and 100");
}

/// The parts from `first` on that hang together on the left side.
std::size_t Builder::limb_end(std::size_t first) const {
    const auto in_limb = [&](const RigPart& part, std::size_t end) {
        return std::any_of(rig_.parts.begin() + static_cast<std::ptrdiff_t>(first),
                           rig_.parts.begin() + static_cast<std::ptrdiff_t>(end), [&](const RigPart& other) {
                               return part.parent == other.names[0] || part.parent == other.names[0] + ".end";
                           });
    };
    std::size_t end = first + 1;
    while (end < rig_.parts.size() && rig_.parts[end].left && in_limb(rig_.parts[end], end)) ++end;
    return end;
}

Rig Builder::build() {
    // Limbs one after another (left arm, right arm, left leg, right leg), as rigs usually list them.
    for (std::size_t i = 0; i < rig_.parts.size();) {
        const std::size_t end = rig_.parts[i].left ? limb_end(i) : i + 1;
        for (std::size_t k = i; k < end; ++k) add(rig_.parts[k], false);
        if (rig_.parts[i].left)
            for (std::size_t k = i; k < end; ++k) add(rig_.parts[k], true);
        i = end;
    }
    if (const std::string wrong = problem(skeleton_); !wrong.empty())
        throw Error(wrong, rig_.name, "change the template or its parameters");
    made_.name = rig_.name;
    for (const std::int16_t parent : skeleton_.parents)
        if (parent != k_no_joint) skeleton_.tips[at(parent)] = {};  // bones end where the next begins
    fill_trunk(skeleton_, made_.roles);
    check_legs();
    set_limits();
    made_.skeleton = std::make_shared<const Skeleton>(std::move(skeleton_));
    std::vector<Transform> models(places_.size());
    local_to_model(*made_.skeleton, made_.skeleton->rest, models);
    made_.legs = make_legs(*made_.skeleton, made_.roles, models, 0);
    return std::move(made_);
}

void Builder::add(const RigPart& part, bool mirror) {
    if (left_out(part)) return;
    const auto sided = [&](const std::string& name) { return mirror ? right_name(name) : name; };
    int parent = k_no_joint;
    if (!part.parent.empty()) {
        const auto found = joints_.find(sided(part.parent));
        if (found == joints_.end())
            fail("the parent of " + part.names[0] + " is left out", part.place, "leave out both or neither");
        parent = found->second;
    }
    const int count = part.count < 0 ? 1 : chain_count(part);
    const bool named = at(count) <= part.names.size();
    for (int i = 0; i < count; ++i) {
        const std::string name = named ? part.names[at(i)] : i == 0 ? part.names[0] : part.names[0] + std::to_string(i);
        parent = add_joint(part, sided(name), parent, point_along(part, i, count), mirror);
    }
    if (part.count >= 0) joints_[sided(part.names[0]) + ".end"] = parent;
}

/// Where the i-th of `count` joints stands: at equal steps through the part's points.
Point Builder::point_along(const RigPart& part, int i, int count) const {
    if (part.count < 0) return point(part.points[0]);
    const double along = static_cast<double>(i) * static_cast<double>(part.points.size() - 1) / count;
    const auto before = static_cast<std::size_t>(along);
    return mix(point(part.points[before]), point(part.points[before + 1]), along - static_cast<double>(before));
}

int Builder::chain_count(const RigPart& part) const {
    const double count = outputs_[at(part.count)];
    if (!(count >= 1 && count <= k_max_chain_joints) || count != std::floor(count))
        fail(fmt::format("{} joints cannot be made for the chain {}", count, part.names[0]), part.place,
             fmt::format("give a whole number from 1 to {}", k_max_chain_joints));
    return static_cast<int>(count);
}

int Builder::add_joint(const RigPart& part, const std::string& name, int parent, Point place, bool mirror) {
    if (joints_.contains(name)) fail("two joints are called " + name, part.place, "rename one of them");
    const auto sided = [&](Point p) { return metres(mirror ? Point{-p.x, p.y, p.z} : p, scale_); };
    const Vec3 here = sided(place);
    if (std::max({std::fabs(here.x), std::fabs(here.y), std::fabs(here.z)}) > k_largest_m)
        fail(name + " is more than 100 m away", part.place, "change its guide point");
    const Vec3 origin = parent == k_no_joint ? Vec3{} : places_[at(parent)];
    const Vec3 tip = part.tip < 0 ? Vec3{} : sided(point(part.tip)) - here;
    const int joint = skeleton_.add(name, parent, {{}, here - origin}, tip);
    places_.push_back(here);
    joints_[name] = joint;
    made_.stature = std::max({made_.stature, here.y, here.y + tip.y});
    if (part.role != Role::count) made_.roles.set(mirror ? mirrored(part.role) : part.role, joint);
    return joint;
}

void Builder::check_legs() const {
    for (const Role role : {Role::hips, Role::left_upper_leg, Role::left_lower_leg, Role::left_foot})
        if (!made_.roles.has(role))
            throw Error("no joint has the role " + std::string(role_name(role)), rig_.name,
                        "a rig that walks needs hips, left_upper_leg, left_lower_leg and left_foot");
    for (const Role role : {Role::left_lower_leg, Role::left_foot})
        if (!is_within(skeleton_, made_.roles[role], made_.roles[Role::hips]) ||
            length(skeleton_.rest[at(made_.roles[role])].translation) < k_shortest_m)
            throw Error("the bone above " + skeleton_.names[at(made_.roles[role])] + " has no length", rig_.name,
                        "set the guide points of the leg apart");
}

void Builder::set_limits() {
    for (const RigLimitRange& range : rig_.limits) {
        const double low = outputs_[at(range.low)], high = outputs_[at(range.low + 1)];
        if (!(low <= high && low >= -180 && high <= 180))
            fail(fmt::format("the limit of {} goes from {} to {}", role_name(range.role), low, high), range.place,
                 "it must ascend, within -180 and 180 degrees");
        JointLimit limit = made_.limits[range.role];
        (&limit.low.x)[range.axis] = static_cast<float>(low * k_pi / 180);
        (&limit.high.x)[range.axis] = static_cast<float>(high * k_pi / 180);
        made_.limits.set_both(range.role, limit);
    }
}

}  // namespace

Rig make_rig(const RigTemplate& rig, std::span<const double> values) { return Builder(rig, values).build(); }

Rig make_rig(std::string_view name, std::span<const std::string> assignments) {
    const std::string_view text = bundled_rig(name);
    if (text.empty()) throw Error("there is no template of that name", std::string(name), "see: surefoot rig list");
    const RigTemplate rig = read_rig_template(text, std::string(name) + ".rig");
    return make_rig(rig, rig_values(rig, {}, assignments));
}

}  // namespace surefoot
