#pragma once
#include "motion/block.h"

/// Four lanes: one number of each of four contacts. Each operation of block.h is applied to every lane, with the same
/// bits. Only for files that are compiled for processors with such registers.
namespace detent {
inline namespace DETENT_NAMESPACE {

typedef int32_t QuadInt32 __attribute__((vector_size(16)));

#define DETENT_QUAD_INLINE inline __attribute__((always_inline))

#if DETENT_FIXED

typedef int64_t QuadInt64 __attribute__((vector_size(32)));
typedef uint64_t QuadUint64 __attribute__((vector_size(32)));

/// Ulps, factors, sums of products, and the raw numbers of Reals and Units. A factor or Unit that is only multiplied
/// uses its low half; the high half may contain anything.
struct Quad {
  QuadInt64 v;
};
struct QuadMask {
  QuadInt64 v;
};
struct QuadScaled {
  Quad mantissa, exponent;
};

DETENT_QUAD_INLINE Quad quad_of(int64_t value) { return {QuadInt64{value, value, value, value}}; }

#else

typedef Real QuadFloat __attribute__((vector_size(4 * sizeof(Real))));

struct Quad {
  QuadFloat v;
};
using QuadMaskBits = decltype(QuadFloat{} > QuadFloat{});
struct QuadMask {
  QuadMaskBits v;
};
using QuadScaled = Quad;

DETENT_QUAD_INLINE Quad quad_of(Real value) { return {QuadFloat{value, value, value, value}}; }

#endif

DETENT_QUAD_INLINE Quad operator+(Quad a, Quad b) { return {a.v + b.v}; }
DETENT_QUAD_INLINE Quad operator-(Quad a, Quad b) { return {a.v - b.v}; }
DETENT_QUAD_INLINE Quad operator-(Quad a) { return {-a.v}; }
DETENT_QUAD_INLINE Quad& operator+=(Quad& a, Quad b) { return a = a + b; }
DETENT_QUAD_INLINE Quad& operator-=(Quad& a, Quad b) { return a = a - b; }
DETENT_QUAD_INLINE QuadMask operator>(Quad a, Quad b) { return {a.v > b.v}; }
DETENT_QUAD_INLINE QuadMask operator&(QuadMask a, QuadMask b) { return {a.v & b.v}; }
DETENT_QUAD_INLINE QuadMask operator|(QuadMask a, QuadMask b) { return {a.v | b.v}; }
DETENT_QUAD_INLINE Quad select(QuadMask mask, Quad a, Quad b) { return {mask.v ? a.v : b.v}; }
DETENT_QUAD_INLINE bool any(QuadMask mask) { return (mask.v[0] | mask.v[1] | mask.v[2] | mask.v[3]) != 0; }
DETENT_QUAD_INLINE Quad max(Quad a, Quad b) { return select(b > a, b, a); }
DETENT_QUAD_INLINE Quad min(Quad a, Quad b) { return select(a > b, b, a); }
DETENT_QUAD_INLINE Quad clamp(Quad value, Quad low, Quad high) { return min(max(value, low), high); }

#if DETENT_FIXED

DETENT_QUAD_INLINE Quad operator-(Quad a, int b) { return a - quad_of(b); }

/// value times 2^-n, rounded down. Range: 0 <= n <= 63.
DETENT_QUAD_INLINE Quad shifted_down(Quad value, Quad n) {
  const QuadUint64 sign = reinterpret_cast<QuadUint64>(quad_of(INT64_MIN).v), by = reinterpret_cast<QuadUint64>(n.v);
  const QuadUint64 moved = (reinterpret_cast<QuadUint64>(value.v) ^ sign) >> by;
  return {reinterpret_cast<QuadInt64>(moved - (sign >> by))};
}
/// Same result as round_shift_64(). Range: 1 <= n <= 63.
DETENT_QUAD_INLINE Quad round_shift_any(Quad value, Quad n) {
  const QuadUint64 sign = reinterpret_cast<QuadUint64>(quad_of(INT64_MIN).v), by = reinterpret_cast<QuadUint64>(n.v);
  const QuadUint64 one = reinterpret_cast<QuadUint64>(quad_of(1).v);
  const QuadUint64 twice = (reinterpret_cast<QuadUint64>(value.v) ^ sign) >> (by - one);
  return {reinterpret_cast<QuadInt64>(((twice + one) >> one) - (sign >> by))};
}
/// Same result as round_shift_64(). Range: |value| < 2^62, 1 <= n <= 63.
DETENT_QUAD_INLINE Quad round_shift(Quad value, Quad n) {
  const QuadUint64 bias = reinterpret_cast<QuadUint64>(quad_of(int64_t{1} << 62).v);
  const QuadUint64 one = reinterpret_cast<QuadUint64>(quad_of(1).v), by = reinterpret_cast<QuadUint64>(n.v);
  const QuadUint64 sum = reinterpret_cast<QuadUint64>(value.v) + bias + (one << (by - one));
  return {reinterpret_cast<QuadInt64>((sum >> by) - (bias >> by))};
}

DETENT_QUAD_INLINE Quad held(Quad a) { return clamp(a, quad_of(-k_factor_max), quad_of(k_factor_max)); }
DETENT_QUAD_INLINE Quad product(Quad a, Quad b) {
#if defined(__AVX2__)
  typedef int32_t Halves __attribute__((vector_size(32)));
  return {reinterpret_cast<QuadInt64>(
      __builtin_ia32_pmuldq256(reinterpret_cast<Halves>(a.v), reinterpret_cast<Halves>(b.v)))};
#else
  return {((a.v << 32) >> 32) * ((b.v << 32) >> 32)};
#endif
}
DETENT_QUAD_INLINE Quad rounded(Quad sum) { return round_shift(sum, quad_of(k_unit_frac)); }
DETENT_QUAD_INLINE Quad whole(Quad a) { return {a.v << k_unit_frac}; }
DETENT_QUAD_INLINE Quad times(Quad a, Quad b) { return rounded(product(a, b)); }
DETENT_QUAD_INLINE Quad times_scaled(Quad a, Quad b, Quad exponent) {
  return round_shift(product(a, b), quad_of(k_unit_frac) - exponent);
}
DETENT_QUAD_INLINE Quad sum_from(Quad a, Quad exponent) { return {a.v << (quad_of(k_unit_frac) - exponent).v}; }
DETENT_QUAD_INLINE Quad rounded(Quad sum, Quad exponent) { return round_shift(sum, quad_of(k_unit_frac) - exponent); }
DETENT_QUAD_INLINE Quad times(Quad a, const QuadScaled& b) {
  const Quad none = quad_of(0), n = clamp(-b.exponent, quad_of(1), quad_of(63));
  const Quad usual = held(round_shift(product(a, b.mantissa), n));
  const Quad most = select(a > none, quad_of(k_factor_max), select(none > a, quad_of(-k_factor_max), none));
  const QuadMask large = b.exponent > quad_of(-1), nothing = {b.mantissa.v == none.v};
  return select(large, select(nothing, none, most), select(quad_of(-63) > b.exponent, none, usual));
}

class QuadBlock {
 public:
  DETENT_QUAD_INLINE void include(const Vec3<Quad>& v, int exponent) {
    include_bits(magnitude(v.x) | magnitude(v.y) | magnitude(v.z), k_spin_power - exponent);
  }
  /// Includes all numbers at once, combined by `or`. Range: not negative.
  template <unsigned count>
  DETENT_QUAD_INLINE void include(const Quad (&values)[count], uint32_t used) {
    QuadInt64 all = {0, 0, 0, 0};
    for (uint32_t i = 0; i < used; ++i) all |= magnitude(values[i]);
    include_bits(all, k_number_drop);
  }
  DETENT_QUAD_INLINE void settle() { shift_ = max(shift_, lengths({bits_}) + quad_of(k_bits_power)); }
  DETENT_QUAD_INLINE Vec3<Quad> mantissas(const Vec3<Quad>& v, int exponent) const {
    const Quad n = shift_ - quad_of(exponent);
    return {round_shift_any(v.x, n), round_shift_any(v.y, n), round_shift_any(v.z, n)};
  }
  DETENT_QUAD_INLINE Quad held(Quad value) const { return detent::held(number(value)); }
  DETENT_QUAD_INLINE Quad number(Quad value) const { return shifted_down(value, shift_); }
  DETENT_QUAD_INLINE Quad real(Quad ulps) const { return {ulps.v << shift_.v}; }
  DETENT_QUAD_INLINE Vec3<Quad> real(const Vec3<Quad>& v, const QuadScaled& share, Quad exponent) const {
    const Quad n = -(shift_ + share.exponent + exponent), none = quad_of(0);
    const QuadMask down = n > none;
    const Quad right = clamp(n, quad_of(1), quad_of(63)), left = clamp(-n, none, quad_of(63));
    const auto part = [&](Quad value) {
      const Quad whole_product = product(value, share.mantissa);
      return select(down, round_shift(whole_product, right), Quad{whole_product.v << left.v});
    };
    return {part(v.x), part(v.y), part(v.z)};
  }
  DETENT_QUAD_INLINE Vec3<Quad> real(const Vec3<Quad>& v, const QuadScaled& share, int exponent) const {
    return real(v, share, quad_of(exponent));
  }
  DETENT_QUAD_INLINE Quad converted(Quad ulps, const QuadBlock& from, int exponent) const {
    const Quad n = from.shift_ + quad_of(exponent) - shift_, none = quad_of(0);
    const Quad right = clamp(-n, quad_of(1), quad_of(63)), left = clamp(n, none, quad_of(31));
    return detent::held(select(none > n, round_shift(ulps, right), Quad{ulps.v << left.v}));
  }
  template <unsigned count>
  DETENT_QUAD_INLINE void coarsen(Quad (&parts)[count]) {
    QuadInt64 all = {0, 0, 0, 0};
    for (const Quad& part : parts) all |= magnitude(part);
    const Quad n = max(lengths({all}) - quad_of(k_wrench_bits), quad_of(0));
    if (!any(n > quad_of(0))) return;
    for (Quad& part : parts) part = select(n > quad_of(0), round_shift_any(part, max(n, quad_of(1))), part);
    shift_ += n;
  }

 private:
  DETENT_QUAD_INLINE static QuadInt64 magnitude(Quad a) { return a.v < 0 ? -a.v : a.v; }
  DETENT_QUAD_INLINE static Quad lengths(Quad all) {
    Quad result;
    for (int i = 0; i < 4; ++i) result.v[i] = bit_length_64(static_cast<uint64_t>(all.v[i]));
    return result;
  }
  DETENT_QUAD_INLINE void include_bits(QuadInt64 all, int drop) {
    bits_ |= reinterpret_cast<QuadInt64>(reinterpret_cast<QuadUint64>(all) >> static_cast<uint64_t>(drop));
  }
  QuadInt64 bits_ = {0, 0, 0, 0};
  Quad shift_ = quad_of(k_shift_min);
};

#else

DETENT_QUAD_INLINE Quad held(Quad a) { return a; }
DETENT_QUAD_INLINE Quad product(Quad a, Quad b) { return {a.v * b.v}; }
DETENT_QUAD_INLINE Quad rounded(Quad sum) { return sum; }
DETENT_QUAD_INLINE Quad whole(Quad a) { return a; }
DETENT_QUAD_INLINE Quad times(Quad a, Quad b) { return {a.v * b.v}; }
DETENT_QUAD_INLINE Quad times_scaled(Quad a, Quad b, int) { return {a.v * b.v}; }
DETENT_QUAD_INLINE Quad sum_from(Quad a, int) { return a; }
DETENT_QUAD_INLINE Quad rounded(Quad sum, int) { return sum; }

class QuadBlock {
 public:
  void include(const Vec3<Quad>&, int) {}
  template <unsigned count>
  void include(const Quad (&)[count], uint32_t) {}
  void settle() {}
  DETENT_QUAD_INLINE Vec3<Quad> mantissas(const Vec3<Quad>& v, int) const { return v; }
  DETENT_QUAD_INLINE Quad held(Quad value) const { return value; }
  DETENT_QUAD_INLINE Quad number(Quad value) const { return value; }
  DETENT_QUAD_INLINE Quad real(Quad ulps) const { return ulps; }
  DETENT_QUAD_INLINE Vec3<Quad> real(const Vec3<Quad>& v, Quad share, int) const {
    return {times(v.x, share), times(v.y, share), times(v.z, share)};
  }
  DETENT_QUAD_INLINE Quad converted(Quad value, const QuadBlock&, int exponent) const {
    return {value.v * power_of_two<Real>(exponent)};
  }
  template <unsigned count>
  void coarsen(Quad (&)[count]) {}
};

#endif

DETENT_QUAD_INLINE Quad dot(const Vec3<Quad>& a, const Vec3<Quad>& b) {
  return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
}
/// The sums must round to factors.
DETENT_QUAD_INLINE Vec3<Quad> rounded(Quad x, Quad y, Quad z) {
#if DETENT_FIXED
  const auto part = [](Quad sum) {
    const QuadUint64 half = reinterpret_cast<QuadUint64>(quad_of(int64_t{1} << (k_unit_frac - 1)).v);
    return Quad{reinterpret_cast<QuadInt64>((reinterpret_cast<QuadUint64>(sum.v) + half) >> k_unit_frac)};
  };
  return {part(x), part(y), part(z)};
#else
  return {x, y, z};
#endif
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
