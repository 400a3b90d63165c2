#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The colour of contacts that find all colours taken at their bodies. Contacts of any other colour share no dynamic
/// body with each other; contacts of this colour may.
inline constexpr uint16_t k_colour_overflow = 64;

/// Computes the order of the solve. Contacts are visited by the hash of their bodies' ids (ties by the contacts' own
/// order). Each takes the lowest colour that is free at both its dynamic bodies. The result is sorted by (island,
/// colour, hash). It is a total order that depends on ids alone: any schedule that keeps it within each body gives the
/// same bits. Visiting by hash and not in the order of creation is necessary for a pyramid to come to rest
/// (docs/design/solver.md, "Order of the solve").
///
/// In: `work` has the bodies' islands and `islands` the places of their contacts, from find_islands(). `spare` is work
/// space as large as `order`. Returns the number of contacts that found no free colour.
uint32_t order_contacts(Span<const BodyProperties> properties, Span<const ContactWork> contacts,
                        Span<const Island> islands, Span<BodyWork> work, Span<ContactOrder> spare,
                        Span<ContactOrder> order);

/// Arranges the islands so that those that may be solved together follow each other: islands without joints and with
/// the same number of substeps. Their contacts are then in one order by (colour, hash), which fills the solver's lanes
/// also where islands are small. The bits stay the same, because islands share no dynamic body.
///
/// In: the results of find_islands(), order_contacts() and the islands' numbers of substeps; `slots` as in
/// find_islands(). Renumbers the islands. The range of contacts of one of several islands that are solved together is
/// meaningless; the sum of their ranges holds all of their contacts.
void group_islands(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                   Span<const BodyActivity> activities, Span<const ContactWork> contacts, Span<Island> islands,
                   Span<BodyWork> work, Span<uint32_t> bodies, Span<ContactOrder> spare, Span<ContactOrder> order);

/// Whether group_islands() may let the two islands be solved together.
bool are_solved_together(const Island& a, const Island& b);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
