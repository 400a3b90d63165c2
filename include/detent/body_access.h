#pragma once
#include <detent/world.h>

/// Getters and setters for the properties that a body's definition sets. Setters wake the body and the sleeping bodies
/// that are in contact with it or joined to it.
/// Errors of all getters: bad_id. Errors of all setters: bad_id, and those that each setter lists.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A definition that creates the same body with its current pose and velocity. An inertia set by set_inertia() is not
/// part of it. Numbers are those that the state stores: rounded, by less than 2^-30 of their size. For a non-dynamic
/// body that never had a mass, `mass` is 0.
Status get_body_def(const World& world, BodyId id, BodyDef& def);
/// BodyDef::type.
Status get_type(const World& world, BodyId id, BodyType& type);
/// BodyDef::shape. Sizes that the shape's type does not use are those of a default shape.
Status get_shape(const World& world, BodyId id, Shape& shape);
/// BodyDef::material.
Status get_material(const World& world, BodyId id, Material& material);
/// BodyDef::linear_damping and angular_damping, 1/s.
Status get_damping(const World& world, BodyId id, Real& linear, Real& angular);
/// BodyDef::gravity_scale.
Status get_gravity_scale(const World& world, BodyId id, Real& scale);
/// BodyDef::rotation_locks.
Status get_rotation_locks(const World& world, BodyId id, uint32_t& locks);
/// BodyDef::sensor.
Status get_sensor(const World& world, BodyId id, bool& sensor);
/// The moments of inertia about the body's axes, kg m^2; 0 for fixed and kinematic bodies and about locked axes.
Status get_inertia(const World& world, BodyId id, Vec3<Scaled>& inertia);
/// The velocity, m/s, world, of the point of the body at `arm` from its centre of mass. `arm`: m, world axes; each
/// component within twice the bounding radius. Errors: out_of_range.
Status get_velocity_at(const World& world, BodyId id, const Vec3<Real>& arm, Vec3<Real>& velocity);

/// Changes the type of the body and ends its contacts at once. Position, velocity and angular velocity stay, but a body
/// that becomes fixed stops, and a body that becomes dynamic loses the angular velocity about its locked axes. Forces
/// that have not acted yet are lost. A body that becomes dynamic gets the mass that it last had or was created with; if
/// it never had one, the mass at 1000 kg/m^3.
/// Errors: bad_argument (`type` is no BodyType; or `type` is dynamic and the shape is a half-space, a terrain, or a
/// hull in its source frame), out_of_range (the mass, or angular velocity x bounding radius).
Status set_type(World& world, BodyId id, BodyType type);
/// Changes the shape of the body and ends its contacts at once. Mass, velocity and angular velocity stay; set_density()
/// sets the mass from the new volume.
/// Errors: as create_body() with this shape, and out_of_range (angular velocity x bounding radius).
Status set_shape(World& world, BodyId id, const Shape& shape);
/// Sets the mass, kg, [2^-60, 2^60]. Velocity and angular velocity stay. A body that is not dynamic stores the mass for
/// a later set_type(). Errors: out_of_range.
Status set_mass(World& world, BodyId id, Scaled mass);
/// Sets the moments of inertia about the body's axes, kg m^2, in place of those of its shape. Range: [2^-15 mass r^2,
/// mass r^2], where r is the power of two, m, above the bounding radius and at most twice that radius. The value about
/// a locked axis has no effect, but must be in (0, mass r^2]. The angular velocity stays. set_mass() scales the moments
/// with the mass; set_shape(), set_type() and set_rotation_locks() restore those of the shape.
/// Errors: bad_argument (the body is not dynamic), out_of_range.
Status set_inertia(World& world, BodyId id, const Vec3<Scaled>& inertia);
/// As set_mass(), with the mass of the shape's volume at `density`, kg/m^3, [2^-60, 2^60].
/// Errors: out_of_range (the density or the mass), bad_argument (a half-space or a terrain).
Status set_density(World& world, BodyId id, Scaled density);
/// BodyDef::material. Errors: bad_argument (restitution_rule is no RestitutionRule), out_of_range.
Status set_material(World& world, BodyId id, const Material& material);
/// BodyDef::linear_damping and angular_damping, 1/s, [0, 1024]. Errors: out_of_range.
Status set_damping(World& world, BodyId id, Real linear, Real angular);
/// BodyDef::gravity_scale, [-1024, 1024]. Errors: out_of_range.
Status set_gravity_scale(World& world, BodyId id, Real scale);
/// BodyDef::rotation_locks. The angular velocity about the other axes stays. An inertia set by set_inertia() is
/// replaced by that of the shape. Errors: bad_argument (other bits than those of k_rotation_locks_all).
Status set_rotation_locks(World& world, BodyId id, uint32_t locks);
/// BodyDef::sensor. A change ends the body's contacts at once and removes it from the stored sensor overlaps, as a
/// sensor and as a sensed body; no leave events are written for that. Errors: pool_full (Capacity::sensed is 0),
/// feature_missing.
Status set_sensor(World& world, BodyId id, bool sensor);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
