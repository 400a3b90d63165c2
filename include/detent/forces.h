#pragma once
#include <detent/world.h>

/// Pushes beside those of world.h.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Adds a force, N, world frame, that acts during the next step at a point given as in apply_impulse_at: from the
/// centre of mass, m, world axes, each component within twice the bounding radius. Errors: as apply_force.
Status apply_force_at(World& world, BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm);
/// As apply_force_at, at a point of the world within the same range of the body. Errors: as apply_force.
Status apply_force_at_point(World& world, BodyId id, const Vec3<Scaled>& force, const Position& point);
/// As apply_impulse_at, at a point of the world within the same range of the body. Errors: as apply_force.
Status apply_impulse_at_point(World& world, BodyId id, const Vec3<Scaled>& impulse, const Position& point);

/// What explode() does.
struct Explosion {
  Position centre = {0.0, 0.0, 0.0};  ///< m, world
  Real radius = 10.0;                 ///< m, [2^-14, 2^14]; nothing farther off is pushed
  Scaled impulse = 100.0;             ///< N s/m^2 at the centre; negative: it pulls
};
/// Pushes each dynamic body at once, in slot order, through its centre of mass and away from the explosion, by
///
///     impulse x pi b^2 x (1 - d / radius),   d = max(distance of the centres - b, 0),
///
/// b the bounding radius, as long as d < radius. A body whose centre is the explosion's is not pushed.
/// Errors: out_of_range, also if a speed would leave its range: then no body is pushed.
Status explode(World& world, const Explosion& explosion);

/// Gives a kinematic body the velocity and spin, the shorter way around, that bring it to the target pose in the next
/// step; it keeps them after that. Error of the pose then: 2^-31 m and the position's step (f32: and 2^-23 of the way)
/// in each coordinate, and 2^-27 (f32: 2^-21) in each component of the rotation (tests/unit/world/kinematic_test.cpp).
/// Errors: bad_id, bad_argument (not kinematic; a half-space that would turn), out_of_range (a speed), not_normalised.
Status move_kinematic(World& world, BodyId id, const Position& position, const Quat& rotation);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
