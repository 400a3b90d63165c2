#include "query/query_terrain.h"

#include <detent/distance.h>

#include "distance/pair.h"
#include "query/query_hits.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The tolerance of the narrow phase is less than 2^-k_tolerance_power of the sizes and distances of a pair.
constexpr int k_tolerance_power = 18;
/// A displacement is searched in up to 2^k_pieces_power pieces. A search distance begins at 2^-k_reaches_power of its
/// final value and is doubled until a hit is found. Therefore triangles far from the hit are not tested.
constexpr int k_pieces_power = 6, k_reaches_power = 8;

/// A search over the triangles around a shape, in the terrain's axes.
struct TriangleSearch {
  const AskedSurface& ground;
  const QueryShape& shape;
  TerrainPlace place = {};
  /// The shape alone in integer coordinates: in the terrain's axes, in 2^-30 of the shape's own unit of length.
  Placed alone = {};
  int64_t ball = 0;           ///< bounding radius of a shape that rotates, else 0; in 2^-46 m, as the next members
  int64_t radius = 0;         ///< radius of the ball that rounds the shape, plus a margin for errors
  Vec64 low = {}, high = {};  ///< bounds of the shape relative to its centre
  QueryHit best = {};
  bool found = false;
  Status status = Status::ok;

  TriangleSearch(const AskedSurface& terrain, const QueryShape& asked, const Pose& at, bool turns)
      : ground(terrain), shape(asked), status(terrain.code.place(terrain.pose, at, place)) {
    if (status != Status::ok) return;
    const GridBox box = terrain.terrain.bounds();
    const auto most = [&](int32_t least, int32_t greatest) { return to_raw(greatest > -least ? greatest : -least); };
    const int64_t size = saturated_sum(most(box.low.x, box.high.x),
                                       saturated_sum(most(box.low.y, box.high.y), most(box.low.z, box.high.z)));
    const int64_t whole = raw_length(real_from_unit(shape.properties.bounding_radius, shape.properties.size_exponent));
    ball = turns ? whole : 0;
    radius = raw_radius(shape.convex) + (whole >> 10) + (size >> k_tolerance_power) + 64;
    alone = detent::place(shape.convex, place.rotation, shape.convex.exponent);
    low = {lowest({k_one, 0, 0}), lowest({0, k_one, 0}), lowest({0, 0, k_one})};
    high = {-lowest({-k_one, 0, 0}), -lowest({0, -k_one, 0}), -lowest({0, 0, -k_one})};
    if (length_bound(place.centre) > int64_t{1} << 62) status = Status::out_of_range;  // so that later sums fit 63 bits
  }

  /// The lowest coordinate of the shape along `axis`, relative to the shape's centre, in units of 2^-46 m. `axis`: a
  /// unit vector in the terrain's axes, Q30.
  int64_t lowest(const Vec32& axis) const {
    if (ball != 0) return -ball - radius;
    return raw_from_block(dot(axis, support(alone, negate(axis)).point) >> 30, shape.convex.exponent) - radius;
  }
  int64_t to_raw(int32_t steps) const { return steps * (int64_t{1} << grid_shift(ground.terrain)); }
  Vec64 from_corner(const Vec32& corner) const {
    return {place.centre.x - to_raw(corner.x), place.centre.y - to_raw(corner.y), place.centre.z - to_raw(corner.z)};
  }
  /// Height of the shape's centre above the triangle's plane, in units of 2^-46 m.
  int64_t height(const TerrainTriangle& t, const Vec32& normal) const {
    return dot(from_corner(t.corner[0]), normal).round_shift(30);
  }
  /// Error bound of a height. The error of a normal is below 2^-28.
  int64_t height_error(const TerrainTriangle& t) const { return (length_bound(from_corner(t.corner[0])) >> 26) + 64; }
  Vec3<Unit> to_world(const Vec32& normal) const {
    return units_from_raw(round_shift(multiply(place.terrain, normal), 30));
  }

  /// Whether a hit does not count, because it is from behind on a one-sided terrain. An undecided hit has no side, so
  /// it counts.
  bool lets_through(const TerrainTriangle& t, const Vec32& normal, const QueryHit& hit) const {
    if (!ground.terrain.one_sided() || hit.undecided) return false;
    if (hit.normal == k_no_direction) return height(t, normal) < 0;
    return dot(to_world(normal), hit.normal) < Unit(0.0);
  }
  void keep(const TerrainTriangle& t, const Vec32& normal, const QueryHit& hit) {
    if (lets_through(t, normal, hit) || (found && !HitOrder{}(hit, best))) return;
    found = true;
    best = hit;
  }
  Status finish(QueryHit& hit, bool& touched) const {
    if (status != Status::ok) return status;
    touched = found;
    hit = best;
    return status;
  }

  template <class Search>
  static void visit(Search& search, const Vec64& low, const Vec64& high) {
    constexpr int64_t k_most = int64_t{1} << 61;  // the coordinates of a terrain are at most half of this
    const auto held = [](int64_t value) { return value > k_most ? k_most : value < -k_most ? -k_most : value; };
    search.ground.code.visit(
        search.ground.terrain, {held(low.x), held(low.y), held(low.z)}, {held(high.x), held(high.y), held(high.z)},
        [](void* context, uint32_t triangle) { ask(*static_cast<Search*>(context), triangle); }, &search);
  }
  /// Tests a triangle for a hit, unless rules_out() shows that it is not needed.
  template <class Search>
  static void ask(Search& search, uint32_t index) {
    const AskedSurface& ground = search.ground;
    const TerrainTriangle t = ground.code.triangle(ground.terrain, index);
    const Vec32 normal = normal_of(t.corner[0], t.corner[1], t.corner[2]);
    if (search.rules_out(t, normal)) return;
    Pose placed;
    Convex convex;
    QueryHit hit;
    hit.triangle = index;
    hit.material = t.material;
    bool touched = true;
    Status asked = ground.code.convex(ground.terrain, ground.pose, index, placed, convex);
    if (asked == Status::ok) asked = search.find(convex, placed, hit, touched);
    if (asked != Status::ok)
      search.status = asked;
    else if (touched)
      search.keep(t, normal, hit);
  }
};

struct CastSearch : TriangleSearch {
  const Motion& motion;
  Vec64 displacement = {0, 0, 0};  ///< of the centre, in the terrain's axes, 2^-46 m

  CastSearch(const AskedSurface& terrain, const QueryShape& asked, const Motion& along)
      : TriangleSearch(terrain, asked, along.start, !(along.rotation_vector == k_zero_vector)), motion(along) {
    Vec64 raw;
    if (status != Status::ok) return;
    if (!raw_from_real(motion.displacement, raw))
      status = Status::out_of_range;
    else
      displacement = rotate_back(place.terrain, raw);
  }

  /// Whether the shape stays on one side of the triangle's plane.
  bool rules_out(const TerrainTriangle& t, const Vec32& normal) const {
    const int64_t start = height(t, normal), end = start + dot(displacement, normal).round_shift(30);
    const int64_t error = height_error(t) + (length_bound(displacement) >> 26);
    const int64_t over = -lowest(normal) + error, under = -lowest(negate(normal)) + error;
    return (start > over && end > over) || (start < -under && end < -under);
  }

  Status find(const Convex& triangle, const Pose& placed, QueryHit& hit, bool& touched) const {
    TimeOfImpact impact;
    const Status asked = time_of_impact(triangle, {placed, k_zero_vector, k_zero_vector}, shape.convex, motion, impact);
    if (asked != Status::ok) return asked;
    touched = impact.outcome != ToiOutcome::clear;
    hit.fraction = impact.time;
    hit.undecided = impact.outcome == ToiOutcome::undecided;
    if (hit.undecided) return asked;
    hit.point = moved(placed.position, impact.point);
    hit.normal = impact.normal;
    return asked;
  }

  /// Searches the displacement piece by piece. Ends as soon as a hit is found that is earlier than the next piece.
  void run() {
    const Vec64 extent = {high.x - low.x, high.y - low.y, high.z - low.z};
    int power = 0;
    while (power < k_pieces_power && magnitudes(displacement) >> (power + 1) > magnitudes(extent)) ++power;
    const Vec64 piece = {displacement.x >> power, displacement.y >> power, displacement.z >> power};
    const int64_t rounding = int64_t{1} << power;
    Vec64 from = place.centre;
    for (int64_t i = 1; i <= int64_t{1} << power; ++i) {
      const auto least = [&](int64_t at, int64_t along) { return at + (along < 0 ? along : 0) - rounding; };
      const auto most = [&](int64_t at, int64_t along) { return at + (along > 0 ? along : 0) + rounding; };
      visit(*this, {least(from.x + low.x, piece.x), least(from.y + low.y, piece.y), least(from.z + low.z, piece.z)},
            {most(from.x + high.x, piece.x), most(from.y + high.y, piece.y), most(from.z + high.z, piece.z)});
      if (found && best.fraction.raw <= i << (Fraction::k_frac - power)) return;
      from = add(from, piece);
    }
  }
};

struct NearSearch : TriangleSearch {
  const Pose& at;
  int64_t distance_max = 0;  ///< current search distance, 2^-46 m

  NearSearch(const AskedSurface& terrain, const QueryShape& asked, const Pose& where)
      : TriangleSearch(terrain, asked, where, false), at(where) {}

  /// Whether the triangle's plane or bounding box is farther from the shape than the nearest hit, or than
  /// `distance_max` if there is no hit yet.
  bool rules_out(const TerrainTriangle& t, const Vec32& normal) const {
    const int64_t nearest = found ? raw_length(best.distance) : distance_max;
    const int64_t room = nearest + (nearest >> k_tolerance_power), error = height_error(t);
    const int64_t over = height(t, normal);
    if (over > room + error - lowest(normal) || -over > room + error - lowest(negate(normal))) return true;
    const auto apart = [&](int32_t Vec32::*axis, int64_t centre, int64_t least, int64_t most) {
      const int32_t a = t.corner[0].*axis, b = t.corner[1].*axis, c = t.corner[2].*axis;
      const int32_t first = a < b ? (a < c ? a : c) : (b < c ? b : c), last = a > b ? (a > c ? a : c) : (b > c ? b : c);
      return to_raw(first) - centre > room + most || centre - to_raw(last) > room - least;
    };
    const Vec64& c = place.centre;
    return apart(&Vec32::x, c.x, low.x, high.x) || apart(&Vec32::y, c.y, low.y, high.y) ||
           apart(&Vec32::z, c.z, low.z, high.z);
  }

  Status find(const Convex& triangle, const Pose& placed, QueryHit& hit, bool&) const {
    Closest closest;
    const Status asked = closest_points(triangle, placed, shape.convex, at, closest);
    if (asked != Status::ok) return asked;
    hit.distance = closest.distance;
    hit.undecided = closest.capped;
    if (hit.undecided) return asked;
    hit.point = moved(placed.position, closest.point_a);
    hit.normal = closest.normal;
    return asked;
  }

  /// Doubles the search distance up to `farthest`, until a hit within the search distance is found.
  void run(int64_t farthest) {
    for (int power = farthest > 0 ? k_reaches_power : 0; power >= 0; --power) {
      distance_max = farthest >> power;
      const int64_t room = distance_max + (distance_max >> k_tolerance_power);
      const Vec64& c = place.centre;
      visit(*this, {c.x + low.x - room, c.y + low.y - room, c.z + low.z - room},
            {c.x + high.x + room, c.y + high.y + room, c.z + high.z + room});
      if (found && raw_length(best.distance) <= distance_max) return;
    }
  }
};

bool is_point(const QueryShape& shape) { return shape.convex.type == ShapeType::sphere && shape.convex.radius == 0; }

Status ray_on_terrain(const AskedSurface& ground, const Motion& motion, QueryHit& hit, bool& touched) {
  const Position &from = motion.start.position, &to = ground.pose.position;
  const Vec3<Real> origin = {real_difference(from.x, to.x), real_difference(from.y, to.y),
                             real_difference(from.z, to.z)};
  TerrainHit found;
  const Status status = ground.code.cast_ray(ground.terrain, ground.pose, origin, motion.displacement, found);
  if (status != Status::ok) return status;
  touched = found.hit;
  hit.fraction = found.time;
  hit.point = moved(from, motion.displacement * real_from_fraction(found.time));
  hit.normal = found.normal;
  hit.triangle = found.triangle;
  hit.material = found.material;
  return Status::ok;
}

}  // namespace

Status cast_on_terrain(const AskedSurface& ground, const QueryShape& shape, const Motion& motion, QueryHit& hit,
                       bool& touched) {
  if (is_point(shape)) return ray_on_terrain(ground, motion, hit, touched);
  CastSearch search(ground, shape, motion);
  if (search.status == Status::ok) search.run();
  return search.finish(hit, touched);
}

Status near_on_terrain(const AskedSurface& ground, const QueryShape& shape, const Pose& at, Real distance_max,
                       QueryHit& hit, bool& touched) {
  NearSearch search(ground, shape, at);
  if (search.status == Status::ok) search.run(raw_length(distance_max));
  return search.finish(hit, touched);
}

Status side_of_triangle(const AskedSurface& ground, uint32_t triangle, const Pose& at, Vec3<Unit>& normal,
                        Real& height) {
  const TriangleSearch search(ground, query_point(), at, false);
  if (search.status != Status::ok) return search.status;
  const TerrainTriangle t = ground.code.triangle(ground.terrain, triangle);
  const Vec32 front = normal_of(t.corner[0], t.corner[1], t.corner[2]);
  const int64_t over = search.height(t, front);
  const bool behind = over < 0 && !ground.terrain.one_sided();
  normal = search.to_world(behind ? negate(front) : front);
  height = real_from_raw(behind ? -over : over);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
