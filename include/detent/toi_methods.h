#pragma once
#include <detent/toi.h>

/// @file
/// Time of impact by a selected method, to compare methods. It is a separate library: link detent::toi_methods, or
/// detent::toi_methods_fx64 and so on, in addition to Detent. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Methods for the time of impact of two convex shapes. The methods from `paper` to `constant_angular_velocity` advance
/// the time along certified separating axes. They differ in how far they advance the time along one axis. The other
/// methods are from the literature, for comparison.
enum class ToiMethod {
  /// Coumans' Algorithm 1: advances the time once for each axis n. It bounds the approach speed along n by
  /// n.v + |wA| rA + |wB| rB. Here v is the relative velocity, wA and wB are the angular velocities, and rA and rB are
  /// the radii of the cores.
  paper,
  /// As `paper`, but with the smaller bound n.v + |n x wA| rA + |n x wB| rB.
  first_order,
  /// Advances the time along an axis, which is fixed in the world, as long as this axis separates the shapes. Each
  /// advance follows from a concave lower bound of the separation as a function of time.
  second_order,
  corotating,  ///< as second_order, but the axis rotates with the body whose face or edge determines it
  /// As constant_angular_velocity, but moves both bodies in the world frame. The other methods move B relative to A.
  /// Both formulations are from Coumans.
  world_space,
  /// As corotating, but an axis that belongs to no face (between vertices, edges or rims) rotates so that it also
  /// separates these features at the time of contact.
  constant_angular_velocity,
  /// Advances the time until the bounds of both bodies' displacements along the normal add up to the gap between the
  /// shapes.
  mirtich,
  baraff,         ///< finds the root of the separation along an axis that two features determine; may miss a contact
  feature_pairs,  ///< polytopes: finds the first contact of all pairs of features
  redon,  ///< polytopes: as feature_pairs, but for another motion: the screw motion from the start pose to the end pose
  /// Polytopes: as feature_pairs, but for another motion: rotation by normalised lerp. Finds roots numerically; may
  /// miss a contact.
  canny,
};

/// Computes the time of impact as time_of_impact() (toi.h) does, but by the given method. Errors: those of
/// time_of_impact(), and bad_argument for a shape that the method does not support.
Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
