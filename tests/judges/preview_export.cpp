// What the runtime does with a project, for preview.mjs to hold the report's page against.
//
//     preview_export FOLDER [CLIPS...]     authors the default set, or CLIPS, into FOLDER; writes FOLDER/runtime.json
//     preview_export FOLDER wrong          the same with one joint of one moment put 3 cm away
//     preview_export FOLDER sliced         the default set in one space of three dimensions
//     preview_export FOLDER sliced-wrong   the same with one corner of one slice moved
//
// runtime.json: [{"space": 0, "at": [..], "dt", "moments": [{"steps", "weights": {clip: w}, "phase_rate", "root": [x,
// z, yaw], "joints": {name: [x, y, z]}}]}], joints seen from the root, metres.
// slices.json: [{"space", "at", "right", "up", "polygons": [[[right, up], ..], ..]}], what the plane along two axes
// cuts.
#include <surefoot/author/author.h>
#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/motion/motion.h>
#include <surefoot/preset/default_set.h>
#include <surefoot/space/slice.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using Json = nlohmann::ordered_json;

constexpr float k_dt = 1.0f / 60;
constexpr int k_steps = 90, k_every = 15;

LocomotionRequest request_at(const BlendSpace& space, const SpacePoint& point) {
    LocomotionRequest request;
    for (std::size_t d = 0; d < space.axes.size(); ++d) {
        const std::string& name = space.axes[d].name;
        if (name == "speed" || name == "forward") request.speed = point[d];
        if (name == "turn") request.turn = point[d];
        if (name == "lateral") request.lateral = point[d];
    }
    return request;
}

Json moment(const Character& character, const LocomotionGraph& graph, const LocomotionFrame& frame,
            const RootFrame& root, int steps) {
    Json json{{"steps", steps}, {"phase_rate", frame.phase_rate}};
    for (const Leaf& leaf : frame.leaves())
        json["weights"][graph.clips[static_cast<std::size_t>(leaf.clip)].name] = leaf.weight;
    json["root"] = {root.position.x, root.position.z, root.yaw};
    std::vector<Transform> locals(character.skeleton->rest.size()), models(locals.size());
    pose(graph, frame, locals);
    local_to_model(*character.skeleton, locals, models);
    for (std::size_t j = 0; j < models.size(); ++j) {
        const Vec3 at = models[j].translation;
        json["joints"][character.skeleton->names[j]] = {at.x, at.y, at.z};
    }
    return json;
}

/// One space alone, as the page plays it: the runtime would mix a space of sideways clips with the other.
Json play(const Character& character, const LocomotionSpace& space, std::size_t index, const SpacePoint& at) {
    LocomotionGraph graph = character.graph;
    const bool sideways = &space == &character.graph.lateral;
    (sideways ? graph.facing : graph.lateral) = {};
    const LocomotionRequest request = request_at(space.space, at);
    LocomotionState state;
    RootFrame root;
    Json json{{"space", index}, {"at", Json::array()}, {"dt", k_dt}, {"moments", Json::array()}};
    for (int d = 0; d < space.space.dimensions(); ++d) json["at"].push_back(at[static_cast<std::size_t>(d)]);
    for (int step = 1; step <= k_steps; ++step) {
        const LocomotionFrame frame = update(graph, state, request, k_dt);
        root = root * frame.root_delta;
        if (step % k_every == 0) json["moments"].push_back(moment(character, graph, frame, root, step));
    }
    return json;
}

/// Points inside and outside the hull, on samples and between them.
std::vector<SpacePoint> points_of(const BlendSpace& space) {
    std::vector<SpacePoint> points;
    for (const Simplex& simplex : space.simplices) {
        SpacePoint middle{};
        float corners = 0, weight = 1;
        for (const std::int32_t sample : simplex) {
            if (sample < 0) continue;
            for (std::size_t d = 0; d < middle.size(); ++d)
                middle[d] += weight * space.samples[static_cast<std::size_t>(sample)][d];
            corners += weight;
            weight += 1;
        }
        for (float& v : middle) v /= corners;
        if (points.size() < 8) points.push_back(middle);
    }
    points.push_back(space.samples.front());
    SpacePoint outside{};
    for (std::size_t d = 0; d < space.axes.size(); ++d) outside[d] = space.axes[d].high;
    points.push_back(outside);
    return points;
}

/// What every plane along two axes cuts out of a space, near each of its points_of. A plane through samples meets
/// simplices along whole faces, and whose those are is decided by the last digit: none such.
void add_slices(const BlendSpace& space, std::size_t index, Json& json) {
    for (SpacePoint at : points_of(space)) {
        for (std::size_t d = 0; d < space.axes.size(); ++d)
            at[d] += 0.0137f * static_cast<float>(d + 1) * (space.axes[d].high - space.axes[d].low);
        for (int right = 0; right < space.dimensions(); ++right)
            for (int up = 0; up < right; ++up) {
                Json polygons = Json::array();
                for (const SliceCell& cell : slice(space, at, right, up).cells) polygons.push_back(cell.polygon);
                Json values = Json::array();
                for (int d = 0; d < space.dimensions(); ++d) values.push_back(at[static_cast<std::size_t>(d)]);
                json.push_back(
                    {{"space", index}, {"at", values}, {"right", right}, {"up", up}, {"polygons", polygons}});
            }
    }
}

int run(const std::string& folder, std::vector<std::string> clips) {
    const std::string mode = clips.size() == 1 ? clips[0] : "";
    const bool wrong = mode == "wrong", sliced = mode == "sliced" || mode == "sliced-wrong";
    AuthorOptions options;
    if (sliced) options.axes = {"speed,turn,lateral"};
    const AuthorResult authored = wrong || sliced || clips.empty()
                                      ? author_motions(make_default_set().clips, folder, options)
                                      : author_clips(clips, folder);
    const Character character = bake_character(authored.project, folder);
    Json json = Json::array(), slices = Json::array();
    for (std::size_t s = 0; s < authored.project.spaces.size(); ++s) {
        const bool sideways = authored.project.spaces[s].name == "lateral";
        const LocomotionSpace& space = sideways ? character.graph.lateral : character.graph.facing;
        for (const SpacePoint& at : points_of(space.space)) json.push_back(play(character, space, s, at));
        add_slices(space.space, s, slices);
    }
    if (mode == "sliced-wrong") {
        Json& corner = slices[0]["polygons"][0][0][0];
        corner = corner.get<double>() + 10;
    }
    write_file(std::filesystem::path(folder) / "slices.json", slices.dump());
    if (wrong) {
        Json& height = json[2]["moments"][3]["joints"].back()[1];
        height = height.get<double>() + 0.03;
    }
    write_file(std::filesystem::path(folder) / "runtime.json", json.dump());
    return 0;
}

}  // namespace
}  // namespace surefoot

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: preview_export FOLDER [CLIPS...]\n");
        return 2;
    }
    try {
        return surefoot::run(argv[1], {argv + 2, argv + argc});
    } catch (const surefoot::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
