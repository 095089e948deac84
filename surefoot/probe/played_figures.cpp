#include <surefoot/analysis/treadmill.h>
#include <surefoot/motion/edit.h>
#include <surefoot/probe/leg_gap.h>
#include <surefoot/probe/played_figures.h>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr float k_least_speed = 0.5f;  // [m/s] errors of slower requests are shares of this

/// The ground under a root that climbs: it rises along the way of the root. Level ground has no rise.
struct Incline {
    Vec3 along;      ///< unit, level, in the root's frame
    float rise = 0;  ///< metres a metre

    explicit Incline(Vec3 velocity) {
        constexpr float k_travels = 0.05f;  // [m/s] slower, a rise is no slope
        const float planar = planar_length(velocity);
        if (planar < k_travels) return;
        along = {velocity.x / planar, 0, velocity.z / planar};
        rise = velocity.y / planar;
    }
    /// Height of the ground at a point of the root's frame.
    float at(Vec3 point) const { return rise * dot(point, along); }
};

void level(Tracks& tracks, const Incline& incline) {
    for (FootTrack& foot : tracks.foot)
        for (std::vector<Vec3>* points : {&foot.heel, &foot.mid, &foot.ball, &foot.tip})
            for (Vec3& point : *points) point.y -= incline.at(point);
}

void level(WalkTrack& track, const Incline& incline) {
    for (TrackFrame& frame : track.frames)
        for (LegTrack& leg : frame.legs)
            for (Vec3& point : leg.sole) {
                const Vec3 seen = rotate(from_yaw(-frame.root.yaw), point - frame.root.position);
                point.y -= frame.root.position.y + incline.at(seen);
            }
}

/// The root's velocity from the pose alone: whatever the runtime did with the root is taken away first. Speed is what
/// the feet say under the turn asked for: their own turn is the least sure of what they say, and would spoil it.
void measure_ground(const Character& character, const SteadyPlay& play, float leg_length, float asked_turn,
                    PlayedFigures& result) {
    Motion in_place = cut(play.motion, play.first, play.last);
    std::fill(in_place.root.begin(), in_place.root.end(), RootFrame{});
    Tracks tracks = make_tracks(in_place, character.roles);
    add_soles(tracks, character.legs);
    level(tracks, Incline(play.velocity));
    const float asked = asked_turn * k_radians_per_degree;
    const GroundMotion ground = estimate_ground_motion(tracks, leg_length, &asked);
    result.standing = ground.coverage;
    if (!(result.standing > 0)) return;
    // Of the centre, moved to the root's origin: V + omega x (0 - centre).
    result.velocity = ground.velocity + Vec3{-ground.turn * ground.centre.z, 0, ground.turn * ground.centre.x};
    result.turn = estimate_ground_motion(tracks, leg_length).turn * k_degrees_per_radian;
}

void set_errors(PlayedFigures& result, Vec3 asked, float asked_turn) {
    const float speed = planar_length(asked);
    constexpr float k_stands = 0.01f;  // [m/s] slower, there is no direction
    const Vec3 along = speed > k_stands ? Vec3{asked.x / speed, 0, asked.z / speed} : Vec3{0, 0, 1};
    const Vec3 off = result.velocity - asked, left{along.z, 0, -along.x};
    const float per_cent = 100 / std::max(speed, k_least_speed);
    result.figures[ProbeFigure::speed] = per_cent * dot(off, along);
    result.figures[ProbeFigure::lateral] = per_cent * dot(off, left);
    result.figures[ProbeFigure::turn] = result.turn - asked_turn;
}

void set_skate(const WalkTrack& track, FrameRange range, Vec3 slip, PlayedFigures& result) {
    const SkateFigures skate = measure_skate(track, track, range);
    if (skate.planted_samples > 0) {
        result.figures[ProbeFigure::skate] = static_cast<float>(skate.mean_cm_s);
        result.figures[ProbeFigure::skate_share] = static_cast<float>(skate.share);
        result.figures[ProbeFigure::skate_weighted] = static_cast<float>(skate.weighted_cm);
    } else {  // the feet stand on the treadmill, but slide over the ground too fast to be called planted
        result.figures[ProbeFigure::skate] = 100 * planar_length(slip);
        result.figures[ProbeFigure::skate_share] = 1;
        result.figures[ProbeFigure::skate_weighted] = 100 * planar_length(slip) / track.fps;
    }
}

}  // namespace

PlayedFigures measure_play(const Character& character, const SteadyPlay& play, Vec3 asked, float asked_turn) {
    PlayedFigures result;
    const float leg = 0.5f * (character.legs[Side::left].length() + character.legs[Side::right].length());
    measure_ground(character, play, leg, asked_turn, result);
    if (!(result.standing > 0)) return result;
    set_errors(result, asked, asked_turn);
    WalkTrack track = make_track(play.motion, character.legs);
    const FrameRange range{static_cast<std::size_t>(play.first), static_cast<std::size_t>(play.last)};
    result.figures[ProbeFigure::knee_peak] =
        static_cast<float>(std::max(knee_peak(track, 0, range), knee_peak(track, 1, range)));
    result.figures[ProbeFigure::leg_gap] = 100 * smallest_leg_gap(track, range, leg);
    level(track, Incline(play.velocity));
    set_skate(track, range, result.velocity - asked, result);
    return result;
}

}  // namespace surefoot
