#include "crowd_stage.h"

#include <surefoot/base/random.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/mannequin/mannequin.h>
#include <surefoot/math/trig.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace surefoot::wasm {
namespace {

using Json = nlohmann::ordered_json;

constexpr float k_first_radius = 3.5f, k_between_rings = 1.5f, k_between_neighbours = 1.6f;  // [m]
constexpr float k_slowest = 0.7f, k_fastest = 2.6f;                                          // [m/s]
constexpr float k_shown_beyond = 60;                                                         // [m] of the last ring
constexpr int k_level_corners[] = {8, 4};  // of the levels after the fine one

/// How many frames a pose lasts, by the distance from the eye [m].
std::uint8_t period_at(float distance) noexcept {
    return distance < 12 ? 1 : distance < 30 ? 2 : distance < 60 ? 3 : 4;
}

/// The fastest that its spaces reach straight ahead.
float fastest_of(const LocomotionGraph& graph) {
    for (const LocomotionSpace* space : {&graph.facing, &graph.lateral})
        for (std::size_t d = 0; d < space->space.axes.size(); ++d)
            if (space->axes[d] == RequestAxis::speed || space->axes[d] == RequestAxis::forward)
                return space->space.axes[d].high;
    return k_fastest;
}

}  // namespace

CrowdStage::CrowdStage(const Character& character, int count, const std::string& ground)
    : character_(character), scratch_(character.graph) {
    const Skeleton& skeleton = *character.skeleton;
    add_level(make_mannequin(skeleton, character.roles, character.legs, character.standing));
    for (const int corners : k_level_corners)
        add_level(make_low_mannequin(skeleton, character.roles, character.legs, character.standing, corners));
    for (const Transform& joint : mesh_.bind) inverse_bind_.push_back(to_matrix(inverse(joint)));
    place(std::clamp(count, 1, k_max_crowd));
    ground_ = make_crowd_ground(ground, rings_.back().radius + k_shown_beyond);
    follow_ground();
}

void CrowdStage::add_level(const Mesh& level) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), level.positions.begin(), level.positions.end());
    mesh_.normals.insert(mesh_.normals.end(), level.normals.begin(), level.normals.end());
    mesh_.joints.insert(mesh_.joints.end(), level.joints.begin(), level.joints.end());
    mesh_.weights.insert(mesh_.weights.end(), level.weights.begin(), level.weights.end());
    for (const std::uint32_t index : level.indices) mesh_.indices.push_back(first + index);
    mesh_.bind = level.bind;
    level_ends_.push_back(mesh_.indices.size());
}

void CrowdStage::place(int count) {
    const auto all = static_cast<std::size_t>(count);
    const float fastest = std::clamp(0.9f * fastest_of(character_.graph), k_slowest, k_fastest);
    Random random(1);
    while (roots_.size() < all) {
        const auto number = static_cast<float>(rings_.size());
        Ring ring{k_first_radius + k_between_rings * number, random.between(k_slowest, fastest),
                  rings_.size() % 2 == 0 ? 1.0f : -1.0f};
        const float around = static_cast<float>(2 * k_pi);
        const auto places = static_cast<std::size_t>(around * ring.radius / k_between_neighbours);
        const std::size_t here = std::min(places, all - roots_.size());
        const float turned = random.between(0, around);
        for (std::size_t i = 0; i < here; ++i) {
            const float yaw = turned + around * static_cast<float>(i) / static_cast<float>(here);
            // Its left, or its right, is where the middle is.
            const Vec3 outward = Vec3{cos(yaw), 0, -sin(yaw)} * -ring.way;
            roots_.push_back({outward * ring.radius, yaw});
            LocomotionState& state = states_.emplace_back();
            state.phase = random.unit();
            state.clock = static_cast<double>(random.between(0, 10));
            ring_of_.push_back(static_cast<std::uint16_t>(rings_.size()));
        }
        rings_.push_back(ring);
    }
    wishes_.resize(all);
    periods_.resize(all, 1);
    feet_.resize(all);
    matrices_.resize(all * character_.skeleton->rest.size());
}

/// Roots to the ground's height.
void CrowdStage::follow_ground() noexcept {
    if (!ground_.ground) return;
    for (RootFrame& root : roots_) root.position.y = height_at(*ground_.ground, root.position.x, root.position.z);
}

/// Around its ring, and back to it where it has strayed.
LocomotionRequest CrowdStage::ask(const RootFrame& root, const Ring& ring) const noexcept {
    constexpr float k_back = 0.35f, k_straighten = 1.5f, k_most_turn = 90;  // [rad/m], [1/s], [deg/s]
    const Vec3 at = root.position;
    const float strayed = std::clamp(planar_length(at) - ring.radius, -1.0f, 1.0f);
    const float along = atan2(ring.way * at.z, -ring.way * at.x) + ring.way * k_back * strayed;
    const float turn = ring.way * ring.speed / ring.radius + k_straighten * wrap_angle(along - root.yaw);
    LocomotionRequest request;
    request.speed = ring.speed;
    request.turn = std::clamp(turn / k_radians_per_degree, -k_most_turn, k_most_turn);
    return request;
}

int CrowdStage::advance(float seconds, float eye_x, float eye_z, bool lasting, bool feet) noexcept {
    const Vec3 eye{eye_x, 0, eye_z};
    for (std::size_t c = 0; c < roots_.size(); ++c) {
        wishes_[c] = ask(roots_[c], rings_[ring_of_[c]]);
        periods_[c] = lasting ? period_at(planar_length(roots_[c].position - eye)) : 1;
    }
    Crowd crowd{states_, wishes_, roots_};
    crowd.periods = periods_;
    crowd.frame = frame_;
    crowd.matrices = matrices_;
    crowd.inverse_bind = inverse_bind_;
    const bool laid = feet && ground_.ground;
    if (laid) {
        crowd.ground = ground_.ground.get();
        crowd.feet = feet_;
    } else {
        std::fill(feet_.begin(), feet_.end(), CrowdFeet{});  // they stand on what they find when they are laid again
    }
    evaluate(character_.graph, crowd, {0, roots_.size()}, std::max(seconds, 0.0f), scratch_);
    if (!laid) follow_ground();
    int posed = 0;
    for (std::size_t c = 0; c < roots_.size(); ++c) posed += is_due(crowd, c) ? 1 : 0;
    ++frame_;
    return posed;
}

std::string CrowdStage::describe() const {
    Json levels = Json::array();
    std::size_t first = 0;
    for (const std::size_t end : level_ends_) {
        levels.push_back({{"first", first}, {"count", end - first}});
        first = end;
    }
    return Json{{"count", roots_.size()},
                {"joints", character_.skeleton->rest.size()},
                {"radius", rings_.back().radius},
                {"levels", std::move(levels)},
                {"grounds", crowd_ground_names()}}
        .dump();
}

}  // namespace surefoot::wasm
