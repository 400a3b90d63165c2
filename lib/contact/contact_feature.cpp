#include "contact/contact_feature.h"

#include "base/bit_set.h"
#include "base/cycle.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Cylinder and cone: the index of the edge that is a line on the round side, and also the name of this line's upper
/// end; its lower end has the next name. The names 0 to 15 are corners of the octagons in the rims.
constexpr uint32_t k_line = 16;
/// The first index of the edges that belong to an outline (find_outline()) but not to the hull. Edges of the hull have
/// lower indices: a hull has at most 759.
constexpr uint32_t k_unpaired_edge = 768;

Vec32 unit(const Vec64& v) { return unit_vector_raw(scaled_to_30_bits(v)); }

/// Eight directions around the y axis, Q30; the first is along x.
constexpr int32_t k_diagonal = 759250125;  // 2^30 / sqrt 2
constexpr Vec32 k_eighth[8] = {
    {k_one, 0, 0},  {k_diagonal, 0, k_diagonal},   {0, 0, k_one},  {-k_diagonal, 0, k_diagonal},
    {-k_one, 0, 0}, {-k_diagonal, 0, -k_diagonal}, {0, 0, -k_one}, {k_diagonal, 0, -k_diagonal}};

/// Sets `face` to the flat side at the top or bottom of a cylinder or cone: an octagon inscribed in its rim.
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

/// A set of vertices of a hull. One byte for each vertex keeps the test of a vertex fast; most tested vertices are not
/// in the set.
struct VertexSet {
  uint8_t has[k_hull_vertices_max] = {};  ///< 1: the vertex is in the set
  uint32_t count = 0;

  /// Range: `v` is not yet in the set.
  void add(uint32_t v) {
    has[v] = 1;
    ++count;
  }
  uint32_t shared_with(const HullIndices& loop) const {
    uint32_t shared = 0;
    for (uint32_t i = 0; i < loop.count; ++i) shared += has[loop.index[i]];
    return shared;
  }
};

struct VertexPolygon {
  uint32_t count = 0;
  uint8_t vertex[k_feature_points_max];
};

/// Returns the vertices whose coordinate along `direction` (Q30) is at most `room` below the greatest coordinate.
VertexSet level_along(const HullView& hull, const Vec32& direction, int64_t room) {
  const HullHeights heights(hull, direction);
  const int64_t slack = room * k_one;
  VertexSet level;
#if defined(__OPTIMIZE_SIZE__)
  int64_t top = INT64_MIN;
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    const int64_t height = heights.of(v);
    top = height > top ? height : top;
  }
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    if (heights.of(v) >= top - slack) level.add(v);
  }
#else
  int64_t top = INT64_MIN / 2, floor = top;
  uint8_t near[k_hull_vertices_max];  // candidates: at most `slack` below `top` when they were added
  uint32_t count = 0;
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    const int64_t height = heights.of(v);
    if (height < floor) continue;
    if (height > top) {
      if (height - slack > top) count = 0;
      top = height;
      floor = top - slack;
    }
    near[count++] = static_cast<uint8_t>(v);
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (heights.of(near[i]) >= floor) level.add(near[i]);
  }
#endif
  return level;
}

/// Returns a normal of a polygon; its length is twice the polygon's area. Each component is below 2^63, because all
/// vertices lie within 2^30 of the origin.
Vec64 area_vector(const HullView& hull, const uint8_t* polygon, uint32_t count) {
  Vec64 sum = {0, 0, 0};
  const Vec32 from = hull.vertex(polygon[0]);
  for (uint32_t i = 2; i < count; ++i) {
    const Vec32 to = hull.vertex(polygon[i - 1]), next = hull.vertex(polygon[i]);
    sum = add(sum, cross(subtract(to, from), subtract(next, from)));
  }
  return sum;
}

/// Sets `polygon` to the outline of a set of vertices, as seen along a normal: those vertices that are farthest along
/// one of 32 directions perpendicular to the normal.
void find_outline(const HullView& hull, const Vec32& normal, const VertexSet& set, VertexPolygon& polygon) {
  constexpr int32_t k_sine[9] = {0, 195, 383, 556, 707, 831, 924, 981, 1000};
  const Vec32 u = unit(cross(normal, magnitude_32(normal.x) < (1u << 29) ? Vec32{k_one, 0, 0} : Vec32{0, k_one, 0}));
  const Vec32 w = round_shift(cross(normal, u), 30);
  uint8_t best[k_feature_points_max] = {};
  int64_t most[k_feature_points_max];
  for (int64_t& margin : most) margin = INT64_MIN;
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    if (set.has[v] == 0) continue;
    const Vec32 at = hull.vertex(v);
    const int64_t right = dot(u, at) >> 30, up = dot(w, at) >> 30;
    for (int part = 0; part < 8; ++part) {
      const int32_t c = k_sine[8 - part], s = k_sine[part];
      int64_t margin = right * c + up * s, next = up * c - right * s;  // along two directions at a right angle
      for (int i = part; i < k_feature_points_max; i += 8) {
        if (margin > most[i]) {
          most[i] = margin;
          best[i] = static_cast<uint8_t>(v);
        }
        const int64_t last = margin;
        margin = next;
        next = -last;
      }
    }
  }
  VertexSet taken;
  polygon.count = 0;
  for (const uint8_t v : best) {
    if (taken.has[v] != 0) continue;
    taken.add(v);
    polygon.vertex[polygon.count++] = v;
  }
}

/// Returns the half thickness of a hull: the least signed distance of its face planes from a centre. Two centres are
/// tried: the frame's origin, which may lie outside the hull, and the mean of the vertices. The result is the greater
/// of the two distances, at least 0.
int32_t hull_half_thickness(const HullView& hull) {
  Vec64 sum = {0, 0, 0};
  for (uint32_t v = 0; v < hull.vertex_count; ++v) {
    const Vec32 at = hull.vertex(v);
    sum = add(sum, Vec64{at.x, at.y, at.z});
  }
  const int64_t n = hull.vertex_count;
  const Vec32 mean = {static_cast<int32_t>(sum.x / n), static_cast<int32_t>(sum.y / n),
                      static_cast<int32_t>(sum.z / n)};
  int64_t from_origin = INT32_MAX, from_mean = INT32_MAX;
#if !defined(__OPTIMIZE_SIZE__)
  for (uint32_t f = 0; f < hull.face_count; ++f) {
    const int64_t offset = hull.plane(f).offset;
    from_origin = offset < from_origin ? offset : from_origin;
  }
#endif
  for (uint32_t f = 0; f < hull.face_count; ++f) {
    const int64_t offset = hull.plane(f).offset, beyond = offset - (dot(plane_normal(hull, f), mean) >> 30);
    from_mean = beyond < from_mean ? beyond : from_mean;
#if defined(__OPTIMIZE_SIZE__)
    from_origin = offset < from_origin ? offset : from_origin;
#else
    if (from_mean <= from_origin) break;  // the distance from the mean cannot be the greater one
#endif
  }
  const int64_t most = from_origin > from_mean ? from_origin : from_mean;
  return most > 0 ? static_cast<int32_t>(most) : 0;
}

/// A vertex is level with the farthest vertex along a direction if it is lower than that vertex by at most
/// 2^-k_even_power of the half thickness.
constexpr int k_even_power = 6;
/// A single face is the contact feature if its area is at least 1 - 2^-k_beyond_power of the area of the region that
/// consists of all vertices level with it. Otherwise this region is the contact feature.
constexpr int k_beyond_power = 2;
constexpr int k_even_rounds_max = 4;  ///< find_even(): rounds in which the region level with a face is recomputed

/// Adds the faces that contain at least one vertex of `vertices` to the set `faces`.
void find_faces(const HullView& hull, const VertexSet& vertices, BitSet faces) {
  const uint8_t* ends = hull.bytes + hull.at.edges;
  for (uint32_t i = 0; i < hull.edge_count; ++i, ends += k_hull_edge_bytes) {
    if ((vertices.has[ends[0]] | vertices.has[ends[1]]) == 0) [[likely]]
      continue;
    const HullEdge edge = hull.edge(i);
    faces.set(edge.left);
    faces.set(edge.right);
  }
}

/// Returns the face of `faces` with the most vertices in `level`. If several faces have as many, returns the one whose
/// normal is closest to `d`.
uint32_t face_along(const HullView& hull, const Vec32& d, const VertexSet& level, BitSet faces) {
  uint32_t best = 0, most = 0;
  int64_t steepest = INT64_MIN;
  faces.for_each([&](uint32_t f) {
    const uint32_t shared = level.shared_with(hull.face(f));
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

/// Sets `polygon` to the outline of all vertices that are level with a face, within `room`. `normal`: on entry,
/// normal_about() of the face; on return, the normal of the polygon. Returns false if the face alone should be used,
/// because its area is most of the outline's area (k_beyond_power), or because no other vertex is level with it.
bool find_even(const HullView& hull, uint32_t face, int64_t room, VertexPolygon& polygon, Vec32& normal) {
  const HullIndices loop = hull.face(face);
  uint32_t before = 0;
  for (int round = 0; round < k_even_rounds_max; ++round) {
    const VertexSet level = level_along(hull, normal, room);
    if (level.shared_with(loop) == level.count) return false;
    if (level.count == before) break;
    before = level.count;
    find_outline(hull, normal, level, polygon);
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
  const VertexSet level = level_along(hull, d, room);
  uint32_t words[k_face_words] = {};
  const BitSet faces = {{words, (hull.face_count + 31) / 32}};
  find_faces(hull, level, faces);
  face.index = face_along(hull, d, level, faces);
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
      find_outline(hull, normal, corners, polygon);
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

/// Returns the vertex `v` of a core that has vertices, in the shape's axes.
Vec32 vertex_of(const Placed& placed, uint32_t v) {
#if !defined(__OPTIMIZE_SIZE__)
  if (placed.convex->type == ShapeType::hull) return placed.hull.vertex(v);
#endif
  CorePoint core;
  core_vertex(*placed.convex, static_cast<uint8_t>(v), core);
  return core.local;
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
      // The outward normal of the cone's round side, not normalised, has the component 2 half lengths across the axis
      // and the component radius along the axis.
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
    const Vec32 at = vertex_of(placed, to);
    if (at == farthest.core.local) return;
    const int64_t slope = slope_of(farthest.core.local, at, d);
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
        if (e.a > from) break;  // the edges are in ascending order, and b > a
        if (e.a != from && e.b != from) continue;
        consider(e.a == from ? e.b : e.a);
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
    edge.add(placed.point(vertex_of(placed, v)), v);
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
      uint32_t from = 0;
#if !defined(__OPTIMIZE_SIZE__)
      // The edges are in ascending order. After the loop, the edge is one of at most 8 edges from `from` on.
      for (uint32_t to = placed.hull.edge_count; to - from > 8;) {
        const uint32_t middle = (from + to) / 2;
        const HullEdge e = placed.hull.edge(middle);
        const bool is_before = e.a < low || (e.a == low && e.b <= high);
        (is_before ? from : to) = middle;
      }
#endif
      for (uint32_t i = from; i < placed.hull.edge_count; ++i) {
        const HullEdge e = placed.hull.edge(i);
        if (e.a == low && e.b == high) return i;
        if (e.a > low) break;
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
