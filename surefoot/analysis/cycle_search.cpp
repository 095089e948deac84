#include <surefoot/analysis/cycle_search.h>
#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/tracks.h>

#include <algorithm>
#include <optional>
#include <tuple>

namespace surefoot {
namespace {

constexpr float k_shortest = 0.35f, k_longest = 2.4f;  // [s] one stride: a sprinter's to a slow turn on the spot
constexpr int k_most_strides = 2;                      // in one cycle
constexpr int k_phases = 24;                           // at which a stride is tried as the beginning of its loop
constexpr float k_search = 0.07f;                      // of the duration: the closing pose is sought around the strike
constexpr float k_best_seam = 0.05f;                   // [m] before closing (DESIGN §5)
constexpr float k_longest_idle = 4, k_shortest_idle = 1;  // [s]
constexpr float k_idle_speed = 0.06f;                     // [m/s] of the smooth hips, standing
constexpr float k_turn_per_speed = 60;                    // [deg/s] of turn that weigh like 1 m/s

/// Body-frame velocity of a constant motion that makes `step` (seen from the frame it starts in) in `time` seconds.
Vec3 body_velocity(const RootFrame& seen, float time) {
    const float angle = seen.yaw;
    // Displacement = A V time with A = [s c; -c s], s = sin(a)/a, c = (1 - cos a)/a; inverted by its determinant.
    float s = 1, c = 0.5f * angle;
    if (std::fabs(angle) > 1e-4f) s = sin(angle) / angle, c = (1 - cos(angle)) / angle;
    const float det = s * s + c * c;
    const Vec3 d = seen.position / time;
    return {(s * d.x - c * d.z) / det, d.y, (c * d.x + s * d.z) / det};
}

void set_velocity(CycleCandidate& c, const RootFrame& at, float fps) {
    const float time = static_cast<float>(c.last - c.first) / fps;
    const RootFrame seen = between(at, c.step * at);
    const Vec3 v = body_velocity(seen, time);
    c.forward = v.z;
    c.lateral = v.x;
    c.turn = seen.yaw / time * k_degrees_per_radian;
}

/// Variation of the smooth root's velocity between the thirds of a cycle.
float unsteadiness(const Motion& motion, int first, int last) {
    Vec3 velocity[3];
    float turn[3];
    for (int k = 0; k < 3; ++k) {
        const int a = first + (last - first) * k / 3, b = std::max(a + 1, first + (last - first) * (k + 1) / 3);
        const RootFrame &ra = motion.root[static_cast<std::size_t>(a)], &rb = motion.root[static_cast<std::size_t>(b)];
        const float time = static_cast<float>(b - a) / motion.fps;
        const RootFrame seen = between(ra, rb);
        velocity[k] = body_velocity(seen, time);
        turn[k] = seen.yaw / time * k_degrees_per_radian;
    }
    float worst = 0;
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < k; ++l)
            worst = std::max(
                worst, planar_length(velocity[k] - velocity[l]) + std::fabs(turn[k] - turn[l]) / k_turn_per_speed);
    return worst;
}

/// Frames of strikes of one foot.
std::vector<int> strikes_of(const ClipFacts& facts, Side side) {
    std::vector<int> frames;
    for (const PhaseEvent& event : facts.events)
        if (event.foot == side && event.kind == StrideEvent::strike)
            frames.push_back(static_cast<int>(event.time * facts.fps + 0.5f));
    return frames;
}

/// Strikes of both feet from one of the left foot to a later one, in order; empty where the feet do not alternate.
std::vector<int> alternating(const std::vector<int>& left, std::size_t from, std::size_t to,
                             const std::vector<int>& right) {
    std::vector<int> strikes{left[from]};
    for (std::size_t i = from; i < to; ++i) {
        const auto own = std::lower_bound(right.begin(), right.end(), left[i]);
        const auto beyond = std::upper_bound(right.begin(), right.end(), left[i + 1]);
        if (beyond - own != 1) return {};
        strikes.push_back(*own);
        strikes.push_back(left[i + 1]);
    }
    return strikes;
}

/// A step that takes far longer than another one is a halt, or hides a step that was not seen.
bool evenly_stepped(const std::vector<int>& strikes) {
    constexpr int k_most = 2;  // times as long; a limp and turns on the spot stay below
    int shortest = 1 << 30, longest = 0;
    for (std::size_t i = 1; i < strikes.size(); ++i) {
        shortest = std::min(shortest, strikes[i] - strikes[i - 1]);
        longest = std::max(longest, strikes[i] - strikes[i - 1]);
    }
    return longest <= k_most * shortest;
}

/// The closing frame near `guess` whose pose matches that of `first` best.
CycleCandidate closed_near(const KeyPoses& poses, int first, int guess) {
    const int reach = std::max(1, static_cast<int>(k_search * static_cast<float>(guess - first)));
    CycleCandidate best;
    float best_cost = 1e30f;
    for (int last = guess - reach; last <= guess + reach; ++last) {
        if (last <= first + 3 || last >= poses.frame_count()) continue;
        const PoseMatch match = match_poses(poses, first, last);
        CycleCandidate c;
        c.first = first, c.last = last, c.step = match.step, c.seam = match.distance, c.seam_speed = match.speed;
        if (c.cost() < best_cost) best = c, best_cost = c.cost();
    }
    return best;
}

/// The stride (or strides) from one strike to another, begun where in the half cycle before or after it loops best.
CycleCandidate best_phase(const Motion& motion, const KeyPoses& poses, int strike, int next) {
    const int period = next - strike, step = std::max(1, period / k_phases);
    CycleCandidate best;
    float best_cost = 1e30f;
    for (int shift = -period / 2; shift < period / 2; shift += step) {
        const int first = strike + shift;
        if (first < 0 || first + period >= poses.frame_count()) continue;
        CycleCandidate c = closed_near(poses, first, first + period);
        if (c.last <= c.first) continue;
        set_velocity(c, motion.root[static_cast<std::size_t>(first)], motion.fps);
        c.unsteadiness = unsteadiness(motion, c.first, c.last);
        if (c.cost() < best_cost) best = c, best_cost = c.cost();
    }
    if (best.last <= best.first) return best;
    const PoseMatch match = match_poses_evenly(poses, best.first, best.last);
    best.step = match.step, best.seam = match.distance, best.seam_speed = match.speed;
    set_velocity(best, motion.root[static_cast<std::size_t>(best.first)], motion.fps);
    return best;
}

bool arms_hang(const Tracks& tracks, int frame) {
    const std::size_t f = static_cast<std::size_t>(frame);
    for (std::size_t s = 0; s < 2; ++s) {
        if (tracks.hand[s].empty() || tracks.upper_arm[s].empty()) return true;
        const Vec3 arm = tracks.hand[s][f] - tracks.upper_arm[s][f];
        if (arm.y < -0.6f * length(arm)) return true;  // at least one arm hangs: not a T-pose
    }
    return false;
}

/// Stretches of standing still on both feet with the arms down.
std::vector<std::pair<int, int>> standing_spans(const AnalyzedClip& take, const Tracks& tracks) {
    std::vector<Vec3> hips;
    for (const Transform& joint : tracks.hips) hips.push_back(joint.translation);
    const float fps = take.motion.fps;
    const std::vector<Vec3> velocity = derivative(smoothed(hips, 0.15f * fps), fps);
    const auto still = [&](int f) {
        const std::size_t i = static_cast<std::size_t>(f);
        return take.facts.contacts[0][i] != Contact::lifted && take.facts.contacts[1][i] != Contact::lifted &&
               length(velocity[i]) < k_idle_speed && arms_hang(tracks, f);
    };
    std::vector<std::pair<int, int>> spans;
    const int n = take.motion.frame_count();
    for (int f = 0; f < n;) {
        int end = f;
        while (end < n && still(end)) ++end;
        if (static_cast<float>(end - 1 - f) >= k_shortest_idle * fps) spans.push_back({f, end - 1});
        f = std::max(end, f + 1);
    }
    return spans;
}

void add_idles(const AnalyzedClip& take, const KeyPoses& poses, const Tracks& tracks,
               std::vector<CycleCandidate>& candidates) {
    const int fps = std::max(1, static_cast<int>(take.motion.fps + 0.5f));
    for (const auto& [begin, end] : standing_spans(take, tracks)) {
        const int longest = static_cast<int>(k_longest_idle) * fps, shortest = static_cast<int>(k_shortest_idle) * fps;
        std::optional<CycleCandidate> best;
        float best_cost = 1e30f;
        for (int first = begin; first + shortest <= end; first += std::max(1, fps / 10))
            for (int last = first + shortest; last <= std::min(end, first + longest); last += std::max(1, fps / 10)) {
                const PoseMatch match = match_poses(poses, first, last, {});
                CycleCandidate c;
                c.first = first, c.last = last, c.seam = match.distance, c.seam_speed = match.speed, c.idle = true;
                // A longer idle repeats less visibly: a second is worth a centimetre of seam.
                const float cost = c.cost() - 0.01f * static_cast<float>(last - first) / take.motion.fps;
                if (cost < best_cost) best = c, best_cost = cost;
            }
        if (best && best->seam < k_best_seam) candidates.push_back(*best);
    }
}

}  // namespace

bool distinct(const CycleCandidate& a, const CycleCandidate& b) noexcept {
    const int overlap = std::min(a.last, b.last) - std::max(a.first, b.first);
    if (2 * overlap <= std::min(a.last - a.first, b.last - b.first)) return true;
    const float dx = a.lateral - b.lateral, dz = a.forward - b.forward;
    return dx * dx + dz * dz >= 0.01f || std::fabs(a.turn - b.turn) >= 10;
}

std::vector<CycleCandidate> cycle_candidates(const AnalyzedClip& take, const KeyPoses& poses) {
    std::vector<CycleCandidate> candidates;
    const Motion& motion = take.motion;
    const std::vector<int> left = strikes_of(take.facts, Side::left), right = strikes_of(take.facts, Side::right);
    for (std::size_t i = 0; i < left.size(); ++i)
        for (std::size_t strides = 1; strides <= k_most_strides && i + strides < left.size(); ++strides) {
            const int first = left[i], guess = left[i + strides];
            const float time = static_cast<float>(guess - first) / motion.fps / static_cast<float>(strides);
            if (time < k_shortest || time > k_longest) continue;
            const std::vector<int> strikes = alternating(left, i, i + strides, right);
            if (strikes.empty() || !evenly_stepped(strikes)) continue;
            CycleCandidate c = best_phase(motion, poses, first, guess);
            if (c.last <= c.first || c.seam > k_best_seam) continue;
            c.strike = first >= c.first ? first : guess;
            candidates.push_back(c);
        }
    const Tracks tracks = make_tracks(motion, take.roles.roles);
    add_idles(take, poses, tracks, candidates);
    return candidates;
}

std::vector<CycleCandidate> best_distinct(std::vector<CycleCandidate> candidates) {
    std::sort(candidates.begin(), candidates.end(), [](const CycleCandidate& a, const CycleCandidate& b) {
        return std::tuple(a.cost(), a.first, a.last) < std::tuple(b.cost(), b.first, b.last);
    });
    std::vector<CycleCandidate> kept;
    for (const CycleCandidate& c : candidates)
        if (std::all_of(kept.begin(), kept.end(), [&](const CycleCandidate& k) { return distinct(c, k); }))
            kept.push_back(c);
    const auto key = [](const CycleCandidate& c) {
        return std::tuple(c.forward * c.forward + c.lateral * c.lateral, c.turn, c.first, c.last);
    };
    std::sort(kept.begin(), kept.end(),
              [&](const CycleCandidate& a, const CycleCandidate& b) { return key(a) < key(b); });
    return kept;
}

std::vector<RootFrame> steady_path(const RootFrame& first, const RootFrame& step, int frames) {
    const RootFrame seen = between(first, step * first);
    const Vec3 v = body_velocity(seen, 1);
    std::vector<RootFrame> path;
    for (int f = 0; f < frames; ++f) {
        const float t = static_cast<float>(f) / static_cast<float>(frames - 1), angle = seen.yaw * t;
        float s = t, c = 0.5f * angle * t;
        if (std::fabs(seen.yaw) > 1e-4f) s = sin(angle) / seen.yaw, c = (1 - cos(angle)) / seen.yaw;
        path.push_back(first * RootFrame{{s * v.x + c * v.z, v.y * t, s * v.z - c * v.x}, angle});
    }
    return path;
}

}  // namespace surefoot
