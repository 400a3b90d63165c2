#include <detent/numbers.h>

#include "base/float_environment.h"
#include "math/float_bits.h"
#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

#if defined(DETENT_F64)
float to_float(double value) {
  const FloatParts parts = float_parts(value);
  return float_from_parts<float>(parts.mantissa, parts.exponent, parts.negative);
}
float relative(Coord a, Coord camera) { return to_float(a - camera); }
/// Interpolates between two coordinates. Returns exactly `to` at alpha = 1, and exactly `from` if `from` equals `to`.
Coord between(Coord from, Coord to, Unit alpha) { return alpha == 1.0 ? to : from + (to - from) * alpha; }
#else
/// Returns a - camera, m. The exact difference, of up to 65 bits, is rounded once.
float relative(Coord a, Coord camera) {
  const bool negative = a < camera;
  const uint64_t low = static_cast<uint64_t>(int64_t{negative ? a.raw : camera.raw});
  const uint64_t high = static_cast<uint64_t>(int64_t{negative ? camera.raw : a.raw});
  return float_from_parts<float>(high - low, -Coord::k_frac, negative);
}
Coord between(Coord from, Coord to, Unit alpha) {
#if DETENT_FIXED
  const int32_t weight = alpha.raw;
#else
  bool saturated = false;
  const int32_t weight = static_cast<int32_t>(integer_from_float(alpha, 30, saturated));
#endif
  const int64_t step = Int128::narrow_sum<30>(subtract_wrapped(to.raw, from.raw), weight);
  return Coord::from_raw(static_cast<Coord::Raw>(add_wrapped(from.raw, step)));
}
#endif
#if DETENT_FIXED
float to_float(Unit value) { return float_from_integer<float>(value.raw, -Unit::k_frac); }
#elif defined(DETENT_F32)
float to_float(Unit value) { return value; }
#endif

}  // namespace

CameraRelative relative_to_camera(const Pose& pose, const Position& camera) {
  const FloatEnvironment environment;
  const Position& p = pose.position;
  const Quat& q = pose.rotation;
  return {{relative(p.x, camera.x), relative(p.y, camera.y), relative(p.z, camera.z)},
          {to_float(q.x), to_float(q.y), to_float(q.z), to_float(q.w)}};
}

Pose interpolate(const Pose& from, const Pose& to, Unit alpha) {
  const FloatEnvironment environment;
  const Quat& a = from.rotation;
  const Quat& b = to.rotation;
  const Unit rest = Unit(1.0) - alpha;
  const Unit cosine = dot(Vec3<Unit>{a.x, a.y, a.z}, Vec3<Unit>{b.x, b.y, b.z}) + a.w * b.w;
  const Unit weight = cosine < Unit(0.0) ? -alpha : alpha;
  const auto mean = [rest, weight](Unit p, Unit q) { return p * rest + q * weight; };
  const Position& p = from.position;
  const Position& q = to.position;
  return {{between(p.x, q.x, alpha), between(p.y, q.y, alpha), between(p.z, q.z, alpha)},
          normalise_any({mean(a.x, b.x), mean(a.y, b.y), mean(a.z, b.z), mean(a.w, b.w)})};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
