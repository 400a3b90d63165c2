#include "toi/screw_motion.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_tangent_max = int64_t{4} << k_tangent_bits;

/// g x v, with g in Q28. Rounding: to nearest.
Vec64 cross_tangent(const Vec32& g, const Vec64& v) {
  const auto minor = [](int32_t a, int64_t p, int32_t b, int64_t q) {
    return (Int128::product_narrow(p, a) - Int128::product_narrow(q, b)).round_shift(k_tangent_bits);
  };
  return {minor(g.y, v.z, g.z, v.y), minor(g.z, v.x, g.x, v.z), minor(g.x, v.y, g.y, v.x)};
}

constexpr Quat32 conjugate(const Quat32& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// The tangent of half the rotation angle from one pose to another, along the rotation axis. False if it is above 4.
bool tangent_between(const Quat32& from, const Quat32& to, Vec32& tangent) {
  const Quat32 rotation_vector = multiply(to, conjugate(from));
  const int64_t w = rotation_vector.w;
  if (magnitude_64(w) < uint64_t{1} << 27) return false;
  const auto part = [w](int32_t v) { return (int64_t{v} << k_tangent_bits) / w; };
  const Vec64 g = {part(rotation_vector.x), part(rotation_vector.y), part(rotation_vector.z)};
  if (largest_component(g) > k_tangent_max) return false;
  tangent = {static_cast<int32_t>(g.x), static_cast<int32_t>(g.y), static_cast<int32_t>(g.z)};
  return dot(tangent, tangent) <= k_tangent_max * k_tangent_max;
}

}  // namespace

RelativePose relative_pose(const Quat32& a, const Quat32& b, const Vec64& offset) {
  const Quat32 back = conjugate(a);
  return {multiply(back, b), rotated(matrix_from(back), offset)};
}

Vec64 ScrewMotion::turned(const Vec64& y, int64_t time, int64_t inverse_weight) const {
  const Vec64 once = cross_tangent(tangent, y), twice = cross_tangent(tangent, once);
  return over_time(over_time(add(once, over_time(twice, time)), time), inverse_weight);
}

Vec64 ScrewMotion::at(const Vec64& x, int64_t time, int64_t inverse_weight) const {
  const Vec64 moved = over_time(displacement, time);
  const Vec64 y = add(add(x, x), add(moved, negate(displacement)));
  return add(add(first, x), add(moved, turned(y, time, inverse_weight)));
}

int64_t ScrewMotion::tangent_length() const {
  return static_cast<int64_t>(square_root_nearest(Words128{0, static_cast<uint64_t>(square)})) + 1;
}

int64_t ScrewMotion::bend(int64_t radius) const {
  // The second derivative of a point's path is at most 4 g^2 r, where r is the distance of the point from the screw
  // axis; and g r <= |d| sqrt(1 + g^2) / 2 + g |x|. The symbols g, d and x are those of ScrewMotion.
  const int64_t far = length_above(displacement), g = tangent_length();
  const auto times_g = [g](int64_t value) { return Int128::product(value, g).round_shift(k_tangent_bits) + 1; };
  const int64_t swing = times_g(times_g(radius)), drift = times_g(far + times_g(far));
  return (swing >> 1) + (drift >> 2) + 2;
}

Status screw_between(const RelativePose& start, const RelativePose& end, ScrewMotion& screw) {
  if (!in_range(start.position, k_screw_range_bits + 1) || !in_range(end.position, k_screw_range_bits + 1) ||
      !tangent_between(start.rotation, end.rotation, screw.tangent)) {
    return Status::out_of_range;
  }
  screw.first = start.position;
  screw.displacement = add(end.position, negate(start.position));
  screw.square = dot(screw.tangent, screw.tangent);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
