#pragma once

// Vectors of 32 bytes in the notation that GCC and Clang share: four doubles or eight floats. On a machine without such
// registers the compiler makes two of two. Everything here is inlined, so that it becomes part of whatever instruction
// set the caller is compiled for, and takes references, because passing wide vectors is no part of the common ABI.

namespace octupole::internal {

template <typename Scalar>
struct LanesOf;
template <>
struct LanesOf<double> {
  typedef double Type __attribute__((vector_size(32), may_alias));
  typedef double Unaligned __attribute__((vector_size(32), aligned(8), may_alias));
  typedef double Four __attribute__((vector_size(32), may_alias));
  // As many floats.
  typedef float Floats __attribute__((vector_size(16), aligned(4), may_alias));
};
template <>
struct LanesOf<float> {
  typedef float Type __attribute__((vector_size(32), may_alias));
  typedef float Unaligned __attribute__((vector_size(32), aligned(4), may_alias));
  typedef float Four __attribute__((vector_size(16), may_alias));
  typedef Unaligned Floats;
};

template <typename Scalar>
using Lanes = typename LanesOf<Scalar>::Type;
template <typename Scalar>
inline constexpr int kLanes = 32 / sizeof(Scalar);

#define OCTUPOLE_INLINE inline __attribute__((always_inline))

#if defined(__x86_64__)
#define OCTUPOLE_WIDE __attribute__((target("avx2,fma")))
inline bool HasWideLanes() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
#else
#define OCTUPOLE_WIDE
inline bool HasWideLanes() { return false; }
#endif

/// A lambda of this kind becomes part of its caller.
#define OCTUPOLE_INLINE_LAMBDA __attribute__((always_inline))

template <typename Work>
OCTUPOLE_WIDE auto CallWide(const Work& work) {
  return work();
}
template <typename Work>
auto CallNarrow(const Work& work) {
  return work();
}
/// Calls `work`, an OCTUPOLE_INLINE_LAMBDA, compiled twice: for the build's instruction set and for AVX2, where the
/// machine has that.
template <typename Work>
auto CallVectorised(const Work& work) {
  return HasWideLanes() ? CallWide(work) : CallNarrow(work);
}

/// The lanes at an address aligned to 32 bytes.
template <typename Scalar>
OCTUPOLE_INLINE const Lanes<Scalar>& LanesAt(const Scalar* address) {
  return *reinterpret_cast<const Lanes<Scalar>*>(address);
}
template <typename Scalar>
OCTUPOLE_INLINE Lanes<Scalar>& LanesAt(Scalar* address) {
  return *reinterpret_cast<Lanes<Scalar>*>(address);
}

/// The sum of all lanes.
template <typename Vector>
OCTUPOLE_INLINE double SumOf(const Vector& lanes) {
  double sum = 0;
  for (unsigned i = 0; i < sizeof(lanes) / sizeof(lanes[0]); ++i) sum += static_cast<double>(lanes[i]);
  return sum;
}

/// sums[k] = the sum of the lanes of v[k], k = 0 .. 3.
OCTUPOLE_INLINE void SumLanes(const Lanes<double>* v, LanesOf<double>::Four* sums) {
  const Lanes<double> pairs01 =
      __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6) + __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Lanes<double> pairs23 =
      __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6) + __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  *sums = __builtin_shufflevector(pairs01, pairs23, 0, 1, 4, 5) + __builtin_shufflevector(pairs01, pairs23, 2, 3, 6, 7);
}

OCTUPOLE_INLINE void SumLanes(const Lanes<float>* v, LanesOf<float>::Four* sums) {
  const Lanes<float> pairs01 = __builtin_shufflevector(v[0], v[1], 0, 2, 8, 10, 4, 6, 12, 14) +
                               __builtin_shufflevector(v[0], v[1], 1, 3, 9, 11, 5, 7, 13, 15);
  const Lanes<float> pairs23 = __builtin_shufflevector(v[2], v[3], 0, 2, 8, 10, 4, 6, 12, 14) +
                               __builtin_shufflevector(v[2], v[3], 1, 3, 9, 11, 5, 7, 13, 15);
  const Lanes<float> halves = __builtin_shufflevector(pairs01, pairs23, 0, 2, 8, 10, 4, 6, 12, 14) +
                              __builtin_shufflevector(pairs01, pairs23, 1, 3, 9, 11, 5, 7, 13, 15);
  *sums = __builtin_shufflevector(halves, halves, 0, 1, 2, 3) + __builtin_shufflevector(halves, halves, 4, 5, 6, 7);
}

/// Exchanges the lanes of as many vectors as there are lanes with their numbers.
OCTUPOLE_INLINE void TransposeLanes(Lanes<double>* v) {
  const Lanes<double> low01 = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6);
  const Lanes<double> high01 = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Lanes<double> low23 = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6);
  const Lanes<double> high23 = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  v[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  v[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  v[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

OCTUPOLE_INLINE void TransposeLanes(Lanes<float>* v) {
  Lanes<float> pairs[8], quads[8];
  for (int i = 0; i < 8; i += 2) {
    pairs[i] = __builtin_shufflevector(v[i], v[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    pairs[i + 1] = __builtin_shufflevector(v[i], v[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int k = 0; k < 2; ++k) {
      quads[i + 2 * k] = __builtin_shufflevector(pairs[i + k], pairs[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      quads[i + 2 * k + 1] = __builtin_shufflevector(pairs[i + k], pairs[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int i = 0; i < 4; ++i) {
    v[i] = __builtin_shufflevector(quads[i], quads[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    v[i + 4] = __builtin_shufflevector(quads[i], quads[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace octupole::internal
