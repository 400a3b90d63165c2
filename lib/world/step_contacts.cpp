#include "world/step_contacts.h"

#include "collision/compound_code.h"
#include "collision/contact_cache.h"
#include "collision/manifold_reuse.h"
#include "dynamics/joint.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Lengths of a pair, m.
struct PairLengths {
  Real at_rest;  ///< how far apart it has contact points if it does not move
  Real reach;    ///< and as it moves: what it can close in this tick is added, up to a quarter of the smaller body, or
                 ///< twice that body where joints hold one
  Real reuse;    ///< how far it may move until its contact points are found anew
};

PairLengths lengths_of(const StepSettings& settings, const BodyWork& a, const BodyWork& b) {
  const Real extent = min(a.extent, b.extent), speed = a.speed + b.speed;
  const Real at_rest = extent * settings.breaking;
  // What joints hold is not stopped on its way (impact.h): its contacts foresee more.
  const bool jointed = a.joint_body != k_no_link || b.joint_body != k_no_link;
  const Real reach_max = scale_by_power(extent, jointed ? 1 : -2);
  return {at_rest, at_rest + min(reach_max, speed * settings.tick_time), extent * settings.reuse};
}

/// A contact of the last tick; `manifold` null where none are kept.
struct ContactBefore {
  const ContactState* contact = nullptr;
  const ManifoldState* manifold = nullptr;
};

/// Contact points of a pair of bodies that have been started: those of the last tick where they will do, which sets
/// `reused`, or else new ones. Fills `manifold`, unless it is null, with what is kept of them.
void collide_pair(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const StepBodies& bodies,
                  const ContactBefore& before, ContactGeometry& geometry, ManifoldState* manifold, bool& reused) {
  const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
  const PairLengths lengths = lengths_of(settings, bodies.work[slot_a], bodies.work[slot_b]);
  // A point that was out of reach then is still farther off than the pair can close in this tick.
  const bool slow = lengths.reach + lengths.reuse <= scale_by_power(lengths.at_rest, 1);
  reused = before.manifold != nullptr && manifold != nullptr && slow &&
           reuse_manifold(body_a, body_b, *before.manifold, before.contact->feature, before.contact->point_count,
                          lengths.reuse, lengths.reach, geometry, *manifold);
  if (reused) return;
  collide(body_a, body_b, lengths.reach, geometry, bodies.assets, settings.reduction, bodies.features);
  if (manifold != nullptr) *manifold = slow ? kept_manifold(body_a, body_b, geometry) : ManifoldState{};
}

/// Likewise the contacts of the parts of a pair. Apart, for what it needs of the stack.
void collide_pair_parts(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const StepBodies& bodies,
                        SurfaceContacts& contacts) {
  const PairLengths lengths = lengths_of(settings, bodies.work[slot_a], bodies.work[slot_b]);
  collide_parts(bodies.collider(slot_a), bodies.collider(slot_b), lengths.reach, bodies.assets, settings.reduction,
                bodies.features, contacts);
}

__attribute__((noinline)) bool parts_touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b,
                                           const StepBodies& bodies) {
  SurfaceContacts contacts;
  collide_pair_parts(settings, slot_a, slot_b, bodies, contacts);
  return contacts.count != 0;
}

bool touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const StepBodies& bodies) {
  if (bodies.has_parts(slot_a, slot_b)) return parts_touch(settings, slot_a, slot_b, bodies);
  ContactGeometry geometry;
  bool reused = false;
  collide_pair(settings, slot_a, slot_b, bodies, {}, geometry, nullptr, reused);
  return geometry.count != 0;
}

Real depth_of(const ContactWork& contact) {
  Real least = contact.separation[0];
  for (uint32_t i = 1; i < contact.state.point_count; ++i) least = min(least, contact.separation[i]);
  return -least;
}

/// Leaves out the shallowest contact, the last of equals, if it is shallower than `depth`, keeping the others' order:
/// the last place is free then, and `key` is that of its pair.
bool leave_out_shallowest(Span<ContactWork> contacts, Span<ManifoldState> manifolds, Real depth, uint64_t& key) {
  uint32_t shallowest = contacts.count;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    const Real other = depth_of(contacts[i]);
    if (other > depth || (other == depth && shallowest == contacts.count)) continue;
    depth = other;
    shallowest = i;
  }
  if (shallowest == contacts.count) return false;
  key = key_of(contacts[shallowest].state);
  for (uint32_t i = shallowest; i + 1 < contacts.count; ++i) contacts[i] = contacts[i + 1];
  for (uint32_t i = shallowest; i + 1 < manifolds.count; ++i) manifolds[i] = manifolds[i + 1];
  return true;
}

/// Collides pairs in ascending order and makes the rows of those that touch, sorted by pair and part.
struct Collider {
  const StepSettings& settings;
  const StepBodies& bodies;
  const LastContacts& last;
  const ContactRoom& room;
  Losses& losses;
  ContactCount count = {};
  uint32_t next = 0;
  uint32_t last_started = UINT32_MAX;

  bool reuses() const { return last.manifolds.count != 0; }

  void meet(uint64_t key) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    // Who still sleeps was not touched when it could wake; points used again could tell otherwise.
    if (bodies.asleep(slot_a) || bodies.asleep(slot_b) || (!bodies.awake(slot_a) && !bodies.awake(slot_b))) return;
    start(slot_a);
    start(slot_b);
    if (bodies.has_parts(slot_a, slot_b)) {
      collide_all_parts(key);
      return;
    }
    ContactGeometry geometry;
    ManifoldState manifold;
    bool reused = false;
    const ContactBefore before = find_before(key, 0);
    collide_pair(settings, slot_a, slot_b, bodies, before, geometry, reuses() ? &manifold : nullptr, reused);
    count.capped += geometry.capped ? 1 : 0;
    count.reused += reused ? 1 : 0;
    if (geometry.count != 0) add(key, 0, geometry, manifold, before.contact);
  }

 private:
  /// One that rests is started when its pairs come; those of the ground come one after the other.
  void start(uint32_t slot) {
    if (bodies.visits.has(slot) || slot == last_started) return;
    bodies.start(settings, slot);
    last_started = slot;
  }

  ContactBefore find_before(uint64_t key, uint32_t part) {
    const auto contact = [&]() -> const ContactState& { return last.contacts[last.awake[next]]; };
    while (next < last.awake.count && (key_of(contact()) < key || (key_of(contact()) == key && contact().part < part)))
      ++next;
    if (next == last.awake.count || key_of(contact()) != key || contact().part != part) return {};
    return {&contact(), reuses() ? &last.manifolds[last.awake[next]] : nullptr};
  }

  __attribute__((noinline)) void collide_all_parts(uint64_t key) {
    SurfaceContacts found;
    collide_pair_parts(settings, pair_low(key), pair_high(key), bodies, found);
    count.capped += found.capped ? 1 : 0;
    count.parts_dropped += found.dropped;
    if (found.dropped != 0) losses.add(CapacityEventType::contact, pair_low(key), pair_high(key));
    for (uint32_t i = 0; i < found.count; ++i) {
      const SurfaceContact& contact = found.contact[i];
      add(key, contact.key, contact.geometry, {}, find_before(key, contact.key).contact);
    }
  }

  void add(uint64_t key, uint32_t part, const ContactGeometry& geometry, const ManifoldState& manifold,
           const ContactState* before) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    if (count.contacts == room.contacts.count) {
      ++count.dropped;
      uint64_t lost = key;
      const bool has_room = leave_out_shallowest(room.contacts, room.manifolds, depth_of(geometry), lost);
      losses.add(CapacityEventType::contact, pair_low(lost), pair_high(lost));
      if (!has_room) return;
      --count.contacts;
    }
    if (reuses()) room.manifolds[count.contacts] = manifold;
    ContactWork& work = room.contacts[count.contacts++];
    work.state = continued_contact(slot_a, slot_b, part, geometry, before);
    make_rows(settings, bodies.at(slot_a), bodies.at(slot_b), geometry, work);
  }
};

}  // namespace

uint32_t wake_touched(const StepSettings& settings, const StepBodies& bodies, const StepCacheView& cache,
                      PairPool& pool) {
  for (uint32_t woke = 0;;) {
    const uint32_t woken_before = woke;
    for (const uint64_t key : pool.pairs()) {
      const uint32_t low = pair_low(key), high = pair_high(key);
      const bool wakes_low = bodies.asleep(low) && bodies.moving(high);
      if (!wakes_low && !(bodies.asleep(high) && bodies.moving(low))) continue;
      bodies.start(settings, wakes_low ? low : high);
      if (!touch(settings, low, high, bodies)) continue;
      woke += wake_all_with(wakes_low ? low : high, bodies.activities, cache.visits);
    }
    if (woke == woken_before) return woke;
    cache.cache.contacts_known = 0;
    pool.go_on();
    cache.visits.for_each([&](uint32_t slot) {
      if (!cache.tree.has(slot)) return;
      cache.tree.remove(slot);
      find_resting_near(slot, cache.tree, pool);
    });
    pool.sort();
  }
}

ContactCount collide_pairs(const StepSettings& settings, const StepBodies& bodies, const LastContacts& last,
                           const ContactRoom& room, Losses& losses, Span<const uint64_t> pairs) {
  Collider collider = {settings, bodies, last, room, losses};
  for (const uint64_t key : pairs) collider.meet(key);
  ContactCount& count = collider.count;
  for (const ContactWork& contact : room.contacts.first(count.contacts)) count.points += contact.state.point_count;
  return count;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
