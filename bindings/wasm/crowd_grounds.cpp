#include "crowd_grounds.h"

#include <surefoot/base/error.h>
#include <surefoot/base/random.h>
#include <surefoot/ground/height_field.h>
#include <surefoot/ground/shapes.h>

#include <utility>

namespace surefoot::wasm {
namespace {

constexpr float k_quad = 4, k_amplitude = 0.5f;                        // [m] as the course of hills has them
constexpr float k_rise = 0.18f;                                        // of the slope: ten degrees
constexpr float k_kerb = 0.12f, k_kerb_width = 2.5f, k_kerb_from = 6;  // [m] high, wide, from one to the next

HeightField wide_hills(float reach) {
    const int quads = 2 * static_cast<int>(reach / k_quad + 1);
    const float origin = -0.5f * k_quad * static_cast<float>(quads);
    std::vector<float> heights(static_cast<std::size_t>((quads + 1) * (quads + 1)));
    Random random(1);
    for (float& height : heights) height = random.between(-k_amplitude, k_amplitude);
    return {origin, origin, k_quad, quads + 1, quads + 1, std::move(heights)};
}

Bands kerbs(float reach) {
    std::vector<Bands::Band> bands;
    for (float from = -reach; from < reach; from += k_kerb_from) bands.push_back({from, from + k_kerb_width});
    return {k_kerb, 0, std::move(bands)};
}

template <typename Surface>
CrowdGround shown(Surface surface, SurfaceMesh mesh) {
    return {std::make_shared<const Surface>(std::move(surface)), std::move(mesh)};
}

}  // namespace

const std::vector<std::string>& crowd_ground_names() {
    static const std::vector<std::string> names{"flat", "hills", "slope", "kerbs"};
    return names;
}

CrowdGround make_crowd_ground(const std::string& name, float reach) {
    const Extent all{-reach, reach, -reach, reach};
    if (name == "flat") return {nullptr, Plane().mesh(all)};
    if (name == "slope") return shown(Plane(0, k_rise), Plane(0, k_rise).mesh(all));
    if (name == "hills") {
        HeightField hills = wide_hills(reach);
        SurfaceMesh mesh = hills.mesh();
        return shown(std::move(hills), std::move(mesh));
    }
    if (name == "kerbs") {
        Bands bands = kerbs(reach);
        SurfaceMesh mesh = bands.mesh(all);
        return shown(std::move(bands), std::move(mesh));
    }
    throw Error("there is no such ground for crowds", name, "choose flat, hills, slope or kerbs");
}

}  // namespace surefoot::wasm
