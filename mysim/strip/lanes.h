// Numbers side by side: the one file that knows instruction sets. It is compiled once for each of them, in a namespace
// of its own, without any function of std::, so that no instruction of a newer machine can end up in shared code.
//
// Lanes<T> is as many numbers as one register holds, with + - * of the compiler's vector types and the few operations
// that these lack: loads, fused multiply-add, the smaller and the larger of two, and 1 / sqrt.
#pragma once

#include <immintrin.h>

#define ALWAYS [[gnu::always_inline]] static inline

namespace crosscheck::strip {
namespace {

template <class T>
struct Lanes;

#if defined(__AVX512F__)

template <>
struct Lanes<double> {
  using V = __m512d;
  static constexpr int width = 8;
  ALWAYS V load(const double* p) { return _mm512_loadu_pd(p); }
  ALWAYS void store(double* p, V a) { _mm512_storeu_pd(p, a); }
  ALWAYS V all(double a) { return _mm512_set1_pd(a); }
  ALWAYS V fma(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
  ALWAYS V fnma(V a, V b, V c) { return _mm512_fnmadd_pd(a, b, c); }
  ALWAYS V min(V a, V b) { return _mm512_min_pd(a, b); }
  ALWAYS V max(V a, V b) { return _mm512_max_pd(a, b); }
  ALWAYS V rough_inverse_root(V s) { return _mm512_rsqrt14_pd(s); }  // 14 bits
  ALWAYS V guessed_inverse_root(V s) {                               // 5 bits, from the bits of s
    return _mm512_castsi512_pd(
        _mm512_sub_epi64(_mm512_set1_epi64(0x5FE6EB50C7B537A9), _mm512_srli_epi64(_mm512_castpd_si512(s), 1)));
  }
  ALWAYS bool any_below(V a, V b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ) != 0; }
};

template <>
struct Lanes<float> {
  using V = __m512;
  static constexpr int width = 16;
  ALWAYS V load(const float* p) { return _mm512_loadu_ps(p); }
  ALWAYS void store(float* p, V a) { _mm512_storeu_ps(p, a); }
  ALWAYS V all(float a) { return _mm512_set1_ps(a); }
  ALWAYS V fma(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
  ALWAYS V fnma(V a, V b, V c) { return _mm512_fnmadd_ps(a, b, c); }
  ALWAYS V min(V a, V b) { return _mm512_min_ps(a, b); }
  ALWAYS V max(V a, V b) { return _mm512_max_ps(a, b); }
  ALWAYS V rough_inverse_root(V s) { return _mm512_rsqrt14_ps(s); }
  ALWAYS V guessed_inverse_root(V s) {
    return _mm512_castsi512_ps(
        _mm512_sub_epi32(_mm512_set1_epi32(0x5F375A86), _mm512_srli_epi32(_mm512_castps_si512(s), 1)));
  }
  ALWAYS bool any_below(V a, V b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ) != 0; }
};

#elif defined(__AVX2__)

template <>
struct Lanes<double> {
  using V = __m256d;
  static constexpr int width = 4;
  ALWAYS V load(const double* p) { return _mm256_loadu_pd(p); }
  ALWAYS void store(double* p, V a) { _mm256_storeu_pd(p, a); }
  ALWAYS V all(double a) { return _mm256_set1_pd(a); }
  ALWAYS V fma(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
  ALWAYS V fnma(V a, V b, V c) { return _mm256_fnmadd_pd(a, b, c); }
  ALWAYS V min(V a, V b) { return _mm256_min_pd(a, b); }
  ALWAYS V max(V a, V b) { return _mm256_max_pd(a, b); }
  /// 12 bits, for 1e-38 < s < 1e38.
  ALWAYS V rough_inverse_root(V s) { return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(s))); }
  ALWAYS V guessed_inverse_root(V s) {
    return _mm256_castsi256_pd(
        _mm256_sub_epi64(_mm256_set1_epi64x(0x5FE6EB50C7B537A9), _mm256_srli_epi64(_mm256_castpd_si256(s), 1)));
  }
  ALWAYS bool any_below(V a, V b) { return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ)) != 0; }
};

template <>
struct Lanes<float> {
  using V = __m256;
  static constexpr int width = 8;
  ALWAYS V load(const float* p) { return _mm256_loadu_ps(p); }
  ALWAYS void store(float* p, V a) { _mm256_storeu_ps(p, a); }
  ALWAYS V all(float a) { return _mm256_set1_ps(a); }
  ALWAYS V fma(V a, V b, V c) { return _mm256_fmadd_ps(a, b, c); }
  ALWAYS V fnma(V a, V b, V c) { return _mm256_fnmadd_ps(a, b, c); }
  ALWAYS V min(V a, V b) { return _mm256_min_ps(a, b); }
  ALWAYS V max(V a, V b) { return _mm256_max_ps(a, b); }
  ALWAYS V rough_inverse_root(V s) { return _mm256_rsqrt_ps(s); }
  ALWAYS V guessed_inverse_root(V s) {
    return _mm256_castsi256_ps(
        _mm256_sub_epi32(_mm256_set1_epi32(0x5F375A86), _mm256_srli_epi32(_mm256_castps_si256(s), 1)));
  }
  ALWAYS bool any_below(V a, V b) { return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)) != 0; }
};

#else  // SSE2: no fused multiply-add, and no seed worth its steps

template <>
struct Lanes<double> {
  using V = __m128d;
  static constexpr int width = 2;
  ALWAYS V load(const double* p) { return _mm_loadu_pd(p); }
  ALWAYS void store(double* p, V a) { _mm_storeu_pd(p, a); }
  ALWAYS V all(double a) { return _mm_set1_pd(a); }
  ALWAYS V fma(V a, V b, V c) { return a * b + c; }
  ALWAYS V fnma(V a, V b, V c) { return c - a * b; }
  ALWAYS V min(V a, V b) { return _mm_min_pd(a, b); }
  ALWAYS V max(V a, V b) { return _mm_max_pd(a, b); }
  ALWAYS V inverse_root(V s) { return all(1) / _mm_sqrt_pd(s); }
  ALWAYS bool any_below(V a, V b) { return _mm_movemask_pd(_mm_cmplt_pd(a, b)) != 0; }
};

template <>
struct Lanes<float> {
  using V = __m128;
  static constexpr int width = 4;
  ALWAYS V load(const float* p) { return _mm_loadu_ps(p); }
  ALWAYS void store(float* p, V a) { _mm_storeu_ps(p, a); }
  ALWAYS V all(float a) { return _mm_set1_ps(a); }
  ALWAYS V fma(V a, V b, V c) { return a * b + c; }
  ALWAYS V fnma(V a, V b, V c) { return c - a * b; }
  ALWAYS V min(V a, V b) { return _mm_min_ps(a, b); }
  ALWAYS V max(V a, V b) { return _mm_max_ps(a, b); }
  ALWAYS V inverse_root(V s) { return all(1) / _mm_sqrt_ps(s); }
  ALWAYS bool any_below(V a, V b) { return _mm_movemask_ps(_mm_cmplt_ps(a, b)) != 0; }
};

#endif

/// y with e = 1 - s y^2 of the order of the seed's error; y (1 + e/2 + 3/8 e^2 + 5/16 e^3) is 1 / sqrt(s) to its fourth
/// power. The correction is added to y, so that only its last digits round.
template <class L, class V>
ALWAYS V better_inverse_root(V s, V y) {
  const V e = L::fnma(s * y, y, L::all(1));
  return L::fma(y * e, L::fma(e, L::fma(e, L::all(0.3125f), L::all(0.375f)), L::all(0.5f)), y);
}

/// 1 / sqrt(s) to 2 units in the last place, s > 0. From a seed that every machine computes alike, or, where `fast`,
/// from the machine's own estimate, which differs between makers.
template <class T, bool fast>
ALWAYS typename Lanes<T>::V inverse_root(typename Lanes<T>::V s) {
  using L = Lanes<T>;
#if defined(__AVX2__)
  const auto better = [](auto squared, auto y) __attribute__((always_inline)) {
    return better_inverse_root<L>(squared, y);
  };
  if constexpr (!fast) return better(s, better(s, L::guessed_inverse_root(s)));
  auto y = L::rough_inverse_root(s);
  const auto e = L::fnma(s * y, y, L::all(1));
  if constexpr (sizeof(T) == 4) return L::fma(y * e, L::all(0.5f), y);  // one step of Newton's is enough
  if constexpr (L::width == 4)                                          // 12 bits need one power more: e^5 is 1e-16
    return L::fma(
        y * e, L::fma(e, L::fma(e, L::fma(e, L::all(0.2734375f), L::all(0.3125f)), L::all(0.375f)), L::all(0.5f)), y);
  return better(s, y);
#else
  return L::inverse_root(s);
#endif
}

}  // namespace
}  // namespace crosscheck::strip
