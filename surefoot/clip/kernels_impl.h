#pragma once
// The kernels' one text, instantiated for each instruction set and for the scalar twin (kernels_*.cpp).

#include <surefoot/clip/block_sum.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

// Values are q * 32767, so a sum shorter than one unit is no rotation: opposite keys have cancelled out.
inline constexpr float k_least_square = 1.0f;

template <class T>
SUREFOOT_INLINE Quat8<T> sum_block(const KeyPair* pairs, int count, int block) noexcept {
    BlockSum<T> sum;
    for (int i = 0; i < count; ++i) sum.add(pairs[i], block);
    return sum.rotations();
}

template <class T>
SUREFOOT_INLINE Quat8<T> load_block(const float* sums, int block) noexcept {
    using F = Float8<T>;
    const float* from = sums + block * 32;
    return {F::load(from), F::load(from + 8), F::load(from + 16), F::load(from + 24)};
}

template <class T>
SUREFOOT_INLINE void add(const Quat8<T>& q, Quat8<T>& sum) noexcept {
    sum.x += q.x;
    sum.y += q.y;
    sum.z += q.z;
    sum.w += q.w;
}

// Where a joint turns more than half a revolution from rest, the signs of two clips need not agree: each leaf joins on
// the side of the sum so far, and one of negative weight, which comes after those, on the other.
template <class T>
SUREFOOT_INLINE Quat8<T> sum_turning_block(const KeyPair* pairs, int count, int block, Quat8<T> sum) noexcept {
    using F = Float8<T>;
    const F zero = F::splat(0);
    for (int i = 0; i < count; ++i) {
        const Quat8<T> leaf = sum_block<T>(pairs + i, 1, block);
        const F towards = F::splat(pairs[i].weight < 0 ? -1.0f : 1.0f);
        const F side = (sum.x * leaf.x + sum.y * leaf.y + sum.z * leaf.z + sum.w * leaf.w) * towards;
        const Mask8<T> other = side < zero;
        sum.x += select(other, -leaf.x, leaf.x);
        sum.y += select(other, -leaf.y, leaf.y);
        sum.z += select(other, -leaf.z, leaf.z);
        sum.w += select(other, -leaf.w, leaf.w);
    }
    return sum;
}

template <class T>
void blend_rotations(const KeyPair* pairs, int count, const float* sums, int joints, float* out, std::size_t stride) {
    using F = Float8<T>;
    const F zero = F::splat(0);
    const int blocks = (joints + 7) / 8;
    bool may_turn = false;
    for (int i = 0; i < count; ++i) may_turn |= pairs[i].turning != nullptr;
    for (int block = 0; block < blocks; ++block) {
        bool turns = false;
        if (may_turn)
            for (int i = 0; i < count; ++i) turns |= pairs[i].turning != nullptr && pairs[i].turning[block] != 0;
        Quat8<T> sum{zero, zero, zero, zero};
        if (turns) {
            if (sums != nullptr) sum = load_block<T>(sums, block);
            sum = sum_turning_block<T>(pairs, count, block, sum);
        } else {
            sum = sum_block<T>(pairs, count, block);
            if (sums != nullptr) add<T>(load_block<T>(sums, block), sum);
        }
        const F square = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z + sum.w * sum.w;
        const F scale = rsqrt(max(square, F::splat(k_least_square)));
        const F quads[4] = {sum.x * scale, sum.y * scale, sum.z * scale, sum.w * scale};
        const int lanes = joints - block * 8 < 8 ? joints - block * 8 : 8;
        float* to = out + static_cast<std::size_t>(block) * 8 * stride;
        if (lanes == 8) {
            store_quads(quads, [&](int lane) noexcept { return to + static_cast<std::size_t>(lane) * stride; });
        } else {
            float all[32];
            store_quads(quads, [&](int lane) noexcept { return all + 4 * lane; });
            for (int lane = 0; lane < lanes; ++lane)
                std::memcpy(to + static_cast<std::size_t>(lane) * stride, all + 4 * lane, 4 * sizeof(float));
        }
    }
}

template <class T>
void add_turns(const float* turns, const std::int16_t* middle, int joints, float weight, float* sums) {
    using F = Float8<T>;
    const F share = F::splat(weight);
    for (int block = 0; block < (joints + 7) / 8; ++block) {
        const float* turn = turns + block * 24;
        const std::int16_t* from = middle + block * 32;
        const F x = F::load(turn), y = F::load(turn + 8), z = F::load(turn + 16);
        const F w = sqrt(max(1.0f - (x * x + y * y + z * z), F::splat(0)));
        const Quat8<T> about{F::load_int16(from), F::load_int16(from + 8), F::load_int16(from + 16),
                             F::load_int16(from + 24)};
        const Quat8<T> q = multiply(about, Quat8<T>{x, y, z, w}), sum = load_block<T>(sums, block);
        float* to = sums + block * 32;
        (sum.x + share * q.x).store(to);
        (sum.y + share * q.y).store(to + 8);
        (sum.z + share * q.z).store(to + 16);
        (sum.w + share * q.w).store(to + 24);
    }
}

// Model transforms of one joint for eight characters; rows come as [qx qy qz qw tx ty tz -].
template <class T>
SUREFOOT_INLINE void model_of_joint(const Float8<T> (&local)[8], const float* parent, float* model) noexcept {
    using F = Float8<T>;
    Quat8<T> q{local[0], local[1], local[2], local[3]};
    Vec8<T> p{local[4], local[5], local[6]};
    if (parent != nullptr) {
        const Quat8<T> up{F::load(parent), F::load(parent + 8), F::load(parent + 16), F::load(parent + 24)};
        q = multiply(up, q);
        const Vec8<T> r = rotate(up, p);
        p = {F::load(parent + 32) + r.x, F::load(parent + 40) + r.y, F::load(parent + 48) + r.z};
    }
    q.x.store(model);
    q.y.store(model + 8);
    q.z.store(model + 16);
    q.w.store(model + 24);
    p.x.store(model + 32);
    p.y.store(model + 40);
    p.z.store(model + 48);
}

template <class T>
SUREFOOT_INLINE void write_matrices(const float* model, float* const* models, std::size_t joint) noexcept {
    using F = Float8<T>;
    const F x = F::load(model), y = F::load(model + 8), z = F::load(model + 16), w = F::load(model + 24);
    const F x2 = x + x, y2 = y + y, z2 = z + z;
    const F xx = x * x2, yy = y * y2, zz = z * z2, xy = x * y2, xz = x * z2, yz = y * z2;
    const F wx = w * x2, wy = w * y2, wz = w * z2;
    F upper[8] = {1.0f - (yy + zz), xy - wz,          xz + wy, F::load(model + 32),
                  xy + wz,          1.0f - (xx + zz), yz - wx, F::load(model + 40)};
    const F lower[4] = {xz - wy, yz + wx, 1.0f - (xx + yy), F::load(model + 48)};
    transpose(upper);
    for (int c = 0; c < 8; ++c) upper[c].store(models[c] + joint * 12);
    store_quads(lower, [&](int c) noexcept { return models[c] + joint * 12 + 8; });
}

template <class T>
void local_to_model(const std::int16_t* parents, int joints, const float* const* locals, float* const* models,
                    float* scratch) {
    using F = Float8<T>;
    for (int j = 0; j < joints; ++j) {
        const std::size_t at = static_cast<std::size_t>(j);
        F rows[8];
        if (j + 1 < joints) {
            for (int c = 0; c < 8; ++c) rows[c] = F::load(locals[c] + at * 7);
        } else {  // the last joint has no eighth float behind it
            for (int c = 0; c < 8; ++c) {
                float last[8] = {};
                std::memcpy(last, locals[c] + at * 7, 7 * sizeof(float));
                rows[c] = F::load(last);
            }
        }
        transpose(rows);
        float* model = scratch + at * 56;
        model_of_joint(rows, parents[j] < 0 ? nullptr : scratch + static_cast<std::size_t>(parents[j]) * 56, model);
        write_matrices<T>(model, models, at);
    }
}

template <class T>
constexpr ClipKernels kernels_named(const char* name) {
    return {name, blend_rotations<T>, add_turns<T>, local_to_model<T>};
}

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
