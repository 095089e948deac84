#include <surefoot/io/mannequin.h>
#include <surefoot/io/mesh_loft.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

// All sizes below are fractions of stature, which is taken from the legs: thigh and shank are 0.491 of it (Drillis and
// Contini 1966). Girths were drawn by eye.
constexpr float k_leg_share = 0.491f;
constexpr float k_shoulder_half_width = 0.107f;
constexpr float k_hand_length = 0.108f;
constexpr float k_head_height = 0.120f;

/// A cross-section of a limb: share of the bone, half-axes sideways and front to back, and how far back it sits.
struct Girth {
    float along, across, depth, back = 0;
};

class Sculptor {
  public:
    Sculptor(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs, std::span<const Transform> bind);
    Mesh sculpt();

  private:
    bool has(Role role) const { return roles_.has(role); }
    Vec3 at(Role role) const { return bind_[static_cast<std::size_t>(roles_[role])].translation; }
    Quat turned(int joint) const { return bind_[static_cast<std::size_t>(joint)].rotation; }
    float size(float share) const { return share * stature_; }
    Vec3 tip_of(Role role, Vec3 direction, float usual) const;
    int chest_joint() const;
    Vec3 neck_base() const;
    Ring ring(Vec3 center, Vec3 along, const Girth& girth, const SkinWeights& skin) const;
    Vec3 head_base() const;
    void add_torso();
    void add_head();
    void add_leg(Side side);
    void add_shoe(const Leg& leg);
    void add_arm(Side side);
    void add_hand(std::vector<Ring>& rings, Role hand, Vec3 direction, float length, const SkinChain& chain,
                  float wrist);
    void add_thumb(Role hand, Vec3 direction, float length);

    const Skeleton& skeleton_;
    const RoleMap& roles_;
    const Legs& legs_;
    std::span<const Transform> bind_;
    float stature_;
    Vec3 hips_;               // between the hip joints
    Vec3 left_, up_, front_;  // of the body in its bind pose
    float hip_half_width_, shoulder_half_width_;
    Mesh mesh_;
};

Sculptor::Sculptor(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs, std::span<const Transform> bind)
    : skeleton_(skeleton), roles_(roles), legs_(legs), bind_(bind) {
    const Leg &left = legs[Side::left], &right = legs[Side::right];
    stature_ = std::max(0.5f * (left.length() + right.length()) / k_leg_share, 1e-3f);
    const Vec3 hip_left = at(Role::left_upper_leg), hip_right = at(Role::right_upper_leg);
    hips_ = 0.5f * (hip_left + hip_right);
    left_ = normalized(hip_left - hip_right, {1, 0, 0});
    const Vec3 knees = 0.5f * (at(Role::left_lower_leg) + at(Role::right_lower_leg));
    const Vec3 rise = normalized(neck_base() - hips_, normalized(hips_ - knees, k_up));
    up_ = normalized(rise - left_ * dot(rise, left_), k_up);
    front_ = cross(left_, up_);
    hip_half_width_ = std::max(0.5f * distance(hip_left, hip_right), size(0.02f));
    shoulder_half_width_ = size(k_shoulder_half_width);
    if (has(Role::left_upper_arm) && has(Role::right_upper_arm))
        shoulder_half_width_ =
            std::clamp(0.5f * std::fabs(dot(at(Role::left_upper_arm) - at(Role::right_upper_arm), left_)), size(0.06f),
                       size(0.2f));
}

int Sculptor::chest_joint() const {
    for (Role role : {Role::upper_chest, Role::chest, Role::spine})
        if (has(role)) return roles_[role];
    return roles_[Role::hips];
}

/// Where the neck begins; by proportion where nothing says so.
Vec3 Sculptor::neck_base() const {
    if (has(Role::neck)) return at(Role::neck);
    if (has(Role::head)) {
        const Vec3 head = at(Role::head);
        return head + (hips_ - head) * 0.14f;
    }
    for (Role role : {Role::upper_chest, Role::chest, Role::spine})
        if (has(role)) return at(role) + (at(role) - hips_) * 0.5f + Vec3{0, size(0.05f), 0};
    return hips_ + Vec3{0, size(0.3f), 0};
}

/// Under the chin. Rigs put the head's joint anywhere between the neck and the ears: the crown decides.
Vec3 Sculptor::head_base() const {
    const Vec3 joint = at(Role::head);
    const float above = std::clamp(dot(tip_of(Role::head, up_, k_head_height) - joint, up_), size(0.06f), size(0.16f));
    return joint + up_ * (above - size(k_head_height));
}

/// End of a leaf bone: the skeleton's tip, else the farthest joint below it, else the usual length along `direction`.
Vec3 Sculptor::tip_of(Role role, Vec3 direction, float usual) const {
    const int joint = roles_[role];
    const auto j = static_cast<std::size_t>(joint);
    float farthest = size(0.3f * usual);
    Vec3 tip = bind_[j].translation + direction * size(usual);
    for (int k = joint; k < skeleton_.joint_count(); ++k) {
        if (!is_within(skeleton_, k, joint)) continue;
        const Vec3 end =
            transform_point(bind_[static_cast<std::size_t>(k)], skeleton_.tips[static_cast<std::size_t>(k)]);
        const float along = dot(end - bind_[j].translation, direction);
        if (along <= farthest || along > size(2.5f * usual)) continue;
        farthest = along;
        tip = bind_[j].translation + direction * along;
    }
    return tip;
}

/// A ring square to `along`, its depth towards the body's front.
Ring Sculptor::ring(Vec3 center, Vec3 along, const Girth& girth, const SkinWeights& skin) const {
    Vec3 forward = front_ - along * dot(front_, along);
    if (length(forward) < 0.2f) forward = up_ - along * dot(up_, along);  // an arm that points forward
    forward = normalized(forward);
    const Vec3 across = normalized(cross(forward, along));
    return {center - forward * size(girth.back), across * size(girth.across), forward * size(girth.depth), skin};
}

void Sculptor::add_torso() {
    // The path: up from the hip joints through the spine's joints to the top of the neck.
    std::vector<Vec3> points{hips_};
    SkinChain chain{{{roles_[Role::hips], 0, 0}}};
    float place = 0;
    const auto extend = [&](Vec3 to, int joint) {
        if (dot(to - points.back(), up_) < size(0.01f)) return;
        place += distance(to, points.back());
        points.push_back(to);
        if (joint != k_no_joint) chain.links.push_back({joint, place, 0});
    };
    for (Role role : {Role::spine, Role::chest, Role::upper_chest})
        if (has(role) && dot(neck_base() - at(role), up_) > size(0.03f)) extend(at(role), roles_[role]);
    extend(neck_base(), roles_[Role::neck]);
    const float to_neck = std::max(place, size(0.1f));
    if (has(Role::head)) extend(head_base(), roles_[Role::head]);
    const float neck_length = place > to_neck ? place - to_neck : size(0.05f);
    for (std::size_t i = 1; i < chain.links.size(); ++i) {
        float gap = chain.links[i].place - chain.links[i - 1].place;
        if (i + 1 < chain.links.size()) gap = std::min(gap, chain.links[i + 1].place - chain.links[i].place);
        chain.links[i].reach = 0.5f * gap;
    }
    const auto point_at = [&](float s) {
        if (s <= 0) return hips_ + up_ * s;
        float done = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const float gap = distance(points[i], points[i + 1]);
            if (s <= done + gap && gap > 0) return lerp(points[i], points[i + 1], (s - done) / gap);
            done += gap;
        }
        return points.back() + up_ * (s - done);
    };
    const float hip = hip_half_width_ / stature_, shoulder = shoulder_half_width_ / stature_;
    const float trunk = to_neck / stature_, neck = neck_length / stature_;
    // Upper stations follow the shoulder joints, which rigs put at different heights.
    constexpr float k_usual_shoulder = 0.914f;  // share of the trunk, hip joints to neck
    float lift = trunk;
    if (has(Role::left_upper_arm) && has(Role::right_upper_arm)) {
        const Vec3 middle = 0.5f * (at(Role::left_upper_arm) + at(Role::right_upper_arm));
        lift = trunk * std::clamp(dot(middle - hips_, up_) / to_neck, 0.8f, 1.1f) / k_usual_shoulder;
    }
    const float above = std::max(trunk, 1.01f * lift);
    const Girth girths[] = {{-0.062f, 0.5f * hip, 0.020f},
                            {-0.052f, hip + 0.006f, 0.042f},
                            {-0.030f, hip + 0.028f, 0.056f, 0.004f},
                            {0, hip + 0.041f, 0.063f, 0.008f},
                            {0.035f, hip + 0.038f, 0.064f, 0.006f},
                            {0.30f * lift, 0.079f, 0.056f},
                            {0.45f * lift, 0.082f, 0.058f},
                            {0.62f * lift, 0.090f, 0.064f, 0.002f},
                            {0.76f * lift, std::max(0.094f, shoulder - 0.010f), 0.066f, 0.004f},
                            {0.86f * lift, std::max(0.094f, shoulder - 0.004f), 0.060f, 0.006f},
                            {0.93f * lift, shoulder * 0.86f, 0.049f, 0.008f},
                            {0.985f * lift, shoulder * 0.50f, 0.040f, 0.006f},
                            {above + 0.08f * neck, 0.037f, 0.037f, 0.004f},
                            {std::max(above + 0.2f * neck, trunk + 0.5f * neck), 0.032f, 0.034f},
                            {std::max(above + 0.3f * neck, trunk + neck), 0.032f, 0.034f},
                            {std::max(above + 0.3f * neck, trunk + neck) + 0.02f, 0.024f, 0.026f}};
    std::vector<Ring> rings;
    for (const Girth& girth : girths) {
        const float s = size(girth.along);
        rings.push_back({point_at(s) - front_ * size(girth.back), left_ * size(girth.across),
                         front_ * size(girth.depth), chain.at(s)});
    }
    add_loft(mesh_, rings, 24);
}

void Sculptor::add_head() {
    if (!has(Role::head)) return;
    const SkinWeights skin = SkinWeights::rigid(roles_[Role::head]);
    const Vec3 base = head_base();
    constexpr float height = k_head_height;
    // From under the chin to the crown; a face that looks forward, so that the heading shows.
    const Girth girths[] = {
        {0.00f, 0.026f, 0.030f, -0.008f}, {0.06f, 0.032f, 0.042f, -0.014f}, {0.18f, 0.037f, 0.049f, -0.013f},
        {0.34f, 0.041f, 0.053f, -0.009f}, {0.52f, 0.043f, 0.055f, -0.006f}, {0.68f, 0.043f, 0.054f, -0.003f},
        {0.82f, 0.037f, 0.047f, -0.001f}, {0.93f, 0.026f, 0.033f, 0},       {0.99f, 0.011f, 0.014f, 0}};
    std::vector<Ring> rings;
    for (const Girth& girth : girths)
        rings.push_back({base + up_ * size(girth.along * height) - front_ * size(girth.back),
                         left_ * size(girth.across), front_ * size(girth.depth), skin});
    add_loft(mesh_, rings, 20);
    const Girth nose[] = {{0.52f, 0.003f, 0.004f, -0.058f},
                          {0.40f, 0.007f, 0.009f, -0.064f},
                          {0.33f, 0.009f, 0.011f, -0.064f},
                          {0.29f, 0.006f, 0.006f, -0.061f}};
    rings.clear();
    for (const Girth& girth : nose)
        rings.push_back({base + up_ * size(girth.along * height) - front_ * size(girth.back),
                         left_ * size(girth.across), front_ * size(girth.depth), skin});
    add_loft(mesh_, rings, 8);
}

void Sculptor::add_leg(Side side) {
    const Leg& leg = legs_[side];
    const auto origin = [&](int joint) { return bind_[static_cast<std::size_t>(joint)].translation; };
    const Vec3 hip = origin(leg.upper), knee = origin(leg.lower), ankle = origin(leg.foot);
    const Vec3 thigh = normalized(knee - hip, -k_up), shank = normalized(ankle - knee, -k_up);
    const float a = std::max(distance(hip, knee), size(0.01f)), b = std::max(distance(knee, ankle), size(0.01f));
    const SkinChain chain{{{roles_[Role::hips], 0, 0},
                           {leg.upper, 0, size(0.045f)},
                           {leg.lower, a, size(0.042f)},
                           {leg.foot, a + b, size(0.016f)}}};
    const float inner = std::min(0.051f, 0.99f * hip_half_width_ / stature_);
    const float top = stature_ / a;
    const Girth upper[] = {{-0.052f * top, 0.35f * inner, 0.020f, 0.006f},
                           {-0.044f * top, 0.66f * inner, 0.038f, 0.006f},
                           {-0.026f * top, 0.90f * inner, 0.051f, 0.006f},
                           {0.04f, inner, 0.057f, 0.003f},
                           {0.20f, inner, 0.056f, 0.002f},
                           {0.42f, 0.046f, 0.050f},
                           {0.64f, 0.040f, 0.044f},
                           {0.82f, 0.035f, 0.039f},
                           {0.92f, 0.033f, 0.037f}};
    const Girth lower[] = {
        {0.0f, 0.032f, 0.035f, -0.001f}, {0.08f, 0.031f, 0.033f},         {0.18f, 0.031f, 0.034f, 0.003f},
        {0.32f, 0.032f, 0.036f, 0.006f}, {0.50f, 0.028f, 0.031f, 0.005f}, {0.70f, 0.022f, 0.025f, 0.003f},
        {0.88f, 0.018f, 0.020f, 0.001f}, {1.0f, 0.017f, 0.019f},          {1.05f, 0.012f, 0.013f}};
    std::vector<Ring> rings;
    for (const Girth& girth : upper) {
        const float s = girth.along * a;
        rings.push_back(ring(hip + thigh * s, thigh, girth, chain.at(s)));
    }
    for (const Girth& girth : lower) {
        const float s = girth.along * b;
        const Vec3 along = girth.along == 0 ? normalized(thigh + shank, shank) : shank;
        rings.push_back(ring(knee + shank * s, along, girth, chain.at(a + s)));
    }
    add_loft(mesh_, rings, 16);
    add_shoe(leg);
}

/// A shoe from heel to toe tip whose sole is flat on the floor when the foot stands.
void Sculptor::add_shoe(const Leg& leg) {
    const Transform& foot = bind_[static_cast<std::size_t>(leg.foot)];
    const Transform& front = leg.toes == k_no_joint ? foot : bind_[static_cast<std::size_t>(leg.toes)];
    const SolePoints sole = sole_points(leg, foot, front);
    const Vec3 up = rotate(foot.rotation, leg.up), forward = rotate(foot.rotation, leg.forward);
    const Vec3 across = cross(up, forward);
    const float to_ball = dot(sole.ball - sole.heel, forward);
    const float whole = std::max(dot(sole.toe_tip - sole.heel, forward), to_ball + size(0.01f));
    const float ankle = std::clamp(dot(foot.translation - sole.heel, up), size(0.02f), size(0.09f));
    SkinChain chain{{{leg.foot, 0, 0}}};
    // Ahead of the ball all is toes: a bending foot would push anything else there into the floor.
    const float reach = 0.12f * to_ball;
    if (leg.toes != k_no_joint) chain.links.push_back({leg.toes, to_ball - reach, reach});
    // Share of the length before or beyond the ball, half width, height by the ankle's.
    struct Section {
        float place, half_width, height;
    };
    const float toes = whole - to_ball;
    const Section sections[] = {{0, 0.013f, 0.62f},
                                {0.03f * to_ball, 0.018f, 0.90f},
                                {0.12f * to_ball, 0.0205f, 1.15f},
                                {0.30f * to_ball, 0.0215f, 1.22f},
                                {0.46f * to_ball, 0.0225f, 1.10f},
                                {0.64f * to_ball, 0.0245f, 0.86f},
                                {0.80f * to_ball, 0.0265f, 0.68f},
                                {0.92f * to_ball, 0.0275f, 0.58f},
                                {to_ball, 0.0277f, 0.53f},
                                {to_ball + 0.30f * toes, 0.0270f, 0.47f},
                                {to_ball + 0.65f * toes, 0.0235f, 0.41f},
                                {to_ball + 0.90f * toes, 0.0160f, 0.35f},
                                {whole, 0.0075f, 0.27f}};
    constexpr float k_belly = 0.3f;  // share of the height at which a section is widest
    std::vector<Ring> rings;
    for (const Section& section : sections) {
        const float height = section.height * ankle;
        Ring shape{sole.heel + forward * section.place + up * (k_belly * height), across * size(section.half_width),
                   up * ((1 - k_belly) * height), chain.at(section.place)};
        shape.flat_at = -k_belly / (1 - k_belly);
        rings.push_back(shape);
    }
    add_loft(mesh_, rings, 18);
}

void Sculptor::add_arm(Side side) {
    const bool left = side == Side::left;
    const auto role = [&](Role of_left) { return left ? of_left : mirrored(of_left); };
    const Role upper_role = role(Role::left_upper_arm), lower_role = role(Role::left_lower_arm);
    const Role hand_role = role(Role::left_hand), girdle_role = role(Role::left_shoulder);
    if (!has(upper_role) || !has(lower_role)) return;
    const Vec3 shoulder = at(upper_role), elbow = at(lower_role);
    const Vec3 upper = normalized(elbow - shoulder, left_);
    const Vec3 wrist = has(hand_role) ? at(hand_role) : elbow + upper * size(0.146f);
    const Vec3 lower = normalized(wrist - elbow, upper);
    const float a = std::max(distance(shoulder, elbow), size(0.01f)), b = std::max(distance(elbow, wrist), size(0.01f));
    const int girdle = has(girdle_role) ? roles_[girdle_role] : chest_joint();
    SkinChain chain{{{girdle, 0, 0}, {roles_[upper_role], 0, size(0.036f)}, {roles_[lower_role], a, size(0.026f)}}};
    if (has(hand_role)) chain.links.push_back({roles_[hand_role], a + b, size(0.016f)});
    const Girth upper_girths[] = {{0.00f, 0.033f, 0.033f},  {0.14f, 0.032f, 0.033f},  {0.32f, 0.028f, 0.030f},
                                  {0.55f, 0.0245f, 0.027f}, {0.78f, 0.022f, 0.0235f}, {0.92f, 0.021f, 0.0215f}};
    const Girth lower_girths[] = {{0.0f, 0.0205f, 0.021f},  {0.09f, 0.021f, 0.022f},   {0.25f, 0.0215f, 0.0225f},
                                  {0.5f, 0.0185f, 0.0195f}, {0.78f, 0.0145f, 0.0165f}, {0.95f, 0.0125f, 0.0155f}};
    std::vector<Ring> rings;
    // The shoulder's cap begins inside the chest.
    const Vec3 inward = left ? -left_ : left_;
    rings.push_back(ring(shoulder + inward * size(0.050f), normalized(upper - inward), {0, 0.024f, 0.026f},
                         SkinWeights::rigid(girdle)));
    rings.push_back(ring(shoulder + inward * size(0.022f), normalized(upper - inward), {0, 0.031f, 0.032f},
                         chain.at(-size(0.022f))));
    for (const Girth& girth : upper_girths)
        rings.push_back(ring(shoulder + upper * (girth.along * a), upper, girth, chain.at(girth.along * a)));
    for (const Girth& girth : lower_girths) {
        const Vec3 along = girth.along == 0 ? normalized(upper + lower, lower) : lower;
        rings.push_back(ring(elbow + lower * (girth.along * b), along, girth, chain.at(a + girth.along * b)));
    }
    if (has(hand_role)) {
        const Vec3 tip = tip_of(hand_role, lower, k_hand_length);
        add_hand(rings, hand_role, lower, dot(tip - wrist, lower), chain, a + b);
    }
    add_loft(mesh_, rings, 14);
    if (has(hand_role)) add_thumb(hand_role, lower, dot(tip_of(hand_role, lower, k_hand_length) - wrist, lower));
}

/// A mitten, broad towards the body's front as hands are when they hang or point sideways palm down.
void Sculptor::add_hand(std::vector<Ring>& rings, Role hand, Vec3 direction, float length, const SkinChain& chain,
                        float wrist) {
    const Girth girths[] = {{0.06f, 0.0125f, 0.0165f}, {0.22f, 0.0135f, 0.0215f}, {0.42f, 0.0130f, 0.0240f},
                            {0.62f, 0.0110f, 0.0230f}, {0.82f, 0.0090f, 0.0195f}, {0.95f, 0.0070f, 0.0140f},
                            {1.00f, 0.0040f, 0.0080f}};
    for (const Girth& girth : girths)
        rings.push_back(ring(at(hand) + direction * (girth.along * length), direction, girth,
                             chain.at(wrist + girth.along * length)));
}

void Sculptor::add_thumb(Role hand, Vec3 direction, float length) {
    const SkinWeights skin = SkinWeights::rigid(roles_[hand]);
    const Ring palm = ring(at(hand), direction, {0, 1, 1}, skin);
    const Vec3 front = normalized(palm.forward);
    const Vec3 base = at(hand) + direction * (0.12f * length) + front * size(0.008f);
    const Vec3 along = normalized(direction * 0.75f + front * 0.6f);
    const Girth girths[] = {{0, 0.009f, 0.010f},
                            {0.15f, 0.010f, 0.011f},
                            {0.35f, 0.008f, 0.009f},
                            {0.48f, 0.006f, 0.007f},
                            {0.52f, 0.003f, 0.003f}};
    std::vector<Ring> rings;
    for (const Girth& girth : girths) {
        Ring shape = palm;
        shape.center = base + along * (girth.along * length);
        shape.forward = normalized(front - along * dot(front, along)) * size(girth.depth);
        shape.across = normalized(cross(shape.forward, along)) * size(girth.across);
        rings.push_back(shape);
    }
    add_loft(mesh_, rings, 8);
}

Mesh Sculptor::sculpt() {
    add_torso();
    add_head();
    for (Side side : {Side::left, Side::right}) {
        add_leg(side);
        add_arm(side);
    }
    return std::move(mesh_);
}

}  // namespace

Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                    std::span<const Transform> bind_models) {
    assert(roles.has_legs() && bind_models.size() >= skeleton.parents.size());
    Mesh mesh = Sculptor(skeleton, roles, legs, bind_models).sculpt();
    mesh.bind.assign(bind_models.begin(), bind_models.begin() + skeleton.joint_count());
    return mesh;
}

Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs) {
    std::vector<Transform> rest(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, rest);
    Mesh mesh = make_mannequin(skeleton, roles, legs, rest);
    mesh.bind.clear();
    return mesh;
}

Mesh make_mannequin(const Skeleton& skeleton, const RoleMap& roles, std::span<const Transform> standing_models) {
    return make_mannequin(skeleton, roles, make_legs(skeleton, roles, standing_models, 0), standing_models);
}

Mesh make_mannequin(const Motion& motion, const RoleMap& roles, const Legs& legs) {
    const int frame = mannequin_bind_frame(motion, roles);
    if (frame < 0) return make_mannequin(*motion.skeleton, roles, legs);
    std::vector<Transform> models(static_cast<std::size_t>(motion.joint_count()));
    local_to_model(*motion.skeleton, motion.frame(frame), models);
    return make_mannequin(*motion.skeleton, roles, legs, models);
}

}  // namespace surefoot
