#include "narrow_phase_pairs.h"

#include <ports/machine.h>

#include "math/float_bits.h"
#include "math/rotation.h"
#include "round_hull.h"
#include "tests/unit/shape/hull_bytes.h"

namespace detent_lockstep {

namespace {

/// numerator 2^-shift, exactly.
template <class T>
struct Exact {
  static T of(int64_t numerator, int shift) { return float_from_integer<T>(numerator, -shift); }
};
template <class Int, int Frac>
struct Exact<Fixed<Int, Frac>> {
  static Fixed<Int, Frac> of(int64_t numerator, int shift) {
    return Fixed<Int, Frac>::from_raw(static_cast<Int>(numerator * (int64_t{1} << (Frac - shift))));
  }
};

struct Integers {
  int32_t x, y, z;
};

/// Each draw is a separate statement or in braces, so that their order is the same with every compiler.
Integers within(Random& random, int32_t limit) {
  return {random.within(limit), random.within(limit), random.within(limit)};
}

template <class T>
Vec3<T> exact(const Integers& v, int shift) {
  return {Exact<T>::of(v.x, shift), Exact<T>::of(v.y, shift), Exact<T>::of(v.z, shift)};
}

Quat draw_rotation(Random& random) {
  const int32_t limit = random.one_in(4) ? 1 : 7;
  Integers v;
  int32_t w, square;
  do {
    v = within(random, limit);
    w = random.within(limit);
    square = v.x * v.x + v.y * v.y + v.z * v.z + w * w;
  } while (square == 0);
  int shift = 0;
  while (square >> (2 * shift) >= 4) ++shift;
  const Vec3<Unit> u = exact<Unit>(v, shift);
  const Quat rotation = {u.x, u.y, u.z, Exact<Unit>::of(w, shift)};
  // Most of the few rotations that are not normalised have another length than 1, and are refused.
  return random.one_in(64) ? rotation : normalise_any(rotation);
}

/// 2^-10 of the pair's scale to 1, mostly more than 1/16; seldom far smaller than the core's other sizes.
int32_t draw_size(Random& random) { return random.one_in(12) ? 2 + random.below(15) : 64 + random.below(960); }

/// The shape types of a pair, and whether some are rounded.
struct Kinds {
  ShapeType types[8];
  int32_t count;
  bool rounds;
};
constexpr Kinds k_all = {{ShapeType::sphere, ShapeType::capsule, ShapeType::box, ShapeType::half_space,
                          ShapeType::cylinder, ShapeType::cone, ShapeType::hull, ShapeType::triangle},
                         8,
                         true};
constexpr Kinds k_polytopes = {{ShapeType::box, ShapeType::hull, ShapeType::triangle}, 3, false};

/// `extent`: half the shape's extent along its x, in 2^-`shift` m, if it is known.
Convex draw_convex(Random& random, ShapeType type, bool rounds, int shift, const Hulls& hulls, int32_t& extent) {
  Convex convex;
  extent = 0;
  if (type == ShapeType::hull) {
    const int32_t index = random.below(Hulls::k_count);
    return rounds && !random.one_in(2) ? hulls.round[index] : hulls.sharp[index];
  }
  Status status = Status::ok;
  do {
    const int32_t rounding = rounds && random.one_in(2) ? 16 + random.below(112) : 0;
    if (type == ShapeType::triangle) {
      Vec3<Real> corners[3];
      for (Vec3<Real>& corner : corners) corner = exact<Real>(within(random, 1023), shift);
      if (random.one_in(16)) corners[1] = corners[0];
      status = make_triangle(corners, Exact<Real>::of(rounding, shift), convex);
    } else {
      const Integers size = {draw_size(random), draw_size(random), draw_size(random)};
      Shape shape;
      shape.type = type;
      shape.radius = Exact<Real>::of(size.x, shift);
      const bool no_length = type == ShapeType::capsule && random.one_in(8);
      shape.half_length = no_length ? Real(0.0) : Exact<Real>::of(size.y, shift);
      shape.half_extents = exact<Real>(size, shift);
      const bool is_round = type == ShapeType::sphere || type == ShapeType::capsule || type == ShapeType::half_space;
      shape.rounding = Exact<Real>::of(is_round ? 0 : rounding, shift);
      status = make_convex(shape, convex);
      extent = size.x + (is_round ? 0 : rounding);
    }
  } while (status != Status::ok);
  return convex;
}

Vec3<Real> draw_turn(Random& random) {
  if (random.one_in(4)) return exact<Real>({0, 0, 0}, 0);
  const int32_t limit = 1 << random.below(11);
  return exact<Real>(within(random, limit), 8);
}

Position moved(const Integers& base, const Integers& offset, int shift) {
  constexpr int32_t k_metre_shift = 10;
  const auto coordinate = [shift](int32_t far, int32_t near) {
    return Exact<Coord>::of((int64_t{far} << (k_metre_shift + shift)) + near, shift);
  };
  return {coordinate(base.x, offset.x), coordinate(base.y, offset.y), coordinate(base.z, offset.z)};
}

}  // namespace

int32_t Random::below(int32_t count) {
  return static_cast<int32_t>(((bits() >> 32) * static_cast<uint64_t>(count)) >> 32);
}

void make_hulls(Hulls& hulls) {
  const Asset assets[Hulls::k_count] = {{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                                        {detent_hulls::k_prism, sizeof detent_hulls::k_prism},
                                        {k_round_hull, sizeof k_round_hull}};
  for (int i = 0; i < Hulls::k_count; ++i) {
    Status status = make_hull(assets[i], Real(0.0), hulls.sharp[i]);
    if (status == Status::ok) status = make_hull(assets[i], Real(0x1p-5), hulls.round[i]);
    if (status != Status::ok) machine_panic(status_text(status));
  }
}

namespace {

void make_pair_of(const Kinds& kinds, Random& random, const Hulls& hulls, Pair& pair) {
  const ShapeType type_a = kinds.types[random.below(kinds.count)];
  const ShapeType type_b = kinds.types[random.below(kinds.count)];
  const bool scales = type_a != ShapeType::hull && type_b != ShapeType::hull;
  const int shift = scales ? 6 + random.below(9) : 10;
  int32_t extent_a, extent_b;
  pair.a = draw_convex(random, type_a, kinds.rounds, shift, hulls, extent_a);
  pair.b = draw_convex(random, type_b, kinds.rounds, shift, hulls, extent_b);

  Pose& pose_a = pair.motion_a.start;
  Pose& pose_b = pair.motion_b.start;
  const bool touching = random.one_in(8);
  const int32_t far = 1 << (9 + random.below(4));
  Integers offset = within(random, far);
  if (touching) offset = {extent_a + extent_b, 0, 0};
  pose_a.rotation = touching ? k_identity : draw_rotation(random);
  pose_b.rotation = touching ? k_identity : draw_rotation(random);
  const Integers base = random.one_in(2) ? Integers{0, 0, 0} : within(random, 15);
  pose_a.position = moved(base, {0, 0, 0}, shift);
  pose_b.position = moved(base, offset, shift);
  pair.offset = exact<Real>(offset, shift);

  // B's displacement in eighths of its offset from A: from none to twice the distance, plus a lateral part.
  const int32_t eighths = random.below(17);
  const Integers aside = random.one_in(4) ? Integers{0, 0, 0} : within(random, 1 << 12);
  const Integers displacement = {aside.x - offset.x * eighths, aside.y - offset.y * eighths,
                                 aside.z - offset.z * eighths};
  const Integers own = within(random, 1 << 12);
  pair.displacement = exact<Real>(displacement, shift + 3);
  pair.motion_a.displacement = exact<Real>(own, shift + 3);
  pair.motion_b.displacement =
      exact<Real>({displacement.x + own.x, displacement.y + own.y, displacement.z + own.z}, shift + 3);
  pair.motion_a.rotation_vector = draw_turn(random);
  pair.motion_b.rotation_vector = draw_turn(random);
  pair.distance_max = Exact<Real>::of(random.below(1 << 10), shift);
}

}  // namespace

void make_pair(Random& random, const Hulls& hulls, Pair& pair) { make_pair_of(k_all, random, hulls, pair); }

void make_polytopes(Random& random, const Hulls& hulls, Pair& pair) { make_pair_of(k_polytopes, random, hulls, pair); }

}  // namespace detent_lockstep
