// A foot in a soft shoe: a tube from the ankle over the heel to the toes, whose underside is flat on the floor.

#include <surefoot/mannequin/sculpt.h>

#include <algorithm>

namespace surefoot {

namespace {

/// A cross-section of the foot in its plane of symmetry: the points where it is highest and lowest (ahead of the heel
/// and over the floor), its half-width, whether its underside is the sole, and how far along the foot its skin is.
struct FootSlice {
    float top_ahead, top_up, bottom_ahead, bottom_up, half_width;
    bool sole;
};

struct FootFrame {
    Vec3 heel, forward, up, outward;

    Vec3 at(float ahead, float high, float out) const { return heel + forward * ahead + up * high + outward * out; }
};

/// Corners from the outside over the top to the inside and back along the underside, as the leg's rings have them.
Loop add_slice(Cage& cage, const FootFrame& frame, const FootSlice& slice, const SkinChain& chain) {
    // Where each corner lies: outward in half-widths, and between bottom (0) and top (1).
    struct Corner {
        float out, high;
    };
    constexpr Corner k_round[] = {{1, 0.5f},  {0.72f, 0.86f},  {0, 1}, {-0.72f, 0.86f},
                                  {-1, 0.5f}, {-0.72f, 0.14f}, {0, 0}, {0.72f, 0.14f}};
    constexpr Corner k_shoe[] = {{1.04f, 0.30f},  {0.70f, 0.84f}, {0, 1.04f}, {-0.70f, 0.84f},
                                 {-1.04f, 0.30f}, {-0.98f, 0},    {0, 0},     {0.98f, 0}};
    Loop loop;
    for (int k = 0; k < k_limb_corners; ++k) {
        const Corner& corner = slice.sole ? k_shoe[k] : k_round[k];
        const float ahead = slice.bottom_ahead + (slice.top_ahead - slice.bottom_ahead) * corner.high;
        const float high = slice.bottom_up + (slice.top_up - slice.bottom_up) * corner.high;
        loop.push_back(cage.add(frame.at(ahead, high, 1.06f * slice.half_width * corner.out), chain.at(ahead)));
    }
    return loop;
}

}  // namespace

void add_foot(Cage& cage, const Measures& body, Side side, const Loop& ankle_loop) {
    const Leg& leg = body.legs[side];
    const Transform& foot = body.pose(leg.foot);
    const SolePoints sole = sole_points(leg, foot, leg.toes == k_no_joint ? foot : body.pose(leg.toes));
    FootFrame frame;
    frame.up = rotate(foot.rotation, leg.up);
    frame.forward = rotate(foot.rotation, leg.forward);
    frame.outward = normalized(cross(frame.up, frame.forward), body.left);
    if (side == Side::right) frame.outward = -frame.outward;
    frame.heel = sole.heel;
    const auto ahead = [&](Vec3 p) { return dot(p - sole.heel, frame.forward); };
    const float ball = std::max(ahead(sole.ball), body.size(0.01f));
    const float toes = std::max(ahead(sole.toe_tip) - ball, body.size(0.012f));
    const float ankle = ahead(foot.translation);
    const float high = std::max(dot(foot.translation - sole.heel, frame.up), body.size(0.02f));
    const float h = std::min(high, body.size(0.055f)), w = std::clamp(toes / body.size(0.0426f), 0.8f, 1.5f);
    const auto wide = [&](float share) { return body.size(share) * std::min(w, 1.2f); };
    // Ahead of the ball all is toes: a bending foot would push anything else there into the floor.
    SkinChain chain{{{leg.foot, 0, 0}}};
    const bool raised = ankle < 0.3f * ball && high > 1.5f * h;
    const float reach = raised ? 0.25f * toes : 0.12f * ball;
    if (leg.toes != k_no_joint) chain.links.push_back({leg.toes, ball - (raised ? 0.0f : reach), reach});
    std::vector<FootSlice> slices;
    if (raised || ankle < 0) {
        // Walking on toes: the foot leads down from the ankle to the pad.
        const auto down = [&](float share, float half_depth) {
            const float middle = ankle + (ball - ankle) * share, height = high * (1 - share);
            slices.push_back({middle + half_depth, height + 0.35f * half_depth, middle - half_depth,
                              height - 0.35f * half_depth, wide(0.016f + 0.008f * share), false});
        };
        down(0.12f, body.size(0.021f));
        down(0.42f, body.size(0.0165f));
        down(0.68f, body.size(0.0175f));
        slices.push_back({ball + 0.15f * toes, 0.80f * body.size(0.039f), 0.05f * ball, 0.2f * body.size(0.039f),
                          wide(0.026f), false});
        slices.push_back({ball + 0.28f * toes, 0.70f * body.size(0.039f), 0.45f * ball, 0, wide(0.0285f), true});
    } else {
        const float back = std::min(0.0f, ankle - body.size(0.026f)), instep = ball - ankle;
        slices.push_back({ankle + 0.30f * instep, 0.98f * h, back, 0.66f * h, wide(0.0185f), false});
        slices.push_back({ankle + 0.44f * instep, 0.87f * h, 0.02f * ball, 0.05f * h, wide(0.0215f), false});
        slices.push_back({ankle + 0.60f * instep, 0.75f * h, 0.16f * ball, 0, wide(0.0215f), true});
        slices.push_back({ankle + 0.79f * instep, 0.62f * h, 0.55f * ball, 0, wide(0.0235f), true});
        slices.push_back({ball, 0.52f * h, ball, 0, wide(0.0275f), true});
    }
    const float t = std::min(h, body.size(0.039f));
    slices.push_back({ball + 0.48f * toes, 0.46f * t, ball + 0.48f * toes, 0, wide(0.0265f), true});
    slices.push_back({ball + 0.86f * toes, 0.38f * t, ball + 0.86f * toes, 0, wide(0.0215f), true});
    slices.push_back({ball + 1.02f * toes, 0.22f * t, ball + 1.02f * toes, 0, wide(0.0120f), true});
    Tube tube(cage, body, side, ankle_loop, chain);
    for (const FootSlice& slice : slices) tube.extend(add_slice(cage, frame, slice, chain));
    tube.cap();
}

}  // namespace surefoot
