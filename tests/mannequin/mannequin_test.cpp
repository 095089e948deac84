#include <surefoot/base/random.h>
#include <surefoot/mannequin/mannequin.h>
#include <surefoot/rig_text/rig_template.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace surefoot {
namespace {

/// A plain T-pose figure of 1.75 m; the parts that rigs often lack can be left out.
struct Figure {
    Skeleton skeleton;
    RoleMap roles;
    std::vector<Transform> models;
};

struct FigureParts {
    bool toes = true, arms = true, chest = true, neck = true;
    float scale = 1;
    Quat turn = {};  ///< every joint's rest axes, as importers deliver them
};

Figure make_figure(const FigureParts& parts = {}) {
    Figure f;
    std::vector<Vec3> places;
    const auto add = [&](Role role, Role parent, Vec3 place) {
        const int at = parent == Role::count ? k_no_joint : f.roles[parent];
        const Vec3 origin = at < 0 ? Vec3{} : places[static_cast<std::size_t>(at)];
        const Vec3 offset = (place * parts.scale - origin);
        const bool top = at < 0;
        const Transform local{top ? parts.turn : Quat{}, top ? offset : rotate(conjugate(parts.turn), offset)};
        places.push_back(place * parts.scale);
        f.roles.set(role, f.skeleton.add(std::string(role_name(role)), at, local));
    };
    add(Role::hips, Role::count, {0, 0.95f, 0});
    add(Role::spine, Role::hips, {0, 1.02f, 0});
    if (parts.chest) add(Role::chest, Role::spine, {0, 1.15f, 0});
    const Role top = parts.chest ? Role::chest : Role::spine;
    if (parts.neck) add(Role::neck, top, {0, 1.45f, 0});
    add(Role::head, parts.neck ? Role::neck : top, {0, 1.53f, 0});
    for (const bool left : {true, false}) {
        const float x = left ? 1.0f : -1.0f;
        const auto of = [&](Role role) { return left ? role : mirrored(role); };
        if (parts.arms) {
            add(of(Role::left_upper_arm), top, {0.19f * x, 1.40f, 0});
            add(of(Role::left_lower_arm), of(Role::left_upper_arm), {0.51f * x, 1.40f, 0});
            add(of(Role::left_hand), of(Role::left_lower_arm), {0.77f * x, 1.40f, 0});
        }
        add(of(Role::left_upper_leg), Role::hips, {0.09f * x, 0.92f, 0});
        add(of(Role::left_lower_leg), of(Role::left_upper_leg), {0.09f * x, 0.49f, 0});
        add(of(Role::left_foot), of(Role::left_lower_leg), {0.09f * x, 0.07f, 0});
        if (parts.toes) add(of(Role::left_toes), of(Role::left_foot), {0.09f * x, 0.01f, 0.13f});
    }
    f.models.resize(places.size());
    local_to_model(f.skeleton, f.skeleton.rest, f.models);
    return f;
}

Mesh mannequin_of(const Figure& f) { return make_mannequin(f.skeleton, f.roles, f.models); }

/// Every edge is used once in each direction: closed, and faces turned the same way.
bool is_closed(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}];
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        const auto back = edges.find({edge.first.second, edge.first.first});
        return edge.second == 1 && back != edges.end() && back->second == 1;
    });
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        sum += dot(mesh.positions[mesh.indices[i]],
                   cross(mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]])) /
               6;
    return sum;
}

/// Positions in another pose by linear blend skinning, as viewers do it.
std::vector<Vec3> skinned(const Mesh& mesh, const Figure& f, const std::vector<Transform>& locals) {
    std::vector<Transform> posed(locals.size());
    local_to_model(f.skeleton, locals, posed);
    std::vector<Vec3> out(mesh.positions.size());
    for (std::size_t v = 0; v < out.size(); ++v)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t j = mesh.joints[v][k];
            out[v] += mesh.weights[v][k] * transform_point(posed[j] * inverse(f.models[j]), mesh.positions[v]);
        }
    return out;
}

/// Arrays of equal length, finite places, unit normals, and weights of joints that there are, adding up to one.
void expect_sound_skin(const Mesh& mesh, const Figure& f) {
    const std::size_t n = mesh.positions.size();
    ASSERT_EQ(mesh.normals.size(), n);
    ASSERT_EQ(mesh.joints.size(), n);
    ASSERT_EQ(mesh.weights.size(), n);
    for (std::size_t v = 0; v < n; ++v) {
        EXPECT_TRUE(is_finite(mesh.positions[v]));
        EXPECT_NEAR(length(mesh.normals[v]), 1, 1e-4f);
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_GE(mesh.weights[v][k], 0);
            EXPECT_LT(mesh.joints[v][k], f.skeleton.joint_count());
            sum += mesh.weights[v][k];
        }
        EXPECT_NEAR(sum, 1, 1e-5f);
    }
    for (std::uint32_t i : mesh.indices) EXPECT_LT(i, n);
}

class AnyFigure : public ::testing::TestWithParam<int> {
  protected:
    static Figure figure(int kind) {
        switch (kind) {
            case 0:
                return make_figure();
            case 1:
                return make_figure({.toes = false});
            case 2:
                return make_figure({.arms = false, .chest = false});
            case 3:
                return make_figure({.neck = false, .scale = 0.6f});
            default:
                return make_figure({.turn = normalized(Quat{0.5f, -0.5f, 0.5f, 0.5f})});
        }
    }
};

TEST_P(AnyFigure, is_clothed_by_a_sound_closed_mesh) {
    const Figure f = figure(GetParam());
    const Mesh mesh = mannequin_of(f);
    const std::size_t n = mesh.positions.size();
    ASSERT_GT(n, 500u);
    EXPECT_LE(mesh.indices.size() / 3, 6500u);
    expect_sound_skin(mesh, f);
    EXPECT_TRUE(is_closed(mesh));
}

TEST_P(AnyFigure, stands_on_the_floor_with_faces_turned_outward) {
    const Figure f = figure(GetParam());
    const Mesh mesh = mannequin_of(f);
    float low = 1;
    for (Vec3 p : mesh.positions) low = std::min(low, p.y);
    EXPECT_NEAR(low, 0, 1e-4f);
    // A body of 1.75 m has some 70 litres; overlaps count twice.
    const double scale = GetParam() == 3 ? 0.216 : 1;
    EXPECT_GT(volume(mesh), 0.035 * scale);
    EXPECT_LT(volume(mesh), 0.110 * scale);
}

/// Corners of the box around a mesh.
std::pair<Vec3, Vec3> box_of(const Mesh& mesh) {
    Vec3 low{9, 9, 9}, high{-9, -9, -9};
    for (Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return {low, high};
}

Mesh low_mannequin_of(const Figure& f, int corners) {
    return make_low_mannequin(f.skeleton, f.roles, make_legs(f.skeleton, f.roles, f.models, 0), f.models, corners);
}

TEST_P(AnyFigure, wears_a_body_of_few_triangles_as_large_as_the_fine_one) {
    const Figure f = figure(GetParam());
    const Mesh fine = mannequin_of(f);
    const auto [fine_low, fine_high] = box_of(fine);
    for (const int corners : {4, 6, 8}) {
        SCOPED_TRACE(corners);
        const Mesh mesh = low_mannequin_of(f, corners);
        expect_sound_skin(mesh, f);
        EXPECT_TRUE(is_closed(mesh));
        EXPECT_LE(mesh.indices.size() / 3, static_cast<std::size_t>(80 * corners));
        const auto [low, high] = box_of(mesh);
        const float size = f.models[0].translation.y;
        EXPECT_NEAR(low.y, 0, 1e-4f);
        EXPECT_NEAR(high.y, fine_high.y, 0.02f * size);
        EXPECT_NEAR(high.x, fine_high.x, 0.05f * size);
        EXPECT_NEAR(low.x, fine_low.x, 0.05f * size);
        EXPECT_NEAR(volume(mesh) / volume(fine), 1, 0.15);
    }
}

INSTANTIATE_TEST_SUITE_P(Mannequin, AnyFigure, ::testing::Range(0, 5));

TEST(Mannequin, covers_head_hands_and_toes) {
    const Figure f = make_figure();
    const Mesh mesh = mannequin_of(f);
    const auto [low, high] = box_of(mesh);
    EXPECT_NEAR(high.y, 1.74f, 0.03f);
    EXPECT_NEAR(high.x, 0.96f, 0.03f);
    EXPECT_NEAR(low.x, -0.96f, 0.03f);
    EXPECT_GT(high.z, 0.15f);
}

TEST(Mannequin, is_the_same_whatever_the_axes_of_the_joints) {
    const Mesh plain = mannequin_of(make_figure());
    const Mesh turned = mannequin_of(make_figure({.turn = axis_angle({0, 0, 1}, 1.1f)}));
    ASSERT_EQ(plain.positions.size(), turned.positions.size());
    for (std::size_t v = 0; v < plain.positions.size(); ++v)
        EXPECT_LT(distance(plain.positions[v], turned.positions[v]), 1e-4f);
}

TEST(Mannequin, neither_tears_nor_collapses_at_a_bent_knee_and_a_raised_arm) {
    const Figure f = make_figure();
    const Mesh mesh = mannequin_of(f);
    std::vector<Transform> pose = f.skeleton.rest;
    const auto bend = [&](Role role, Vec3 axis, float degrees) {
        pose[static_cast<std::size_t>(f.roles[role])].rotation = axis_angle(axis, degrees * k_radians_per_degree);
    };
    bend(Role::left_upper_leg, {1, 0, 0}, -60);
    bend(Role::left_lower_leg, {1, 0, 0}, 90);
    bend(Role::right_upper_arm, {0, 0, 1}, -70);
    bend(Role::left_upper_arm, {0, 0, 1}, -80);
    bend(Role::left_lower_arm, {0, 1, 0}, -90);
    const std::vector<Vec3> posed = skinned(mesh, f, pose);
    // No edge grows to more than 2.2 times its length (beyond a centimetre), and the volume stays.
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
            const float before = distance(mesh.positions[a], mesh.positions[b]);
            EXPECT_LT(distance(posed[a], posed[b]), 2.2f * before + 0.01f)
                << mesh.positions[a].x << " " << mesh.positions[a].y << " " << mesh.positions[a].z;
        }
    Mesh moved = mesh;
    moved.positions = posed;
    EXPECT_NEAR(volume(moved) / volume(mesh), 1, 0.06);
}

/// How many pieces a mesh is made of.
int pieces(const Mesh& mesh) {
    std::vector<std::uint32_t> head(mesh.positions.size());
    for (std::uint32_t v = 0; v < head.size(); ++v) head[v] = v;
    const auto find = [&](std::uint32_t v) {
        while (head[v] != v) v = head[v] = head[head[v]];
        return v;
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 1; k < 3; ++k) head[find(mesh.indices[i])] = find(mesh.indices[i + k]);
    int count = 0;
    for (std::uint32_t v = 0; v < head.size(); ++v) count += head[v] == v;
    return count;
}

/// A bundled template as a figure.
Figure rig_figure(const char* name, std::vector<std::string> set = {}) {
    const Rig rig = make_rig(name, set);
    Figure f{*rig.skeleton, rig.roles, {}};
    f.models.resize(f.skeleton.rest.size());
    local_to_model(f.skeleton, f.skeleton.rest, f.models);
    return f;
}

TEST(Mannequin, is_one_skin_from_the_toes_to_the_crown) {
    EXPECT_EQ(pieces(mannequin_of(make_figure())), 3);  // and two thumbs
    EXPECT_EQ(pieces(mannequin_of(make_figure({.arms = false}))), 1);
    EXPECT_EQ(pieces(mannequin_of(rig_figure("adult", {"fingers=1"}))), 11);
}

class AnyTemplate : public ::testing::TestWithParam<const char*> {};

TEST_P(AnyTemplate, wears_a_closed_skin_that_bends_without_tearing_or_collapsing) {
    for (const char* spine : {"spine=1", "spine=3", "spine=9"})
        for (const char* toes : {"toes=0", "toes=1"}) {
            SCOPED_TRACE(std::string(spine) + " " + toes);
            const Figure f = rig_figure(GetParam(), {spine, toes, "fingers=1"});
            const Mesh mesh = mannequin_of(f);
            ASSERT_TRUE(is_closed(mesh));
            EXPECT_LE(mesh.indices.size() / 3, 8000u);
            float low = 1;
            for (Vec3 p : mesh.positions) low = std::min(low, p.y);
            EXPECT_NEAR(low, 0, 2e-3f);
            std::vector<Transform> pose = f.skeleton.rest;
            const auto bend = [&](Role role, Vec3 axis, float degrees) {
                pose[static_cast<std::size_t>(f.roles[role])].rotation =
                    axis_angle(axis, degrees * k_radians_per_degree);
            };
            bend(Role::left_upper_leg, {1, 0, 0}, -70);
            bend(Role::left_lower_leg, {1, 0, 0}, 60);
            bend(Role::right_upper_leg, {1, 0, 0}, 15);
            bend(Role::right_foot, {1, 0, 0}, 30);
            bend(Role::left_upper_arm, {0, 0, 1}, 60);
            bend(Role::right_upper_arm, {0, 0, 1}, 75);
            bend(Role::left_lower_arm, {0, 1, 0}, -110);
            bend(Role::spine, {1, 0, 0}, 20);
            bend(Role::head, {0, 1, 0}, 40);
            Mesh moved = mesh;
            moved.positions = skinned(mesh, f, pose);
            EXPECT_NEAR(volume(moved) / volume(mesh), 1, 0.08);
            const float size = f.models[0].translation.y;
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
                    const float before = distance(mesh.positions[a], mesh.positions[b]);
                    EXPECT_LT(distance(moved.positions[a], moved.positions[b]), 2.5f * before + 0.015f * size)
                        << mesh.positions[a].x << " " << mesh.positions[a].y << " " << mesh.positions[a].z;
                }
        }
}

INSTANTIATE_TEST_SUITE_P(Mannequin, AnyTemplate,
                         ::testing::Values("adult", "child", "giant", "long_arms", "toe_walker"));

TEST(Mannequin, of_few_triangles_bends_with_the_fine_one) {
    const Figure f = rig_figure("adult");
    std::vector<Transform> pose = f.skeleton.rest;
    const auto bend = [&](Role role, Vec3 axis, float degrees) {
        pose[static_cast<std::size_t>(f.roles[role])].rotation = axis_angle(axis, degrees * k_radians_per_degree);
    };
    bend(Role::left_upper_leg, {1, 0, 0}, -50);
    bend(Role::left_lower_leg, {1, 0, 0}, 60);
    bend(Role::right_foot, {1, 0, 0}, 30);
    bend(Role::left_lower_arm, {0, 1, 0}, -80);
    bend(Role::spine, {1, 0, 0}, 20);
    const std::vector<Vec3> fine = skinned(mannequin_of(f), f, pose);
    for (const int corners : {4, 6, 8}) {
        const Mesh mesh = low_mannequin_of(f, corners);
        const std::vector<Vec3> posed = skinned(mesh, f, pose);
        for (std::size_t v = 0; v < posed.size(); ++v) {
            float nearest = 1;
            for (Vec3 p : fine) nearest = std::min(nearest, distance(posed[v], p));
            EXPECT_LT(nearest, 0.12f) << corners << " corners, vertex " << v;
        }
        Mesh moved = mesh;
        moved.positions = posed;
        EXPECT_NEAR(volume(moved) / volume(mesh), 1, 0.1);
    }
}

TEST(Mannequin, keeps_its_knees_and_elbows_when_they_bend_by_120_degrees) {
    const Figure f = rig_figure("adult");
    const Mesh mesh = mannequin_of(f);
    std::vector<Transform> pose = f.skeleton.rest;
    pose[static_cast<std::size_t>(f.roles[Role::left_lower_leg])].rotation =
        axis_angle({1, 0, 0}, 120 * k_radians_per_degree);
    std::vector<Transform> posed(pose.size());
    local_to_model(f.skeleton, pose, posed);
    const std::vector<Vec3> skin = skinned(mesh, f, pose);
    const Vec3 knee = posed[static_cast<std::size_t>(f.roles[Role::left_lower_leg])].translation;
    // Outward of the bend: forward and up, half-way between thigh and shank. Across: the hinge's axis.
    const Vec3 out = normalized(Vec3{0, -0.5f, 0.866f});
    float before = 0, outside = 0, across = 0;
    for (std::size_t v = 0; v < skin.size(); ++v) {
        if (distance(mesh.positions[v], f.models[static_cast<std::size_t>(f.roles[Role::left_lower_leg])].translation) >
            0.12f)
            continue;
        before = std::max(before, mesh.positions[v].z);
        outside = std::max(outside, dot(skin[v] - knee, out));
        across = std::max(across, skin[v].x - knee.x);
    }
    EXPECT_GT(outside, 0.5f * before);
    EXPECT_GT(across, 0.045f);
}

TEST(Mannequin, is_bound_to_the_clip_where_the_rest_pose_is_twisted) {
    // A rest pose whose shanks are turned half around themselves against how the clip holds them: a skin bound to it
    // would shrink to nothing at the knee.
    Figure f = make_figure();
    auto skeleton = std::make_shared<Skeleton>(f.skeleton);
    Motion sound = make_motion(skeleton, "sound", 3, 30), twisted = sound;
    const Quat half{0, 1, 0, 0};  // about the bone, which hangs down
    for (Motion* m : {&sound, &twisted})
        for (int frame = 0; frame < 3; ++frame)
            m->frame(frame)[static_cast<std::size_t>(f.roles[Role::left_lower_leg])].rotation =
                axis_angle({1, 0, 0}, 0.2f + 0.3f * static_cast<float>(frame == 0));
    for (int frame = 0; frame < 3; ++frame) {
        const auto pose = twisted.frame(frame);
        for (Role role : {Role::left_lower_leg, Role::right_lower_leg}) {
            Quat& q = pose[static_cast<std::size_t>(f.roles[role])].rotation;
            q = q * half;
        }
    }
    EXPECT_EQ(mannequin_bind_frame(sound, f.roles), -1);
    EXPECT_EQ(mannequin_bind_frame(twisted, f.roles), 1);
    const Legs legs = make_legs(f.skeleton, f.roles, f.models, 0);
    EXPECT_TRUE(make_mannequin(sound, f.roles, legs).bind.empty());
    const Mesh mesh = make_mannequin(twisted, f.roles, legs);
    ASSERT_EQ(mesh.bind.size(), f.models.size());
    EXPECT_NE(mesh.bind, f.models);
    EXPECT_TRUE(is_closed(mesh));
}

TEST(Mannequin, stays_finite_and_closed_on_senseless_skeletons) {
    Random random(11);
    for (int round = 0; round < 60; ++round) {
        Figure f = make_figure({.toes = random.below(2) == 0, .chest = random.below(2) == 0});
        for (Transform& rest : f.skeleton.rest) {
            const auto turn = [&] { return random.between(-3.0f, 3.0f); };
            rest.rotation = from_rotation_vector({turn(), turn(), turn()});
            if (random.below(4) == 0) rest.translation = {};
            if (random.below(4) == 0) rest.translation = {turn(), turn(), turn()};
        }
        local_to_model(f.skeleton, f.skeleton.rest, f.models);
        const Mesh mesh = mannequin_of(f);
        EXPECT_TRUE(std::all_of(mesh.positions.begin(), mesh.positions.end(), [](Vec3 p) { return is_finite(p); }));
        EXPECT_TRUE(std::all_of(mesh.normals.begin(), mesh.normals.end(),
                                [](Vec3 n) { return std::fabs(length(n) - 1) < 1e-3f; }));
        EXPECT_TRUE(is_closed(mesh)) << round;
        const Mesh low = low_mannequin_of(f, 4);
        EXPECT_TRUE(std::all_of(low.positions.begin(), low.positions.end(), [](Vec3 p) { return is_finite(p); }));
        EXPECT_TRUE(is_closed(low)) << round;
    }
}

TEST(Mannequin, is_the_same_every_time) {
    const Mesh a = mannequin_of(make_figure()), b = mannequin_of(make_figure());
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.weights, b.weights);
    EXPECT_EQ(a.indices, b.indices);
}

}  // namespace
}  // namespace surefoot
