#pragma once
#include <detent/world.h>

/// Forces, impulses and kinematic targets, in addition to the functions of world.h.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Adds a force, N, world frame, that acts during the next step at the point `arm` from the centre of mass. `arm`: m,
/// world axes; each component within twice the bounding radius. Errors: as apply_force().
Status apply_force_at(World& world, BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm);
/// As apply_force_at(), with the point as a world position, m, in the same range around the centre of mass.
/// Errors: as apply_force().
Status apply_force_at_point(World& world, BodyId id, const Vec3<Scaled>& force, const Position& point);
/// As apply_impulse_at(), with the point as a world position, m. Its distance from the centre of mass is at most twice
/// the bounding radius in each component. Errors: as apply_force().
Status apply_impulse_at_point(World& world, BodyId id, const Vec3<Scaled>& impulse, const Position& point);

/// The parameters of explode().
struct Explosion {
  Position centre = {0.0, 0.0, 0.0};  ///< m, world
  Real radius = 10.0;                 ///< m, [2^-14, 2^14]; bodies farther away get no impulse
  Scaled impulse = 100.0;             ///< N s/m^2 at the centre; a negative value pulls bodies towards the centre
};
/// Applies an impulse at once to each dynamic body with d < radius, in slot order, through its centre of mass and away
/// from the centre of the explosion. The impulse is
///
///     impulse x pi b^2 x (1 - d / radius),   d = max(distance of the centres - b, 0),
///
/// where b is the bounding radius of the body. A body whose centre of mass is at the centre of the explosion gets no
/// impulse. Errors: out_of_range, also if a speed would leave its range; then no body gets an impulse.
Status explode(World& world, const Explosion& explosion);

/// Sets the velocity and angular velocity of a kinematic body so that the next step moves it to the target pose, by the
/// smaller of the two possible rotations. The body keeps these velocities after that step. The error of the pose after
/// the step is at most 2^-31 m plus one step of the position format (f32: plus 2^-23 of the displacement) in each
/// coordinate, and 2^-27 (f32: 2^-21) in each component of the rotation (tests/unit/world/kinematic_test.cpp).
/// Errors: bad_id, bad_argument (not kinematic; a half-space that would rotate), out_of_range (a speed),
/// not_normalised.
Status move_kinematic(World& world, BodyId id, const Position& position, const Quat& rotation);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
