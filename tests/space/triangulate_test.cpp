// Triangulations against exact properties and against libqhull.

#include <surefoot/base/random.h>
#include <surefoot/space/predicates.h>
#include <surefoot/space/triangulate.h>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace surefoot {
namespace {

using Points = std::vector<LatticePoint>;

/// d! times the volume of the convex hull, by qhull (which starts at two dimensions).
double oracle_hull_volume(int d, const Points& points) {
    if (d == 1) {
        const auto [low, high] = std::minmax_element(points.begin(), points.end());
        return (*high)[0] - (*low)[0];
    }
    std::vector<coordT> flat;
    for (const LatticePoint& p : points)
        for (int k = 0; k < d; ++k) flat.push_back(p[k]);
    qhT qhull;
    qh_zero(&qhull, stderr);
    char options[] = "qhull FA Pp";
    const int failed =
        qh_new_qhull(&qhull, d, static_cast<int>(points.size()), flat.data(), False, options, nullptr, nullptr);
    EXPECT_EQ(failed, 0);
    double volume = failed ? 0 : qhull.totvol;
    int short_memory, blocks;
    qh_freeqhull(&qhull, !qh_ALL);
    qh_memfreeshort(&qhull, &short_memory, &blocks);
    for (int k = 2; k <= d; ++k) volume *= k;
    return volume;
}

std::array<LatticePoint, k_max_dimensions + 1> corners(int d, const Points& points, const Simplex& simplex) {
    std::array<LatticePoint, k_max_dimensions + 1> result{};
    for (int k = 0; k <= d; ++k) result[k] = points[simplex[k]];
    return result;
}

/// The simplices as sets of places: what must not depend on the order of the points.
std::set<std::set<LatticePoint>> by_place(int d, const Points& points, const Triangulation& t) {
    std::set<std::set<LatticePoint>> result;
    for (const Simplex& simplex : t.simplices) {
        std::set<LatticePoint> places;
        for (int k = 0; k <= d; ++k) places.insert(points[simplex[k]]);
        result.insert(places);
    }
    return result;
}

/// Rank of the affine hull by elimination modulo a prime: shares nothing with the code under test.
int rank_modulo_prime(int d, const Points& points) {
    constexpr std::int64_t k_prime = 2147483647;  // differences are smaller, and no minor is likely to be a multiple
    const auto power = [](std::int64_t base, std::int64_t exponent) {
        std::int64_t result = 1;
        for (; exponent > 0; exponent /= 2, base = base * base % k_prime)
            if (exponent % 2) result = result * base % k_prime;
        return result;
    };
    std::vector<std::array<std::int64_t, k_max_dimensions>> rows;
    for (const LatticePoint& p : points) {
        auto& row = rows.emplace_back();
        for (int k = 0; k < d; ++k) row[k] = (p[k] - points[0][k] + k_prime) % k_prime;
    }
    int rank = 0;
    for (int column = 0; column < d; ++column) {
        std::size_t pivot = rank;
        while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
        if (pivot == rows.size()) continue;
        std::swap(rows[rank], rows[pivot]);
        const std::int64_t inverse = power(rows[rank][column], k_prime - 2);
        for (std::size_t r = rank + 1; r < rows.size(); ++r) {
            const std::int64_t factor = rows[r][column] * inverse % k_prime;
            for (int k = column; k < d; ++k)
                rows[r][k] = ((rows[r][k] - factor * rows[rank][k]) % k_prime + k_prime) % k_prime;
        }
        ++rank;
    }
    return rank;
}

/// The points on axes onto which they fall without losing a dimension.
Points dropped_to_rank(int d, int rank, const Points& points) {
    for (unsigned mask = 1; mask < (1u << d); ++mask) {
        Points dropped;
        int count = 0;
        for (const LatticePoint& p : points) {
            auto& q = dropped.emplace_back();
            count = 0;
            for (int k = 0; k < d; ++k)
                if (mask >> k & 1u) q[count++] = p[k];
        }
        if (count == rank && rank_modulo_prime(rank, dropped) == rank) return dropped;
    }
    ADD_FAILURE() << "no projection keeps the rank";
    return points;
}

/// Faces shared by two simplices belong to both, and neither sphere holds the other's far corner. Together with a sum
/// of positive volumes that fills the hull, local emptiness everywhere makes the whole Delaunay.
void check_faces(int d, const Points& places, const Triangulation& t) {
    for (std::size_t s = 0; s < t.simplices.size(); ++s) {
        const auto shape = corners(d, places, t.simplices[s]);
        for (int k = 0; k <= d; ++k) {
            const std::int32_t n = t.neighbours[s][k];
            if (n < 0) continue;
            int shared = 0, far = -1;
            for (int b = 0; b <= d; ++b) {
                bool mine = false;
                for (int a = 0; a <= d; ++a) mine |= a != k && t.simplices[s][a] == t.simplices[n][b];
                shared += mine;
                if (!mine) far = t.simplices[n][b];
            }
            ASSERT_EQ(shared, d);
            ASSERT_EQ(
                t.neighbours[n][std::find(t.simplices[n].begin(), t.simplices[n].end(), far) - t.simplices[n].begin()],
                static_cast<std::int32_t>(s));
            ASSERT_FALSE(in_sphere(d, shape.data(), places[far]));
        }
    }
}

/// Everything that makes a set of simplices the Delaunay triangulation of the points: within the dimensions that they
/// span, simplices of positive volume fill exactly the hull that qhull finds, use every place, and are empty.
/// Returns the rank of the points.
int check(int d, const Points& points) {
    const Triangulation t = triangulate(d, points);
    const int rank = rank_modulo_prime(d, points);
    EXPECT_EQ(t.rank, rank);
    if (t.rank != rank) return rank;
    const std::set<std::int32_t> places(t.same_as.begin(), t.same_as.end());
    std::set<std::int32_t> used;
    for (const Simplex& simplex : t.simplices) {
        EXPECT_EQ(std::count(simplex.begin(), simplex.end(), -1), k_max_dimensions - rank);
        used.insert(simplex.begin(), simplex.begin() + rank + 1);
    }
    EXPECT_EQ(used, places);  // every distinct place is a corner of something, and duplicates of nothing
    if (rank == 0) return rank;

    const Points flat = rank < d ? dropped_to_rank(d, rank, points) : points;
    double total = 0;
    for (const Simplex& simplex : t.simplices) {
        const Wide volume = orientation(rank, corners(rank, flat, simplex).data());
        EXPECT_GT(volume, 0);
        total += static_cast<double>(volume);
    }
    EXPECT_NEAR(total / oracle_hull_volume(rank, flat), 1, 1e-9);
    check_faces(rank, flat, t);
    return rank;
}

Points random_points(Random& random, int d, int count, std::uint32_t steps, std::int32_t pitch) {
    Points points(count);
    for (LatticePoint& p : points)
        for (int k = 0; k < d; ++k) p[k] = static_cast<std::int32_t>(random.below(steps)) * pitch;
    return points;
}

/// Points in a random plane (line, hyperplane) of the space: integer combinations of fewer directions than axes.
Points flat_points(Random& random, int d, int count) {
    const int rank = static_cast<int>(random.below(static_cast<std::uint32_t>(d)));
    std::array<LatticePoint, k_max_dimensions> directions{};
    for (int r = 0; r < rank; ++r)
        for (int k = 0; k < d; ++k) directions[r][k] = static_cast<std::int32_t>(random.below(401)) - 200;
    Points points(count);
    for (LatticePoint& p : points) {
        p.fill(0);
        for (int k = 0; k < d; ++k) p[k] = 32768;
        for (int r = 0; r < rank; ++r) {
            const auto times = static_cast<std::int32_t>(random.below(41)) - 20;
            for (int k = 0; k < d; ++k) p[k] += times * directions[r][k];
        }
    }
    return points;
}

/// Some points stand where others do.
void repeat_some(Random& random, Points& points) {
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t n = random.below(count + 1); n > 0; --n)
        points[random.below(count)] = points[random.below(count)];
}

/// One set after another of the kinds that a space may be made of: tiny, plain, repeated, flat, clustered, fine.
Points any_points(Random& random, int d, int round) {
    const int most = d == 4 ? 16 : 24, few = 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(d) + 2));
    const int some = d + 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(most)));
    switch (round % 8) {
        case 0:
            return random_points(random, d, few, 65536, 1);
        case 1:
            return flat_points(random, d, some);
        case 2:
            return random_points(random, d, some, 40, 1);  // on a patch of the lattice: many near-ties
        case 3: {
            Points points = random_points(random, d, some, 65536, 1);
            repeat_some(random, points);
            return points;
        }
        default:
            return random_points(random, d, some, 65536, 1);
    }
}

/// Sets a dimension. The promised figures take some seconds; under a sanitizer a tenth of them has to do.
int rounds(int promised) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return promised / 10;
#else
    return promised;
#endif
}

/// The in-sphere determinant by Leibniz' sum over permutations: slow, and nothing like the code under test.
Wide plain_determinant(std::vector<std::vector<Wide>> m) {
    std::vector<int> order(m.size());
    for (std::size_t i = 0; i < m.size(); ++i) order[i] = static_cast<int>(i);
    Wide sum = 0;
    do {
        Wide term = 1;
        for (std::size_t i = 0; i < m.size(); ++i) {
            term *= m[i][order[i]];
            for (std::size_t j = 0; j < i; ++j)
                if (order[j] > order[i]) term = -term;
        }
        sum += term;
    } while (std::next_permutation(order.begin(), order.end()));
    return sum;
}

TEST(predicates, orientation_of_unit_simplices_is_one) {
    for (int d = 1; d <= 4; ++d) {
        std::array<LatticePoint, 5> p{};
        for (int k = 0; k < d; ++k) p[k + 1][k] = 1;
        EXPECT_EQ(static_cast<long long>(orientation(d, p.data())), 1) << d;
        std::swap(p[0], p[1]);
        EXPECT_EQ(static_cast<long long>(orientation(d, p.data())), -1) << d;
    }
}

TEST(predicates, in_sphere_agrees_with_a_plain_determinant_on_extreme_coordinates) {
    Random random(7);
    for (int d = 1; d <= 4; ++d) {
        int inside = 0, compared = 0;
        for (int round = 0; round < 2000; ++round) {
            std::array<LatticePoint, 6> p{};
            for (int i = 0; i < d + 2; ++i)
                for (int k = 0; k < d; ++k)
                    p[i][k] = round % 2 ? static_cast<std::int32_t>(random.below(65536))
                                        : static_cast<std::int32_t>(random.below(2)) * 65535;
            const Wide side = orientation(d, p.data());
            if (side == 0) continue;
            if (side < 0) std::swap(p[0], p[1]);
            std::vector<std::vector<Wide>> m(d + 1, std::vector<Wide>(d + 1));
            for (int i = 0; i <= d; ++i)
                for (int k = 0; k < d; ++k) {
                    m[i][k] = p[i][k] - p[d + 1][k];
                    m[i][d] += m[i][k] * m[i][k];
                }
            Wide expected = plain_determinant(m);
            if (d % 2) expected = -expected;
            if (expected == 0) continue;
            ++compared;
            inside += expected > 0;
            ASSERT_EQ(in_sphere(d, p.data(), p[d + 1]), expected > 0) << "d " << d << " round " << round;
        }
        EXPECT_GT(compared, 900) << d;
        EXPECT_GT(inside, 10) << d;
    }
}

TEST(predicates, a_co_circular_square_has_one_answer_whatever_the_order) {
    // Of the two diagonals of a square exactly one is Delaunay once ties are broken.
    const LatticePoint a{0, 0}, b{10, 0}, c{10, 10}, e{0, 10};
    const std::array<LatticePoint, 3> one{a, b, c}, same{b, c, a}, other{a, b, e};
    EXPECT_EQ(in_sphere(2, one.data(), e), in_sphere(2, same.data(), e));
    EXPECT_NE(in_sphere(2, one.data(), e), in_sphere(2, other.data(), c));
}

TEST(triangulate, ten_thousand_random_sets_give_exact_delaunay_simplices_in_every_dimension) {
    for (int d = 1; d <= 4; ++d) {
        Random random(100 + d);
        std::array<int, k_max_dimensions + 1> by_rank{};
        for (int round = 0; round < rounds(10000) && !testing::Test::HasFailure(); ++round)
            ++by_rank[check(d, any_points(random, d, round))];
        EXPECT_GT(by_rank[d], rounds(10000) * 7 / 10) << d;
        for (int rank = 0; rank < d; ++rank) EXPECT_GT(by_rank[rank], rounds(10000) / 200) << d << " " << rank;
    }
}

TEST(triangulate, a_thousand_gridded_sets_full_of_ties_do_too) {
    for (int d = 1; d <= 4; ++d) {
        Random random(200 + d);
        int full = 0;
        for (int round = 0; round < rounds(1000) && !testing::Test::HasFailure(); ++round) {
            const std::uint32_t steps = 2 + random.below(4);
            full += check(d, random_points(random, d, d + 1 + static_cast<int>(random.below(30)), steps,
                                           65535 / (steps - 1))) == d;
        }
        EXPECT_GT(full, rounds(1000) / 2) << d;
    }
}

TEST(triangulate, a_full_grid_splits_into_boxes_of_the_right_volume) {
    for (int d = 1; d <= 4; ++d) {
        Points points;
        const int total = 1 << (2 * d);  // four steps an axis
        for (int i = 0; i < (d == 4 ? 81 : total); ++i) {
            LatticePoint p{};
            const int steps = d == 4 ? 3 : 4;
            for (int k = 0, rest = i; k < d; ++k, rest /= steps) p[k] = rest % steps * 1000;
            points.push_back(p);
        }
        EXPECT_EQ(check(d, points), d);
    }
}

TEST(triangulate, the_result_does_not_depend_on_the_order_of_the_points) {
    for (int d = 1; d <= 4; ++d) {
        Random random(300 + d);
        for (int round = 0; round < 20; ++round) {
            Points points = random_points(random, d, 20, 4, 5000);
            const auto expected = by_place(d, points, triangulate(d, points));
            for (int n = 0; n < 3; ++n) {
                for (std::size_t i = points.size() - 1; i > 0; --i)
                    std::swap(points[i], points[random.below(static_cast<std::uint32_t>(i + 1))]);
                const Triangulation t = triangulate(d, points);
                if (t.rank == d) {
                    ASSERT_EQ(by_place(d, points, t), expected);
                }
            }
        }
    }
}

TEST(triangulate, equal_points_are_merged_into_the_first) {
    const Points points{{0, 0}, {10, 0}, {0, 0}, {0, 10}, {10, 0}};
    const Triangulation t = triangulate(2, points);
    EXPECT_EQ(t.same_as, (std::vector<std::int32_t>{0, 1, 0, 3, 1}));
    ASSERT_EQ(t.simplices.size(), 1u);
    EXPECT_EQ(t.simplices[0][2] + t.simplices[0][1] + t.simplices[0][0], 0 + 1 + 3);
}

TEST(triangulate, points_on_a_line_become_a_chain_of_segments) {
    for (int d = 2; d <= 4; ++d) {
        Points points;
        for (int i = 0; i < 5; ++i) {
            LatticePoint p{};
            for (int k = 0; k < d; ++k) p[k] = 100 + (k == 0 ? 0 : (i * 7) % 5 * 300 * k);
            points.push_back(p);
        }
        const Triangulation t = triangulate(d, points);
        EXPECT_EQ(t.rank, 1);
        ASSERT_EQ(t.simplices.size(), 4u);
        for (const Simplex& simplex : t.simplices) EXPECT_EQ(simplex[2], -1);
    }
}

TEST(triangulate, one_place_is_a_simplex_of_one_corner_and_nothing_is_nothing) {
    const Triangulation one = triangulate(3, Points{{5, 5, 5}, {5, 5, 5}});
    EXPECT_EQ(one.rank, 0);
    EXPECT_EQ(one.simplices.size(), 1u);
    EXPECT_EQ(triangulate(2, Points{}).rank, -1);
}

}  // namespace
}  // namespace surefoot
