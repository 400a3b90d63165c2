#include "dynamics/contact_order.h"

#include "base/digest.h"
#include "base/heap.h"
#include "dynamics/spin.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint64_t k_order_seed = 0x6465746e74736f72u;

uint64_t id_word(Span<const BodyTraits> traits, uint32_t slot) {
  return (uint64_t{traits[slot].generation} << 32) | (slot + 1);
}

uint64_t pair_hash(Span<const BodyTraits> traits, const ContactState& contact) {
  const uint64_t low = digest_step(k_order_seed, id_word(traits, contact.body_a));
  return digest_finish(digest_step(low, id_word(traits, contact.body_b)));
}

}  // namespace

uint32_t order_contacts(Span<const BodyTraits> traits, Span<const ContactWork> contacts, Span<BodyWork> work,
                        Span<ContactOrder> order) {
  for (uint32_t i = 0; i < contacts.count; ++i) order[i] = {pair_hash(traits, contacts[i].state), i, 0};
  const auto by_key = [](const ContactOrder& a, const ContactOrder& b) {
    return a.key < b.key || (a.key == b.key && a.contact < b.contact);
  };
  heap_sort(order, by_key);
  uint32_t overflows = 0;
  for (ContactOrder& entry : order) {
    const ContactState& contact = contacts[entry.contact].state;
    const bool colours_a = is_dynamic(traits[contact.body_a]), colours_b = is_dynamic(traits[contact.body_b]);
    uint64_t taken = 0;
    if (colours_a) taken |= work[contact.body_a].colours;
    if (colours_b) taken |= work[contact.body_b].colours;
    if (taken == UINT64_MAX) {
      entry.colour = k_colour_overflow;
      ++overflows;
      continue;
    }
    entry.colour = static_cast<uint32_t>(__builtin_ctzll(~taken));
    const uint64_t mark = uint64_t{1} << entry.colour;
    if (colours_a) work[contact.body_a].colours |= mark;
    if (colours_b) work[contact.body_b].colours |= mark;
  }
  heap_sort(order, [&](const ContactOrder& a, const ContactOrder& b) {
    return a.colour < b.colour || (a.colour == b.colour && by_key(a, b));
  });
  return overflows;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
