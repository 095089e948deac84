// A body of few triangles, for crowds: a closed tube a part, which overlap where they meet.

#include <surefoot/mannequin/mannequin.h>
#include <surefoot/mannequin/sculpt.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace surefoot {

namespace {

/// Tubes whose rings have as many square metres as the ellipses that they stand for.
class Tubes {
  public:
    Tubes(Mesh& mesh, const Measures& body, int corners) : mesh_(mesh), body_(body), corners_(corners) {
        const float turn = static_cast<float>(2 * k_pi) / static_cast<float>(corners), wide = turn / sin(turn);
        const float grow = std::sqrt(wide);
        // A side looks ahead and not a corner: left and right are alike, and from afar a trunk of four is a box.
        const float first = static_cast<float>(k_pi) / 2 - 0.5f * turn;
        cos_ = grow * cos(first), sin_ = grow * sin(first);
    }
    /// How far ahead of its middle that side lies, in half-axes.
    float reach() const { return sin_; }
    void ring(Vec3 center, const Axes& axes, const Girth& girth, const SkinWeights& skin) {
        const Vec3 across = axes.across * body_.size(girth.side);
        const Vec3 forward = axes.forward * body_.size(0.5f * (girth.front + girth.back));
        const Vec3 middle = center + axes.forward * body_.size(0.5f * (girth.front - girth.back));
        rings_.push_back({middle, across * cos_ + forward * sin_, forward * cos_ - across * sin_, skin});
    }
    void close() {
        add_loft(mesh_, rings_, corners_);
        rings_.clear();
    }

  private:
    Mesh& mesh_;
    const Measures& body_;
    int corners_;
    float cos_ = 1, sin_ = 0;  // of the first corner
    std::vector<Ring> rings_;
};

void add_low_trunk(Tubes& tubes, const Measures& body) {
    const Axes axes{body.up, body.left, body.front};
    const float hip = body.hip_half_width / body.stature, shoulder = body.shoulder_half_width / body.stature;
    const Vec3 neck = body.neck_base();
    const float length = std::max(dot(neck - body.hips, body.up), body.size(0.1f));
    const SkinChain spine{{{body.roles[Role::hips], 0, 0}, {body.chest_joint(), 0.5f * length, 0.3f * length}}};
    struct Part {
        float along;  // of the way from the hips to the neck
        Girth girth;
    };
    for (const Part& part : {Part{-0.2f, {hip + 0.018f, 0.044f, 0.048f}}, Part{0.12f, {hip + 0.040f, 0.058f, 0.068f}},
                             Part{0.50f, {0.076f, 0.056f, 0.052f}}, Part{0.78f, {shoulder - 0.008f, 0.062f, 0.062f}},
                             Part{0.98f, {shoulder - 0.020f, 0.036f, 0.050f}}, Part{1.10f, {0.034f, 0.032f, 0.036f}}})
        tubes.ring(lerp(body.hips, neck, part.along), axes, part.girth, spine.at(part.along * length));
    tubes.close();
    if (!body.has(Role::head)) return;
    const SkinWeights skin = SkinWeights::rigid(body.roles[Role::head]);
    const Vec3 base = body.head_base();
    for (const Part& part : {Part{-0.25f, {0.031f, 0.031f, 0.034f}}, Part{0.08f, {0.031f, 0.046f, 0.038f}},
                             Part{0.52f, {0.043f, 0.052f, 0.056f}}, Part{0.97f, {0.026f, 0.028f, 0.034f}}})
        tubes.ring(base + body.up * (part.along * body.head_height()), axes, part.girth, skin);
    tubes.close();
}

void add_low_leg(Tubes& tubes, const Measures& body, Side side) {
    const Leg& leg = body.legs[side];
    const Transform &thigh = body.pose(leg.upper), &shank = body.pose(leg.lower), &foot = body.pose(leg.foot);
    const Vec3 hip = thigh.translation, knee = shank.translation, ankle = foot.translation;
    const SkinChain chain = leg_chain(body, side);
    const float a = chain.links[2].place, b = chain.links[3].place - a;
    const Axes hanging{-body.up, body.left, body.front};
    const Axes upper = hanging.turned_to(normalized(knee - hip, -body.up));
    const Axes lower = upper.turned_to(normalized(ankle - knee, upper.along));
    const float inner = std::min(0.050f, 0.9f * body.hip_half_width / body.stature);
    tubes.ring(lerp(hip, knee, -0.06f), upper, {inner, 0.050f, 0.056f}, chain.at(0.04f * a));
    tubes.ring(lerp(hip, knee, 0.40f), upper, {0.046f, 0.050f, 0.050f}, chain.at(0.40f * a));
    tubes.ring(knee, lower, {0.032f, 0.038f, 0.033f}, chain.at(a));
    tubes.ring(lerp(knee, ankle, 0.30f), lower, {0.032f, 0.031f, 0.043f}, chain.at(a + 0.30f * b));
    tubes.ring(ankle, lower, {0.020f, 0.022f, 0.022f}, chain.at(a + b));
    tubes.close();

    const Transform toes = leg.toes == k_no_joint ? foot : body.pose(leg.toes);
    const SolePoints sole = sole_points(leg, foot, toes);
    const Vec3 up = rotate(foot.rotation, leg.up), forward = rotate(foot.rotation, leg.forward);
    const Axes along{forward, cross(up, forward), -up};
    // Rings stand on the sole with that side.
    const auto slice = [&](Vec3 on_sole, float wide, float high, int joint) {
        tubes.ring(on_sole + up * body.size(high * tubes.reach()), along, {wide, high, high},
                   SkinWeights::rigid(joint));
    };
    slice(sole.heel - forward * body.size(0.004f), 0.020f, 0.018f, leg.foot);
    slice(lerp(sole.heel, sole.ball, 0.35f), 0.022f, 0.022f, leg.foot);
    slice(sole.ball, 0.028f, 0.013f, leg.foot);
    slice(sole.toe_tip, 0.018f, 0.007f, leg.toes == k_no_joint ? leg.foot : leg.toes);
    tubes.close();
}

void add_low_arm(Tubes& tubes, const Measures& body, Side side) {
    const ArmBones arm = arm_bones(body, side);
    if (!arm.there()) return;
    const SkinChain chain = arm_chain(body, side);
    const float a = distance(arm.shoulder, arm.elbow), b = distance(arm.elbow, arm.wrist);
    const float hand = std::max(dot(arm.tip - arm.wrist, arm.lower_axes.along), body.size(0.03f));
    tubes.ring(lerp(arm.shoulder, arm.elbow, -0.08f), arm.upper_axes, {0.032f, 0.034f, 0.034f}, chain.at(0.1f * a));
    tubes.ring(lerp(arm.shoulder, arm.elbow, 0.5f), arm.upper_axes, {0.026f, 0.027f, 0.027f}, chain.at(0.5f * a));
    tubes.ring(arm.elbow, arm.lower_axes, {0.020f, 0.021f, 0.021f}, chain.at(a));
    tubes.ring(arm.wrist, arm.lower_axes, {0.013f, 0.016f, 0.016f}, chain.at(a + b));
    if (arm.hand != k_no_joint) {
        const SkinWeights skin = SkinWeights::rigid(arm.hand);
        tubes.ring(arm.wrist + arm.lower_axes.along * (0.5f * hand), arm.lower_axes, {0.011f, 0.023f, 0.023f}, skin);
        tubes.ring(arm.wrist + arm.lower_axes.along * (0.95f * hand), arm.lower_axes, {0.006f, 0.012f, 0.012f}, skin);
    }
    tubes.close();
}

}  // namespace

Mesh make_low_mannequin(const Skeleton& skeleton, const RoleMap& roles, const Legs& legs,
                        std::span<const Transform> bind_models, int corners) {
    assert(roles.has_legs() && bind_models.size() >= skeleton.parents.size() && corners >= 4);
    const Measures body(skeleton, roles, legs, bind_models);
    Mesh mesh;
    Tubes tubes(mesh, body, corners);
    add_low_trunk(tubes, body);
    for (const Side side : {Side::left, Side::right}) {
        add_low_leg(tubes, body, side);
        add_low_arm(tubes, body, side);
    }
    mesh.bind.assign(bind_models.begin(), bind_models.begin() + skeleton.joint_count());
    return mesh;
}

}  // namespace surefoot
