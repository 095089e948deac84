// What the browser calls: plain C functions over the module's own memory. surefoot.mjs is the other half.
//
// Calls that produce a text leave it where sf_text() and sf_text_size() say, until the next call. They return 0, or 1
// where the text is an error message.

#include "scenario.h"

#include <surefoot/analysis/analyze.h>
#include <surefoot/analysis/facts_json.h>
#include <surefoot/base/error.h>
#include <surefoot/io/bvh.h>
#include <surefoot/space/triangulate.h>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <exception>
#include <span>

#define SUREFOOT_EXPORT(name) __attribute__((used, export_name(#name)))

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

}  // extern "C"
