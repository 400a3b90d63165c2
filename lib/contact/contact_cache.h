#pragma once
#include <detent/detail/state.h>

#include "base/span.h"
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct SurfaceContacts;

/// The contacts of a pair in the last tick, in the order of their parts.
struct PairBefore {
  const ContactState* contacts;  ///< of the world
  const uint32_t* index;         ///< which of them, `count`
  uint32_t count = 0;            ///< at most k_surface_manifolds_max

  const ContactState& operator[](uint32_t i) const { return contacts[index[i]]; }
};

/// How many of the points have a feature that the contact had.
uint32_t shared_features(const ContactGeometry& geometry, const ContactState& contact);

/// Gives contacts whose keys are new those of contacts with whose features they go on: a plane that leans a little, or
/// is taken together with another, is named anew. They are ascending by key.
void continue_keys(const PairBefore& before, SurfaceContacts& contacts);

/// The contact of this tick from its geometry and, if the pair touched in the last tick, its contact of then: the
/// impulses of points whose feature is still there are kept, others start at 0.
ContactState continued_contact(uint32_t body_a, uint32_t body_b, uint32_t part, const ContactGeometry& geometry,
                               const ContactState* before);

/// Removes the contacts of a body and their manifolds, if there are any, keeping the order of the rest. Returns how
/// many are left; the slots freed are zero.
uint32_t remove_contacts(uint32_t body, Span<ContactState> contacts, Span<ManifoldState> manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
