#include "contact/contact_cache.h"

#include "contact/terrain_manifolds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Adds an impulse, without overflow.
void add_impulse(Real more, Real& sum) { sum += min(more, k_real_max - sum); }

}  // namespace

uint32_t shared_features(const ContactGeometry& geometry, const ContactState& contact) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < geometry.count; ++i) {
    for (uint32_t j = 0; j < contact.point_count; ++j)
      count += geometry.point[i].feature == contact.feature[j] ? 1u : 0u;
  }
  return count;
}

void continue_keys(const PairBefore& before, TerrainContacts& contacts) {
  bool goes_on[k_terrain_manifolds_max] = {}, is_known[k_terrain_manifolds_max] = {};
  for (uint32_t i = 0; i < contacts.count; ++i) {
    for (uint32_t j = 0; j < before.count; ++j) {
      if (before[j].part == contacts.contact[i].key) goes_on[j] = is_known[i] = true;
    }
  }
  for (uint32_t i = 0; i < contacts.count; ++i) {
    TerrainContact& contact = contacts.contact[i];
    uint32_t best = before.count, most = 0;
    for (uint32_t j = 0; !is_known[i] && j < before.count; ++j) {
      const uint32_t shared = goes_on[j] ? 0 : shared_features(contact.geometry, before[j]);
      if (shared <= most) continue;
      most = shared;
      best = j;
    }
    if (most == 0) continue;
    goes_on[best] = true;
    contact.key = before[best].part;
  }
  for (uint32_t i = 1; i < contacts.count; ++i) {
    for (uint32_t k = i; k > 0 && contacts.contact[k].key < contacts.contact[k - 1].key; --k) {
      const TerrainContact swapped = contacts.contact[k];
      contacts.contact[k] = contacts.contact[k - 1];
      contacts.contact[k - 1] = swapped;
    }
  }
}

ContactState continued_contact(uint32_t body_a, uint32_t body_b, uint32_t part, const ContactGeometry& geometry,
                               const ContactState* before) {
  ContactState contact{};
  contact.body_a = body_a;
  contact.body_b = body_b;
  contact.part = part;
  contact.point_count = static_cast<uint8_t>(geometry.count);
  for (uint32_t i = 0; i < geometry.count; ++i) contact.feature[i] = geometry.point[i].feature;
  if (before == nullptr) return contact;
  contact.age = before->age == UINT16_MAX ? before->age : static_cast<uint16_t>(before->age + 1);
  contact.touching = before->touching;
  contact.angular_impulse = before->angular_impulse;
  contact.friction_impulse = before->friction_impulse;
  contact.load = before->load;
  take_impulses(*before, contact);
  return contact;
}

uint32_t heir_of(const ContactState& before, const TerrainContacts& found) {
  uint32_t heir = UINT32_MAX;
  for (uint32_t i = found.count; i-- > 0;) {
    if (found.contact[i].key == before.part) return UINT32_MAX;
    if (shared_features(found.contact[i].geometry, before) != 0) heir = i;
  }
  return heir;
}

void take_impulses(const ContactState& before, ContactState& contact) {
  for (uint32_t i = 0; i < contact.point_count; ++i) {
    for (uint32_t j = 0; j < before.point_count; ++j) {
      if (before.feature[j] == contact.feature[i]) add_impulse(before.normal_impulse[j], contact.normal_impulse[i]);
    }
  }
}

uint32_t remove_contacts(uint32_t body, Span<ContactState> contacts, Span<ManifoldState> manifolds) {
  const bool has_manifolds = manifolds.count != 0;
  uint32_t kept = 0;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    if (contacts[i].body_a == body || contacts[i].body_b == body) continue;
    if (kept != i) {
      contacts[kept] = contacts[i];
      if (has_manifolds) manifolds[kept] = manifolds[i];
    }
    ++kept;
  }
  for (uint32_t i = kept; i < contacts.count; ++i) {
    contacts[i] = ContactState{};
    if (has_manifolds) manifolds[i] = ManifoldState{};
  }
  return kept;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
