#include "contact/terrain_query.h"

#include "base/cycle.h"
#include "math/arithmetic.h"
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int32_t k_slack = 4;  ///< grid steps; rounding the ends of a segment moves its points by less than this

/// Shortens [from, to] to the times at which the segment is in the box, grown by k_slack grid steps. Returns false if
/// there are none. `box` is in grid steps, `origin` and `displacement` are in 2^-46 m.
bool clip(const GridBox& box, int shift, const Vec64& origin, const Vec64& displacement, int64_t& from, int64_t& to) {
  const auto axis = [&](int32_t low, int32_t high, int64_t start, int64_t along) {
    const int64_t first = (int64_t{low} - k_slack) * (int64_t{1} << shift) - start;
    const int64_t last = (int64_t{high} + k_slack) * (int64_t{1} << shift) - start;
    if (along == 0) return first <= 0 && last >= 0;
    const auto time_at = [along](int64_t distance) {
      const int64_t time = divide_rounded(Int128::product(distance, k_time_end), along);
      return time < 0 ? 0 : time > k_time_end ? k_time_end : time;
    };
    if ((along > 0 ? last : first) * (along > 0 ? 1 : -1) < 0) return false;
    const int64_t enters = time_at(along > 0 ? first : last), leaves = time_at(along > 0 ? last : first);
    from = enters > from ? enters : from;
    to = leaves < to ? leaves : to;
    return from <= to;
  };
  return axis(box.low.x, box.high.x, origin.x, displacement.x) &&
         axis(box.low.y, box.high.y, origin.y, displacement.y) && axis(box.low.z, box.high.z, origin.z, displacement.z);
}

/// A segment whose ends are rounded to the grid.
struct GridSegment {
  Vec32 from, to;

  /// Whether the segment touches the box, grown by k_slack. Exact. Source: the separating axes of Gottschalk, Lin,
  /// Manocha, "OBBTree", 1996.
  bool meets(const GridBox& box) const {
    const auto twice_apart = [](int32_t p, int32_t q, int32_t low, int32_t high) {
      return int64_t{p} + q - low - high;
    };
    const Vec64 m = {twice_apart(from.x, to.x, box.low.x, box.high.x), twice_apart(from.y, to.y, box.low.y, box.high.y),
                     twice_apart(from.z, to.z, box.low.z, box.high.z)};
    const auto size = [](int32_t low, int32_t high) { return int64_t{high} - low + 2 * k_slack; };
    const Vec64 h = {size(box.low.x, box.high.x), size(box.low.y, box.high.y), size(box.low.z, box.high.z)};
    const Vec32 d = subtract(to, from);
    const auto beyond = [](int64_t apart, int64_t half, int32_t along) {
      return static_cast<int64_t>(magnitude_64(apart)) > half + int64_t{magnitude_32(along)};
    };
    if (beyond(m.x, h.x, d.x) || beyond(m.y, h.y, d.y) || beyond(m.z, h.z, d.z)) return false;
    const auto apart = [](int64_t m_u, int64_t m_v, int32_t d_u, int32_t d_v, int64_t h_u, int64_t h_v) {
      const Int128 across = Int128::product_narrow(m_u, d_v) - Int128::product_narrow(m_v, d_u);
      const Int128 margin = Int128::product(h_u, magnitude_32(d_v)) + Int128::product(h_v, magnitude_32(d_u));
      return margin < across || margin < -across;
    };
    return !apart(m.x, m.y, d.x, d.y, h.x, h.y) && !apart(m.y, m.z, d.y, d.z, h.y, h.z) &&
           !apart(m.z, m.x, d.z, d.x, h.z, h.x);
  }
};

/// Returns part / whole as a time: k_time_end stands for 1. Range: 0 <= part <= whole, whole > 0.
int64_t quotient(Int128 part, Int128 whole) {
  const int excess = bit_length_128(magnitude_128(whole)) - 62;
  const auto head = [excess](Int128 value) { return excess > 0 ? value.round_shift(excess) : value.low_signed(); };
  const int64_t time = divide_rounded(Int128::product(head(part), k_time_end), head(whole));
  return time > k_time_end ? k_time_end : time;
}

/// Whether the segment hits the triangle. If so, sets `time` to the time of the hit, and `from_behind` to whether the
/// segment comes from the triangle's back.
bool meets_triangle(const GridSegment& segment, const TerrainTriangle& triangle, int64_t& time, bool& from_behind) {
  const Vec32 displacement = subtract(segment.to, segment.from);
  const Vec64 area = area_vector(triangle.corner[0], triangle.corner[1], triangle.corner[2]);
  Int128 whole = dot(area, displacement);
  Int128 part = dot(area, subtract(triangle.corner[0], segment.from));
  if (sign_of(whole) == 0) return false;
  from_behind = sign_of(whole) > 0;
  if (!from_behind) {
    whole = -whole;
    part = -part;
  }
  if (sign_of(part) < 0 || whole < part) return false;
  // For each edge of the triangle, the sign of a triple product shows on which side of the edge the segment passes. The
  // triangle beyond the edge computes the same product with the opposite sign. So no segment passes between the two
  // triangles.
  int left = 0, right = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec32 a = subtract(triangle.corner[k], segment.from),
                b = subtract(triangle.corner[next_of_three(k)], segment.from);
    const int sign = sign_of(dot(cross(a, b), displacement));
    left += sign > 0 ? 1 : 0;
    right += sign < 0 ? 1 : 0;
  }
  if (left > 0 && right > 0) return false;
  time = quotient(part, whole);
  return true;
}

}  // namespace

Status cast_ray_on_terrain(const Terrain& terrain, const Pose& pose, const Vec3<Real>& origin,
                           const Vec3<Real>& displacement, TerrainHit& hit) {
  Quat32 rotation;
  if (!raw_from_quat(pose.rotation, rotation)) return Status::not_normalised;
  Vec64 start, along;
  if (!raw_from_real(origin, start) || !raw_from_real(displacement, along)) return Status::out_of_range;
  if (magnitudes(start) >> 61 != 0 || magnitudes(along) >> 61 != 0) return Status::out_of_range;
  const Matrix32 matrix = matrix_from(rotation);
  start = rotate_back(matrix, start);
  along = rotate_back(matrix, along);
  TerrainHit found;
  found.time = Fraction::from_raw(k_time_end);
  const int shift = grid_shift(terrain);
  int64_t from = 0, to = k_time_end;
  if (!clip(terrain.bounds(), shift, start, along, from, to)) {
    hit = found;
    return Status::ok;
  }
  const auto point_at = [&](int64_t time) {
    const auto component = [&](int64_t a, int64_t d) {
      const int64_t steps = round_shift_64(a + over_time(d, time), shift);
      constexpr int64_t k_most = k_terrain_coordinate_max;
      return static_cast<int32_t>(steps > k_most ? k_most : steps < -k_most ? -k_most : steps);
    };
    return Vec32{component(start.x, along.x), component(start.y, along.y), component(start.z, along.z)};
  };
  const GridSegment whole = {point_at(from), point_at(to)};
  GridSegment rest = whole;
  const bool one_sided = terrain.one_sided();
  int64_t best = k_time_end;
  terrain.walk([&](const GridBox& box) { return rest.meets(box); },
               [&](uint32_t index) {
                 const TerrainTriangle triangle = terrain.triangle(index);
                 int64_t time = 0;
                 bool behind = false;
                 if (!meets_triangle(whole, triangle, time, behind) || (behind && one_sided)) return;
                 if (found.hit && (time > best || (time == best && index > found.triangle))) return;
                 best = time;
                 found.hit = true;
                 found.triangle = index;
                 found.material = triangle.material;
                 const Vec32 n = normal_of(triangle.corner[0], triangle.corner[1], triangle.corner[2]);
                 found.normal = units_from_raw(round_shift(multiply(matrix, behind ? negate(n) : n), 30));
                 const Vec32 d = subtract(whole.to, whole.from);
                 rest.to = add(whole.from, Vec32{static_cast<int32_t>(over_time(d.x, time)),
                                                 static_cast<int32_t>(over_time(d.y, time)),
                                                 static_cast<int32_t>(over_time(d.z, time))});
               });
  if (found.hit) found.time = Fraction::from_raw(from + over_time(to - from, best));
  hit = found;
  return Status::ok;
}

void visit_terrain(const Terrain& terrain, const Vec64& low, const Vec64& high,
                   void (*visit)(void* context, uint32_t triangle), void* context) {
  const GridBox swept = grid_box(terrain, low, high);
  terrain.walk([&](const GridBox& box) { return meet(box, swept); },
               [&](uint32_t triangle) { visit(context, triangle); });
}

Status terrain_convex(const Terrain& terrain, const Pose& pose, uint32_t triangle, Pose& placed, Convex& convex) {
  Quat32 rotation;
  if (!raw_from_quat(pose.rotation, rotation)) return Status::not_normalised;
  const Matrix32 matrix = matrix_from(rotation);
  const TerrainTriangle t = terrain.triangle(triangle);
  const int64_t step = int64_t{1} << grid_shift(terrain);
  Vec64 corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = {t.corner[k].x * step, t.corner[k].y * step, t.corner[k].z * step};
  const Vec64 displacement = rotate(matrix, corner[0]);
  Pose near = pose;
  bool saturated = false;
  near.position.x = coord_advance(near.position.x, real_from_raw(displacement.x), saturated);
  near.position.y = coord_advance(near.position.y, real_from_raw(displacement.y), saturated);
  near.position.z = coord_advance(near.position.z, real_from_raw(displacement.z), saturated);
  Vec64 moved;
  if (saturated || !raw_difference(near.position, pose.position, moved)) return Status::out_of_range;
  // Makes the corners relative to the rounded position, so that the rounding does not move the triangle.
  const Vec64 origin = rotate_back(matrix, moved);
  for (Vec64& at : corner) at = {at.x - origin.x, at.y - origin.y, at.z - origin.z};
  const int64_t bound = bound_of(corner);
  set_triangle(corner, bound, raw_exponent_above(bound + 1), convex);
  placed = near;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
