#pragma once
#include <detent/math.h>

/// Transforms between a body's axes and the world's. Range: lengths below 2^16 m, angles to 2^16 rad; rotations of
/// length 1 within 2^-10. They need no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Transforms a point, given from a body's centre of mass, m, in the body's axes, to a position in the world. Rounding:
/// to a step of a position. Overflow: clamped to the range of a position.
Position to_world(const Pose& pose, const Vec3<Real>& point);
/// Transforms a position in the world to a point from the body's centre of mass, m, in the body's axes. Range: within
/// 2^15 m of the body in each coordinate.
Vec3<Real> to_local(const Pose& pose, const Position& point);
/// Transforms a vector from the body's axes to the world's.
Vec3<Real> vector_to_world(const Quat& rotation, const Vec3<Real>& vector);
/// Transforms a vector from the world's axes to the body's.
Vec3<Real> vector_to_local(const Quat& rotation, const Vec3<Real>& vector);
/// `rotation` followed by the rotation vector `rotation_vector`: |turn| rad about the direction of `rotation_vector`,
/// world. Of length 1.
Quat rotated_by(const Quat& rotation, const Vec3<Real>& rotation_vector);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
