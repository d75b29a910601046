#pragma once

// Vectors of four doubles in the notation that GCC and Clang share. On a machine without such registers the compiler
// makes two of two. Everything here is inlined, so that it becomes part of whatever instruction set the caller is
// compiled for, and takes references, because passing wide vectors is no part of the common ABI.

namespace octupole::internal {

typedef double Lanes __attribute__((vector_size(32), may_alias));
typedef float FloatLanes __attribute__((vector_size(16), may_alias));

#define OCTUPOLE_INLINE inline __attribute__((always_inline))

#if defined(__x86_64__)
#define OCTUPOLE_WIDE __attribute__((target("avx2,fma")))
inline bool HasWideLanes() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
#else
#define OCTUPOLE_WIDE
inline bool HasWideLanes() { return false; }
#endif

/// The lanes at an address aligned to 32 bytes.
OCTUPOLE_INLINE const Lanes& LanesAt(const double* address) { return *reinterpret_cast<const Lanes*>(address); }
OCTUPOLE_INLINE Lanes& LanesAt(double* address) { return *reinterpret_cast<Lanes*>(address); }

/// sums[k] = the sum of the lanes of v_k.
OCTUPOLE_INLINE void SumLanes(const Lanes& v0, const Lanes& v1, const Lanes& v2, const Lanes& v3, Lanes* sums) {
  const Lanes pairs01 = __builtin_shufflevector(v0, v1, 0, 4, 2, 6) + __builtin_shufflevector(v0, v1, 1, 5, 3, 7);
  const Lanes pairs23 = __builtin_shufflevector(v2, v3, 0, 4, 2, 6) + __builtin_shufflevector(v2, v3, 1, 5, 3, 7);
  *sums = __builtin_shufflevector(pairs01, pairs23, 0, 1, 4, 5) + __builtin_shufflevector(pairs01, pairs23, 2, 3, 6, 7);
}

/// Exchanges the lanes of four vectors with their numbers.
OCTUPOLE_INLINE void TransposeLanes(Lanes* v) {
  const Lanes low01 = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6);
  const Lanes high01 = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Lanes low23 = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6);
  const Lanes high23 = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  v[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  v[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  v[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

}  // namespace octupole::internal
