// The native twin of the WebAssembly module, for smoke_test.mjs to compare with: prints the hashes of the same
// scenarios, or the BVH text or the facts of the example clip.

#include <bindings/wasm/scenario.h>

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/facts_json.h>
#include <surefoot/io/bvh.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstring>

// wasm_twin scenarios | bvh | facts (the facts of the clip that `bvh` prints)
int main(int argc, char** argv) {
    const char* what = argc > 1 ? argv[1] : "scenarios";
    if (std::strcmp(what, "scenarios") == 0) {
        std::fputs(surefoot::wasm::run_scenarios().c_str(), stdout);
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
