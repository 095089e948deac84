#include <surefoot/analysis/locomotion.h>
#include <surefoot/analysis/signal.h>

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

}  // namespace

BodyFeatures body_features(const Measured& measured, const ClipFacts& facts, float leg_length) {
    BodyFeatures result;
    const Tracks& tracks = measured.tracks;
    const std::size_t n = tracks.hips.size();
    result.uneven = measured.contacts.uneven;
    std::vector<float> hips;
    for (const Transform& joint : tracks.hips) hips.push_back(joint.translation.y / leg_length);
    result.hips_low = percentile(hips, 0.05f);
    result.hips_high = percentile(hips, 0.95f);
    result.tilt = percentile(tracks.tilt, 0.9f) * k_degrees_per_radian;

    int flight = 0, longest = 0, both = 0, any = 0;
    for (int f = 0; f < static_cast<int>(n); ++f) {
        const bool left = measured.contacts.down(Side::left, f), right = measured.contacts.down(Side::right, f);
        flight = left || right ? 0 : flight + 1;
        longest = std::max(longest, flight);
        both += left && right;
        any += left || right;
    }
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

std::string why_not_locomotion(const BodyFeatures& b, const ClipFacts& facts, float leg_length) {
    // Thresholds: crouched walks keep the hips above 0.55 leg lengths, sprinters lean 35 degrees and fly for 0.2 s.
    const float tempo = std::sqrt(leg_length / 0.9f);
    if (facts.frames < 2 || facts.duration < 0.1f) return "a single pose, not a motion";
    if (b.hips_low < 0.45f)
        return fmt::format("the hips go down to {:.0f} % of the leg's length: it sits, kneels, lies or falls",
                           100 * b.hips_low);
    if (b.tilt > 60) return fmt::format("the torso leans {:.0f} degrees: it rolls, swims, lies or falls", b.tilt);
    if (b.standing < 0.15f) return "the feet hardly touch the ground: it flies, swims or hangs";
    if (b.airborne > 0.45f * tempo)
        return fmt::format("both feet are off the ground for {:.2f} s: it jumps or falls", b.airborne);
    const bool level = std::fabs(facts.slope) < 3 && !b.uneven;
    if (level && b.hips_high - b.hips_low > 0.28f)
        return fmt::format("the hips rise or sink by {:.0f} cm on level ground: it jumps, sits down or gets up",
                           100 * (b.hips_high - b.hips_low) * leg_length);
    const int strikes = b.strikes[0] + b.strikes[1];
    const bool travels = std::fabs(facts.speed) > k_slowest * tempo, turns = std::fabs(facts.turn) > k_slowest_turn;
    if (!travels && !turns) {
        if (b.planted > 0.9f || (strikes == 0 && b.foot_speed < 0.3f)) {  // stands
            if (b.hand_speed > 1.0f * tempo)
                return fmt::format("it stands and its hands move at {:.1f} m/s: a gesture or an attack", b.hand_speed);
            return {};
        }
        return "the feet step but the body gets nowhere: a dance, a fight or a shuffle";
    }
    if (b.strikes[0] < 1 || b.strikes[1] < 1) return "the body travels but the feet do not step in turn";
    return {};
}

}  // namespace surefoot
