#include <surefoot/mannequin/sculpt.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

// Half-widths of the change from one bone's skin to the next, shares of stature. Wide ones keep creases soft; narrow
// ones keep the outside of a bent knee or elbow from caving in.
constexpr float k_hip_reach = 0.062f, k_knee_reach = 0.034f, k_ankle_reach = 0.018f;
constexpr float k_shoulder_reach = 0.044f, k_elbow_reach = 0.026f, k_wrist_reach = 0.018f;

// Place along the leg whose skin the inside of the uppermost ring wears.
constexpr float k_inner_thigh = 0.018f;

/// A ring at a share of a bone.
struct Slice {
    float along;
    Girth girth;
};

Vec3 origin(const Measures& body, int joint) { return body.pose(joint).translation; }

}  // namespace

Tube::Tube(Cage& cage, const Measures& body, Side side, Loop from, SkinChain chain)
    : cage_(cage), body_(body), last_(std::move(from)), chain_(std::move(chain)), flip_(side == Side::right) {}

void Tube::ring(Vec3 center, const Axes& axes, const Girth& girth, float place) {
    extend(add_ring(cage_, body_, center, axes, girth, k_limb_corners, chain_.at(place)));
}

void Tube::extend(const Loop& loop) {
    cage_.bridge(last_, loop, flip_);
    last_ = loop;
}

SkinChain leg_chain(const Measures& body, Side side) {
    const Leg& leg = body.legs[side];
    const float thigh = std::max(distance(origin(body, leg.upper), origin(body, leg.lower)), body.size(0.01f));
    const float shank = std::max(distance(origin(body, leg.lower), origin(body, leg.foot)), body.size(0.01f));
    return {{{body.roles[Role::hips], 0, 0},
             {leg.upper, 0, body.size(k_hip_reach)},
             {leg.lower, thigh, body.size(k_knee_reach)},
             {leg.foot, thigh + shank, body.size(k_ankle_reach)}}};
}

void add_leg(Cage& cage, const Measures& body, Side side, const Loop& hole) {
    const Leg& leg = body.legs[side];
    const Vec3 hip = origin(body, leg.upper), knee = origin(body, leg.lower), ankle = origin(body, leg.foot);
    const float a = std::max(distance(hip, knee), body.size(0.01f));
    const float b = std::max(distance(knee, ankle), body.size(0.01f));
    const Axes hanging{-body.up, side == Side::left ? body.left : -body.left, body.front};
    const Axes thigh = hanging.turned_to(normalized(knee - hip, -body.up));
    const Axes shank = thigh.turned_to(normalized(ankle - knee, thigh.along));
    const Axes at_knee = thigh.turned_to(normalized(thigh.along + shank.along, shank.along));
    const float inner = std::min(0.048f, 0.96f * body.hip_half_width / body.stature);
    const Slice upper[] = {{0.30f, {inner, 0.053f, 0.053f}},
                           {0.50f, {0.045f, 0.048f, 0.047f}},
                           {0.72f, {0.0385f, 0.041f, 0.040f}},
                           {0.88f, {0.0335f, 0.038f, 0.0345f}}};
    const Slice lower[] = {{0.12f, {0.031f, 0.0345f, 0.036f}},
                           {0.30f, {0.0325f, 0.031f, 0.044f}},
                           {0.52f, {0.0275f, 0.0265f, 0.037f}},
                           {0.76f, {0.0205f, 0.022f, 0.0245f}},
                           {0.94f, {0.0175f, 0.020f, 0.021f}}};
    Tube tube(cage, body, side, hole, leg_chain(body, side));
    for (const Slice& slice : upper) {
        tube.ring(hip + thigh.along * (slice.along * a), thigh, slice.girth, slice.along * a);
        if (&slice != upper) continue;
        // Close to the other leg the skin of a thigh gives way to that between them.
        for (const std::size_t inside : {3u, 4u, 5u})
            cage.skins[tube.last()[inside]] =
                tube.chain().at(body.size(inside == 4 ? k_inner_thigh : 1.6f * k_inner_thigh));
    }
    tube.ring(knee, at_knee, {0.0325f, 0.0395f, 0.0325f}, a);
    for (const Slice& slice : lower)
        tube.ring(knee + shank.along * (slice.along * b), shank, slice.girth, a + slice.along * b);
    add_foot(cage, body, side, tube.last());
}

ArmBones arm_bones(const Measures& body, Side side) {
    const bool right = side == Side::right;
    const auto joint = [&](Role of_left) { return body.roles[right ? mirrored(of_left) : of_left]; };
    ArmBones arm;
    arm.upper = joint(Role::left_upper_arm);
    arm.lower = joint(Role::left_lower_arm);
    arm.hand = joint(Role::left_hand);
    arm.girdle = joint(Role::left_shoulder);
    if (arm.girdle == k_no_joint) arm.girdle = body.chest_joint();
    if (!arm.there()) return arm;
    const Vec3 out = right ? -body.left : body.left;
    arm.shoulder = origin(body, arm.upper);
    arm.elbow = origin(body, arm.lower);
    const Axes sideways{out, body.up, body.front};
    arm.upper_axes = sideways.turned_to(normalized(arm.elbow - arm.shoulder, out));
    arm.wrist = arm.hand == k_no_joint ? arm.elbow + arm.upper_axes.along * body.size(0.146f) : origin(body, arm.hand);
    arm.lower_axes = arm.upper_axes.turned_to(normalized(arm.wrist - arm.elbow, arm.upper_axes.along));
    arm.tip = arm.hand == k_no_joint ? arm.wrist : body.tip_of(arm.hand, arm.lower_axes.along, 0.108f);
    return arm;
}

SkinChain arm_chain(const Measures& body, Side side) {
    const ArmBones arm = arm_bones(body, side);
    SkinChain chain{{{arm.girdle, 0, 0}}};
    if (!arm.there()) return chain;
    const float upper = std::max(distance(arm.shoulder, arm.elbow), body.size(0.01f));
    const float fore = std::max(distance(arm.elbow, arm.wrist), body.size(0.01f));
    chain.links.push_back({arm.upper, body.size(0.006f), body.size(k_shoulder_reach)});
    chain.links.push_back({arm.lower, upper, body.size(k_elbow_reach)});
    if (arm.hand != k_no_joint) chain.links.push_back({arm.hand, upper + fore, body.size(k_wrist_reach)});
    return chain;
}

namespace {

/// The way to the knuckles where there are fingers to begin there, else to the fingertips.
float hand_length(const Measures& body, Side side, const ArmBones& arm) {
    const float whole = std::max(dot(arm.tip - arm.wrist, arm.lower_axes.along), body.size(0.03f));
    float sum = 0, fingers = 0;
    for (const Role role : {Role::left_index_proximal, Role::left_middle_proximal, Role::left_ring_proximal,
                            Role::left_little_proximal}) {
        const Role own = side == Side::left ? role : mirrored(role);
        if (!body.has(own)) continue;
        sum += dot(body.at(own) - arm.wrist, arm.lower_axes.along), ++fingers;
    }
    return fingers > 0 ? std::clamp(sum / fingers + body.size(0.006f), 0.3f * whole, whole) : whole;
}

}  // namespace

namespace {

/// From the wrist on: a mitten, or the palm alone where fingers begin at its end. `place` is the wrist's.
void add_hand(Tube& tube, const Measures& body, Side side, const ArmBones& arm, float place) {
    constexpr Slice k_mitten[] = {{0.14f, {0.0120f, 0.0175f, 0.0165f}},
                                  {0.34f, {0.0125f, 0.0225f, 0.0215f}},
                                  {0.56f, {0.0110f, 0.0225f, 0.0220f}},
                                  {0.80f, {0.0085f, 0.0195f, 0.0200f}},
                                  {0.97f, {0.0055f, 0.0110f, 0.0125f}}};
    constexpr Slice k_palm[] = {{0.25f, {0.0120f, 0.0185f, 0.0175f}},
                                {0.60f, {0.0125f, 0.0225f, 0.0225f}},
                                {0.98f, {0.0095f, 0.0225f, 0.0235f}}};
    const float whole = dot(arm.tip - arm.wrist, arm.lower_axes.along), length = hand_length(body, side, arm);
    const float s = std::clamp(whole / body.size(0.108f), 0.5f, 2.0f);
    for (const Slice& slice :
         length > 0.8f * whole ? std::span<const Slice>(k_mitten) : std::span<const Slice>(k_palm)) {
        const float along = slice.along * length;
        const Girth girth{s * slice.girth.side, s * slice.girth.front, s * slice.girth.back};
        tube.ring(arm.wrist + arm.lower_axes.along * along, arm.lower_axes, girth, place + along);
    }
}

}  // namespace

void add_arm(Cage& cage, const Measures& body, Side side, const Loop& hole) {
    const ArmBones arm = arm_bones(body, side);
    Tube tube(cage, body, side, hole, arm_chain(body, side));
    if (!arm.there()) return tube.cap();
    const float a = std::max(distance(arm.shoulder, arm.elbow), body.size(0.01f));
    const float b = std::max(distance(arm.elbow, arm.wrist), body.size(0.01f));
    const Axes &upper = arm.upper_axes, &lower = arm.lower_axes;
    // The first ring still looks half to the side.
    const Axes sideways{side == Side::left ? body.left : -body.left, body.up, body.front};
    const Axes cap = sideways.turned_to(normalized(sideways.along + upper.along, upper.along));
    const Axes at_elbow = upper.turned_to(normalized(upper.along + lower.along, lower.along));
    constexpr Slice k_upper[] = {{0.22f, {0.0315f, 0.032f, 0.033f}},
                                 {0.46f, {0.0265f, 0.028f, 0.027f}},
                                 {0.72f, {0.0225f, 0.0235f, 0.0235f}},
                                 {0.89f, {0.0205f, 0.0205f, 0.0215f}}};
    constexpr Slice k_lower[] = {{0.13f, {0.0205f, 0.0215f, 0.0215f}},
                                 {0.30f, {0.0205f, 0.022f, 0.0215f}},
                                 {0.60f, {0.0165f, 0.019f, 0.018f}},
                                 {0.92f, {0.0120f, 0.0158f, 0.0150f}}};
    tube.ring(arm.shoulder + cap.along * body.size(0.010f), cap, {0.034f, 0.0345f, 0.0355f}, body.size(0.010f));
    for (const Slice& slice : k_upper)
        tube.ring(arm.shoulder + upper.along * (slice.along * a), upper, slice.girth, slice.along * a);
    tube.ring(arm.elbow, at_elbow, {0.0195f, 0.0195f, 0.0215f}, a);
    for (const Slice& slice : k_lower)
        tube.ring(arm.elbow + lower.along * (slice.along * b), lower, slice.girth, a + slice.along * b);
    if (arm.hand != k_no_joint) add_hand(tube, body, side, arm, a + b);
    tube.cap();
}

}  // namespace surefoot
