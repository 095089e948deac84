#include <surefoot/mannequin/sculpt.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cmath>

namespace surefoot {

namespace {

/// The line through the trunk, from between the hip joints to the top of the neck, and whose skin each place wears.
struct SpinePath {
    std::vector<Vec3> points;
    SkinChain chain;
    float to_neck = 0, neck = 0;  // [m] along it; length of the neck
    Vec3 up;

    Vec3 at(float s) const;
};

Vec3 SpinePath::at(float s) const {
    if (s <= 0) return points.front() + up * s;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const float gap = distance(points[i], points[i + 1]);
        if (s <= gap && gap > 0) return lerp(points[i], points[i + 1], s / gap);
        s -= gap;
    }
    return points.back() + up * s;
}

/// The joints from the hips (not included) up to `last`.
std::vector<int> joints_up_to(const Measures& body, int last) {
    std::vector<int> joints;
    for (int j = last; j != k_no_joint && j != body.roles[Role::hips];
         j = body.skeleton.parents[static_cast<std::size_t>(j)])
        joints.insert(joints.begin(), j);
    return joints;
}

SpinePath spine_path(const Measures& body) {
    SpinePath path;
    path.up = body.up;
    path.points.push_back(body.hips);
    path.chain.links.push_back({body.roles[Role::hips], 0, 0});
    float place = 0;
    const auto extend = [&](Vec3 to, int joint) {
        if (!(dot(to - path.points.back(), body.up) >= body.size(0.008f))) return;
        place += distance(to, path.points.back());
        path.points.push_back(to);
        if (joint != k_no_joint) path.chain.links.push_back({joint, place, 0});
    };
    const int top = body.chest_joint();
    for (const int joint : joints_up_to(body, top))
        if (dot(body.neck_base() - body.pose(joint).translation, body.up) > body.size(0.02f))
            extend(body.pose(joint).translation, joint);
    extend(body.neck_base(), body.roles[Role::neck]);
    path.to_neck = std::max(place, body.size(0.1f));
    if (body.has(Role::head)) extend(body.head_base() + body.up * (0.12f * body.head_height()), body.roles[Role::head]);
    path.neck = place > path.to_neck ? place - path.to_neck : body.size(0.05f);
    std::vector<SkinChain::Link>& links = path.chain.links;
    for (std::size_t i = 1; i < links.size(); ++i) {
        float gap = links[i].place - links[i - 1].place;
        if (i + 1 < links.size()) gap = std::min(gap, links[i + 1].place - links[i].place);
        links[i].reach = 0.5f * gap;
    }
    return path;
}

/// One ring of the trunk: how far along the path, its girth, how far it is tilted (front down) and shifted forward.
struct Station {
    float along;
    Girth girth;
    float tilt = 0, ahead = 0;
    float nose = 0;  // how far the corner in front stands out
};

std::vector<Station> stations(const Measures& body, const SpinePath& path) {
    const float hip = body.hip_half_width / body.stature, shoulder = body.shoulder_half_width / body.stature;
    const float trunk = path.to_neck / body.stature, neck = path.neck / body.stature;
    // Upper stations follow the shoulder joints, which rigs put at different heights.
    float joint = 0.914f * trunk;
    if (body.has(Role::left_upper_arm) && body.has(Role::right_upper_arm)) {
        const Vec3 middle = 0.5f * (body.at(Role::left_upper_arm) + body.at(Role::right_upper_arm));
        joint = trunk * std::clamp(dot(middle - body.hips, body.up) / path.to_neck, 0.73f, 1.0f);
    }
    const float chest = std::max(0.088f, shoulder - 0.014f);
    const float nape = std::max(trunk, joint + 0.024f);
    return {{0.055f, {hip + 0.041f, 0.058f, 0.070f}},
            {0.115f, {std::max(0.076f, hip + 0.026f), 0.056f, 0.058f}},
            {0.155f / 0.302f * joint / 0.914f, {0.076f, 0.056f, 0.051f}},
            {joint - 0.088f, {0.5f * (chest + 0.084f), 0.062f, 0.057f}},
            {joint - 0.048f, {chest, 0.063f, 0.063f}},
            {joint - 0.006f, {shoulder - 0.006f, 0.052f, 0.062f}},
            {joint + 0.022f, {shoulder - 0.022f, 0.030f, 0.048f}},
            {nape + 0.008f, {0.046f, 0.030f, 0.040f}, 0.010f},
            {nape + 0.008f + 0.30f * neck, {0.0325f, 0.0315f, 0.034f}, 0.008f},
            {nape + 0.008f + std::max(0.62f * neck, 0.015f), {0.032f, 0.033f, 0.034f}, 0.008f}};
}

/// From under the chin to the crown, in heads: place, girth, tilt and how far ahead.
std::vector<Station> head_stations(float head) {
    constexpr float k_drawn = 0.130f;  // the head that these were drawn for
    const float s = head / k_drawn;
    const Station drawn[] = {{0.02f, {0.028f, 0.032f, 0.034f}, 0.021f, 0.013f},
                             {0.14f, {0.036f, 0.044f, 0.043f}, 0.015f, 0.010f},
                             {0.27f, {0.040f, 0.047f, 0.050f}, 0.006f, 0.007f, 0.006f},
                             {0.36f, {0.041f, 0.048f, 0.052f}, 0, 0.006f, 0.022f},
                             {0.52f, {0.043f, 0.047f, 0.056f}, 0, 0.005f, 0.004f},
                             {0.72f, {0.043f, 0.048f, 0.056f}, 0, 0.003f},
                             {0.89f, {0.034f, 0.038f, 0.046f}, 0, 0.000f},
                             {0.985f, {0.017f, 0.018f, 0.024f}, 0, -0.002f}};
    std::vector<Station> result;
    for (const Station& d : drawn)
        result.push_back({d.along * head,
                          {s * d.girth.side, s * d.girth.front, s * d.girth.back},
                          s * d.tilt,
                          s * d.ahead,
                          s * d.nose});
    return result;
}

Loop add_station(Cage& cage, const Measures& body, Vec3 center, const Station& station, const SkinWeights& skin) {
    const Vec3 middle = center + body.front * body.size(station.ahead);
    const float slope = station.tilt / std::max(0.5f * (station.girth.front + station.girth.back), 0.01f);
    const Vec3 forward = body.front - body.up * slope;
    Loop ring = add_ring(cage, body, middle, {body.up, body.left, forward}, station.girth, k_trunk_corners, skin);
    constexpr std::size_t k_in_front = k_trunk_corners / 4;
    cage.positions[ring[k_in_front]] += body.front * body.size(station.nose);
    return ring;
}

/// A band of the trunk without the columns of a hole: those beside corner 0 (left) and corner 6 (right).
void bridge_around_holes(Cage& cage, const Loop& from, const Loop& to) {
    for (std::size_t k = 0; k < from.size(); ++k) {
        const std::size_t next = (k + 1) % from.size();
        const bool hole = k == 11 || k == 0 || k == 5 || k == 6;
        if (!hole) cage.faces.push_back({from[k], to[k], to[next], from[next]});
    }
}

// The skin of the rim is that of a place so far along the legs, wherever it lies: what is between the legs follows
// both, and would tear if it followed them further.
constexpr float k_rim_above_hips = -0.018f;

/// The lower rim: high at the outside of the thighs, low between them.
Loop add_rim(Cage& cage, const Measures& body) {
    const SkinChain left = leg_chain(body, Side::left), right = leg_chain(body, Side::right);
    const float above = body.size(k_rim_above_hips);
    const SkinWeights groin = SkinWeights::mix(left.at(above), right.at(above), 0.5f);
    const float hip = body.hip_half_width / body.stature;
    Loop rim;
    for (int k = 0; k < k_trunk_corners; ++k) {
        const float angle = static_cast<float>(2 * k_pi) * static_cast<float>(k) / k_trunk_corners;
        const float c = cos(angle), s = sin(angle);
        const float outward = c * c;
        const float height = -0.038f + 0.058f * outward;
        const float depth = s > 0 ? 0.058f - 0.012f * (1 - outward) : 0.070f;
        const Vec3 place = body.hips + body.left * body.size((hip + 0.046f) * 1.02f * c) +
                           body.front * body.size(depth * s) + body.up * body.size(height);
        const SkinWeights skin = std::fabs(c) < 0.1f ? groin : c > 0 ? left.at(above) : right.at(above);
        rim.push_back(cage.add(place, skin));
    }
    return rim;
}

/// The loops at which the legs begin: half of the rim each, and the corner between the legs.
void split_rim(Cage& cage, const Measures& body, const Loop& rim, Holes& holes) {
    const float down = body.size(0.058f);
    const SkinWeights skin =
        SkinWeights::mix(leg_chain(body, Side::left).at(0), leg_chain(body, Side::right).at(0), 0.5f);
    const std::uint32_t crotch = cage.add(body.hips - body.up * down - body.front * body.size(0.006f), skin);
    holes.leg[0] = {rim[0], rim[1], rim[2], rim[3], crotch, rim[9], rim[10], rim[11]};
    holes.leg[1] = {rim[6], rim[5], rim[4], rim[3], crotch, rim[9], rim[8], rim[7]};
}

/// The loop around a hole between three rings, in the order of an arm's rings. Its skin follows the shoulder girdle.
Loop arm_hole(Cage& cage, const Measures& body, Side side, const Loop& low, const Loop& mid, const Loop& high) {
    const bool left = side == Side::left;
    const std::size_t middle = left ? 0 : 6, ahead = left ? 1 : 5, behind = left ? 11 : 7;
    const Loop hole{high[middle], high[ahead], mid[ahead],  low[ahead],
                    low[middle],  low[behind], mid[behind], high[behind]};
    const ArmBones arm = arm_bones(body, side);
    if (!arm.there()) return hole;
    const SkinChain chain = arm_chain(body, side);
    constexpr float k_girdle[] = {0.75f, 0.6f, 0.5f, 0.25f, 0.25f, 0.25f, 0.5f, 0.6f};
    for (std::size_t i = 0; i < hole.size(); ++i) {
        const float along = dot(cage.positions[hole[i]] - arm.shoulder, arm.upper_axes.along);
        cage.skins[hole[i]] = SkinWeights::mix(cage.skins[hole[i]], chain.at(along), k_girdle[i]);
    }
    return hole;
}

/// Goes on from the neck; returns the last ring.
Loop add_head(Cage& cage, const Measures& body, Loop last) {
    const SkinWeights skin = SkinWeights::rigid(body.roles[Role::head]);
    const Vec3 base = body.head_base();
    for (const Station& station : head_stations(body.head_height() / body.stature)) {
        const Loop ring = add_station(cage, body, base + body.up * body.size(station.along), station, skin);
        cage.bridge(last, ring, true);
        last = ring;
    }
    return last;
}

}  // namespace

Loop add_ring(Cage& cage, const Measures& body, Vec3 center, const Axes& axes, const Girth& girth, int corners,
              const SkinWeights& skin) {
    // What is made of corners on a circle by one step of subdivision lies inside of it by this much.
    const float step = static_cast<float>(2 * k_pi) / static_cast<float>(corners);
    const float swell = 4.0f / (3.0f + cos(step));
    Loop loop;
    for (int k = 0; k < corners; ++k) {
        const float c = cos(step * static_cast<float>(k)), s = sin(step * static_cast<float>(k));
        const float depth = s > 0 ? girth.front : girth.back;
        loop.push_back(cage.add(
            center + axes.across * (swell * body.size(girth.side) * c) + axes.forward * (swell * body.size(depth) * s),
            skin));
    }
    return loop;
}

Holes add_trunk(Cage& cage, const Measures& body) {
    const SpinePath path = spine_path(body);
    Holes holes;
    Loop last = add_rim(cage, body);
    split_rim(cage, body, last, holes);
    const std::vector<Station> all = stations(body, path);
    constexpr std::size_t k_armpit = 4;  // the station at the lower end of the arms' holes
    std::vector<Loop> rings;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float s = body.size(all[i].along);
        rings.push_back(add_station(cage, body, path.at(s), all[i], path.chain.at(s)));
        if (i == k_armpit + 1 || i == k_armpit + 2)
            bridge_around_holes(cage, last, rings.back());
        else
            cage.bridge(last, rings.back(), true);
        last = rings.back();
    }
    for (const Side side : {Side::left, Side::right})
        holes.arm[static_cast<std::size_t>(side)] =
            arm_hole(cage, body, side, rings[k_armpit], rings[k_armpit + 1], rings[k_armpit + 2]);
    if (body.has(Role::head)) last = add_head(cage, body, last);
    cage.cap(last, true);
    return holes;
}

}  // namespace surefoot
