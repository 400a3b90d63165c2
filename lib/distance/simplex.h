#pragma once
#include "base/cycle.h"
#include "distance/support.h"

/// The simplex of GJK on integers. Exact signs decide which of its faces, edges and vertices is nearest to the origin,
/// so that GJK cannot cycle and cannot report touching cores as separate.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A vertex of the Minkowski difference B - A. Range: |difference| < 2^30.
struct SimplexVertex {
  Vec32 difference;
  CorePoint a, b;  ///< the points of A's and B's core whose difference (b - a) this vertex is
};

/// Up to four vertices. Either their convex hull contains the origin, or all of them have a positive barycentric weight
/// in the hull's point nearest to the origin.
class Simplex {
 public:
  int count() const { return count_; }
  const SimplexVertex& vertex(int i) const { return vertex_[i]; }
  /// Whether the hull of the vertices contains the origin.
  bool holds_origin() const { return holds_origin_; }

  void clear() {
    count_ = 0;
    holds_origin_ = false;
  }
  /// Stores a vertex for gjk() to start from; gjk() uses only its core points.
  void start(const SimplexVertex& vertex) {
    if (count_ < 4) vertex_[count_++] = vertex;
  }
  /// Adds `vertex` and drops the vertices that the new nearest point (the simplex's point nearest to the origin) does
  /// not need. Returns false and changes nothing unless `vertex` lies strictly on the origin's side of a plane: the
  /// plane through the present nearest point v that is perpendicular to v. So each insertion brings the nearest point
  /// strictly nearer. Two polytopes have finitely many vertices, so every sequence of insertions ends. Range: not
  /// holds_origin().
  bool insert(const SimplexVertex& vertex);

  /// A vector from the origin towards the nearest point. Its largest component is within [2^29, 2^30] in magnitude.
  /// Rounding: relative 2^-29. Range: not holds_origin(), count > 0.
  Vec32 direction() const;

  /// Returns v . p times a positive number, exactly, where v is the point of the simplex nearest to the origin. Range:
  /// not holds_origin(), |p| < 2^30.
  Int128 support(const Vec32& p) const;

  /// The weights of the vertices in the nearest point, Q30. Their sum is 2^30 within rounding. Arbitrary if the simplex
  /// contains the origin.
  void weights(int32_t (&weight)[4]) const;

 private:
  bool is_nearer(const Vec32& difference) const;
  void reduce_edge();
  void reduce_triangle();
  void reduce_tetrahedron();
  bool edge_holds(const Vec32& a, const Vec32& b);
  bool triangle_holds(const Vec32& a, const Vec32& b, const Vec32& c);
  void take_triangle(int a, int b, int c);
  void keep(int a);
  void keep(int a, int b);
  void keep(int a, int b, int c);

  SimplexVertex vertex_[4];
  int count_ = 0;
  bool holds_origin_ = false;
  // Of a simplex with two vertices (an edge): `edge_` runs from vertex 1 to vertex 0; `edge_square_` is its squared
  // length. Of a simplex with three vertices: `normal_` is perpendicular to the triangle and points from the origin
  // towards it.
  Vec32 edge_;
  int64_t edge_square_;
  int64_t along_;  // nearest point's distance from vertex 1 times the edge's length, in (0, edge_square_)
  Vec64 normal_;
};

// Bit widths. For vertices a and b, |a| < 2^30 and |b - a| < 2^31. Dot and cross products are below 2^62 (64 bits). A
// determinant is below 2^92, the weight of a vertex in a triangle below 2^122, and the test of a vertex against an edge
// below 2^125 (128 bits).

/// Returns the sign of v . (y - a), where v is the point nearest to the origin on the edge that starts at a. `square`
/// and `along`: as Simplex::edge_square_ and along_. The sum whose sign is taken is v . (y - a) times `square`.
inline int side_of_edge(const Vec32& a, const Vec32& edge, int64_t square, int64_t along, const Vec32& y) {
  const Vec32 displacement = subtract(y, a);
  return sign_of(Int128::product(square, dot(a, displacement)) + Int128::product(along, dot(edge, displacement)));
}

/// Returns value 2^-n. Range: the result fits 64 bits. Rounding: to nearest, ties up.
inline int64_t high_part(Int128 value, int n) { return n == 0 ? value.low_signed() : value.round_shift(n); }

inline bool Simplex::insert(const SimplexVertex& vertex) {
  DETENT_VERIFY_RANGE(!holds_origin_);
  if (count_ > 0 && !is_nearer(vertex.difference)) return false;
  vertex_[count_++] = vertex;
  if (count_ == 1)
    keep(0);
  else if (count_ == 2)
    reduce_edge();
  else if (count_ == 3)
    reduce_triangle();
  else
    reduce_tetrahedron();
  return true;
}

inline bool Simplex::is_nearer(const Vec32& difference) const {
  const Vec32& a = vertex_[count_ - 1].difference;
  const Vec32 displacement = subtract(difference, a);
  if (count_ == 1) return dot(a, displacement) < 0;
  if (count_ == 2) return side_of_edge(a, edge_, edge_square_, along_, difference) < 0;
  return sign_of(dot(normal_, displacement)) < 0;
}

inline void Simplex::keep(int a) {
  vertex_[0] = vertex_[a];
  count_ = 1;
  holds_origin_ = is_zero(vertex_[0].difference);
}

inline void Simplex::keep(int a, int b) {
  const SimplexVertex newest = vertex_[a];
  vertex_[0] = vertex_[b];
  vertex_[1] = newest;
  count_ = 2;
  holds_origin_ = is_zero(cross(edge_, vertex_[1].difference));
}

inline void Simplex::keep(int a, int b, int c) {
  const SimplexVertex newest = vertex_[a], middle = vertex_[b];
  vertex_[0] = vertex_[c];
  vertex_[1] = middle;
  vertex_[2] = newest;
  count_ = 3;
}

/// Whether the point nearest to the origin on the line through a and b lies strictly between a and b. Sets edge_,
/// edge_square_ and along_.
inline bool Simplex::edge_holds(const Vec32& a, const Vec32& b) {
  edge_ = subtract(b, a);
  edge_square_ = dot(edge_, edge_);
  along_ = -dot(a, edge_);
  return along_ > 0 && along_ < edge_square_;
}

inline void Simplex::reduce_edge() {
  if (edge_holds(vertex_[1].difference, vertex_[0].difference)) return keep(1, 0);
  keep(1);
}

/// Whether the point nearest to the origin in the plane of the triangle lies within the triangle. The corners are the
/// newest vertex a, and b and c. The weight of a is known to be positive, so the other two weights decide. Sets
/// normal_.
inline bool Simplex::triangle_holds(const Vec32& a, const Vec32& b, const Vec32& c) {
  normal_ = cross(subtract(b, a), subtract(c, a));
  return sign_of(dot(cross(a, b), normal_)) > 0 && sign_of(dot(cross(c, a), normal_)) > 0;
}

inline void Simplex::take_triangle(int a, int b, int c) {
  const int side = sign_of(dot(normal_, vertex_[a].difference));
  if (side < 0) normal_ = negate(normal_);
  keep(a, b, c);
  holds_origin_ = side == 0;
}

inline void Simplex::reduce_triangle() {
  const Vec32 &a = vertex_[2].difference, &b = vertex_[1].difference, &c = vertex_[0].difference;
  normal_ = cross(subtract(b, a), subtract(c, a));
  const bool beyond_ab = sign_of(dot(cross(a, b), normal_)) <= 0;
  const bool beyond_ac = sign_of(dot(cross(c, a), normal_)) <= 0;
  if (!beyond_ab && !beyond_ac) return take_triangle(2, 1, 0);
  if (beyond_ab && edge_holds(a, b)) return keep(2, 1);
  if (beyond_ac && edge_holds(a, c)) return keep(2, 0);
  keep(2);
}

inline void Simplex::reduce_tetrahedron() {
  const Vec32& a = vertex_[3].difference;
  const Vec32 ab = subtract(vertex_[2].difference, a), ac = subtract(vertex_[1].difference, a),
              ad = subtract(vertex_[0].difference, a);
  const Vec64 normals[3] = {cross(ab, ac), cross(ac, ad), cross(ad, ab)};
  const int volume = sign_of(dot(normals[0], ad));
  bool outside = volume == 0;
  for (int i = 0; i < 3; ++i) {
    // The origin is outside a face if the origin and the fourth vertex lie on opposite sides of it. A flat tetrahedron
    // has no inside.
    const int side = sign_of(dot(normals[i], a));
    if (volume != 0 && side != volume) continue;
    outside = true;
    const int b = 2 - i, c = i == 2 ? 2 : 1 - i;
    if (triangle_holds(a, vertex_[b].difference, vertex_[c].difference)) return take_triangle(3, b, c);
  }
  if (!outside) {
    holds_origin_ = true;
    return;
  }
  for (int b = 2; b >= 0; --b) {
    if (!edge_holds(a, vertex_[b].difference)) continue;
    const Vec32& c = vertex_[next_of_three(b)].difference;
    const Vec32& d = vertex_[previous_of_three(b)].difference;
    if (side_of_edge(a, edge_, edge_square_, along_, c) >= 0 && side_of_edge(a, edge_, edge_square_, along_, d) >= 0) {
      return keep(3, b);
    }
  }
  keep(3);
}

inline Vec32 Simplex::direction() const {
  const Vec32& a = vertex_[count_ - 1].difference;
  switch (count_) {
    case 1:
      return scaled_to_30_bits(a);
    case 2:
      return scaled_to_30_bits(cross(scaled_to_30_bits(cross(edge_, a)), edge_));
    default:
      return scaled_to_30_bits(normal_);
  }
}

inline Int128 Simplex::support(const Vec32& p) const {
  const Vec32& a = vertex_[count_ - 1].difference;
  if (count_ == 1) return Int128::from(dot(a, p));
  if (count_ == 2) return Int128::product(edge_square_, dot(a, p)) + Int128::product(along_, dot(edge_, p));
  return dot(normal_, p);
}

inline void Simplex::weights(int32_t (&weight)[4]) const {
  for (int32_t& w : weight) w = 0;
  if (count_ == 2) {
    const int n = bit_length_64(static_cast<uint64_t>(edge_square_)) > 32
                      ? bit_length_64(static_cast<uint64_t>(edge_square_)) - 32
                      : 0;
    weight[0] = static_cast<int32_t>(((along_ >> n) << 30) / ((edge_square_ >> n) > 0 ? edge_square_ >> n : 1));
    weight[1] = static_cast<int32_t>(k_one_64 - weight[0]);
    return;
  }
  if (count_ == 3) {
    const Vec32 &a = vertex_[2].difference, &b = vertex_[1].difference, &c = vertex_[0].difference;
    const Vec64 normal = cross(subtract(b, a), subtract(c, a));
    const Int128 total = dot(normal, normal);
    const int length = bit_length_128(magnitude_128(total));
    const int n = length > 32 ? length - 32 : 0;
    const int64_t whole = high_part(total, n);
    weight[0] = static_cast<int32_t>((high_part(dot(cross(a, b), normal), n) << 30) / whole);
    weight[1] = static_cast<int32_t>((high_part(dot(cross(c, a), normal), n) << 30) / whole);
    weight[2] = static_cast<int32_t>(k_one_64 - weight[0] - weight[1]);
    return;
  }
  weight[0] = static_cast<int32_t>(k_one_64);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
