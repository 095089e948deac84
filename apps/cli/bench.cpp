// surefoot bench CHARACTER: what a frame of it costs on this machine, a character and stage; and what the machine does
// today beside it.

#include "character_file.h"
#include "command.h"

#include <surefoot/bake/character.h>
#include <surefoot/base/error.h>
#include <surefoot/clip/sample.h>
#include <surefoot/course/placed_walker.h>
#include <surefoot/crowd/crowd.h>
#include <surefoot/ground/height_field.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ctime>
#include <memory>

namespace surefoot::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr float k_dt = 1.0f / 60;

struct Options {
    std::string source;
    std::vector<std::size_t> crowds{1, 8, 100, 1000, 10000};
    double seconds = 4;
    bool json = false;
};

/// One thing that is measured: `work` is a frame of `units` characters, or of a calibration loop.
struct Row {
    std::string name;
    double units = 1;
    std::function<void()> work;
    std::vector<double> us;  ///< a unit, by round
    double median() const {
        std::vector<double> sorted = us;
        std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

/// Processor time, which what else runs here disturbs less than the clock on the wall.
double measure(const Row& row, double seconds) {
    const std::clock_t begin = std::clock();
    const auto enough = static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
    std::clock_t now = begin;
    double done = 0;
    for (long batch = 1; now - begin < enough; batch *= 2) {
        for (long i = 0; i < batch; ++i) row.work();
        done += static_cast<double>(batch) * row.units;
        now = std::clock();
    }
    return static_cast<double>(now - begin) * 1e6 / CLOCKS_PER_SEC / done;
}

/// Steering that never rests, and each character's own.
LocomotionRequest wish(std::size_t character, std::uint32_t frame) {
    const float t = 0.01f * static_cast<float>(frame) + 0.13f * static_cast<float>(character % 97);
    const float saw = t - std::floor(t), slow_saw = 0.3f * t - std::floor(0.3f * t);
    return {1.2f + 1.5f * saw, 70.0f * (0.5f - slow_saw), 0};
}

struct Actors {
    const LocomotionGraph& graph;
    std::vector<LocomotionState> states;
    std::vector<LocomotionRequest> wishes;
    std::vector<RootFrame> roots;
    std::vector<Transform> locals;
    std::vector<Matrix34> matrices;
    std::vector<CrowdFeet> feet;
    HeightField hills = make_hills();
    CrowdScratch scratch;
    std::uint32_t frame = 0;

    struct Wants {
        bool locals = false, matrices = false, feet = false;
        bool steers = false;  ///< all the time; else each keeps its own wish
    };
    bool steers;
    Actors(const LocomotionGraph& graph_, std::size_t count, Wants wants)
        : graph(graph_), states(count), wishes(count), roots(count), scratch(graph), steers(wants.steers) {
        const std::size_t joints = graph.skeleton->rest.size();
        if (wants.locals) locals.resize(count * joints);
        if (wants.matrices) matrices.resize(count * joints);
        if (wants.feet) feet.resize(count);
        for (std::size_t c = 0; c < count; ++c) {
            states[c].phase = 0.01f * static_cast<float>(c % 97);
            roots[c] = {{static_cast<float>(c % 41) - 20, 0, static_cast<float>(c % 71)},
                        0.1f * static_cast<float>(c % 63)};
        }
    }
    void step() {
        for (std::size_t c = 0; c < wishes.size(); ++c) {
            wishes[c] = wish(c, steers ? frame : 0);
            keep_on_hills(roots[c].position);
        }
        Crowd crowd{states, wishes, roots};
        crowd.frame = frame++;
        crowd.locals = locals;
        crowd.matrices = matrices;
        if (!feet.empty()) crowd.ground = &hills;
        crowd.feet = feet;
        evaluate(graph, crowd, {0, states.size()}, k_dt, scratch);
    }

  private:
    static void keep_on_hills(Vec3& place) {
        if (std::fabs(place.x) > 28) place.x = -place.x;
        if (place.z > 88) place.z -= 90;
        if (place.z < -8) place.z += 90;
    }
};

/// One character with its feet on hills, as the course runs it: it looks ahead and plans once a step.
struct Hero {
    HeightField hills = make_hills();
    std::unique_ptr<Walker> walker;
    std::unique_ptr<PlacedWalker> placed;
    int frame = 0;
    bool steers;

    Hero(const Character& character, bool steers_) : walker(make_character_walker(character)), steers(steers_) {
        placed = std::make_unique<PlacedWalker>(*walker, hills);
        placed->start(1.4f);
    }
    void step() {
        constexpr int k_lap = 60 * 60;  // the hills end
        if (++frame % k_lap == 0) placed->start(1.4f);
        if (steers) walker->steer(wish(0, static_cast<std::uint32_t>(frame)));
        placed->advance(k_dt);
    }
};

void multiply_add() {
    static float a[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    for (int k = 0; k < 1000; ++k)
        for (float& x : a) x = x * 0.999f + 1e-3f;
}

constexpr const char *k_multiply_adds = "16 000 multiply-adds", *k_writes = "writing 32 MB";

std::vector<Row> measured(const Character& character, const Options& options) {
    const LocomotionGraph& graph = character.graph;
    std::vector<Row> rows;
    const auto crowd = [&](const std::string& name, std::size_t count, Actors::Wants wants) {
        auto actors = std::make_shared<Actors>(graph, count, wants);
        rows.push_back({name, static_cast<double>(count), [actors] { actors->step(); }, {}});
    };
    constexpr std::size_t k_stage_crowd = 104;
    crowd("update alone", k_stage_crowd, {});
    crowd("update alone, steering", k_stage_crowd, {.steers = true});
    crowd("update and pose", k_stage_crowd, {.locals = true});
    for (const std::size_t count : options.crowds)
        crowd(fmt::format("update, pose, matrices: crowd of {}", count), count, {.matrices = true});
    if (character.legs.known())
        for (const std::size_t count : options.crowds)
            crowd(fmt::format("the same with feet on hills: crowd of {}", count), count,
                  {.matrices = true, .feet = true});
    if (character.legs.known())
        for (const std::size_t count : options.crowds)
            crowd(fmt::format("and steering: crowd of {}", count), count,
                  {.matrices = true, .feet = true, .steers = true});
    for (const bool steers : {false, true}) {
        if (!character.legs.known()) continue;
        auto hero = std::make_shared<Hero>(character, steers);
        rows.push_back({steers ? "the same, steering" : "one with its feet on hills, looking ahead",
                        1,
                        [hero] { hero->step(); },
                        {}});
    }
    rows.push_back({k_multiply_adds, 1, multiply_add, {}});
    auto bytes = std::make_shared<std::vector<float>>(8'000'000);
    rows.push_back(
        {k_writes, 1, [bytes, value = 0.0f]() mutable { std::fill(bytes->begin(), bytes->end(), ++value); }, {}});
    // In turns, so that what disturbs the machine for a while disturbs all alike.
    constexpr int k_rounds = 5;
    const double each = options.seconds / (k_rounds * static_cast<double>(rows.size()));
    for (int round = 0; round < k_rounds; ++round)
        for (Row& row : rows) row.us.push_back(measure(row, each));
    return rows;
}

Json report_json(const Character& character, const std::vector<Row>& rows) {
    Json report{{"kernels", kernels_name()},
                {"joints", character.skeleton->joint_count()},
                {"clips", character.graph.clips.size()},
                {"state_bytes", sizeof(LocomotionState)},
                {"foot_placement_state_bytes", sizeof(FootPlacementState)},
                {"rows", Json::array()}};
    for (const Row& row : rows) {
        const auto [least, most] = std::minmax_element(row.us.begin(), row.us.end());
        report["rows"].push_back(
            {{"name", row.name}, {"median_us", row.median()}, {"least_us", *least}, {"most_us", *most}});
    }
    return report;
}

std::string report_text(const Character& character, const std::vector<Row>& rows) {
    std::string text = fmt::format(
        "{} joints, {} clips, kernels for {}; {} bytes of state a character, and {} where feet are placed\n\n"
        "{:<44} {:>9} {:>9} {:>9}\n",
        character.skeleton->joint_count(), character.graph.clips.size(), kernels_name(), sizeof(LocomotionState),
        sizeof(FootPlacementState), "processor time, us a character and frame", "median", "least", "most");
    for (const Row& row : rows) {
        if (row.name == k_multiply_adds) text += "\nthe machine, us each\n";
        const auto [least, most] = std::minmax_element(row.us.begin(), row.us.end());
        text += fmt::format("{:<44} {:>9.3f} {:>9.3f} {:>9.3f}\n", row.name, row.median(), *least, *most);
    }
    return text;
}

int run(const Options& options) {
    const CharacterFile file = read_character_file(options.source);  // a pack's clips point into its bytes
    if (file.pack.has_program())
        throw Error("it is a graph", options.source,
                    "only characters of one blend space are measured; name its project");
    const Character character = to_character(file.pack);
    const std::vector<Row> rows = measured(character, options);
    if (options.json)
        fmt::print("{}\n", report_json(character, rows).dump(2));
    else
        fmt::print("{}", report_text(character, rows));
    return 0;
}

}  // namespace

extern const Command k_bench;
const Command k_bench{"bench", "Measure what a frame of a character costs on this machine", [](CLI::App& app) {
                          auto options = std::make_shared<Options>();
                          app.add_option("character", options->source, "a project or a pack of one")->required();
                          app.add_option("--crowd", options->crowds, "how many characters, one or several numbers")
                              ->delimiter(',')
                              ->check(CLI::Range(1, 200000))
                              ->capture_default_str();
                          app.add_option("--seconds", options->seconds, "how long to measure, about")
                              ->check(is_number)
                              ->check(CLI::Range(0.1, 600.0));
                          app.add_flag("--json", options->json, "Tell it as JSON");
                          return [options] { return run(*options); };
                      }};

}  // namespace surefoot::cli
