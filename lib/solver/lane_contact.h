#pragma once
#include "solver/contact_solver.h"
#include "solver/lanes.h"

/// Reads contacts or bodies from memory into lanes, and writes them back. `count` is the number of lanes: 4, or on
/// x86-64 also 8.
namespace detent {
inline namespace DETENT_NAMESPACE {

using LaneFourWords = LaneInt32<4>;

/// One value for each lane, returned by make(lane).
template <class T, uint32_t count>
struct EachLane {
  T of[count];

  template <class Make>
  DETENT_LANES_INLINE explicit EachLane(const Make& make) {
    DETENT_UNROLL
    for (uint32_t k = 0; k < count; ++k) of[k] = make(k);
  }
};

/// Makes a register of the words a, b, c and d of two registers, separately in each 128 bits: 0 to 3 select words of
/// the first register, 4 to 7 words of the second.
template <int a, int b, int c, int d, class Row>
DETENT_LANES_INLINE Row picked(Row first, Row second) {
  if constexpr (sizeof(Row) == 16) {
    return __builtin_shufflevector(first, second, a, b, c, d);
  } else {
    constexpr int k_a = a % 4 + a / 4 * 8, k_b = b % 4 + b / 4 * 8, k_c = c % 4 + c / 4 * 8, k_d = d % 4 + d / 4 * 8;
    return __builtin_shufflevector(first, second, k_a, k_b, k_c, k_d, k_a + 4, k_b + 4, k_c + 4, k_d + 4);
  }
}

/// Transposes a matrix of 4 x 4 words of 32 bits in each 128 bits of the rows.
template <class Row>
DETENT_LANES_INLINE void transpose_words(Row (&row)[4]) {
  const Row low_01 = picked<0, 4, 1, 5>(row[0], row[1]), low_23 = picked<0, 4, 1, 5>(row[2], row[3]);
  const Row high_01 = picked<2, 6, 3, 7>(row[0], row[1]), high_23 = picked<2, 6, 3, 7>(row[2], row[3]);
  row[0] = picked<0, 1, 4, 5>(low_01, low_23);
  row[1] = picked<2, 3, 6, 7>(low_01, low_23);
  row[2] = picked<0, 1, 4, 5>(high_01, high_23);
  row[3] = picked<2, 3, 6, 7>(high_01, high_23);
}

/// Reads four words from each address, and transposes them. A 256-bit register is assembled from 128-bit halves when it
/// is read, and split into them when it is written, because moving data between the halves of a register costs more.
template <uint32_t count, class T>
DETENT_LANES_INLINE void read_four_words(const T* const (&from)[count], LaneInt32<count> (&words)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) {
    LaneFourWords low;
    __builtin_memcpy(&low, from[k], sizeof(low));
    if constexpr (count == 4) {
      words[k] = low;
    } else {
      LaneFourWords high;
      __builtin_memcpy(&high, from[k + 4], sizeof(high));
      words[k] = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    }
  }
  transpose_words(words);
}

#if DETENT_FIXED
typedef int64_t LaneHalf __attribute__((vector_size(16)));
template <uint32_t count>
using LaneInt64 = typename LaneTypes<count>::LaneInt64;

/// Reads two numbers of 64 bits from each address, and transposes them.
template <uint32_t count>
DETENT_LANES_INLINE void read_two(const Real* const (&from)[count], LaneReals<count>& first, LaneReals<count>& second) {
  if constexpr (count == 4) {
    LaneHalf row[4];
    DETENT_UNROLL
    for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], from[k], sizeof(row[k]));
    const LaneInt64<4> even = __builtin_shufflevector(row[0], row[2], 0, 1, 2, 3);
    const LaneInt64<4> odd = __builtin_shufflevector(row[1], row[3], 0, 1, 2, 3);
    first.v = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    second.v = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
  } else {
    LaneReals<4> low[2], high[2];
    read_two<4>({from[0], from[1], from[2], from[3]}, low[0], low[1]);
    read_two<4>({from[4], from[5], from[6], from[7]}, high[0], high[1]);
    first.v = __builtin_shufflevector(low[0].v, high[0].v, 0, 1, 2, 3, 4, 5, 6, 7);
    second.v = __builtin_shufflevector(low[1].v, high[1].v, 0, 1, 2, 3, 4, 5, 6, 7);
  }
}
template <uint32_t count>
DETENT_LANES_INLINE void write_two(LaneInt64<count> first, LaneInt64<count> second, Real* const (&to)[count]) {
  if constexpr (count == 4) {
    const LaneInt64<4> even = __builtin_shufflevector(first, second, 0, 4, 2, 6);
    const LaneInt64<4> odd = __builtin_shufflevector(first, second, 1, 5, 3, 7);
    const LaneHalf row[4] = {__builtin_shufflevector(even, even, 0, 1), __builtin_shufflevector(odd, odd, 0, 1),
                             __builtin_shufflevector(even, even, 2, 3), __builtin_shufflevector(odd, odd, 2, 3)};
    DETENT_UNROLL
    for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &row[k], sizeof(row[k]));
  } else {
    write_two<4>(__builtin_shufflevector(first, first, 0, 1, 2, 3), __builtin_shufflevector(second, second, 0, 1, 2, 3),
                 {to[0], to[1], to[2], to[3]});
    write_two<4>(__builtin_shufflevector(first, first, 4, 5, 6, 7), __builtin_shufflevector(second, second, 4, 5, 6, 7),
                 {to[4], to[5], to[6], to[7]});
  }
}

template <uint32_t count>
DETENT_LANES_INLINE LaneReals<count> read_real(const Real* const (&from)[count]) {
  LaneInt64<count> words;
  DETENT_UNROLL
  for (uint32_t k = 0; k < count; ++k) words[k] = from[k]->raw;
  return {words};
}
template <uint32_t count>
DETENT_LANES_INLINE void write_real(LaneReals<count> from, Real* const (&to)[count]) {
  DETENT_UNROLL
  for (uint32_t k = 0; k < count; ++k) to[k]->raw = from.v[k];
}
template <uint32_t count>
DETENT_LANES_INLINE void read_three(const Real* const (&from)[count], LaneReals<count> (&to)[3]) {
  read_two(from, to[0], to[1]);
  to[2] = read_real(EachLane<const Real*, count>([&](uint32_t k) { return from[k] + 2; }).of);
}
template <uint32_t count>
DETENT_LANES_INLINE void write_three(const LaneReals<count> (&from)[3], Real* const (&to)[count]) {
  write_two<count>(from[0].v, from[1].v, to);
  write_real(from[2], EachLane<Real*, count>([&](uint32_t k) { return to[k] + 2; }).of);
}

#else
template <uint32_t count>
DETENT_LANES_INLINE Lanes<count> read_real(const Real* const (&from)[count]) {
  Lanes<count> to;
  DETENT_UNROLL
  for (uint32_t k = 0; k < count; ++k) to.v[k] = *from[k];
  return to;
}
template <uint32_t count>
DETENT_LANES_INLINE void write_real(Lanes<count> from, Real* const (&to)[count]) {
  DETENT_UNROLL
  for (uint32_t k = 0; k < count; ++k) *to[k] = from.v[k];
}
/// Reads three Reals from each address, and transposes them. Four Reals must be readable at each address.
template <uint32_t count>
DETENT_LANES_INLINE void read_three(const Real* const (&from)[count], Lanes<count> (&to)[3]) {
  LaneInt32<count> words[4];
  read_four_words(from, words);
  DETENT_UNROLL
  for (int k = 0; k < 3; ++k) to[k].v = reinterpret_cast<typename LaneTypes<count>::LaneFloat>(words[k]);
}
template <uint32_t count>
DETENT_LANES_INLINE void write_three(const Lanes<count> (&from)[3], Real* const (&to)[count]) {
  typename LaneTypes<count>::LaneFloat row[4] = {from[0].v, from[1].v, from[2].v, from[2].v};
  transpose_words(row);
  DETENT_UNROLL
  for (uint32_t k = 0; k < count; ++k) {
    typename LaneTypes<4>::LaneFloat own;
    if constexpr (count == 4)
      own = row[k];
    else
      own = k < 4 ? __builtin_shufflevector(row[k % 4], row[k % 4], 0, 1, 2, 3)
                  : __builtin_shufflevector(row[k % 4], row[k % 4], 4, 5, 6, 7);
    __builtin_memcpy(to[k], &own, 2 * sizeof(Real));
    const Real last = own[2];
    __builtin_memcpy(to[k] + 2, &last, sizeof(Real));
  }
}
#endif

/// Reads the first `words` words of `count` arrays. Range: `words` is a multiple of 4; every array has that many words.
template <uint32_t count, uint32_t words>
struct LaneWords {
  LaneInt32<count> word[words];

  DETENT_LANES_INLINE explicit LaneWords(const uint8_t* const (&from)[count]) {
    for (unsigned i = 0; i < words; i += 4) {
      LaneInt32<count> row[4];
      read_four_words(EachLane<const uint8_t*, count>([&](uint32_t k) { return from[k] + 4 * i; }).of, row);
      DETENT_UNROLL
      for (unsigned k = 0; k < 4; ++k) word[i + k] = row[k];
    }
  }
#if DETENT_FIXED
  /// The word `i` of each array as a Unit of at most 24 bits, multiplied by 2^exponent.
  DETENT_LANES_INLINE LaneUnits<count> unit(uint32_t i, LaneInt32<count> exponent = LaneInt32<count>{}) const {
    return {__builtin_convertvector(word[i], LaneSingle) * single_power(exponent - k_unit_frac)};
  }
  DETENT_LANES_INLINE LaneUnits<count> fine_unit(uint32_t i) const {
    constexpr int32_t k_step = 1 << (k_unit_frac - k_fine_frac);
    const LaneInt32<count> raw = (word[i] + k_step / 2) & -k_step;
    return {__builtin_convertvector(raw, LaneSingle) * single_power(LaneInt32<count>{} - k_unit_frac)};
  }
  /// 2^exponent.
  DETENT_LANES_INLINE static LaneUnits<count> power(LaneInt32<count> exponent) { return {single_power(exponent)}; }
  /// The words `i` and `i` + 1 of each array as a Scaled by which a factor is multiplied. The exponent is clamped:
  /// factors are integers below 2^26, so an exponent beyond a limit gives the same results as the limit.
  DETENT_LANES_INLINE LaneScaled<count> scaled(uint32_t i) const {
    const LaneInt32<count> least = LaneInt32<count>{} - 100, most = LaneInt32<count>{} + 40;
    LaneInt32<count> exponent = word[i + 1] < least ? least : word[i + 1];
    exponent = exponent > most ? most : exponent;
    return {{__builtin_convertvector(word[i], LaneSingle) * single_power(exponent)}};
  }
  DETENT_LANES_INLINE LaneShare<count> share(uint32_t i) const { return {word[i], word[i + 1]}; }

 private:
  using LaneSingle = typename LaneTypes<count>::LaneSingle;
  /// 2^exponent. Range: |exponent| <= 126.
  DETENT_LANES_INLINE static LaneSingle single_power(LaneInt32<count> exponent) {
    return reinterpret_cast<LaneSingle>((exponent + 127) << 23);
  }
#else
  DETENT_LANES_INLINE Lanes<count> unit(uint32_t i) const {
    return {reinterpret_cast<typename LaneTypes<count>::LaneFloat>(word[i])};
  }
  DETENT_LANES_INLINE Lanes<count> unit(uint32_t i, LaneInt32<count>) const { return unit(i); }
  DETENT_LANES_INLINE Lanes<count> fine_unit(uint32_t i) const { return unit(i); }
  DETENT_LANES_INLINE Lanes<count> scaled(uint32_t i) const { return unit(i); }
  DETENT_LANES_INLINE Lanes<count> share(uint32_t i) const { return unit(i); }
#endif
};

template <uint32_t count>
struct LaneInverseInertia {
  Vec3<LaneUnits<count>> row[3];
  LaneStoredInt32<count> exponent;
};

template <uint32_t count>
struct LaneSoftness {
  Lanes<count> rate, spring_eighth;
};

/// A group of contacts with equal numbers of angular rows, as the group is stored while its island is solved. The
/// members have the same meaning as in ContactWork, with one value for each lane. Lanes without a contact have a copy
/// of the group's last contact; the results of these lanes are not used.
template <uint32_t count>
struct LaneContact {
  uint32_t used;                  ///< number of lanes with a contact
  uint32_t contact[count];        ///< indices of the contacts
  uint32_t body[2][count];        ///< slots of their bodies A and B
  uint32_t takes[2][count];       ///< 1 if impulses act on the body
  LaneStoredInt32<count> points;  ///< number of points of each contact
  struct {
    LaneReals<count> normal_impulse[k_manifold_points_max];
    uint32_t point_count;  ///< the largest number of points
  } state;
  uint32_t angular_rows;
  Vec3<LaneUnits<count>> normal, tangent[2], moment_a, moment_b;
  LaneUnits<count> unit_a, unit_b;
  LaneUnits<count> coupling[k_manifold_points_max][k_manifold_points_max];
  static constexpr int coupling_exponent = 0;  // `coupling` includes the exponent
#if DETENT_FIXED
  /// `coupling_step`: the value of the last bit of a mantissa of `coupling`. `coupling_power`: 1 / coupling_step.
  LaneUnits<count> coupling_power, coupling_step;
#endif
  LaneUnits<count> friction_mass;
  Vec3<LaneUnits<count>> middle_a, middle_b;
  LaneUnits<count> response[k_responses];
  static constexpr int response_exponent = 0;  // `response` includes the exponent
  LaneUnits<count> x[k_manifold_points_max], y[k_manifold_points_max], normal_mass[k_manifold_points_max];
  LaneStoredInt32<count> apart[k_manifold_points_max];
  LaneReals<count> separation[k_manifold_points_max], impulse_max[k_manifold_points_max];
  LaneReals<count> friction_impulse[2], angular_impulse[3];
  LaneScaled<count> twist_mass, rolling_mass;
  LaneShare<count> inverse_mass_a, inverse_mass_b;
  LaneScaled<count> friction, twist_arm, rolling_arm;
  LaneReals<count> push_max, deep;
  LaneStoredInt32<count> static_pair;
  LaneInverseInertia<count> inverse_inertia[2];
};

template <uint32_t count>
struct LaneBody {
  Vec3<LaneReals<count>> linear_velocity, angular_momentum, angular_velocity;
  Vec3<LaneReals<count>> contact_velocity, contact_angular_momentum;
  Vec3<LaneReals<count>> displacement, rotation_vector;
  const LaneInverseInertia<count>& inverse_inertia;

  /// The motion is not initialised.
  DETENT_LANES_INLINE explicit LaneBody(const LaneInverseInertia<count>& own) : inverse_inertia(own) {}
};

namespace {

/// The kind of number for `count` contacts at once.
template <uint32_t count>
struct LaneKind {
  using Types = LaneTypes<count>;
  using Number = Lanes<count>;
  using Factor = Number;
  using Sum = Number;
  using Vector = Vec3<Number>;
  using Block = typename Types::LaneBlock;
  using Real = LaneReals<count>;
  using Unit = LaneUnits<count>;
  using Scaled = LaneShare<count>;
  using Contact = LaneContact<count>;
  using Body = LaneBody<count>;
  using Mask = LaneMask<count>;
  using Flags = LaneInt32<count>;

  DETENT_LANES_INLINE static Number zero() { return Types::lanes_of(LaneNumber{0}); }
  DETENT_LANES_INLINE static Number unit(detent::Unit value) {
#if DETENT_FIXED
    return Types::lanes_of(static_cast<double>(value.raw) * 0x1p-30);
#else
    return Types::lanes_of(value);
#endif
  }
#if DETENT_FIXED
  using Wide = Number;
  DETENT_LANES_INLINE static Number mantissa(const Contact& contact, uint32_t i, uint32_t k) {
    return product(contact.coupling[i][k], contact.coupling_power);
  }
  DETENT_LANES_INLINE static Number widened(Number value) { return product(value, Types::lanes_of(0x1p20)); }
  DETENT_LANES_INLINE static typename Types::LaneProduct wide(Number a, Number b) { return product(a, b); }
  DETENT_LANES_INLINE static Number narrowed(Number sum) { return rounded(product(sum, Types::lanes_of(0x1p-20))); }
  DETENT_LANES_INLINE static Number scaled_product(Number a, Number b) { return narrowed(product(a, b)); }
  DETENT_LANES_INLINE static Number held_row(Number a) {
    return clamp(a, Types::lanes_of(-k_row_max), Types::lanes_of(k_row_max));
  }
  DETENT_LANES_INLINE static Number inverse(Number pivot) {
    return rounded_down(Number{Types::lanes_of(0x1p40).v / max(pivot, Types::lanes_of(0x1p13)).v});
  }
  DETENT_LANES_INLINE static Number quotient(const Contact& contact, Number side, Number inverse_pivot) {
    const Number power = product(contact.coupling_power, Types::lanes_of(0x1p-40));
    return rounded(product(product(side, inverse_pivot), power));
  }
  DETENT_LANES_INLINE static Number soft_speed(const Contact& contact, Number impulse, Number mantissa) {
    return rounded(product(product(impulse, mantissa), contact.coupling_step));
  }
#else
  using Wide = Number;
  DETENT_LANES_INLINE static Number mantissa(const Contact& contact, uint32_t i, uint32_t k) {
    return contact.coupling[i][k];
  }
  DETENT_LANES_INLINE static Number widened(Number value) { return value; }
  DETENT_LANES_INLINE static Number wide(Number a, Number b) { return product(a, b); }
  DETENT_LANES_INLINE static Number narrowed(Number sum) { return sum; }
  DETENT_LANES_INLINE static Number scaled_product(Number a, Number b) { return narrowed(product(a, b)); }
  DETENT_LANES_INLINE static Number held_row(Number a) { return a; }
  DETENT_LANES_INLINE static Number inverse(Number pivot) { return {Types::lanes_of(1).v / pivot.v}; }
  DETENT_LANES_INLINE static Number quotient(const Contact&, Number side, Number inverse_pivot) {
    return product(side, inverse_pivot);
  }
  DETENT_LANES_INLINE static Number soft_speed(const Contact&, Number impulse, Number mantissa) {
    return product(impulse, mantissa);
  }
#endif
  DETENT_LANES_INLINE static Number eightfold(Number a) { return product(a, Types::lanes_of(LaneNumber{8})); }
  DETENT_LANES_INLINE static Mask is_positive(Number value) { return value > zero(); }
  DETENT_LANES_INLINE static Number factor(Number value) { return value; }
  DETENT_LANES_INLINE static Number impulse(Number value) {
#if DETENT_FIXED
    return clamp(value, zero(), Types::lanes_of(LaneNumber{k_factor_max}));
#else
    return max(value, zero());
#endif
  }
  /// Always true: impulses on a non-dynamic body have no effect, because the relative inverse mass of the body is 0 and
  /// the body is not written back.
  DETENT_LANES_INLINE static bool takes_impulses(const Scaled&) { return true; }
  DETENT_LANES_INLINE static Mask has_point(const Contact& contact, uint32_t i) {
    const Flags points = contact.points;
    return is_set(points > static_cast<int32_t>(i));
  }
  DETENT_LANES_INLINE static Flags flag(Mask mask) { return __builtin_convertvector(mask.v, Flags); }
  DETENT_LANES_INLINE static Mask all() { return Types::lanes_of(LaneNumber{1}) > zero(); }
  DETENT_LANES_INLINE static bool any(Mask mask) { return Types::any(mask); }
  DETENT_LANES_INLINE static Mask is_set(Flags flag) {
    return {__builtin_convertvector(flag, typename Types::LaneMaskBits)};
  }
  DETENT_LANES_INLINE static Mask is_unset(Flags flag) { return is_set(~flag); }
  DETENT_LANES_INLINE static LaneSoftness<count> softness(const StepSettings& settings, const Contact& contact) {
    const auto one = [&](detent::Unit Softness::*part) {
      return select(is_set(contact.static_pair), unit(settings.static_softness.*part),
                    unit(settings.dynamic_softness.*part));
    };
    return {one(&Softness::rate), one(&Softness::spring_eighth)};
  }
};

}  // namespace

/// Reads the vector that `pick` selects from each of the contacts or bodies.
template <uint32_t count, class Item, class Pick>
DETENT_LANES_INLINE void read_vector(Item* const (&items)[count], const Pick& pick, Vec3<LaneReals<count>>& to) {
  LaneReals<count> row[3];
  read_three(EachLane<const Real*, count>([&](uint32_t k) { return &pick(*items[k]).x; }).of, row);
  to = {row[0], row[1], row[2]};
}
template <uint32_t count, class Item, class Pick>
DETENT_LANES_INLINE void write_vector(const Vec3<LaneReals<count>>& from, Item* const (&items)[count],
                                      const Pick& pick) {
  const LaneReals<count> row[3] = {from.x, from.y, from.z};
  write_three(row, EachLane<Real*, count>([&](uint32_t k) { return &pick(*items[k]).x; }).of);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
