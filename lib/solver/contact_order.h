#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Contacts of one colour share no dynamic body. Those that find all colours taken get this one and share freely.
inline constexpr uint16_t k_colour_overflow = 64;

/// The order of the solve: contacts are visited by the hash of their bodies' ids (ties by the contacts' own order),
/// each takes the lowest colour free at both its dynamic bodies, and the result is sorted by (island, colour, hash). It
/// is a total order that depends on ids alone: any schedule that keeps it within each body gives the same bits.
/// Visiting by hash and not by creation is what lets a pyramid settle (DESIGN.md, "Order of the solve").
/// `work` has its islands and `islands` their contacts' places, from find_islands(). `spare` is work space as large as
/// `order`. Returns how many found no colour.
uint32_t order_contacts(Span<const BodyTraits> traits, Span<const ContactWork> contacts, Span<const Island> islands,
                        Span<BodyWork> work, Span<ContactOrder> spare, Span<ContactOrder> order);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
