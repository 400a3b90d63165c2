#include "ccd/terrain_impact.h"

#include "ccd/moving_shapes.h"
#include "distance/pair.h"
#include "math/root.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_parts_power_max = 8;  ///< a long path is searched in at most 2^k_parts_power_max parts

/// Tests the triangles of a terrain, one by one, against a moving body.
struct TerrainSearch {
  const TerrainOps& code;
  const SweptBody& ground;
  const Terrain terrain;
  const Motion ground_motion;
  const Convex& convex;
  const Motion motion;
  const Fraction time;
  const bool ground_is_a, turns;
  Matrix32 matrix;  ///< rotation of the terrain at `time`
  /// The body's centre and translation relative to the terrain, in the terrain's axes at `time`, 2^-46 m. The terrain's
  /// rotation over the tick is left out.
  Vec64 centre, displacement;
  Matrix32 rotation;  ///< from the body's axes to the terrain's, at `time`
  int64_t radius;     ///< bounding radius of the body, 2^-46 m
  int64_t swing = 0;  ///< bound on the motion of the shape's points by the rotations of both bodies, 2^-46 m
  HullView hull = {};
  uint32_t triangle = k_no_triangle;
  TimeOfImpact first = {};
  bool failed = false;

  /// Height of the body's centre above the triangle's plane at `time`, 2^-46 m.
  int64_t height(const TerrainTriangle& t, const Vec32& normal) const { return dot(from(t), normal).round_shift(30); }
  Vec64 from(const TerrainTriangle& t) const {
    const int64_t step = int64_t{1} << grid_shift(terrain);
    return {centre.x - t.corner[0].x * step, centre.y - t.corner[0].y * step, centre.z - t.corner[0].z * step};
  }

  /// An upper bound, 2^-46 m, of how far the shape extends from the centre of its body along `direction` (terrain's
  /// axes), at any time of the sweep.
  int64_t extent_along(const Vec32& direction) const {
    const Vec32 local = rotate_inverse(rotation, direction);
    const Vec32 farthest = local_support(convex, hull, local, 0).local;
    // The error of a direction is less than 2^-28; that of a support point is less than 2 units of 2^(exponent - 30) m.
    const int64_t units = (dot(farthest, local) >> 30) + 4, core = raw_core_radius(convex);
    const int64_t extent = units * (int64_t{1} << (k_metre_bits - 30 + convex.exponent)) + (core >> 26);
    const int64_t reach = saturated_sum(extent + raw_radius(convex), swing);
    return reach < radius ? reach : radius;
  }

  /// Whether the shape stays on one side of the triangle's plane during its sweep.
  bool passes_by(const TerrainTriangle& t, const Vec32& normal) const {
    const int64_t start = height(t, normal), end = start + dot(displacement, normal).round_shift(30);
    const int64_t extent = extent_along(start > 0 ? negate(normal) : normal);
    // The error of a normal is less than 2^-28.
    const int64_t clear = extent + (radius >> 10) + ((length_bound(from(t)) + length_bound(displacement)) >> 26) + 64;
    return (start > clear && end > clear) || (start < -clear && end < -clear);
  }

  /// Makes a convex shape of the triangle. If the terrain rotates, the shape is placed relative to the terrain's centre
  /// of rotation; otherwise relative to a point near the triangle, which is more precise.
  bool place(uint32_t index, const TerrainTriangle& t, Pose& placed, Convex& made) const {
    placed = ground_motion.start;
    if (!turns) return code.convex(terrain, placed, index, placed, made) == Status::ok;
    const int64_t step = int64_t{1} << grid_shift(terrain);
    Vec64 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = {t.corner[k].x * step, t.corner[k].y * step, t.corner[k].z * step};
    const int64_t bound = bound_of(corner);
    set_triangle(corner, bound, raw_exponent_above(bound + 1), made);
    return true;
  }

  bool from_behind(const TerrainTriangle& t, const Vec32& normal, const TimeOfImpact& found) const {
    const Unit zero = 0.0;
    if (found.normal == Vec3<Unit>{zero, zero, zero}) return height(t, normal) < 0;
    const Fraction when = time + fraction_product(k_whole_step - time, found.time);
    const Vec3<Unit> front = rotate(pose_at(ground, when).rotation, units_from_raw(normal));
    return (dot(front, found.normal) < zero) == ground_is_a;
  }

  void ask(uint32_t index) {
    if (index == triangle) return;  // this triangle has the first impact so far; it needs no second test
    const TerrainTriangle t = terrain.triangle(index);
    const Vec32 normal = normal_of(t.corner[0], t.corner[1], t.corner[2]);
    if (!turns && passes_by(t, normal)) return;
    Pose placed;
    Convex made;
    TimeOfImpact found;
    if (!place(index, t, placed, made)) {
      failed = true;
      return;
    }
    const Motion moved = {placed, ground_motion.displacement, ground_motion.rotation_vector};
    MovingShapes shapes(ground_is_a ? moved : motion, ground_is_a ? motion : moved);
    const Fraction until = triangle == k_no_triangle ? k_whole_step : first.time;
    const bool known =
        ground_is_a ? shapes.find(made, convex, {}, until, found) : shapes.find(convex, made, {}, until, found);
    failed = failed || !known;
    if (!known || found.outcome == ToiOutcome::clear) return;
    if (terrain.one_sided() && from_behind(t, normal, found)) return;
    if (triangle != k_no_triangle && !(found.time < first.time || (found.time == first.time && index < triangle)))
      return;
    triangle = index;
    first = found;
    const Position &near = placed.position, &whole = ground_motion.start.position;
    if (ground_is_a)
      first.point +=
          {real_difference(near.x, whole.x), real_difference(near.y, whole.y), real_difference(near.z, whole.z)};
  }

  /// Visits the triangles in the bounds of the shape's path relative to the terrain, enlarged for the terrain's
  /// rotation.
  void walk() {
    const auto size = [](int64_t along) { return along < 0 ? -along : along; };
    const auto larger = [](int64_t p, int64_t q) { return p < q ? q : p; };
    constexpr Real k_far = 32768.0, k_most = 2.0;
    const auto angle_of = [&](const Vec3<Real>& rotation_vector) { return min(length(rotation_vector), k_most); };
    const Real angle = angle_of(ground_motion.rotation_vector);
    const Real core = real_from_raw(raw_core_radius(convex));
    swing = raw_length((angle + angle_of(motion.rotation_vector)) * core);
    swing += (swing >> 10) + 64;
    hull = hull_of(convex);
    int64_t margin = radius >> 10;
    if (turns) {
      const Real distance = min(real_from_raw(length_bound(centre)), k_far);
      const Real swept = min(length(motion.displacement - ground_motion.displacement), k_far);
      margin = saturated_sum(margin, saturated_sum(raw_length(angle * distance), raw_length(angle * swept)));
    }
    constexpr int64_t k_all = int64_t{1} << 61;  // terrain coordinates are at most half of this
    if (margin >= k_all - radius) {
      visit({-k_all, -k_all, -k_all}, {k_all, k_all, k_all});
      return;
    }
    // A long path is searched part by part, up to the part with the first impact, because a box around the whole path
    // would contain many more triangles.
    const int64_t longest = larger(size(displacement.x), larger(size(displacement.y), size(displacement.z)));
    int power = 0;
    while (!turns && power < k_parts_power_max && longest >> power > 4 * (radius + margin)) ++power;
    const int64_t parts = int64_t{1} << power;
    margin += parts - 1;  // the step is rounded down
    const Vec64 step = {displacement.x >> power, displacement.y >> power, displacement.z >> power};
    // The offsets from the start of a part of the path to the lower and the upper corner of its box.
    const auto below = [&](int64_t along, const Vec32& axis) {
      return (along < 0 ? along : 0) - extent_along(negate(axis)) - margin;
    };
    const auto above = [&](int64_t along, const Vec32& axis) {
      return (along > 0 ? along : 0) + extent_along(axis) + margin;
    };
    constexpr Vec32 k_x = {k_one, 0, 0}, k_y = {0, k_one, 0}, k_z = {0, 0, k_one};
    const Vec64 low = {below(step.x, k_x), below(step.y, k_y), below(step.z, k_z)};
    const Vec64 high = {above(step.x, k_x), above(step.y, k_y), above(step.z, k_z)};
    Vec64 begins = centre;
    for (int64_t part = 0; part < parts; ++part) {
      visit(add(begins, low), add(begins, high));
      if (triangle != k_no_triangle && first.time.raw <= (k_whole_step.raw >> power) * (part + 1)) return;
      begins = add(begins, step);
    }
  }
  void visit(const Vec64& low, const Vec64& high) {
    code.visit(
        terrain, low, high, [](void* search, uint32_t index) { static_cast<TerrainSearch*>(search)->ask(index); },
        this);
  }
};

}  // namespace

bool terrain_impact(const AssetTable& assets, const TerrainOps& code, const SweptBody& a, const SweptBody& b,
                    const Convex& convex, Fraction time, TimeOfImpact& impact) {
  const bool ground_is_a = is_terrain(a.properties);
  const SweptBody &ground = ground_is_a ? a : b, &body = ground_is_a ? b : a;
  if (!is_in(assets, ground.properties.asset)) return false;
  const Motion ground_motion = motion_from(ground, time), motion = motion_from(body, time);
  TerrainPlace place;
  Vec64 displacement;
  if (place_on_terrain(ground_motion.start, motion.start, place) != Status::ok ||
      !raw_from_real(motion.displacement - ground_motion.displacement, displacement))
    return false;
  TerrainSearch search = {code,
                          ground,
                          terrain_of(ground.properties, assets),
                          ground_motion,
                          convex,
                          motion,
                          time,
                          ground_is_a,
                          !(ground_motion.rotation_vector == Vec3<Real>{k_zero, k_zero, k_zero}),
                          place.terrain,
                          place.centre,
                          rotate_back(place.terrain, displacement),
                          place.rotation,
                          raw_length(real_from_unit(body.properties.bounding_radius, body.properties.size_exponent))};
  search.walk();
  if (search.failed) return false;
  impact = search.first;
  if (search.triangle != k_no_triangle) return true;
  impact = {};
  impact.outcome = ToiOutcome::clear;
  impact.time = k_whole_step;
  return true;
}

const TerrainImpactOps k_terrain_impact_ops = {terrain_impact};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
