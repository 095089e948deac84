#include <surefoot/author/gait_file.h>
#include <surefoot/author/json_node.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <memory>

namespace surefoot {
namespace {

constexpr int k_version = 1;
constexpr const char* k_sides[2] = {"left", "right"};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A series of `length` numbers at `offset` of the values, as the file calls it.
struct NamedSeries {
    std::string name;
    std::size_t offset, length;
};

std::vector<NamedSeries> series_of(const HarmonicGait& gait) {
    std::vector<NamedSeries> list;
    std::size_t offset = 0;
    const auto add = [&](const std::string& name, std::size_t length) {
        list.push_back({name, offset, length});
        offset += length;
    };
    const auto add_vector = [&](const std::string& name, const char* unit, int harmonics) {
        for (const char* axis : {"x", "y", "z"}) add(name + " " + axis + unit, at(1 + 2 * harmonics));
    };
    for (const std::string& joint : gait.skeleton->names) add_vector("rotation " + joint, "_rad", gait.harmonics);
    for (const std::int16_t joint : gait.moving)
        add_vector("translation " + gait.skeleton->names[at(joint)], "_m", gait.harmonics);
    for (const char* side : k_sides) {
        add_vector(std::string("foot ") + side + " rotation", "_rad", gait.foot_harmonics);
        add_vector(std::string("foot ") + side + " heel", "_m", gait.foot_harmonics);
        add_vector(std::string("foot ") + side + " ball", "_m", gait.foot_harmonics);
        add_vector(std::string("foot ") + side + " toes", "_rad", gait.foot_harmonics);
    }
    for (const char* name : {"velocity x_mps", "velocity y_mps", "velocity z_mps", "turn_rad_s", "frequency_hz",
                             "right strike_share", "left lift_share", "right lift_share"})
        add(std::string("rhythm ") + name, 1);
    return list;
}

Json to_json(Vec3 v) { return Json::array({short_number(v.x), short_number(v.y), short_number(v.z)}); }
Json to_json(Quat q) {
    return Json::array({short_number(q.x), short_number(q.y), short_number(q.z), short_number(q.w)});
}
Vec3 vector_from(const JsonNode& node) {
    const std::vector<float> v = node.reals();
    if (v.size() != 3) node.fail("expected three numbers");
    return {v[0], v[1], v[2]};
}
Quat rotation_from(const JsonNode& node) {
    const std::vector<float> v = node.reals();
    if (v.size() != 4) node.fail("expected four numbers");
    return {v[0], v[1], v[2], v[3]};
}

Json joints_json(const HarmonicGait& gait) {
    const Skeleton& skeleton = *gait.skeleton;
    Json joints = Json::array();
    for (std::size_t j = 0; j < skeleton.names.size(); ++j)
        joints.push_back({{"name", skeleton.names[j]},
                          {"parent", skeleton.parents[j]},
                          {"offset_m", to_json(skeleton.rest[j].translation)},
                          {"rest", to_json(skeleton.rest[j].rotation)},
                          {"tip_m", to_json(skeleton.tips[j])},
                          {"mean", to_json(gait.mean[j])}});
    return joints;
}

void read_joints(HarmonicGait& gait, JsonNode node) {
    Skeleton skeleton;
    for (JsonNode joint : node.items()) {
        const int parent = joint.at("parent").integer(-1, k_max_joints);
        skeleton.add(joint.at("name").text(), parent,
                     {rotation_from(joint.at("rest")), vector_from(joint.at("offset_m"))},
                     vector_from(joint.at("tip_m")));
        gait.mean.push_back(rotation_from(joint.at("mean")));
    }
    if (const std::string text = problem(skeleton); !text.empty()) node.fail(text);
    gait.skeleton = std::make_shared<const Skeleton>(std::move(skeleton));
}

Json legs_json(const HarmonicGait& gait) {
    Json legs;
    legs["hips"] = gait.soles.hips;
    for (std::size_t side = 0; side < 2; ++side) {
        const Leg& leg = gait.soles.side[side];
        legs[k_sides[side]] = {{"joints", {leg.upper, leg.lower, leg.foot, leg.toes}},
                               {"lengths_m", {short_number(leg.upper_length), short_number(leg.lower_length)}},
                               {"heel_m", to_json(leg.heel)},
                               {"mid_m", to_json(leg.mid)},
                               {"ball_m", to_json(leg.ball)},
                               {"toe_tip_m", to_json(leg.toe_tip)},
                               {"up", to_json(leg.up)},
                               {"forward", to_json(leg.forward)},
                               {"knee_forward", to_json(gait.legs.side[side].knee_forward)},
                               {"foot_mean", to_json(gait.foot_mean[side])},
                               {"toes_mean", to_json(gait.toes_mean[side])}};
    }
    return legs;
}

Leg leg_from(JsonNode node, int joints) {
    Leg leg;
    const std::vector<JsonNode> chain = node.at("joints").items();
    if (chain.size() != 4) node.at("joints").fail("expected thigh, shank, foot and toes");
    leg.upper = chain[0].integer(0, joints - 1);
    leg.lower = chain[1].integer(0, joints - 1);
    leg.foot = chain[2].integer(0, joints - 1);
    leg.toes = chain[3].integer(-1, joints - 1);
    const std::vector<float> lengths = node.at("lengths_m").reals();
    if (lengths.size() != 2) node.at("lengths_m").fail("expected two numbers");
    leg.upper_length = lengths[0], leg.lower_length = lengths[1];
    leg.heel = vector_from(node.at("heel_m"));
    leg.mid = vector_from(node.at("mid_m"));
    leg.ball = vector_from(node.at("ball_m"));
    leg.toe_tip = vector_from(node.at("toe_tip_m"));
    leg.up = vector_from(node.at("up"));
    leg.forward = vector_from(node.at("forward"));
    return leg;
}

void read_legs(HarmonicGait& gait, JsonNode node) {
    const Skeleton& skeleton = *gait.skeleton;
    gait.soles.hips = node.at("hips").integer(0, skeleton.joint_count() - 1);
    for (std::size_t side = 0; side < 2; ++side) {
        JsonNode of_side = node.at(k_sides[side]);
        const Leg& leg = gait.soles.side[side] = leg_from(of_side, skeleton.joint_count());
        if (!is_within(skeleton, leg.lower, leg.upper) || !is_within(skeleton, leg.foot, leg.lower) ||
            leg.lower == leg.upper || leg.foot == leg.lower)
            of_side.fail("thigh, shank and foot are no chain");
        gait.foot_mean[side] = rotation_from(of_side.at("foot_mean"));
        gait.toes_mean[side] = rotation_from(of_side.at("toes_mean"));
    }
    std::vector<Transform> models(skeleton.rest.size());
    local_to_model(skeleton, skeleton.rest, models);
    gait.legs = make_leg_paths(skeleton, gait.soles, models);
    for (std::size_t side = 0; side < 2; ++side)
        gait.legs.side[side].knee_forward = vector_from(node.at(k_sides[side]).at("knee_forward"));
}

Json basis_json(const GaitBasis& basis) {
    const auto pair = [](const std::array<float, 2>& v) {
        return Json::array({short_number(v[0]), short_number(v[1])});
    };
    return {{"modes", basis.modes},
            {"degree", basis.degree},
            {"travel_deg", short_number(basis.travel_deg)},
            {"climb", short_number(basis.climb)},
            {"speeds_mps", pair({basis.least_speed, basis.most_speed})},
            {"most_turn_deg_s", short_number(basis.most_turn)},
            {"walk_to_run_mps", pair({basis.walk_until, basis.run_from})},
            {"middle_speed_mps", pair(basis.middle_speed)},
            {"speed_unit_mps", pair(basis.speed_unit)},
            {"walked_mps", pair(basis.fitted_speeds[0])},
            {"run_mps", pair(basis.fitted_speeds[1])},
            {"fitted_turn_deg_s", pair(basis.fitted_turn)}};
}

GaitBasis basis_from(JsonNode node) {
    const auto pair = [&](const char* key) {
        const JsonNode of_key = node.at(key);
        const std::vector<float> v = of_key.reals();
        if (v.size() != 2) of_key.fail("expected two numbers");
        return std::array<float, 2>{v[0], v[1]};
    };
    GaitBasis basis;
    basis.modes = node.at("modes").integer(1, 2);
    basis.degree = node.at("degree").integer(0, 3);
    if (node.has("travel_deg")) basis.travel_deg = node.at("travel_deg").real();
    if (node.has("climb")) basis.climb = node.at("climb").real();
    const std::array<float, 2> speeds = pair("speeds_mps"), change = pair("walk_to_run_mps");
    basis.least_speed = speeds[0], basis.most_speed = speeds[1];
    basis.walk_until = change[0], basis.run_from = change[1];
    basis.most_turn = node.at("most_turn_deg_s").real();
    basis.middle_speed = pair("middle_speed_mps");
    basis.speed_unit = pair("speed_unit_mps");
    basis.fitted_speeds = {pair("walked_mps"), pair("run_mps")};
    basis.fitted_turn = pair("fitted_turn_deg_s");
    return basis;
}

/// "name": [[term 0's numbers], [term 1's], …]
std::string series_line(const HarmonicGait& gait, const NamedSeries& series) {
    const std::size_t values = at(value_count(gait));
    std::string line = "  " + Json(series.name).dump(-1, ' ', false, Json::error_handler_t::replace) + ": [";
    for (int t = 0; t < gait.basis.terms(); ++t) {
        line += t > 0 ? ", [" : "[";
        for (std::size_t i = 0; i < series.length; ++i)
            line += fmt::format("{}{}", i > 0 ? ", " : "", gait.coefficients[at(t) * values + series.offset + i]);
        line += "]";
    }
    return line + "]";
}

void read_series(HarmonicGait& gait, JsonNode node) {
    const std::size_t values = at(value_count(gait));
    const auto terms = at(gait.basis.terms());
    gait.coefficients.assign(terms * values, 0.0f);
    for (const NamedSeries& series : series_of(gait)) {
        const JsonNode of_series = node.at(series.name.c_str());
        const std::vector<JsonNode> rows = of_series.items();
        if (rows.size() != terms) of_series.fail(fmt::format("expected {} terms, found {}", terms, rows.size()));
        for (std::size_t t = 0; t < terms; ++t) {
            const std::vector<float> numbers = rows[t].reals();
            if (numbers.size() != series.length)
                rows[t].fail(fmt::format("expected {} numbers, found {}", series.length, numbers.size()));
            std::copy(numbers.begin(), numbers.end(),
                      gait.coefficients.begin() + static_cast<std::ptrdiff_t>(t * values + series.offset));
        }
    }
}

}  // namespace

std::string gait_to_json(const HarmonicGait& gait) {
    const auto text = [](const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); };
    Json cycles = Json::array();
    for (const auto& cycle : gait.cycles)
        cycles.push_back(Json::array({short_number(cycle[0]), short_number(cycle[1])}));
    std::string out = fmt::format("{{\n \"surefoot_gait\": {},\n \"name\": {},\n", k_version, text(gait.name));
    out += fmt::format(" \"harmonics\": {},\n \"foot_harmonics\": {},\n \"foot_lift\": {},\n", gait.harmonics,
                       gait.foot_harmonics, gait.foot_lift);
    if (gait.foot_hold > 0) out += fmt::format(" \"foot_hold\": {},\n", gait.foot_hold);
    out += " \"basis\": " + text(basis_json(gait.basis)) + ",\n \"fitted_mps_deg_s\": " + text(cycles) +
           ",\n \"joints\": [\n";
    const Json joints = joints_json(gait);
    for (std::size_t j = 0; j < joints.size(); ++j)
        out += "  " + text(joints[j]) + (j + 1 < joints.size() ? ",\n" : "\n");
    out += " ],\n \"legs\": " + text(legs_json(gait)) + ",\n \"moving\": " + text(Json(gait.moving)) +
           ",\n \"series\": {\n";
    const std::vector<NamedSeries> list = series_of(gait);
    for (std::size_t i = 0; i < list.size(); ++i)
        out += series_line(gait, list[i]) + (i + 1 < list.size() ? ",\n" : "\n");
    return out + " }\n}\n";
}

HarmonicGait gait_from_json(std::string_view text, const std::string& where) {
    Json parsed;
    try {
        parsed = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        throw Error(fmt::format("it is no JSON (byte {})", error.byte), where, "make the gait again: surefoot fit");
    } catch (const Json::exception&) {  // a number that no double holds
        throw Error("a number in it is too large", where, "make the gait again: surefoot fit");
    }
    JsonNode node(parsed, where, "", nullptr);
    if (!node.has("surefoot_gait")) node.fail("it is no fitted gait", "make one: surefoot fit CLIPS -o gait.json");
    node.at("surefoot_gait").integer(k_version, k_version);
    HarmonicGait gait;
    gait.name = node.at("name").text();
    gait.harmonics = node.at("harmonics").integer(1, k_most_harmonics);
    gait.foot_harmonics = node.at("foot_harmonics").integer(1, k_most_harmonics);
    gait.foot_lift = node.at("foot_lift").real();
    if (node.has("foot_hold")) gait.foot_hold = node.at("foot_hold").real();
    gait.basis = basis_from(node.at("basis"));
    for (const JsonNode& cycle : node.at("fitted_mps_deg_s").items()) {
        const std::vector<float> pair = cycle.reals();
        if (pair.size() != 2) cycle.fail("expected a speed and a turn");
        gait.cycles.push_back({pair[0], pair[1]});
    }
    read_joints(gait, node.at("joints"));
    read_legs(gait, node.at("legs"));
    for (const JsonNode& joint : node.at("moving").items())
        gait.moving.push_back(static_cast<std::int16_t>(joint.integer(0, gait.skeleton->joint_count() - 1)));
    read_series(gait, node.at("series"));
    if (const std::string found = problem(gait); !found.empty()) node.fail(found);
    return gait;
}

}  // namespace surefoot
