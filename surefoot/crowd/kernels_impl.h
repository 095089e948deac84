#pragma once
// The kernels' one text, instantiated for each instruction set and for the scalar twin (kernels_*.cpp).

#include <surefoot/crowd/kernels.h>
#include <surefoot/graph/sole_lanes.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

template <class T>
SUREFOOT_INLINE Mask8<T> is_set(const std::int32_t (&flags)[8]) noexcept {
    return Int8<T>::splat(0) < Int8<T>::load(flags);
}
template <class T>
SUREFOOT_INLINE void store_flags(Mask8<T> mask, std::int32_t (&flags)[8]) noexcept {
    select(mask, Int8<T>::splat(1), Int8<T>::splat(0)).store(flags);
}

/// A heading: rotation about +Y by the angle of that sine and cosine.
template <class T>
struct Heading {
    Float8<T> sine, cosine;

    SUREFOOT_INLINE Vec8<T> to_world(const Vec8<T>& v) const noexcept {
        return {v.x * cosine + v.z * sine, v.y, v.z * cosine - v.x * sine};
    }
    SUREFOOT_INLINE Vec8<T> from_world(const Vec8<T>& v) const noexcept {
        return {v.x * cosine - v.z * sine, v.y, v.z * cosine + v.x * sine};
    }
};

/// The plane of the ground about a place, world (crowd_feet.h).
template <class T>
struct PlaneLanes {
    using F = Float8<T>;
    F x, z, height, slope_x, slope_z;

    SUREFOOT_INLINE static PlaneLanes load(const float (*from)[8]) noexcept {
        return {F::load(from[0]), F::load(from[1]), F::load(from[2]), F::load(from[3]), F::load(from[4])};
    }
    SUREFOOT_INLINE void store(float (*to)[8]) const noexcept {
        x.store(to[0]);
        z.store(to[1]);
        height.store(to[2]);
        slope_x.store(to[3]);
        slope_z.store(to[4]);
    }
    SUREFOOT_INLINE F height_at(const Vec8<T>& place) const noexcept {
        constexpr float k_plane = 0.25f;  // [m] a plane is trusted so far from its place
        return height + slope_x * clamp(place.x - x, -k_plane, k_plane) +
               slope_z * clamp(place.z - z, -k_plane, k_plane);
    }
};
template <class T>
SUREFOOT_INLINE PlaneLanes<T> select(Mask8<T> m, const PlaneLanes<T>& a, const PlaneLanes<T>& b) noexcept {
    return {select(m, a.x, b.x), select(m, a.z, b.z), select(m, a.height, b.height), select(m, a.slope_x, b.slope_x),
            select(m, a.slope_z, b.slope_z)};
}

constexpr int k_from = 0, k_to = 5, k_share = 10;  // in GroundLanes::foot

template <class T>
SUREFOOT_INLINE Vec8<T> sole_centre(const GroundLanes& lanes, const float (*foot)[8]) noexcept {
    const Vec8<T> middle = (load_vec<T>(lanes.heel) + load_vec<T>(lanes.ball)) * Float8<T>::splat(0.5f);
    return load_vec<T>(foot + 4) + rotate(load_quat<T>(foot), middle);
}

template <class T>
SUREFOOT_INLINE Mask8<T> swings(const GroundLanes& lanes) noexcept {
    return is_set<T>(lanes.is_stepping) & (Float8<T>::load(lanes.share) >= Float8<T>::load(lanes.stance));
}

template <class T>
void ask_ground(GroundLanes& lanes) {
    using F = Float8<T>;
    constexpr float k_dragged = 0.1f;  // [m] farther from its place a standing foot stands elsewhere
    F half_sine, half_cosine;
    sincos(0.5f * F::load(lanes.yaw), half_sine, half_cosine);
    const Heading<T> heading{2.0f * half_sine * half_cosine, 1.0f - 2.0f * half_sine * half_sine};
    const Vec8<T> root = load_vec<T>(lanes.root);
    const Vec8<T> centre = root + heading.to_world(sole_centre<T>(lanes, lanes.now));
    const Vec8<T> coming = root + heading.to_world(sole_centre<T>(lanes, lanes.next));

    const F share = F::load(lanes.share), zero = F::splat(0);
    const PlaneLanes<T> from = PlaneLanes<T>::load(lanes.foot + k_from), to = PlaneLanes<T>::load(lanes.foot + k_to);
    const Mask8<T> strikes = ~is_set<T>(lanes.is_stepping) | (share < F::load(lanes.foot[k_share]));
    select(strikes, to, from).store(lanes.foot + k_from);
    share.store(lanes.foot[k_share]);

    const Mask8<T> swing = swings<T>(lanes), is_new = is_set<T>(lanes.is_new);
    const F off = lanes::planar_length(Vec8<T>{centre.x - to.x, zero, centre.z - to.z});
    const Mask8<T> lands = is_new | (~swing & (off > F::splat(k_dragged)));
    const Vec8<T> place = lanes::select(swing & ~is_new, coming, centre);
    store<T>(Vec8<T>{place.x, root.y, place.z}, lanes.asked);
    store<T>(centre, lanes.centre);
    heading.sine.store(lanes.sine);
    heading.cosine.store(lanes.cosine);
    store_flags<T>(lands | swing, lanes.is_asking);
    store_flags<T>(lands, lanes.is_laid);
}

/// The plane that the ground has answered with.
template <class T>
SUREFOOT_INLINE PlaneLanes<T> answered_plane(const GroundLanes& lanes, Float8<T> otherwise, float steepest) noexcept {
    using F = Float8<T>;
    const Vec8<T> normal = load_vec<T>(lanes.normal);
    const Mask8<T> hit = is_set<T>(lanes.is_hit);
    const F zero = F::splat(0), up = max(normal.y, F::splat(1e-3f)), x = -normal.x / up, z = -normal.z / up;
    const F slope = sqrt(x * x + z * z), limit = F::splat(steepest);
    const Mask8<T> steep = slope > limit;
    const F share = select(steep, limit / select(steep, slope, F::splat(1)), F::splat(1));
    return {F::load(lanes.asked[0]), F::load(lanes.asked[2]), select(hit, F::load(lanes.height), otherwise),
            select(hit, share * x, zero), select(hit, share * z, zero)};
}

template <class T>
SUREFOOT_INLINE Float8<T> smooth(Float8<T> t) noexcept {
    t = clamp(t, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// The ground as a foot sees it just now.
template <class T>
SUREFOOT_INLINE PlaneLanes<T> ground_under(const GroundLanes& lanes, const PlaneLanes<T>& from, const PlaneLanes<T>& to,
                                           const Vec8<T>& place) noexcept {
    using F = Float8<T>;
    constexpr float k_over = 0.7f;  // share of the swing that it takes: over an edge first up, and only then down
    const F old = from.height_at(place), height = to.height_at(place), stance = F::load(lanes.stance);
    const F u = (F::load(lanes.share) - stance) / (1.0f - stance);
    const F rises = select(height > old, u / k_over, (u - 1.0f) / k_over + 1.0f), turned = smooth(u);
    const PlaneLanes<T> between{place.x, place.z, old + (height - old) * smooth(rises),
                                from.slope_x + (to.slope_x - from.slope_x) * turned,
                                from.slope_z + (to.slope_z - from.slope_z) * turned};
    return select(swings<T>(lanes), between, {place.x, place.z, height, to.slope_x, to.slope_z});
}

template <class T>
void lay_feet(GroundLanes& lanes, float steepest) {
    using F = Float8<T>;
    const F zero = F::splat(0), one = F::splat(1);
    PlaneLanes<T> from = PlaneLanes<T>::load(lanes.foot + k_from), to = PlaneLanes<T>::load(lanes.foot + k_to);
    const F otherwise = select(is_set<T>(lanes.is_new), F::load(lanes.root[1]), from.height);
    to = select(is_set<T>(lanes.is_asking), answered_plane<T>(lanes, otherwise, steepest), to);
    from = select(is_set<T>(lanes.is_laid), to, from);
    from.store(lanes.foot + k_from);
    to.store(lanes.foot + k_to);
    const PlaneLanes<T> ground = ground_under<T>(lanes, from, to, load_vec<T>(lanes.centre));

    // The foot is laid onto it, both as seen from the root.
    const Heading<T> heading{F::load(lanes.sine), F::load(lanes.cosine)};
    const Vec8<T> slope = heading.from_world({ground.slope_x, zero, ground.slope_z});
    const Quat8<T> foot = load_quat<T>(lanes.now);
    const Vec8<T> place = load_vec<T>(lanes.now + 4), centre = sole_centre<T>(lanes, lanes.now);
    const Vec8<T> own_heel = load_vec<T>(lanes.heel), own_ball = load_vec<T>(lanes.ball);
    const auto lifted = [&](const Vec8<T>& own) noexcept {
        const Vec8<T> p = place + rotate(foot, own), off = p - centre;
        return Vec8<T>{p.x, p.y + (ground.height + slope.x * off.x + slope.z * off.z), p.z};
    };
    const Quat8<T> tilt = lanes::rotation_between({zero, one, zero}, Vec8<T>{-slope.x, one, -slope.z});
    const Quat8<T> rotation = lanes::normalized(multiply(tilt, foot));
    store<T>(rotation, lanes.goal);
    store<T>(stand_on(rotation, own_heel, own_ball, lifted(own_heel), lifted(own_ball)), lanes.goal + 4);
    ground.height.store(lanes.ground);
}

template <class T>
constexpr GroundKernels kernels_named(const char* name) {
    return {name, ask_ground<T>, lay_feet<T>};
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
