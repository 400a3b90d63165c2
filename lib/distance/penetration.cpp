#include "distance/penetration.h"

#include "distance/pair.h"
#include "math/root.h"

// Bit widths, with |vertex| < 2^30 and |edge| < 2^31. A face's normal is below 2^62 (64 bits). Its product with a
// vertex is below 2^92. Its square, the weight of a vertex in its face, and the numerator of a distance are below 2^124
// (128 bits).

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_ulp = int64_t{1} << 30;  ///< one ulp (2^-30 of the pair's unit of length), in Q30
constexpr int k_vertices_max = k_penetration_vertices_max;
constexpr int k_faces_max = 2 * k_vertices_max - 4;
static_assert(k_vertices_max <= 64, "edges are rows of 64 bits");

/// Returns the signed distance from the origin to the plane through `point` perpendicular to `normal`, in 2^-30 ulps.
/// It is positive if the plane lies in the direction of the normal. Rounding: to nearest, from a quotient with a
/// relative error below 2^-62.
int64_t plane_distance(const Vec64& normal, const Vec32& point) {
  const Int128 square = dot(normal, normal);
  const int half_shift = (126 - bit_length_128(magnitude_128(square))) / 2;
  const Int128 scaled = square.shift_left(2 * half_shift);
  const uint64_t length = square_root_nearest(Words128{static_cast<uint64_t>(scaled.high_word()), scaled.low_word()});
  return divide_rounded(dot(normal, point).shift_left(30 + half_shift), static_cast<int64_t>(length));
}
/// If the distances of two planes differ by no more than this (in 2^-30 ulps), rounding may hide which plane is nearer.
constexpr int64_t k_tie = 4;

/// A vertex of the Minkowski difference B - A.
struct Vertex {
  Vec32 difference;
  Vec32 on_a;  ///< the point of A in this difference, from A's centre
};

/// A triangle; its vertices are counter-clockwise seen from outside.
struct Face {
  uint8_t vertex[3];
  int64_t distance;  ///< from the origin to its plane, in 2^-30 ulps
};

/// The convex hull of some vertices of the difference; its boundary consists of triangles.
struct ExpandingPolytope {
  Vertex vertex[k_vertices_max];
  Face face[k_faces_max];
  uint64_t edges[k_vertices_max];  ///< bit j of row i: a face that is being removed has the edge from i to j
  int vertex_count = 0;
  int face_count = 0;

  const Vec32& at(const Face& f, int i) const { return vertex[f.vertex[i]].difference; }
  Vec64 normal_of(const Face& f) const { return cross(subtract(at(f, 1), at(f, 0)), subtract(at(f, 2), at(f, 0))); }
  /// Whether the point lies strictly outside the face's plane.
  bool faces(const Face& f, const Vec32& point) const {
    return sign_of(dot(normal_of(f), subtract(point, at(f, 0)))) > 0;
  }

  void add_face(int i, int j, int k);
  /// Extends the hull by the last vertex. Removes the faces for which this vertex lies strictly outside the face's
  /// plane, and no others. So coplanar triangles are removed together, and no new triangle is degenerate.
  void grow();
  /// Whether the origin's projection onto the face's plane lies in the face.
  bool holds_foot(const Face& f) const;
  /// Returns the face nearest to the origin, within rounding. Sets `least` to the least distance of a face's plane from
  /// the origin (in 2^-30 ulps), also within rounding.
  const Face& nearest_face(int64_t& least) const;
};
static_assert(sizeof(ExpandingPolytope) <= 4096);

void ExpandingPolytope::add_face(int i, int j, int k) {
  DETENT_VERIFY_RANGE(face_count < k_faces_max);  // by Euler's formula
  Face& f = face[face_count++];
  f = {{static_cast<uint8_t>(i), static_cast<uint8_t>(j), static_cast<uint8_t>(k)}, 0};
  f.distance = plane_distance(normal_of(f), at(f, 0));
}

void ExpandingPolytope::grow() {
  const int last = vertex_count - 1;
  for (int i = 0; i < last; ++i) edges[i] = 0;
  int kept = 0;
  for (int n = 0; n < face_count; ++n) {
    const Face f = face[n];
    if (!faces(f, vertex[last].difference)) {
      face[kept++] = f;
      continue;
    }
    for (int i = 0; i < 3; ++i) edges[f.vertex[i]] |= uint64_t{1} << f.vertex[i == 2 ? 0 : i + 1];
  }
  face_count = kept;
  for (int i = 0; i < last; ++i) {
    for (int j = 0; j < last; ++j) {
      if ((edges[i] >> j & 1) != 0 && (edges[j] >> i & 1) == 0) add_face(i, j, last);
    }
  }
}

bool ExpandingPolytope::holds_foot(const Face& f) const {
  const Vec64 normal = normal_of(f);
  for (int i = 0; i < 3; ++i) {
    if (sign_of(dot(normal, cross(at(f, i), at(f, i == 2 ? 0 : i + 1)))) < 0) return false;
  }
  return true;
}

const Face& ExpandingPolytope::nearest_face(int64_t& least) const {
  int best = 0;
  for (int i = 1; i < face_count; ++i) {
    if (face[i].distance < face[best].distance) best = i;
  }
  least = face[best].distance;
  // Several planes may be nearest within rounding, and several triangles may lie in one plane. The nearest face among
  // them is the one that contains the origin's projection onto its plane.
  for (int i = 0; i < face_count; ++i) {
    if (face[i].distance <= least + k_tie && holds_foot(face[i])) return face[i];
  }
  return face[best];
}

/// Replaces `found`, a point of the placed core that is farthest along `normal` only within rounding, by the vertex
/// that is farthest exactly. Leaves `found` as it is if the core has no vertices.
void exact_support(const Placed& placed, const Vec64& normal, SupportPoint& found) {
  if (found.core.feature == k_no_feature) return;
  // A vertex cannot be the farthest if its coordinate along `direction` is smaller than that of `found` by more than
  // `doubt`. Both are dot products of a local point, in 2^-30 of the shape's unit, with `direction`. `doubt` covers 4
  // units of 2^-30 of the shape's unit for the rounded directions, and 9 ulps of the pair's block for the two rounded
  // points.
  const Vec32 direction = rotate_inverse(placed.rotation, scaled_to_30_bits(normal));
  const int64_t doubt = int64_t{16} << (30 + (placed.shift < 27 ? placed.shift : 27));
  const int64_t floor = dot(direction, found.core.local) - doubt;
  Int128 most = dot(normal, found.point);
  const auto consider = [&](const CorePoint& core) {
    if (dot(direction, core.local) < floor) return;
    const Vec32 point = placed.point(core.local);
    const Int128 support = dot(normal, point);
    if (!(most < support)) return;
    most = support;
    found = {point, core};
  };
#if !defined(__OPTIMIZE_SIZE__)
  const HullView& hull = placed.hull;
  if (hull.vertex_count != 0) {
    const HullHeights heights(hull, direction);
    for (uint32_t i = 0; i < hull.vertex_count; ++i) {
      if (heights.of(i) >= floor) consider({hull.vertex(i), static_cast<uint8_t>(i)});
    }
    return;
  }
#endif
  CorePoint core;
  for (uint8_t i = 0; core_vertex(*placed.convex, i, core); ++i) consider(core);
}

bool is_half_space(const Placed& placed) { return placed.convex->type == ShapeType::half_space; }
bool is_curved(const Placed& placed) {
  return placed.convex->type == ShapeType::cylinder || placed.convex->type == ShapeType::cone;
}

/// Searches for the face of the Minkowski difference that is nearest to the origin.
class PenetrationSearch {
 public:
  PenetrationSearch(const Placed& a, const Placed& b, const Vec32& offset) : a_(a), b_(b), offset_(offset) {}

  Penetration run(const Simplex& simplex);

 private:
  bool complete(const Simplex& simplex, Vec64& across);
  template <class Test>
  bool add_where(const Vec64& direction, const Test& test);
  void start();
  void expand();
  Penetration flat(const Simplex& simplex, const Vec64& across) const;
  Penetration answer() const;
  Vertex vertex_of(const SupportPoint& on_a, const SupportPoint& on_b) const {
    return {add(offset_, subtract(on_b.point, on_a.point)), on_a.point};
  }

  const Placed& a_;
  const Placed& b_;
  Vec32 offset_;
  ExpandingPolytope polytope_;
  // The best face so far. If the plane of each tested face is moved outwards until it only touches the Minkowski
  // difference, the moved plane of the best face is the one nearest to the origin.
  Face best_;
  Vec32 outward_;
  int64_t support_ = INT64_MAX / 2;
  int64_t lower_ = 0;
  int supports_ = 0;
  bool capped_ = false;
};

/// Adds the vertex of the difference that is farthest along `direction`, if `test` accepts it. Returns whether it was
/// added.
template <class Test>
bool PenetrationSearch::add_where(const Vec64& direction, const Test& test) {
  const Vec32 d = scaled_to_30_bits(direction);
  SupportPoint on_a = support(a_, negate(d)), on_b = support(b_, d);
  ++supports_;
  exact_support(a_, negate(direction), on_a);
  exact_support(b_, direction, on_b);
  const Vertex vertex = vertex_of(on_a, on_b);
  if (!test(vertex.difference)) return false;
  polytope_.vertex[polytope_.vertex_count++] = vertex;
  return true;
}

/// Copies the simplex to the polytope and adds vertices until there are four that span a volume. Returns false if the
/// Minkowski difference is flat; `across` is then perpendicular to it.
bool PenetrationSearch::complete(const Simplex& simplex, Vec64& across) {
  int& count = polytope_.vertex_count;
  const auto p = [&](int i) -> const Vec32& { return polytope_.vertex[i].difference; };
  for (int i = 0; i < simplex.count(); ++i) {
    const SimplexVertex& v = simplex.vertex(i);
    polytope_.vertex[count++] = {v.difference, a_.point(v.a.local)};
  }
  if (count == 1) {
    const auto elsewhere = [&](const Vec32& q) { return !(q == p(0)); };
    for (int i = 0; i < 6 && count == 1; ++i) {
      const int64_t side = i < 3 ? 1 : -1;
      const int axis = i < 3 ? i : i - 3;
      add_where({axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0}, elsewhere);
    }
    across = {0, 1, 0};
    if (count == 1) return false;
  }
  if (count == 2) {
    const Vec32 edge = subtract(p(1), p(0));
    const auto aside = [&](const Vec32& q) { return !is_zero(cross(edge, subtract(q, p(0)))); };
    const uint32_t x = magnitude_32(edge.x), y = magnitude_32(edge.y), z = magnitude_32(edge.z);
    // `axis` is the coordinate axis along which the edge's extent is least; if extents are equal, y is preferred to x,
    // and x to z. `across` is the part of `axis` perpendicular to the edge. So two horizontal segments are separated
    // vertically.
    const Vec32 axis = y <= x && y <= z ? Vec32{0, 1, 0} : x <= z ? Vec32{1, 0, 0} : Vec32{0, 0, 1};
    const Vec64 level = cross(edge, axis);
    across = cross(scaled_to_30_bits(level), scaled_to_30_bits(edge));
    if (!add_where(across, aside) && !add_where(negate(across), aside) && !add_where(level, aside) &&
        !add_where(negate(level), aside)) {
      return false;
    }
  }
  if (count == 3) {
    across = cross(subtract(p(1), p(0)), subtract(p(2), p(0)));
    const auto beyond = [&](const Vec32& q) { return sign_of(dot(across, subtract(q, p(0)))) != 0; };
    if (!add_where(across, beyond) && !add_where(negate(across), beyond)) return false;
  }
  return true;
}

void PenetrationSearch::start() {
  const auto p = [&](int i) -> const Vec32& { return polytope_.vertex[i].difference; };
  const Vec64 normal = cross(subtract(p(1), p(0)), subtract(p(2), p(0)));
  const int volume = sign_of(dot(normal, subtract(p(3), p(0))));
  DETENT_VERIFY_RANGE(volume != 0);
  const int i = volume < 0 ? 1 : 2, j = volume < 0 ? 2 : 1;
  polytope_.add_face(0, i, j);
  polytope_.add_face(0, 3, i);
  polytope_.add_face(i, 3, j);
  polytope_.add_face(j, 3, 0);
}

void PenetrationSearch::expand() {
  const bool curved = is_curved(a_) || is_curved(b_);
  uint8_t start_a = 0, start_b = 0;
  for (;;) {
    const Face face = polytope_.nearest_face(lower_);
    if (curved && support_ - lower_ <= k_penetration_gap * k_ulp) return;
    const Vec64 normal = polytope_.normal_of(face);
    const Vec32 direction = scaled_to_30_bits(normal);
    SupportPoint on_a = support(a_, negate(direction), start_a), on_b = support(b_, direction, start_b);
    start_a = on_a.core.feature;
    start_b = on_b.core.feature;
    ++supports_;
    Vertex vertex = vertex_of(on_a, on_b);
    if (!polytope_.faces(face, vertex.difference)) {
      exact_support(a_, negate(normal), on_a);
      exact_support(b_, normal, on_b);
      vertex = vertex_of(on_a, on_b);
    }
    const bool beyond = polytope_.faces(face, vertex.difference);
    const int64_t support = beyond ? plane_distance(normal, vertex.difference) : face.distance;
    if (support < support_ || !beyond) {
      support_ = support;
      best_ = face;
      outward_ = unit_vector_raw(direction);
    }
    if (!beyond) return;  // the face lies on the boundary of the difference
    if (polytope_.vertex_count == k_vertices_max) {
      capped_ = true;
      return;
    }
    polytope_.vertex[polytope_.vertex_count++] = vertex;
    polytope_.grow();
  }
}

/// Returns part / whole in Q30, clamped to [0, 1]. Range: whole > 0.
int64_t fraction(Int128 part, Int128 whole) {
  if (sign_of(part) <= 0) return 0;
  if (!(part < whole)) return k_ulp;
  const int length = bit_length_128(magnitude_128(whole));
  const int n = length > 32 ? length - 32 : 0;
  const auto leading = [n](Int128 value) { return n == 0 ? value.low_signed() : value.round_shift(n); };
  return leading(part) * k_ulp / leading(whole);
}

Penetration PenetrationSearch::answer() const {
  const Face& face = best_;
  const Vec64 normal = polytope_.normal_of(face);
  const Int128 whole = dot(normal, normal);
  int64_t rest = k_ulp;
  int64_t weight[3];
  for (int i = 0; i < 2; ++i) {
    const Vec64 part = cross(polytope_.at(face, i + 1), polytope_.at(face, i == 0 ? 2 : 0));
    const int64_t w = fraction(dot(normal, part), whole);
    weight[i] = w > rest ? rest : w;
    rest -= weight[i];
  }
  weight[2] = rest;
  Vec64 on_a = {0, 0, 0}, difference = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const Vertex& v = polytope_.vertex[face.vertex[i]];
    on_a = add(on_a, {weight[i] * v.on_a.x, weight[i] * v.on_a.y, weight[i] * v.on_a.z});
    difference = add(difference, {weight[i] * v.difference.x, weight[i] * v.difference.y, weight[i] * v.difference.z});
  }
  const Vec32 point_a = round_shift(on_a, 30);
  const int64_t depth = (support_ + k_ulp - 1) >> 30;
  const int64_t lower = lower_ >> 30;
  return {negate(outward_),
          static_cast<int32_t>(depth > 0 ? depth : 0),
          static_cast<int32_t>(lower > 0 ? lower : 0),
          point_a,
          subtract(add(point_a, round_shift(difference, 30)), offset_),
          supports_,
          capped_};
}

Penetration PenetrationSearch::flat(const Simplex& simplex, const Vec64& across) const {
  int32_t weight[4];
  simplex.weights(weight);
  Vec64 on_a = {0, 0, 0};
  for (int i = 0; i < simplex.count(); ++i) {
    const Vec32 p = a_.point(simplex.vertex(i).a.local);
    on_a = add(on_a, {int64_t{weight[i]} * p.x, int64_t{weight[i]} * p.y, int64_t{weight[i]} * p.z});
  }
  const Vec32 point = round_shift(on_a, 30);
  const Vec32 normal = unit_vector_raw(scaled_to_30_bits(across));
  return {dot(normal, offset_) < 0 ? negate(normal) : normal, 0, 0, point, subtract(point, offset_), supports_, false};
}

Penetration PenetrationSearch::run(const Simplex& simplex) {
  Vec64 across;
  if (!complete(simplex, across)) return flat(simplex, across);
  start();
  expand();
  return answer();
}

Penetration half_space_penetration(const Placed& a, const Placed& b, const Vec32& offset) {
  const bool plane_is_a = is_half_space(a);
  const Vec32 up = (plane_is_a ? a : b).rotation.column[1];
  const Vec32 normal = plane_is_a ? up : negate(up);
  const Vec32 displacement = plane_is_a ? offset : negate(offset);
  const Vec32 deepest = support(plane_is_a ? b : a, negate(up)).point;
  const int64_t height = dot(up, add(displacement, deepest));  // above the plane, Q30
  const int64_t depth = height < 0 ? (-height + k_ulp - 1) >> 30 : 0;
  const int64_t below = round_shift_64(height, 30);
  const Vec32 foot = subtract(add(displacement, deepest), scaled_vector(up, below));
  return {normal,
          static_cast<int32_t>(depth),
          static_cast<int32_t>(depth),
          plane_is_a ? foot : deepest,
          plane_is_a ? deepest : foot,
          1,
          false};
}

}  // namespace

Penetration penetration(const Placed& a, const Placed& b, const Vec32& offset, const Simplex& simplex) {
  if (is_half_space(a) || is_half_space(b)) return half_space_penetration(a, b, offset);
  return PenetrationSearch(a, b, offset).run(simplex);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
