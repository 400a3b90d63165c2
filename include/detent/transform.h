#pragma once
#include <detent/math.h>

/// Between a body's axes and the world's. Range: lengths below 2^16 m, angles to 2^16 rad; rotations of length 1 within
/// 2^-10. These touch no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The place in the world of a point given from a body's centre of mass, m, in its axes. Rounding: to a position's
/// step; held to the world's extent.
Position to_world(const Pose& pose, const Vec3<Real>& point);
/// The reverse: from the centre of mass, m, in the body's axes. Range: within 2^15 m of the body in each coordinate.
Vec3<Real> to_local(const Pose& pose, const Position& point);
/// A direction or a vector, from the body's axes to the world's.
Vec3<Real> vector_to_world(const Quat& rotation, const Vec3<Real>& vector);
/// The reverse of vector_to_world().
Vec3<Real> vector_to_local(const Quat& rotation, const Vec3<Real>& vector);
/// `rotation`, and then a turn by |turn| rad about the world's direction of `turn`. Of length 1.
Quat turned_by(const Quat& rotation, const Vec3<Real>& turn);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
