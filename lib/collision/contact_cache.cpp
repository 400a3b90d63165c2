#include "collision/contact_cache.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

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
  contact.friction_impulse = before->friction_impulse;
  contact.angular_impulse = before->angular_impulse;
  contact.load = before->load;
  for (uint32_t i = 0; i < contact.point_count; ++i) {
    for (uint32_t j = 0; j < before->point_count; ++j) {
      if (before->feature[j] == contact.feature[i]) contact.normal_impulse[i] = before->normal_impulse[j];
    }
  }
  return contact;
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
