// The native twin of the WebAssembly module, for smoke_test.mjs to compare with: prints the hashes of the same
// scenarios, or the BVH text or the facts of the example clip.

#include <bindings/wasm/bench_desk.h>
#include <bindings/wasm/crowd_stage.h>
#include <bindings/wasm/gait_desk.h>
#include <bindings/wasm/graph_desk.h>
#include <bindings/wasm/scenario.h>
#include <bindings/wasm/stage.h>

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/facts_json.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

/// The frames of a stage as bytes, one after the other: as tests/studio and smoke_test.mjs play it.
void write_stage() {
    surefoot::wasm::Stage stage(surefoot::wasm::default_character());
    const auto play = [&](int frames, int parts) {
        for (int f = 0; f < frames; ++f) {
            stage.advance(1, parts);
            std::fwrite(stage.frame().data(), 1, stage.frame().size_bytes(), stdout);
        }
    };
    stage.set_course("stairs_up", 15);
    stage.patrol(1.2f);
    play(300, 1);
    stage.steer(1.4f, 0, 30);
    play(120, 1);
    stage.set_mode(surefoot::FootMode::colvin2013);
    stage.steer(0.5f, 0.25f, -20);
    play(60, 2);
    stage.set_mode(surefoot::FootMode::none);
    play(60, 1);
}

/// Weights at a place; the default project under another threshold; what mends it, and how it is then.
void write_bench() {
    const surefoot::wasm::Stage stage(surefoot::wasm::default_character());
    const float at[] = {1.0f, 20.0f};
    std::puts(stage.weights("facing", at).c_str());
    surefoot::wasm::BenchDesk desk = surefoot::wasm::BenchDesk::of_default();
    desk.set_threshold("too-close.distance=20");
    std::puts(desk.describe().c_str());
    std::puts(desk.fix("").c_str());
    desk.probe(5);
    std::puts(desk.describe().c_str());
    std::puts(desk.heat().c_str());
}

/// The files of the default project and its pack, mended, one after the other.
void write_files() {
    surefoot::wasm::BenchDesk desk = surefoot::wasm::BenchDesk::of_default();
    desk.fix("");
    for (const auto& [name, bytes] : desk.files(true)) std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    const std::string pack = desk.pack();
    std::fwrite(pack.data(), 1, pack.size(), stdout);
}

/// The frames of a gait as bytes, as tests/studio and smoke_test.mjs play it: at first as it is, then shaped.
void write_gait() {
    surefoot::wasm::Stage stage(surefoot::wasm::default_character());
    surefoot::wasm::GaitDesk desk(surefoot::wasm::body_of(stage.character()));
    desk.read(surefoot::bundled_gait("bhatti2017"));
    const surefoot::Gait gait = surefoot::read_gait(surefoot::bundled_gait("bhatti2017"), "bhatti2017");
    const auto play = [&](const std::vector<double>& values, double speed, double turn, double slope) {
        desk.play(values, {speed, turn, slope});
        stage.play(desk.motion(), desk.body(), desk.rise());
        for (int f = 0; f < 100; ++f) {
            stage.advance(1);
            std::fwrite(stage.frame().data(), 1, stage.frame().size_bytes(), stdout);
        }
    };
    const auto shaped = [&](const std::vector<std::string>& set) { return surefoot::gait_values(gait, "", set); };
    play(shaped({}), 0, 0, 0);
    play(shaped({"df=0.2"}), 0, 0, 0);
    play(shaped({"df=0.2", "Shgt=0.6"}), 1.1, 20, 0);
    // Fitted to motion: as it is, with a personality, uphill, and on the body of a child.
    desk.read_fitted("jog");
    const std::vector<double> own = surefoot::wasm::personality_values(R"({"own": {}})");
    const std::vector<double> stiff = surefoot::wasm::personality_values(R"({"stiff": {"spine": {"lean_deg": 12}}})");
    play(own, 2.3, 0, 0);
    play(stiff, 1.2, -30, 0);
    play(stiff, 1.2, 0, 9);
    std::vector<double> child;
    for (const surefoot::GaitParameter& each :
         surefoot::read_rig_template(surefoot::bundled_rig("child"), "child").parameters)
        child.push_back(each.value);
    desk.put_on(surefoot::wasm::rigged_body("child", child));
    play(stiff, 1.2, 0, 9);
}

/// The frames of a crowd as bytes, as tests/studio and smoke_test.mjs play it: roots, then matrices.
void write_crowd() {
    const surefoot::Character character = surefoot::wasm::default_character();
    for (const char* ground : {"flat", "hills"}) {
        surefoot::wasm::CrowdStage crowd(character, 203, ground);
        for (int frame = 0; frame < 90; ++frame) {
            crowd.advance(1.0f / 60, 20, 5, frame >= 30, true);
            std::fwrite(crowd.roots().data(), 1, crowd.roots().size_bytes(), stdout);
            std::fwrite(crowd.matrices().data(), 1, crowd.matrices().size_bytes(), stdout);
        }
    }
}

/// The frames of a graph as bytes, as tests/studio and smoke_test.mjs play it, then what it says of itself.
void write_graph(const char* file) {
    surefoot::wasm::Stage stage(surefoot::wasm::default_character());
    surefoot::wasm::GraphDesk desk(stage.character());
    desk.read(surefoot::read_file(file));
    stage.play(desk.walker(), [&desk] { return desk.asked(); });
    const auto play = [&](int frames) {
        for (int f = 0; f < frames; ++f) {
            stage.advance(1);
            std::fwrite(stage.frame().data(), 1, stage.frame().size_bytes(), stdout);
        }
    };
    play(100);
    desk.set(3, 1);
    play(100);
    desk.set(0, 0);
    play(60);
    std::printf("%s\n%s\n", desk.describe().c_str(), desk.live().c_str());
}

// wasm_twin scenarios | bvh | facts (the facts of the clip that `bvh` prints) | stage | bench | files | gait | crowd |
// graph FILE
int main(int argc, char** argv) {
    const char* what = argc > 1 ? argv[1] : "scenarios";
    if (std::strcmp(what, "scenarios") == 0) {
        std::fputs(surefoot::wasm::run_scenarios().c_str(), stdout);
        return 0;
    }
    if (std::strcmp(what, "stage") == 0) {
        write_stage();
        return 0;
    }
    if (std::strcmp(what, "gait") == 0) {
        write_gait();
        return 0;
    }
    if (std::strcmp(what, "graph") == 0 && argc > 2) {
        write_graph(argv[2]);
        return 0;
    }
    if (std::strcmp(what, "crowd") == 0) {
        write_crowd();
        return 0;
    }
    if (std::strcmp(what, "bench") == 0) {
        write_bench();
        return 0;
    }
    if (std::strcmp(what, "files") == 0) {
        write_files();
        return 0;
    }
    const std::string bvh = surefoot::wasm::example_bvh();
    if (std::strcmp(what, "bvh") == 0) {
        std::fputs(bvh.c_str(), stdout);
        return 0;
    }
    surefoot::LoadedClip clip = surefoot::read_bvh(bvh, "clip.bvh");
    const auto analyzed = surefoot::analyze_clip(std::move(clip.motion), clip.file, clip.unit_scale);
    std::puts(surefoot::facts_to_json(analyzed.facts, surefoot::FactsDetail::listed).dump().c_str());
    return 0;
}
