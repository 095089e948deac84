#include <surefoot/analysis/locomotion.h>
#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/take.h>

#include <fmt/format.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_slowest = 0.12f;    // [m/s] slower than any walk in a game; a shuffle in place
constexpr float k_slowest_turn = 15;  // [deg/s]

std::vector<float> relative_speed(const std::vector<Vec3>& points, const std::vector<Transform>& hips, float fps) {
    std::vector<Vec3> offset;
    for (std::size_t f = 0; f < points.size(); ++f) offset.push_back(points[f] - hips[f].translation);
    std::vector<float> speed;
    for (const Vec3 v : derivative(smoothed(offset, 0.02f * fps), fps)) speed.push_back(length(v));
    return speed;
}

/// Distance on the ground of a point from the line between two others, as far as these reach.
float distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
    p.y = a.y = b.y = 0;
    const Vec3 d = b - a;
    const float along = length_squared(d) > 1e-8f ? std::clamp(dot(p - a, d) / length_squared(d), 0.0f, 1.0f) : 0;
    return distance(p, a + d * along);
}

bool lies_flat(const FootTrack& foot, std::size_t f) {
    const Vec3 sole = foot.ball[f] - foot.heel[f];
    return std::fabs(sole.y) < 0.42f * length(sole);  // sine of 25 degrees
}

/// Mean height of the hips while they pass over a foot that is down, against their mean height.
float vault_of(const Measured& measured, const std::vector<float>& hips, float leg_length) {
    const Tracks& tracks = measured.tracks;
    float over = 0, mean = 0;
    int count = 0;
    for (std::size_t f = 0; f < hips.size(); ++f) {
        mean += hips[f] / static_cast<float>(hips.size());
        const Vec3 facing = rotate(from_yaw(tracks.heading[f]), {0, 0, 1});
        for (std::size_t s = 0; s < 2; ++s) {
            const float ahead = dot(facing, tracks.foot[s].mid[f] - tracks.hips[f].translation);
            if (measured.contacts.state[s][f] == Contact::lifted || std::fabs(ahead) > 0.12f * leg_length) continue;
            over += hips[f];
            ++count;
        }
    }
    return count ? over / static_cast<float>(count) - mean : 0;
}

}  // namespace

BodyFeatures body_features(const Measured& measured, const ClipFacts& facts, float leg_length) {
    BodyFeatures result;
    const Tracks& tracks = measured.tracks;
    const std::size_t n = tracks.hips.size();
    result.uneven = measured.contacts.uneven;
    std::vector<float> hips;
    for (const Transform& joint : tracks.hips) hips.push_back(joint.translation.y / leg_length);
    result.vault = vault_of(measured, hips, leg_length);
    result.hips_low = percentile(hips, 0.05f);
    result.hips_high = percentile(hips, 0.95f);
    result.tilt = percentile(tracks.tilt, 0.9f) * k_degrees_per_radian;

    int flight = 0, longest = 0, both = 0, any = 0, flat = 0;
    std::vector<float> aside;
    for (int f = 0; f < static_cast<int>(n); ++f) {
        const bool left = measured.contacts.down(Side::left, f), right = measured.contacts.down(Side::right, f);
        flight = left || right ? 0 : flight + 1;
        longest = std::max(longest, flight);
        both += left && right;
        any += left || right;
        const std::size_t i = static_cast<std::size_t>(f);
        flat += (left && lies_flat(tracks.foot[0], i)) || (right && lies_flat(tracks.foot[1], i));
        aside.push_back(distance_to_segment(tracks.hips[i].translation, tracks.foot[0].mid[i], tracks.foot[1].mid[i]) /
                        leg_length);
    }
    result.flat = static_cast<float>(flat) / static_cast<float>(n);
    result.aside = median(aside);
    result.airborne = static_cast<float>(longest) / tracks.fps;
    result.planted = static_cast<float>(both) / static_cast<float>(n);
    result.standing = static_cast<float>(any) / static_cast<float>(n);

    std::vector<float> hands(n), feet(n);
    for (std::size_t s = 0; s < 2; ++s) {
        if (tracks.hand[s].size() == n) {
            const std::vector<float> speed = relative_speed(tracks.hand[s], tracks.hips, tracks.fps);
            for (std::size_t f = 0; f < n; ++f) hands[f] = std::max(hands[f], speed[f]);
        }
        const std::vector<Vec3> ball = derivative(smoothed(tracks.foot[s].ball, 0.02f * tracks.fps), tracks.fps);
        for (std::size_t f = 0; f < n; ++f) feet[f] = std::max(feet[f], length(ball[f]));
    }
    result.hand_speed = percentile(hands, 0.95f);
    for (const float v : hands) result.hand_swing += v / static_cast<float>(n);
    result.foot_speed = percentile(feet, 0.95f);

    if (tracks.hand[0].size() == n && tracks.hand[1].size() == n && tracks.upper_arm[0].size() == n &&
        tracks.upper_arm[1].size() == n) {
        int up = 0;
        for (std::size_t f = 0; f < n; ++f) {
            const float margin = 0.1f * leg_length;  // a T-pose's hands hang a little below the shoulders
            up += tracks.hand[0][f].y > tracks.upper_arm[0][f].y - margin &&
                  tracks.hand[1][f].y > tracks.upper_arm[1][f].y - margin;
        }
        result.arms_up = static_cast<float>(up) / static_cast<float>(n);
    }
    for (const PhaseEvent& event : facts.events)
        if (event.kind == StrideEvent::strike) ++result.strikes[static_cast<std::size_t>(event.foot)];
    return result;
}

namespace {

/// Of someone who stays where they are on both feet.
std::string why_no_idle(const BodyFeatures& b, const ClipFacts& facts, float tempo) {
    if (b.hand_swing < 0.004f && b.foot_speed < 0.004f) return "nothing moves: a held pose";
    if (b.aside > 0.3f)
        return fmt::format("the hips are {:.0f} % of a leg's length beside the feet: it sits or leans on something",
                           100 * b.aside);
    if (b.flat < 0.7f) return "no foot lies flat on the ground: it hangs, floats or falls";
    if (b.foot_speed > 0.3f * tempo) return "the feet move but do not carry the body: it treads water or shuffles";
    if (b.hand_speed > 1.0f * tempo)
        return fmt::format("it stands and its hands move at {:.1f} m/s: a gesture or an attack", b.hand_speed);
    if (facts.duration < 1) return "it stands for less than a second: a reaction, not an idle";
    return {};
}

}  // namespace

std::string why_not_locomotion(const BodyFeatures& b, const ClipFacts& facts, float leg_length) {
    // Thresholds: crouched walks keep the hips above 0.55 leg lengths, sprinters lean 35 degrees and fly for 0.2 s.
    const float tempo = std::sqrt(leg_length / 0.9f);
    if (facts.frames < 2 || facts.duration < 0.1f) return "a single pose, not a motion";
    if (b.hips_low < 0.45f)
        return fmt::format("the hips go down to {:.0f} % of the leg's length: it sits, kneels, lies or falls",
                           100 * b.hips_low);
    if (b.tilt > 60) return fmt::format("the torso leans {:.0f} degrees: it rolls, swims, lies or falls", b.tilt);
    // A sprinter sampled 24 times a second shows one or two standing frames a step.
    const float least = std::fabs(facts.speed) > 3 * tempo ? 0.05f : 0.12f;
    if (b.standing < least) return "the feet hardly touch the ground: it flies, swims or hangs";
    const bool take = !facts.cyclic && lasts_like_a_take(facts);  // a long idle is none
    if (!take && b.airborne > 0.45f * tempo)
        return fmt::format("both feet are off the ground for {:.2f} s: it jumps or falls", b.airborne);
    const bool level = std::fabs(facts.slope) < 3 && !b.uneven;
    if (!take && level && b.hips_high - b.hips_low > 0.28f)
        return fmt::format("the hips rise or sink by {:.0f} cm on level ground: it jumps, sits down or gets up",
                           100 * (b.hips_high - b.hips_low) * leg_length);
    const int strikes = b.strikes[0] + b.strikes[1];
    const bool travels = std::fabs(facts.speed) > k_slowest * tempo, turns = std::fabs(facts.turn) > k_slowest_turn;
    if (!take && !travels && !turns) {
        if (b.planted > 0.9f || (strikes == 0 && b.foot_speed < 0.3f)) return why_no_idle(b, facts, tempo);
        return "the feet step but the body gets nowhere: a dance, a fight or a shuffle";
    }
    if (b.arms_up > 0.9f && b.tilt > 35 && std::fabs(facts.speed) < tempo)
        return fmt::format("it leans {:.0f} degrees with both hands held up: it pushes or carries", b.tilt);
    if (b.strikes[0] < 1 || b.strikes[1] < 1) return "the body travels but the feet do not step in turn";
    return {};
}

}  // namespace surefoot
