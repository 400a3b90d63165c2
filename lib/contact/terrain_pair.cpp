#include "contact/terrain_pair.h"

#include "base/cycle.h"
#include "contact/contact_seam.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_shallow_power = 3;  ///< a contact less deep than 2^-3 of the half thickness is shallow
constexpr int k_lowest_power = 10;  ///< points up to 2^-10 of the half thickness above the lowest point count as lowest
constexpr int k_allowed_power = 7;  ///< an allowed normal may tilt by 2^-7 rad into the neighbouring triangles
constexpr int k_level_power = 6;    ///< an edge at less than 2^-6 rad to the contact plane touches along its length
constexpr int k_mild_power = 3;     ///< an edge is mild if the normals of its faces are at most 2^-3 rad apart
constexpr uint32_t k_fan_max = 64;  ///< at most this many triangles around a corner are tested in each direction

constexpr uint64_t longest(const Vec32& v) {
  uint64_t most = magnitude_32(v.x);
  most = magnitude_32(v.y) > most ? magnitude_32(v.y) : most;
  return magnitude_32(v.z) > most ? magnitude_32(v.z) : most;
}

/// Whether a point lies below a plane with normal `normal`, or above it by an angle of at most 2^-k_allowed_power rad.
/// `direction`: from a point of the plane to the tested point.
bool is_below(const Vec32& normal, const Vec32& direction) {
  return dot(normal, direction) <= static_cast<int64_t>(longest(direction) << (30 - k_allowed_power));
}

/// Returns an 18-bit hash of the corner's position.
uint32_t corner_name(const Vec32& corner) {
  const uint32_t x = static_cast<uint32_t>(corner.x), y = static_cast<uint32_t>(corner.y),
                 z = static_cast<uint32_t>(corner.z);
  uint32_t name = (x * 0x9e3779b1u) ^ (y * 0x85ebca77u + (x >> 7)) ^ (z * 0xc2b2ae3du + (y >> 9));
  name = (name ^ name >> 15) * 0x2c1b3c6du;
  return name >> 14;
}

EdgeKind seen_from_behind(EdgeKind kind) {
  return kind == EdgeKind::convex ? EdgeKind::concave : kind == EdgeKind::concave ? EdgeKind::convex : kind;
}

bool allows_other_normals(EdgeKind kind) { return kind == EdgeKind::convex || kind == EdgeKind::open; }

}  // namespace

/// A triangle, seen from the side on which the shape is.
struct TerrainPair::Side {
  TerrainTriangle triangle;
  Vec32 normal;    ///< towards the shape
  int64_t height;  ///< height of the shape's lowest point above the triangle's plane, 2^-46 m
  uint32_t index;
  bool behind;  ///< the shape is on the back of the triangle, whose corners are therefore in reverse order

  bool has_free_edge() const {
    return allows_other_normals(triangle.kind[0]) || allows_other_normals(triangle.kind[1]) ||
           allows_other_normals(triangle.kind[2]);
  }
};

Status place_on_terrain(const Pose& terrain, const Pose& shape, TerrainPlace& place) {
  Quat32 q, p;
  if (!raw_from_quat(terrain.rotation, q) || !raw_from_quat(shape.rotation, p)) return Status::not_normalised;
  Vec64 direction;
  if (!raw_difference(shape.position, terrain.position, direction) || magnitudes(direction) >> 62 != 0)
    return Status::out_of_range;
  place.terrain = matrix_from(q);
  place.rotation = matrix_from(normalise(multiply(Quat32{-q.x, -q.y, -q.z, q.w}, p)));
  place.centre = rotate_back(place.terrain, direction);
  place.middle = {0, 0, 0};
  return Status::ok;
}

Vec64 rotate(const Matrix32& m, const Vec64& v) {
  const Vec32* c = m.column;
  const auto row = [&](int32_t x, int32_t y, int32_t z) { return dot(v, Vec32{x, y, z}).round_shift(30); };
  return {row(c[0].x, c[1].x, c[2].x), row(c[0].y, c[1].y, c[2].y), row(c[0].z, c[1].z, c[2].z)};
}

Vec64 rotate_back(const Matrix32& m, const Vec64& v) {
  return {dot(v, m.column[0]).round_shift(30), dot(v, m.column[1]).round_shift(30),
          dot(v, m.column[2]).round_shift(30)};
}

int64_t bound_of(const Vec64 (&corner)[3]) {
  int64_t bound = 0;
  for (const Vec64& at : corner) bound = length_bound(at) > bound ? length_bound(at) : bound;
  return bound;
}

void set_triangle(const Vec64 (&corner)[3], int64_t bound, int exponent, Convex& convex) {
  const int n = exponent + k_metre_bits - 30;
  convex = {};
  convex.type = ShapeType::triangle;
  convex.exponent = exponent;
  convex.core_radius = static_cast<int32_t>(bound >> n) + 1;
  for (int k = 0; k < 3; ++k) {
    const Vec32 at = round_shift(corner[k], n);
    convex.corner[k][0] = at.x;
    convex.corner[k][1] = at.y;
    convex.corner[k][2] = at.z;
  }
}

GridBox grid_box(const Terrain& terrain, const Vec64& low, const Vec64& high) {
  const int shift = grid_shift(terrain);
  const auto at = [shift](int64_t raw, int64_t more) {
    const int64_t steps = (raw >> shift) + more;
    return static_cast<int32_t>(steps > INT32_MAX ? INT32_MAX : steps < -INT32_MAX ? -INT32_MAX : steps);
  };
  return {{at(low.x, -1), at(low.y, -1), at(low.z, -1)}, {at(high.x, 2), at(high.y, 2), at(high.z, 2)}};
}

TerrainPair::TerrainPair(const Terrain& terrain, const TerrainPlace& place, const Convex& shape,
                         const ContactRules& rules)
    : terrain_(terrain),
      rotation_(place.rotation),
      shape_(shape),
      centre_(place.centre),
      middle_(place.middle),
      rules_(rules),
      margin_(rules.margin),
      radius_(raw_radius(shape)),
      alone_(detent::place(shape, place.rotation, shape.exponent)) {
  thickness_ = saturated_sum(raw_from_block(detent::half_thickness(alone_), shape.exponent), radius_);
  const int64_t more = saturated_sum(saturated_sum(margin_, radius_), raw_from_block(4, shape.exponent));
  const auto end = [&](const Vec32& axis, int32_t Vec32::*component) {
    return raw_from_block(support(alone_, axis).point.*component, shape.exponent);
  };
  const Vec64& c = centre_;
  const Vec64 low = {c.x + end({-k_one, 0, 0}, &Vec32::x) - more, c.y + end({0, -k_one, 0}, &Vec32::y) - more,
                     c.z + end({0, 0, -k_one}, &Vec32::z) - more};
  const Vec64 high = {c.x + end({k_one, 0, 0}, &Vec32::x) + more, c.y + end({0, k_one, 0}, &Vec32::y) + more,
                      c.z + end({0, 0, k_one}, &Vec32::z) + more};
  box_ = grid_box(terrain, low, high);
}

/// Converts a point from grid steps to a displacement from the shape's centre, 2^-46 m.
Vec64 TerrainPair::from_centre(const Vec32& point) const {
  const int64_t step = int64_t{1} << grid_shift(terrain_);
  return {point.x * step - centre_.x, point.y * step - centre_.y, point.z * step - centre_.z};
}

/// Returns the height, 2^-46 m, of the shape's lowest point above the plane with normal `normal` through `corner`.
int64_t TerrainPair::height(const Vec32& normal, const Vec32& corner) const {
  const int64_t lowest = dot(normal, support(alone_, negate(normal)).point) >> 30;
  return raw_from_block(lowest, shape_.exponent) - radius_ - dot(from_centre(corner), normal).round_shift(30);
}

/// Whether a point lies behind the plane with normal `normal` through `corner`. `point` is relative to the shape's
/// centre.
bool TerrainPair::is_behind(const Vec64& point, const Vec32& normal, const Vec32& corner) const {
  return sign_of(dot(add(from_centre(corner), negate(point)), normal)) > 0;
}

/// Returns a point inside the shape, relative to its centre. A capsule, box or cylinder may be long or flat. For such a
/// shape, the point is near the triangle's middle, within the shape shrunk by its half thickness. For other shapes, it
/// is the shape's middle.
Vec64 TerrainPair::nearest_inside(const TerrainTriangle& t) const {
  const auto beyond_thickness = [&](int k) {
    const int64_t extent = saturated_sum(raw_from_block(shape_.size[k], shape_.exponent), radius_);
    return extent > thickness_ ? extent - thickness_ : 0;
  };
  Vec64 inner = {0, 0, 0};
  if (shape_.type == ShapeType::capsule) inner.y = raw_from_block(shape_.size[1], shape_.exponent);
  if (shape_.type == ShapeType::box) inner = {beyond_thickness(0), beyond_thickness(1), beyond_thickness(2)};
  if (shape_.type == ShapeType::cylinder)
    inner = {beyond_thickness(0) / 2, beyond_thickness(1), beyond_thickness(0) / 2};
  const Vec64 a = from_centre(t.corner[0]), b = from_centre(t.corner[1]), c = from_centre(t.corner[2]);
  const auto mean = [](int64_t p, int64_t q, int64_t r) { return p / 3 + q / 3 + r / 3; };
  const Vec64 to = rotate_back(rotation_, Vec64{mean(a.x, b.x, c.x), mean(a.y, b.y, c.y), mean(a.z, b.z, c.z)});
  const auto held = [](int64_t value, int64_t limit) {
    return value > limit ? limit : value < -limit ? -limit : value;
  };
  return add(middle_, rotate(rotation_, Vec64{held(to.x, inner.x), held(to.y, inner.y), held(to.z, inner.z)}));
}

/// Whether the shape's middle lies beyond a convex edge of the triangle and in front of the neighbouring face. The
/// shape is then on the front side although its middle is behind the triangle's plane, as with a rod that extends over
/// a ridge. If the middle is beyond several edges, the edge that it is farthest beyond decides.
bool TerrainPair::is_before_neighbour(const TerrainTriangle& t, const Vec32& normal) const {
  int64_t most = 0;
  uint32_t farthest = 3;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec32 along = unit_vector_raw(scaled_to_30_bits(subtract(t.corner[next_of_three(k)], t.corner[k])));
    const Vec32 out = unit_vector_raw(scaled_to_30_bits(cross(along, normal)));
    const int64_t beyond = dot(add(middle_, negate(from_centre(t.corner[k]))), out).round_shift(30);
    if (beyond <= most) continue;
    most = beyond;
    farthest = k;
  }
  if (farthest == 3 || t.kind[farthest] != EdgeKind::convex) return false;
  const TerrainTriangle next = terrain_.triangle(t.neighbour[farthest]);
  return !is_behind(middle_, normal_of(next.corner[0], next.corner[1], next.corner[2]), next.corner[0]);
}

TerrainPair::Side TerrainPair::side_of(uint32_t index) const {
  Side side;
  side.index = index;
  TerrainTriangle& t = side.triangle;
  t = terrain_.triangle(index);
  side.normal = normal_of(t.corner[0], t.corner[1], t.corner[2]);
  side.behind = is_behind(middle_, side.normal, t.corner[0]) && !is_before_neighbour(t, side.normal) &&
                is_behind(nearest_inside(t), side.normal, t.corner[0]);
  if (side.behind) {
    side.normal = negate(side.normal);
    const TerrainTriangle front = t;
    t.corner[1] = front.corner[2];
    t.corner[2] = front.corner[1];
    for (int k = 0; k < 3; ++k) {
      t.kind[k] = seen_from_behind(front.kind[2 - k]);
      t.neighbour[k] = front.neighbour[2 - k];
    }
  }
  side.height = height(side.normal, t.corner[0]);
  return side;
}

/// Sets `convex` to the triangle, and `pair` to the pair of the triangle (A) and the shape (B), both with the shape's
/// centre as their origin. Returns false if the triangle is too far away to be touched.
bool TerrainPair::make_pair(const Side& side, Convex& convex, RestingPair& pair) const {
  Vec64 corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = from_centre(side.triangle.corner[k]);
  const int64_t bound = bound_of(corner);
  const int64_t margin = saturated_sum(bound, raw_core_radius(shape_) + 64);
  if (margin >> 62 != 0) return false;
  pair.exponent = raw_exponent_above(margin);
  set_triangle(corner, bound, pair.exponent, convex);
  pair.offset = {0, 0, 0};
  pair.offset_metres = {0, 0, 0};
  pair.a = place(convex, Matrix32{{{k_one, 0, 0}, {0, k_one, 0}, {0, 0, k_one}}}, pair.exponent);
  pair.b = place(shape_, rotation_, pair.exponent);
  pair.radius_a = 0;
  pair.radius_b = radius_;
  return true;
}

/// Returns the normal of the neighbouring triangle beyond a convex edge. It points to the side on which the shape is.
Vec32 TerrainPair::normal_beyond(const Side& side, uint32_t edge) const {
  const TerrainTriangle beyond = terrain_.triangle(side.triangle.neighbour[edge]);
  const Vec32 normal = normal_of(beyond.corner[0], beyond.corner[1], beyond.corner[2]);
  return side.behind ? negate(normal) : normal;
}

/// Whether the triangle has a sharp edge: an open edge, or a convex edge whose two face normals are more than
/// 2^-k_mild_power rad apart.
bool TerrainPair::has_sharp_edge(const Side& side) const {
  constexpr int64_t k_mild_cosine = (int64_t{1} << 60) - (int64_t{1} << (59 - 2 * k_mild_power));
  for (uint32_t k = 0; k < 3; ++k) {
    const EdgeKind kind = side.triangle.kind[k];
    if (kind == EdgeKind::open) return true;
    if (kind == EdgeKind::convex && dot(side.normal, normal_beyond(side, k)) < k_mild_cosine) return true;
  }
  return false;
}

/// Whether the shape overlaps less along a direction across a convex or open edge than along the triangle's normal. At
/// a convex edge, this direction is the normal of the neighbour; at an open edge, it points outward in the plane of the
/// triangle. `deepest`: the least separation along the triangle's normal, 2^-46 m.
bool TerrainPair::has_nearer_exit(const Side& side, int64_t deepest) const {
  for (uint32_t k = 0; k < 3; ++k) {
    const TerrainTriangle& t = side.triangle;
    const Vec32 &a = t.corner[k], &b = t.corner[next_of_three(k)];
    if (!allows_other_normals(t.kind[k])) continue;
    Vec32 other;
    if (t.kind[k] == EdgeKind::open) {
      const Vec32 along = unit_vector_raw(scaled_to_30_bits(subtract(b, a)));
      other = unit_vector_raw(scaled_to_30_bits(cross(along, side.normal)));
    } else {
      other = normal_beyond(side, k);
    }
    if (height(other, a) > deepest) return true;
  }
  return false;
}

/// Whether no triangle around a corner rises above the plane with normal `normal` through that corner.
bool TerrainPair::allows_at_corner(uint32_t triangle, const Vec32& corner, const Vec32& normal) const {
  for (int direction = 0; direction < 2; ++direction) {
    uint32_t at = triangle;
    for (uint32_t n = 0; n < k_fan_max; ++n) {
      const TerrainTriangle t = terrain_.triangle(at);
      uint32_t k = 0;
      while (k < 2 && !(t.corner[k] == corner)) ++k;
      for (uint32_t other = 1; other < 3; ++other) {
        if (!is_below(normal, subtract(t.corner[(k + other) % 3], corner))) return false;
      }
      at = t.neighbour[direction == 0 ? k : previous_of_three(k)];
      if (at == triangle) return true;
      if (at == k_no_triangle) break;
    }
  }
  return true;
}

bool TerrainPair::allows(const Side& side, const Vec32& normal) const {
  const Vec32* corner = side.triangle.corner;
  uint32_t top = 0;
  for (uint32_t k = 1; k < 3; ++k) top = dot(normal, subtract(corner[k], corner[top])) > 0 ? k : top;
  bool level[3];
  uint32_t count = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec32 direction = subtract(corner[k], corner[top]);
    level[k] = -dot(normal, direction) <= static_cast<int64_t>(longest(direction) << (30 - k_level_power));
    count += level[k] ? 1u : 0u;
  }
  if (count == 3) return dot(normal, side.normal) > 0;
  for (uint32_t k = 0; k < 3 && count == 2; ++k) {
    if (!level[k] || !level[next_of_three(k)]) continue;
    if (side.triangle.kind[k] != EdgeKind::convex) return side.triangle.kind[k] == EdgeKind::open;
    const TerrainTriangle beyond = terrain_.triangle(side.triangle.neighbour[k]);
    for (const Vec32& at : beyond.corner) {
      if (!is_below(normal, subtract(at, corner[k]))) return false;
    }
    return true;
  }
  return allows_at_corner(side.index, corner[top], normal);
}

/// Returns a vector in the triangle's plane that is perpendicular to side k and points outward. Its length is between
/// 2^29 and 2^31.
Vec32 TerrainPair::outward(const Side& side, uint32_t k) {
  const Vec32 &a = side.triangle.corner[k], &b = side.triangle.corner[next_of_three(k)];
  return scaled_to_30_bits(cross(scaled_to_30_bits(subtract(b, a)), side.normal));
}

/// Returns a lower bound of the distance, 2^-46 m, by which `point` of the shape's core lies beyond side k. `out`:
/// outward() of this side. Within rounding, the bound is at least a quarter of the distance; it is at most 0 if the
/// point is not beyond the side.
int64_t TerrainPair::beyond(const Side& side, uint32_t k, const Vec32& out, const Vec32& point) const {
  return raw_from_block(dot(out, point) >> 31, shape_.exponent) -
         dot(from_centre(side.triangle.corner[k]), out).round_shift(31);
}

/// Whether beyond() shows that the whole core lies beyond one side of the triangle by more than `clear`, 2^-46 m.
bool TerrainPair::is_beside(const Side& side, int64_t clear) const {
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec32 out = outward(side, k);
    if (beyond(side, k, out, support(alone_, negate(out)).point) > clear) return true;
  }
  return false;
}

/// Whether beyond() shows that the lowest point of the core lies beyond a side of the triangle by more than `clear`,
/// 2^-46 m. The lowest feature may be an edge, or a line of a round side, that is level with the triangle; then its
/// middle is the point that is tested.
__attribute__((noinline)) bool TerrainPair::is_lowest_beside(const Side& side, int64_t clear) const {
  constexpr int64_t k_lying = k_one >> 12;
  Feature lowest;
  supporting_edge(alone_, negate(side.normal), k_lying, lowest);
  const Vec32 &p = lowest.point[0], &q = lowest.point[lowest.count - 1];
  const Vec32 middle = {(p.x >> 1) + (q.x >> 1), (p.y >> 1) + (q.y >> 1), (p.z >> 1) + (q.z >> 1)};
  for (uint32_t k = 0; k < 3; ++k) {
    if (beyond(side, k, outward(side, k), middle) > clear) return true;
  }
  return false;
}

/// Whether a contact found at an edge of the triangle is a contact at a seam (contact_seam.h). A contact whose normal
/// is within 2^-2 rad of the triangle's normal is at a seam if a round shape touches an edge that is level with the
/// triangle. Any other contact is at a seam if it is a sliver (is_sliver()). The result is false without
/// ContactRules::smooth_seams, and if no edge of the triangle is convex or open. `facing`: the dot product of the
/// contact normal and the triangle's normal, Q60. `deepest`: the least separation of the contact, 2^-46 m.
bool TerrainPair::is_at_seam(const Side& side, int64_t facing, int64_t deepest) const {
  if (!rules_.smooth_seams || !side.has_free_edge()) return false;
  const auto within = [&](int64_t room) { return side.height >= -room && side.height <= room && deepest >= -room; };
  if (facing >= k_alike) return is_round(shape_, radius_) && deepest <= rules_.sunk && within(rules_.sunk);
  if (!within(sliver_room(thickness_, rules_.sunk))) return false;
  Feature face;
  return supporting_face(alone_, negate(side.normal), core_half_thickness(alone_), face) &&
         dot(face.normal, side.normal) < -k_level_faces;
}

/// Replaces the normal of a manifold. Moves each contact point to the line along the new normal through the core's
/// point that belongs to it. A contact point beside this line would exert a torque on a ball.
void TerrainPair::turn_to(const Vec32& normal, BlockManifold& manifold) const {
  for (uint32_t i = 0; i < manifold.count; ++i) {
    BlockPoint& point = manifold.point[i];
    const int64_t direction = radius_ + point.separation / 2;
    const auto part = [direction](int32_t before, int32_t after) {
      return Int128::product_narrow(direction, static_cast<int32_t>(int64_t{before} - after)).round_shift(30);
    };
    const Vec32& before = manifold.normal;
    point.from_b =
        add(point.from_b, Vec64{part(before.x, normal.x), part(before.y, normal.y), part(before.z, normal.z)});
  }
  manifold.normal = normal;
  manifold.turns = false;
}

Vec32 axis_across(const Vec32& normal) {
  const uint32_t x = magnitude_32(normal.x), y = magnitude_32(normal.y), z = magnitude_32(normal.z);
  const Vec32 least = x <= y && x <= z ? Vec32{k_one, 0, 0} : z <= y ? Vec32{0, 0, k_one} : Vec32{0, k_one, 0};
  return unit_vector_raw(scaled_to_30_bits(cross(least, normal)));
}

bool TerrainPair::touch(uint32_t index, TerrainTouch& touch) const {
  touch.seam = false;
  const Side side = side_of(index);
  const bool one_sided = terrain_.one_sided();
  if ((side.behind && one_sided) || side.height > margin_) return false;
  const bool free = side.has_free_edge();
  const int64_t size = saturated_sum(raw_core_radius(shape_), radius_);
  if (is_beside(side, saturated_sum(size >> k_level_power, free ? saturated_sum(radius_, margin_) : 0))) return false;
  Convex convex;
  RestingPair pair;
  if (!make_pair(side, convex, pair)) return false;

  touch.triangle = index;
  touch.part = 0;
  touch.material = side.triangle.material;
  touch.on_face = true;
  touch.doubtful = false;
  for (uint32_t k = 0; k < 3; ++k) touch.corner_name[k] = corner_name(side.triangle.corner[k]);
  Feature face;
  for (uint32_t k = 0; k < 3; ++k) face.add({convex.corner[k][0], convex.corner[k][1], convex.corner[k][2]}, k);
  face.normal = side.normal;
  face.along = axis_across(side.normal);
  contact_points_over_face(pair, face, margin_, ManifoldReduction::projected_extremes, touch.manifold);
  touch.deepest = least_separation(touch.manifold);
  const bool over = touch.manifold.count > 0, shallow = touch.deepest > -(thickness_ >> k_shallow_power);
  const bool sharp = free && has_sharp_edge(side);
  if (!sharp && over && shallow) return true;
  // The limit `clear` is larger for a triangle with a convex or open edge. On a mild ridge, the shape's lowest point
  // along the normal of either triangle lies beyond the common edge. So with the smaller limit both triangles would
  // discard the contact.
  if (!sharp && !over && is_lowest_beside(side, size >> (free ? k_mild_power : k_level_power))) return false;
  if (over && touch.deepest >= 0 && touch.deepest <= side.height + (thickness_ >> k_lowest_power)) return true;
  if (over && shallow && touch.deepest <= side.height + (thickness_ >> k_lowest_power) &&
      !has_nearer_exit(side, touch.deepest)) {
    return true;
  }

  BlockManifold searched;
  ContactRules rules = rules_;
  find_contact_points(pair, rules, nullptr, searched);
  rules.leans = false;
  if (searched.leans && !allows(side, searched.normal)) find_contact_points(pair, rules, nullptr, searched);
  if (searched.count == 0) return false;
  const int64_t facing = dot(searched.normal, side.normal);  // Q60
  if (is_at_seam(side, facing, least_separation(searched))) {
    touch.seam = true;
    if (facing < k_alike) return false;
    turn_to(side.normal, searched);
    // The separation of each point becomes the height, above the triangle's plane, of its place on the shape.
    const Vec64 from = negate(from_centre(side.triangle.corner[0]));
    for (uint32_t i = 0; i < searched.count; ++i) {
      BlockPoint& point = searched.point[i];
      point.separation = dot(add(from, point.from_b), side.normal).round_shift(30) + point.separation / 2;
    }
    touch.manifold = searched;
    touch.deepest = least_separation(searched);
    return true;
  }
  constexpr int64_t k_upright_cosine = (int64_t{1} << 60) - (int64_t{1} << 49);  // 2^-5 rad
  if (facing >= k_upright_cosine) {
    if (over) return true;
    turn_to(side.normal, searched);
  } else if (one_sided && facing < -(int64_t{1} << (60 - k_allowed_power))) {
    return false;
  } else if (!allows(side, searched.normal)) {
    touch.doubtful = !shallow;
    return over && (shallow || least_separation(searched) <= 0);  // else the shape touches only beside the triangle
  }
  touch.on_face = facing >= k_upright_cosine;
  touch.manifold = searched;
  touch.deepest = least_separation(searched);
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
