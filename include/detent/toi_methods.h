#pragma once
#include <detent/toi.h>

/// @file
/// Time of impact by a selected method, to compare methods. It is a separate library: link detent::toi_methods, or
/// detent::toi_methods_fx64 and so on, in addition to Detent. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Methods for the time of impact of two convex shapes. The methods from `paper` to `constant_angular_velocity` advance
/// along separating axes that are certified, and differ in how far they advance along one axis. The others are methods
/// from the literature, for comparison.
enum class ToiMethod {
  paper,         ///< Coumans' Algorithm 1: bounds the approach by n.v + |wA| rA + |wB| rB; one step for each axis
  first_order,   ///< bounds it by |n x w| times the radius about the rotation axis; one step for each axis
  second_order,  ///< uses a concave bound along an axis fixed in the world, as long as the bound permits an advance
  corotating,    ///< as second_order, but the axis rotates with the body that has the face or edge
  /// As constant_angular_velocity, but each body moves by itself; the other methods move B relative to A (both are
  /// formulations of Coumans).
  world_space,
  constant_angular_velocity,  ///< as corotating, but the axis of two edges rotates so that it is also exact at contact
  mirtich,                    ///< conservative advancement whose bound is solved for the time: D1(t) + D2(t) = d
  baraff,                     ///< finds the root of the separation along a witness axis; may miss a contact
  feature_pairs,              ///< polytopes: finds the first contact of all pairs of features
  redon,  ///< polytopes: as feature_pairs, for the screw motion between both end poses (a different motion)
  canny,  ///< polytopes: finds numerical roots, for a rotation by normalised lerp; may miss a contact
};

/// time_of_impact() (toi.h) by a selected method. Errors: bad_argument for a shape that the method does not support.
Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
