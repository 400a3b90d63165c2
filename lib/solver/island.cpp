#include "solver/island.h"

#include "motion/activity.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Finds the first body of a set (union-find). `link`: the member of BodyWork that holds the links. The search halves
/// the path.
uint32_t first_of(Span<BodyWork> work, uint32_t BodyWork::*link, uint32_t body) {
  while (work[body].*link != body) {
    work[body].*link = work[work[body].*link].*link;
    body = work[body].*link;
  }
  return body;
}

/// Joins the sets of `a` and `b`. Sets `first` to the first body of the joined set, which is the lower of the two first
/// bodies, and `other` to the higher one. Returns false if both bodies were in one set already.
bool join(Span<BodyWork> work, uint32_t BodyWork::*link, uint32_t a, uint32_t b, uint32_t& first, uint32_t& other) {
  a = first_of(work, link, a);
  b = first_of(work, link, b);
  first = a < b ? a : b;
  other = a < b ? b : a;
  work[other].*link = first;
  return a != b;
}

}  // namespace

uint32_t find_islands(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                      Span<const BodyActivity> activities, Span<const ContactWork> contacts, const JointStage& joints,
                      Span<BodyWork> work, Span<Island> islands, Span<uint32_t> bodies) {
  for (const uint32_t slot : slots) {
    BodyWork& now = work[slot];
    now.island = now.run = slot;
    now.run_length = 1;
    now.contacts = 0;
  }
  for (const ContactWork& contact : contacts) {
    ++work[contact.state.body_a].contacts;
    ++work[contact.state.body_b].contacts;
  }
  for (const ContactWork& contact : contacts) {
    const uint32_t a = contact.state.body_a, b = contact.state.body_b;
    if (contact.static_pair != 0) continue;
    uint32_t first = 0, other = 0;
    join(work, &BodyWork::island, a, b, first, other);
    if (work[a].contacts > 2 || work[b].contacts > 2) continue;
    if (join(work, &BodyWork::run, a, b, first, other)) work[first].run_length += work[other].run_length;
  }
  for (const JointWork& joint : joints.work.first(joints.count)) {
    const JointBody &a = joints.bodies[joint.body[0]], &b = joints.bodies[joint.body[1]];
    uint32_t first = 0, other = 0;
    if (a.mobile != 0 && b.mobile != 0) join(work, &BodyWork::island, a.slot, b.slot, first, other);
  }

  // Links every body directly to the first body of its set. The next loop visits the first body of a set before its
  // other bodies, which then take over the island number of the first.
  for (const uint32_t slot : slots) {
    work[slot].island = first_of(work, &BodyWork::island, slot);
    work[slot].run_length = work[first_of(work, &BodyWork::run, slot)].run_length;
  }
  uint32_t count = 0;
  for (const uint32_t slot : slots) {
    if (!is_awake(properties[slot], activities[slot])) continue;
    uint32_t& island = work[slot].island;
    if (island == slot) {
      islands[count] = {};
      island = count++;
    } else {
      island = work[island].island;
    }
    ++islands[island].body_count;
  }
  for (const ContactWork& contact : contacts) ++islands[island_of(properties, work, contact.state)].contact_count;
  list_island_bodies(slots, properties, activities, work, islands.first(count), bodies);
  return count;
}

void list_island_bodies(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                        Span<const BodyActivity> activities, Span<const BodyWork> work, Span<Island> islands,
                        Span<uint32_t> bodies) {
  uint32_t first_body = 0, first_contact = 0;
  for (Island& island : islands) {
    island.first_body = first_body;
    island.first_contact = first_contact;
    first_body += island.body_count;
    first_contact += island.contact_count;
    island.body_count = 0;
  }
  for (const uint32_t slot : slots) {
    if (!is_awake(properties[slot], activities[slot])) continue;
    Island& island = islands[work[slot].island];
    bodies[island.first_body + island.body_count++] = slot;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
