#include <surefoot/probe/leg_gap.h>

#include <algorithm>
#include <limits>

namespace surefoot {
namespace {

// Of a leg of 0.9 m. Shanks are 10 to 11 cm thick at the calf and 7 at the ankle; shoes about 8 cm wide.
constexpr float k_standard_leg = 0.9f, k_shank_radius = 0.04f, k_foot_radius = 0.04f;

struct Capsule {
    Vec3 from, to;
    float radius;
};

std::array<Capsule, 2> capsules_of(const LegTrack& leg, float scale) {
    const float foot = k_foot_radius * scale;
    const Vec3 up = leg.sole_up * foot, along = normalized(leg.sole[3] - leg.sole[0]) * foot;
    return {Capsule{leg.knee, leg.ankle, k_shank_radius * scale},
            Capsule{leg.sole[0] + up + along, leg.sole[3] + up - along, foot}};
}

}  // namespace

float segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1) noexcept {
    const Vec3 a = a1 - a0, b = b1 - b0, between = a0 - b0;
    const float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), at = dot(a, between), bt = dot(b, between);
    const auto within = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
    constexpr float k_point = 1e-12f;  // [m^2] a segment this short is a point
    float s = 0, t = 0;
    if (aa <= k_point) {
        t = bb > k_point ? within(bt / bb) : 0.0f;
    } else if (bb <= k_point) {
        s = within(-at / aa);
    } else {
        const float det = aa * bb - ab * ab;
        s = det > 1e-6f * aa * bb ? within((ab * bt - at * bb) / det) : 0.0f;  // parallel: any point will do
        t = (ab * s + bt) / bb;
        if (t < 0 || t > 1) {
            t = within(t);
            s = within((ab * t - at) / aa);
        }
    }
    return length(between + a * s - b * t);
}

float smallest_leg_gap(const WalkTrack& track, FrameRange range, float leg_length) {
    const float scale = leg_length / k_standard_leg;
    float gap = std::numeric_limits<float>::max();
    for (std::size_t f = range.first; f < range.end; ++f) {
        const auto left = capsules_of(track.frames[f].legs[0], scale);
        const auto right = capsules_of(track.frames[f].legs[1], scale);
        for (const Capsule& l : left)
            for (const Capsule& r : right)
                gap = std::min(gap, segment_distance(l.from, l.to, r.from, r.to) - l.radius - r.radius);
    }
    return gap;
}

}  // namespace surefoot
