#include "tests/common/queries/sets.h"

#include <algorithm>

#include "tests/common/queries/aim.h"
#include "tests/common/queries/gap.h"
#include "tests/common/queries/place.h"
#include "tests/common/queries/solids.h"

namespace detent_queries {

namespace {

const std::vector<Drawn> k_mixed = {Drawn::sphere, Drawn::capsule, Drawn::box, Drawn::ellipsoid, Drawn::prism};
const std::vector<Drawn> k_all = {Drawn::sphere,   Drawn::capsule,  Drawn::box,  Drawn::ellipsoid, Drawn::prism,
                                  Drawn::cylinder, Drawn::cylinder, Drawn::cone, Drawn::cone};
constexpr double k_extent_min = 0.1, k_extent_max = 1.2;
constexpr double k_degree = 3.14159265358979323846 / 180;

bool turning(uint32_t index) { return index % 2 == 0; }

/// Sets 1, 5, 6, 8 and game: sent from apart, every other query with an angular velocity.
Query sent(Random& random, uint32_t index, const Solid& a, const Solid& b, const Aim& aim) {
  Query query = at_one_place(random, a, b, aim.scale);
  send(random, query, aim);
  if (turning(index)) angular_velocity(random, query, 0.05, 1);
  return query;
}

Query mixed_of(Random& random, uint32_t index, const std::vector<Drawn>& kinds, const Aim& aim) {
  const Solid a = draw(random, kinds, k_extent_min, k_extent_max), b = draw(random, kinds, k_extent_min, k_extent_max);
  return sent(random, index, a, b, aim);
}

Query mixed(Random& random, uint32_t index, const Sources&) { return mixed_of(random, index, k_mixed, {}); }
Query mixed_all(Random& random, uint32_t index, const Sources&) { return mixed_of(random, index, k_all, {}); }

Query mixed_rounded(Random& random, uint32_t index, const Sources&) {
  static const std::vector<Drawn> kinds = {Drawn::box, Drawn::ellipsoid, Drawn::prism, Drawn::cylinder, Drawn::cone};
  const auto one = [&] {
    const double extent = random.uniform(k_extent_min, k_extent_max);
    return rounded(draw(random, kinds[random.below(5)], extent), extent * random.log_uniform(0.01, 0.5));
  };
  const Solid a = one(), b = one();
  return sent(random, index, a, b, {});
}

/// Set 2. A is the slab, its middle plane y = 0.
Query paper(Random& random, uint32_t index, const Sources&) {
  const Triple half = {random.uniform(1, 5), random.log_uniform(0.0005, 0.01), random.uniform(1, 5)};
  Query query = at_one_place(random, box(half), draw(random, k_mixed, 0.01, 0.2), 1);
  const double bound = bound_of(query.b), distance = random.log_uniform(1, 60);
  const double angle = random.uniform(0, 69) * k_degree, around = random.uniform(0, 360) * k_degree;
  const Triple from = {sin(angle) * cos(around), cos(angle) * random.sign(), sin(angle) * sin(around)};
  Triple goal = {0.9 * half[0] * random.uniform(-1, 1), 0, 0.9 * half[2] * random.uniform(-1, 1)};
  if (index % 5 == 4) {
    const size_t axis = random.chance(0.5) ? 0 : 2;
    const double beyond = bound * random.uniform(1.02, 1.4) / cos(angle) + half[1] * tan(angle);
    goal[axis] = random.sign() * (half[axis] + beyond);
  }
  const Rotation& rotation = query.path_a.rotation;
  query.path_b.position = to_float(query.path_a.position + rotate(rotation, goal + from * (bound + distance)));
  query.path_b.displacement = to_float(rotate(rotation, from * (-(bound + distance) * random.uniform(1.05, 1.5))));
  return query;
}

/// Sets 3 and 9.
Query rods_of(Random& random, double turn_min, double turn_max, bool round) {
  const auto rod = [&] { return draw_rod(random, random.uniform(1, 6), random.uniform(0.01, 0.08), round); };
  const Solid a = rod();
  const Solid b = random.chance(0.5) ? rod() : draw(random, round ? k_all : k_mixed, k_extent_min, k_extent_max);
  Query query = at_one_place(random, a, b, 1);
  const double bound_a = bound_of(a), bounds = bound_a + bound_of(b);
  for (;;) {
    const Triple apart = random.direction() * (bounds * random.uniform(0.05, 0.95));
    query.path_b.position = to_float(query.path_a.position + apart);
    query.path_b.rotation = random.rotation();
    if (gap_at(query, 0) > 0.002 * bound_a) break;
  }
  const Triple apart = query.path_b.position - query.path_a.position;
  const Triple beside = random.direction() * (0.25 * bound_a * random.uniform(0, 1));
  share_motion(random, query, (beside - apart) * random.uniform(0, 1.2), 0.5);
  angular_velocity(random, query, turn_min, turn_max);
  return query;
}

Query rods(Random& random, uint32_t, const Sources&) { return rods_of(random, 0.5, 3, false); }
Query rods_round(Random& random, uint32_t, const Sources&) { return rods_of(random, 0.5, 3, true); }
Query fast_rods(Random& random, uint32_t, const Sources&) { return rods_of(random, 3.2, 12, false); }

/// Set 4. Every fourth query that turns is one of set 3.
Query grazing(Random& random, uint32_t index, const Sources&) {
  const bool of_rods = index % 8 == 0;
  const double ratio = random.sign() * random.log_uniform(1e-6, 1e-3);
  for (;;) {
    Aim aim;
    aim.lateral_max = 1;
    Query query = of_rods ? rods_of(random, 0.5, 3, false) : mixed_of(random, index, k_mixed, aim);
    if (graze(query, ratio * size_of(query))) return query;
  }
}

Query far_of(Random& random, uint32_t index, double far) {
  Aim aim;
  aim.far = far;
  return mixed_of(random, index, k_mixed, aim);
}
Query far(Random& random, uint32_t index, const Sources&) { return far_of(random, index, index % 4 < 2 ? 1e3 : 1e4); }
Query farthest(Random& random, uint32_t index, const Sources&) { return far_of(random, index, 1e7); }

/// Set 6, in turn at 1 mm, at 100 m and thin.
Query scaled(Random& random, uint32_t index, const Sources&) {
  const uint32_t rotation_vector = index / 2 % 3;
  if (rotation_vector < 2) {
    Aim aim;
    aim.scale = rotation_vector == 0 ? 1e-3 : 100;
    const auto one = [&] { return draw(random, k_mixed, 0.6 * aim.scale, 1.2 * aim.scale); };
    const Solid a = one(), b = one();
    return sent(random, index, a, b, aim);
  }
  const auto thin = [&] { return draw_thin(random, random.chance(0.5), random.uniform(0.3, 1.2), 1e-3); };
  const Solid a = thin();
  return sent(random, index, a, random.chance(0.5) ? thin() : draw(random, k_mixed, 0.1, 1.2), {});
}

/// Set 7.
Query near(Random& random, uint32_t index, const Sources&) {
  Query query;
  do {
    const Solid a = draw(random, k_mixed, k_extent_min, k_extent_max);
    query = at_one_place(random, a, draw(random, k_mixed, k_extent_min, k_extent_max), 1);
  } while (!place_at_gap(query, random.direction(), random.log_uniform(1e-6, 1e-4)));
  const Triple normal = gap_normal(query, 0);
  const Triple along = random.perpendicular(normal);
  Triple relative;
  switch (index / 2 % 3) {
    case 0:
      relative = normal * random.uniform(0.01, 1) + along * random.uniform(0, 1);
      break;
    case 1:
      relative = along * random.uniform(0.05, 1) + normal * (random.sign() * random.log_uniform(1e-6, 1e-2));
      break;
    default:
      relative = normal * -random.log_uniform(1e-5, 1) + along * random.uniform(0, 0.5);
      break;
  }
  share_motion(random, query, relative, 0.5);
  if (turning(index)) angular_velocity(random, query, 0.05, 1);
  return query;
}

/// Set 8.
Query hulls(Random& random, uint32_t index, const Sources&) {
  const auto one = [&] {
    const double half = random.uniform(k_extent_min, k_extent_max) / 2;
    if (random.chance(0.3)) return prism(half, half * random.uniform(0.25, 1), 4 + random.below(29));
    const Triple semi_axes = {half, half * random.uniform(0.25, 1), half * random.uniform(0.25, 1)};
    return ellipsoid_hull(random, semi_axes, 8 + random.below(57));
  };
  const Solid a = one(), b = one();
  return sent(random, index, a, b, {});
}

/// Half the width of a solid along a local axis; for those that are symmetric to the origin.
double half_width(const Solid& solid, size_t axis) {
  switch (solid.kind) {
    case Kind::sphere:
      return solid.radius;
    case Kind::capsule:
      return solid.radius + (axis == 1 ? solid.half_length : 0);
    case Kind::box:
      return solid.half_extents[axis];
    case Kind::cylinder:
      return axis == 1 ? solid.half_length : solid.radius;
    default: {
      double width = 0;
      for (const Triple& point : solid.points) width = std::max(width, fabs(point[axis]));
      return width;
    }
  }
}

/// Set 10: of one rotation, or half a turn apart, side by side along a local axis.
Query degenerate_of(Random& random, bool round) {
  const auto one = [&] {
    const double extent = random.uniform(k_extent_min, k_extent_max);
    if (round && random.chance(0.5)) return draw(random, Drawn::cylinder, extent);
    switch (random.below(6)) {
      case 0:
        return draw(random, Drawn::capsule, extent);
      case 1:
      case 2:
        return draw(random, Drawn::box, extent);
      case 3:
        return prism(extent / 2, extent / 2 * random.uniform(0.25, 1), 2 * (2 + random.below(7)));
      default:
        return draw_thin(random, random.chance(0.5), std::max(extent, 0.2), random.log_uniform(1e-3, 1e-1));
    }
  };
  const Solid a = one();
  const Solid b = random.chance(0.25) ? a : one();
  Query query = at_one_place(random, a, b, 1);
  const Rotation q = query.path_a.rotation;
  query.path_b.rotation = q;
  const size_t axis = random.below(3);
  Triple widths;  // of both together
  for (size_t i = 0; i < 3; ++i) widths[i] = half_width(a, i) + half_width(b, i);
  if (random.chance(0.2)) {  // q times a half turn about the axis: parallel still, and exact
    const Rotation halves[3] = {{q[3], q[2], -q[1], -q[0]}, {-q[2], q[3], q[0], -q[1]}, {q[1], -q[0], q[3], -q[2]}};
    query.path_b.rotation = halves[axis];
  }
  Triple offset;
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t choice = random.below(4);  // aligned, edge over edge, or anywhere
    offset[i] = choice == 0 ? 0 : choice == 1 ? random.sign() * widths[i] : widths[i] * random.uniform(-1, 1);
  }
  offset[axis] = random.sign() * (widths[axis] + random.log_uniform(1e-6, 1));
  query.path_a.position = {};
  query.path_b.position = to_float(rotate(q, offset));
  return query;
}
Query degenerate(Random& random, uint32_t, const Sources&) { return degenerate_of(random, false); }
Query degenerate_round(Random& random, uint32_t, const Sources&) { return degenerate_of(random, true); }

/// Set 11. Half of the triangles are at rest, as those of a mesh, and half of them slivers.
Query triangles(Random& random, uint32_t index, const Sources&) {
  const auto one = [&] {
    const double side = random.uniform(k_extent_min, k_extent_max);
    const double aspect = random.chance(0.5) ? random.log_uniform(0.01, 0.1) : random.uniform(0.1, 0.85);
    return triangle(random, side, side * aspect);
  };
  static const std::vector<Drawn> boxes = {Drawn::box}, hulls = {Drawn::ellipsoid, Drawn::prism};
  const Solid a = one();
  const uint32_t partner = index / 2 % 3;
  const Solid b = partner == 0 ? one() : draw(random, partner == 1 ? boxes : hulls, k_extent_min, k_extent_max);
  Query query = at_one_place(random, a, b, 1);
  const bool rests = random.chance(0.5), edges = random.chance(0.5);
  if (turning(index)) angular_velocity(random, query, 0.05, 1);
  if (rests) query.path_a.rotation_vector = {};
  const Triple displacement = aim_at_feature(random, query, edges, {}).displacement;
  if (rests)
    query.path_b.displacement = to_float(displacement);
  else
    share_motion(random, query, displacement, 0.5);
  return query;
}

Query game(Random& random, uint32_t index, const Sources& sources) {
  const auto one = [&]() -> const Solid& {
    return sources.game_hulls[random.below(static_cast<uint32_t>(sources.game_hulls.size()))];
  };
  const Solid &a = one(), &b = one();
  return sent(random, index, a, b, {});
}

uint64_t hash_of(const char* text) {
  uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (; *text != 0; ++text) hash = (hash ^ static_cast<uint8_t>(*text)) * 0x100000001b3u;
  return hash;
}

}  // namespace

const std::vector<Set>& all_sets() {
  static const std::vector<Set> sets = {
      {"1", "mixed: 0.05 to 2 m apart, angular velocity 0.05 to 1 rad", true, mixed},
      {"1c", "as 1, with cylinders and cones", true, mixed_all},
      {"1r", "as 1, boxes, hulls, cylinders and cones rounded by a ball", true, mixed_rounded},
      {"2", "paper: 1 to 20 cm at slabs 1 to 20 mm thick, from 1 to 60 m, no angular_velocity", true, paper},
      {"3", "rods 1 to 6 m long, within each other's bounds, all turn by 0.5 to 3 rad", true, rods},
      {"3c", "as 3, the rods cylinders and cones", true, rods_round},
      {"4", "grazing: the closest approach is +-1e-6 to 1e-3 of size", true, grazing},
      {"5", "set 1 at 1 km and 10 km", true, far},
      {"5far", "set 1 at 10,000 km, where floats are 1 m apart", true, farthest},
      {"6", "at 1 mm, at 100 m, and of aspect 1:1000", true, scaled},
      {"7", "starting 1e-6 to 1e-4 m apart: separating, sliding, approaching", true, near},
      {"8", "hulls of 8 to 64 vertices", true, hulls},
      {"9", "as 3, all turn by 3.2 to 12 rad", true, fast_rods},
      {"10", "at rest: parallel boxes, prisms, flat and needle hulls, capsules, gaps 1e-6 to 1", false, degenerate},
      {"10c", "as 10, with cylinders", false, degenerate_round},
      {"11", "triangles, slivers too, at triangles, boxes and hulls: a vertex at a face or an edge at an edge", true,
       triangles},
      {"game", "as 1, pairs of real game hulls", true, game},
  };
  return sets;
}

const Set* find_set(const std::string& name) {
  for (const Set& set : all_sets()) {
    if (name == set.name) return &set;
  }
  return nullptr;
}

Query make_query(const Set& set, uint64_t seed, uint32_t index, const Sources& sources) {
  Random mixer(hash_of(set.name) ^ (seed * 0x9e3779b97f4a7c15u));
  Random random(mixer.next() + index * 0xd1342543de82ef95u);
  return set.make(random, index, sources);
}

std::vector<Query> make_queries(const Set& set, uint64_t seed, uint32_t count, const Sources& sources) {
  std::vector<Query> queries;
  queries.reserve(count);
  for (uint32_t index = 0; index < count; ++index) queries.push_back(make_query(set, seed, index, sources));
  return queries;
}

bool turns(const Query& query) {
  return length(query.path_a.rotation_vector) != 0 || length(query.path_b.rotation_vector) != 0;
}

}  // namespace detent_queries
