#include "world/step_contacts.h"

#include "collision/compound_code.h"
#include "collision/contact_cache.h"
#include "collision/manifold_reuse.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Lengths of a pair, m.
struct PairLengths {
  Real at_rest;  ///< how far apart it has contact points if it does not move
  Real reach;    ///< and as it moves: what it can close in this tick is added, up to a quarter of the smaller body, or
                 ///< twice that body where joints hold one
  Real reuse;    ///< how far it may move until its contact points are found anew

  /// A point that was out of reach when they were found is still farther off than the pair can close in this tick.
  bool is_slow() const { return reach + reuse <= scale_by_power(at_rest, 1); }
};

PairLengths lengths_of(const StepSettings& settings, const BodyWork& a, const BodyWork& b) {
  const Real extent = min(a.extent, b.extent), speed = a.speed + b.speed;
  const Real at_rest = extent * settings.breaking;
  // What joints hold is not stopped on its way (impact.h): its contacts foresee more.
  const bool jointed = a.joint_body != k_no_link || b.joint_body != k_no_link;
  const Real reach_max = scale_by_power(extent, jointed ? 1 : -2);
  return {at_rest, at_rest + min(reach_max, speed * settings.tick_time), extent * settings.reuse};
}

ContactReach reach_of(const StepSettings& settings, const PairLengths& lengths) {
  return {lengths.reach, settings.sunk};
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
  reused = before.manifold != nullptr && manifold != nullptr && lengths.is_slow() &&
           reuse_manifold(body_a, body_b, *before.manifold, before.contact->feature, before.contact->point_count,
                          lengths.reuse, lengths.reach, geometry, *manifold);
  if (reused) return;
  collide(body_a, body_b, reach_of(settings, lengths), geometry, bodies.assets, settings.reduction, bodies.features);
  if (manifold != nullptr) *manifold = lengths.is_slow() ? kept_manifold(body_a, body_b, geometry) : ManifoldState{};
}

/// Apart, for what it needs of the stack.
__attribute__((noinline)) bool parts_touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b,
                                           const StepBodies& bodies) {
  SurfaceContacts contacts;
  const PairLengths lengths = lengths_of(settings, bodies.work[slot_a], bodies.work[slot_b]);
  collide_parts(bodies.collider(slot_a), bodies.collider(slot_b), reach_of(settings, lengths), bodies.assets,
                settings.reduction, bodies.features, contacts);
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

/// So that all contacts of the pair are found anew: some of them are missing.
void forget_manifolds(Span<const ContactWork> contacts, Span<ManifoldState> manifolds, uint64_t key) {
  for (uint32_t i = 0; manifolds.count != 0 && i < contacts.count; ++i) {
    if (key_of(contacts[i].state) == key) manifolds[i] = {};
  }
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
  forget_manifolds(contacts.first(contacts.count - 1), manifolds, key);
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
    const PairBefore pair = find_pair(key);
    const ContactBefore before = pair.count != 0 && pair[0].part == 0 ? before_at(pair, 0) : ContactBefore{};
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

  PairBefore find_pair(uint64_t key) {
    const auto key_at = [&](uint32_t i) { return key_of(last.contacts[last.awake[i]]); };
    while (next < last.awake.count && key_at(next) < key) ++next;
    PairBefore pair = {last.contacts.data, last.awake.data + next};
    while (next < last.awake.count && key_at(next) == key) {
      if (pair.count < k_surface_manifolds_max) ++pair.count;
      ++next;
    }
    return pair;
  }

  ContactBefore before_at(const PairBefore& pair, uint32_t i) const {
    return {&pair[i], reuses() ? &last.manifolds[pair.index[i]] : nullptr};
  }

  __attribute__((noinline)) void collide_all_parts(uint64_t key) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    const PairLengths lengths = lengths_of(settings, bodies.work[slot_a], bodies.work[slot_b]);
    const PairBefore pair = find_pair(key);
    SurfaceContacts found;
    ManifoldState manifold[k_surface_manifolds_max];
    const bool reused = lengths.is_slow() && reuse_parts(pair, slot_a, slot_b, lengths, found, manifold);
    if (reused) {
      count.reused += found.count;
    } else {
      const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
      collide_parts(body_a, body_b, reach_of(settings, lengths), bodies.assets, settings.reduction, bodies.features,
                    found);
      continue_keys(pair, found);
      bool kept = reuses() && lengths.is_slow() && !found.capped && found.dropped == 0;
      for (uint32_t i = 0; kept && i < found.count; ++i) {
        manifold[i] = kept_manifold(body_a, body_b, found.contact[i].geometry);
        kept = is_kept(manifold[i]);
      }
      for (uint32_t i = 0; !kept && i < found.count; ++i) manifold[i] = {};
    }
    count.capped += found.capped ? 1 : 0;
    count.parts_dropped += found.dropped;
    if (found.dropped != 0) losses.add(CapacityEventType::contact, slot_a, slot_b);
    const uint32_t dropped_before = count.dropped;
    for (uint32_t i = 0; i < found.count; ++i) {
      const SurfaceContact& contact = found.contact[i];
      const ContactState* before = nullptr;
      for (uint32_t k = 0; k < pair.count; ++k) before = pair[k].part == contact.key ? &pair[k] : before;
      add(key, contact.key, contact.geometry, manifold[i], before);
    }
    if (count.dropped != dropped_before) forget_manifolds(room.contacts.first(count.contacts), room.manifolds, key);
  }

  /// The contacts of the last tick, where all of the pair will do.
  bool reuse_parts(const PairBefore& pair, uint32_t slot_a, uint32_t slot_b, const PairLengths& lengths,
                   SurfaceContacts& found, ManifoldState (&manifold)[k_surface_manifolds_max]) const {
    found.count = found.dropped = 0;
    found.capped = false;
    const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
    for (uint32_t i = 0; reuses() && i < pair.count; ++i) {
      SurfaceContact& contact = found.contact[found.count];
      contact.key = pair[i].part;
      if (!reuse_manifold(body_a, body_b, last.manifolds[pair.index[i]], pair[i].feature, pair[i].point_count,
                          lengths.reuse, lengths.reach, contact.geometry, manifold[found.count++]))
        return false;
    }
    return found.count != 0;
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
