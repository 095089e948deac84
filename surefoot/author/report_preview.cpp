// The data of the page's preview (report_blend.js reads it): the joints that a figure needs, every clip's rotations as
// 16-bit integers, and the spaces with what their samples declare.

#include <surefoot/author/base64.h>
#include <surefoot/author/json_node.h>
#include <surefoot/author/report_parts.h>
#include <surefoot/clip/sample.h>
#include <surefoot/graph/locomotion.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double k_most_rate = 40;      // [1/s] poses between are interpolated: off by a few millimetres at most
constexpr double k_most_bytes = 600e3;  // of poses in a page, before base64; many clips share them with fewer frames
constexpr double k_translation_unit = 1e-4;  // [m], and [s] of ages: a tenth of a millimetre, up to 3.2 m

/// Millimetres and less: what a preview needs, in few characters.
Json short_number(double value) { return std::round(value * 1e5) / 1e5; }
Json to_json(Vec3 v) { return Json::array({short_number(v.x), short_number(v.y), short_number(v.z)}); }

std::string base64_of(const std::vector<std::int16_t>& numbers) {
    std::vector<std::uint8_t> bytes;  // little-endian on every machine
    for (const std::int16_t number : numbers) {
        bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint16_t>(number) & 0xffu));
        bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint16_t>(number) >> 8u));
    }
    return base64(bytes);
}

std::int16_t to_int16(double value) {
    return static_cast<std::int16_t>(std::lround(std::min(std::max(value, -32767.0), 32767.0)));
}

/// The joints that carry the figure, parents before children: those of the body's roles and all above them.
struct Body {
    std::vector<int> joints;  // of the skeleton
    std::vector<int> index;   // of each joint of the skeleton: among `joints`, or -1

    Body(const Skeleton& skeleton, const RoleMap& roles) : index(static_cast<std::size_t>(skeleton.joint_count()), -1) {
        std::vector<bool> needed(index.size());
        for (int r = 0; r < static_cast<int>(Role::left_thumb_metacarpal); ++r) {
            const auto role = static_cast<Role>(r);
            if (role == Role::jaw || role == Role::left_eye || role == Role::right_eye) continue;
            for (int j = roles[role]; j >= 0; j = skeleton.parents[static_cast<std::size_t>(j)])
                needed[static_cast<std::size_t>(j)] = true;
        }
        for (int j = 0; j < skeleton.joint_count(); ++j) {
            if (!needed[static_cast<std::size_t>(j)]) continue;
            index[static_cast<std::size_t>(j)] = static_cast<int>(joints.size());
            joints.push_back(j);
        }
    }
};

/// Points beside the joints (heels, balls, toe tips, crown) and the bones between points.
class Figure {
  public:
    Figure(const ClipFigures& figures, const Body& body) : figures_(figures), body_(body) {
        parts();
        Json names = Json::array(), parents = Json::array(), rest = Json::array();
        const Skeleton& skeleton = *figures.skeleton;
        for (const int j : body.joints) {
            const int parent = skeleton.parents[static_cast<std::size_t>(j)];
            names.push_back(skeleton.names[static_cast<std::size_t>(j)]);
            parents.push_back(parent < 0 ? -1 : body.index[static_cast<std::size_t>(parent)]);
            rest.push_back(to_json(skeleton.rest[static_cast<std::size_t>(j)].translation));
        }
        json_["joints"] = std::move(names);
        json_["parents"] = std::move(parents);
        json_["rest"] = std::move(rest);
        json_["height_m"] = short_number(figures.height);
        json_["ends"] = std::move(ends_);
        json_["bones"] = std::move(bones_);
        json_["feet"] = std::move(feet_);
        json_["legs"] = legs();
    }
    Json take() { return std::move(json_); }

  private:
    int at(Role role) const { return of_joint(figures_.roles[role]); }
    int of_joint(int joint) const { return joint < 0 ? -1 : body_.index[static_cast<std::size_t>(joint)]; }
    int end(int joint, Vec3 offset) {
        ends_.push_back({{"joint", of_joint(joint)}, {"offset", to_json(offset)}});
        return static_cast<int>(body_.joints.size() + ends_.size()) - 1;
    }
    void bone(int a, int b, double width_of_height, const char* side = "body") {
        if (a < 0 || b < 0) return;
        bones_.push_back(
            {{"a", a}, {"b", b}, {"width_m", short_number(width_of_height * figures_.height)}, {"side", side}});
    }
    /// Straight up in the head's frame, as the head is held at rest.
    Vec3 upright() const {
        std::vector<Transform> models(figures_.skeleton->rest.size());
        local_to_model(*figures_.skeleton, figures_.skeleton->rest, models);
        return rotate(conjugate(models[static_cast<std::size_t>(figures_.roles[Role::head])].rotation), {0, 1, 0});
    }
    /// Bones through those of the points that exist.
    void chain(std::initializer_list<int> points, double width, const char* side = "body") {
        int last = -1;
        for (const int point : points) {
            if (point < 0) continue;
            bone(last, point, width, side);
            last = point;
        }
    }

    /// Widths in shares of the stature, as on a jointed doll.
    void parts() {
        const int neck = at(Role::neck), head = at(Role::head);
        const int chest = at(Role::upper_chest) >= 0 ? at(Role::upper_chest)
                          : at(Role::chest) >= 0     ? at(Role::chest)
                                                     : at(Role::spine);
        chain({at(Role::hips), at(Role::spine), at(Role::chest), at(Role::upper_chest), neck >= 0 ? neck : head},
              0.085);
        if (head >= 0) {
            const Vec3 up = figures_.skeleton->tips[static_cast<std::size_t>(figures_.roles[Role::head])];
            const float least = 0.03f * figures_.height, most = 0.09f * figures_.height;
            const bool known = length(up) > least && length(up) < most;
            bone(head, end(figures_.roles[Role::head], known ? up : upright() * (0.06f * figures_.height)), 0.1);
        }
        const Role arms[2][4] = {
            {Role::left_shoulder, Role::left_upper_arm, Role::left_lower_arm, Role::left_hand},
            {Role::right_shoulder, Role::right_upper_arm, Role::right_lower_arm, Role::right_hand}};
        for (std::size_t side = 0; side < 2; ++side) {
            const char* name = side == 0 ? "left" : "right";
            chain({chest, at(arms[side][0]), at(arms[side][1])}, 0.045);
            chain({at(arms[side][1]), at(arms[side][2]), at(arms[side][3])}, 0.036);
            const Leg& leg = figures_.legs.side[side];
            bone(at(Role::hips), of_joint(leg.upper), 0.06);
            bone(of_joint(leg.upper), of_joint(leg.lower), 0.058, name);
            bone(of_joint(leg.lower), of_joint(leg.foot), 0.044, name);
            const int heel = end(leg.foot, leg.heel), ball = end(leg.foot, leg.ball);
            const int tip = end(leg.toes == k_no_joint ? leg.foot : leg.toes, leg.toe_tip);
            chain({of_joint(leg.foot), heel, ball, tip}, 0.026, name);
            bone(of_joint(leg.foot), ball, 0.026, name);
            feet_[name] = {{"heel", heel}, {"toe", tip}};
        }
    }

    /// What it takes to solve the legs for a blended foot (graph/foot_blend.h); null where they are not known.
    Json legs() const {
        const LegPaths paths = make_leg_paths(*figures_.skeleton, figures_.legs, figures_.standing);
        if (!figures_.legs.known() || paths.count == 0) return nullptr;
        Json json;
        for (std::size_t side = 0; side < 2; ++side) {
            const LegPaths::Side& leg = paths.side[side];
            const auto joint = [&](int slot) { return of_joint(paths.joint[static_cast<std::size_t>(slot)]); };
            json[side == 0 ? "left" : "right"] = {{"upper", joint(leg.upper)},
                                                  {"lower", joint(leg.lower)},
                                                  {"foot", joint(leg.foot)},
                                                  {"toes", of_joint(leg.toes)},
                                                  {"knee_forward", to_json(leg.knee_forward)},
                                                  {"heel", to_json(leg.heel)},
                                                  {"ball", to_json(leg.ball)}};
        }
        return json;
    }

    const ClipFigures& figures_;
    const Body& body_;
    Json json_, ends_ = Json::array(), bones_ = Json::array(), feet_;
};

/// The footprints of a side, every frame of them: rotation, translation, toes, age.
Json to_json(const FootPrints& prints) {
    std::vector<std::int16_t> keys;
    const auto add = [&](std::initializer_list<float> values, double unit) {
        for (const float value : values) keys.push_back(to_int16(value / unit));
    };
    for (const FootKey& key : prints.keys) {
        const Quat q = key.print.rotation, toes = key.toes;
        const Vec3 at = key.print.translation;
        add({q.x, q.y, q.z, q.w}, 1 / 32767.0);
        add({at.x, at.y, at.z}, k_translation_unit);
        add({toes.x, toes.y, toes.z, toes.w}, 1 / 32767.0);
        add({key.age}, k_translation_unit);
    }
    Json steps = Json::array();
    for (const FootStep& step : prints.steps)
        steps.push_back({{"lift", short_number(step.lift)}, {"duration_s", short_number(step.duration)}});
    return {{"keys", base64_of(keys)}, {"steps", std::move(steps)}};
}

int frames_of(const PackedClip& clip, double rate) {
    const int wanted = static_cast<int>(std::lround(clip.duration() * std::min(rate, static_cast<double>(clip.fps))));
    return std::clamp(wanted + 1, 2, clip.frame_count);
}

Json to_json(const PackedClip& clip, const Skeleton& skeleton, const Body& body, double rate) {
    const int frames = frames_of(clip, rate);
    Json moving = Json::array(), turning = Json::array(), map = Json::array();
    std::vector<int> moving_joints;
    for (const std::int16_t j : clip.moving)
        if (const int at = body.index[static_cast<std::size_t>(j)]; at >= 0) {
            moving.push_back(at);
            moving_joints.push_back(j);
        }
    for (std::size_t k = 0; k < body.joints.size() && !clip.turning_blocks.empty(); ++k)
        if (clip.turning_blocks[static_cast<std::size_t>(body.joints[k] / k_lanes)] != 0) turning.push_back(k);
    for (const auto& [share, phase] : clip.phase_map) map.push_back({short_number(share), short_number(phase)});

    std::vector<std::int16_t> rotations, translations;
    std::vector<Transform> locals(skeleton.rest.size());
    for (int f = 0; f < frames; ++f) {
        const Leaf leaf{0, clip.duration() * static_cast<float>(f) / static_cast<float>(frames - 1), 1};
        sample_pose(skeleton, {&clip, 1}, {&leaf, 1}, locals);
        for (const int j : body.joints) {
            const Quat q = locals[static_cast<std::size_t>(j)].rotation;
            for (const float part : {q.x, q.y, q.z, q.w}) rotations.push_back(to_int16(part * 32767.0));
        }
        for (const int j : moving_joints) {
            const Vec3 v = locals[static_cast<std::size_t>(j)].translation;
            for (const float part : {v.x, v.y, v.z}) translations.push_back(to_int16(part / k_translation_unit));
        }
    }
    Json json;
    json["name"] = clip.name;
    json["cyclic"] = clip.cyclic;
    json["seconds"] = clip.duration();
    json["frames"] = frames;
    json["cycles"] = clip.cycles;
    json["velocity"] = to_json(clip.velocity);
    json["turn_rate"] = short_number(clip.turn_rate);
    json["phase_map"] = std::move(map);
    json["moving"] = std::move(moving);
    json["turning"] = std::move(turning);
    if (!clip.feet[0].keys.empty()) json["feet"] = {{"left", to_json(clip.feet[0])}, {"right", to_json(clip.feet[1])}};
    json["rotations"] = base64_of(rotations);
    json["translations"] = base64_of(translations);
    return json;
}

/// Poses a second that keep the page moderate.
double rate_for(const std::vector<const PackedClip*>& clips, std::size_t joints) {
    double bytes = 0;  // a pose a second
    for (const PackedClip* clip : clips)
        bytes += clip->duration() * static_cast<double>(8 * joints + 6 * std::min(clip->moving.size(), joints));
    return bytes > 0 ? std::min(k_most_rate, k_most_bytes / bytes) : k_most_rate;
}

/// Where the puck lies at first: well inside what the clips cover, where something moves.
Json start_of(const BlendSpace& space) {
    Json start = Json::array();
    for (int d = 0; d < space.dimensions(); ++d) {
        float most = 0;
        for (const SpacePoint& sample : space.samples) most = std::max(most, sample[static_cast<std::size_t>(d)]);
        start.push_back(short_number(most * (d == 0 ? 0.5f : 0.25f)));
    }
    return start;
}

Json to_json(const ProjectSpace& space, const std::vector<int>& slots, const ClipFigures& figures) {
    // What a sample declares about the root is the graph's rule; it asks the clips only for their velocities.
    std::vector<PackedClip> moves(figures.clips.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
        moves[i].velocity = figures.clips[i].packed.velocity;
        moves[i].turn_rate = figures.clips[i].packed.turn_rate;
    }
    SpaceDefinition definition{space.space, {space.clips.begin(), space.clips.end()}};
    const LocomotionSpace joined =
        make_locomotion_graph(figures.skeleton, std::move(moves), std::move(definition), {}).facing;

    Json json;
    json["name"] = space.name;
    for (const Axis& axis : space.space.axes)
        json["axes"].push_back({{"name", axis.name},
                                {"unit", axis.unit},
                                {"low", short_number(axis.low)},
                                {"high", short_number(axis.high)},
                                {"wraps", axis.wraps}});
    json["start"] = start_of(space.space);
    for (std::size_t i = 0; i < space.space.samples.size(); ++i) {  // copies of wrapping axes included
        const auto own = static_cast<std::size_t>(space.space.original(static_cast<std::int32_t>(i)));
        Json place = Json::array();
        for (int d = 0; d < space.space.dimensions(); ++d)
            place.push_back(short_number(space.space.samples[i][static_cast<std::size_t>(d)]));
        json["samples"].push_back(std::move(place));
        json["clips"].push_back(slots[static_cast<std::size_t>(space.clips[own])]);
        json["velocities"].push_back(to_json(joined.velocities[own]));
        json["turns"].push_back(short_number(joined.turns[own]));
    }
    json["simplices"] = Json::array();
    for (const Simplex& simplex : space.space.simplices) {
        Json corners = Json::array();
        for (const std::int32_t sample : simplex)
            if (sample >= 0) corners.push_back(sample);
        json["simplices"].push_back(std::move(corners));
    }
    return json;
}

}  // namespace

std::string preview_json(const Project& project, const ClipFigures& figures) {
    if (!figures.skeleton || figures.clips.size() != project.clips.size() || !figures.roles.has_legs()) return {};
    const Body body(*figures.skeleton, figures.roles);
    std::vector<int> slots(project.clips.size(), -1);
    std::vector<const PackedClip*> clips;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (project.clips[i].excluded || figures.clips[i].packed.frame_count < 2) continue;
        slots[i] = static_cast<int>(clips.size());
        clips.push_back(&figures.clips[i].packed);
    }
    Json json;
    json["spaces"] = Json::array();
    for (std::size_t s = 0; s < project.spaces.size(); ++s) {
        const ProjectSpace& space = project.spaces[s];
        if (std::any_of(space.clips.begin(), space.clips.end(),
                        [&](int clip) { return slots[static_cast<std::size_t>(clip)] < 0; }))
            continue;  // a clip that cannot be played leaves a hole
        json["spaces"].push_back(to_json(space, slots, figures));
        json["spaces"].back()["index"] = s;
    }
    if (json["spaces"].empty()) return {};
    json["body"] = Figure(figures, body).take();
    const double rate = rate_for(clips, body.joints.size());
    json["clips"] = Json::array();
    for (const PackedClip* clip : clips) json["clips"].push_back(to_json(*clip, *figures.skeleton, body, rate));

    std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace), safe;
    for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;  // "</script>" in a name ends nothing
    return safe;
}

}  // namespace surefoot
