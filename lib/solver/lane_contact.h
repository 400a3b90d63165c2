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
using LaneNumber = int64_t;
using LaneExponent = Lanes;
DETENT_LANES_INLINE Lanes lanes_of(Unit value) { return lanes_of(int64_t{value.raw}); }

typedef int64_t LaneHalf __attribute__((vector_size(16)));

/// Reads two numbers of 64 bits from each of four addresses, and transposes them. A 256-bit register is assembled from
/// 128-bit halves when it is read, and split into them when it is written, because moving data between the halves of a
/// register costs more.
DETENT_LANES_INLINE void read_two(const void* const (&from)[4], LaneInt64& first, LaneInt64& second) {
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
DETENT_LANES_INLINE void read_reals(const Real* const (&from)[4], Lanes (&to)[4]) {
  read_two({from[0], from[1], from[2], from[3]}, to[0].v, to[1].v);
  read_two({from[0] + 2, from[1] + 2, from[2] + 2, from[3] + 2}, to[2].v, to[3].v);
}
DETENT_LANES_INLINE void write_reals(const Lanes (&from)[4], Real* const (&to)[4]) {
  write_two(from[0].v, from[1].v, {to[0], to[1], to[2], to[3]});
  write_two(from[2].v, from[3].v, {to[0] + 2, to[1] + 2, to[2] + 2, to[3] + 2});
}
DETENT_LANES_INLINE Lanes read_real(const Real* const (&from)[4]) {
  return {LaneInt64{from[0]->raw, from[1]->raw, from[2]->raw, from[3]->raw}};
}
DETENT_LANES_INLINE void write_real(Lanes from, Real* const (&to)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) to[k]->raw = from.v[k];
}
DETENT_LANES_INLINE void read_three(const Real* const (&from)[4], Lanes (&to)[3]) {
  read_two({from[0], from[1], from[2], from[3]}, to[0].v, to[1].v);
  to[2] = read_real({from[0] + 2, from[1] + 2, from[2] + 2, from[3] + 2});
}
DETENT_LANES_INLINE void write_three(const Lanes (&from)[3], Real* const (&to)[4]) {
  write_two(from[0].v, from[1].v, {to[0], to[1], to[2], to[3]});
  write_real(from[2], {to[0] + 2, to[1] + 2, to[2] + 2, to[3] + 2});
}

/// Reads the first `count` words of four arrays, two words per register. A factor uses the low half of its lane. Range:
/// `count` is a multiple of 4, and `count` words are readable.
template <unsigned count>
struct LaneWords {
  LaneInt64 pair[count / 2];

  DETENT_LANES_INLINE explicit LaneWords(const uint8_t* const (&from)[4]) {
    for (unsigned i = 0; i < count; i += 4)
      read_two({from[0] + 4 * i, from[1] + 4 * i, from[2] + 4 * i, from[3] + 4 * i}, pair[i / 2], pair[i / 2 + 1]);
  }
  DETENT_LANES_INLINE Lanes unit(uint32_t i) const {
    if (i % 2 == 0) return {pair[i / 2]};
    return {reinterpret_cast<LaneInt64>(reinterpret_cast<LaneUint64>(pair[i / 2]) >> 32)};
  }
  DETENT_LANES_INLINE Lanes number(uint32_t i) const { return product(unit(i), lanes_of(1)); }
  DETENT_LANES_INLINE Lanes exponent(uint32_t i) const { return number(i); }
  DETENT_LANES_INLINE LaneScaled scaled(uint32_t i) const { return {number(i), number(i + 1)}; }
  DETENT_LANES_INLINE LaneMask flag(uint32_t i) const { return {number(i).v != 0}; }
};
#else
using LaneNumber = Real;
using LaneExponent = int;

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
  DETENT_LANES_INLINE Lanes unit(uint32_t i) const { return {reinterpret_cast<LaneFloat>(word[i])}; }
  DETENT_LANES_INLINE int exponent(uint32_t) const { return 0; }
  DETENT_LANES_INLINE LaneScaled scaled(uint32_t i) const { return unit(i); }
  DETENT_LANES_INLINE LaneMask flag(uint32_t i) const { return {word[i] != 0}; }
};
#endif

struct LaneInverseInertia {
  Vec3<Lanes> row[3];
  LaneExponent exponent;
};

struct LaneSoftness {
  Lanes rate, mass_scale, impulse_scale;
};

/// Four contacts with equal counts of points and of angular rows.
struct LaneContact {
  struct {
    Lanes normal_impulse[k_manifold_points_max];
    uint32_t point_count;
  } state;
  Vec3<Lanes> normal, tangent[2], moment_a, moment_b;
  Lanes unit_a, unit_b;
  Lanes coupling[k_manifold_points_max][k_manifold_points_max];
  LaneExponent coupling_exponent;
  Lanes friction_mass[2];
  Vec3<Lanes> middle_a, middle_b;
  Lanes response[k_responses];
  LaneExponent response_exponent;
  uint32_t angular_rows;
  Lanes x[k_manifold_points_max], y[k_manifold_points_max], inverse_mass[k_manifold_points_max];
  LaneMask apart[k_manifold_points_max];
  Lanes separation[k_manifold_points_max], impulse_max[k_manifold_points_max];
  Lanes friction_impulse[2], angular_impulse[3];
  LaneScaled angular_mass[3];
  LaneScaled inverse_mass_a, inverse_mass_b, friction, twist_arm, rolling_arm;
  Lanes push_max;
  LaneMask static_pair;
};

struct LaneBody {
  Vec3<Lanes> linear_velocity, angular_momentum, angular_velocity;
  Vec3<Lanes> contact_velocity, contact_angular_momentum;
  Vec3<Lanes> displacement, rotation_vector;
  LaneInverseInertia inverse_inertia;
};

namespace {

/// The kind of number for four contacts.
struct Four {
  using Number = Lanes;
  using Factor = Lanes;
  using Sum = Lanes;
  using Vector = Vec3<Lanes>;
  using Block = LaneBlock;
  using Real = Lanes;
  using Unit = Lanes;
  using Scaled = LaneScaled;
  using Contact = LaneContact;
  using Body = LaneBody;
  using Mask = LaneMask;

  DETENT_LANES_INLINE static Lanes zero() { return lanes_of(LaneNumber{0}); }
  DETENT_LANES_INLINE static Lanes unit(detent::Unit value) { return lanes_of(value); }
  /// Always true: impulses on a non-dynamic body have no effect, because its relative inverse mass is 0 and it is not
  /// written back.
  DETENT_LANES_INLINE static bool takes_impulses(const LaneScaled&) { return true; }
  DETENT_LANES_INLINE static LaneMask flag(LaneMask mask) { return mask; }
  DETENT_LANES_INLINE static LaneMask all() { return lanes_of(LaneNumber{1}) > zero(); }
  DETENT_LANES_INLINE static bool any(LaneMask mask) { return detent::any(mask); }
  DETENT_LANES_INLINE static LaneMask is_unset(LaneMask flag) { return {~flag.v}; }
  DETENT_LANES_INLINE static LaneSoftness softness(const StepSettings& settings, const LaneContact& contact) {
    const auto one = [&](detent::Unit Softness::*part) {
      return select(contact.static_pair, lanes_of(settings.static_softness.*part),
                    lanes_of(settings.dynamic_softness.*part));
    };
    return {one(&Softness::rate), one(&Softness::mass_scale), one(&Softness::impulse_scale)};
  }
};

}  // namespace

DETENT_LANES_INLINE Vec3<Lanes> operator+(const Vec3<Lanes>& a, const Vec3<Lanes>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// Reads the vector that `pick` selects from each of four contacts or bodies.
template <class Item, class Pick>
DETENT_LANES_INLINE void read_vector(Item* const (&items)[4], const Pick& pick, Vec3<Lanes>& to) {
  Lanes row[3];
  read_three({&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x}, row);
  to = {row[0], row[1], row[2]};
}
template <class Item, class Pick>
DETENT_LANES_INLINE void write_vector(const Vec3<Lanes>& from, Item* const (&items)[4], const Pick& pick) {
  write_three({from.x, from.y, from.z},
              {&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
