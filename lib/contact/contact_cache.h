#pragma once
#include <detent/detail/state.h>

#include "base/span.h"
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct TerrainContacts;

/// The contacts of a pair in the last tick, in ascending order of ContactState::part.
struct PairBefore {
  const ContactState* contacts;  ///< all contacts of the world
  const uint32_t* index;         ///< `count` indices of the pair's contacts in `contacts`
  uint32_t count = 0;            ///< at most k_terrain_manifolds_max

  const ContactState& operator[](uint32_t i) const { return contacts[index[i]]; }
};

/// Returns how many points of `geometry` have a feature that also occurs in `contact`.
uint32_t shared_features(const ContactGeometry& geometry, const ContactState& contact);

/// Carries the keys (TerrainContact::key, which name the touched planes) over from the contacts of the last tick to
/// those of this tick, because a plane gets a new key when it tilts slightly or merges with another plane. A contact of
/// this tick whose key did not exist in the last tick takes the key of the contact of the last tick with which it
/// shares the most features. It cannot take a key that another contact of this tick already has. A contact that shares
/// no feature keeps its new key. Sorts the contacts by key.
void continue_keys(const PairBefore& before, TerrainContacts& contacts);

/// Makes the state of a contact of this tick from its geometry and from its state in the last tick, `before` (null if
/// there was none). A point whose feature also occurs in `before` keeps its normal impulse; the impulses of other
/// points start at 0.
ContactState continued_contact(uint32_t body_a, uint32_t body_b, uint32_t part, const ContactGeometry& geometry,
                               const ContactState* before);

/// A contact may end while points that bore its load are still touched, as points of another contact of the pair.
/// Returns the index of the first contact in `found` that has such a point; UINT32_MAX if there is none, or if a
/// contact has the key of `before`. Range: continue_keys() has been called.
uint32_t heir_of(const ContactState& before, const TerrainContacts& found);

/// Adds the normal impulses of another contact of the pair in the last tick, `before`, to the points of `contact` that
/// have the same features.
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 for Cortex-M0 at -Os: with interprocedural analysis, continued_contact() returns other impulses.
__attribute__((noipa))
#endif
void take_impulses(const ContactState& before, ContactState& contact);

/// Removes the contacts of a body, and their manifolds if `manifolds` is not empty. The other contacts move to the
/// front and keep their order; the elements after them are set to zero. Returns the number of contacts left.
uint32_t remove_contacts(uint32_t body, Span<ContactState> contacts, Span<ManifoldState> manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
