#pragma once
#include <detent/detail/state.h>

#include "base/span.h"
#include "collision/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The contact of this tick from its geometry and, if the pair touched in the last tick, its contact of then: the
/// impulses of points whose feature is still there are kept, others start at 0.
ContactState continued_contact(uint32_t body_a, uint32_t body_b, uint32_t part, const ContactGeometry& geometry,
                               const ContactState* before);

/// Removes the contacts of a body and their manifolds, if there are any, keeping the order of the rest. Returns how
/// many are left; the slots freed are zero.
uint32_t remove_contacts(uint32_t body, Span<ContactState> contacts, Span<ManifoldState> manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
