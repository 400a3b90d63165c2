#include <detent/numbers.h>

#include "base/float_environment.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Position to_world(const Pose& pose, const Vec3<Real>& point) {
  const FloatEnvironment environment;
  return moved(pose.position, rotate(pose.rotation, point));
}

Vec3<Real> to_local(const Pose& pose, const Position& point) {
  const FloatEnvironment environment;
  return rotate_inverse(pose.rotation, real_difference(point, pose.position));
}

Vec3<Real> vector_to_world(const Quat& rotation, const Vec3<Real>& vector) {
  const FloatEnvironment environment;
  return rotate(rotation, vector);
}

Vec3<Real> vector_to_local(const Quat& rotation, const Vec3<Real>& vector) {
  const FloatEnvironment environment;
  return rotate_inverse(rotation, vector);
}

Quat rotated_by(const Quat& rotation, const Vec3<Real>& rotation_vector) {
  const FloatEnvironment environment;
  return normalise(multiply(rotation_from_vector(rotation_vector), rotation));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
