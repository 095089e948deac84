#include <surefoot/ik/plant.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>

namespace surefoot {
namespace {

// All constants below in centimetres, as tuned on the courses (docs/feet.md); the fit works in them.
constexpr float k_cm = 100;
constexpr int k_fit_rounds = 4;           // pitch settles within these on anything but noise
constexpr float k_overhang = 1.06f;       // the sole counts as reaching this much of its half length behind the middle
constexpr float k_round_ends = 0.5f;      // heels and tips are round: so much narrower than the foot
constexpr float k_toe_weight = 0.35f;     // missing support under the toe tip counts less
constexpr float k_protrusion = 3;         // ground that stands into the sole counts more than ground missing below
constexpr float k_toe_protrusion = 0.6f;  // but less under the toes, which bend
constexpr float k_worst_gap = 10, k_worst_wall = 10;
constexpr float k_bearing_weight = 0.6f;  // of heel, ball and toe tip themselves: no edge may lie between them,
constexpr float k_bearing_side = 0.8f;    // nor within this share of the half width beside heel and ball
constexpr float k_wall_weight = 0.05f;    // of ground just ahead of the toe or behind the heel
// A foot comes down no more steeply than this: what stands higher behind its heel is in its way.
constexpr float k_descent = 1.8f, k_descent_weight = 0.02f;
constexpr std::array k_behind{0.10f, 0.14f};  // [m] behind the heel
constexpr float k_along_scale = 6, k_across_scale = 3;
constexpr float k_steep_deg = 35, k_steep_scale_deg = 5;
constexpr float k_edge = 0.02f;        // [m] of a jump in height within half a centimetre
constexpr float k_room = 0.015f;       // [m] to keep from an edge, where there is room
constexpr float k_plain_cost = 0.02f;  // the ground is plain here: no search
constexpr int k_columns = 9, k_rows = 3;

struct Fit {
    float height = 0, rise_along = 0, rise_across = 0;  // [m], [1], [1]
    float cost = 0;
};

float square(float x) noexcept { return x * x; }

/// What the ground rises from one side of a foot to the other, at its heel and at its ball: the mean, but an edge under
/// one of the four corners is no slope to roll with.
float common_rise(float at_heel, float at_ball) noexcept {
    if (std::fabs(at_heel - at_ball) < k_edge) return 0.5f * (at_heel + at_ball);
    if (at_heel * at_ball <= 0) return 0;
    return std::fabs(at_heel) < std::fabs(at_ball) ? at_heel : at_ball;
}

/// Pitch from heel and ball, roll from the slopes beside both.
Fit fit_plane(const Footprint& foot, Vec3 centre, Vec3 lateral, const GroundProbe& probe) noexcept {
    Fit fit;
    float cosine = 1, heel = 0, ball = 0;
    const Vec3 side = lateral * (k_bearing_side * foot.half_width);
    for (int round = 0; round < k_fit_rounds; ++round) {
        const Vec3 half = foot.forward * (foot.half_length * cosine);
        heel = probe.height(centre.x - half.x, centre.z - half.z);
        ball = probe.height(centre.x + half.x, centre.z + half.z);
        const float rise = (ball - heel) / (2 * foot.half_length * cosine);
        const float change = std::fabs(rise - fit.rise_along);
        fit.rise_along = rise;
        cosine = 1 / std::sqrt(1 + rise * rise);
        if (change < 1e-5f) break;
    }
    const Vec3 half = foot.forward * (foot.half_length * cosine);
    const std::array<Vec3, 4> beside{centre - half + side, centre - half - side, centre + half + side,
                                     centre + half - side};
    std::array<float, 4> h;
    probe.heights(beside, h);
    fit.rise_across = common_rise(h[0] - h[1], h[2] - h[3]) / (2 * length(side));
    fit.height = 0.5f * (heel + ball);
    return fit;
}

float unevenness(const Footprint& foot, Vec3 centre, Vec3 lateral, const GroundProbe& probe, const Fit& fit) noexcept {
    const float cosine = 1 / std::sqrt(1 + fit.rise_along * fit.rise_along);
    const float back = -k_overhang * foot.half_length, front = foot.tip;
    std::array<Vec3, k_columns * k_rows + 11 + k_behind.size()> places;
    std::array<float, places.size()> heights, plane;
    const auto put = [&](std::size_t i, float u, float v) {
        places[i] = centre + foot.forward * u + lateral * v;
        plane[i] = fit.height + u * fit.rise_along + v * fit.rise_across;
    };
    for (int i = 0; i < k_columns; ++i)
        for (int j = 0; j < k_rows; ++j) {
            const float width = foot.half_width * (i == 0 || i == k_columns - 1 ? k_round_ends : 1.0f);
            put(static_cast<std::size_t>(i * k_rows + j),
                (back + (front - back) * static_cast<float>(i) / (k_columns - 1)) * cosine,
                width * static_cast<float>(j - 1));
        }
    constexpr std::size_t walls = k_columns * k_rows;
    put(walls, (front + 0.02f) * cosine, 0);
    put(walls + 1, (front + 0.04f) * cosine, 0);
    put(walls + 2, -(foot.half_length + 0.03f) * cosine, 0);
    put(walls + 3, -(foot.half_length + 0.06f) * cosine, 0);
    constexpr std::size_t bearing = walls + 4;
    put(bearing, -foot.half_length * cosine, 0);
    put(bearing + 1, foot.half_length * cosine, 0);
    put(bearing + 2, foot.tip * cosine, 0);
    for (std::size_t i = 0; i < 4; ++i)
        put(bearing + 3 + i, (i < 2 ? -1 : 1) * foot.half_length * cosine,
            (i % 2 == 0 ? -k_bearing_side : k_bearing_side) * foot.half_width);
    constexpr std::size_t behind = bearing + 7;
    for (std::size_t i = 0; i < k_behind.size(); ++i) put(behind + i, -(foot.half_length + k_behind[i]) * cosine, 0);
    probe.heights(places, heights);

    float cost = 0;
    for (std::size_t i = 0; i < walls; ++i) {
        const float gap = (heights[i] - plane[i]) * k_cm;
        const bool toe = dot(places[i] - centre, foot.forward) > foot.half_length * 1.05f;
        cost += (toe ? k_toe_weight : 1.0f) * square(std::min(std::fabs(gap), k_worst_gap)) / walls;
        cost += k_protrusion * (toe ? k_toe_protrusion : 1.0f) * square(std::max(0.0f, gap)) / walls;
    }
    for (std::size_t i = walls; i < bearing; ++i)
        cost += k_wall_weight * 0.5f * square(std::clamp((heights[i] - plane[i]) * k_cm, 0.0f, k_worst_wall));
    for (std::size_t i = 0; i < k_behind.size(); ++i) {
        const float high = heights[behind + i] - plane[behind + i] - k_descent * k_behind[i];
        cost += k_descent_weight * square(std::clamp(high * k_cm, 0.0f, k_worst_wall));
    }
    for (std::size_t i = bearing; i < behind; ++i)
        cost += k_bearing_weight * square(std::min(std::fabs(heights[i] - plane[i]) * k_cm, k_worst_gap));
    return cost;
}

Fit judge(const Footprint& foot, float along, float across, const GroundProbe& probe, Vec3 lateral) noexcept {
    const Vec3 centre = foot.centre + foot.forward * along + lateral * across;
    Fit fit = fit_plane(foot, centre, lateral, probe);
    const float pitch_deg = std::fabs(atan2(fit.rise_along, 1.0f)) * k_degrees_per_radian;
    fit.cost = unevenness(foot, centre, lateral, probe, fit) + 0.5f * square(along * k_cm / k_along_scale) +
               square(across * k_cm / k_across_scale) +
               square(std::max(0.0f, pitch_deg - k_steep_deg) / k_steep_scale_deg);
    return fit;
}

/// Where between edges across the way a whole foot has room: calls `take` with how far it must move along for each.
template <typename Take>
void between_edges(const Footprint& foot, const GroundProbe& probe, float along, const Take& take) noexcept {
    constexpr int k_places = 2 * static_cast<int>(GroundProbe::k_batch);
    const float back = -along - foot.half_length, front = along + foot.tip;
    const float spacing = (front - back) / (k_places - 1);
    std::array<Vec3, GroundProbe::k_batch> places;
    std::array<float, k_places> heights;
    const auto at = [&](int i) { return back + spacing * static_cast<float>(i); };
    for (int first = 0; first < k_places; first += static_cast<int>(places.size())) {
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = foot.centre + foot.forward * at(first + static_cast<int>(i));
        probe.heights(places, {heights.data() + first, places.size()});
    }
    for (int first = 0, i = 1; i <= k_places; ++i) {
        const auto n = static_cast<std::size_t>(i);
        if (i < k_places && std::fabs(heights[n] - heights[n - 1]) < k_edge) continue;
        const float least = at(first) + foot.half_length, most = at(i - 1) - foot.tip;
        const float margin = std::min(k_room, 0.5f * (most - least));
        if (margin >= 0) take(std::clamp(0.0f, least + margin, most - margin));
        first = i;
    }
}

// Most batches are small: of the room for the largest, only what is asked for is constructed.
template <class T>
std::span<T> constructed(std::byte* memory, std::size_t count) noexcept {
    T* first = reinterpret_cast<T*>(memory);
    std::uninitialized_default_construct_n(first, count);
    return {first, count};
}

}  // namespace

float GroundProbe::height(float x, float z) const noexcept {
    const GroundQuery query{{x, level, z}, up, down};
    GroundHit hit;
    ground.query({&query, 1}, {&hit, 1});
    return hit.hit ? hit.height : fallback;
}

void GroundProbe::look(std::span<const Vec3> places, std::span<GroundHit> out) const noexcept {
    alignas(GroundQuery) std::byte memory[k_batch * sizeof(GroundQuery)];
    const std::size_t count = std::min(places.size(), k_batch);
    const std::span<GroundQuery> queries = constructed<GroundQuery>(memory, count);
    for (std::size_t i = 0; i < count; ++i) queries[i] = {{places[i].x, level, places[i].z}, up, down};
    ground.query(queries, out.first(count));
}

void GroundProbe::heights(std::span<const Vec3> places, std::span<float> out) const noexcept {
    alignas(GroundHit) std::byte memory[k_batch * sizeof(GroundHit)];
    const std::size_t count = std::min(places.size(), k_batch);
    const std::span<GroundHit> hits = constructed<GroundHit>(memory, count);
    look(places, hits);
    for (std::size_t i = 0; i < count; ++i) out[i] = hits[i].hit ? hits[i].height : fallback;
}

Vec3 planted(const Plant& plant, Vec3 point, float leg_length) noexcept {
    const Vec3 v = point - plant.centre;
    const float r = length(v), free = 0.3f * leg_length, longest = 0.47f * leg_length;
    Vec3 lever = v;
    if (r > free) {
        const float x = (r - free) / (longest - free);
        lever = v * ((free + (longest - free) * x / (1 + x)) / r);
    }
    // As displacements, which are exactly zero on flat ground.
    return point + (plant.foothold - plant.centre) + (rotate(plant.tilt, lever) - lever);
}

Plant plant_for(const Plant& plant, Vec3 heel, Vec3 ball) noexcept {
    if (!plant.held) return plant;
    const Vec3 middle = (heel + ball) * 0.5f, forward{ball.x - heel.x, 0, ball.z - heel.z};
    Plant now = plant;
    now.centre = {middle.x, 0, middle.z};
    now.tilt = plant.tilt * rotation_between(normalized(forward, plant.heading), plant.heading);
    return now;
}

Footprint make_footprint(Vec3 heel, Vec3 ball, Vec3 toe_tip, float leg_length) noexcept {
    Footprint foot;
    heel.y = ball.y = toe_tip.y = 0;
    foot.centre = (heel + ball) * 0.5f;
    foot.forward = normalized(ball - heel);
    foot.half_length = std::max(0.5f * distance(heel, ball), 0.02f * leg_length);
    foot.tip = std::max(dot(toe_tip - foot.centre, foot.forward), foot.half_length);
    foot.half_width = 0.045f * leg_length;
    return foot;
}

Plant find_foothold(const Footprint& foot, const GroundProbe& probe, float along, float across) noexcept {
    const Vec3 lateral{foot.forward.z, 0, -foot.forward.x};
    float u = 0, v = 0;
    Fit best = judge(foot, 0, 0, probe, lateral);
    const auto consider = [&](float try_u, float try_v) {
        const Fit fit = judge(foot, try_u, try_v, probe, lateral);
        if (fit.cost < best.cost - 1e-6f) best = fit, u = try_u, v = try_v;
    };
    if (best.cost > k_plain_cost && along > 0) {
        // A foot just fits a tread: the place is looked for by itself.
        between_edges(foot, probe, along, [&](float there) { consider(there, 0); });
        constexpr int coarse = 8, sides = 2;
        for (int i = -coarse; i <= coarse; ++i)
            for (int j = -sides; j <= sides; ++j)
                if (i || j) consider(along * static_cast<float>(i) / coarse, across * static_cast<float>(j) / sides);
        for (float step = along / coarse / 2; step > 0.004f; step *= 0.5f) {
            const float middle = u;
            consider(middle - step, v);
            consider(middle + step, v);
            const float aside = v, sideways = step * across / along * coarse / sides;
            consider(u, std::max(aside - sideways, -across));
            consider(u, std::min(aside + sideways, across));
        }
    }
    Plant plant;
    plant.centre = foot.centre;
    plant.heading = foot.forward;
    plant.foothold = foot.centre + foot.forward * u + lateral * v;
    plant.foothold.y = best.height;
    const Vec3 normal = normalized(cross(foot.forward + k_up * best.rise_along, lateral + k_up * best.rise_across));
    plant.tilt = rotation_between(k_up, normal);
    return plant;
}

}  // namespace surefoot
