#include "toi_methods/feature_candidates.h"

#include "distance/pair.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Vec32 unit_or_zero(const Vec64& v) { return is_zero(v) ? Vec32{0, 0, 0} : unit_vector_raw(scaled_to_30_bits(v)); }
Vec32 turned(const Matrix32& rotation, const Vec32& v) { return round_shift(multiply(rotation, v), 30); }

}  // namespace

bool may_touch(const EdgeFan& a, const EdgeFan& b, const StepPart& part) {
  // The common normal of the two edges is n = s a x b, where a and b are their directions and s is a sign. It lies
  // between the face normals of A, n = x left + y right with x, y >= 0, only if s left.b >= 0 >= s right.b. The same
  // condition with a and b exchanged holds for -n = s b x a and the face normals of B.
  const int64_t slack = (part.angle + CandidateSide::k_unit_error) << 30;
  const int64_t left_a = dot(a.left, b.along), right_a = dot(a.right, b.along);
  const int64_t left_b = dot(b.left, a.along), right_b = dot(b.right, a.along);
  const bool plus = left_a >= -slack && right_a <= slack && left_b >= -slack && right_b <= slack;
  const bool minus = left_a <= slack && right_a >= -slack && left_b <= slack && right_b >= -slack;
  if (!plus && !minus) return false;
  const Vec32 normal = round_shift(cross(a.along, b.along), 30);
  return (plus && part.approaches(normal)) || (minus && part.approaches(negate(normal)));
}

Vec64 CandidateSide::corner(uint32_t vertex) const {
  const Vec32 v = polytope_.vertex(vertex);
  const int n = k_metre_bits - 30 + convex_.exponent;  // >= 2
  return {int64_t{v.x} << n, int64_t{v.y} << n, int64_t{v.z} << n};
}

int64_t CandidateSide::metres(int64_t along) const {
  const int n = 60 - k_metre_bits - convex_.exponent;  // -1 for the largest exponent
  return n < 0 ? along << -n : along >> n;
}

void CandidateSide::choose(const Vec32 (&direction)[2], const int64_t (&least)[2]) {
  direction_[0] = direction[0];
  direction_[1] = direction[1];
  count_ = 0;
  for (uint32_t i = 0; i < polytope_.vertex_count(); ++i) {
    const Vec32 v = polytope_.vertex(i);
    counts_[i] = metres(dot(direction[0], v)) >= least[0] || metres(dot(direction[1], v)) >= least[1];
    if (counts_[i]) chosen_[count_++] = static_cast<uint8_t>(i);
  }
}

bool CandidateSide::fan(uint32_t from, uint32_t to, const Matrix32& rotation, EdgeFan& fan) const {
  const EdgeFaces faces = polytope_.faces(from, to);
  if (faces.flat) return false;
  const Vec32 displacement = subtract(polytope_.vertex(to), polytope_.vertex(from));
  fan.from = static_cast<uint8_t>(from);
  fan.to = static_cast<uint8_t>(to);
  fan.along = turned(rotation, unit_or_zero({displacement.x, displacement.y, displacement.z}));
  fan.left = turned(rotation, unit_or_zero(faces.left));
  fan.right = turned(rotation, unit_or_zero(faces.right));
  return true;
}

int64_t separation(const PlacedPair& pair, const Vec32& direction, const CandidateSide& a, const CandidateSide& b) {
  return dot(pair.offset, direction).round_shift(30) - a.extent(in_axes(pair.a, direction)) -
         b.extent(in_axes(pair.b, negate(direction)));
}

bool choose(const StepPart& part, const Vec32& normal, CandidateSide& a, CandidateSide& b, int64_t (&apart)[2]) {
  // Points move on chords here. Along a fixed direction, the minimum over such points is concave in time. The amount by
  // which a point is beyond this minimum is therefore convex, and greatest at the beginning or at the end.
  const PlacedPair* const end[2] = {&part.begin, &part.end};
  Vec32 of_a[2], of_b[2];
  int64_t least_a[2], least_b[2];
  bool any = false;
  for (int i = 0; i < 2; ++i) {
    of_a[i] = in_axes(end[i]->a, normal);
    of_b[i] = in_axes(end[i]->b, negate(normal));
    apart[i] = dot(end[i]->offset, normal).round_shift(30) - part.bend;
    const int64_t extent_a = a.extent(of_a[i]), extent_b = b.extent(of_b[i]);
    least_a[i] = apart[i] - extent_b;
    least_b[i] = apart[i] - extent_a;
    any = any || extent_a >= least_a[i];
  }
  if (!any) return false;
  a.choose(of_a, least_a);
  b.choose(of_b, least_b);
  return true;
}

Vec32 face_normal(const Polytope& polytope, uint32_t i, uint32_t j, uint32_t k, const Matrix32& rotation) {
  const Vec32 p = polytope.vertex(i);
  const Vec64 across = cross(subtract(polytope.vertex(j), p), subtract(polytope.vertex(k), p));
  return turned(rotation, unit_or_zero(across));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
