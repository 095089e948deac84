#include <surefoot/analysis/measure.h>
#include <surefoot/analysis/signal.h>
#include <surefoot/analysis/treadmill.h>
#include <surefoot/motion/edit.h>

#include <algorithm>

namespace surefoot {
namespace {

constexpr float k_still = 0.02f;  // [m/s] below this a direction of travel means nothing

/// Mean velocity in the body's frame. A cyclic clip's is that of its root; elsewhere the hips' own displacement is
/// seen through the smooth heading of the root, so that the ends of the low-passed path do not matter.
void measure_velocity(const Motion& motion, const Tracks& tracks, ClipFacts& facts) {
    const std::size_t n = motion.root.size();
    const float time = motion.duration();
    facts.forward = facts.lateral = facts.chord = facts.turn = facts.climb = 0;
    if (n < 2) return;
    const auto place = [&](std::size_t f) {
        return motion.cyclic ? motion.root[f].position : tracks.hips[f].translation;
    };
    double forward = 0, lateral = 0;
    for (std::size_t f = 1; f < n; ++f) {
        const float yaw = 0.5f * (motion.root[f].yaw + motion.root[f - 1].yaw);
        const Vec3 step = rotate(from_yaw(-yaw), place(f) - place(f - 1));
        forward += static_cast<double>(step.z);
        lateral += static_cast<double>(step.x);
    }
    set_travel(facts, static_cast<float>(forward) / time, static_cast<float>(lateral) / time);
    facts.chord = planar_length(place(n - 1) - place(0)) / time;
    facts.turn = (motion.root[n - 1].yaw - motion.root[0].yaw) / time * k_degrees_per_radian;
}

/// Rise per planar metre of the places where the feet stand, by the slope of the least-squares line.
void measure_slope(const Measured& measured, ClipFacts& facts) {
    facts.slope = facts.climb = 0;
    if (!measured.contacts.uneven) return;
    const Tracks& tracks = measured.tracks;
    double n = 0, st = 0, sy = 0, stt = 0, sty = 0;
    for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t f = 0; f < tracks.foot[s].mid.size(); ++f) {
            if (measured.contacts.state[s][f] != Contact::flat) continue;
            const double t = static_cast<double>(f) / static_cast<double>(tracks.fps);
            const double y = static_cast<double>(tracks.foot[s].mid[f].y);
            n += 1, st += t, sy += y, stt += t * t, sty += t * y;
        }
    const double spread = stt - st * st / std::max(n, 1.0);
    if (n < 4 || !(spread > 1e-6)) return;
    facts.climb = static_cast<float>((sty - st * sy / n) / spread);
    const float planar = std::fabs(facts.speed);
    if (planar > 0.1f) facts.slope = atan2(facts.climb, planar) * k_degrees_per_radian;
}

/// Mean time between strikes, from the first strike of each foot to its last.
void measure_steps(const Measured& measured, const Motion& motion, ClipFacts& facts) {
    facts.cadence = facts.stride = facts.duty = 0;
    float strikes = 0, span = 0;
    double down = 0, frames = 0;
    for (const Side side : {Side::left, Side::right}) {
        float first = -1, last = -1;
        int count = 0;
        for (const PhaseEvent& event : facts.events) {
            if (event.foot != side || event.kind != StrideEvent::strike) continue;
            if (count++ == 0) first = event.time;
            last = event.time;
        }
        int from = 0, to = motion.frame_count() - 1;
        if (motion.cyclic) {
            strikes += static_cast<float>(count);
            span = motion.duration();
        } else if (count >= 2) {  // whole strides of this foot
            strikes += static_cast<float>(count - 1);
            span += 0.5f * (last - first);
            from = static_cast<int>(first * motion.fps + 0.5f), to = static_cast<int>(last * motion.fps + 0.5f);
        }
        for (int f = from; f < to; ++f, ++frames) down += measured.contacts.down(side, f) ? 1 : 0;
    }
    if (strikes > 0 && span > 0) facts.cadence = 60 * strikes / span;
    if (!(facts.cadence > 0)) {  // no whole stride: one step from foot to foot still tells the rhythm
        std::vector<float> times;
        for (const PhaseEvent& event : facts.events)
            if (event.kind == StrideEvent::strike) times.push_back(event.time);
        if (times.size() >= 2 && times.back() > times.front())
            facts.cadence = 60 * static_cast<float>(times.size() - 1) / (times.back() - times.front());
    }
    if (facts.cadence > 0) facts.stride = std::fabs(facts.speed) * 120 / facts.cadence;
    if (facts.cadence > 0 && frames > 0) facts.duty = static_cast<float>(down / frames);
}

void measure_heights(const Tracks& tracks, ClipFacts& facts) {
    double hips = 0;
    for (const Transform& joint : tracks.hips) hips += static_cast<double>(joint.translation.y);
    facts.hip_height = static_cast<float>(hips / static_cast<double>(tracks.hips.size()));
    // A rig whose head joint is its highest point says nothing of the skull: 13 % of stature above that joint (Drillis
    // & Contini 1966 put the chin at 0.87).
    const float crown = percentile(tracks.crown, 0.9f);
    std::vector<float> head;
    for (const Vec3 p : tracks.head) head.push_back(p.y);
    const float joint = percentile(head, 0.9f);
    facts.height = crown > joint + 0.02f ? crown : joint / 0.87f;
}

/// The slip of the standing feet under the root motion that the clip has.
void measure_disagreement(const Motion& motion, const Tracks& tracks, float leg_length, ClipFacts& facts) {
    const GroundMotion slip = estimate_slip(tracks, motion.root, leg_length);
    const bool usable = slip.coverage > 0.2f && motion.frame_count() > 3;
    facts.root_disagreement_speed = usable ? slip.speed() : 0;
    facts.root_disagreement_turn = usable ? std::fabs(slip.turn) * k_degrees_per_radian : 0;
}

template <typename T>
std::vector<T> middle_of(const std::vector<T>& track, std::size_t first, std::size_t count) {
    if (track.empty()) return {};
    const auto begin = track.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

void set_travel(ClipFacts& facts, float forward, float lateral) {
    facts.forward = forward;
    facts.lateral = lateral;
    const float planar = std::sqrt(forward * forward + lateral * lateral);
    facts.travel = planar > k_still ? atan2(lateral, forward) * k_degrees_per_radian : 0;
    facts.speed = std::fabs(facts.travel) > 90 ? -planar : planar;
}

StanceFlags stance_flags(const ClipFacts& facts) {
    StanceFlags flags;
    for (std::size_t side = 0; side < 2; ++side)
        for (const Contact contact : facts.contacts[side]) flags[side].push_back(contact != Contact::lifted);
    return flags;
}

Measured measure(const Motion& motion, const RoleMap& roles, const Legs& legs, ClipFacts& facts) {
    Measured measured;
    measured.tracks = make_tracks(motion, roles);
    add_soles(measured.tracks, legs);
    const float leg = 0.5f * (legs[Side::left].length() + legs[Side::right].length());
    facts.frames = motion.frame_count();
    facts.joints = motion.joint_count();
    facts.fps = motion.fps;
    facts.duration = motion.duration();
    facts.cyclic = motion.cyclic;
    measure_velocity(motion, measured.tracks, facts);

    const std::size_t n = motion.root.size();
    if (motion.cyclic && n > 1) {
        const Tracks three = repeated(measured.tracks, motion.root.front(), motion.root.back());
        const Contacts all = find_contacts(three, leg);
        measured.contacts.uneven = all.uneven;
        for (std::size_t s = 0; s < 2; ++s) measured.contacts.state[s] = middle_of(all.state[s], n - 1, n);
        const float begin = static_cast<float>(n - 1) / motion.fps, end = static_cast<float>(2 * (n - 1)) / motion.fps;
        facts.events.clear();
        for (PhaseEvent event : find_events(all, motion.fps))
            if (event.time > begin - 0.5f / motion.fps && event.time < end - 0.5f / motion.fps) {
                event.time = std::max(0.0f, event.time - begin);
                facts.events.push_back(event);
            }
        facts.skate = planted_skate(three);
        measure_disagreement(motion, three, leg, facts);
    } else {
        measured.contacts = find_contacts(measured.tracks, leg);
        facts.events = find_events(measured.contacts, motion.fps);
        facts.skate = planted_skate(measured.tracks);
        measure_disagreement(motion, measured.tracks, leg, facts);
    }
    for (std::size_t s = 0; s < 2; ++s) facts.contacts[s] = measured.contacts.state[s];
    measure_slope(measured, facts);
    measure_steps(measured, motion, facts);
    measure_heights(measured.tracks, facts);
    const LoopClosing seam = measure_seam(motion);
    facts.seam = facts.loop_error = seam.seam;
    facts.seam_speed = seam.seam_speed;
    facts.closing = 0;
    return measured;
}

}  // namespace surefoot
