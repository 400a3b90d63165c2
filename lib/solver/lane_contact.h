#pragma once
#include "solver/contact_solver.h"
#include "solver/lanes.h"

/// Four contacts, or four bodies, read from memory into lanes and written back.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Transposes a matrix of 4 x 4 words of 32 bits.
template <class Row>
DETENT_LANES_INLINE void transpose_words(Row (&row)[4]) {
  const Row low_01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
  const Row low_23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
  const Row high_01 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
  const Row high_23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
  row[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
  row[2] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
  row[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
}

/// Reads four words from each of four addresses, and transposes them.
DETENT_LANES_INLINE void read_four_words(const void* const (&from)[4], LaneInt32 (&words)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&words[k], from[k], sizeof(words[k]));
  transpose_words(words);
}

/// Transposes four words, and writes them to each of four addresses.
DETENT_LANES_INLINE void write_words(const LaneInt32 (&words)[4], void* const (&to)[4]) {
  LaneInt32 rows[4];
  const void* const from[4] = {&words[0], &words[1], &words[2], &words[3]};
  read_four_words(from, rows);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &rows[k], sizeof(rows[k]));
}

#if DETENT_FIXED
using LaneNumber = double;
DETENT_LANES_INLINE Lanes lanes_of(Unit value) { return lanes_of(static_cast<double>(value.raw) * 0x1p-30); }

typedef int64_t LaneHalf __attribute__((vector_size(16)));

/// Reads two numbers of 64 bits from each of four addresses, and transposes them. A 256-bit register is assembled from
/// 128-bit halves when it is read, and split into them when it is written, because moving data between the halves of a
/// register costs more.
DETENT_LANES_INLINE void read_two(const void* const (&from)[4], LaneStoredInt64& first, LaneStoredInt64& second) {
  LaneHalf row[4];
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], from[k], sizeof(row[k]));
  const LaneInt64 even = __builtin_shufflevector(row[0], row[2], 0, 1, 2, 3);
  const LaneInt64 odd = __builtin_shufflevector(row[1], row[3], 0, 1, 2, 3);
  first = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  second = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}
DETENT_LANES_INLINE void write_two(LaneInt64 first, LaneInt64 second, void* const (&to)[4]) {
  const LaneInt64 even = __builtin_shufflevector(first, second, 0, 4, 2, 6);
  const LaneInt64 odd = __builtin_shufflevector(first, second, 1, 5, 3, 7);
  const LaneHalf row[4] = {__builtin_shufflevector(even, even, 0, 1), __builtin_shufflevector(odd, odd, 0, 1),
                           __builtin_shufflevector(even, even, 2, 3), __builtin_shufflevector(odd, odd, 2, 3)};
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &row[k], sizeof(row[k]));
}

/// Reads four Reals from each of four addresses, and transposes them.
DETENT_LANES_INLINE void read_reals(const Real* const (&from)[4], LaneReals (&to)[4]) {
  read_two({from[0], from[1], from[2], from[3]}, to[0].v, to[1].v);
  read_two({from[0] + 2, from[1] + 2, from[2] + 2, from[3] + 2}, to[2].v, to[3].v);
}
DETENT_LANES_INLINE void write_reals(const LaneReals (&from)[4], Real* const (&to)[4]) {
  write_two(from[0].v, from[1].v, {to[0], to[1], to[2], to[3]});
  write_two(from[2].v, from[3].v, {to[0] + 2, to[1] + 2, to[2] + 2, to[3] + 2});
}
DETENT_LANES_INLINE LaneReals read_real(const Real* const (&from)[4]) {
  return {LaneInt64{from[0]->raw, from[1]->raw, from[2]->raw, from[3]->raw}};
}
DETENT_LANES_INLINE void write_real(LaneReals from, Real* const (&to)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) to[k]->raw = from.v[k];
}
DETENT_LANES_INLINE void read_three(const Real* const (&from)[4], LaneReals (&to)[3]) {
  read_two({from[0], from[1], from[2], from[3]}, to[0].v, to[1].v);
  to[2] = read_real({from[0] + 2, from[1] + 2, from[2] + 2, from[3] + 2});
}
DETENT_LANES_INLINE void write_three(const LaneReals (&from)[3], Real* const (&to)[4]) {
  write_two(from[0].v, from[1].v, {to[0], to[1], to[2], to[3]});
  write_real(from[2], {to[0] + 2, to[1] + 2, to[2] + 2, to[3] + 2});
}

#else
using LaneNumber = Real;

DETENT_LANES_INLINE void read_reals(const Real* const (&from)[4], Lanes (&to)[4]) {
  LaneFloat row[4];
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], from[k], sizeof(row[k]));
  transpose_words(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) to[k].v = row[k];
}
DETENT_LANES_INLINE void write_reals(const Lanes (&from)[4], Real* const (&to)[4]) {
  LaneFloat row[4] = {from[0].v, from[1].v, from[2].v, from[3].v};
  transpose_words(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &row[k], sizeof(row[k]));
}
DETENT_LANES_INLINE Lanes read_real(const Real* const (&from)[4]) {
  return {LaneFloat{*from[0], *from[1], *from[2], *from[3]}};
}
DETENT_LANES_INLINE void write_real(Lanes from, Real* const (&to)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) *to[k] = from.v[k];
}
/// Reads three Reals from each of four addresses, and transposes them. Four Reals must be readable at each address.
DETENT_LANES_INLINE void read_three(const Real* const (&from)[4], Lanes (&to)[3]) {
  Lanes row[4];
  read_reals(from, row);
  DETENT_UNROLL
  for (int k = 0; k < 3; ++k) to[k] = row[k];
}
DETENT_LANES_INLINE void write_three(const Lanes (&from)[3], Real* const (&to)[4]) {
  LaneFloat row[4] = {from[0].v, from[1].v, from[2].v, from[2].v};
  transpose_words(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) {
    __builtin_memcpy(to[k], &row[k], 2 * sizeof(Real));
    const auto last = row[k][2];
    __builtin_memcpy(to[k] + 2, &last, sizeof(Real));
  }
}
#endif

/// Reads the first `count` words of four arrays. Range: `count` is a multiple of 4, and `count` words are readable.
template <unsigned count>
struct LaneWords {
  LaneInt32 word[count];

  DETENT_LANES_INLINE explicit LaneWords(const uint8_t* const (&from)[4]) {
    for (unsigned i = 0; i < count; i += 4) {
      LaneInt32 row[4];
      read_four_words({from[0] + 4 * i, from[1] + 4 * i, from[2] + 4 * i, from[3] + 4 * i}, row);
      DETENT_UNROLL
      for (unsigned k = 0; k < 4; ++k) word[i + k] = row[k];
    }
  }
#if DETENT_FIXED
  /// Units of at most 24 bits, times 2^exponent.
  DETENT_LANES_INLINE LaneUnits unit(uint32_t i, LaneInt32 exponent = LaneInt32{0, 0, 0, 0}) const {
    return {__builtin_convertvector(word[i], LaneSingle) * single_power(exponent - k_unit_frac)};
  }
  DETENT_LANES_INLINE LaneUnits fine_unit(uint32_t i) const {
    constexpr int32_t k_step = 1 << (k_unit_frac - k_fine_frac);
    const LaneInt32 raw = (word[i] + k_step / 2) & -k_step;
    return {__builtin_convertvector(raw, LaneSingle) * single_power(LaneInt32{0, 0, 0, 0} - k_unit_frac)};
  }
  /// 2^exponent.
  DETENT_LANES_INLINE static LaneUnits power(LaneInt32 exponent) { return {single_power(exponent)}; }
  /// A Scaled by which a factor is multiplied. Factors are integers below 2^26, so larger and smaller exponents have
  /// the same results as the limits.
  DETENT_LANES_INLINE LaneScaled scaled(uint32_t i) const {
    const LaneInt32 least = LaneInt32{0, 0, 0, 0} - 100, most = LaneInt32{0, 0, 0, 0} + 40;
    LaneInt32 exponent = word[i + 1] < least ? least : word[i + 1];
    exponent = exponent > most ? most : exponent;
    return {{__builtin_convertvector(word[i], LaneSingle) * single_power(exponent)}};
  }
  DETENT_LANES_INLINE LaneShare share(uint32_t i) const { return {word[i], word[i + 1]}; }

 private:
  typedef float LaneSingle __attribute__((vector_size(16)));
  /// 2^exponent. Range: |exponent| <= 126.
  DETENT_LANES_INLINE static LaneSingle single_power(LaneInt32 exponent) {
    return reinterpret_cast<LaneSingle>((exponent + 127) << 23);
  }
#else
  DETENT_LANES_INLINE Lanes unit(uint32_t i) const { return {reinterpret_cast<LaneFloat>(word[i])}; }
  DETENT_LANES_INLINE Lanes unit(uint32_t i, LaneInt32) const { return unit(i); }
  DETENT_LANES_INLINE Lanes fine_unit(uint32_t i) const { return unit(i); }
  DETENT_LANES_INLINE Lanes scaled(uint32_t i) const { return unit(i); }
  DETENT_LANES_INLINE Lanes share(uint32_t i) const { return unit(i); }
#endif
};

struct LaneInverseInertia {
  Vec3<LaneUnits> row[3];
  LaneStoredInt32 exponent;
};

struct LaneSoftness {
  Lanes rate, spring_eighth;
};

/// Four contacts with equal counts of points and of angular rows, as they are kept while their island is solved:
/// ContactWork has the members' meanings. A member that has one value in each contact has one in each lane.
struct LaneContact {
  uint32_t contact[4];   ///< indices of the contacts
  uint32_t body[2][4];   ///< slots of their bodies A and B
  uint32_t takes[2][4];  ///< 1 if impulses act on the body
  struct {
    LaneReals normal_impulse[k_manifold_points_max];
    uint32_t point_count;
  } state;
  uint32_t angular_rows;
  Vec3<LaneUnits> normal, tangent[2], moment_a, moment_b;
  LaneUnits unit_a, unit_b;
  LaneUnits coupling[k_manifold_points_max][k_manifold_points_max];
  static constexpr int coupling_exponent = 0;  // the coupling includes it
#if DETENT_FIXED
  LaneUnits coupling_power, coupling_step;  ///< 1 over the least part of a mantissa of the coupling, and that part
#endif
  LaneUnits friction_mass[2];
  Vec3<LaneUnits> middle_a, middle_b;
  LaneUnits response[k_responses];
  static constexpr int response_exponent = 0;  // the response includes it
  LaneUnits x[k_manifold_points_max], y[k_manifold_points_max], inverse_mass[k_manifold_points_max];
  LaneStoredInt32 apart[k_manifold_points_max];
  LaneReals separation[k_manifold_points_max], impulse_max[k_manifold_points_max];
  LaneReals friction_impulse[2], angular_impulse[3];
  LaneScaled angular_mass[3];
  LaneShare inverse_mass_a, inverse_mass_b;
  LaneScaled friction, twist_arm, rolling_arm;
  LaneReals push_max;
  LaneStoredInt32 static_pair;
  LaneInverseInertia inverse_inertia[2];
};

struct LaneBody {
  Vec3<LaneReals> linear_velocity, angular_momentum, angular_velocity;
  Vec3<LaneReals> contact_velocity, contact_angular_momentum;
  Vec3<LaneReals> displacement, rotation_vector;
  const LaneInverseInertia& inverse_inertia;

  /// The motion is not initialised.
  DETENT_LANES_INLINE explicit LaneBody(const LaneInverseInertia& own) : inverse_inertia(own) {}
};

namespace {

/// The kind of number for four contacts.
struct Four {
  using Number = Lanes;
  using Factor = Lanes;
  using Sum = Lanes;
  using Vector = Vec3<Lanes>;
  using Block = LaneBlock;
  using Real = LaneReals;
  using Unit = LaneUnits;
  using Scaled = LaneShare;
  using Contact = LaneContact;
  using Body = LaneBody;
  using Mask = LaneMask;

  DETENT_LANES_INLINE static Lanes zero() { return lanes_of(LaneNumber{0}); }
  DETENT_LANES_INLINE static Lanes unit(detent::Unit value) { return lanes_of(value); }
#if DETENT_FIXED
  using Wide = Lanes;
  DETENT_LANES_INLINE static Lanes mantissa(const LaneContact& contact, uint32_t i, uint32_t k) {
    return product(contact.coupling[i][k], contact.coupling_power);
  }
  DETENT_LANES_INLINE static Lanes widened(Lanes value) { return product(value, lanes_of(0x1p20)); }
  DETENT_LANES_INLINE static LaneProduct wide(Lanes a, Lanes b) { return product(a, b); }
  DETENT_LANES_INLINE static Lanes narrowed(Lanes sum) { return rounded(product(sum, lanes_of(0x1p-20))); }
  DETENT_LANES_INLINE static Lanes scaled_product(Lanes a, Lanes b) { return narrowed(product(a, b)); }
  DETENT_LANES_INLINE static Lanes held_row(Lanes a) { return clamp(a, lanes_of(-k_row_max), lanes_of(k_row_max)); }
  DETENT_LANES_INLINE static Lanes inverse(Lanes pivot) {
    return rounded_down({lanes_of(0x1p40).v / max(pivot, lanes_of(0x1p13)).v});
  }
  DETENT_LANES_INLINE static Lanes quotient(const LaneContact& contact, Lanes side, Lanes inverse_pivot) {
    const Lanes power = product(contact.coupling_power, lanes_of(0x1p-40));
    return rounded(product(product(side, inverse_pivot), power));
  }
  DETENT_LANES_INLINE static Lanes soft_speed(const LaneContact& contact, Lanes impulse, Lanes mantissa) {
    return rounded(product(product(impulse, mantissa), contact.coupling_step));
  }
#else
  using Wide = Lanes;
  DETENT_LANES_INLINE static Lanes mantissa(const LaneContact& contact, uint32_t i, uint32_t k) {
    return contact.coupling[i][k];
  }
  DETENT_LANES_INLINE static Lanes widened(Lanes value) { return value; }
  DETENT_LANES_INLINE static Lanes wide(Lanes a, Lanes b) { return product(a, b); }
  DETENT_LANES_INLINE static Lanes narrowed(Lanes sum) { return sum; }
  DETENT_LANES_INLINE static Lanes scaled_product(Lanes a, Lanes b) { return narrowed(product(a, b)); }
  DETENT_LANES_INLINE static Lanes held_row(Lanes a) { return a; }
  DETENT_LANES_INLINE static Lanes inverse(Lanes pivot) { return {lanes_of(1).v / pivot.v}; }
  DETENT_LANES_INLINE static Lanes quotient(const LaneContact&, Lanes side, Lanes inverse_pivot) {
    return product(side, inverse_pivot);
  }
  DETENT_LANES_INLINE static Lanes soft_speed(const LaneContact&, Lanes impulse, Lanes mantissa) {
    return product(impulse, mantissa);
  }
#endif
  DETENT_LANES_INLINE static Lanes eightfold(Lanes a) { return product(a, lanes_of(LaneNumber{8})); }
  DETENT_LANES_INLINE static LaneMask is_positive(Lanes value) { return value > zero(); }
  DETENT_LANES_INLINE static Lanes factor(Lanes value) { return value; }
  DETENT_LANES_INLINE static Lanes impulse(Lanes value) {
#if DETENT_FIXED
    return clamp(value, zero(), lanes_of(LaneNumber{k_factor_max}));
#else
    return max(value, zero());
#endif
  }
  /// Always true: impulses on a non-dynamic body have no effect, because its relative inverse mass is 0 and it is not
  /// written back.
  DETENT_LANES_INLINE static bool takes_impulses(const LaneShare&) { return true; }
  DETENT_LANES_INLINE static LaneInt32 flag(LaneMask mask) { return __builtin_convertvector(mask.v, LaneInt32); }
  DETENT_LANES_INLINE static LaneMask all() { return lanes_of(LaneNumber{1}) > zero(); }
  DETENT_LANES_INLINE static bool any(LaneMask mask) { return detent::any(mask); }
  DETENT_LANES_INLINE static LaneMask is_set(LaneInt32 flag) { return {__builtin_convertvector(flag, LaneMaskBits)}; }
  DETENT_LANES_INLINE static LaneMask is_unset(LaneInt32 flag) { return is_set(~flag); }
  DETENT_LANES_INLINE static LaneSoftness softness(const StepSettings& settings, const LaneContact& contact) {
    const auto one = [&](detent::Unit Softness::*part) {
      return select(is_set(contact.static_pair), lanes_of(settings.static_softness.*part),
                    lanes_of(settings.dynamic_softness.*part));
    };
    return {one(&Softness::rate), one(&Softness::spring_eighth)};
  }
};

}  // namespace

DETENT_LANES_INLINE Vec3<LaneReals> operator+(const Vec3<LaneReals>& a, const Vec3<LaneReals>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// Reads the vector that `pick` selects from each of four contacts or bodies.
template <class Item, class Pick>
DETENT_LANES_INLINE void read_vector(Item* const (&items)[4], const Pick& pick, Vec3<LaneReals>& to) {
  LaneReals row[3];
  read_three({&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x}, row);
  to = {row[0], row[1], row[2]};
}
template <class Item, class Pick>
DETENT_LANES_INLINE void write_vector(const Vec3<LaneReals>& from, Item* const (&items)[4], const Pick& pick) {
  write_three({from.x, from.y, from.z},
              {&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
