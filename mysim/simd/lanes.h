// The only file with intrinsics. It is compiled once per instruction set, in a namespace of its own and without any
// std:: function, so that no newer instruction can end up in shared code.
//
// Lanes<T> holds as many numbers as a register, with + - * of the compiler's vector types and the few operations that
// these lack: loads, fused multiply-add, minimum and maximum, 1 / sqrt. Points are stored as x y z x y z; add_points
// converts lanes of x, of y and of z to this order. A record is four numbers: x y z 0. The type Records holds one
// record per lane, loaded whole from any address; only the sums of their squares are converted to lanes.
//
// Highway is not used: Debian's version (1.0.3) has no SSE2 target, so the build for every machine would have one lane
// and take 1.9 to 2.7 times as long (measured on 1 - 1 / sqrt(s)). Highway also has no estimate of 1 / sqrt in double
// precision.
#pragma once

#ifdef __SSE2__
#include <immintrin.h>
#endif

#define FORCE_INLINE [[gnu::always_inline]] static inline

namespace crosscheck::simd {
namespace {

template <class T>
struct Lanes;

#if defined(__AVX2__)
/// Adds the first three numbers of a record to a point.
FORCE_INLINE void add_record(double* p, __m256d a) {
  _mm_storeu_pd(p, _mm_loadu_pd(p) + _mm256_castpd256_pd128(a));
  _mm_store_sd(p + 2, _mm_add_sd(_mm_load_sd(p + 2), _mm256_extractf128_pd(a, 1)));
}
#endif

#if defined(__AVX512F__)

template <>
struct Lanes<double> {
  using V = __m512d;
  static constexpr int width = 8;
  FORCE_INLINE V load(const double* p) { return _mm512_loadu_pd(p); }
  FORCE_INLINE void store(double* p, V a) { _mm512_storeu_pd(p, a); }
  FORCE_INLINE V all(double a) { return _mm512_set1_pd(a); }
  FORCE_INLINE V fma(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
  FORCE_INLINE V fnma(V a, V b, V c) { return _mm512_fnmadd_pd(a, b, c); }
  FORCE_INLINE V min(V a, V b) { return _mm512_min_pd(a, b); }
  FORCE_INLINE V max(V a, V b) { return _mm512_max_pd(a, b); }
  FORCE_INLINE V root(V s) { return _mm512_sqrt_pd(s); }
  FORCE_INLINE V rsqrt_estimate(V s) { return _mm512_rsqrt14_pd(s); }  // 14 bits
  FORCE_INLINE bool any_less(V a, V b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ) != 0; }

  FORCE_INLINE void add(double* p, V a) { store(p, load(p) + a); }
  FORCE_INLINE void add_points(double* p, V x, V y, V z) {
    const auto three = [&](__m512i xy, __m512i and_z) __attribute__((always_inline)) {
      return _mm512_permutex2var_pd(_mm512_permutex2var_pd(x, xy, y), and_z, z);
    };
    add(p, three(_mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10), _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7)));
    add(p + 8, three(_mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5), _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7)));
    add(p + 16, three(_mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0), _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15)));
  }

  using Record = __m256d;
  struct Records {
    V r[4];  // two records each
  };
  FORCE_INLINE Record record(const double* p) { return _mm256_loadu_pd(p); }
  /// x[ends[0]] - x[ends[1]], x[ends[2]] - x[ends[3]] ...
  FORCE_INLINE Records difference(const double* x, const int* ends) {
    const auto one = [&](int i) __attribute__((always_inline)) {
      return record(x + ends[2 * i]) - record(x + ends[2 * i + 1]);
    };
    const auto two = [&](int i) __attribute__((always_inline)) {
      return _mm512_insertf64x4(_mm512_castpd256_pd512(one(i)), one(i + 1), 1);
    };
    return {two(0), two(2), two(4), two(6)};
  }
  /// Sum of squares of each record, rounded as x x + y y + z z.
  FORCE_INLINE V squared_norms(const Records& d) {
    const auto two = [](V a, V b) __attribute__((always_inline)) {
      const V even = _mm512_unpacklo_pd(a, b), odd = _mm512_unpackhi_pd(a, b);
      return even * even + odd * odd;
    };
    const V a = two(d.r[0], d.r[1]), b = two(d.r[2], d.r[3]);
    return _mm512_permutex_pd(_mm512_shuffle_f64x2(a, b, 0x88) + _mm512_shuffle_f64x2(a, b, 0xdd), 0b11011000);
  }
  /// Calls take(i, record i times lane i of `by`) for each i.
  template <class Take>
  FORCE_INLINE void each_scaled(const Records& d, V by, Take take) {
    const auto two = [&](long a, long b) __attribute__((always_inline)) {
      const V f = d.r[a / 2] * _mm512_permutexvar_pd(_mm512_setr_epi64(a, a, a, a, b, b, b, b), by);
      take(a, _mm512_castpd512_pd256(f)), take(b, _mm512_extractf64x4_pd(f, 1));
    };
    two(0, 1), two(2, 3), two(4, 5), two(6, 7);
  }
  FORCE_INLINE void store_record(double* p, Record a) { _mm256_storeu_pd(p, a); }
  FORCE_INLINE void add_point(double* p, Record a) { add_record(p, a); }
};

template <>
struct Lanes<float> {
  using V = __m512;
  static constexpr int width = 16;
  FORCE_INLINE V load(const float* p) { return _mm512_loadu_ps(p); }
  FORCE_INLINE void store(float* p, V a) { _mm512_storeu_ps(p, a); }
  FORCE_INLINE V all(float a) { return _mm512_set1_ps(a); }
  FORCE_INLINE V fma(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
  FORCE_INLINE V fnma(V a, V b, V c) { return _mm512_fnmadd_ps(a, b, c); }
  FORCE_INLINE V min(V a, V b) { return _mm512_min_ps(a, b); }
  FORCE_INLINE V max(V a, V b) { return _mm512_max_ps(a, b); }
  FORCE_INLINE V root(V s) { return _mm512_sqrt_ps(s); }
  FORCE_INLINE V rsqrt_estimate(V s) { return _mm512_rsqrt14_ps(s); }
  FORCE_INLINE bool any_less(V a, V b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ) != 0; }
};

#elif defined(__AVX2__)

template <>
struct Lanes<double> {
  using V = __m256d;
  static constexpr int width = 4;
  FORCE_INLINE V load(const double* p) { return _mm256_loadu_pd(p); }
  FORCE_INLINE void store(double* p, V a) { _mm256_storeu_pd(p, a); }
  FORCE_INLINE V all(double a) { return _mm256_set1_pd(a); }
  FORCE_INLINE V fma(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
  FORCE_INLINE V fnma(V a, V b, V c) { return _mm256_fnmadd_pd(a, b, c); }
  FORCE_INLINE V min(V a, V b) { return _mm256_min_pd(a, b); }
  FORCE_INLINE V max(V a, V b) { return _mm256_max_pd(a, b); }
  FORCE_INLINE V root(V s) { return _mm256_sqrt_pd(s); }
  /// 12 bits, for 1e-38 < s < 1e38.
  FORCE_INLINE V rsqrt_estimate(V s) { return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(s))); }
  FORCE_INLINE bool any_less(V a, V b) { return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ)) != 0; }

  FORCE_INLINE void add(double* p, V a) { store(p, load(p) + a); }
  FORCE_INLINE void add_points(double* p, V x, V y, V z) {
    const V xy = _mm256_unpacklo_pd(x, y), zx = _mm256_shuffle_pd(z, x, 0b1010), yz = _mm256_unpackhi_pd(y, z);
    add(p, _mm256_permute2f128_pd(xy, zx, 0x20));
    add(p + 4, _mm256_blend_pd(yz, xy, 0b1100));
    add(p + 8, _mm256_permute2f128_pd(zx, yz, 0x31));
  }

  using Record = __m256d;
  struct Records {
    V r[4];
  };
  FORCE_INLINE Record record(const double* p) { return _mm256_loadu_pd(p); }
  FORCE_INLINE Records difference(const double* x, const int* ends) {
    const auto one = [&](int i) __attribute__((always_inline)) {
      return record(x + ends[2 * i]) - record(x + ends[2 * i + 1]);
    };
    return {one(0), one(1), one(2), one(3)};
  }
  FORCE_INLINE V squared_norms(const Records& d) {
    const auto two = [](V a, V b) __attribute__((always_inline)) {
      const V even = _mm256_unpacklo_pd(a, b), odd = _mm256_unpackhi_pd(a, b);
      return even * even + odd * odd;
    };
    const V a = two(d.r[0], d.r[1]), b = two(d.r[2], d.r[3]);
    return _mm256_permute2f128_pd(a, b, 0x20) + _mm256_permute2f128_pd(a, b, 0x31);
  }
  template <class Take>
  FORCE_INLINE void each_scaled(const Records& d, V by, Take take) {
    take(0, d.r[0] * _mm256_permute4x64_pd(by, 0x00)), take(1, d.r[1] * _mm256_permute4x64_pd(by, 0x55));
    take(2, d.r[2] * _mm256_permute4x64_pd(by, 0xaa)), take(3, d.r[3] * _mm256_permute4x64_pd(by, 0xff));
  }
  FORCE_INLINE void store_record(double* p, Record a) { store(p, a); }
  FORCE_INLINE void add_point(double* p, Record a) { add_record(p, a); }
};

template <>
struct Lanes<float> {
  using V = __m256;
  static constexpr int width = 8;
  FORCE_INLINE V load(const float* p) { return _mm256_loadu_ps(p); }
  FORCE_INLINE void store(float* p, V a) { _mm256_storeu_ps(p, a); }
  FORCE_INLINE V all(float a) { return _mm256_set1_ps(a); }
  FORCE_INLINE V fma(V a, V b, V c) { return _mm256_fmadd_ps(a, b, c); }
  FORCE_INLINE V fnma(V a, V b, V c) { return _mm256_fnmadd_ps(a, b, c); }
  FORCE_INLINE V min(V a, V b) { return _mm256_min_ps(a, b); }
  FORCE_INLINE V max(V a, V b) { return _mm256_max_ps(a, b); }
  FORCE_INLINE V root(V s) { return _mm256_sqrt_ps(s); }
  FORCE_INLINE V rsqrt_estimate(V s) { return _mm256_rsqrt_ps(s); }
  FORCE_INLINE bool any_less(V a, V b) { return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)) != 0; }
};

#else  // baseline, two doubles or four floats: SSE2, NEON and WebAssembly. Nothing is fused, and an estimate of 1 /
       // sqrt does not pay

#define PERMUTE __builtin_shufflevector

template <>
struct Lanes<double> {
  typedef double V __attribute__((vector_size(16)));
  static constexpr int width = 2;
  FORCE_INLINE V load(const double* p) {
    V a;
    __builtin_memcpy(&a, p, sizeof a);
    return a;
  }
  FORCE_INLINE void store(double* p, V a) { __builtin_memcpy(p, &a, sizeof a); }
  FORCE_INLINE V all(double a) { return V{a, a}; }
  FORCE_INLINE V fma(V a, V b, V c) { return a * b + c; }
  FORCE_INLINE V fnma(V a, V b, V c) { return c - a * b; }
  FORCE_INLINE V min(V a, V b) { return a < b ? a : b; }
  FORCE_INLINE V max(V a, V b) {
#ifdef __SSE2__
    return _mm_max_pd(a, b);  // g++ 12 uses four instructions if b is a constant
#else
    return a > b ? a : b;
#endif
  }
  FORCE_INLINE V root(V s) { return V{__builtin_sqrt(s[0]), __builtin_sqrt(s[1])}; }
  FORCE_INLINE bool any_less(V a, V b) {
    const auto less = a < b;
    return (less[0] | less[1]) != 0;
  }

  FORCE_INLINE void add(double* p, V a) { store(p, load(p) + a); }
  FORCE_INLINE void add_points(double* p, V x, V y, V z) {
    add(p, PERMUTE(x, y, 0, 2)), add(p + 2, PERMUTE(z, x, 0, 3)), add(p + 4, PERMUTE(y, z, 1, 3));
  }

  struct Record {
    V xy, z;
    [[gnu::always_inline]] Record operator+(Record b) const { return {xy + b.xy, z + b.z}; }
    [[gnu::always_inline]] Record operator-(Record b) const { return {xy - b.xy, z - b.z}; }
  };
  struct Records {
    Record r[2];
  };
  FORCE_INLINE Record record(const double* p) { return {load(p), load(p + 2)}; }
  FORCE_INLINE Records difference(const double* x, const int* ends) {
    return {record(x + ends[0]) - record(x + ends[1]), record(x + ends[2]) - record(x + ends[3])};
  }
  FORCE_INLINE V squared_norms(const Records& d) {
    const V x = PERMUTE(d.r[0].xy, d.r[1].xy, 0, 2), y = PERMUTE(d.r[0].xy, d.r[1].xy, 1, 3),
            z = PERMUTE(d.r[0].z, d.r[1].z, 0, 2);
    return x * x + y * y + z * z;
  }
  template <class Take>
  FORCE_INLINE void each_scaled(const Records& d, V by, Take take) {
    const V first = all(by[0]), second = all(by[1]);
    take(0, Record{d.r[0].xy * first, d.r[0].z * first}), take(1, Record{d.r[1].xy * second, d.r[1].z * second});
  }
  FORCE_INLINE void store_record(double* p, Record a) { store(p, a.xy), store(p + 2, a.z); }
  FORCE_INLINE void add_point(double* p, Record a) {
    add(p, a.xy);
    p[2] += a.z[0];
  }
};

template <>
struct Lanes<float> {
  typedef float V __attribute__((vector_size(16)));
  static constexpr int width = 4;
  FORCE_INLINE V load(const float* p) {
    V a;
    __builtin_memcpy(&a, p, sizeof a);
    return a;
  }
  FORCE_INLINE void store(float* p, V a) { __builtin_memcpy(p, &a, sizeof a); }
  FORCE_INLINE V all(float a) { return V{a, a, a, a}; }
  FORCE_INLINE V fma(V a, V b, V c) { return a * b + c; }
  FORCE_INLINE V fnma(V a, V b, V c) { return c - a * b; }
  FORCE_INLINE V min(V a, V b) { return a < b ? a : b; }
  FORCE_INLINE V max(V a, V b) {
#ifdef __SSE2__
    return _mm_max_ps(a, b);  // g++ 12 uses four instructions if b is a constant
#else
    return a > b ? a : b;
#endif
  }
  FORCE_INLINE V root(V s) {
    return V{__builtin_sqrtf(s[0]), __builtin_sqrtf(s[1]), __builtin_sqrtf(s[2]), __builtin_sqrtf(s[3])};
  }
  FORCE_INLINE bool any_less(V a, V b) {
    const auto less = a < b;
    return (less[0] | less[1] | less[2] | less[3]) != 0;
  }
};

#endif

/// Lanes whose fma() and fnma() round the product before they add it, which gives the same bits on every machine, or,
/// if `fast`, fuse both operations where possible.
template <class T, bool fast>
struct Arithmetic : Lanes<T> {
  using V = typename Lanes<T>::V;
  FORCE_INLINE V fma(V a, V b, V c) {
    if constexpr (fast) return Lanes<T>::fma(a, b, c);
    return a * b + c;
  }
  FORCE_INLINE V fnma(V a, V b, V c) {
    if constexpr (fast) return Lanes<T>::fnma(a, b, c);
    return c - a * b;
  }
};

/// 1 / sqrt(s), s > 0, to 2 units in the last place: by square root and division, which round identically everywhere,
/// or, if `fast`, from the machine's own estimate y, which differs between vendors. With e = 1 - s y^2, of the order of
/// the estimate's error, 1 / sqrt(s) = y (1 + e/2 + 3/8 e^2 + 5/16 e^3 + ...). The correction is added to y, so that
/// rounding affects only its last digits.
template <class T, bool fast>
FORCE_INLINE typename Lanes<T>::V rsqrt(typename Lanes<T>::V s) {
  using L = Lanes<T>;
#if defined(__AVX2__)
  if constexpr (fast) {
    const auto y = L::rsqrt_estimate(s);
    const auto e = L::fnma(s * y, y, L::all(1));
    if constexpr (sizeof(T) == 4) return L::fma(y * e, L::all(0.5f), y);  // one Newton step suffices
    auto series = L::all(0.3125f);
    if constexpr (L::width == 4) series = L::fma(e, L::all(0.2734375f), series);  // 12 bits: e^5 is 1e-16
    return L::fma(y * e, L::fma(e, L::fma(e, series, L::all(0.375f)), L::all(0.5f)), y);
  }
#endif
  return L::all(1) / L::root(s);
}

}  // namespace
}  // namespace crosscheck::simd
