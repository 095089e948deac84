#include <surefoot/author/json_node.h>
#include <surefoot/author/probe_json.h>

#include <nlohmann/json.hpp>

namespace surefoot {
namespace {

constexpr int k_most_points = 1 << 20;

Json numbers(const std::vector<float>& values) {
    Json result = Json::array();
    for (const float value : values) result.push_back(short_number(value));
    return result;
}

Json to_json(const ProbeFigures& figures, bool measured) {
    Json result = Json::object();
    for (int f = 0; f < k_probe_figures; ++f) {
        const auto figure = static_cast<ProbeFigure>(f);
        result[figure_key(figure)] = measured ? short_number(figures[figure]) : Json();
    }
    return result;
}

Json to_json(const ProbeCell& cell) {
    Json result;
    result["grid"] = cell.grid;
    result["at"] = numbers(cell.at);
    result["clips"] = result["weights"] = Json::array();
    for (const ProbeShare& share : cell.shares) {
        result["clips"].push_back(share.clip);
        result["weights"].push_back(short_number(share.weight));
    }
    result["standing_share"] = short_number(cell.standing);
    result["obtained"] = {{"forward_mps", short_number(cell.forward)},
                          {"lateral_mps", short_number(cell.lateral)},
                          {"turn_deg_s", short_number(cell.turn)}};
    const bool measured = cell.standing > 0;
    result["blend"] = to_json(cell.blend, measured);
    result["sources"] = to_json(cell.sources, measured);
    return result;
}

Json to_json(const ProbeSpace& space) {
    Json result;
    result["name"] = space.name;
    result["axes"] = Json::array();
    for (const ProbeAxis& axis : space.axes)
        result["axes"].push_back({{"name", axis.name},
                                  {"unit", axis.unit},
                                  {"low", short_number(axis.low)},
                                  {"high", short_number(axis.high)},
                                  {"points", axis.points}});
    result["clips"] = space.clips;
    result["cells"] = Json::array();
    for (const ProbeCell& cell : space.cells) result["cells"].push_back(to_json(cell));
    return result;
}

Json summary_json(const std::vector<ProbeSpace>& spaces) {
    Json result = Json::object();
    for (int f = 0; f < k_probe_figures; ++f) {
        const auto figure = static_cast<ProbeFigure>(f);
        const ProbeStat stat = probe_stat(spaces, figure);
        if (stat.cell < 0) {
            result[figure_key(figure)] = Json();
            continue;
        }
        const ProbeSpace& space = spaces[static_cast<std::size_t>(stat.space)];
        const ProbeCell& cell = space.cells[static_cast<std::size_t>(stat.cell)];
        Json clips = Json::array();
        for (const ProbeShare& share : cell.shares) clips.push_back(space.clips[static_cast<std::size_t>(share.clip)]);
        result[figure_key(figure)] = {
            {"mean", short_number(static_cast<float>(stat.mean))},
            {"worst", short_number(static_cast<float>(stat.worst))},
            {"source_mean", short_number(static_cast<float>(stat.source))},
            {"added_mean", short_number(static_cast<float>(stat.added))},
            {"worst_cell", {{"space", space.name}, {"at", numbers(cell.at)}, {"clips", clips}}}};
    }
    result["skate_ratio"] = short_number(static_cast<float>(skate_ratio(spaces)));
    result["unmeasured_cells"] = unmeasured_cells(spaces);
    return result;
}

Json one_result(const ProbeResult& result) {
    Json json = Json::object();
    if (result.empty()) return json;
    json["summary"] = summary_json(result.spaces);
    json["spaces"] = Json::array();
    for (const ProbeSpace& space : result.spaces) json["spaces"].push_back(to_json(space));
    return json;
}

ProbeFigures read_figures(JsonNode node) {
    ProbeFigures figures;
    for (int f = 0; f < k_probe_figures; ++f) {
        const auto figure = static_cast<ProbeFigure>(f);
        if (node.has(figure_key(figure))) figures[figure] = node.at(figure_key(figure)).real();
    }
    return figures;
}

ProbeCell read_cell(JsonNode node, const ProbeSpace& space) {
    ProbeCell cell;
    const auto grid = node.at("grid").items();
    cell.at = node.at("at").reals();
    if (grid.size() != space.axes.size() || cell.at.size() != space.axes.size())
        node.fail("\"grid\" and \"at\" need one number for each axis");
    for (std::size_t k = 0; k < grid.size(); ++k) cell.grid.push_back(grid[k].integer(0, space.axes[k].points - 1));
    const auto clips = node.at("clips").items();
    const auto weights = node.at("weights").reals();
    if (clips.size() != weights.size()) node.fail("\"clips\" and \"weights\" must be of the same length");
    for (std::size_t i = 0; i < clips.size(); ++i)
        cell.shares.push_back({clips[i].integer(0, static_cast<int>(space.clips.size()) - 1), weights[i]});
    cell.standing = node.at("standing_share").real();
    JsonNode obtained = node.at("obtained");
    cell.forward = obtained.at("forward_mps").real();
    cell.lateral = obtained.at("lateral_mps").real();
    cell.turn = obtained.at("turn_deg_s").real();
    cell.blend = read_figures(node.at("blend"));
    cell.sources = read_figures(node.at("sources"));
    return cell;
}

ProbeSpace read_space(JsonNode node) {
    ProbeSpace space;
    space.name = node.at("name").text();
    for (JsonNode axis : node.at("axes").items())
        space.axes.push_back({axis.at("name").text(), axis.at("unit").text(), axis.at("low").real(),
                              axis.at("high").real(), axis.at("points").integer(1, k_most_points)});
    space.clips = node.at("clips").texts();
    for (const JsonNode& cell : node.at("cells").items()) space.cells.push_back(read_cell(cell, space));
    return space;
}

ProbeResult read_result(JsonNode node) {
    ProbeResult result;
    if (node.has("spaces"))
        for (const JsonNode& space : node.at("spaces").items()) result.spaces.push_back(read_space(space));
    return result;
}

}  // namespace

Json to_json(const ProbeResult& result, const ProbeResult* before) {
    Json json = one_result(result);
    if (before) json["before"] = one_result(*before);
    return json;
}

ProbeResult read_probe(JsonNode node, std::optional<ProbeResult>& before) {
    if (node.has("before")) before = read_result(node.at("before"));
    return read_result(std::move(node));
}

std::string probe_json(const ProbeResult& result, const ProbeResult* before) {
    return to_json(result, before).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surefoot
