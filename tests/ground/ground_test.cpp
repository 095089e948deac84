#include <surefoot/ground/height_field.h>
#include <surefoot/ground/shapes.h>

#include "tests/ground/ask.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

using test::ask;

/// Height of a mesh under (x, z), found by searching its triangles seen from above; NaN where there is none.
float mesh_height(const SurfaceMesh& mesh, float x, float z) {
    float best = std::nanf("");
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                   c = mesh.positions[mesh.indices[t + 2]];
        const float area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
        if (std::fabs(area) < 1e-9f) continue;
        const float v = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / area;
        const float w = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / area;
        if (v < 0 || w < 0 || v + w > 1) continue;
        const float y = a.y + v * (b.y - a.y) + w * (c.y - a.y);
        if (!(best > y)) best = y;
    }
    return best;
}

/// Every triangle faces up or sideways: none shows its back from above.
void expect_mesh_faces_up(const SurfaceMesh& mesh) {
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                   c = mesh.positions[mesh.indices[t + 2]];
        EXPECT_GE(cross(b - a, c - a).y, -1e-6f) << "triangle " << t / 3;
    }
}

TEST(HeightField, heights_are_barycentric_in_the_two_triangles_of_a_quad) {
    const HeightField field(0, 0, 4, 2, 2, {0, 1, 2, 5});
    EXPECT_FLOAT_EQ(ask(field, 0, 0).height, 0);
    EXPECT_FLOAT_EQ(ask(field, 4, 0).height, 1);
    EXPECT_FLOAT_EQ(ask(field, 0, 4).height, 2);
    EXPECT_FLOAT_EQ(ask(field, 4, 4).height, 5);
    EXPECT_FLOAT_EQ(ask(field, 1, 1).height, 0.75f);  // near triangle: 0 + 1/4 * 1 + 1/4 * 2
    EXPECT_FLOAT_EQ(ask(field, 3, 3).height, 3.25f);  // far triangle: 5 - 1/4 * (5 - 2) - 1/4 * (5 - 1)
    EXPECT_FLOAT_EQ(ask(field, 2, 2).height, 1.5f);   // on the diagonal: the mean of its ends
}

TEST(HeightField, normals_are_those_of_the_triangles) {
    const HeightField field(0, 0, 4, 2, 2, {0, 1, 2, 5});
    const Vec3 near = ask(field, 1, 1).normal, far = ask(field, 3, 3).normal;
    EXPECT_LT(distance(near, normalized({-0.25f, 1, -0.5f})), 1e-6f);
    EXPECT_LT(distance(far, normalized({-0.75f, 1, -1.0f})), 1e-6f);
}

TEST(HeightField, the_rim_goes_on_outside_and_is_level) {
    const HeightField field(0, 0, 4, 2, 2, {0, 1, 2, 5});
    EXPECT_FLOAT_EQ(ask(field, -10, -10).height, 0);
    EXPECT_FLOAT_EQ(ask(field, 50, 50).height, 5);
    EXPECT_EQ(ask(field, 50, 50).normal, k_up);
}

TEST(HeightField, what_is_out_of_reach_is_no_hit) {
    const HeightField field(0, 0, 4, 2, 2, {3, 3, 3, 3});
    EXPECT_FALSE(ask(field, 1, 1, 0, 1, 1).hit);
    EXPECT_TRUE(ask(field, 1, 1, 0, 3.5f, 1).hit);
    EXPECT_TRUE(ask(field, 1, 1, 5, 0, 2.5f).hit);
    EXPECT_FALSE(ask(field, 1, 1, 5, 0, 1).hit);
}

TEST(HeightField, the_mesh_is_the_surface_that_queries_see) {
    const HeightField hills = make_hills();
    const SurfaceMesh mesh = hills.mesh();
    expect_mesh_faces_up(mesh);
    float low = 9, high = -9;
    for (float z = -9; z < 60; z += 1.37f)
        for (float x = -7; x < 7; x += 1.91f) {
            const float h = ask(hills, x, z).height;
            EXPECT_NEAR(mesh_height(mesh, x, z), h, 1e-4f) << x << ", " << z;
            low = std::fmin(low, h);
            high = std::fmax(high, h);
        }
    EXPECT_LT(low, -0.2f);
    EXPECT_GT(high, 0.2f);
    EXPECT_GE(low, -0.5f);
    EXPECT_LE(high, 0.5f);
}

TEST(Hills, a_seed_gives_the_same_hills_and_another_seed_others) {
    EXPECT_EQ(ask(make_hills(1), 3, 3).height, ask(make_hills(1), 3, 3).height);
    EXPECT_NE(ask(make_hills(1), 3, 3).height, ask(make_hills(2), 3, 3).height);
}

TEST(Shapes, a_ramp_rises_between_its_ends_only) {
    const Ramp ramp(0.5f, 2, 6);
    EXPECT_FLOAT_EQ(ask(ramp, 0, 1).height, 0);
    EXPECT_FLOAT_EQ(ask(ramp, 3, 4).height, 1);
    EXPECT_FLOAT_EQ(ask(ramp, 0, 9).height, 2);
    EXPECT_LT(distance(ask(ramp, 0, 4).normal, normalized({0, 1, -0.5f})), 1e-6f);
    EXPECT_EQ(ask(ramp, 0, 9).normal, k_up);
}

TEST(Shapes, stairs_count_their_risers_up_and_down) {
    const Stairs up(0.17f, 0.28f, 3, 4), down(-0.17f, 0.28f, 3, 4);
    EXPECT_FLOAT_EQ(ask(up, 0, 2.99f).height, 0);
    EXPECT_FLOAT_EQ(ask(up, 0, 3.01f).height, 0.17f);
    EXPECT_FLOAT_EQ(ask(up, 0, 3.30f).height, 0.34f);
    EXPECT_FLOAT_EQ(ask(up, 0, 30).height, 0.68f);
    EXPECT_FLOAT_EQ(ask(down, 0, 3.30f).height, -0.34f);
}

TEST(Shapes, meshes_are_the_surfaces_that_queries_see) {
    const Extent extent{-4, 4, -2, 12};
    const Ramp ramp(-0.3f, 2, 6);
    const Stairs stairs(0.17f, 0.28f, 3, 10);
    const Stairs down(-0.17f, 0.28f, 3, 10);
    const Bands bands(0.12f, 0.577f, {{4, 6}, {8, 9}});
    const Tiles tiles(0.3f, 0.08f, 2, 1);
    const Plane plane(0.27f, 0.1f);
    const std::pair<const Ground*, SurfaceMesh> grounds[] = {
        {&ramp, ramp.mesh(extent)},   {&stairs, stairs.mesh(extent)}, {&down, down.mesh(extent)},
        {&bands, bands.mesh(extent)}, {&tiles, tiles.mesh(extent)},   {&plane, plane.mesh(extent)}};
    for (const auto& [ground, mesh] : grounds) {
        expect_mesh_faces_up(mesh);
        for (float z = -1.003f; z < 11; z += 0.371f)
            for (float x = -2.007f; x < 2; x += 0.533f)
                EXPECT_NEAR(mesh_height(mesh, x, z), ask(*ground, x, z).height, 1e-4f) << x << ", " << z;
    }
}

TEST(Shapes, far_away_places_are_answered_too) {
    const Tiles tiles(0.3f, 0.08f, 2, 1);
    EXPECT_TRUE(std::isfinite(ask(tiles, 1e20f, -1e20f).height));
    EXPECT_TRUE(std::isfinite(ask(make_hills(), -1e20f, 1e20f).height));
}

}  // namespace
}  // namespace surefoot
