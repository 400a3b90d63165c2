#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "base/team.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The colour of contacts for which no colour was free at their bodies. Two contacts that have the same other colour
/// share no dynamic body.
inline constexpr uint16_t k_colour_overflow = 63;

/// The parts of ContactOrder::kind. The lowest bits (k_point_mask) are the number of points. The number of angular rows
/// begins at bit number k_rows_shift. The upper byte (k_group_shift) tells whether the contact is in a group of
/// contacts that are solved at once: 0 if it is solved alone; for the first contact of a group the number of contacts
/// in the group, 2 to 8; for its other contacts k_in_group.
inline constexpr uint32_t k_point_mask = 7;
inline constexpr int k_rows_shift = 3, k_group_shift = 8;
inline constexpr uint32_t k_in_group = 1;
constexpr uint32_t group_size(const ContactOrder& entry) { return uint32_t{entry.kind} >> k_group_shift; }

/// Computes the order in which the solver visits contacts. First the contacts of each island are sorted by the hash of
/// their bodies' ids; contacts with equal hashes keep their order. In this order, each contact takes the lowest colour
/// that is free at both of its dynamic bodies. The result is sorted by (island, colour, ContactOrder::kind, hash). Any
/// schedule that keeps the order of the contacts of each dynamic body gives the same bits. The order by hash, instead
/// of the order of creation, is necessary for a pyramid to come to rest (docs/design/solver.md, "Order of the solve").
///
/// Input, from find_islands(): the islands of the bodies in `work`, and the ranges of contacts in `islands`. `spare` is
/// work space as large as `order`. Returns the number of contacts that found no free colour.
uint32_t order_contacts(Team* team, Span<const BodyProperties> properties, Span<const ContactWork> contacts,
                        Span<const Island> islands, Span<BodyWork> work, Span<ContactOrder> spare,
                        Span<ContactOrder> order);

/// Sorts the islands, so that islands which may be solved together follow each other: islands without joints and with
/// the same number of substeps. The contacts of such a group are sorted together, by colour first, so that several
/// contacts can be solved at once even if the islands are small. The sort changes no bit of the solve, because islands
/// share no dynamic body.
///
/// Input: the results of find_islands() and order_contacts(), and the islands' numbers of substeps; `slots` as in
/// find_islands(). Renumbers the islands. In a group of islands that are solved together, the range of contacts of a
/// single island has no meaning; only the range of the whole group is valid.
void group_islands(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                   Span<const BodyActivity> activities, Span<const ContactWork> contacts, Span<Island> islands,
                   Span<BodyWork> work, Span<uint32_t> bodies, Span<ContactOrder> spare, Span<ContactOrder> order);

/// Whether the two islands may be solved together, in one group of group_islands().
bool are_solved_together(const Island& a, const Island& b);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
