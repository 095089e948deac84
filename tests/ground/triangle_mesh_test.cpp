#include <surefoot/base/random.h>
#include <surefoot/ground/height_field.h>
#include <surefoot/ground/shapes.h>
#include <surefoot/ground/triangle_mesh.h>

#include "tests/ground/ask.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

using test::ask;

SurfaceMesh joined(SurfaceMesh a, const SurfaceMesh& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const std::uint32_t index : b.indices) a.indices.push_back(first + index);
    return a;
}

TEST(TriangleMesh, is_the_surface_that_a_height_field_is) {
    const HeightField hills = make_hills(3);
    const TriangleMesh mesh(hills.mesh());
    Random random(5);
    for (int i = 0; i < 5000; ++i) {
        const float x = random.between(-29, 29), z = random.between(-9, 89);
        const GroundHit a = ask(hills, x, z), b = ask(mesh, x, z);
        ASSERT_TRUE(b.hit);
        EXPECT_NEAR(a.height, b.height, 1e-5f);
        EXPECT_LT(distance(a.normal, b.normal), 1e-4f);
    }
}

TEST(TriangleMesh, no_query_falls_between_two_triangles) {
    // A grid at odd angles, asked along its own edges and corners.
    SurfaceMesh fan;
    fan.positions.push_back({0.1f, 0, 0.2f});
    constexpr std::uint32_t k_blades = 97;
    for (std::uint32_t i = 0; i < k_blades; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(k_blades);
        fan.positions.push_back({3 * std::cos(angle), 0.3f * static_cast<float>(i % 3), 3 * std::sin(angle)});
    }
    for (std::uint32_t i = 0; i < k_blades; ++i)
        fan.indices.insert(fan.indices.end(), {0, 1 + (i + 1) % k_blades, 1 + i});
    const TriangleMesh mesh(fan);
    for (std::uint32_t i = 1; i <= k_blades; ++i)
        for (float share = 0; share < 1; share += 0.01f) {
            const Vec3 p = lerp(fan.positions[0], fan.positions[i], share);
            EXPECT_TRUE(ask(mesh, p.x, p.z).hit) << i << " " << share;
        }
    EXPECT_FALSE(ask(mesh, 3.2f, 0).hit);
    EXPECT_FALSE(ask(mesh, std::nanf(""), 0).hit);
}

TEST(TriangleMesh, a_bridge_is_walked_on_and_under_by_how_far_is_looked) {
    const Plane road, bridge(0, 0, 3);
    const SurfaceMesh both = joined(road.mesh({-10, 10, -10, 10}), bridge.mesh({-2, 2, -10, 10}));
    std::vector<std::uint32_t> surfaces(both.indices.size() / 3, 1);
    surfaces.back() = surfaces[surfaces.size() - 2] = 7;  // the bridge's
    const TriangleMesh mesh(both, surfaces);
    const GroundHit under = ask(mesh, 0.5f, 0.3f, 0, 1.5f, 2), on = ask(mesh, 0.5f, 0.3f, 3, 1.5f, 2);
    EXPECT_EQ(under.height, 0);
    EXPECT_EQ(under.surface, 1u);
    EXPECT_EQ(on.height, 3);
    EXPECT_EQ(on.surface, 7u);
    EXPECT_EQ(ask(mesh, 5, 0.3f, 3, 1, 1).hit, false) << "beside the bridge, too high for the road";
}

TEST(TriangleMesh, walls_are_not_stood_on_and_backs_count_as_fronts) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {3, 1, 0}, {1, 1, 2}};
    mesh.indices = {0, 1, 2, 3, 4, 5};  // upright; the second shows its back from above
    const TriangleMesh ground(mesh);
    EXPECT_FALSE(ask(ground, 0, 0.5f).hit);
    EXPECT_EQ(ask(ground, 1.2f, 0.2f).height, 1);
    EXPECT_EQ(ask(ground, 1.2f, 0.2f).normal, (Vec3{0, 1, 0}));
}

TEST(TriangleMesh, a_query_looks_at_a_few_triangles_however_many_there_are) {
    Random random(1);
    std::vector<float> heights(301 * 301);
    for (float& h : heights) h = random.between(-1, 1);
    const HeightField field(-150, -150, 1, 301, 301, heights);
    const TriangleMesh mesh(field.mesh());  // 180,000 triangles
    for (int i = 0; i < 1000; ++i)
        EXPECT_LE(mesh.candidates_at(random.between(-149, 149), random.between(-149, 149)), 12u);
}

TEST(TriangleMesh, what_is_wrong_with_a_mesh_is_told) {
    EXPECT_EQ(problem(SurfaceMesh{}), "the indices are not three for each triangle");
    EXPECT_EQ(problem(SurfaceMesh{{{0, 0, 0}}, {0, 0, 1}}), "a triangle names a corner that is not there");
    EXPECT_EQ(problem(SurfaceMesh{{{0, std::nanf(""), 0}}, {0, 0, 0}}), "a corner has a coordinate that is no number");
    EXPECT_EQ(problem(SurfaceMesh{{{0, 0, 0}}, {0, 0, 0}}), "");
}

}  // namespace
}  // namespace surefoot
