#pragma once
#include "motion/block.h"

/// Four lanes: a register that holds one number of each of four contacts. The operations of block.h, applied to each
/// lane; the results have the same bits. Only for files that are compiled for processors with registers of 256 bits.
namespace detent {
inline namespace DETENT_NAMESPACE {

typedef int32_t LaneInt32 __attribute__((vector_size(16)));

#define DETENT_LANES_INLINE inline __attribute__((always_inline))

#if DETENT_FIXED

typedef int64_t LaneInt64 __attribute__((vector_size(32)));
typedef uint64_t LaneUint64 __attribute__((vector_size(32)));

/// Ulps, factors, sums of products, and the raw numbers of Reals and Units. A factor or Unit that is only multiplied
/// uses its low half; the high half may contain anything.
struct Lanes {
  LaneInt64 v;
};
struct LaneMask {
  LaneInt64 v;
};
struct LaneScaled {
  Lanes mantissa, exponent;
};

DETENT_LANES_INLINE Lanes lanes_of(int64_t value) { return {LaneInt64{value, value, value, value}}; }

#else

typedef Real LaneFloat __attribute__((vector_size(4 * sizeof(Real))));

struct Lanes {
  LaneFloat v;
};
using LaneMaskBits = decltype(LaneFloat{} > LaneFloat{});
struct LaneMask {
  LaneMaskBits v;
};
using LaneScaled = Lanes;

DETENT_LANES_INLINE Lanes lanes_of(Real value) { return {LaneFloat{value, value, value, value}}; }

#endif

DETENT_LANES_INLINE Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
DETENT_LANES_INLINE Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
DETENT_LANES_INLINE Lanes operator-(Lanes a) { return {-a.v}; }
DETENT_LANES_INLINE Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
DETENT_LANES_INLINE Lanes& operator-=(Lanes& a, Lanes b) { return a = a - b; }
DETENT_LANES_INLINE LaneMask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
DETENT_LANES_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
DETENT_LANES_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }
DETENT_LANES_INLINE Lanes select(LaneMask mask, Lanes a, Lanes b) { return {mask.v ? a.v : b.v}; }
DETENT_LANES_INLINE bool any(LaneMask mask) { return (mask.v[0] | mask.v[1] | mask.v[2] | mask.v[3]) != 0; }
DETENT_LANES_INLINE Lanes max(Lanes a, Lanes b) { return select(b > a, b, a); }
DETENT_LANES_INLINE Lanes min(Lanes a, Lanes b) { return select(a > b, b, a); }
DETENT_LANES_INLINE Lanes clamp(Lanes value, Lanes low, Lanes high) { return min(max(value, low), high); }

#if DETENT_FIXED

DETENT_LANES_INLINE Lanes operator-(Lanes a, int b) { return a - lanes_of(b); }

/// value times 2^-n, rounded down. Range: 0 <= n <= 63.
DETENT_LANES_INLINE Lanes shifted_down(Lanes value, Lanes n) {
  const LaneUint64 sign = reinterpret_cast<LaneUint64>(lanes_of(INT64_MIN).v), by = reinterpret_cast<LaneUint64>(n.v);
  const LaneUint64 moved = (reinterpret_cast<LaneUint64>(value.v) ^ sign) >> by;
  return {reinterpret_cast<LaneInt64>(moved - (sign >> by))};
}
/// In each lane the result of round_shift_64(). Range: 1 <= n <= 63.
DETENT_LANES_INLINE Lanes round_shift_any(Lanes value, Lanes n) {
  const LaneUint64 sign = reinterpret_cast<LaneUint64>(lanes_of(INT64_MIN).v), by = reinterpret_cast<LaneUint64>(n.v);
  const LaneUint64 one = reinterpret_cast<LaneUint64>(lanes_of(1).v);
  const LaneUint64 twice = (reinterpret_cast<LaneUint64>(value.v) ^ sign) >> (by - one);
  return {reinterpret_cast<LaneInt64>(((twice + one) >> one) - (sign >> by))};
}
/// In each lane the result of round_shift_64(). Range: |value| < 2^62, 1 <= n <= 63.
DETENT_LANES_INLINE Lanes round_shift(Lanes value, Lanes n) {
  const LaneUint64 bias = reinterpret_cast<LaneUint64>(lanes_of(int64_t{1} << 62).v);
  const LaneUint64 one = reinterpret_cast<LaneUint64>(lanes_of(1).v), by = reinterpret_cast<LaneUint64>(n.v);
  const LaneUint64 sum = reinterpret_cast<LaneUint64>(value.v) + bias + (one << (by - one));
  return {reinterpret_cast<LaneInt64>((sum >> by) - (bias >> by))};
}

DETENT_LANES_INLINE Lanes held(Lanes a) { return clamp(a, lanes_of(-k_factor_max), lanes_of(k_factor_max)); }
DETENT_LANES_INLINE Lanes product(Lanes a, Lanes b) {
#if defined(__AVX2__)
  typedef int32_t Halves __attribute__((vector_size(32)));
  return {reinterpret_cast<LaneInt64>(
      __builtin_ia32_pmuldq256(reinterpret_cast<Halves>(a.v), reinterpret_cast<Halves>(b.v)))};
#else
  return {((a.v << 32) >> 32) * ((b.v << 32) >> 32)};
#endif
}
DETENT_LANES_INLINE Lanes rounded(Lanes sum) { return round_shift(sum, lanes_of(k_unit_frac)); }
DETENT_LANES_INLINE Lanes whole(Lanes a) { return {a.v << k_unit_frac}; }
DETENT_LANES_INLINE Lanes times(Lanes a, Lanes b) { return rounded(product(a, b)); }
DETENT_LANES_INLINE Lanes times_scaled(Lanes a, Lanes b, Lanes exponent) {
  return round_shift(product(a, b), lanes_of(k_unit_frac) - exponent);
}
DETENT_LANES_INLINE Lanes sum_from(Lanes a, Lanes exponent) { return {a.v << (lanes_of(k_unit_frac) - exponent).v}; }
DETENT_LANES_INLINE Lanes rounded(Lanes sum, Lanes exponent) {
  return round_shift(sum, lanes_of(k_unit_frac) - exponent);
}
DETENT_LANES_INLINE Lanes times(Lanes a, const LaneScaled& b) {
  const Lanes none = lanes_of(0), n = clamp(-b.exponent, lanes_of(1), lanes_of(63));
  const Lanes usual = held(round_shift(product(a, b.mantissa), n));
  const Lanes most = select(a > none, lanes_of(k_factor_max), select(none > a, lanes_of(-k_factor_max), none));
  const LaneMask large = b.exponent > lanes_of(-1), nothing = {b.mantissa.v == none.v};
  return select(large, select(nothing, none, most), select(lanes_of(-63) > b.exponent, none, usual));
}

class LaneBlock {
 public:
  DETENT_LANES_INLINE void include(const Vec3<Lanes>& v, int exponent) {
    include_bits(magnitude(v.x) | magnitude(v.y) | magnitude(v.z), k_angular_velocity_power - exponent);
  }
  /// Includes all numbers at once, combined by `or`. Range: not negative.
  template <unsigned count>
  DETENT_LANES_INLINE void include(const Lanes (&values)[count], uint32_t used) {
    LaneInt64 all = {0, 0, 0, 0};
    for (uint32_t i = 0; i < used; ++i) all |= magnitude(values[i]);
    include_bits(all, k_number_drop);
  }
  DETENT_LANES_INLINE void settle() { shift_ = max(shift_, lengths({bits_}) + lanes_of(k_bits_power)); }
  DETENT_LANES_INLINE Vec3<Lanes> mantissas(const Vec3<Lanes>& v, int exponent) const {
    const Lanes n = shift_ - lanes_of(exponent);
    return {round_shift_any(v.x, n), round_shift_any(v.y, n), round_shift_any(v.z, n)};
  }
  DETENT_LANES_INLINE Lanes held(Lanes value) const { return detent::held(number(value)); }
  DETENT_LANES_INLINE Lanes number(Lanes value) const { return shifted_down(value, shift_); }
  DETENT_LANES_INLINE Lanes real(Lanes ulps) const { return {ulps.v << shift_.v}; }
  DETENT_LANES_INLINE Vec3<Lanes> real(const Vec3<Lanes>& v, const LaneScaled& share, Lanes exponent) const {
    const Lanes n = -(shift_ + share.exponent + exponent), none = lanes_of(0);
    const LaneMask down = n > none;
    const Lanes right = clamp(n, lanes_of(1), lanes_of(63)), left = clamp(-n, none, lanes_of(63));
    const auto part = [&](Lanes value) {
      const Lanes whole_product = product(value, share.mantissa);
      return select(down, round_shift(whole_product, right), Lanes{whole_product.v << left.v});
    };
    return {part(v.x), part(v.y), part(v.z)};
  }
  DETENT_LANES_INLINE Vec3<Lanes> real(const Vec3<Lanes>& v, const LaneScaled& share, int exponent) const {
    return real(v, share, lanes_of(exponent));
  }
  DETENT_LANES_INLINE Lanes converted(Lanes ulps, const LaneBlock& from, int exponent) const {
    const Lanes n = from.shift_ + lanes_of(exponent) - shift_, none = lanes_of(0);
    const Lanes right = clamp(-n, lanes_of(1), lanes_of(63)), left = clamp(n, none, lanes_of(31));
    return detent::held(select(none > n, round_shift(ulps, right), Lanes{ulps.v << left.v}));
  }
  template <unsigned count>
  DETENT_LANES_INLINE void coarsen(Lanes (&parts)[count]) {
    LaneInt64 all = {0, 0, 0, 0};
    for (const Lanes& part : parts) all |= magnitude(part);
    const Lanes n = max(lengths({all}) - lanes_of(k_wrench_bits), lanes_of(0));
    if (!any(n > lanes_of(0))) return;
    for (Lanes& part : parts) part = select(n > lanes_of(0), round_shift_any(part, max(n, lanes_of(1))), part);
    shift_ += n;
  }

 private:
  DETENT_LANES_INLINE static LaneInt64 magnitude(Lanes a) { return a.v < 0 ? -a.v : a.v; }
  DETENT_LANES_INLINE static Lanes lengths(Lanes all) {
    Lanes result;
    for (int i = 0; i < 4; ++i) result.v[i] = bit_length_64(static_cast<uint64_t>(all.v[i]));
    return result;
  }
  DETENT_LANES_INLINE void include_bits(LaneInt64 all, int drop) {
    bits_ |= reinterpret_cast<LaneInt64>(reinterpret_cast<LaneUint64>(all) >> static_cast<uint64_t>(drop));
  }
  LaneInt64 bits_ = {0, 0, 0, 0};
  Lanes shift_ = lanes_of(k_shift_min);
};

#else

DETENT_LANES_INLINE Lanes held(Lanes a) { return a; }
DETENT_LANES_INLINE Lanes product(Lanes a, Lanes b) { return {a.v * b.v}; }
DETENT_LANES_INLINE Lanes rounded(Lanes sum) { return sum; }
DETENT_LANES_INLINE Lanes whole(Lanes a) { return a; }
DETENT_LANES_INLINE Lanes times(Lanes a, Lanes b) { return {a.v * b.v}; }
DETENT_LANES_INLINE Lanes times_scaled(Lanes a, Lanes b, int) { return {a.v * b.v}; }
DETENT_LANES_INLINE Lanes sum_from(Lanes a, int) { return a; }
DETENT_LANES_INLINE Lanes rounded(Lanes sum, int) { return sum; }

class LaneBlock {
 public:
  void include(const Vec3<Lanes>&, int) {}
  template <unsigned count>
  void include(const Lanes (&)[count], uint32_t) {}
  void settle() {}
  DETENT_LANES_INLINE Vec3<Lanes> mantissas(const Vec3<Lanes>& v, int) const { return v; }
  DETENT_LANES_INLINE Lanes held(Lanes value) const { return value; }
  DETENT_LANES_INLINE Lanes number(Lanes value) const { return value; }
  DETENT_LANES_INLINE Lanes real(Lanes ulps) const { return ulps; }
  DETENT_LANES_INLINE Vec3<Lanes> real(const Vec3<Lanes>& v, Lanes share, int) const {
    return {times(v.x, share), times(v.y, share), times(v.z, share)};
  }
  DETENT_LANES_INLINE Lanes converted(Lanes value, const LaneBlock&, int exponent) const {
    return {value.v * power_of_two<Real>(exponent)};
  }
  template <unsigned count>
  void coarsen(Lanes (&)[count]) {}
};

#endif

DETENT_LANES_INLINE Lanes dot(const Vec3<Lanes>& a, const Vec3<Lanes>& b) {
  return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
}
/// Rounds sums of products to factors. Range: each rounded value must fit a factor.
DETENT_LANES_INLINE Vec3<Lanes> rounded(Lanes x, Lanes y, Lanes z) {
#if DETENT_FIXED
  const auto part = [](Lanes sum) {
    const LaneUint64 half = reinterpret_cast<LaneUint64>(lanes_of(int64_t{1} << (k_unit_frac - 1)).v);
    return Lanes{reinterpret_cast<LaneInt64>((reinterpret_cast<LaneUint64>(sum.v) + half) >> k_unit_frac)};
  };
  return {part(x), part(y), part(z)};
#else
  return {x, y, z};
#endif
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
