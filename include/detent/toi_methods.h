#pragma once
#include <detent/toi.h>

/// @file
/// Time of impact by a method of choice, to compare methods with. It is a library of its own: link detent::toi_methods,
/// or detent::toi_methods_fx64 and so on, beside Detent. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How the time of impact of two convex shapes is found. Those from `paper` to `constant_spin` move along certified
/// axes; they differ in how far one axis leads. The others are the literature's, there to be compared.
enum class ToiMethod {
  paper,          ///< Coumans' Algorithm 1: the bound n.v + |wA| rA + |wB| rB on the approach, one step an axis
  first_order,    ///< |n x w| times the radius about the spin, one step an axis
  second_order,   ///< the concave bound along an axis fixed in the world, until it leads no farther
  corotating,     ///< likewise, the axis turning with the body that owns the face or edge
  world_space,    ///< as constant_spin, each body moved by itself; the others move B relative to A (Coumans'
                  ///< formulations)
  constant_spin,  ///< likewise, an edge's axis turning so that it is right at contact too
  mirtich,        ///< conservative advancement whose bound is solved for the time: D1(t) + D2(t) = d
  baraff,         ///< the root of the separation along a witness axis; may pass a contact
  feature_pairs,  ///< polytopes: the first of their features' contacts
  redon,          ///< polytopes, likewise, in the screw between their poses at both ends: another motion
  canny,          ///< polytopes, by numerical roots, in the motion by normalised lerp; may pass a contact
};

/// time_of_impact() (toi.h) by a method of choice. Errors: bad_argument for a shape that the method does not know.
Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
