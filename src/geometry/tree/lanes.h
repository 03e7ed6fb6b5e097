// Eight numbers side by side, by the compiler's vectors: SSE, AVX, NEON or none. Every lane
// undergoes the same operations of IEEE arithmetic at any width, so widths agree bit-exactly.
// Includes no Eigen: the files built on it may be compiled for the host's instruction set.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

// operations are too small for calls
#define CLENCH_INLINE __attribute__((always_inline)) inline

namespace clench {

inline constexpr int lane_count = 8;

/// Real: float or double; Width: numbers per vector, 1, 2, 4 or 8; Count: number of lanes.
template <class Scalar, int Width, int Count = lane_count>
struct Lanes {
  using Real = Scalar;
  using Int = std::conditional_t<sizeof(Real) == 4, int32_t, int64_t>;
  typedef Real Chunk __attribute__((vector_size(sizeof(Real) * Width)));
  typedef Int Bits __attribute__((vector_size(sizeof(Real) * Width)));
  static constexpr int width = Width, count = Count, chunks = Count / Width;

  /// which lanes satisfy a condition
  struct Mask {
    Bits bits[chunks];

    friend CLENCH_INLINE Mask operator&(const Mask& x, const Mask& y) {
      Mask out;
      for (int i = 0; i < chunks; ++i) out.bits[i] = x.bits[i] & y.bits[i];
      return out;
    }
    friend CLENCH_INLINE Mask operator|(const Mask& x, const Mask& y) {
      Mask out;
      for (int i = 0; i < chunks; ++i) out.bits[i] = x.bits[i] | y.bits[i];
      return out;
    }
    /// bit i for lane i
    CLENCH_INLINE unsigned set() const {
#if defined(__AVX__)
      if constexpr (sizeof(Real) == 4 && Width == 8 && Count == 8)
        return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<const __m256&>(bits[0])));
#endif
#if defined(__SSE2__)
      if constexpr (sizeof(Real) == 4 && Width == 4 && Count == 8)
        return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<const __m128&>(bits[0])) |
                                     _mm_movemask_ps(reinterpret_cast<const __m128&>(bits[1]))
                                         << 4);
#endif
      unsigned out = 0;
      for (int i = 0; i < Count; ++i) out |= (bits[i / Width][i % Width] != 0 ? 1u : 0u) << i;
      return out;
    }
  };

  Chunk chunk[chunks];

  static CLENCH_INLINE Lanes all(Real x) {
    Lanes out;
    for (int i = 0; i < chunks; ++i) out.chunk[i] = Chunk{} + x;
    return out;
  }
  static CLENCH_INLINE Lanes load(const float* from) {
    Lanes out;
    if constexpr (std::is_same_v<Real, float>)
      std::memcpy(&out, from, sizeof out);
    else
      for (int i = 0; i < Count; ++i) out.chunk[i / Width][i % Width] = from[i];
    return out;
  }
  /// lanes written by store
  static CLENCH_INLINE Lanes stored(const Real* from) {
    Lanes out;
    std::memcpy(out.chunk, from, sizeof out.chunk);
    return out;
  }
  CLENCH_INLINE void store(Real* to) const { std::memcpy(to, chunk, sizeof chunk); }

#define CLENCH_LANES_OPERATOR(op)                                             \
  friend CLENCH_INLINE Lanes operator op(const Lanes& x, const Lanes& y) {    \
    Lanes out;                                                                \
    for (int i = 0; i < chunks; ++i) out.chunk[i] = x.chunk[i] op y.chunk[i]; \
    return out;                                                               \
  }                                                                           \
  friend CLENCH_INLINE Lanes operator op(const Lanes& x, Real y) {            \
    Lanes out;                                                                \
    for (int i = 0; i < chunks; ++i) out.chunk[i] = x.chunk[i] op y;          \
    return out;                                                               \
  }
#define CLENCH_LANES_COMPARISON(op)                                          \
  friend CLENCH_INLINE Mask operator op(const Lanes& x, const Lanes& y) {    \
    Mask out;                                                                \
    for (int i = 0; i < chunks; ++i) out.bits[i] = x.chunk[i] op y.chunk[i]; \
    return out;                                                              \
  }                                                                          \
  friend CLENCH_INLINE Mask operator op(const Lanes& x, Real y) {            \
    Mask out;                                                                \
    for (int i = 0; i < chunks; ++i) out.bits[i] = x.chunk[i] op y;          \
    return out;                                                              \
  }
  CLENCH_LANES_OPERATOR(+)
  CLENCH_LANES_OPERATOR(-)
  CLENCH_LANES_OPERATOR(*)
  CLENCH_LANES_OPERATOR(/)
  CLENCH_LANES_COMPARISON(<)
  CLENCH_LANES_COMPARISON(>)
  CLENCH_LANES_COMPARISON(<=)
  CLENCH_LANES_COMPARISON(>=)
#undef CLENCH_LANES_OPERATOR
#undef CLENCH_LANES_COMPARISON

  CLENCH_INLINE Lanes operator-() const {
    Lanes out;
    for (int i = 0; i < chunks; ++i) out.chunk[i] = -chunk[i];
    return out;
  }
  // the second argument if one is NaN
  friend CLENCH_INLINE Lanes max(const Lanes& x, const Lanes& y) {
    Lanes out;
    for (int i = 0; i < chunks; ++i)
      out.chunk[i] = x.chunk[i] > y.chunk[i] ? x.chunk[i] : y.chunk[i];
    return out;
  }
  friend CLENCH_INLINE Lanes min(const Lanes& x, const Lanes& y) {
    Lanes out;
    for (int i = 0; i < chunks; ++i)
      out.chunk[i] = x.chunk[i] < y.chunk[i] ? x.chunk[i] : y.chunk[i];
    return out;
  }
  friend CLENCH_INLINE Lanes abs(const Lanes& x) {
    Lanes out;
    constexpr Int most = ~(Int{1} << (8 * sizeof(Real) - 1));
    for (int i = 0; i < chunks; ++i)
      out.chunk[i] = reinterpret_cast<Chunk>(reinterpret_cast<Bits>(x.chunk[i]) & most);
    return out;
  }
  friend CLENCH_INLINE Lanes sqrt(const Lanes& x) {
    Lanes out;
#if defined(__AVX__)
    if constexpr (sizeof(Real) == 4 && Width == 8 && Count == 8) {
      const __m256 root = _mm256_sqrt_ps(reinterpret_cast<const __m256&>(x.chunk[0]));
      std::memcpy(&out, &root, sizeof out);
      return out;
    }
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(Real) == 4 && Width == 4 && Count == 8) {
      for (int i = 0; i < chunks; ++i) {
        const __m128 root = _mm_sqrt_ps(reinterpret_cast<const __m128&>(x.chunk[i]));
        std::memcpy(&out.chunk[i], &root, sizeof root);
      }
      return out;
    }
#endif
    for (int i = 0; i < Count; ++i)
      out.chunk[i / Width][i % Width] = std::sqrt(x.chunk[i / Width][i % Width]);
    return out;
  }
  friend CLENCH_INLINE Lanes select(const Mask& mask, const Lanes& yes, const Lanes& no) {
    Lanes out;
    for (int i = 0; i < chunks; ++i) out.chunk[i] = mask.bits[i] ? yes.chunk[i] : no.chunk[i];
    return out;
  }
};

template <class F>
CLENCH_INLINE typename F::Real min_of(const F& x) {
  typename F::Real values[lane_count];
  x.store(values);
  for (int step = lane_count / 2; step > 0; step /= 2)
    for (int i = 0; i < step; ++i)
      values[i] = values[i + step] < values[i] ? values[i + step] : values[i];
  return values[0];
}

#if defined(__AVX__)
using FloatLanes = Lanes<float, 8>;
using DoubleLanes = Lanes<double, 4>;
#else
using FloatLanes = Lanes<float, 4>;
using DoubleLanes = Lanes<double, 2>;
#endif

/// bit i if number i is not negative: unused lanes of a bundle have -1
CLENCH_INLINE unsigned used_lanes(const int32_t* numbers) {
  FloatLanes::Mask negative;
  std::memcpy(&negative, numbers, sizeof negative);
  for (auto& bits : negative.bits) bits = bits < 0;
  return ~negative.set() & 0xff;
}

/// A vector in each lane, or a single one if F is a number.
template <class F>
struct Triple {
  F x, y, z;

  friend CLENCH_INLINE Triple operator+(const Triple& u, const Triple& v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
  }
  friend CLENCH_INLINE Triple operator-(const Triple& u, const Triple& v) {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
  }
  CLENCH_INLINE Triple scaled(const F& by) const { return {x * by, y * by, z * by}; }
};

// a vector of lanes, and one that is the same in all of them, in any order
template <class F, class G>
CLENCH_INLINE auto dot(const Triple<F>& u, const Triple<G>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

template <class F>
CLENCH_INLINE Triple<F> cross(const Triple<F>& u, const Triple<F>& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

template <class F>
CLENCH_INLINE Triple<F> select(const typename F::Mask& mask, const Triple<F>& yes,
                               const Triple<F>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// a rotation, rows of a matrix, followed by a translation: p -> R p + offset
template <class Real>
struct Move {
  Triple<Real> row[3];
  Triple<Real> offset;

  template <class F>
  CLENCH_INLINE Triple<F> turned(const Triple<F>& v) const {
    return {dot(v, row[0]), dot(v, row[1]), dot(v, row[2])};
  }
  template <class F>
  CLENCH_INLINE Triple<F> operator()(const Triple<F>& p) const {
    const Triple<F> t = turned(p);
    return {t.x + offset.x, t.y + offset.y, t.z + offset.z};
  }
};

}  // namespace clench
