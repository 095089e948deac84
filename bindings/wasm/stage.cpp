#include "stage.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/author/place.h>
#include <surefoot/base/error.h>
#include <surefoot/clip/sample.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/mannequin/mannequin.h>
#include <surefoot/math/trig.h>
#include <surefoot/preset/default_set.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace surefoot::wasm {
namespace {

using Json = nlohmann::ordered_json;

constexpr Extent k_shown{-24, 24, -16, 72};
constexpr float k_margin = 6;                    // [m] of shown ground that stays ahead of who nobody steers
constexpr Extent k_shown_rubble{-9, 9, -6, 58};  // thirty centimetres a tile: many triangles

/// What lies where in a frame, in floats. The names are those of surefoot.d.mts; a test holds the two together.
enum Place : std::size_t {
    k_time,
    k_root,                // x, y, z [m], yaw [rad]
    k_speed = k_root + 4,  // [m/s]
    k_turn,                // [deg/s]
    k_speed_limit,         // [m/s] of foot placement; 0: none
    k_hips,                // height over the ground under the root [m]
    k_phase,               // share of the cycle that is played (Stage::play); else 0
    k_feet,                // two of k_foot_floats
    k_foot_floats = 36,
    k_joints = k_feet + 2 * k_foot_floats  // 16 a joint: 4x4, column-major, world
};
enum FootPlace : std::size_t {
    k_contact,    // 0 lifted, 1 heel, 2 toes, 3 flat: as the clip means it
    k_planted,    // 1: foot placement holds it
    k_pulled_in,  // 1: its target is out of reach
    k_clearance,  // [m] of the lowest point of the sole over the ground under it
    k_knee,       // [deg] interior
    k_has_next,   // 1: the next four are known
    k_next,       // x, y, z [m]: the next foothold
    k_next_normal = k_next + 3,
    k_next_yaw = k_next_normal + 3,  // [rad]
    k_sole,                          // heel, mid, ball, toe tip
    k_hip = k_sole + 12,
    k_ankle = k_hip + 3
};
static_assert(k_ankle + 3 <= k_foot_floats);
/// After the joints: the clips that the pose is blended from, heaviest first.
enum GhostPlace : std::size_t {
    k_ghost_clip,    // index into CharacterFacts::clipNames
    k_ghost_weight,  // 0: there is none
    k_ghost_joints   // as k_joints
};
constexpr std::size_t k_most_ghosts = 4;
constexpr float k_least_ghost = 0.02f;  // weight of a clip that anybody could see in the blend

void put(std::span<float> frame, std::size_t at, Vec3 v) {
    frame[at] = v.x;
    frame[at + 1] = v.y;
    frame[at + 2] = v.z;
}

void put(std::span<float> frame, std::size_t at, const Transform& transform) {
    const Matrix34 m = to_matrix(transform);
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            frame[at + 4 * column + row] = row < 3 ? m.m[4 * row + column] : column == 3 ? 1.0f : 0.0f;
}

/// What touches the ground, judged on the twin that goes on a plane through its root.
int contact_of(const LegTrack& twin, float rise) {
    constexpr float k_down = 0.02f;  // [m]
    const auto over = [&](std::size_t point) { return twin.sole[point].y - rise * twin.sole[point].z; };
    const bool heel = over(0) < k_down, toes = std::min(over(2), over(3)) < k_down;
    return (heel ? 1 : 0) + (toes ? 2 : 0);
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json axes_of(const LocomotionSpace& space) {
    Json axes = Json::object();
    for (const Axis& axis : space.space.axes) axes[axis.name] = {axis.low, axis.high};
    return axes;
}

}  // namespace

Character default_character() {
    Project project;
    std::vector<AnalyzedClip> clips;
    for (Motion& motion : make_default_set().clips) {
        const std::string name = motion.name;
        clips.push_back(analyze_clip(std::move(motion), name));
        ProjectClip clip;
        clip.name = name;
        clip.facts = clips.back().facts;
        project.clips.push_back(std::move(clip));
    }
    std::vector<std::string> warnings;
    place_clips(project, {}, nullptr, warnings);
    return bake_character(clips, project.spaces, "Default character");
}

Character packed_character(std::span<const std::byte> bytes) {
    std::string problem;
    const std::optional<Pack> pack = Pack::open(bytes, &problem);
    if (!pack) throw Error(problem, "the pack", "make it again");
    return to_character(*pack);
}

Stage::Stage(Character character, std::vector<std::byte> bytes)
    : bytes_(std::move(bytes)), character_(std::move(character)) {
    wear(body_of(character_));
    walker_ = make_character_walker(character_);
    set_course("hills", grade_);
}

/// True where it is another one than before.
bool Stage::wear(const StageBody& body) {
    if (body.skeleton == body_.skeleton) return false;
    body_ = body;
    bind_mesh();
    const std::size_t pose_floats = 16 * body_.standing.size();
    frame_.assign(k_joints + pose_floats + k_most_ghosts * (k_ghost_joints + pose_floats), 0);
    models_.resize(body_.standing.size());
    return true;
}

void Stage::bind_mesh() {
    mesh_ = make_mannequin(*body_.skeleton, body_.roles, body_.legs, body_.standing);
    std::vector<Transform> bind = mesh_.bind;
    if (bind.empty()) {
        bind.resize(body_.skeleton->rest.size());
        local_to_model(*body_.skeleton, body_.skeleton->rest, bind);
    }
    inverse_bind_.resize(16 * bind.size());
    for (std::size_t j = 0; j < bind.size(); ++j) put(inverse_bind_, 16 * j, inverse(bind[j]));
}

std::string Stage::describe() const {
    Json figures = Json::array();
    for (const WalkFigure& figure : walk_figures())
        figures.push_back({{"key", figure.key},
                           {"name", figure.head},
                           {"unit", figure.unit},
                           {"mark", figure.mark ? Json(figure.mark) : Json(nullptr)}});
    Json layout = {{"time", k_time},
                   {"root", k_root},
                   {"speed", k_speed},
                   {"turn", k_turn},
                   {"speedLimit", k_speed_limit},
                   {"hips", k_hips},
                   {"phase", k_phase},
                   {"feet", k_feet},
                   {"footFloats", k_foot_floats},
                   {"joints", k_joints},
                   {"ghosts", k_joints + 16 * models_.size()},
                   {"ghostFloats", k_ghost_joints + 16 * models_.size()},
                   {"mostGhosts", k_most_ghosts}};
    layout["ghost"] = {{"clip", k_ghost_clip}, {"weight", k_ghost_weight}, {"joints", k_ghost_joints}};
    layout["foot"] = {{"contact", k_contact},
                      {"planted", k_planted},
                      {"pulledIn", k_pulled_in},
                      {"clearance", k_clearance},
                      {"knee", k_knee},
                      {"hasNext", k_has_next},
                      {"next", k_next},
                      {"nextNormal", k_next_normal},
                      {"nextYaw", k_next_yaw},
                      {"sole", k_sole},
                      {"hip", k_hip},
                      {"ankle", k_ankle}};
    Json clip_names = Json::array();
    const bool own = body_.skeleton == character_.skeleton;  // whose clips they are
    if (own)
        for (const PackedClip& clip : character_.graph.clips) clip_names.push_back(clip.name);
    Json out = {{"name", body_.name},
                {"joints", body_.skeleton->names},
                {"parents", body_.skeleton->parents},
                {"clipNames", std::move(clip_names)},
                {"hipHeight", body_.hip_height},
                {"facing", axes_of(character_.graph.facing)},
                {"lateral", axes_of(character_.graph.lateral)},
                {"courses", course_names()},
                {"figures", std::move(figures)},
                {"warnings", character_.warnings},
                {"layout", std::move(layout)}};
    for (std::size_t side = 0; side < 2; ++side) out["ankles"].push_back(body_.legs.side[side].foot);
    return out.dump();
}

void Stage::set_course(const std::string& name, float grade_deg) {
    course_ = make_course(name, grade_deg, false, name == "rubble" ? k_shown_rubble : k_shown);
    grade_ = grade_deg;
    put_on_course();
}

void Stage::put_on_course() {
    Walker& walker = guest_ ? *guest_ : *walker_;
    placed_ = std::make_unique<PlacedWalker>(walker, *course_.ground, placement());
    restart();
}

FootSettings Stage::placement() const noexcept {
    FootSettings settings;
    settings.mode = guest_ ? FootMode::none : mode_;
    return settings;
}

bool Stage::play(Motion cycle, const StageBody& body, float rise) {
    if (cycle_) {
        cycle_->change(std::move(cycle), body.legs);
        tilt_floor(rise);
        const bool changed = wear(body);
        if (changed) placed_ = std::make_unique<PlacedWalker>(*guest_, *course_.ground, placement());
        placed_->take_up();
        rolling_.clear();
        write_frame();
        return changed;
    }
    auto guest = std::make_shared<CycleWalker>(std::move(cycle), body.legs);
    CycleWalker* const walker = guest.get();
    const bool changed = wear(body);
    put_on_stage(std::move(guest), nullptr);
    cycle_ = walker;
    course_.ground = floor_;
    floor_->tilt(0, {});
    tilt_floor(rise);
    put_on_course();
    return changed;
}

/// The ground goes on under who is on it.
void Stage::tilt_floor(float rise) {
    if (rise == floor_->rise()) return;
    floor_->tilt(rise, placed_->root().position);
    course_.mesh = floor_->mesh(k_shown);
}

void Stage::play(std::shared_ptr<Walker> guest, std::function<LocomotionRequest()> asks) {
    wear(body_of(character_));
    put_on_stage(std::move(guest), std::move(asks));
}

void Stage::put_on_stage(std::shared_ptr<Walker> guest, std::function<LocomotionRequest()> asks) {
    const std::shared_ptr<Walker> gone = std::exchange(guest_, std::move(guest));
    asks_ = std::move(asks);
    cycle_ = nullptr;
    set_course("flat", grade_);
}

bool Stage::stop_playing() {
    if (!guest_) return false;
    const std::shared_ptr<Walker> gone = std::move(guest_);
    asks_ = nullptr;
    cycle_ = nullptr;
    const bool changed = wear(body_of(character_));
    if (course_.ground == floor_)
        set_course("flat", grade_);
    else
        put_on_course();
    return changed;
}

/// A guest that nobody turns around comes to the end of what is shown of its ground.
bool Stage::is_off_course() const noexcept {
    const Vec3 at = placed_->root().position;
    return at.x < k_shown.x0 + k_margin || at.x > k_shown.x1 - k_margin || at.z < k_shown.z0 + k_margin ||
           at.z > k_shown.z1 - k_margin;
}

void Stage::set_mode(FootMode mode) noexcept {
    if (mode == mode_) return;
    mode_ = mode;
    if (!guest_) placed_->set_mode(mode);
}

void Stage::steer(float speed, float lateral, float turn) noexcept {
    patrols_ = false;
    asked_ = {};
    asked_.speed = speed;
    asked_.lateral = lateral;
    asked_.turn = turn;
}

void Stage::patrol(float speed) noexcept {
    patrols_ = true;
    patrol_speed_ = speed;
}

void Stage::restart() {
    patrol_ = Patrol(course_.length);
    time_ = 0;
    speed_ = patrols_ ? patrol_speed_ : asked_.speed;
    turn_ = 0;
    placed_->start(speed_);
    begin();
}

void Stage::go_on_from(const Stage& before) {
    mode_ = before.mode_;
    patrols_ = before.patrols_;
    patrol_speed_ = before.patrol_speed_;
    set_course(before.course_.name, before.grade_);
    if (before.guest_) return;  // it went its own way
    patrol_ = before.patrol_;
    time_ = before.time_;
    speed_ = before.speed_;
    placed_->start(speed_);
    walker_->put(before.placed_->root());
    placed_->take_up();
    begin();
}

/// Figures from here on.
void Stage::begin() {
    rolling_.clear();
    parts_done_ = 0;
    rolling_.add(*placed_, body_.legs);
    write_frame();
}

void Stage::advance(int frames, int parts) {
    const float dt = 1 / (k_walk_fps * static_cast<float>(parts));
    for (int f = 0; f < frames; ++f) {
        if (guest_ && is_off_course()) restart();
        const RootFrame before = placed_->root();
        if (asks_) guest_->steer(asks_());
        walker_->steer(patrols_ ? patrol_.ask(before, patrol_speed_) : asked_);
        placed_->advance(dt);
        const RootFrame step = between(before, placed_->root());
        speed_ = planar_length(step.position) / dt;
        turn_ = step.yaw / dt / k_radians_per_degree;
        time_ += static_cast<double>(dt);
        // Figures are for frames of 1/60 s, whatever time is shown in between, and of one mode.
        if (placed_->changes_mode()) rolling_.clear();
        if (++parts_done_ >= parts) {
            rolling_.add(*placed_, body_.legs);
            parts_done_ = 0;
        }
    }
    write_frame();
}

std::string Stage::metrics() const {
    WalkInfo info;
    info.course = course_.name;
    info.grade_deg = grade_;
    info.speed_mps = speed_;
    const std::optional<MeasuredWalk> measured = rolling_.measure(*course_.ground, info, mode_);
    if (!measured) return "null";
    Json out = Json::array();
    for (const WalkFigure& figure : walk_figures())
        out.push_back({{"text", figure.text(*measured)},
                       {"value", number(figure.value(*measured))},
                       {"missed", figure.missed(*measured)}});
    return out.dump();
}

void Stage::write_frame() {
    const RootFrame root = placed_->root();
    frame_[k_time] = static_cast<float>(time_);
    put(frame_, k_root, root.position);
    frame_[k_root + 3] = root.yaw;
    frame_[k_speed] = speed_;
    frame_[k_turn] = turn_;
    frame_[k_speed_limit] = placed_->speed_limit() < k_no_speed_limit ? placed_->speed_limit() : 0;

    local_to_model(*body_.skeleton, placed_->locals(), models_);
    const Transform world = to_transform(root);
    for (Transform& joint : models_) joint = world * joint;
    for (std::size_t j = 0; j < models_.size(); ++j) put(frame_, k_joints + 16 * j, models_[j]);
    write_ghosts(world);
    const TrackFrame now = track_frame(root, models_, body_.legs);
    frame_[k_hips] = now.hips.y - root.position.y;

    frame_[k_phase] = cycle_ ? static_cast<float>(cycle_->share()) : 0;

    std::vector<Transform> flat(placed_->unplaced().begin(), placed_->unplaced().end());
    const TrackFrame twin = track_frame({}, flat, body_.legs);
    for (std::size_t side = 0; side < 2; ++side) {
        const std::span<float> foot = std::span(frame_).subspan(k_feet + side * k_foot_floats, k_foot_floats);
        const LegTrack& leg = now.legs[side];
        foot[k_contact] = static_cast<float>(contact_of(twin.legs[side], cycle_ ? floor_->rise() : 0));
        foot[k_planted] = placed_->feet().planted[side] ? 1 : 0;
        foot[k_pulled_in] = placed_->feet().pulled_in[side] ? 1 : 0;
        float clearance = std::numeric_limits<float>::max();
        for (std::size_t p = 0; p < k_sole_points; ++p) {
            const Vec3 point = leg.sole[p];
            put(foot, k_sole + 3 * p, point);
            clearance = std::min(clearance, point.y - height_at(*course_.ground, point.x, point.z));
        }
        foot[k_clearance] = clearance;
        foot[k_knee] = static_cast<float>(knee_angle(leg));
        const FootState& state = placed_->state().feet[side];
        foot[k_has_next] = state.has_next ? 1 : 0;
        put(foot, k_next, state.next.foothold);
        put(foot, k_next_normal, rotate(state.next.tilt, k_up));
        foot[k_next_yaw] = root.yaw;
        put(foot, k_hip, leg.hip);
        put(foot, k_ankle, leg.ankle);
    }
}

/// Each clip alone, at the time at which it plays in the blend, where the character is.
void Stage::write_ghosts(const Transform& root) {
    const std::size_t joints = models_.size(), size = k_ghost_joints + 16 * joints;
    const std::span<float> ghosts = std::span(frame_).subspan(k_joints + 16 * joints);
    std::fill(ghosts.begin(), ghosts.end(), 0.0f);
    if (guest_) return;  // they are not of the stage's clips
    std::vector<Leaf> leaves(walker_->playing().begin(), walker_->playing().end());
    std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.weight > b.weight; });
    std::vector<Transform> locals(joints), models(joints);
    for (std::size_t g = 0; g < k_most_ghosts; ++g) {
        const std::span<float> ghost = ghosts.subspan(g * size, size);
        if (g >= leaves.size() || leaves[g].weight <= k_least_ghost) break;
        ghost[k_ghost_weight] = leaves[g].weight;
        ghost[k_ghost_clip] = static_cast<float>(leaves[g].clip);
        const Leaf alone{leaves[g].clip, leaves[g].time, 1};
        sample_pose(*character_.skeleton, character_.graph.clips, {&alone, 1}, locals);
        local_to_model(*character_.skeleton, locals, models);
        for (std::size_t j = 0; j < joints; ++j) put(ghost, k_ghost_joints + 16 * j, root * models[j]);
    }
}

const LocomotionSpace& Stage::space_named(const std::string& name) const {
    const LocomotionGraph& graph = character_.graph;
    const LocomotionSpace* space = name == "facing" ? &graph.facing : name == "lateral" ? &graph.lateral : nullptr;
    for (const LocomotionStyle& style : graph.styles)
        if (name == std::string(k_style_prefix) + style.name) space = &style.space;
    if (!space || space->empty()) throw Error("there is no such blend space", name, "");
    return *space;
}

void Stage::steer_to(const std::string& name, std::span<const float> at) {
    const LocomotionSpace& space = space_named(name);
    std::vector<float> place(at.begin(), at.end());
    place.resize(space.space.axes.size());
    patrols_ = false;
    asked_ = request_at(space, place);
    for (std::size_t s = 0; s < character_.graph.styles.size(); ++s)
        if (&character_.graph.styles[s].space == &space) {
            asked_.style = static_cast<std::int32_t>(s);
            asked_.style_weight = 1;
        }
}

std::string Stage::weights(const std::string& name, std::span<const float> at) const {
    const LocomotionSpace& space = space_named(name);
    SpacePoint point{};
    for (std::size_t d = 0; d < std::min(at.size(), space.space.axes.size()); ++d) point[d] = at[d];
    const BlendWeights found = blend_weights(space.space, point);
    std::vector<std::pair<float, std::int32_t>> order;
    for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k)
        order.push_back({-found.weights[k], found.samples[k]});
    std::sort(order.begin(), order.end());
    Json out = Json::array();
    for (const auto& [negative, sample] : order) {
        const std::int32_t clip = space.clips[static_cast<std::size_t>(sample)];
        out.push_back({{"clip", character_.graph.clips[static_cast<std::size_t>(clip)].name}, {"weight", -negative}});
    }
    return out.dump();
}

}  // namespace surefoot::wasm
