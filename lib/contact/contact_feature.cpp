#include "contact/contact_feature.h"

#include "base/bit_set.h"
#include "base/cycle.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Cylinder and cone: the index of the line on the round side, and also the name of that line's upper end. The names 0
/// to 15 are rim corners.
constexpr uint32_t k_line = 16;
/// The first index of edges that only a reduced face has. Edges of the hull have lower indices: there are at most 759.
constexpr uint32_t k_unpaired_edge = 768;

Vec32 unit(const Vec64& v) { return unit_vector_raw(scaled_to_30_bits(v)); }

/// Eight directions around the y axis, Q30; the first is along x.
constexpr int32_t k_diagonal = 759250125;  // 2^30 / sqrt 2
constexpr Vec32 k_eighth[8] = {
    {k_one, 0, 0},  {k_diagonal, 0, k_diagonal},   {0, 0, k_one},  {-k_diagonal, 0, k_diagonal},
    {-k_one, 0, 0}, {-k_diagonal, 0, -k_diagonal}, {0, 0, -k_one}, {k_diagonal, 0, -k_diagonal}};

/// The flat side at the top or bottom of a cylinder or cone.
void round_face(const Placed& placed, bool bottom, Feature& face) {
  for (int n = 0; n < 8; ++n) {
    const int i = bottom ? n : 7 - n;  // from x to z is clockwise as seen from above
    const Vec32 offset = {k_eighth[i].x, bottom ? -k_one : 1, k_eighth[i].z};
    face.add(placed.point(local_support(*placed.convex, offset).local), static_cast<uint32_t>(i) + (bottom ? 8 : 0));
  }
  const Vec32& up = placed.rotation.column[1];
  face.normal = bottom ? negate(up) : up;
  face.along = placed.rotation.column[0];
  face.index = bottom ? 1 : 0;
}

Vec32 plane_normal(const HullView& hull, uint32_t face) {
  const HullPlane plane = hull.plane(face);
  return {plane.normal[0], plane.normal[1], plane.normal[2]};
}

constexpr uint32_t k_face_words = 16;  ///< a hull has at most 506 faces

/// A set of vertices of a hull.
struct VertexSet {
  uint32_t words[8] = {};
  uint32_t count = 0;

  BitSet bits() { return {{words, 8}}; }
  /// Range: `v` is not yet in the set.
  void add(uint32_t v) {
    bits().set(v);
    ++count;
  }
};

struct VertexPolygon {
  uint32_t count = 0;
  uint8_t vertex[k_feature_points_max];
};

/// Returns the vertices whose coordinate along `direction` (Q30) is smaller than the greatest one by at most `room`.
VertexSet level_along(const HullView& hull, const Vec32& direction, int64_t room) {
  int64_t top = INT64_MIN;
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    const int64_t height = dot(hull.vertex(v), direction);
    top = height > top ? height : top;
  }
  VertexSet level;
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    if (dot(hull.vertex(v), direction) >= top - room * k_one) level.add(v);
  }
  return level;
}

uint32_t shared_count(const HullIndices& loop, BitSet set) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < loop.count; ++i) count += set.has(loop.index[i]) ? 1u : 0u;
  return count;
}

/// The normal of a polygon, with a length of twice its area. Widths: below 2^63, because all vertices lie within 2^30.
Vec64 area_vector(const HullView& hull, const uint8_t* polygon, uint32_t count) {
  Vec64 sum = {0, 0, 0};
  const Vec32 from = hull.vertex(polygon[0]);
  for (uint32_t i = 2; i < count; ++i) {
    const Vec32 to = hull.vertex(polygon[i - 1]), next = hull.vertex(polygon[i]);
    sum = add(sum, cross(subtract(to, from), subtract(next, from)));
  }
  return sum;
}

/// Makes a polygon of the vertices of a set that are farthest along 32 directions perpendicular to a normal.
void find_outline(const HullView& hull, const Vec32& normal, BitSet set, VertexPolygon& polygon) {
  constexpr int32_t k_sine[9] = {0, 195, 383, 556, 707, 831, 924, 981, 1000};
  const Vec32 u = unit(cross(normal, magnitude_32(normal.x) < (1u << 29) ? Vec32{k_one, 0, 0} : Vec32{0, k_one, 0}));
  const Vec32 w = round_shift(cross(normal, u), 30);
  uint8_t best[k_feature_points_max] = {};
  int64_t most[k_feature_points_max];
  for (int64_t& margin : most) margin = INT64_MIN;
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    if (!set.has(v)) continue;
    const Vec32 at = hull.vertex(v);
    const int64_t right = dot(u, at) >> 30, up = dot(w, at) >> 30;
    for (int i = 0; i < k_feature_points_max; ++i) {
      const int quarter = i / 8, part = i % 8;
      const int32_t c = k_sine[8 - part], s = k_sine[part];
      const int32_t x = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
      const int32_t y = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
      const int64_t margin = right * x + up * y;
      if (margin <= most[i]) continue;
      most[i] = margin;
      best[i] = static_cast<uint8_t>(v);
    }
  }
  VertexSet taken;
  polygon.count = 0;
  for (const uint8_t v : best) {
    if (taken.bits().has(v)) continue;
    taken.add(v);
    polygon.vertex[polygon.count++] = v;
  }
}

/// Returns the half thickness of a hull: the least signed distance of its face planes from a centre. Two centres are
/// tried: the frame's origin, which may lie outside the hull, and the mean of the vertices. The result is the greater
/// of the two distances, at least 0.
int32_t hull_half_thickness(const HullView& hull) {
  Vec64 sum = {0, 0, 0};
  for (uint32_t v = 0; v < hull.vertex_count; ++v) sum = add(sum, Vec64{hull.x(v), hull.y(v), hull.z(v)});
  const int64_t n = hull.vertex_count;
  const Vec32 mean = {static_cast<int32_t>(sum.x / n), static_cast<int32_t>(sum.y / n),
                      static_cast<int32_t>(sum.z / n)};
  int64_t from_origin = INT32_MAX, from_mean = INT32_MAX;
  for (uint32_t f = 0; f < hull.face_count; ++f) {
    const int64_t offset = hull.plane(f).offset, beyond = offset - (dot(plane_normal(hull, f), mean) >> 30);
    from_origin = offset < from_origin ? offset : from_origin;
    from_mean = beyond < from_mean ? beyond : from_mean;
  }
  const int64_t most = from_origin > from_mean ? from_origin : from_mean;
  return most > 0 ? static_cast<int32_t>(most) : 0;
}

/// A vertex is level with the farthest vertex along a direction if its coordinate is smaller by at most 2^-k_even_power
/// of the half thickness.
constexpr int k_even_power = 6;
/// A single face is the contact feature if its area is at least 1 - 2^-k_beyond_power of the area of the whole region
/// level with it. Otherwise the region is the contact feature.
constexpr int k_beyond_power = 2;
constexpr int k_even_rounds_max = 4;  ///< rounds in which the region level with a face may grow

/// Finds the faces that contain at least one vertex of `vertices`.
void find_faces(const HullView& hull, BitSet vertices, BitSet faces) {
  for (uint32_t i = 0; i < hull.edge_count; ++i) {
    const HullEdge edge = hull.edge(i);
    if (!vertices.has(edge.a) && !vertices.has(edge.b)) continue;
    faces.set(edge.left);
    faces.set(edge.right);
  }
}

/// Returns the face with the most vertices of `level`; among equal faces, the one whose normal is closest to `d`.
uint32_t face_along(const HullView& hull, const Vec32& d, BitSet level, BitSet faces) {
  uint32_t best = 0, most = 0;
  int64_t steepest = INT64_MIN;
  faces.for_each([&](uint32_t f) {
    const uint32_t shared = shared_count(hull.face(f), level);
    if (shared < most) return;
    const int64_t along = dot(plane_normal(hull, f), d);
    if (shared == most && along <= steepest) return;
    most = shared;
    steepest = along;
    best = f;
  });
  return best;
}

/// Returns the mean normal, weighted by area, of a face and of those faces in `faces` whose normals are within 2^-9 rad
/// of the normal of this face.
Vec32 normal_about(const HullView& hull, uint32_t face, BitSet faces) {
  constexpr int64_t k_alike = (int64_t{1} << 60) - (int64_t{1} << 41);  // 2^-9 rad
  const Vec32 normal = plane_normal(hull, face);
  Vec64 sum = {0, 0, 0};
  faces.for_each([&](uint32_t f) {
    if (f != face && dot(plane_normal(hull, f), normal) < k_alike) return;
    const HullIndices loop = hull.face(f);
    const Vec32 area = round_shift(area_vector(hull, loop.index, loop.count), 33);
    sum = add(sum, Vec64{area.x, area.y, area.z});
  });
  return is_zero(sum) ? normal : unit(sum);
}

/// Finds the region level with a face, as one polygon, if it is larger than the face. `normal`: in, the normal about
/// the face; out, that of the polygon. False if the face should be used by itself.
bool find_even(const HullView& hull, uint32_t face, int64_t room, VertexPolygon& polygon, Vec32& normal) {
  const HullIndices loop = hull.face(face);
  uint32_t before = 0;
  for (int round = 0; round < k_even_rounds_max; ++round) {
    VertexSet level = level_along(hull, normal, room);
    if (shared_count(loop, level.bits()) == level.count) return false;
    if (level.count == before) break;
    before = level.count;
    find_outline(hull, normal, level.bits(), polygon);
    const Vec64 area = area_vector(hull, polygon.vertex, polygon.count);
    if (polygon.count < 3 || is_zero(area)) return false;
    normal = unit(area);
  }
  const auto area_of = [&](const Vec64& twice) { return dot(round_shift(twice, 32), normal); };
  const int64_t whole = area_of(area_vector(hull, polygon.vertex, polygon.count));
  return area_of(area_vector(hull, loop.index, loop.count)) < whole - (whole >> k_beyond_power);
}

__attribute__((noinline)) void hull_face(const Placed& placed, const Vec32& d, int32_t thickness, Feature& face) {
  const HullView& hull = placed.hull;
  const int64_t room = thickness >> k_even_power;
  VertexSet level = level_along(hull, d, room);
  uint32_t words[k_face_words] = {};
  const BitSet faces = {{words, k_face_words}};
  find_faces(hull, level.bits(), faces);
  face.index = face_along(hull, d, level.bits(), faces);
  VertexPolygon polygon;
  Vec32 normal = normal_about(hull, face.index, faces);
  if (find_even(hull, face.index, room, polygon, normal)) {
    face.index = hull.face_count;
  } else {
    const HullIndices loop = hull.face(face.index);
    normal = plane_normal(hull, face.index);
    if (loop.count > k_feature_points_max) {
      VertexSet corners;
      for (uint32_t i = 0; i < loop.count; ++i) corners.add(loop.index[i]);
      find_outline(hull, normal, corners.bits(), polygon);
    } else {
      polygon.count = loop.count;
      for (uint32_t i = 0; i < loop.count; ++i) polygon.vertex[i] = loop.index[i];
    }
  }
  for (uint32_t i = 0; i < polygon.count; ++i)
    face.add(placed.point(hull.vertex(polygon.vertex[i])), polygon.vertex[i]);
  face.normal = unit(multiply(placed.rotation, normal));
  face.along = unit(
      Vec64{face.point[1].x - face.point[0].x, face.point[1].y - face.point[0].y, face.point[1].z - face.point[0].z});
}

void box_face(const Placed& placed, const Vec32& d, Feature& face) {
  const int64_t part[3] = {magnitude_32(d.x), magnitude_32(d.y), magnitude_32(d.z)};
  const int x = part[1] > part[0] ? (part[2] > part[1] ? 2 : 1) : part[2] > part[0] ? 2 : 0;
  const int y = next_of_three(x), z = previous_of_three(x);
  const int32_t at[3] = {d.x, d.y, d.z};
  const bool back = at[x] < 0;
  for (int i = 0; i < 4; ++i) {
    const int n = back ? 3 - i : i;
    const uint32_t name = (back ? 1u << x : 0) | (n == 1 || n == 2 ? 1u << y : 0) | (n >= 2 ? 1u << z : 0);
    const auto sign = [&](int bit) { return (name >> bit & 1) != 0 ? -1 : 0; };
    face.add(placed.box_point(sign(0), sign(1), sign(2)), name);
  }
  const Vec32& axis = placed.rotation.column[x];
  face.normal = back ? negate(axis) : axis;
  face.along = placed.rotation.column[y];
  face.index = static_cast<uint32_t>(2 * x + (back ? 1 : 0));
}

bool triangle_face(const Placed& placed, const Vec32& direction, Feature& face) {
  CorePoint corner[3];
  for (uint8_t i = 0; i < 3; ++i) core_vertex(*placed.convex, i, corner[i]);
  const Vec32 p = placed.point(corner[0].local), q = placed.point(corner[1].local), r = placed.point(corner[2].local);
  const Vec64 across = cross(subtract(q, p), subtract(r, p));
  if (is_zero(across)) return false;
  face.normal = unit(across);
  const bool back = dot(face.normal, direction) < 0;
  if (back) face.normal = negate(face.normal);
  face.add(p, 0);
  face.add(back ? r : q, back ? 2 : 1);
  face.add(back ? q : r, back ? 1 : 2);
  const Vec32 edge = subtract(q, p);
  face.along = unit(Vec64{edge.x, edge.y, edge.z});
  face.index = back ? 1 : 0;
  return true;
}

/// Makes the edge along which a plane perpendicular to `d` (local axes) touches the round side of a cylinder or cone.
void round_line(const Placed& placed, const Vec32& d, Feature& edge) {
  const Convex& convex = *placed.convex;
  const bool is_cone = convex.type == ShapeType::cone;
  const Vec32 up = is_cone ? Vec32{0, k_one, 0} : Vec32{d.x, 1, d.z};
  edge.add(placed.point(local_support(convex, up).local), k_line);
  edge.add(placed.point(local_support(convex, {d.x, -k_one, d.z}).local), k_line + 1);
  edge.index = k_line;
}

int64_t slope_of(const Vec32& from, const Vec32& to, const Vec32& direction) {
  const Vec32 offset = subtract(to, from);
  if (is_zero(offset)) return k_one;
  const int64_t rise = dot(unit(Vec64{offset.x, offset.y, offset.z}), direction);
  return (rise < 0 ? -rise : rise) >> 30;
}

}  // namespace

uint32_t Feature::name() const {
  if (count == 1) return feature_name(FeatureType::vertex, vertex[0]);
  return feature_name(count == 2 ? FeatureType::edge : FeatureType::face, index);
}

bool supporting_face(const Placed& placed, const Vec32& direction, int32_t thickness, Feature& face) {
  const Convex& convex = *placed.convex;
  face.count = 0;
  const Vec32 d = rotate_inverse(placed.rotation, direction);
  switch (convex.type) {
    case ShapeType::box:
      box_face(placed, d, face);
      return true;
    case ShapeType::hull:
      hull_face(placed, d, thickness, face);
      return true;
    case ShapeType::triangle:
      return triangle_face(placed, direction, face);
    case ShapeType::cylinder:
      if (magnitude_32(d.y) < static_cast<uint64_t>(length_across(d))) return false;
      round_face(placed, d.y < 0, face);
      return true;
    case ShapeType::cone: {
      // The outward normal of the cone's round side, not normalised: 2 half lengths across the axis, the radius along
      // it.
      const int64_t radius = convex.size[0], height = 2 * int64_t{convex.size[1]}, across = length_across(d);
      const int64_t length = square_root_nearest(static_cast<uint64_t>(radius * radius + height * height));
      if (d.y >= 0 || -d.y < (height * across + radius * d.y) / length) return false;
      round_face(placed, true, face);
      return true;
    }
    default:
      return false;
  }
}

void supporting_edge(const Placed& placed, const Vec32& direction, int64_t slope_max, Feature& edge) {
  const Convex& convex = *placed.convex;
  const Vec32 d = rotate_inverse(placed.rotation, direction);
  const SupportPoint farthest = support(placed, direction);
  edge.count = 0;
  if (convex.type == ShapeType::cylinder || convex.type == ShapeType::cone) {
    round_line(placed, d, edge);
    if (slope_of(edge.point[0], edge.point[1], direction) <= slope_max) return;
    const bool second = dot(direction, edge.point[1]) > dot(direction, edge.point[0]);
    edge.count = 0;
    edge.add(farthest.point, second ? k_line + 1 : k_line);
    return;
  }
  const uint32_t from = farthest.core.feature;
  uint32_t best = from;
  int64_t least = INT64_MAX;
  const auto consider = [&](uint32_t to) {
    CorePoint core;
    if (!core_vertex(convex, static_cast<uint8_t>(to), core) || core.local == farthest.core.local) return;
    const int64_t slope = slope_of(farthest.core.local, core.local, d);
    if (slope >= least) return;
    least = slope;
    best = to;
  };
  switch (convex.type) {
    case ShapeType::capsule:
      if (convex.size[1] > 0) consider(from ^ 1);
      break;
    case ShapeType::box:
      for (uint32_t axis = 0; axis < 3; ++axis) consider(from ^ (1u << axis));
      break;
    case ShapeType::triangle:
      for (uint32_t i = 1; i < 3; ++i) consider((from + i) % 3);
      break;
    case ShapeType::hull:
      for (uint32_t i = 0; i < placed.hull.edge_count; ++i) {
        const HullEdge e = placed.hull.edge(i);
        if (e.a == from || e.b == from) consider(e.a == from ? e.b : e.a);
      }
      break;
    default:
      break;
  }
  if (least > slope_max) {
    edge.add(farthest.point, from);
    return;
  }
  for (int i = 0; i < 2; ++i) {
    const uint32_t v = (from < best) == (i == 0) ? from : best;
    CorePoint core;
    core_vertex(convex, static_cast<uint8_t>(v), core);
    edge.add(placed.point(core.local), v);
  }
  edge.index = edge_index(placed, from, best);
}

uint32_t edge_index(const Placed& placed, uint32_t vertex_a, uint32_t vertex_b) {
  switch (placed.convex->type) {
    case ShapeType::box: {
      const uint32_t across = vertex_a ^ vertex_b, axis = across == 1 ? 0 : across == 2 ? 1 : 2;
      const uint32_t both = vertex_a & vertex_b;
      return 4 * axis + (both >> (next_of_three(axis)) & 1) + 2 * (both >> (previous_of_three(axis)) & 1);
    }
    case ShapeType::triangle:
      return vertex_a + vertex_b - 1;
    case ShapeType::hull: {
      const uint32_t low = vertex_a < vertex_b ? vertex_a : vertex_b, high = vertex_a < vertex_b ? vertex_b : vertex_a;
      for (uint32_t i = 0; i < placed.hull.edge_count; ++i) {
        const HullEdge e = placed.hull.edge(i);
        if (e.a == low && e.b == high) return i;
      }
      return k_unpaired_edge + vertex_a;
    }
    case ShapeType::cylinder:
    case ShapeType::cone: {
      if (vertex_a >= k_line) return k_line;
      const bool follows = ((vertex_a + 1) & 7) == (vertex_b & 7);
      return follows ? vertex_a : vertex_b;
    }
    default:
      return 0;
  }
}

int32_t in_block(const Placed& placed, int32_t length) {
  // The shift may be negative only for a core that is a point.
  return length == 0 || placed.shift > 30 ? 0 : length >> placed.shift;
}

int32_t core_half_thickness(const Placed& placed) {
  const Convex& convex = *placed.convex;
  if (convex.type == ShapeType::hull) return convex.size[0] > 0 ? convex.size[0] : hull_half_thickness(placed.hull);
  int32_t least = convex.core_radius;
  const bool is_box = convex.type == ShapeType::box;
  if (is_box || convex.type == ShapeType::cylinder || convex.type == ShapeType::cone) {
    for (int i = 0; i < (is_box ? 3 : 2); ++i) {
      const int32_t extent = convex.size[i];
      least = extent > 0 && extent < least ? extent : least;
    }
  }
  return least;
}

int32_t half_thickness(const Placed& placed) { return in_block(placed, core_half_thickness(placed)); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
