#include "solver/contact_order.h"

#include "base/digest.h"
#include "base/heap.h"
#include "base/radix_sort.h"
#include "solver/island.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint64_t k_order_seed = 0x6465746e74736f72u;

uint64_t id_word(Span<const BodyProperties> properties, uint32_t slot) {
  return (uint64_t{properties[slot].generation} << 32) | (slot + 1);
}

uint32_t pair_hash(Span<const BodyProperties> properties, const ContactState& contact) {
  const uint64_t low = digest_step(k_order_seed, id_word(properties, contact.body_a));
  uint64_t pair = digest_step(low, id_word(properties, contact.body_b));
  if (contact.part != 0) pair = digest_step(pair, contact.part);
  return static_cast<uint32_t>(digest_finish(pair) >> 32);
}

/// The kind of work of a contact. Contacts of one colour may be solved in any order. Those of the same kind are sorted
/// together, so that several can be solved at once.
uint16_t kind_of(const ContactWork& contact) {
  return static_cast<uint16_t>(contact.state.point_count | contact.angular_rows << k_rows_shift);
}

/// Returns the lowest colour that is free at both bodies, and marks it as taken. Returns k_colour_overflow if no colour
/// is free.
uint16_t take_colour(Span<const BodyProperties> properties, const ContactState& contact, Span<BodyWork> work) {
  const bool colours_a = is_dynamic(properties[contact.body_a]), colours_b = is_dynamic(properties[contact.body_b]);
  uint64_t taken = k_has_near;
  if (colours_a) taken |= work[contact.body_a].colours;
  if (colours_b) taken |= work[contact.body_b].colours;
  if (taken == UINT64_MAX) return k_colour_overflow;
  const uint16_t colour = static_cast<uint16_t>(__builtin_ctzll(~taken));
  const uint64_t mark = uint64_t{1} << colour;
  if (colours_a) work[contact.body_a].colours |= mark;
  if (colours_b) work[contact.body_b].colours |= mark;
  return colour;
}

/// The sort key of an island, below 256: first the number of substeps, then whether it has contacts. Islands with
/// joints come last.
uint32_t kind_of(const Island& island) {
  return island.joint_count != 0 ? 255 : 2 * island.substeps + (island.contact_count != 0 ? 1 : 0);
}

/// Copies the contacts from number `first` of `from` on to `to`, to the ranges of their islands. Keeps their order
/// within an island.
void copy_by_island(Span<const Island> islands, Span<BodyWork> work, Span<const ContactOrder> from,
                    Span<ContactOrder> to, uint32_t first) {
  for (uint32_t i = 0; i < islands.count; ++i) work[i].run = islands[i].first_contact;
  for (uint32_t i = first; i < from.count; ++i) to[work[from[i].island].run++] = from[i];
}

/// Orders the contacts of one island. Returns the number of contacts that found no free colour.
uint32_t order_island(Span<const BodyProperties> properties, Span<const ContactWork> contacts, Span<BodyWork> work,
                      Span<ContactOrder> spare, Span<ContactOrder> order) {
  // Digits of the sort: from 0 on those of the key, then the kind (k_kind), last the colour.
  constexpr int k_kind = 4, k_digits = 6;
  const auto sort_by = [&](int first, int end) {
    const auto digit_of = [first](const ContactOrder& entry, int digit) {
      const int at = first + digit;
      return at < k_kind ? entry.key >> (8 * at) & 255 : uint32_t{at == k_kind ? entry.kind : entry.colour};
    };
    radix_sort(order, spare, digit_of, end - first);
  };
  sort_by(0, k_kind);
  uint32_t overflows = 0;
  for (ContactOrder& entry : order) {
    entry.colour = take_colour(properties, contacts[entry.contact].state, work);
    overflows += entry.colour == k_colour_overflow ? 1 : 0;
  }
  sort_by(k_kind, k_digits);
  return overflows;
}

}  // namespace

uint32_t order_contacts(Team* team, Span<const BodyProperties> properties, Span<const ContactWork> contacts,
                        Span<const Island> islands, Span<BodyWork> work, Span<ContactOrder> spare,
                        Span<ContactOrder> order) {
  share(team, contacts.count, k_contacts_shared, [&](uint32_t first, uint32_t last) {
    for (uint32_t i = first; i < last; ++i) {
      const ContactState& state = contacts[i].state;
      spare[i] = {pair_hash(properties, state), i, 0, kind_of(contacts[i]), island_of(properties, work, state)};
    }
  });
  copy_by_island(islands, work, {spare.data, contacts.count}, order, 0);
  return share_sum(team, islands, k_islands_shared, [&](Span<const Island> part) {
    uint32_t overflows = 0;
    for (const Island& island : part) {
      const uint32_t first = island.first_contact, count = island.contact_count;
      overflows += order_island(properties, contacts, work, {spare.data + first, count}, {order.data + first, count});
    }
    return overflows;
  });
}

bool are_solved_together(const Island& a, const Island& b) {
  return a.joint_count == 0 && b.joint_count == 0 && kind_of(a) == kind_of(b);
}

void group_islands(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                   Span<const BodyActivity> activities, Span<const ContactWork> contacts, Span<Island> islands,
                   Span<BodyWork> work, Span<uint32_t> bodies, Span<ContactOrder> spare, Span<ContactOrder> order) {
  if (islands.count < 2) return;
  const auto precedes = [](const Island& a, const Island& b) {
    return kind_of(a) < kind_of(b) || (kind_of(a) == kind_of(b) && a.first_body < b.first_body);
  };
  bool sorted = true;
  for (uint32_t i = 1; sorted && i < islands.count; ++i) sorted = precedes(islands[i - 1], islands[i]);
  if (!sorted) {
    heap_sort(islands, precedes);
    for (uint32_t i = 0; i < islands.count; ++i) {
      for (uint32_t k = 0; k < islands[i].body_count; ++k) work[bodies[islands[i].first_body + k]].island = i;
    }
    list_island_bodies(slots, properties, activities, work, islands, bodies);
    for (ContactOrder& entry : order) entry.island = island_of(properties, work, contacts[entry.contact].state);
  }
  radix_sort(
      order, spare,
      [&](const ContactOrder& entry, int digit) {
        return digit == 0 ? uint32_t{entry.kind} : digit == 1 ? uint32_t{entry.colour} : kind_of(islands[entry.island]);
      },
      3);
  uint32_t alone = 0;
  for (const Island& island : islands) alone += island.joint_count == 0 ? island.contact_count : 0;
  for (uint32_t i = alone; i < order.count; ++i) spare[i] = order[i];
  copy_by_island(islands, work, {spare.data, order.count}, order, alone);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
