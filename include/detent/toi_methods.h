#pragma once
#include <detent/toi.h>

/// @file
/// Time of impact by a selected method, to compare methods. It is a separate library: link detent::toi_methods, or
/// detent::toi_methods_fx64 and so on, in addition to Detent. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Methods for the time of impact of two convex shapes. The methods from `paper` to `constant_angular_velocity` advance
/// along certified separating axes. They differ in how far they advance along one axis. The other methods are from the
/// literature, for comparison.
enum class ToiMethod {
  paper,         ///< Coumans' Algorithm 1: bounds the approach speed by n.v + |wA| rA + |wB| rB; one step per axis
  first_order,   ///< bounds it by n.v + |n x wA| rA + |n x wB| rB, with the same core radii r; one step per axis
  second_order,  ///< repeats advances along an axis fixed in the world, by a concave bound of the separation
  corotating,    ///< as second_order, but the axis rotates with the body that has the face or edge
  /// As constant_angular_velocity, but both bodies move in the world frame. The other methods move B relative to A.
  /// Both formulations are from Coumans.
  world_space,
  constant_angular_velocity,  ///< as corotating, but the axis of two edges rotates so that it is also exact at contact
  mirtich,                    ///< advances until the bounds of both bodies' motions add up to their distance
  baraff,                     ///< finds the root of the separation along a witness axis; may miss a contact
  feature_pairs,              ///< polytopes: finds the first contact of all pairs of features
  redon,  ///< polytopes: as feature_pairs, for the screw motion between both end poses (a different motion)
  canny,  ///< polytopes: as feature_pairs, by numerical roots and for rotation by normalised lerp; may miss a contact
};

/// time_of_impact() (toi.h) by a selected method. Errors: bad_argument for a shape that the method does not support.
Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
