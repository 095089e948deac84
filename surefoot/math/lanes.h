#pragma once
// Eight lanes of floats and integers, and their scalar twin.
//
// Every kernel is one template over a tag: `Vector` runs it on the machine's vector registers (GCC/Clang vector
// extensions: SSE, AVX2, NEON and WebAssembly SIMD128 alike), `Scalar` on plain floats. Both give the same bits: only
// + - * / sqrt, comparisons and conversions are used, each correctly rounded everywhere, and contraction is off
// (-ffp-contract=off). NaN payloads are the one exception, and kernels make no NaN.
//
// The names live in a namespace of the build (SUREFOOT_KERNELS, default `kernels_baseline`): a file that is compiled
// for another instruction set defines it before the first include, so that the linker cannot mix inline functions of
// different builds.

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#ifndef SUREFOOT_KERNELS
#define SUREFOOT_KERNELS kernels_baseline
#endif
// GCC takes minutes over what is all inlined and checked.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SUREFOOT_INLINE inline
#else
#define SUREFOOT_INLINE inline __attribute__((always_inline))
#endif

namespace surefoot {
inline namespace SUREFOOT_KERNELS {

/// Plain floats, one at a time: the reference.
struct Scalar {
    static constexpr int width = 1, parts = 8;
    using F = float;
    using I = std::int32_t;
};

/// One lane: for one alone what eight do side by side, with the bits of a lane. Only what is done lane by lane: nothing
/// that names eight (any, all, gather, transpose).
struct Single {
    static constexpr int width = 1, parts = 1;
    using F = float;
    using I = std::int32_t;
};

/// The machine's vectors: one of eight with AVX2, else two of four.
struct Vector {
#if defined(__AVX2__)
    static constexpr int width = 8, parts = 1;
#else
    static constexpr int width = 4, parts = 2;
#endif
    typedef float F __attribute__((vector_size(width * 4)));
    typedef std::int32_t I __attribute__((vector_size(width * 4)));
};

template <class T>
struct Int8;
template <class T>
struct Mask8;

#define SUREFOOT_EACH_PART _Pragma("GCC unroll 8") for (int i = 0; i < T::parts; ++i)

/// Eight floats.
template <class T>
struct Float8 {
    typename T::F part[T::parts];

    SUREFOOT_INLINE static Float8 splat(float x) noexcept {
        Float8 r;
        SUREFOOT_EACH_PART r.part[i] = x - typename T::F{};
        return r;
    }
    /// Eight floats from memory of any alignment.
    SUREFOOT_INLINE static Float8 load(const float* from) noexcept {
        Float8 r;
        std::memcpy(r.part, from, sizeof r.part);
        return r;
    }
    /// Eight 16-bit integers, as floats.
    SUREFOOT_INLINE static Float8 load_int16(const std::int16_t* from) noexcept;
    SUREFOOT_INLINE void store(float* to) const noexcept { std::memcpy(to, part, sizeof part); }
    /// The first four lanes only.
    SUREFOOT_INLINE void store4(float* to) const noexcept { std::memcpy(to, part, 4 * sizeof(float)); }
    float operator[](int lane) const noexcept {
        float all[8];
        store(all);
        return all[lane];
    }

    friend SUREFOOT_INLINE Float8 operator+(Float8 a, Float8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] + b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Float8 operator-(Float8 a, Float8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] - b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Float8 operator*(Float8 a, Float8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] * b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Float8 operator/(Float8 a, Float8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] / b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Float8 operator-(Float8 a) noexcept {
        SUREFOOT_EACH_PART a.part[i] = -a.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Float8 operator+(Float8 a, float b) noexcept { return a + splat(b); }
    friend SUREFOOT_INLINE Float8 operator-(Float8 a, float b) noexcept { return a - splat(b); }
    friend SUREFOOT_INLINE Float8 operator*(Float8 a, float b) noexcept { return a * splat(b); }
    friend SUREFOOT_INLINE Float8 operator/(Float8 a, float b) noexcept { return a / splat(b); }
    friend SUREFOOT_INLINE Float8 operator+(float a, Float8 b) noexcept { return splat(a) + b; }
    friend SUREFOOT_INLINE Float8 operator-(float a, Float8 b) noexcept { return splat(a) - b; }
    friend SUREFOOT_INLINE Float8 operator*(float a, Float8 b) noexcept { return splat(a) * b; }
    friend SUREFOOT_INLINE Float8 operator/(float a, Float8 b) noexcept { return splat(a) / b; }
    SUREFOOT_INLINE Float8& operator+=(Float8 b) noexcept { return *this = *this + b; }
    SUREFOOT_INLINE Float8& operator-=(Float8 b) noexcept { return *this = *this - b; }
    SUREFOOT_INLINE Float8& operator*=(Float8 b) noexcept { return *this = *this * b; }

    friend SUREFOOT_INLINE Mask8<T> operator<(Float8 a, Float8 b) noexcept {
        Mask8<T> r;
        SUREFOOT_EACH_PART r.part[i] = Mask8<T>::of(a.part[i] < b.part[i]);
        return r;
    }
    friend SUREFOOT_INLINE Mask8<T> operator<=(Float8 a, Float8 b) noexcept {
        Mask8<T> r;
        SUREFOOT_EACH_PART r.part[i] = Mask8<T>::of(a.part[i] <= b.part[i]);
        return r;
    }
    friend SUREFOOT_INLINE Mask8<T> operator==(Float8 a, Float8 b) noexcept {
        Mask8<T> r;
        SUREFOOT_EACH_PART r.part[i] = Mask8<T>::of(a.part[i] == b.part[i]);
        return r;
    }
    friend SUREFOOT_INLINE Mask8<T> operator>(Float8 a, Float8 b) noexcept { return b < a; }
    friend SUREFOOT_INLINE Mask8<T> operator>=(Float8 a, Float8 b) noexcept { return b <= a; }
};

/// Eight 32-bit integers. [Limit: no overflow]
template <class T>
struct Int8 {
    typename T::I part[T::parts];

    SUREFOOT_INLINE static Int8 splat(std::int32_t x) noexcept {
        Int8 r;
        SUREFOOT_EACH_PART r.part[i] = x | typename T::I{};
        return r;
    }
    SUREFOOT_INLINE static Int8 load(const std::int32_t* from) noexcept {
        Int8 r;
        std::memcpy(r.part, from, sizeof r.part);
        return r;
    }
    SUREFOOT_INLINE void store(std::int32_t* to) const noexcept { std::memcpy(to, part, sizeof part); }
    std::int32_t operator[](int lane) const noexcept {
        std::int32_t all[8];
        store(all);
        return all[lane];
    }

    friend SUREFOOT_INLINE Int8 operator+(Int8 a, Int8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] + b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Int8 operator-(Int8 a, Int8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] - b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Int8 operator*(Int8 a, Int8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] * b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Int8 operator&(Int8 a, Int8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] & b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Int8 operator|(Int8 a, Int8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] | b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Int8 operator^(Int8 a, Int8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] ^ b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Mask8<T> operator==(Int8 a, Int8 b) noexcept {
        Mask8<T> r;
        SUREFOOT_EACH_PART r.part[i] = Mask8<T>::of(a.part[i] == b.part[i]);
        return r;
    }
    friend SUREFOOT_INLINE Mask8<T> operator<(Int8 a, Int8 b) noexcept {
        Mask8<T> r;
        SUREFOOT_EACH_PART r.part[i] = Mask8<T>::of(a.part[i] < b.part[i]);
        return r;
    }
};

/// Eight truths: all bits set or none.
template <class T>
struct Mask8 {
    typename T::I part[T::parts];

    SUREFOOT_INLINE static typename T::I of(bool truth) noexcept requires(T::width == 1) { return truth ? -1 : 0; }
    template <class V>
    SUREFOOT_INLINE static typename T::I of(V truth) noexcept requires(T::width > 1) {
        return (typename T::I)truth;
    }
    bool operator[](int lane) const noexcept {
        std::int32_t all[8];
        std::memcpy(all, part, sizeof part);
        return all[lane] != 0;
    }
    friend SUREFOOT_INLINE Mask8 operator&(Mask8 a, Mask8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] & b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Mask8 operator|(Mask8 a, Mask8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] | b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Mask8 operator^(Mask8 a, Mask8 b) noexcept {
        SUREFOOT_EACH_PART a.part[i] = a.part[i] ^ b.part[i];
        return a;
    }
    friend SUREFOOT_INLINE Mask8 operator~(Mask8 a) noexcept {
        SUREFOOT_EACH_PART a.part[i] = ~a.part[i];
        return a;
    }
};

template <class T>
SUREFOOT_INLINE bool any(Mask8<T> m) noexcept {
    std::int64_t all[4];
    std::memcpy(all, m.part, sizeof all);
    return ((all[0] | all[1]) | (all[2] | all[3])) != 0;
}
template <class T>
SUREFOOT_INLINE bool all(Mask8<T> m) noexcept {
    return !any(~m);
}

/// Lane by lane: where the mask is set, a; else b.
template <class T>
SUREFOOT_INLINE Float8<T> select(Mask8<T> m, Float8<T> a, Float8<T> b) noexcept {
    SUREFOOT_EACH_PART a.part[i] = m.part[i] ? a.part[i] : b.part[i];
    return a;
}
template <class T>
SUREFOOT_INLINE Int8<T> select(Mask8<T> m, Int8<T> a, Int8<T> b) noexcept {
    SUREFOOT_EACH_PART a.part[i] = m.part[i] ? a.part[i] : b.part[i];
    return a;
}
/// a < b ? a : b and b < a ? a : b; for equal operands (+0 and -0) the second.
template <class T>
SUREFOOT_INLINE Float8<T> min(Float8<T> a, Float8<T> b) noexcept {
    SUREFOOT_EACH_PART a.part[i] = a.part[i] < b.part[i] ? a.part[i] : b.part[i];
    return a;
}
template <class T>
SUREFOOT_INLINE Float8<T> max(Float8<T> a, Float8<T> b) noexcept {
    SUREFOOT_EACH_PART a.part[i] = b.part[i] < a.part[i] ? a.part[i] : b.part[i];
    return a;
}
template <class T>
SUREFOOT_INLINE Float8<T> clamp(Float8<T> x, float low, float high) noexcept {
    return min(max(x, Float8<T>::splat(low)), Float8<T>::splat(high));
}

/// The same bits as the other type.
template <class T>
SUREFOOT_INLINE Int8<T> bits(Float8<T> a) noexcept {
    Int8<T> r;
    std::memcpy(r.part, a.part, sizeof r.part);
    return r;
}
template <class T>
SUREFOOT_INLINE Float8<T> from_bits(Int8<T> a) noexcept {
    Float8<T> r;
    std::memcpy(r.part, a.part, sizeof r.part);
    return r;
}
inline constexpr std::int32_t k_sign_bit = INT32_MIN;
template <class T>
SUREFOOT_INLINE Float8<T> abs(Float8<T> a) noexcept {
    return from_bits(bits(a) & Int8<T>::splat(~k_sign_bit));
}
/// The magnitude of a with the sign of b.
template <class T>
SUREFOOT_INLINE Float8<T> copysign(Float8<T> a, Float8<T> b) noexcept {
    return from_bits((bits(a) & Int8<T>::splat(~k_sign_bit)) | (bits(b) & Int8<T>::splat(k_sign_bit)));
}

template <class T>
SUREFOOT_INLINE Float8<T> to_float(Int8<T> a) noexcept {
    Float8<T> r;
    if constexpr (T::width == 1) {
        SUREFOOT_EACH_PART r.part[i] = static_cast<float>(a.part[i]);
    } else {
        SUREFOOT_EACH_PART r.part[i] = __builtin_convertvector(a.part[i], typename T::F);
    }
    return r;
}
/// Rounds towards zero. [Limit: |a| < 2^31]
template <class T>
SUREFOOT_INLINE Int8<T> to_int(Float8<T> a) noexcept {
    Int8<T> r;
    if constexpr (T::width == 1) {
        SUREFOOT_EACH_PART r.part[i] = static_cast<std::int32_t>(a.part[i]);
    } else {
        SUREFOOT_EACH_PART r.part[i] = __builtin_convertvector(a.part[i], typename T::I);
    }
    return r;
}

template <class T>
SUREFOOT_INLINE Float8<T> sqrt(Float8<T> a) noexcept {
    if constexpr (T::width == 1) {
        SUREFOOT_EACH_PART a.part[i] = std::sqrt(a.part[i]);
    } else {
#if defined(__AVX2__)
        a.part[0] = (typename T::F)_mm256_sqrt_ps((__m256)a.part[0]);
#elif defined(__SSE2__)
        SUREFOOT_EACH_PART a.part[i] = (typename T::F)_mm_sqrt_ps((__m128)a.part[i]);
#elif defined(__wasm_simd128__)
        SUREFOOT_EACH_PART a.part[i] = (typename T::F)wasm_f32x4_sqrt((v128_t)a.part[i]);
#else
        SUREFOOT_EACH_PART for (int lane = 0; lane < T::width; ++lane) a.part[i][lane] = std::sqrt(a.part[i][lane]);
#endif
    }
    return a;
}
/// 1 / sqrt(a), both exactly rounded: the hardware's estimates differ from machine to machine.
template <class T>
SUREFOOT_INLINE Float8<T> rsqrt(Float8<T> a) noexcept {
    return 1.0f / sqrt(a);
}

/// Largest whole number not above a (a zero comes out as +0). Beyond 2^23 every float is whole.
template <class T>
SUREFOOT_INLINE Float8<T> floor(Float8<T> a) noexcept {
    const Mask8<T> small = abs(a) < Float8<T>::splat(8388608.0f);
    const Float8<T> whole = to_float(to_int(select(small, a, Float8<T>::splat(0))));
    const Float8<T> below = select(whole > a, whole - 1.0f, whole);
    return select(small, below, a);
}

template <class T>
SUREFOOT_INLINE Float8<T> Float8<T>::load_int16(const std::int16_t* from) noexcept {
    Float8 r;
    if constexpr (T::width == 1) {
        SUREFOOT_EACH_PART r.part[i] = static_cast<float>(from[i]);
    } else {
        typedef std::int16_t Short8 __attribute__((vector_size(16)));
        Short8 v;
        std::memcpy(&v, from, sizeof v);
        if constexpr (T::width == 8) {
            r.part[0] = __builtin_convertvector(v, typename T::F);
        } else {
            // Each number into the upper half of 32 bits, then down with its sign (little-endian).
            const Short8 low = __builtin_shufflevector(v, v, 0, 0, 1, 1, 2, 2, 3, 3);
            const Short8 high = __builtin_shufflevector(v, v, 4, 4, 5, 5, 6, 6, 7, 7);
            r.part[0] = __builtin_convertvector((typename T::I)low >> 16, typename T::F);
            r.part[T::parts - 1] = __builtin_convertvector((typename T::I)high >> 16, typename T::F);
        }
    }
    return r;
}

/// base[index] lane by lane.
template <class T>
SUREFOOT_INLINE Float8<T> gather(const float* base, Int8<T> index) noexcept {
    std::int32_t at[8];
    float out[8];
    index.store(at);
    for (int i = 0; i < 8; ++i) out[i] = base[at[i]];
    return Float8<T>::load(out);
}

/// rows[r] lane c becomes rows[c] lane r.
template <class T>
SUREFOOT_INLINE void transpose(Float8<T> (&rows)[8]) noexcept {
    if constexpr (T::width == 1) {
        for (int r = 0; r < 8; ++r)
            for (int c = 0; c < r; ++c) {
                const float swapped = rows[r].part[c];
                rows[r].part[c] = rows[c].part[r];
                rows[c].part[r] = swapped;
            }
    } else if constexpr (T::width == 8) {
        typename T::F s[8];
        for (int i = 0; i < 8; i += 4) {
            const auto a = rows[i].part[0], b = rows[i + 1].part[0], c = rows[i + 2].part[0], d = rows[i + 3].part[0];
            const auto ab0 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
            const auto ab1 = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
            const auto cd0 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
            const auto cd1 = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
            s[i] = __builtin_shufflevector(ab0, cd0, 0, 1, 8, 9, 4, 5, 12, 13);
            s[i + 1] = __builtin_shufflevector(ab0, cd0, 2, 3, 10, 11, 6, 7, 14, 15);
            s[i + 2] = __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 4, 5, 12, 13);
            s[i + 3] = __builtin_shufflevector(ab1, cd1, 2, 3, 10, 11, 6, 7, 14, 15);
        }
        for (int i = 0; i < 4; ++i) {
            rows[i].part[0] = __builtin_shufflevector(s[i], s[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
            rows[i + 4].part[0] = __builtin_shufflevector(s[i], s[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        }
    } else {
        // Four 4x4 blocks, the two off the diagonal change places.
        Float8<T> out[8];
        for (int down = 0; down < 2; ++down)
            for (int right = 0; right < 2; ++right) {
                const auto a = rows[4 * down].part[right], b = rows[4 * down + 1].part[right];
                const auto c = rows[4 * down + 2].part[right], d = rows[4 * down + 3].part[right];
                const auto ab0 = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                           ab1 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
                const auto cd0 = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                           cd1 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
                out[4 * right].part[down] = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
                out[4 * right + 1].part[down] = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
                out[4 * right + 2].part[down] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
                out[4 * right + 3].part[down] = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
            }
        for (int r = 0; r < 8; ++r) rows[r] = out[r];
    }
}

template <class F4>
SUREFOOT_INLINE void store_quad(float* to, F4 quad) noexcept {
    static_assert(sizeof quad == 4 * sizeof(float));
    std::memcpy(to, &quad, sizeof quad);
}
/// Four rows of eight as eight quads: lane l of the rows goes to the four floats at to(l).
template <class T, class To>
SUREFOOT_INLINE void store_quads(const Float8<T> (&rows)[4], const To& to) noexcept {
    if constexpr (T::width == 1) {
        for (int lane = 0; lane < 8; ++lane)
            for (int r = 0; r < 4; ++r) to(lane)[r] = rows[r].part[lane];
    } else {
        for (int i = 0; i < T::parts; ++i) {
            const auto a = rows[0].part[i], b = rows[1].part[i], c = rows[2].part[i], d = rows[3].part[i];
            if constexpr (T::width == 8) {
                const auto ab0 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
                const auto ab1 = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
                const auto cd0 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
                const auto cd1 = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
                const typename T::F pairs[4] = {__builtin_shufflevector(ab0, cd0, 0, 1, 8, 9, 4, 5, 12, 13),
                                                __builtin_shufflevector(ab0, cd0, 2, 3, 10, 11, 6, 7, 14, 15),
                                                __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 4, 5, 12, 13),
                                                __builtin_shufflevector(ab1, cd1, 2, 3, 10, 11, 6, 7, 14, 15)};
                for (int l = 0; l < 4; ++l) {
                    store_quad(to(l), __builtin_shufflevector(pairs[l], pairs[l], 0, 1, 2, 3));
                    store_quad(to(l + 4), __builtin_shufflevector(pairs[l], pairs[l], 4, 5, 6, 7));
                }
            } else {
                const auto ab0 = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                           ab1 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
                const auto cd0 = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                           cd1 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
                store_quad(to(4 * i), __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5));
                store_quad(to(4 * i + 1), __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7));
                store_quad(to(4 * i + 2), __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5));
                store_quad(to(4 * i + 3), __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7));
            }
        }
    }
}

/// Sine and cosine together. Good to 2e-7 for |x| < 100 and to 1e-5 for |x| < 8000; angles in radians.
template <class T>
SUREFOOT_INLINE void sincos(Float8<T> x, Float8<T>& sine, Float8<T>& cosine) noexcept {
    using F = Float8<T>;
    // pi/2 in three parts, the first two with trailing zeros, so that their products with k are exact (Cody & Waite).
    const F k = floor(x * 0.636619772f + 0.5f);
    const F r = ((x - k * 1.5703125f) - k * 4.83751297e-4f) - k * 7.54978995e-8f;
    const F s = r * r;
    // Taylor on [-pi/4, pi/4]: the first omitted terms are below 2e-9.
    F p = s * (1.0f / 362880.0f) - (1.0f / 5040.0f);
    p = p * s + (1.0f / 120.0f);
    p = p * s - (1.0f / 6.0f);
    const F in_sine = r + r * s * p;
    F q = s * (-1.0f / 3628800.0f) + (1.0f / 40320.0f);
    q = q * s - (1.0f / 720.0f);
    q = q * s + (1.0f / 24.0f);
    const F in_cosine = (1.0f - 0.5f * s) + s * s * q;
    const Int8<T> quadrant = to_int(k) & Int8<T>::splat(3);
    const Mask8<T> odd = (quadrant & Int8<T>::splat(1)) == Int8<T>::splat(1);
    const Mask8<T> sine_minus = Int8<T>::splat(1) < quadrant;                                                 // 2, 3
    const Mask8<T> cosine_minus = ((quadrant + Int8<T>::splat(1)) & Int8<T>::splat(2)) == Int8<T>::splat(2);  // 1, 2
    const F a = select(odd, in_cosine, in_sine), b = select(odd, in_sine, in_cosine);
    sine = select(sine_minus, -a, a);
    cosine = select(cosine_minus, -b, b);
}
template <class T>
SUREFOOT_INLINE Float8<T> sin(Float8<T> x) noexcept {
    Float8<T> s, c;
    sincos(x, s, c);
    return s;
}
template <class T>
SUREFOOT_INLINE Float8<T> cos(Float8<T> x) noexcept {
    Float8<T> s, c;
    sincos(x, s, c);
    return c;
}

/// Angle of (x, y) in [-pi, pi], good to 4e-7; 0 for (0, 0).
template <class T>
SUREFOOT_INLINE Float8<T> atan2(Float8<T> y, Float8<T> x) noexcept {
    using F = Float8<T>;
    const F ax = abs(x), ay = abs(y);
    const F high = max(ax, ay), low = min(ax, ay), zero = F::splat(0);
    const F safe = select(high > zero, high, F::splat(1));
    // atan(t) for t = low / high in [0, 1]: above tan(pi/8), pi/4 + atan((t - 1) / (t + 1)).
    const Mask8<T> steep = low > high * 0.414213562f;
    const F t = select(steep, low - high, low) / select(steep, low + safe, safe);
    const F s = t * t;
    // Taylor on |t| <= tan(pi/8): the first omitted term is 2e-8.
    F p = s * (-1.0f / 15.0f) + (1.0f / 13.0f);
    p = p * s - (1.0f / 11.0f);
    p = p * s + (1.0f / 9.0f);
    p = p * s - (1.0f / 7.0f);
    p = p * s + (1.0f / 5.0f);
    p = p * s - (1.0f / 3.0f);
    F angle = (t + t * s * p) + select(steep, F::splat(0.785398163f), zero);
    angle = select(ay > ax, 1.57079633f - angle, angle);
    angle = select(x < zero, 3.14159265f - angle, angle);
    return copysign(angle, y);
}

/// Arc cosine of x clamped to [-1, 1].
template <class T>
SUREFOOT_INLINE Float8<T> acos(Float8<T> x) noexcept {
    x = clamp(x, -1.0f, 1.0f);
    return atan2(sqrt((1.0f - x) * (1.0f + x)), x);
}
/// Arc sine of x clamped to [-1, 1], good to 4e-7.
template <class T>
SUREFOOT_INLINE Float8<T> asin(Float8<T> x) noexcept {
    x = clamp(x, -1.0f, 1.0f);
    return atan2(x, sqrt((1.0f - x) * (1.0f + x)));
}

/// Exponential, good to 2e-7 of its value. [Limit: x in [-87, 88]]
template <class T>
SUREFOOT_INLINE Float8<T> exp(Float8<T> x) noexcept {
    using F = Float8<T>;
    const F k = floor(x * 1.44269504f + 0.5f);
    const F r = (x - k * 0.693359375f) - k * -2.12194440e-4f;  // |r| <= ln2 / 2, ln2 in two parts
    F p = r * (1.0f / 5040.0f) + (1.0f / 720.0f);
    p = p * r + (1.0f / 120.0f);
    p = p * r + (1.0f / 24.0f);
    p = p * r + (1.0f / 6.0f);
    p = p * r + 0.5f;
    p = (p * r * r + r) + 1.0f;
    // 2^k by its exponent: k + 127 lies in [1, 254], so the product does not overflow.
    return p * from_bits((to_int(k) + Int8<T>::splat(127)) * Int8<T>::splat(1 << 23));
}

#undef SUREFOOT_EACH_PART

}  // namespace SUREFOOT_KERNELS
}  // namespace surefoot
