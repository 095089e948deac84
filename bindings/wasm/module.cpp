// What the browser calls: plain C functions over the module's own memory. surefoot.mjs is the other half.
//
// Calls that produce a text leave it where sf_text() and sf_text_size() say, until the next call. They return 0, or 1
// where the text is an error message.

#include "bench_desk.h"
#include "crowd_stage.h"
#include "gait_desk.h"
#include "graph_desk.h"
#include "scenario.h"
#include "stage.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/facts_json.h>
#include <surefoot/base/error.h>
#include <surefoot/graph_text/json_edit.h>
#include <surefoot/host/progress.h>
#include <surefoot/io/bvh.h>
#include <surefoot/space/triangulate.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#define SUREFOOT_EXPORT(name) __attribute__((used, export_name(#name)))
#define SUREFOOT_IMPORT(name) __attribute__((import_module("surefoot"), import_name(#name)))

/// Who loads the module is told of long work, step by step.
extern "C" SUREFOOT_IMPORT(progress) void sf_tell_progress(const char* label, std::size_t size, std::size_t done,
                                                           std::size_t total);

namespace {

std::string g_text;

template <typename Body>
int guarded(const Body& body) {
    try {
        g_text = body();
        return 0;
    } catch (const std::exception& error) {
        g_text = error.what();
        return 1;
    }
}

surefoot::BlendSpace g_space;
surefoot::wasm::Files g_files;  // given, and not used yet
surefoot::wasm::Files g_made;   // of sf_bench_files
std::unique_ptr<surefoot::wasm::Stage> g_stage;
std::unique_ptr<surefoot::wasm::BenchDesk> g_bench;
std::unique_ptr<surefoot::wasm::GaitDesk> g_gait;     // none before a gait is asked for
std::unique_ptr<surefoot::wasm::CrowdStage> g_crowd;  // none before a crowd is asked for
std::unique_ptr<surefoot::wasm::GraphDesk> g_graph;   // none before a graph is asked for

/// Arrays that stay in the module's memory, for views upon them: sf_array.
enum Array {
    k_frame,
    k_positions,
    k_normals,
    k_joints,
    k_weights,
    k_triangles,
    k_inverse_bind,
    k_terrain,
    k_terrain_triangles,
    k_crowd_roots,
    k_crowd_matrices,
    k_crowd_positions,
    k_crowd_normals,
    k_crowd_joints,
    k_crowd_weights,
    k_crowd_triangles,
    k_crowd_terrain,
    k_crowd_terrain_triangles,
    k_gait_curves
};

std::span<const std::byte> crowd_bytes_of(int array) {
    using std::as_bytes, std::span;
    if (!g_crowd) return {};
    const surefoot::Mesh& mesh = g_crowd->mesh();
    switch (array) {
        case k_crowd_roots:
            return as_bytes(g_crowd->roots());
        case k_crowd_matrices:
            return as_bytes(g_crowd->matrices());
        case k_crowd_positions:
            return as_bytes(span(mesh.positions));
        case k_crowd_normals:
            return as_bytes(span(mesh.normals));
        case k_crowd_joints:
            return as_bytes(span(mesh.joints));
        case k_crowd_weights:
            return as_bytes(span(mesh.weights));
        case k_crowd_triangles:
            return as_bytes(span(mesh.indices));
        case k_crowd_terrain:
            return as_bytes(span(g_crowd->terrain().positions));
        case k_crowd_terrain_triangles:
            return as_bytes(span(g_crowd->terrain().indices));
        default:
            return {};
    }
}

std::span<const std::byte> bytes_of(int array) {
    using std::as_bytes, std::span;
    if (array == k_gait_curves) return g_gait ? as_bytes(g_gait->curves()) : span<const std::byte>();
    if (!g_stage) return {};
    const surefoot::Mesh& mesh = g_stage->mesh();
    switch (array) {
        case k_frame:
            return as_bytes(g_stage->frame());
        case k_positions:
            return as_bytes(span(mesh.positions));
        case k_normals:
            return as_bytes(span(mesh.normals));
        case k_joints:
            return as_bytes(span(mesh.joints));
        case k_weights:
            return as_bytes(span(mesh.weights));
        case k_triangles:
            return as_bytes(span(mesh.indices));
        case k_inverse_bind:
            return as_bytes(g_stage->inverse_bind());
        case k_terrain:
            return as_bytes(span(g_stage->terrain().positions));
        case k_terrain_triangles:
            return as_bytes(span(g_stage->terrain().indices));
        default:
            return crowd_bytes_of(array);
    }
}

/// Another character, or after an error the one that was there. `goes_on`: from where that one is.
std::string put_on_stage(surefoot::Character character, std::vector<std::byte> bytes = {}, bool goes_on = false) {
    auto stage = std::make_unique<surefoot::wasm::Stage>(std::move(character), std::move(bytes));
    if (goes_on && g_stage) stage->go_on_from(*g_stage);
    g_gait.reset();
    g_crowd.reset();
    g_stage = std::move(stage);  // before what its guest plays goes
    g_graph.reset();
    return g_stage->describe();
}

surefoot::wasm::Files take_files() { return std::exchange(g_files, {}); }

surefoot::wasm::BenchDesk& bench() {
    if (!g_bench) throw surefoot::Error("there is no project yet", "", "open one first");
    return *g_bench;
}

/// Another project, or after an error the one that was there.
template <typename Open>
std::string put_on_bench(const Open& open) {
    surefoot::watch_progress([](const std::string& label, std::size_t done, std::size_t total) {
        sf_tell_progress(label.data(), label.size(), done, total);
    });
    g_bench = std::make_unique<surefoot::wasm::BenchDesk>(open());
    return g_bench->describe();
}

surefoot::wasm::Stage& stage() {
    if (!g_stage) throw surefoot::Error("there is no character yet", "", "open one first");
    return *g_stage;
}

/// Of the character on the stage, until it is given another body.
surefoot::wasm::GaitDesk& gait_desk() {
    if (!g_gait) g_gait = std::make_unique<surefoot::wasm::GaitDesk>(surefoot::wasm::body_of(stage().character()));
    return *g_gait;
}

/// What is on the desk goes on the stage; true where the body is another one.
bool show_gait() { return stage().play(gait_desk().motion(), gait_desk().body(), gait_desk().rise()); }

}  // namespace

extern "C" {

SUREFOOT_EXPORT(sf_allocate) void* sf_allocate(std::size_t bytes) { return std::malloc(bytes); }
SUREFOOT_EXPORT(sf_free) void sf_free(void* memory) { std::free(memory); }
SUREFOOT_EXPORT(sf_text) const char* sf_text() { return g_text.data(); }
SUREFOOT_EXPORT(sf_text_size) std::size_t sf_text_size() { return g_text.size(); }

/// The hashes of bindings/wasm/scenario.h.
SUREFOOT_EXPORT(sf_scenarios) int sf_scenarios() {
    return guarded([] { return surefoot::wasm::run_scenarios(); });
}

/// A BVH text in, the facts of its clip out, as the JSON of `surefoot analyze --json`.
SUREFOOT_EXPORT(sf_analyze_bvh) int sf_analyze_bvh(const char* text, std::size_t size) {
    return guarded([&] {
        surefoot::LoadedClip clip = surefoot::read_bvh({text, size}, "clip.bvh");
        const auto analyzed = surefoot::analyze_clip(std::move(clip.motion), clip.file, clip.unit_scale);
        return surefoot::facts_to_json(analyzed.facts, surefoot::FactsDetail::listed).dump();
    });
}

/// Builds the module's one blend space: `values` holds count samples of `dimensions` numbers each within the limits
/// low and high of every axis.
SUREFOOT_EXPORT(sf_space)
int sf_space(int dimensions, const float* values, int count, const float* low, const float* high) {
    return guarded([&] {
        if (dimensions < 1 || dimensions > surefoot::k_max_dimensions || count < 1)
            throw surefoot::Error("a blend space has 1 to 4 dimensions and at least one sample", "", "");
        surefoot::BlendSpace space;
        const auto width = static_cast<std::size_t>(dimensions);
        for (std::size_t d = 0; d < width; ++d) space.axes.push_back({"axis", "", low[d], high[d], false});
        for (std::size_t s = 0; s < static_cast<std::size_t>(count); ++s) {
            surefoot::SpacePoint point{};
            for (std::size_t d = 0; d < width; ++d) point[d] = values[s * width + d];
            space.samples.push_back(point);
        }
        surefoot::triangulate(space);
        g_space = std::move(space);
        return std::string();
    });
}

/// Weights of the space at a point: up to 5 samples and their weights; returns how many, 0 without a space.
SUREFOOT_EXPORT(sf_weights) int sf_weights(const float* point, std::int32_t* samples, float* weights) {
    if (g_space.samples.empty()) return 0;
    surefoot::SpacePoint at{};
    for (std::size_t d = 0; d < g_space.axes.size(); ++d) at[d] = point[d];
    const surefoot::BlendWeights found = surefoot::blend_weights(g_space, at);
    for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k) {
        samples[k] = found.samples[k];
        weights[k] = found.weights[k];
    }
    return found.count;
}

/// Keeps a file for the next call that opens files; whether that succeeds or not, they are forgotten then.
SUREFOOT_EXPORT(sf_put_file)
void sf_put_file(const char* name, std::size_t name_size, const char* bytes, std::size_t size) {
    g_files[std::string(name, name_size)] = std::string(bytes, size);
}

/// Puts the character of the bundled gaits on the stage. Text: what it is (Stage::describe).
SUREFOOT_EXPORT(sf_open_default) int sf_open_default() {
    return guarded([] { return put_on_stage(surefoot::wasm::default_character()); });
}

/// The same with the character of a pack, who goes on from where the one before is. After an error the stage is as it
/// was.
SUREFOOT_EXPORT(sf_open_pack) int sf_open_pack(const char* bytes, std::size_t size) {
    return guarded([&] {
        const std::span<const std::byte> given{reinterpret_cast<const std::byte*>(bytes), size};
        std::vector<std::byte> own(given.begin(), given.end());
        surefoot::Character character = surefoot::wasm::packed_character(own);
        return put_on_stage(std::move(character), std::move(own), true);
    });
}

/// Another course by name, from its start; `grade_deg` is the steepness of slopes.
SUREFOOT_EXPORT(sf_course) int sf_course(const char* name, std::size_t size, float grade_deg) {
    return guarded([&] {
        stage().set_course(std::string(name, size), grade_deg);
        return std::string();
    });
}

/// How feet are placed: 0 none, 1 colvin2013, 2 surefoot.
SUREFOOT_EXPORT(sf_mode) void sf_mode(int mode) {
    if (g_stage && mode >= 0 && mode <= 2) g_stage->set_mode(static_cast<surefoot::FootMode>(mode));
}

/// Somebody steers: m/s ahead and to the left, deg/s to the left.
SUREFOOT_EXPORT(sf_steer) void sf_steer(float speed, float lateral, float turn) {
    if (g_stage) g_stage->steer(speed, lateral, turn);
}

/// As it is at a place of a space, in axis units.
SUREFOOT_EXPORT(sf_steer_to) int sf_steer_to(const char* space, std::size_t size, const float* at, int dimensions) {
    return guarded([&] {
        stage().steer_to(std::string(space, size), {at, static_cast<std::size_t>(std::max(dimensions, 0))});
        return std::string();
    });
}

/// Nobody does: up and down the course at a speed.
SUREFOOT_EXPORT(sf_patrol) void sf_patrol(float speed) {
    if (g_stage) g_stage->patrol(speed);
}

/// Back to the start of the course.
SUREFOOT_EXPORT(sf_restart) void sf_restart() {
    if (g_stage) g_stage->restart();
}

/// So many frames of 1/60 s, or of a `parts`th of that each, on.
SUREFOOT_EXPORT(sf_advance) void sf_advance(int frames, int parts) {
    if (g_stage && frames > 0 && parts > 0) g_stage->advance(frames, parts);
}

/// Text: the figures of the last seconds (Stage::metrics).
SUREFOOT_EXPORT(sf_metrics) int sf_metrics() {
    return guarded([] { return stage().metrics(); });
}

/// Text: which clips play at a place of a space, in axis units (Stage::weights).
SUREFOOT_EXPORT(sf_blend) int sf_blend(const char* space, std::size_t size, const float* at, int dimensions) {
    return guarded([&] {
        return stage().weights(std::string(space, size), {at, static_cast<std::size_t>(std::max(dimensions, 0))});
    });
}

/// Projects on the bench. Text of each: BenchDesk::describe. After an error the bench is as it was.
SUREFOOT_EXPORT(sf_bench_default) int sf_bench_default() {
    return guarded([] { return put_on_bench(surefoot::wasm::BenchDesk::of_default); });
}

/// Of the files given so far: a project that `author` wrote, as it is on disk or as it was kept elsewhere.
SUREFOOT_EXPORT(sf_bench_open) int sf_bench_open(int on_disk) {
    return guarded([&] {
        const surefoot::wasm::Files files = take_files();
        return put_on_bench([&] { return surefoot::wasm::BenchDesk::of_project(files, on_disk != 0); });
    });
}

/// Of the files given so far: clips to make a project of.
SUREFOOT_EXPORT(sf_bench_author) int sf_bench_author(const char* name, std::size_t size) {
    return guarded([&] {
        const surefoot::wasm::Files files = take_files();
        return put_on_bench([&] { return surefoot::wasm::BenchDesk::of_clips(files, std::string(name, size)); });
    });
}

SUREFOOT_EXPORT(sf_bench) int sf_bench() {
    return guarded([] { return bench().describe(); });
}

/// What plays on the bench, for sf_open_pack. Text: its bytes.
SUREFOOT_EXPORT(sf_bench_pack) int sf_bench_pack() {
    return guarded([] { return bench().pack(); });
}

/// Another threshold, "too-close.distance=6"; without text all back to the project's own.
SUREFOOT_EXPORT(sf_bench_threshold) int sf_bench_threshold(const char* text, std::size_t size) {
    return guarded([&] {
        bench().set_threshold(std::string(text, size));
        return bench().describe();
    });
}

/// Mends a finding, or all that can be mended. Text: what was tried (BenchDesk::fix).
SUREFOOT_EXPORT(sf_bench_fix) int sf_bench_fix(const char* id, std::size_t size) {
    return guarded([&] { return bench().fix(std::string(id, size)); });
}

SUREFOOT_EXPORT(sf_bench_take_back) int sf_bench_take_back(const char* repair, std::size_t size) {
    return guarded([&] {
        bench().take_back(std::string(repair, size));
        return bench().describe();
    });
}

SUREFOOT_EXPORT(sf_bench_leave_out) int sf_bench_leave_out(const char* clip, std::size_t size, int out) {
    return guarded([&] {
        bench().leave_out(std::string(clip, size), out != 0);
        return bench().describe();
    });
}

/// One step back, or one forward again.
SUREFOOT_EXPORT(sf_bench_undo) int sf_bench_undo(int again) {
    return guarded([&] {
        if (again != 0)
            bench().redo();
        else
            bench().undo();
        return bench().describe();
    });
}

/// Plays the spaces and measures them.
SUREFOOT_EXPORT(sf_bench_probe) int sf_bench_probe(int grid) {
    return guarded([&] {
        bench().probe(grid);
        return bench().describe();
    });
}

/// Text: what the probe found (BenchDesk::heat).
SUREFOOT_EXPORT(sf_bench_heat) int sf_bench_heat() {
    return guarded([] { return bench().heat(); });
}

/// Makes the project's files, all or only those that are not saved. Text: {"files": names, "gone": names}.
SUREFOOT_EXPORT(sf_bench_files) int sf_bench_files(int all) {
    return guarded([&] {
        g_made = bench().files(all != 0);
        nlohmann::ordered_json out = {{"files", nlohmann::ordered_json::array()}, {"gone", bench().gone()}};
        for (const auto& [name, bytes] : g_made) out["files"].push_back(name);
        return out.dump();
    });
}

/// Text: the bytes of one of them, which is given away: it can be had once.
SUREFOOT_EXPORT(sf_bench_file) int sf_bench_file(const char* name, std::size_t size) {
    return guarded([&] {
        const auto found = g_made.find(std::string(name, size));
        if (found == g_made.end()) throw surefoot::Error("there is no such file", std::string(name, size), "");
        return std::move(g_made.extract(found).mapped());
    });
}

SUREFOOT_EXPORT(sf_bench_saved) void sf_bench_saved() {
    if (g_bench) g_bench->saved();
}

/// Text: the bundled gaits (gaits_json).
SUREFOOT_EXPORT(sf_gaits) int sf_gaits() {
    return guarded([] { return surefoot::wasm::gaits_json(); });
}

/// Text: the source of a bundled gait.
SUREFOOT_EXPORT(sf_gait_source) int sf_gait_source(const char* name, std::size_t size) {
    return guarded([&] {
        const std::string_view text = surefoot::bundled_gait({name, size});
        if (text.empty()) throw surefoot::Error("there is no such gait", std::string(name, size), "");
        return std::string(text);
    });
}

/// A gait for the character on the stage, which goes in it from now on. Text: what it is (GaitDesk::describe). After an
/// error all is as it was.
SUREFOOT_EXPORT(sf_gait_read) int sf_gait_read(const char* text, std::size_t size) {
    return guarded([&] {
        gait_desk().read({text, size});
        show_gait();
        return gait_desk().describe();
    });
}

/// The same of a bundled gait that was fitted to motion.
SUREFOOT_EXPORT(sf_gait_fitted) int sf_gait_fitted(const char* name, std::size_t size) {
    return guarded([&] {
        gait_desk().read_fitted({name, size});
        show_gait();
        return gait_desk().describe();
    });
}

/// The same gait with other values, one a parameter; k_gait_curves has the curves of what it does from now on.
SUREFOOT_EXPORT(sf_gait_play)
int sf_gait_play(const double* values, int count, double speed_mps, double turn_deg_s, double slope_deg) {
    return guarded([&] {
        surefoot::GaitPlay asked;
        asked.speed_mps = speed_mps;
        asked.turn_deg_s = turn_deg_s;
        asked.slope_deg = slope_deg;
        gait_desk().play({values, static_cast<std::size_t>(std::max(count, 0))}, asked);
        show_gait();
        return std::string();
    });
}

/// Text: the values that a personality's text gives the sliders of fitted gaits.
SUREFOOT_EXPORT(sf_gait_personality) int sf_gait_personality(const char* text, std::size_t size) {
    return guarded([&] { return nlohmann::ordered_json(surefoot::wasm::personality_values({text, size})).dump(); });
}

/// Text: the bundled rig templates (rigs_json).
SUREFOOT_EXPORT(sf_rigs) int sf_rigs() {
    return guarded([] { return surefoot::wasm::rigs_json(); });
}

/// The gait on the body of a template with these values, one a parameter; without a name on that of the character.
/// Text: {"gait", "character"}, as GaitDesk and Stage describe themselves from now on; the latter is null where the
/// body is the same. After an error all is as it was.
SUREFOOT_EXPORT(sf_gait_rig) int sf_gait_rig(const char* name, std::size_t size, const double* values, int count) {
    return guarded([&] {
        const std::span<const double> given(values, static_cast<std::size_t>(std::max(count, 0)));
        gait_desk().put_on(size == 0 ? surefoot::wasm::body_of(stage().character())
                                     : surefoot::wasm::rigged_body({name, size}, given));
        const bool changed = show_gait();
        return R"({"gait":)" + gait_desk().describe() + R"(,"character":)" + (changed ? stage().describe() : "null") +
               "}";
    });
}

/// Text: what it does as it is played now, measured (GaitDesk::played).
SUREFOOT_EXPORT(sf_gait_played) int sf_gait_played() {
    return guarded([] { return gait_desk().played(); });
}

/// The character goes by its own clips again, and in no gait and no graph. Text: what it is, where that is not who was
/// seen before; else null.
SUREFOOT_EXPORT(sf_gait_stop) int sf_gait_stop() {
    return guarded([] {
        const bool changed = g_stage && g_stage->stop_playing();
        g_gait.reset();
        return changed ? g_stage->describe() : std::string("null");
    });
}

/// Text: the gait's clip as the bytes of a file, 0 BVH, 1 GLB.
SUREFOOT_EXPORT(sf_gait_file) int sf_gait_file(int format) {
    return guarded([&] { return format == 0 ? gait_desk().bvh() : gait_desk().glb(); });
}

/// So many of the character on the stage, at the start of their way on a ground (crowd_ground_names). Text: what they
/// are (CrowdStage::describe).
SUREFOOT_EXPORT(sf_crowd) int sf_crowd(int count, const char* ground, std::size_t size) {
    return guarded([&] {
        g_crowd = std::make_unique<surefoot::wasm::CrowdStage>(stage().character(), count, std::string(ground, size));
        return g_crowd->describe();
    });
}

/// One frame of the crowd (CrowdStage::advance); returns how many were posed, 0 without a crowd.
SUREFOOT_EXPORT(sf_crowd_advance) int sf_crowd_advance(float seconds, float eye_x, float eye_z, int lasting, int feet) {
    return g_crowd ? g_crowd->advance(seconds, eye_x, eye_z, lasting != 0, feet != 0) : 0;
}

/// A graph for the character on the stage, which goes as it says from now on. Text: what it is (GraphDesk::describe).
/// After an error all is as it was.
SUREFOOT_EXPORT(sf_graph_read) int sf_graph_read(const char* text, std::size_t size) {
    return guarded([&] {
        if (!g_graph) g_graph = std::make_unique<surefoot::wasm::GraphDesk>(stage().character());
        g_graph->read({text, size});
        if (stage().guest() != g_graph->walker().get())
            stage().play(g_graph->walker(), [] { return g_graph->asked(); });
        return g_graph->describe();
    });
}

/// Asks for the value of one of its parameters, by index.
SUREFOOT_EXPORT(sf_graph_set) void sf_graph_set(int parameter, float value) {
    if (g_graph) g_graph->set(parameter, value);
}

/// Text: what of the graph plays, and what has happened since the last call (GraphDesk::live).
SUREFOOT_EXPORT(sf_graph_live) int sf_graph_live() {
    return guarded([&] {
        if (!g_graph) throw surefoot::Error("there is no graph yet", "", "read one first");
        return g_graph->live();
    });
}

/// Text: a JSON text with another value at a place, and every other byte as it was (json_edit.h).
SUREFOOT_EXPORT(sf_json_edit)
int sf_json_edit(const char* text, std::size_t size, const char* pointer, std::size_t pointer_size, const char* value,
                 std::size_t value_size) {
    return guarded([&] {
        return surefoot::with_json_value({text, size}, {pointer, pointer_size}, {value, value_size});
    });
}

/// Text: a JSON text without what is at a place (json_edit.h).
SUREFOOT_EXPORT(sf_json_remove)
int sf_json_remove(const char* text, std::size_t size, const char* pointer, std::size_t pointer_size) {
    return guarded([&] { return surefoot::without_json_value({text, size}, {pointer, pointer_size}); });
}

/// Where an array begins and how many bytes it has; valid until the next call that opens, or changes the course.
SUREFOOT_EXPORT(sf_array) const void* sf_array(int array) { return bytes_of(array).data(); }
SUREFOOT_EXPORT(sf_array_bytes) std::size_t sf_array_bytes(int array) { return bytes_of(array).size(); }

}  // extern "C"
