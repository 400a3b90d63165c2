#include "tests/common/queries/solids.h"

#include <algorithm>

namespace detent_queries {

namespace {

constexpr double k_pi = 3.14159265358979323846;

Solid of_kind(Kind kind) {
  Solid solid;
  solid.kind = kind;
  return solid;
}

Solid hull_of(std::vector<Triple> points) {
  Solid solid = of_kind(Kind::hull);
  for (Triple& point : points) point = to_float(point);
  solid.points = std::move(points);
  return solid;
}

}  // namespace

double core_bound_of(const Solid& solid) {
  switch (solid.kind) {
    case Kind::sphere:
      return 0;
    case Kind::capsule:
      return solid.half_length;
    case Kind::box:
      return length(solid.half_extents);
    case Kind::cylinder:
      return hypot(solid.radius, solid.half_length);
    case Kind::cone:
      return std::max(hypot(solid.radius, solid.half_length / 2), 1.5 * solid.half_length);
    case Kind::hull:
    case Kind::triangle: {
      double bound = 0;
      for (const Triple& point : solid.points) bound = std::max(bound, length(point));
      return bound;
    }
    case Kind::half_space:
      break;
  }
  return INFINITY;
}

double bound_of(const Solid& solid) {
  const bool radius_rounds = solid.kind == Kind::sphere || solid.kind == Kind::capsule;
  return core_bound_of(solid) + (radius_rounds ? solid.radius : solid.rounding);
}

double size_of(const Query& query) {
  const double core = std::max(core_bound_of(query.a), core_bound_of(query.b));
  return 2 * (core != 0 ? core : std::max(bound_of(query.a), bound_of(query.b)));
}

bool is_polytope(const Solid& solid) {
  return solid.rounding == 0 && (solid.kind == Kind::box || solid.kind == Kind::hull || solid.kind == Kind::triangle);
}

std::vector<Triple> vertices_of(const Solid& solid) {
  if (solid.kind != Kind::box) return solid.points;
  const Triple& half = solid.half_extents;
  std::vector<Triple> vertices;
  for (int i = 0; i < 8; ++i)
    vertices.push_back(
        {(i & 1) != 0 ? half[0] : -half[0], (i & 2) != 0 ? half[1] : -half[1], (i & 4) != 0 ? half[2] : -half[2]});
  return vertices;
}

Solid rounded(Solid solid, double rounding) {
  solid.rounding = to_float(rounding);
  return solid;
}

Solid sphere(double radius) {
  Solid solid = of_kind(Kind::sphere);
  solid.radius = to_float(radius);
  return solid;
}

namespace {

Solid round_solid(Kind kind, double radius, double half_length) {
  Solid solid = of_kind(kind);
  solid.radius = to_float(radius);
  solid.half_length = to_float(half_length);
  return solid;
}

}  // namespace

Solid capsule(double radius, double half_length) { return round_solid(Kind::capsule, radius, half_length); }
Solid cylinder(double radius, double half_length) { return round_solid(Kind::cylinder, radius, half_length); }
Solid cone(double radius, double half_length) { return round_solid(Kind::cone, radius, half_length); }

Solid box(const Triple& half_extents) {
  Solid solid = of_kind(Kind::box);
  solid.half_extents = to_float(half_extents);
  return solid;
}

Solid ellipsoid_hull(Random& random, const Triple& semi_axes, uint32_t count) {
  // A Fibonacci spiral, shaken: no two points come near each other and none lies within the hull of the others.
  const double golden = k_pi * (3 - sqrt(5.0)), start = random.uniform(0, 2 * k_pi);
  std::vector<Triple> points;
  for (uint32_t i = 0; i < count; ++i) {
    const double y = 1 - (i + 0.5 + random.uniform(-0.3, 0.3)) * 2 / count;
    const double angle = start + golden * i + random.uniform(-0.2, 0.2) / sqrt(count);
    const double r = sqrt(1 - y * y);
    points.push_back({semi_axes[0] * r * cos(angle), semi_axes[1] * y, semi_axes[2] * r * sin(angle)});
  }
  return hull_of(std::move(points));
}

Solid triangle(Random& random, double side, double height) {
  // The apex is where neither of the other sides is the longer.
  const double distance_max = sqrt(side * side - height * height);
  const double apex = random.uniform(side - distance_max, distance_max);
  Solid solid = of_kind(Kind::triangle);
  const Triple centroid = {(side + apex) / 3, height / 3, 0};
  for (const Triple& corner : {Triple{0, 0, 0}, Triple{side, 0, 0}, Triple{apex, height, 0}})
    solid.points.push_back(to_float(corner - centroid));
  return solid;
}

Solid prism(double radius, double half_length, uint32_t sides, double flat) {
  std::vector<Triple> points;
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * k_pi * i / sides;
    for (const double y : {-half_length, half_length})
      points.push_back({radius * cos(angle), y, flat * radius * sin(angle)});
  }
  return hull_of(std::move(points));
}

Solid draw(Random& random, Drawn kind, double extent) {
  const double half = extent / 2;
  const auto width = [&] { return half * random.uniform(0.25, 1); };
  switch (kind) {
    case Drawn::sphere:
      return sphere(half);
    case Drawn::capsule: {
      const double radius = half * random.uniform(0.2, 0.7);
      return capsule(radius, half - radius);
    }
    case Drawn::box: {
      Triple half_extents = {width(), width(), width()};
      half_extents[random.below(3)] = half;
      return box(half_extents);
    }
    case Drawn::ellipsoid: {
      Triple semi_axes = {width(), width(), width()};
      semi_axes[random.below(3)] = half;
      return ellipsoid_hull(random, semi_axes, 8 + random.below(25));
    }
    case Drawn::prism: {
      const bool is_long = random.chance(0.5);
      return prism(is_long ? width() : half, is_long ? half : width(), 3 + random.below(6));
    }
    case Drawn::cylinder: {
      const bool is_long = random.chance(0.5);
      return cylinder(is_long ? width() : half, is_long ? half : width());
    }
    case Drawn::cone: {
      const bool is_long = random.chance(0.5);
      return cone(is_long ? width() : half, is_long ? half : width());
    }
  }
  return {};
}

Solid draw(Random& random, const std::vector<Drawn>& kinds, double extent_min, double extent_max) {
  const Drawn kind = kinds[random.below(static_cast<uint32_t>(kinds.size()))];
  return draw(random, kind, random.uniform(extent_min, extent_max));
}

Solid draw_thin(Random& random, bool needle, double size, double aspect) {
  const double wide = size / 2, thin = wide * aspect, middle = needle ? thin : wide * random.uniform(0.5, 1);
  switch (random.below(needle ? 4 : 3)) {
    case 0: {
      Triple half_extents = {middle, middle, middle};
      const uint32_t axis = random.below(3);
      half_extents[axis] = wide;
      half_extents[(axis + 1) % 3] = thin;
      return box(half_extents);
    }
    case 1:
      return ellipsoid_hull(random, {middle, needle ? wide : thin, needle ? thin : wide}, 12 + random.below(21));
    case 2:
      return needle ? prism(thin, wide, 3 + random.below(6)) : prism(wide, thin, 3 + random.below(14));
    default:
      return capsule(thin, wide);
  }
}

Solid draw_rod(Random& random, double rod_length, double thickness, bool round) {
  const double half = rod_length / 2, radius = thickness / 2;
  switch (round ? 3 + random.below(2) : random.below(3)) {
    case 0:
      return capsule(radius, half - radius);
    case 1:
      return box({radius * random.uniform(0.5, 1), half, radius});
    case 2:
      return prism(radius, half, 3 + random.below(6));
    case 3:
      return cylinder(radius, half);
    default:
      return cone(radius, half);
  }
}

}  // namespace detent_queries
