#include <surefoot/base/random.h>
#include <surefoot/math/transform.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

Quat random_rotation(Random& random) {
    return normalized(Quat{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
}
Vec3 random_point(Random& random) { return {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)}; }

TEST(Quat, rotating_a_quarter_turn_left_takes_forward_to_the_left) {
    const Vec3 v = rotate(from_yaw(static_cast<float>(k_pi / 2)), {0, 0, 1});
    EXPECT_NEAR(v.x, 1, 1e-6);
    EXPECT_NEAR(v.z, 0, 1e-6);
    EXPECT_NEAR(yaw_of(from_yaw(1.2f)), 1.2f, 1e-6);
}

TEST(Quat, rotation_between_takes_one_direction_to_the_other_even_when_opposite) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Vec3 a = normalized(random_point(random)), b = i % 5 ? normalized(random_point(random)) : -a;
        EXPECT_LT(distance(rotate(rotation_between(a, b), a), b), 2e-3f);
    }
}

TEST(Quat, rotation_vectors_round_trip) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Quat q = random_rotation(random), r = from_rotation_vector(to_rotation_vector(q));
        EXPECT_NEAR(std::fabs(dot(q, r)), 1, 1e-5);
    }
}

TEST(Transform, the_inverse_undoes_and_the_matrix_agrees) {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Transform t{random_rotation(random), random_point(random)};
        const Vec3 p = random_point(random), q = transform_point(t, p);
        EXPECT_LT(distance(transform_point(inverse(t), q), p), 1e-5f);
        const Matrix34 m = to_matrix(t);
        EXPECT_NEAR(m.m[4] * p.x + m.m[5] * p.y + m.m[6] * p.z + m.m[7], q.y, 1e-5);
    }
}

TEST(RootFrame, a_step_between_two_frames_leads_from_one_to_the_other) {
    const RootFrame a{{1, 0, 2}, 0.7f}, b{{-3, 0.5f, 1}, 4.0f}, c = a * between(a, b);
    EXPECT_LT(distance(c.position, b.position), 1e-5f);
    EXPECT_NEAR(c.yaw, b.yaw, 1e-6);
}

}  // namespace
}  // namespace surefoot
