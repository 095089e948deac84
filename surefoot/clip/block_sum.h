#pragma once
// The weighted sum of one block of rotations (x8 y8 z8 w8) over the leaves of a pose. Between the two keys of a clip
// the numbers stay integers: 16 bits times 15-bit shares, two products and their sum by one instruction, exact on every
// build. The sum over the leaves is in floats. Private to clip/.

#include <surefoot/clip/kernels.h>
#include <surefoot/math/lanes_rigid.h>

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

/// Eight numbers between two keys: a * from_share + b * to_share.
template <class T>
SUREFOOT_INLINE Int8<T> between_row(const std::int16_t* a, const std::int16_t* b, const KeyPair& pair) noexcept {
    Int8<T> r;
    if constexpr (T::width == 4) {
#if defined(__SSE2__)
        const __m128i shares = _mm_set1_epi32(pair.from_share | pair.to_share << 16);
        const __m128i from = _mm_loadu_si128((const __m128i*)a), to = _mm_loadu_si128((const __m128i*)b);
        r.part[0] = (typename T::I)_mm_madd_epi16(_mm_unpacklo_epi16(from, to), shares);
        r.part[T::parts - 1] = (typename T::I)_mm_madd_epi16(_mm_unpackhi_epi16(from, to), shares);
        return r;
#elif defined(__wasm_simd128__)
        const v128_t shares = wasm_i32x4_splat(pair.from_share | pair.to_share << 16);
        const v128_t from = wasm_v128_load(a), to = wasm_v128_load(b);
        r.part[0] = (typename T::I)wasm_i32x4_dot_i16x8(wasm_i16x8_shuffle(from, to, 0, 8, 1, 9, 2, 10, 3, 11), shares);
        r.part[T::parts - 1] =
            (typename T::I)wasm_i32x4_dot_i16x8(wasm_i16x8_shuffle(from, to, 4, 12, 5, 13, 6, 14, 7, 15), shares);
        return r;
#endif
    }
    std::int32_t all[8];
    for (int i = 0; i < 8; ++i) all[i] = a[i] * pair.from_share + b[i] * pair.to_share;
    std::memcpy(r.part, all, sizeof r.part);
    return r;
}

template <class T>
struct BlockSum {
    Float8<T> row[4] = {Float8<T>::splat(0), Float8<T>::splat(0), Float8<T>::splat(0), Float8<T>::splat(0)};

    SUREFOOT_INLINE void add(const KeyPair& pair, int block) noexcept {
        const std::int16_t *a = pair.from + block * 32, *b = pair.to + block * 32;
        const Float8<T> weight = Float8<T>::splat(pair.weight);
        for (int k = 0; k < 4; ++k) row[k] += weight * to_float(between_row<T>(a + 8 * k, b + 8 * k, pair));
    }
    SUREFOOT_INLINE Quat8<T> rotations() const noexcept { return {row[0], row[1], row[2], row[3]}; }
};

// The instructions interleave within 128 bits, so what is summed there is (x0-3 y0-3), (x4-7 y4-7), (z0-3 w0-3), …; it
// comes into order once, after the last leaf.
#if defined(__AVX512BW__)

// Vector extensions where there are some: GCC 12 warns of its own headers (GCC bug 105593).
template <>
struct BlockSum<Vector> {
    typedef float F16 __attribute__((vector_size(64)));
    typedef std::int32_t I16 __attribute__((vector_size(64)));
    F16 low = {}, high = {};  ///< x0-3 y0-3 z0-3 w0-3, and 4-7

    SUREFOOT_INLINE void add(const KeyPair& pair, int block) noexcept {
        const __m512i a = _mm512_loadu_si512(pair.from + block * 32), b = _mm512_loadu_si512(pair.to + block * 32);
        const __m512i shares = _mm512_set1_epi32(pair.from_share | pair.to_share << 16);
        const F16 weight = pair.weight - F16{};
        const I16 between_low = (I16)_mm512_madd_epi16(_mm512_unpacklo_epi16(a, b), shares);
        const I16 between_high = (I16)_mm512_madd_epi16(_mm512_unpackhi_epi16(a, b), shares);
        low += weight * __builtin_convertvector(between_low, F16);
        high += weight * __builtin_convertvector(between_high, F16);
    }
    SUREFOOT_INLINE Quat8<Vector> rotations() const noexcept {
        return {{__builtin_shufflevector(low, high, 0, 1, 2, 3, 16, 17, 18, 19)},
                {__builtin_shufflevector(low, high, 4, 5, 6, 7, 20, 21, 22, 23)},
                {__builtin_shufflevector(low, high, 8, 9, 10, 11, 24, 25, 26, 27)},
                {__builtin_shufflevector(low, high, 12, 13, 14, 15, 28, 29, 30, 31)}};
    }
};

#elif defined(__AVX2__)

template <>
struct BlockSum<Vector> {
    using F = Float8<Vector>;
    F part[4] = {F::splat(0), F::splat(0), F::splat(0), F::splat(0)};

    SUREFOOT_INLINE void add(const KeyPair& pair, int block) noexcept {
        const auto* a = (const __m256i*)(pair.from + block * 32);
        const auto* b = (const __m256i*)(pair.to + block * 32);
        const __m256i shares = _mm256_set1_epi32(pair.from_share | pair.to_share << 16);
        for (int k = 0; k < 2; ++k) {
            const __m256i from = _mm256_loadu_si256(a + k), to = _mm256_loadu_si256(b + k);
            part[2 * k] += pair.weight * between(_mm256_unpacklo_epi16(from, to), shares);
            part[2 * k + 1] += pair.weight * between(_mm256_unpackhi_epi16(from, to), shares);
        }
    }
    SUREFOOT_INLINE Quat8<Vector> rotations() const noexcept {
        return {lower(part[0], part[1]), upper(part[0], part[1]), lower(part[2], part[3]), upper(part[2], part[3])};
    }

  private:
    SUREFOOT_INLINE static F between(__m256i keys, __m256i shares) noexcept {
        return to_float(Int8<Vector>{{(Vector::I)_mm256_madd_epi16(keys, shares)}});
    }
    SUREFOOT_INLINE static F lower(F a, F b) noexcept {
        return {{__builtin_shufflevector(a.part[0], b.part[0], 0, 1, 2, 3, 8, 9, 10, 11)}};
    }
    SUREFOOT_INLINE static F upper(F a, F b) noexcept {
        return {{__builtin_shufflevector(a.part[0], b.part[0], 4, 5, 6, 7, 12, 13, 14, 15)}};
    }
};

#endif

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
