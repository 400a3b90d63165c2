#pragma once
#include "solver/contact_solver.h"
#include "solver/quad.h"

/// Four contacts, or four bodies, read from memory into lanes and written back.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Transposes a matrix of 4 x 4 words of 32 bits.
template <class Row>
DETENT_QUAD_INLINE void transpose_words(Row (&row)[4]) {
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
DETENT_QUAD_INLINE void read_four_words(const void* const (&from)[4], QuadInt32 (&words)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&words[k], from[k], sizeof(words[k]));
  transpose_words(words);
}

/// Transposes four words, and writes them to each of four addresses.
DETENT_QUAD_INLINE void write_words(const QuadInt32 (&words)[4], void* const (&to)[4]) {
  QuadInt32 rows[4];
  const void* const from[4] = {&words[0], &words[1], &words[2], &words[3]};
  read_four_words(from, rows);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &rows[k], sizeof(rows[k]));
}

#if DETENT_FIXED
using QuadNumber = int64_t;
using QuadExponent = Quad;
DETENT_QUAD_INLINE Quad quad_of(Unit value) { return quad_of(int64_t{value.raw}); }

typedef int64_t QuadHalf __attribute__((vector_size(16)));

/// Reads two numbers of 64 bits from each of four addresses, and transposes them. Register halves are joined on reading
/// and separated on writing, because moving data across the halves costs more.
DETENT_QUAD_INLINE void read_two(const void* const (&from)[4], QuadInt64& first, QuadInt64& second) {
  QuadHalf row[4];
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], from[k], sizeof(row[k]));
  const QuadInt64 even = __builtin_shufflevector(row[0], row[2], 0, 1, 2, 3);
  const QuadInt64 odd = __builtin_shufflevector(row[1], row[3], 0, 1, 2, 3);
  first = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  second = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}
DETENT_QUAD_INLINE void write_two(QuadInt64 first, QuadInt64 second, void* const (&to)[4]) {
  const QuadInt64 even = __builtin_shufflevector(first, second, 0, 4, 2, 6);
  const QuadInt64 odd = __builtin_shufflevector(first, second, 1, 5, 3, 7);
  const QuadHalf row[4] = {__builtin_shufflevector(even, even, 0, 1), __builtin_shufflevector(odd, odd, 0, 1),
                           __builtin_shufflevector(even, even, 2, 3), __builtin_shufflevector(odd, odd, 2, 3)};
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &row[k], sizeof(row[k]));
}

/// Reads four Reals from each of four addresses, and transposes them.
DETENT_QUAD_INLINE void read_reals(const Real* const (&from)[4], Quad (&to)[4]) {
  read_two({from[0], from[1], from[2], from[3]}, to[0].v, to[1].v);
  read_two({from[0] + 2, from[1] + 2, from[2] + 2, from[3] + 2}, to[2].v, to[3].v);
}
DETENT_QUAD_INLINE void write_reals(const Quad (&from)[4], Real* const (&to)[4]) {
  write_two(from[0].v, from[1].v, {to[0], to[1], to[2], to[3]});
  write_two(from[2].v, from[3].v, {to[0] + 2, to[1] + 2, to[2] + 2, to[3] + 2});
}
DETENT_QUAD_INLINE Quad read_real(const Real* const (&from)[4]) {
  return {QuadInt64{from[0]->raw, from[1]->raw, from[2]->raw, from[3]->raw}};
}
DETENT_QUAD_INLINE void write_real(Quad from, Real* const (&to)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) to[k]->raw = from.v[k];
}
DETENT_QUAD_INLINE void read_three(const Real* const (&from)[4], Quad (&to)[3]) {
  read_two({from[0], from[1], from[2], from[3]}, to[0].v, to[1].v);
  to[2] = read_real({from[0] + 2, from[1] + 2, from[2] + 2, from[3] + 2});
}
DETENT_QUAD_INLINE void write_three(const Quad (&from)[3], Real* const (&to)[4]) {
  write_two(from[0].v, from[1].v, {to[0], to[1], to[2], to[3]});
  write_real(from[2], {to[0] + 2, to[1] + 2, to[2] + 2, to[3] + 2});
}

/// The first `count` words of four arrays, two words per register. A factor uses the low half of its lane. Range: count
/// is a multiple of 4, and that many words are readable.
template <unsigned count>
struct QuadWords {
  QuadInt64 pair[count / 2];

  DETENT_QUAD_INLINE explicit QuadWords(const uint8_t* const (&from)[4]) {
    for (unsigned i = 0; i < count; i += 4)
      read_two({from[0] + 4 * i, from[1] + 4 * i, from[2] + 4 * i, from[3] + 4 * i}, pair[i / 2], pair[i / 2 + 1]);
  }
  DETENT_QUAD_INLINE Quad unit(uint32_t i) const {
    if (i % 2 == 0) return {pair[i / 2]};
    return {reinterpret_cast<QuadInt64>(reinterpret_cast<QuadUint64>(pair[i / 2]) >> 32)};
  }
  DETENT_QUAD_INLINE Quad number(uint32_t i) const { return product(unit(i), quad_of(1)); }
  DETENT_QUAD_INLINE Quad exponent(uint32_t i) const { return number(i); }
  DETENT_QUAD_INLINE QuadScaled scaled(uint32_t i) const { return {number(i), number(i + 1)}; }
  DETENT_QUAD_INLINE QuadMask flag(uint32_t i) const { return {number(i).v != 0}; }
};
#else
using QuadNumber = Real;
using QuadExponent = int;

DETENT_QUAD_INLINE void read_reals(const Real* const (&from)[4], Quad (&to)[4]) {
  QuadFloat row[4];
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], from[k], sizeof(row[k]));
  transpose_words(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) to[k].v = row[k];
}
DETENT_QUAD_INLINE void write_reals(const Quad (&from)[4], Real* const (&to)[4]) {
  QuadFloat row[4] = {from[0].v, from[1].v, from[2].v, from[3].v};
  transpose_words(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &row[k], sizeof(row[k]));
}
DETENT_QUAD_INLINE Quad read_real(const Real* const (&from)[4]) {
  return {QuadFloat{*from[0], *from[1], *from[2], *from[3]}};
}
DETENT_QUAD_INLINE void write_real(Quad from, Real* const (&to)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) *to[k] = from.v[k];
}
/// Reads the first three Reals of four.
DETENT_QUAD_INLINE void read_three(const Real* const (&from)[4], Quad (&to)[3]) {
  Quad row[4];
  read_reals(from, row);
  DETENT_UNROLL
  for (int k = 0; k < 3; ++k) to[k] = row[k];
}
DETENT_QUAD_INLINE void write_three(const Quad (&from)[3], Real* const (&to)[4]) {
  QuadFloat row[4] = {from[0].v, from[1].v, from[2].v, from[2].v};
  transpose_words(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) {
    __builtin_memcpy(to[k], &row[k], 2 * sizeof(Real));
    const auto last = row[k][2];
    __builtin_memcpy(to[k] + 2, &last, sizeof(Real));
  }
}

/// The first `count` words of four arrays. Range: count is a multiple of 4, and that many words are readable.
template <unsigned count>
struct QuadWords {
  QuadInt32 word[count];

  DETENT_QUAD_INLINE explicit QuadWords(const uint8_t* const (&from)[4]) {
    for (unsigned i = 0; i < count; i += 4) {
      QuadInt32 row[4];
      read_four_words({from[0] + 4 * i, from[1] + 4 * i, from[2] + 4 * i, from[3] + 4 * i}, row);
      DETENT_UNROLL
      for (unsigned k = 0; k < 4; ++k) word[i + k] = row[k];
    }
  }
  DETENT_QUAD_INLINE Quad unit(uint32_t i) const { return {reinterpret_cast<QuadFloat>(word[i])}; }
  DETENT_QUAD_INLINE int exponent(uint32_t) const { return 0; }
  DETENT_QUAD_INLINE QuadScaled scaled(uint32_t i) const { return unit(i); }
  DETENT_QUAD_INLINE QuadMask flag(uint32_t i) const { return {word[i] != 0}; }
};
#endif

struct QuadGyration {
  Vec3<Quad> row[3];
  QuadExponent exponent;
};

struct QuadSoftness {
  Quad rate, mass_scale, impulse_scale;
};

/// Four contacts with equal counts of points and of angular rows.
struct QuadContact {
  struct {
    Quad normal_impulse[k_manifold_points_max];
    uint32_t point_count;
  } state;
  Vec3<Quad> normal, tangent[2], lever_a, lever_b;
  Quad unit_a, unit_b;
  Quad coupling[k_manifold_points_max][k_manifold_points_max];
  QuadExponent coupling_exponent;
  Quad friction_mass[2];
  Vec3<Quad> middle_a, middle_b;
  Quad response[k_responses];
  QuadExponent response_exponent;
  uint32_t angular_rows;
  Quad x[k_manifold_points_max], y[k_manifold_points_max], inverse_mass[k_manifold_points_max];
  QuadMask apart[k_manifold_points_max];
  Quad separation[k_manifold_points_max], impulse_max[k_manifold_points_max];
  Quad friction_impulse[2], angular_impulse[3];
  QuadScaled angular_mass[3];
  QuadScaled share_a, share_b, friction, twist_arm, rolling_arm;
  Quad push_max;
  QuadMask static_pair;
};

struct QuadBody {
  Vec3<Quad> velocity, momentum, spin;
  Vec3<Quad> contact_velocity, contact_momentum;
  Vec3<Quad> displacement, turn;
  QuadGyration gyration;
};

namespace {

/// The kind of number for four contacts.
struct Four {
  using Number = Quad;
  using Factor = Quad;
  using Sum = Quad;
  using Vector = Vec3<Quad>;
  using Block = QuadBlock;
  using Real = Quad;
  using Unit = Quad;
  using Scaled = QuadScaled;
  using Contact = QuadContact;
  using Body = QuadBody;
  using Mask = QuadMask;

  DETENT_QUAD_INLINE static Quad zero() { return quad_of(QuadNumber{0}); }
  DETENT_QUAD_INLINE static Quad unit(detent::Unit value) { return quad_of(value); }
  /// A body that is not dynamic has a relative inverse mass of 0, and is not written back.
  DETENT_QUAD_INLINE static bool takes_impulses(const QuadScaled&) { return true; }
  DETENT_QUAD_INLINE static QuadMask flag(QuadMask mask) { return mask; }
  DETENT_QUAD_INLINE static QuadMask all() { return quad_of(QuadNumber{1}) > zero(); }
  DETENT_QUAD_INLINE static bool any(QuadMask mask) { return detent::any(mask); }
  DETENT_QUAD_INLINE static QuadMask is_unset(QuadMask flag) { return {~flag.v}; }
  DETENT_QUAD_INLINE static QuadSoftness softness(const StepSettings& settings, const QuadContact& contact) {
    const auto one = [&](detent::Unit Softness::*part) {
      return select(contact.static_pair, quad_of(settings.static_softness.*part),
                    quad_of(settings.dynamic_softness.*part));
    };
    return {one(&Softness::rate), one(&Softness::mass_scale), one(&Softness::impulse_scale)};
  }
};

}  // namespace

DETENT_QUAD_INLINE Vec3<Quad> operator+(const Vec3<Quad>& a, const Vec3<Quad>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// Reads the vector that `pick` selects from each of four contacts or bodies.
template <class Item, class Pick>
DETENT_QUAD_INLINE void read_vector(Item* const (&items)[4], const Pick& pick, Vec3<Quad>& to) {
  Quad row[3];
  read_three({&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x}, row);
  to = {row[0], row[1], row[2]};
}
template <class Item, class Pick>
DETENT_QUAD_INLINE void write_vector(const Vec3<Quad>& from, Item* const (&items)[4], const Pick& pick) {
  write_three({from.x, from.y, from.z},
              {&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
