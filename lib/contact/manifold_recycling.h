#pragma once
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Makes the data from which later ticks can recycle a pair's contact: use its points again while the pair has hardly
/// moved. The data is all zero for a contact that is not recycled: a contact without points; a contact with a
/// half-space, because it can be found anew as fast as recycled; the result of a capped search; and a contact of bodies
/// that overlap deeply.
ManifoldState kept_manifold(const CollisionBody& a, const CollisionBody& b, const ContactGeometry& contact);

/// Whether the data belongs to a contact that can be recycled. False if the data is all zero.
bool is_kept(const ManifoldState& manifold);

/// Recycles the contact with the data `before` and `count` points, whose features are `feature`, at the current poses.
/// Sets `contact`, and sets `after` to the data for the next tick. The normal and the surface of the base (the larger
/// body) move with the base, the points move with the other body, and the separations follow the motion along the
/// normal. Points with a separation above `margin`, m, are left out of `contact` and of `after`.
/// Returns false if the caller must collide the pair anew: if the data is all zero, and in two other cases. First, a
/// point of the smaller body may have moved relative to the larger body by more than `tolerance`, m; for a contact of
/// one or two points, about which a body can rotate or roll, the limit is 1/64 of `tolerance`. Second, too few points
/// are left: fewer than three of a contact with three or four points, or not all of a contact with one or two points.
///
/// Precision: that of collide(), and 2^-17 of the motion. Each call starts from the stored data, so errors do not
/// accumulate. The direction of the normal errs by no more than the relative rotation of the pair since the data was
/// stored, which is at most 2 tolerance / (bounding diameter of the smaller body).
bool recycle_manifold(const CollisionBody& a, const CollisionBody& b, const ManifoldState& before,
                      const uint32_t (&feature)[k_manifold_points_max], uint32_t count, Real tolerance, Real margin,
                      ContactGeometry& contact, ManifoldState& after);

/// Whether data from an untrusted source can be recycled safely for a contact of `count` points: all values are in the
/// ranges that recycle_manifold() needs. True for all data from kept_manifold().
bool is_manifold(const BodyProperties& a, const BodyProperties& b, uint32_t count, const ManifoldState& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
