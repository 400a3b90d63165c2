#pragma once
#include <detent/world.h>

#include "state/view.h"

/// Each of these functions checks and sets one kind of property of a body. The calls that create and change bodies use
/// them.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Returns ok if a body of this type may have the shape. Errors: bad_argument; for shapes with an asset also
/// out_of_range and asset_missing.
Status suits(const World& world, ShapeType shape, uint32_t asset, BodyType type);
/// Sets the shape properties of `properties` for a body of this type. Errors: bad_argument, out_of_range,
/// asset_missing, feature_missing.
Status set_body_shape(const World& world, const Shape& shape, BodyType type, BodyProperties& properties);
/// Sets `inverse_inertia` from the shape, the type and the rotation locks of the body. Errors: out_of_range.
Status set_body_inverse_inertia(const World& world, BodyProperties& properties);
/// Sets `inverse_inertia` of a dynamic body from the moments of inertia about its axes, kg m^2. Errors: out_of_range.
Status set_body_inertia(const Vec3<Scaled>& inertia, BodyProperties& properties);
/// Sets the mass from the volume of the shape and `density`, kg/m^3. Errors: out_of_range.
Status set_body_density(const World& world, Scaled density, BodyProperties& properties);
/// Each of the next four functions checks and sets the properties that its name gives. Errors: bad_argument,
/// out_of_range.
Status set_body_material(const Material& material, BodyProperties& properties);
Status set_body_damping(Real linear, Real angular, BodyProperties& properties);
Status set_body_gravity_scale(Real scale, BodyProperties& properties);
Status set_body_rotation_locks(uint32_t locks, BodyProperties& properties);

/// Makes a pose from a position and a rotation, and normalises the rotation. Errors: out_of_range, not_normalised.
Status make_pose(const Position& position, const Quat& rotation, BodyPose& pose);
/// Sets the motion of a body from a velocity, m/s, and an angular velocity, rad/s, both in world axes. Errors:
/// bad_argument, out_of_range.
Status make_motion(const BodyProperties& properties, const Quat& rotation, const Vec3<Real>& velocity,
                   const Vec3<Real>& angular_velocity, BodyMotion& motion);

/// Whether the velocity, angular momentum and angular velocity of a dynamic body are in the ranges that the state
/// allows.
bool speeds_fit(const BodyProperties& properties, const Quat& rotation, const BodyMotion& motion);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
