#pragma once
#include "dynamics/contact_solver.h"
#include "dynamics/quad.h"

/// Four contacts, or four bodies, read from their places into quads and written back.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Rows become columns, of four numbers of 32 bits.
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

/// The first `count` words of four arrays, word by word. Range: count is a multiple of 4, and as many can be read.
template <unsigned count>
DETENT_QUAD_INLINE void read_words(const void* const (&from)[4], QuadInt32 (&words)[count]) {
  for (unsigned i = 0; i < count; i += 4) {
    QuadInt32 row[4];
    DETENT_UNROLL
    for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], static_cast<const int32_t*>(from[k]) + i, sizeof(row[k]));
    transpose_words(row);
    DETENT_UNROLL
    for (unsigned k = 0; k < 4; ++k) words[i + k] = row[k];
  }
}

/// Writes four words to each of four places.
DETENT_QUAD_INLINE void write_words(const QuadInt32 (&words)[4], void* const (&to)[4]) {
  QuadInt32 rows[4];
  const void* const from[4] = {&words[0], &words[1], &words[2], &words[3]};
  read_words(from, rows);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &rows[k], sizeof(rows[k]));
}

#if DETENT_FIXED
using QuadRow = QuadInt64;
using QuadNumber = int64_t;
using QuadExponent = Quad;
DETENT_QUAD_INLINE Quad quad_from_words(QuadInt32 words) { return {__builtin_convertvector(words, QuadInt64)}; }
DETENT_QUAD_INLINE Quad exponent_from_words(QuadInt32 words) { return quad_from_words(words); }
DETENT_QUAD_INLINE Quad quad_of(Unit value) { return quad_of(int64_t{value.raw}); }
#else
using QuadRow = QuadFloat;
using QuadNumber = Real;
using QuadExponent = int;
DETENT_QUAD_INLINE Quad quad_from_words(QuadInt32 words) { return {reinterpret_cast<QuadFloat>(words)}; }
DETENT_QUAD_INLINE int exponent_from_words(QuadInt32) { return 0; }
#endif

DETENT_QUAD_INLINE void transpose(QuadRow (&row)[4]) {
#if DETENT_FIXED
  // Within the halves of a register first: to cross them costs more.
  const QuadRow low_01 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
  const QuadRow high_01 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
  const QuadRow low_23 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
  const QuadRow high_23 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
  row[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
  row[2] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
  row[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
#else
  transpose_words(row);
#endif
}

/// Four Reals at each of four places.
DETENT_QUAD_INLINE void read_reals(const Real* const (&from)[4], QuadRow (&row)[4]) {
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(&row[k], from[k], sizeof(row[k]));
  transpose(row);
}
DETENT_QUAD_INLINE void write_reals(QuadRow (&row)[4], Real* const (&to)[4]) {
  transpose(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) __builtin_memcpy(to[k], &row[k], sizeof(row[k]));
}
/// The first three of four.
DETENT_QUAD_INLINE void write_three(QuadRow (&row)[4], Real* const (&to)[4]) {
  transpose(row);
  DETENT_UNROLL
  for (int k = 0; k < 4; ++k) {
    __builtin_memcpy(to[k], &row[k], 2 * sizeof(Real));
    const auto last = row[k][2];
    __builtin_memcpy(to[k] + 2, &last, sizeof(Real));
  }
}

struct QuadGyration {
  Vec3<Quad> row[3];
  QuadExponent exponent;
};

struct QuadSoftness {
  Quad rate, mass_scale, impulse_scale;
};

/// Four contacts of as many points and angular rows.
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
  QuadSoftness softness;
};

struct QuadBody {
  Vec3<Quad> velocity, momentum, spin;
  Vec3<Quad> contact_velocity, contact_momentum;
  Vec3<Quad> displacement, turn;
  QuadGyration gyration;
};

/// The numbers of four contacts.
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

  DETENT_QUAD_INLINE static Quad zero() { return quad_of(QuadNumber{0}); }
  DETENT_QUAD_INLINE static Quad unit(detent::Unit value) { return quad_of(value); }
  /// What is not dynamic has a share of 0, and is not written back.
  DETENT_QUAD_INLINE static bool takes_impulses(const QuadScaled&) { return true; }
  DETENT_QUAD_INLINE static QuadMask flag(QuadMask mask) { return mask; }
  DETENT_QUAD_INLINE static QuadMask is_unset(QuadMask flag) { return {~flag.v}; }
  DETENT_QUAD_INLINE static const QuadSoftness& softness(const StepSettings&, const QuadContact& contact) {
    return contact.softness;
  }
};

DETENT_QUAD_INLINE Vec3<Quad> operator+(const Vec3<Quad>& a, const Vec3<Quad>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// Where `pick` of four contacts or bodies lies.
template <class Item, class Pick>
DETENT_QUAD_INLINE void read_vector(Item* const (&items)[4], const Pick& pick, Vec3<Quad>& to) {
  QuadRow row[4];
  read_reals({&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x}, row);
  to = {{row[0]}, {row[1]}, {row[2]}};
}
template <class Item, class Pick>
DETENT_QUAD_INLINE void write_vector(const Vec3<Quad>& from, Item* const (&items)[4], const Pick& pick) {
  QuadRow row[4] = {from.x.v, from.y.v, from.z.v, from.z.v};
  write_three(row, {&pick(*items[0]).x, &pick(*items[1]).x, &pick(*items[2]).x, &pick(*items[3]).x});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
