#pragma once
#include "base/unroll.h"
#include "motion/block.h"

/// Lanes: registers that hold one number of each of four or eight contacts. The operations of block.h are applied to
/// each lane, and give the same bits as for a single contact. Only for files that are compiled for processors with
/// vector registers: of 256 bits on x86-64 (for eight lanes in fixed point 512), of at least 128 bits elsewhere.
namespace detent {
inline namespace DETENT_NAMESPACE {

#define DETENT_LANES_INLINE inline __attribute__((always_inline))

#if DETENT_FIXED
using LaneNumber = double;

// Instructions for registers of 512 bits, whose builtins depend on the compiler.
/// The mask of all lanes. Its type differs between builtins.
struct AllLanes {
  constexpr operator char() const { return static_cast<char>(-1); }
  constexpr operator unsigned char() const { return 255; }
};
inline constexpr AllLanes k_all_lanes;
inline constexpr int k_current_rounding = 4;
#if defined(__clang__)
#define DETENT_MAXPD512(a, b) __builtin_ia32_maxpd512(a, b, k_current_rounding)
#define DETENT_MINPD512(a, b) __builtin_ia32_minpd512(a, b, k_current_rounding)
#define DETENT_PMULDQ512(a, b) __builtin_ia32_pmuldq512(a, b)
#define DETENT_LZCNTQ512(a) __builtin_ia32_vplzcntq_512(a)
#else
typedef long long LaneWords512 __attribute__((vector_size(64)));
#define DETENT_MAXPD512(a, b) __builtin_ia32_maxpd512_mask(a, b, a, k_all_lanes, k_current_rounding)
#define DETENT_MINPD512(a, b) __builtin_ia32_minpd512_mask(a, b, a, k_all_lanes, k_current_rounding)
#define DETENT_PMULDQ512(a, b) __builtin_ia32_pmuldq512_mask(a, b, LaneWords512{}, k_all_lanes)
#define DETENT_LZCNTQ512(a) __builtin_ia32_vplzcntq_512_mask(a, LaneWords512{}, k_all_lanes)
#endif
#else
using LaneNumber = Real;
#endif

/// The vector types of `count` numbers. The types named Stored... may be stored at any address that
/// is a multiple of 8.
template <uint32_t count>
struct LaneVectors;

template <>
struct LaneVectors<4> {
  typedef int32_t Int32 __attribute__((vector_size(16)));
  typedef int32_t StoredInt32 __attribute__((vector_size(16), aligned(8)));
  typedef float Single __attribute__((vector_size(16)));
  typedef float StoredSingle __attribute__((vector_size(16), aligned(8)));
#if DETENT_FIXED
  typedef double Float __attribute__((vector_size(32)));
  typedef int64_t Int64 __attribute__((vector_size(32)));
  typedef uint64_t Uint64 __attribute__((vector_size(32)));
  typedef int64_t StoredInt64 __attribute__((vector_size(32), aligned(8)));
  typedef int32_t Words __attribute__((vector_size(32)));
#endif
};

template <>
struct LaneVectors<8> {
  typedef int32_t Int32 __attribute__((vector_size(32)));
  typedef int32_t StoredInt32 __attribute__((vector_size(32), aligned(8)));
  typedef float Single __attribute__((vector_size(32)));
  typedef float StoredSingle __attribute__((vector_size(32), aligned(8)));
#if DETENT_FIXED
  typedef double Float __attribute__((vector_size(64)));
  typedef int64_t Int64 __attribute__((vector_size(64)));
  typedef uint64_t Uint64 __attribute__((vector_size(64)));
  typedef int64_t StoredInt64 __attribute__((vector_size(64), aligned(8)));
  typedef int32_t Words __attribute__((vector_size(64)));
  typedef long long LongInt64 __attribute__((vector_size(64)));
#endif
};

/// The numbers of `count` contacts, and the operations on them. Range of `count`: 4; on x86-64 also 8. An
/// operation is a friend function, which a call finds by the types of its arguments; an operation on plain vectors is a
/// static member.
template <uint32_t count>
struct LaneTypes {
  using LaneInt32 = typename LaneVectors<count>::Int32;
  using LaneStoredInt32 = typename LaneVectors<count>::StoredInt32;
  using LaneSingle = typename LaneVectors<count>::Single;
  using LaneStoredFloat = typename LaneVectors<count>::StoredSingle;

#if DETENT_FIXED

  using LaneFloat = typename LaneVectors<count>::Float;
  using LaneInt64 = typename LaneVectors<count>::Int64;
  using LaneUint64 = typename LaneVectors<count>::Uint64;
  using LaneStoredInt64 = typename LaneVectors<count>::StoredInt64;
  using LaneMaskBits = LaneInt64;

  /// Ulps, factors, Units, and sums of their products, as doubles. Every value is exact: ulps and factors are integers,
  /// a Unit is a multiple of 2^-24, and a sum of products has at most 53 bits (block.h). So the operations round
  /// nothing, except rounded(), and no result depends on the rounding mode.
  struct Lanes {
    LaneFloat v;
  };
  /// The raw numbers of Reals.
  struct LaneReals {
    LaneStoredInt64 v;
  };
  /// A product that is not yet computed: multiplication and a following addition become one instruction. As every
  /// product and sum is exact, this changes no bit.
  struct LaneProduct {
    LaneFloat a, b;
    DETENT_LANES_INLINE operator Lanes() const { return {a * b}; }
  };
  /// Units, as floats, which hold them exactly.
  struct LaneUnits {
    LaneStoredFloat v;
    DETENT_LANES_INLINE operator Lanes() const { return {__builtin_convertvector(v, LaneFloat)}; }
  };
  /// Scaled values that multiply a motion of a body.
  struct LaneShare {
    LaneStoredInt32 mantissa, exponent;
  };
  /// Scaled values that multiply a factor.
  struct LaneScaled {
    LaneUnits value;
  };

  DETENT_LANES_INLINE static LaneInt64 words_of(int64_t value) { return LaneInt64{} + value; }

#else

  using LaneFloat = LaneSingle;
  using LaneMaskBits = LaneInt32;

  struct Lanes {
    LaneStoredFloat v;
  };
  using LaneProduct = Lanes;
  using LaneReals = Lanes;
  using LaneUnits = Lanes;
  using LaneShare = Lanes;
  using LaneScaled = Lanes;

#endif

  DETENT_LANES_INLINE static Lanes lanes_of(LaneNumber value) {
    LaneFloat v;
    DETENT_UNROLL
    for (uint32_t k = 0; k < count; ++k) v[k] = value;
    return {v};
  }

  struct LaneMask {
    LaneMaskBits v;
  };

  friend DETENT_LANES_INLINE Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
  friend DETENT_LANES_INLINE Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
  friend DETENT_LANES_INLINE Lanes operator-(Lanes a) { return {-a.v}; }
  friend DETENT_LANES_INLINE Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
  friend DETENT_LANES_INLINE Lanes& operator-=(Lanes& a, Lanes b) { return a = a - b; }
  friend DETENT_LANES_INLINE LaneMask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
  friend DETENT_LANES_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
  friend DETENT_LANES_INLINE LaneMask operator!(LaneMask a) { return {~a.v}; }
  friend DETENT_LANES_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }

// max() returns b > a ? b : a in each lane, min() a > b ? b : a. The compiler uses these instructions by itself only if
// it may ignore NaN and -0.
#if defined(__AVX2__) && DETENT_FIXED
  friend DETENT_LANES_INLINE Lanes select(LaneMask mask, Lanes a, Lanes b) {
    if constexpr (count == 8) return {mask.v ? a.v : b.v};
    if constexpr (count == 4) return {__builtin_ia32_blendvpd256(b.v, a.v, reinterpret_cast<LaneFloat>(mask.v))};
  }
  DETENT_LANES_INLINE static bool any(LaneMask mask) {
    if constexpr (count == 8)
      return __builtin_ia32_movmskps256(reinterpret_cast<LaneSingle>(__builtin_convertvector(mask.v, LaneInt32))) != 0;
    if constexpr (count == 4) return __builtin_ia32_movmskpd256(reinterpret_cast<LaneFloat>(mask.v)) != 0;
  }
  friend DETENT_LANES_INLINE Lanes max(Lanes a, Lanes b) {
    if constexpr (count == 8) return {DETENT_MAXPD512(b.v, a.v)};
    if constexpr (count == 4) return {__builtin_ia32_maxpd256(b.v, a.v)};
  }
  friend DETENT_LANES_INLINE Lanes min(Lanes a, Lanes b) {
    if constexpr (count == 8) return {DETENT_MINPD512(b.v, a.v)};
    if constexpr (count == 4) return {__builtin_ia32_minpd256(b.v, a.v)};
  }
#elif defined(__AVX2__) && defined(DETENT_F32)
  friend DETENT_LANES_INLINE Lanes select(LaneMask mask, Lanes a, Lanes b) {
    const LaneFloat bits = reinterpret_cast<LaneFloat>(mask.v);
    if constexpr (count == 8) return {__builtin_ia32_blendvps256(b.v, a.v, bits)};
    if constexpr (count == 4) return {__builtin_ia32_blendvps(b.v, a.v, bits)};
  }
  DETENT_LANES_INLINE static bool any(LaneMask mask) {
    const LaneFloat bits = reinterpret_cast<LaneFloat>(mask.v);
    if constexpr (count == 8) return __builtin_ia32_movmskps256(bits) != 0;
    if constexpr (count == 4) return __builtin_ia32_movmskps(bits) != 0;
  }
  friend DETENT_LANES_INLINE Lanes max(Lanes a, Lanes b) {
    if constexpr (count == 8) return {__builtin_ia32_maxps256(b.v, a.v)};
    if constexpr (count == 4) return {__builtin_ia32_maxps(b.v, a.v)};
  }
  friend DETENT_LANES_INLINE Lanes min(Lanes a, Lanes b) {
    if constexpr (count == 8) return {__builtin_ia32_minps256(b.v, a.v)};
    if constexpr (count == 4) return {__builtin_ia32_minps(b.v, a.v)};
  }
#else
  friend DETENT_LANES_INLINE Lanes select(LaneMask mask, Lanes a, Lanes b) { return {mask.v ? a.v : b.v}; }
  DETENT_LANES_INLINE static bool any(LaneMask mask) { return (mask.v[0] | mask.v[1] | mask.v[2] | mask.v[3]) != 0; }
  friend DETENT_LANES_INLINE Lanes max(Lanes a, Lanes b) { return select(b > a, b, a); }
  friend DETENT_LANES_INLINE Lanes min(Lanes a, Lanes b) { return select(a > b, b, a); }
#endif
  friend DETENT_LANES_INLINE Lanes clamp(Lanes value, Lanes low, Lanes high) { return min(max(value, low), high); }

#if DETENT_FIXED

  friend DETENT_LANES_INLINE LaneReals operator+(LaneReals a, LaneReals b) { return {a.v + b.v}; }
  friend DETENT_LANES_INLINE LaneReals operator-(LaneReals a, LaneReals b) { return {a.v - b.v}; }
  friend DETENT_LANES_INLINE LaneReals& operator+=(LaneReals& a, LaneReals b) { return a = a + b; }
  friend DETENT_LANES_INLINE LaneReals& operator-=(LaneReals& a, LaneReals b) { return a = a - b; }
  friend DETENT_LANES_INLINE LaneReals max(LaneReals a, LaneReals b) { return {b.v > a.v ? b.v : a.v}; }

  /// Conversions of integers between doubles and 64-bit words. Range: |value| < 2^51.
  DETENT_LANES_INLINE static Lanes number_from(LaneInt64 value) {
    const LaneFloat base = lanes_of(0x1.8p52).v;
    return {reinterpret_cast<LaneFloat>(value + reinterpret_cast<LaneInt64>(base)) - base};
  }
  DETENT_LANES_INLINE static LaneInt64 words_from(Lanes value) {
    const LaneFloat base = lanes_of(0x1.8p52).v;
    return reinterpret_cast<LaneInt64>(value.v + base) - reinterpret_cast<LaneInt64>(base);
  }
  /// Products of the low 32 bits of each lane of a and b, as signed integers.
  DETENT_LANES_INLINE static LaneInt64 multiplied(LaneInt64 a, LaneInt64 b) {
    using Words = typename LaneVectors<count>::Words;
    const Words words_a = reinterpret_cast<Words>(a), words_b = reinterpret_cast<Words>(b);
    if constexpr (count == 8) return reinterpret_cast<LaneInt64>(DETENT_PMULDQ512(words_a, words_b));
    if constexpr (count == 4) return reinterpret_cast<LaneInt64>(__builtin_ia32_pmuldq256(words_a, words_b));
  }
  /// 2^exponent. Range: |exponent| <= 1022.
  DETENT_LANES_INLINE static Lanes power_of_two(LaneInt64 exponent) {
    return {reinterpret_cast<LaneFloat>((exponent + words_of(1023)) << 52)};
  }

  DETENT_LANES_INLINE static LaneInt64 clamp_words(LaneInt64 value, int64_t low, int64_t high) {
    const LaneInt64 least = words_of(low), most = words_of(high);
    value = value < least ? least : value;
    return value > most ? most : value;
  }
  /// value times 2^-n, rounded down. Range: 0 <= n <= 63.
  DETENT_LANES_INLINE static LaneInt64 shifted_down(LaneInt64 value, LaneInt64 n) {
    const LaneUint64 sign = reinterpret_cast<LaneUint64>(words_of(INT64_MIN)), by = reinterpret_cast<LaneUint64>(n);
    const LaneUint64 moved = (reinterpret_cast<LaneUint64>(value) ^ sign) >> by;
    return reinterpret_cast<LaneInt64>(moved - (sign >> by));
  }
  /// In each lane the result of round_shift_64(). Range: 1 <= n <= 63.
  DETENT_LANES_INLINE static LaneInt64 round_shift_any(LaneInt64 value, LaneInt64 n) {
    const LaneUint64 sign = reinterpret_cast<LaneUint64>(words_of(INT64_MIN)), by = reinterpret_cast<LaneUint64>(n);
    const LaneUint64 one = reinterpret_cast<LaneUint64>(words_of(1));
    const LaneUint64 twice = (reinterpret_cast<LaneUint64>(value) ^ sign) >> (by - one);
    return reinterpret_cast<LaneInt64>(((twice + one) >> one) - (sign >> by));
  }
  /// In each lane the result of round_shift_64(). Range: |value| < 2^62, 1 <= n <= 63.
  DETENT_LANES_INLINE static LaneInt64 round_shift(LaneInt64 value, LaneInt64 n) {
    const LaneUint64 bias = reinterpret_cast<LaneUint64>(words_of(int64_t{1} << 62));
    const LaneUint64 one = reinterpret_cast<LaneUint64>(words_of(1)), by = reinterpret_cast<LaneUint64>(n);
    const LaneUint64 sum = reinterpret_cast<LaneUint64>(value) + bias + (one << (by - one));
    return reinterpret_cast<LaneInt64>((sum >> by) - (bias >> by));
  }

  DETENT_LANES_INLINE static Lanes limited(Lanes a) {
    return clamp(a, lanes_of(-k_factor_max), lanes_of(k_factor_max));
  }
  friend DETENT_LANES_INLINE Lanes held(Lanes a) { return limited(a); }
  friend DETENT_LANES_INLINE LaneProduct product(Lanes a, Lanes b) { return {a.v, b.v}; }
  /// a b + c.
  DETENT_LANES_INLINE static Lanes fused(LaneFloat a, LaneFloat b, LaneFloat c) {
    if constexpr (count == 8) return {__builtin_ia32_vfmaddpd512_mask(a, b, c, k_all_lanes, k_current_rounding)};
    if constexpr (count == 4) return {__builtin_ia32_vfmaddpd256(a, b, c)};
  }
  friend DETENT_LANES_INLINE Lanes operator+(Lanes a, LaneProduct b) { return fused(b.a, b.b, a.v); }
  friend DETENT_LANES_INLINE Lanes operator-(Lanes a, LaneProduct b) { return fused(-b.a, b.b, a.v); }
  friend DETENT_LANES_INLINE Lanes operator+(LaneProduct a, Lanes b) { return b + a; }
  friend DETENT_LANES_INLINE Lanes operator+(LaneProduct a, LaneProduct b) { return Lanes(a) + b; }
  friend DETENT_LANES_INLINE Lanes operator-(LaneProduct a, LaneProduct b) { return Lanes(a) - b; }
  friend DETENT_LANES_INLINE Lanes& operator+=(Lanes& a, LaneProduct b) { return a = a + b; }
  friend DETENT_LANES_INLINE Lanes& operator-=(Lanes& a, LaneProduct b) { return a = a - b; }
  /// Rounds down to an integer.
  friend DETENT_LANES_INLINE Lanes rounded_down(Lanes sum) {
    constexpr int k_down_without_exceptions = 9;
    if constexpr (count == 8)
      return {__builtin_ia32_rndscalepd_mask(sum.v, k_down_without_exceptions, sum.v, k_all_lanes, k_current_rounding)};
    if constexpr (count == 4) return {__builtin_ia32_roundpd256(sum.v, k_down_without_exceptions)};
  }
  /// Rounds to an integer: to nearest, ties up.
  friend DETENT_LANES_INLINE Lanes rounded(Lanes sum) { return rounded_down(sum + lanes_of(0.5)); }
  friend DETENT_LANES_INLINE Lanes rounded(LaneProduct a) { return rounded_down(lanes_of(0.5) + a); }
  friend DETENT_LANES_INLINE Lanes whole(Lanes a) { return a; }
  friend DETENT_LANES_INLINE Lanes times(Lanes a, Lanes b) { return rounded(product(a, b)); }
  friend DETENT_LANES_INLINE Lanes times(Lanes a, const LaneScaled& b) { return held(times(a, Lanes(b.value))); }
  friend DETENT_LANES_INLINE Lanes times_scaled(Lanes a, Lanes b, int) { return rounded(product(a, b)); }
  friend DETENT_LANES_INLINE Lanes sum_from(Lanes a, int) { return a; }
  friend DETENT_LANES_INLINE Lanes rounded(Lanes sum, int) { return rounded(sum); }

  class LaneBlock {
   public:
    DETENT_LANES_INLINE void include(const Vec3<LaneReals>& v, int exponent) {
      include_bits(magnitude(v.x) | magnitude(v.y) | magnitude(v.z), k_angular_velocity_power - exponent);
    }
    /// Makes settle() choose a block in which the first `used` values fit. Combines their magnitudes by `or`.
    DETENT_LANES_INLINE void include(const LaneReals* values, uint32_t used) {
      LaneInt64 all = {};
      for (uint32_t i = 0; i < used; ++i) all |= magnitude(values[i]);
      include_bits(all, k_number_drop);
    }
    DETENT_LANES_INLINE void include_speed(Lanes speed, const LaneBlock& from, int exponent, LaneReals most) {
      // The lowest 12 bits of a raw Real are below the finest step of a block.
      constexpr int k_drop = 12;
      static_assert(k_drop < k_shift_min + k_number_bits);
      const LaneInt64 bits = bit_lengths(speed) + from.shift_ + words_of(exponent);
      const LaneInt64 bits_max = bit_lengths(number_from(most.v >> k_drop)) + words_of(k_drop);
      const LaneInt64 least = (bits < bits_max ? bits : bits_max) - words_of(k_number_bits);
      shift_ = least > shift_ ? least : shift_;
    }
    DETENT_LANES_INLINE void settle() {
      LaneInt64 least;
      if constexpr (count == 8) {
        const auto bits = reinterpret_cast<typename LaneVectors<count>::LongInt64>(bits_);
        least = words_of(64 + k_bits_power) - reinterpret_cast<LaneInt64>(DETENT_LZCNTQ512(bits));
      } else {
        for (uint32_t i = 0; i < count; ++i) least[i] = bit_length_64(static_cast<uint64_t>(bits_[i]));
        least += words_of(k_bits_power);
      }
      shift_ = least > shift_ ? least : shift_;
    }
    DETENT_LANES_INLINE Vec3<Lanes> mantissas(const Vec3<LaneReals>& v, int exponent) const {
      const LaneInt64 n = shift_ - words_of(exponent);
      return {number_from(round_shift_any(v.x.v, n)), number_from(round_shift_any(v.y.v, n)),
              number_from(round_shift_any(v.z.v, n))};
    }
    DETENT_LANES_INLINE Lanes held(LaneReals value, int exponent = 0) const {
      const LaneInt64 ulps = shifted_down(value.v, shift_ - words_of(exponent));
      return number_from(clamp_words(ulps, -k_factor_max, k_factor_max));
    }
    /// Range: `value` was passed to include().
    DETENT_LANES_INLINE Lanes number(LaneReals value) const { return number_from(shifted_down(value.v, shift_)); }
    DETENT_LANES_INLINE LaneReals real(Lanes ulps) const { return {words_from(ulps) << shift_}; }
    DETENT_LANES_INLINE Vec3<LaneReals> real(const Vec3<Lanes>& v, const LaneShare& share, LaneInt32 exponent) const {
      const LaneInt64 mantissa = __builtin_convertvector(share.mantissa, LaneInt64);
      const LaneInt64 n = -(shift_ + __builtin_convertvector(share.exponent + exponent, LaneInt64)), none = words_of(0);
      const LaneInt64 down = n > none, right = clamp_words(n, 1, 63), left = clamp_words(none - n, 0, 63);
      const auto part = [&](Lanes value) {
        const LaneInt64 product = multiplied(words_from(value), mantissa);
        return LaneReals{down ? round_shift(product, right) : product << left};
      };
      return {part(v.x), part(v.y), part(v.z)};
    }
    DETENT_LANES_INLINE Vec3<LaneReals> real(const Vec3<Lanes>& v, const LaneShare& share, int exponent) const {
      return real(v, share, LaneInt32{} + exponent);
    }
    DETENT_LANES_INLINE Lanes converted(Lanes ulps, const LaneBlock& from, int exponent) const {
      const LaneInt64 n = clamp_words(from.shift_ + words_of(exponent) - shift_, -63, 31);
      return limited(times(ulps, power_of_two(n)));
    }
    template <unsigned used>
    DETENT_LANES_INLINE void coarsen(Lanes (&parts)[used]) {
      Lanes most = lanes_of(0);
      for (const Lanes& part : parts) most = max(most, max(part, -part));
      const LaneMask long_ = most > lanes_of(static_cast<double>((int64_t{1} << k_wrench_bits) - 1));
      if (!any(long_)) return;
      const LaneInt64 n = (bit_lengths(most) - words_of(k_wrench_bits)) & long_.v;
      const Lanes power = power_of_two(words_of(0) - n);
      for (Lanes& part : parts) part = times(part, power);
      shift_ += n;
    }

   private:
    /// The bit lengths of integers >= 0: the exponents of their doubles plus 1. That of 0 is -1022.
    DETENT_LANES_INLINE static LaneInt64 bit_lengths(Lanes a) {
      return (reinterpret_cast<LaneInt64>(a.v) >> 52) - words_of(1022);
    }
    DETENT_LANES_INLINE static LaneInt64 magnitude(LaneReals a) { return a.v < 0 ? -a.v : a.v; }
    DETENT_LANES_INLINE void include_bits(LaneInt64 all, int drop) {
      bits_ |= reinterpret_cast<LaneInt64>(reinterpret_cast<LaneUint64>(all) >> static_cast<uint64_t>(drop));
    }
    LaneInt64 bits_ = {};
    LaneInt64 shift_ = words_of(k_shift_min);
  };

#else

  friend DETENT_LANES_INLINE Lanes held(Lanes a) { return a; }
  friend DETENT_LANES_INLINE Lanes product(Lanes a, Lanes b) { return {a.v * b.v}; }
  friend DETENT_LANES_INLINE Lanes rounded(Lanes sum) { return sum; }
  friend DETENT_LANES_INLINE Lanes whole(Lanes a) { return a; }
  friend DETENT_LANES_INLINE Lanes times(Lanes a, Lanes b) { return {a.v * b.v}; }
  friend DETENT_LANES_INLINE Lanes times_scaled(Lanes a, Lanes b, int) { return {a.v * b.v}; }
  friend DETENT_LANES_INLINE Lanes sum_from(Lanes a, int) { return a; }
  friend DETENT_LANES_INLINE Lanes rounded(Lanes sum, int) { return sum; }

  class LaneBlock {
   public:
    void include(const Vec3<Lanes>&, int) {}
    void include(const Lanes*, uint32_t) {}
    void include_speed(Lanes, const LaneBlock&, int, Lanes) {}
    void settle() {}
    DETENT_LANES_INLINE Vec3<Lanes> mantissas(const Vec3<Lanes>& v, int) const { return v; }
    DETENT_LANES_INLINE Lanes held(Lanes value, int exponent = 0) const {
      return {value.v * power_of_two<Real>(exponent)};
    }
    DETENT_LANES_INLINE Lanes number(Lanes value) const { return value; }
    DETENT_LANES_INLINE Lanes real(Lanes ulps) const { return ulps; }
    template <class Exponent>
    DETENT_LANES_INLINE Vec3<Lanes> real(const Vec3<Lanes>& v, Lanes share, Exponent) const {
      return {times(v.x, share), times(v.y, share), times(v.z, share)};
    }
    DETENT_LANES_INLINE Lanes converted(Lanes value, const LaneBlock&, int exponent) const {
      return {value.v * power_of_two<Real>(exponent)};
    }
    template <unsigned used>
    void coarsen(Lanes (&)[used]) {}
  };

#endif

  friend DETENT_LANES_INLINE Vec3<LaneReals> operator+(const Vec3<LaneReals>& a, const Vec3<LaneReals>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  /// Returns `v` itself, because the Units of lanes are already rounded.
  friend DETENT_LANES_INLINE const Vec3<LaneUnits>& fine(const Vec3<LaneUnits>& v) { return v; }
  friend DETENT_LANES_INLINE Lanes dot(const Vec3<Lanes>& a, const Vec3<LaneUnits>& b) {
    return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
  }
  /// Rounds sums of products to factors. Range: each rounded value must fit a factor.
  friend DETENT_LANES_INLINE Vec3<Lanes> rounded(Lanes x, Lanes y, Lanes z) {
    return {rounded(x), rounded(y), rounded(z)};
  }
  /// Clamps v to the circle of radius `limit` in each lane. Only few contacts slide, so their lanes are processed one
  /// by one.
  friend DETENT_LANES_INLINE void clamp_to_circle(Lanes (&v)[2], Lanes limit) {
    const Lanes none = lanes_of(LaneNumber{0});
    const Lanes size = select(none > v[0], -v[0], v[0]) + select(none > v[1], -v[1], v[1]);
    const LaneMask out = size > limit;
    if (!any(out)) return;
    for (uint32_t lane = 0; lane < count; ++lane) {
      if (out.v[lane] != 0) clamp_lane(v, limit, lane);
    }
  }

 private:
  DETENT_LANES_INLINE static void clamp_lane(Lanes (&v)[2], Lanes limit, uint32_t lane) {
    Factor own[2] = {static_cast<Factor>(v[0].v[lane]), static_cast<Factor>(v[1].v[lane])};
    clamp_to_circle(own, static_cast<Factor>(limit.v[lane]));
    v[0].v[lane] = own[0];
    v[1].v[lane] = own[1];
  }
};

template <uint32_t count>
using Lanes = typename LaneTypes<count>::Lanes;
template <uint32_t count>
using LaneReals = typename LaneTypes<count>::LaneReals;
template <uint32_t count>
using LaneUnits = typename LaneTypes<count>::LaneUnits;
template <uint32_t count>
using LaneShare = typename LaneTypes<count>::LaneShare;
template <uint32_t count>
using LaneScaled = typename LaneTypes<count>::LaneScaled;
template <uint32_t count>
using LaneMask = typename LaneTypes<count>::LaneMask;
template <uint32_t count>
using LaneInt32 = typename LaneTypes<count>::LaneInt32;
template <uint32_t count>
using LaneStoredInt32 = typename LaneTypes<count>::LaneStoredInt32;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
