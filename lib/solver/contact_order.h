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
/// same bits. Visiting by hash and not in the order of creation is necessary for a pyramid to come to rest (DESIGN.md,
/// "Order of the solve").
///
/// In: `work` has the bodies' islands and `islands` the places of their contacts, from find_islands(). `spare` is work
/// space as large as `order`. Returns the number of contacts that found no free colour.
uint32_t order_contacts(Span<const BodyProperties> properties, Span<const ContactWork> contacts,
                        Span<const Island> islands, Span<BodyWork> work, Span<ContactOrder> spare,
                        Span<ContactOrder> order);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
