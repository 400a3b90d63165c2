#pragma once
#include "collision/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Contact of a half-space (A) with any other shape (B): the lowest points of B over the plane. Appends to an empty
/// contact.
void collide_half_space(const CollisionBody& plane, const CollisionBody& body, Real reach, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
