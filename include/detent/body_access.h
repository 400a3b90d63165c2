#pragma once
#include <detent/world.h>

/// Reading and changing what a body's definition set. Setters wake the body and what sleeps against it.
/// Errors of all getters: bad_id; of all setters: bad_id, and what they name.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A definition that creates the same body here and now, but for an inertia that was set. Numbers come back as the state keeps them: rounded by less
/// than 2^-30 of their size; of a non-dynamic body that never had a mass, `mass` is 0.
Status get_body_def(const World& world, BodyId id, BodyDef& def);
/// BodyDef::type.
Status get_type(const World& world, BodyId id, BodyType& type);
/// Sizes that the shape's type does not use are those of a default shape.
Status get_shape(const World& world, BodyId id, Shape& shape);
/// BodyDef::material.
Status get_material(const World& world, BodyId id, Material& material);
/// 1/s.
Status get_damping(const World& world, BodyId id, Real& linear, Real& angular);
/// BodyDef::gravity_scale.
Status get_gravity_scale(const World& world, BodyId id, Real& scale);
/// BodyDef::turn_locks.
Status get_turn_locks(const World& world, BodyId id, uint32_t& locks);
/// BodyDef::sensor.
Status get_sensor(const World& world, BodyId id, bool& sensor);
/// The moments of inertia about the body's axes, kg m^2; 0 for fixed and kinematic bodies and about locked axes.
Status get_inertia(const World& world, BodyId id, Vec3<Scaled>& inertia);
/// The velocity of the body's point `arm` from its centre of mass, m, world axes, each component within twice the
/// bounding radius. m/s, world. Errors: out_of_range.
Status get_velocity_at(const World& world, BodyId id, const Vec3<Real>& arm, Vec3<Real>& velocity);

/// Its contacts end at once. Position, velocity and spin stay, but a body that becomes fixed stops, and one that
/// becomes dynamic loses the spin about its locked axes. Mass: a body that becomes dynamic has the mass it last had
/// or was created with; if it never had one, that of 1000 kg/m^3.
/// Errors: bad_argument (no type; a half-space, a surface or a hull in its source frame that is to be dynamic),
/// out_of_range (the mass, or the speed of the rim).
Status set_type(World& world, BodyId id, BodyType type);
/// Its contacts end at once. Mass, velocity and spin stay; set_density() gives the mass of the new volume.
/// Errors: as create_body of such a shape, and out_of_range (the speed of the rim).
Status set_shape(World& world, BodyId id, const Shape& shape);
/// kg, [2^-60, 2^60]. Velocity and spin stay. A body that is not dynamic keeps it for when it is.
/// Errors: out_of_range.
Status set_mass(World& world, BodyId id, Scaled mass);
/// The moments of inertia about the body's axes, kg m^2, instead of those of its shape: at least 2^-15 mass r^2 and not
/// above mass r^2, r the power of two, m, that is above the bounding radius and not above twice it. What is given about a
/// locked axis has no effect. The spin stays. set_mass() scales them with the mass; set_shape(), set_type() and
/// set_turn_locks() give the shape's again. Errors: bad_argument (the body is not dynamic), out_of_range.
Status set_inertia(World& world, BodyId id, const Vec3<Scaled>& inertia);
/// As set_mass, of the shape's volume at `density`, kg/m^3. Errors: out_of_range, bad_argument (a half-space or
/// surface).
Status set_density(World& world, BodyId id, Scaled density);
/// Errors: bad_argument (no restitution rule), out_of_range.
Status set_material(World& world, BodyId id, const Material& material);
/// 1/s, [0, 1024]. Errors: out_of_range.
Status set_damping(World& world, BodyId id, Real linear, Real angular);
/// [-1024, 1024]. Errors: out_of_range.
Status set_gravity_scale(World& world, BodyId id, Real scale);
/// BodyDef::turn_locks. Spin about the other axes stays. Errors: bad_argument.
Status set_turn_locks(World& world, BodyId id, uint32_t locks);
/// BodyDef::sensor. Its contacts end at once, and who was within whom is forgotten. Errors: pool_full
/// (Capacity::sensed is 0), feature_missing.
Status set_sensor(World& world, BodyId id, bool sensor);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
