#include "tests/campaigns/manifolds/solids.h"

#include <math.h>

#include <algorithm>

#include "tests/common/oracle/contact_patch.h"

namespace detent_manifolds {

namespace {

constexpr double k_pi = 3.14159265358979323846;

Arrow unit(const Arrow& v) { return v * (1 / detent_oracle::length(v)); }
Arrow any_across(const Arrow& out) {
  return unit(detent_oracle::cross(out, fabsl(out.x) < 0.6L ? Arrow{1, 0, 0} : Arrow{0, 1, 0}));
}
Arrow around(double angle) { return {cos(angle), 0, sin(angle)}; }

/// A log-uniform random number in [low, high].
double spread(Dice& dice, double low, double high) { return low * pow(high / low, dice.between(0, 1)); }

/// Adds the corners of a prism: `count` corners of radius r, with heights that differ by up to `uneven`. For a wedge,
/// or a block with a smaller upper side, `top` is the scale of the upper side.
void add_prism(Dice& dice, int count, const Triple& half, double top, double uneven, Solid& solid) {
  const double start = dice.between(0, 1);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * k_pi * (i + start) / count;
    for (const double side : {-1.0, 1.0}) {
      const double r = side > 0 ? top : 1, off = uneven * dice.between(-1, 1);
      solid.points.push_back(
          {held(half[0] * r * cos(angle)), held(side * half[1] + off), held(half[2] * r * sin(angle))});
    }
  }
}

/// Draws each number in its own statement: the order of evaluation of arguments depends on the compiler.
Solid random_hull(Dice& dice, const Triple& half) {
  Solid solid;
  solid.kind = SolidKind::hull;
  switch (dice.below(5)) {
    case 0:  // a prism
      add_prism(dice, 3 + dice.below(10), half, 1, 0, solid);
      break;
    case 1: {  // nearly flat
      const double uneven = half[1] * spread(dice, 1e-6, 1e-2);
      add_prism(dice, 4 + dice.below(9), half, 1, uneven, solid);
      break;
    }
    case 2: {  // a block with slanted sides
      const double top = dice.between(0.3, 0.9);
      add_prism(dice, 3 + dice.below(6), half, top, 0, solid);
      break;
    }
    case 3:  // a wedge
      for (const double z : {-half[2], half[2]}) {
        solid.points.push_back({held(-half[0]), held(-half[1]), held(z)});
        solid.points.push_back({held(half[0]), held(-half[1]), held(z)});
        solid.points.push_back({held(half[0] * dice.between(-1, 1)), held(half[1]), held(z)});
      }
      break;
    default:
      for (int i = 8 + dice.below(13); i > 0; --i) {
        const Triple v = dice.direction();
        solid.points.push_back({held(v[0] * half[0]), held(v[1] * half[1]), held(v[2] * half[2])});
      }
  }
  return solid;
}

/// A direction between two unit normals: 0 is the first, 1 the second.
Arrow between(const Arrow& a, const Arrow& b, double part) { return unit(a * (1 - part) + b * part); }

/// The mean of the support points in a direction.
Arrow middle_of(const detent_oracle::ConvexSolid& solid, const Arrow& out) {
  if (solid.core == detent_oracle::CoreKind::points) {
    const Number most = support_value(solid, out);
    Arrow sum = {0, 0, 0};
    int count = 0;
    for (const Arrow& p : solid.points) {
      if (detent_oracle::dot(p, out) < most - 1e-9L * solid.distance_max) continue;
      sum = sum + p;
      ++count;
    }
    return sum * (1.0L / count);
  }
  const bool cone = solid.core == detent_oracle::CoreKind::cone;
  const Number low = cone ? -solid.half_length / 2 : -solid.half_length, high = cone ? 1.5L * solid.half_length : -low;
  const Number across = hypotl(out.x, out.z);
  if (across < 1e-9L) return {0, out.y < 0 ? low : high, 0};
  const Arrow aside = {out.x / across * solid.radius, 0, out.z / across * solid.radius};
  const Number at_low = dot(out, aside) + out.y * low, at_high = (cone ? 0 : dot(out, aside)) + out.y * high;
  const Arrow foot = aside + Arrow{0, low, 0}, head = (cone ? Arrow{0, 0, 0} : aside) + Arrow{0, high, 0};
  if (fabsl(at_low - at_high) < 1e-9L * solid.distance_max) return (foot + head) * 0.5L;
  return at_low > at_high ? foot : head;
}

}  // namespace

double held(double length) {
  const int bits = fabs(length) < 16 ? 20 : 16;
  return ldexp(round(ldexp(length, bits)), -bits);
}

Solid box_of(const Triple& half) {
  Solid solid;
  solid.kind = SolidKind::box;
  solid.half_extents = {held(half[0]), held(half[1]), held(half[2])};
  return solid;
}

Solid random_solid(Dice& dice, Part part, double size) {
  constexpr SolidKind k_faces[] = {SolidKind::box,  SolidKind::box,  SolidKind::cylinder,
                                   SolidKind::cone, SolidKind::hull, SolidKind::hull};
  constexpr SolidKind k_edges[] = {SolidKind::box,  SolidKind::cylinder, SolidKind::capsule,
                                   SolidKind::cone, SolidKind::hull,     SolidKind::hull};
  constexpr SolidKind k_corners[] = {SolidKind::box,  SolidKind::sphere, SolidKind::cone,
                                     SolidKind::hull, SolidKind::hull,   SolidKind::capsule};
  constexpr SolidKind k_rims[] = {SolidKind::cylinder, SolidKind::cone};
  const auto thin = [&] { return dice.below(3) == 0 ? spread(dice, 0.01, 1) : dice.between(0.2, 1); };
  // At least a millimetre thick, so that steps of positions do not matter.
  const auto length = [&] { return held(std::max(size * thin(), 1e-3)); };
  const Triple half = {length(), length(), length()};
  const SolidKind kind = part == Part::face     ? k_faces[dice.below(6)]
                         : part == Part::edge   ? k_edges[dice.below(6)]
                         : part == Part::corner ? k_corners[dice.below(6)]
                                                : k_rims[dice.below(2)];
  if (kind == SolidKind::hull) return random_hull(dice, half);
  if (kind == SolidKind::box) return box_of(half);
  Solid solid;
  solid.kind = kind;
  solid.radius = half[0];
  solid.half_length = kind == SolidKind::sphere ? 0 : half[1];
  return solid;
}

Seat random_seat(Dice& dice, const Solid& solid, Part part) {
  const detent_oracle::ConvexSolid convex = solid_of(solid);
  Seat seat = {{0, -1, 0}, {1, 0, 0}, {0, 0, 0}};
  const double angle = dice.between(0, 2 * k_pi), mix = dice.between(0.15, 0.85);
  if (convex.core != detent_oracle::CoreKind::points) {
    const bool cone = convex.core == detent_oracle::CoreKind::cone;
    const Arrow radial = around(angle);
    const Number rise = cone ? convex.radius / (2 * convex.half_length) : 0;
    const Arrow side = unit(radial + Arrow{0, rise, 0});
    const Arrow end = {0, cone || dice.coin() ? -1.0L : 1.0L, 0};
    if (part == Part::face) seat.out = end;
    if (part == Part::edge) {
      seat.out = side;
      seat.along = cone ? unit(radial * -convex.radius + Arrow{0, 2 * convex.half_length, 0}) : Arrow{0, 1, 0};
    }
    if (part == Part::rim || (part == Part::corner && !cone)) seat.out = between(side, end, mix);
    if (part == Part::corner && cone) seat.out = between(side, {0, 1, 0}, mix);
    if (part != Part::edge) seat.along = any_across(seat.out);
  } else if (convex.points.size() < 3) {  // a ball or a rod
    seat.out = around(angle);
    seat.along = {0, 1, 0};
    if (part == Part::corner) seat.out = unit(seat.out + Arrow{0, dice.between(0.1, 2), 0});
    if (part == Part::corner) seat.along = any_across(seat.out);
  } else {
    const std::vector<detent_oracle::FacePlane> faces = detent_oracle::FacedSolid(convex).planes({0, 1, 0});
    const auto on = [&](const detent_oracle::FacePlane& face, const Arrow& p) {
      return fabsl(dot(face.normal, p) - face.limit) < 1e-9L * convex.distance_max;
    };
    // An edge: two corners that lie on two faces. Nearly coplanar faces have no edge.
    for (int attempt = 0; attempt < 64; ++attempt) {
      const detent_oracle::FacePlane& face = faces[static_cast<size_t>(dice.below(static_cast<int>(faces.size())))];
      std::vector<Arrow> corners;
      for (const Arrow& p : convex.points) {
        if (on(face, p)) corners.push_back(p);
      }
      const Arrow &p = corners[0],
                  &q = corners[1 + static_cast<size_t>(dice.below(static_cast<int>(corners.size()) - 1))];
      seat.out = face.normal;
      seat.along = unit(q - p);
      if (part == Part::face) break;
      Arrow sum = {0, 0, 0};
      bool found = false;
      for (const detent_oracle::FacePlane& other : faces) {
        if (&other == &face || !on(other, p) || (part == Part::edge && !on(other, q))) continue;
        if (dot(other.normal, face.normal) > 0.98L) continue;
        sum = sum + other.normal;
        found = true;
      }
      if (!found || detent_oracle::length(sum) < 1e-3L) continue;
      seat.out = between(face.normal, unit(sum), mix);
      if (part == Part::corner) seat.along = any_across(seat.out);
      break;
    }
  }
  seat.middle = middle_of(convex, seat.out);
  return seat;
}

}  // namespace detent_manifolds
