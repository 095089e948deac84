#include <surefoot/space/predicates.h>

namespace surefoot {
namespace {

using Row = std::array<std::int64_t, k_max_dimensions>;

std::int64_t minor2(const Row& a, const Row& b, int i, int j) noexcept { return a[i] * b[j] - a[j] * b[i]; }

std::int64_t minor3(const Row& a, const Row& b, const Row& c, int i, int j, int k) noexcept {
    return a[i] * minor2(b, c, j, k) - a[j] * minor2(b, c, i, k) + a[k] * minor2(b, c, i, j);
}

/// Determinant of the first `n` columns of n rows.
Wide determinant(int n, const Row* const* r) noexcept {
    switch (n) {
        case 0:
            return 1;
        case 1:
            return (*r[0])[0];
        case 2:
            return minor2(*r[0], *r[1], 0, 1);
        case 3:
            return minor3(*r[0], *r[1], *r[2], 0, 1, 2);
        default: {
            const Row& a = *r[0];
            return Wide{a[0]} * minor3(*r[1], *r[2], *r[3], 1, 2, 3) -
                   Wide{a[1]} * minor3(*r[1], *r[2], *r[3], 0, 2, 3) +
                   Wide{a[2]} * minor3(*r[1], *r[2], *r[3], 0, 1, 3) -
                   Wide{a[3]} * minor3(*r[1], *r[2], *r[3], 0, 1, 2);
        }
    }
}

Row difference(int dimensions, const LatticePoint& a, const LatticePoint& b) noexcept {
    Row row{};
    for (int k = 0; k < dimensions; ++k) row[k] = std::int64_t{a[k]} - b[k];
    return row;
}

}  // namespace

Wide orientation(int dimensions, const LatticePoint* p) noexcept {
    std::array<Row, k_max_dimensions> rows;
    std::array<const Row*, k_max_dimensions> pointers{};
    for (int i = 0; i < dimensions; ++i) {
        rows[i] = difference(dimensions, p[i + 1], p[0]);
        pointers[i] = &rows[i];
    }
    return determinant(dimensions, pointers.data());
}

bool in_sphere(int dimensions, const LatticePoint* p, const LatticePoint& q) noexcept {
    // The determinant of rows (p_i - q, lift_i), lift_i = |p_i - q|^2 + e_i - e_q, expanded along the lifted column:
    // sum of lift_i * cofactor_i. The cofactors are at the same time the factors of the infinitesimals e_i, and minus
    // their sum is that of e_q. Inside is (-1)^d * determinant > 0 for a positively oriented simplex.
    const int count = dimensions + 1;
    std::array<Row, k_max_dimensions + 1> rows;
    for (int i = 0; i < count; ++i) rows[i] = difference(dimensions, p[i], q);

    std::array<Wide, k_max_dimensions + 1> cofactor;
    Wide sum = 0, cofactors = 0;
    for (int i = 0; i < count; ++i) {
        std::array<const Row*, k_max_dimensions> others{};
        for (int j = 0, n = 0; j < count; ++j)
            if (j != i) others[n++] = &rows[j];
        cofactor[i] = determinant(dimensions, others.data());
        if (i % 2 != 0) cofactor[i] = -cofactor[i];  // (-1)^(i + d) of the expansion times (-1)^d of "inside"
        Wide lift = 0;
        for (int k = 0; k < dimensions; ++k) lift += rows[i][k] * rows[i][k];
        sum += lift * cofactor[i];
        cofactors += cofactor[i];
    }
    if (sum != 0) return sum > 0;

    std::array<const LatticePoint*, k_max_dimensions + 2> order{};
    for (int i = 0; i < count; ++i) order[i] = &p[i];
    order[count] = &q;
    sort_few(order.data(), count + 1, [](const LatticePoint* a, const LatticePoint* b) { return *a < *b; });
    for (int n = 0; n <= count; ++n) {
        const LatticePoint* point = order[n];
        const Wide factor = point == &q ? -cofactors : cofactor[point - p];
        if (factor != 0) return factor > 0;
    }
    return false;  // not reached: the factor of q is the simplex's own volume
}

int affine_rank(int dimensions, std::span<const LatticePoint> points,
                std::array<std::int32_t, k_max_dimensions + 1>& basis) noexcept {
    basis.fill(-1);
    if (points.empty()) return -1;
    basis[0] = 0;
    // Fraction-free elimination (Bareiss): every entry is a minor of the differences, so the products of step k, of two
    // (k - 1)-minors, stay below 2^102 (see the budget in the header).
    std::array<std::array<Wide, k_max_dimensions>, k_max_dimensions> reduced{};
    std::array<int, k_max_dimensions> pivot{};
    int rank = 0;
    for (std::size_t i = 1; i < points.size() && rank < dimensions; ++i) {
        const Row start = difference(dimensions, points[i], points[0]);
        std::array<Wide, k_max_dimensions> row{};
        for (int k = 0; k < dimensions; ++k) row[k] = start[k];
        Wide previous = 1;
        for (int r = 0; r < rank; ++r) {
            const Wide head = row[pivot[r]], lead = reduced[r][pivot[r]];
            for (int k = 0; k < dimensions; ++k) row[k] = (row[k] * lead - reduced[r][k] * head) / previous;
            previous = lead;
        }
        for (int k = 0; k < dimensions; ++k) {
            if (row[k] == 0) continue;
            reduced[rank] = row;
            pivot[rank] = k;
            basis[++rank] = static_cast<std::int32_t>(i);
            break;
        }
    }
    return rank;
}

}  // namespace surefoot
