#include "world/step_contacts.h"

#include "base/binary_search.h"
#include "base/heap.h"
#include "contact/compound_ops.h"
#include "contact/contact_cache.h"
#include "contact/manifold_recycling.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Lengths of a pair, m.
struct PairLengths {
  Real at_rest;           ///< contact margin of a pair that does not move
  Real margin;            ///< contact margin: speculative_distance() for the sum of the two bodies' speeds
  Real reach;             ///< as `margin`, for the relative speed, so that bodies that move together count as slow
  Real recycle_distance;  ///< largest relative motion for which the pair's contact points are recycled

  /// Whether a point that was beyond `margin` when the contact points were computed is still too far away to touch in
  /// this tick.
  bool is_slow() const { return reach + recycle_distance <= scale_by_power(at_rest, 1); }
};

/// Sets `speed` to an upper bound, to first order, of the speed, m/s, of all surface points of body `slot` in the
/// moving axes of body `frame`. This is also an upper bound of the speed at which the two bodies approach. It is 0 if
/// they move together as one rigid body. Returns false if a value is out of range.
bool speed_in_frame(const StepBodies& bodies, uint32_t slot, uint32_t frame, Real& speed) {
  constexpr int k_power_max = 6;  // limit of each length and rate, 2^6 m or rad/s: sums of products then fit a Real
  const auto angular_velocity = [&](uint32_t of, Vec3<Real>& found) {
    const int power = k_angular_velocity_power - bodies.properties[of].size_exponent;
    const Vec3<Real>& scaled = bodies.work[of].angular_velocity;
    if (exponent_above(greatest(scaled)) + power > k_power_max) return false;
    found = scale_by_power(scaled, power);
    return true;
  };
  Vec3<Real> own, of_frame;
  if (!angular_velocity(slot, own) || !angular_velocity(frame, of_frame)) return false;
  const Vec3<Real> offset = real_difference(bodies.poses[slot].position, bodies.poses[frame].position);
  if (exponent_above(greatest(offset)) > k_power_max) return false;
  const BodyProperties& properties = bodies.properties[slot];
  const Real radius = real_from_unit(properties.bounding_radius, properties.size_exponent);
  if (exponent_above(radius) > k_power_max) return false;
  const Vec3<Real> velocity = bodies.motions[slot].linear_velocity - bodies.motions[frame].linear_velocity;
  speed = absolute_sum(velocity - cross(of_frame, offset)) + absolute_sum(own - of_frame) * radius;
  return true;
}

PairLengths lengths_of(const StepSettings& settings, const StepBodies& bodies, uint32_t slot_a, uint32_t slot_b) {
  const BodyWork &a = bodies.work[slot_a], &b = bodies.work[slot_b];
  const Real extent = min(a.extent, b.extent);
  const bool jointed = a.joint_body != k_no_link || b.joint_body != k_no_link;
  const Real margin = speculative_distance(settings, extent, a.speed + b.speed, jointed);
  PairLengths lengths = {extent * settings.contact_margin, margin, margin, extent * settings.contact_recycle_distance};
  // Continuous collision does not stop jointed bodies. So the contacts of jointed bodies must cover every motion that
  // the solver can cause.
  if (jointed || lengths.is_slow() || a.speed == k_zero || b.speed == k_zero) return lengths;
  const bool a_is_smaller = a.extent < b.extent;
  Real speed;
  if (speed_in_frame(bodies, a_is_smaller ? slot_a : slot_b, a_is_smaller ? slot_b : slot_a, speed))
    lengths.reach = min(margin, speculative_distance(settings, extent, speed, false));
  return lengths;
}

ContactMargins margins_of(const StepSettings& settings, const PairLengths& lengths) {
  return {lengths.margin, settings.sunk};
}

/// A contact of the last tick, or null. `manifold` is null if the world stores no manifolds.
struct ContactBefore {
  const ContactState* contact = nullptr;
  const ManifoldState* manifold = nullptr;
};

/// Computes the contact points of a pair of bodies. Range: the BodyWork of both is initialised (StepBodies::start()).
/// If the points of the last tick are still valid, it recycles them and sets `recycled`. Otherwise it finds new points.
/// If `manifold` is not null, it receives the data for recycling in the next tick.
void collide_pair(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const StepBodies& bodies,
                  const ContactBefore& before, ContactGeometry& geometry, ManifoldState* manifold, bool& recycled) {
  const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
  const PairLengths lengths = lengths_of(settings, bodies, slot_a, slot_b);
  recycled = before.manifold != nullptr && manifold != nullptr && lengths.is_slow() &&
             recycle_manifold(body_a, body_b, *before.manifold, before.contact->feature, before.contact->point_count,
                              lengths.recycle_distance, lengths.margin, geometry, *manifold);
  if (recycled) return;
  collide(body_a, body_b, margins_of(settings, lengths), geometry, bodies.assets, settings.reduction, bodies.features);
  if (manifold != nullptr) *manifold = lengths.is_slow() ? kept_manifold(body_a, body_b, geometry) : ManifoldState{};
}

/// A separate function, because it needs much stack.
__attribute__((noinline)) bool parts_touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b,
                                           const StepBodies& bodies) {
  TerrainContacts contacts;
  const PairLengths lengths = lengths_of(settings, bodies, slot_a, slot_b);
  collide_parts(bodies.collider(slot_a), bodies.collider(slot_b), margins_of(settings, lengths), bodies.assets,
                settings.reduction, bodies.features, contacts);
  return contacts.count != 0;
}

bool touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const StepBodies& bodies) {
  if (bodies.has_parts(slot_a, slot_b)) return parts_touch(settings, slot_a, slot_b, bodies);
  ContactGeometry geometry;
  bool recycled = false;
  collide_pair(settings, slot_a, slot_b, bodies, {}, geometry, nullptr, recycled);
  return geometry.count != 0;
}

Real depth_of(const ContactWork& contact) {
  Real least = contact.separation[0];
  for (uint32_t i = 1; i < contact.state.point_count; ++i) least = min(least, contact.separation[i]);
  return -least;
}

/// Whether a point of the contact had a normal impulse in the last tick.
bool is_pushed(const ContactWork& contact) {
  bool pushed = false;
  for (uint32_t i = 0; i < contact.state.point_count; ++i)
    pushed = pushed || contact.state.normal_impulse[i] > Real(0.0);
  return pushed;
}

/// Sorts deeper contacts first; of equally deep contacts, the one that was found first. `key`: the number of the
/// contact in the order of finding.
struct DeeperContact {
  Span<const ContactWork> contacts;

  bool operator()(const ContactOrder& a, const ContactOrder& b) const {
    const Real depth_a = depth_of(contacts[a.contact]), depth_b = depth_of(contacts[b.contact]);
    return depth_a > depth_b || (depth_a == depth_b && a.key < b.key);
  }
};

/// Swaps two contacts word by word, because a copy of a contact would take much stack.
void swap(ContactWork& a, ContactWork& b) {
  static_assert(sizeof(ContactWork) % sizeof(uint64_t) == 0);
  uint8_t *at_a = reinterpret_cast<uint8_t*>(&a), *at_b = reinterpret_cast<uint8_t*>(&b);
  for (uint32_t i = 0; i < sizeof(ContactWork); i += sizeof(uint64_t)) {
    uint64_t word_a, word_b;
    __builtin_memcpy(&word_a, at_a + i, sizeof(word_a));
    __builtin_memcpy(&word_b, at_b + i, sizeof(word_b));
    __builtin_memcpy(at_a + i, &word_b, sizeof(word_b));
    __builtin_memcpy(at_b + i, &word_a, sizeof(word_a));
  }
}

/// Implements find_contacts().
struct Collider {
  const StepSettings& settings;
  const StepBodies& bodies;
  const LastContacts& last;
  const ContactRoom& room;
  Overflow& overflow;
  ContactCount count = {};
  uint32_t next = 0;
  uint32_t rebounds = 0;  ///< 1 if any contact of two dynamic bodies may rebound
  uint32_t last_started = UINT32_MAX;

  bool recycles() const { return last.manifolds.count != 0; }

  /// Whether the step looks for contacts of this pair: neither body sleeps, and at least one body is awake (dynamic).
  bool takes(uint64_t key) const {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    // If a body of the pair still sleeps, wake_touched() has found that the bodies do not touch. Recycled contact
    // points could contradict this result, so the pair is skipped.
    return !bodies.asleep(slot_a) && !bodies.asleep(slot_b) && (bodies.awake(slot_a) || bodies.awake(slot_b));
  }
  void visit(uint64_t key) {
    if (!takes(key)) return;
    start(pair_low(key));
    start(pair_high(key));
    collide_started(key);
  }
  /// Finds the contacts of a pair. Range: start() has been called for both bodies.
  void collide_started(uint64_t key) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    if (bodies.has_parts(slot_a, slot_b)) {
      collide_all_parts(key);
      return;
    }
    ContactGeometry geometry;
    ManifoldState manifold;
    bool recycled = false;
    const PairBefore pair = find_pair(key);
    const ContactBefore before = pair.count != 0 && pair[0].part == 0 ? before_at(pair, 0) : ContactBefore{};
    collide_pair(settings, slot_a, slot_b, bodies, before, geometry, recycles() ? &manifold : nullptr, recycled);
    count.capped += geometry.capped ? 1 : 0;
    count.recycled += recycled ? 1 : 0;
    if (geometry.count != 0)
      add(key, geometry, manifold, continued_contact(slot_a, slot_b, 0, geometry, before.contact));
    else if (geometry.seam || geometry.near)
      mark_near(slot_a, slot_b);
  }

  /// Records for continuous collision that two bodies without a contact may be near each other.
  void mark_near(uint32_t slot_a, uint32_t slot_b) const {
    alone(settings.team, [&] {
      bodies.work[slot_a].colours |= k_has_near;
      bodies.work[slot_b].colours |= k_has_near;
    });
  }

  /// Restores the order in which the contacts were found. It is lost when new contacts take the places of dropped ones.
  __attribute__((noinline)) void put_in_order() {
    const Span<ContactOrder> place = room.by_depth();
    heap_sort(place, [](const ContactOrder& a, const ContactOrder& b) { return a.key < b.key; });
    for (uint32_t i = 0; i < place.count; ++i) {
      uint32_t at = i;
      while (place[at].contact != i) {
        const uint32_t from = place[at].contact;
        swap(room.contacts()[at], room.contacts()[from]);
        if (room.keeps_manifolds) {
          const ManifoldState moved = room.manifolds()[at];
          room.manifolds()[at] = room.manifolds()[from];
          room.manifolds()[from] = moved;
        }
        place[at].contact = at;
        at = from;
      }
      place[at].contact = at;
    }
  }

  /// Leaves the rebounds of pairs of dynamic bodies to continuous collision, which resolves them as impacts. The solver
  /// resolves the rebounds of two kinds of pairs itself: pairs with a compound or terrain, and pairs of which a body
  /// leans on a dynamic body. Two dynamic bodies lean on each other if their contact had a normal impulse in the last
  /// tick. Without these exceptions, a pile would cause too many impacts.
  __attribute__((noinline)) void leave_rebounds_to_impacts() const {
    const Span<ContactWork> contacts = room.contacts().first(count.contacts);
    const auto for_each_leaning = [&](const auto& visit) {
      for (const ContactWork& contact : contacts) {
        if (contact.static_pair != 0 || !is_pushed(contact)) continue;
        visit(contact.state.body_a);
        visit(contact.state.body_b);
      }
    };
    for_each_leaning([&](uint32_t slot) { room.leaning().set(slot); });
    for (ContactWork& contact : contacts) {
      const uint32_t a = contact.state.body_a, b = contact.state.body_b;
      if (contact.static_pair == 0 && !room.leaning().has(a) && !room.leaning().has(b) && !bodies.has_parts(a, b))
        leave_to_impact(settings, bodies.at(a), bodies.at(b), contact);
    }
    for_each_leaning([&](uint32_t slot) { room.leaning().clear(slot); });
  }

  /// Initialises the BodyWork of a resting body before its pairs are collided. Successive pairs often have the same
  /// resting body (the ground). The function remembers the body that it started last, and does not start it again.
  void start(uint32_t slot) {
    if (bodies.active.has(slot) || slot == last_started) return;
    bodies.start(settings, slot);
    last_started = slot;
  }

  /// Sets `next`, the position in the list of the last tick's contacts, to the first contact of this pair.
  void seek(uint64_t key) {
    next = partition_point(last.awake.count, [&](uint32_t i) { return key_of(last.contacts[last.awake[i]]) < key; });
  }
  /// Appends a contact that another Collider stored at the index `from`.
  void move(uint32_t from) {
    const uint32_t place = count.contacts++;
    if (place == from) return;
    room.contacts()[place] = room.contacts()[from];
    if (recycles()) room.manifolds()[place] = room.manifolds()[from];
  }

 private:
  PairBefore find_pair(uint64_t key) {
    const auto key_at = [&](uint32_t i) { return key_of(last.contacts[last.awake[i]]); };
    while (next < last.awake.count && key_at(next) < key) ++next;
    PairBefore pair = {last.contacts.data, last.awake.data + next};
    while (next < last.awake.count && key_at(next) == key) {
      if (pair.count < k_terrain_manifolds_max) ++pair.count;
      ++next;
    }
    return pair;
  }

  ContactBefore before_at(const PairBefore& pair, uint32_t i) const {
    return {&pair[i], recycles() ? &last.manifolds[pair.index[i]] : nullptr};
  }

  __attribute__((noinline)) void collide_all_parts(uint64_t key) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    const PairLengths lengths = lengths_of(settings, bodies, slot_a, slot_b);
    const PairBefore pair = find_pair(key);
    TerrainContacts found;
    ManifoldState manifold[k_terrain_manifolds_max];
    const bool recycled = lengths.is_slow() && recycle_parts(pair, slot_a, slot_b, lengths, found, manifold);
    if (recycled) {
      count.recycled += found.count;
    } else {
      const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
      collide_parts(body_a, body_b, margins_of(settings, lengths), bodies.assets, settings.reduction, bodies.features,
                    found);
      continue_keys(pair, found);
      bool kept = recycles() && lengths.is_slow() && !found.capped && found.dropped == 0;
      for (uint32_t i = 0; kept && i < found.count; ++i) {
        manifold[i] = kept_manifold(body_a, body_b, found.contact[i].geometry);
        kept = is_kept(manifold[i]);
      }
      for (uint32_t i = 0; !kept && i < found.count; ++i) manifold[i] = {};
    }
    if (found.count == 0 && (found.seam || found.capped)) mark_near(slot_a, slot_b);
    count.capped += found.capped ? 1 : 0;
    count.parts_dropped += found.dropped;
    if (found.dropped != 0) {
      alone(settings.team, [&] { overflow.add(CapacityEventType::contact, slot_a, slot_b); });
    }
    const uint32_t dropped_before = count.dropped;
    for (uint32_t i = 0; i < found.count; ++i) {
      const TerrainContact& contact = found.contact[i];
      const ContactState* before = nullptr;
      for (uint32_t k = 0; k < pair.count; ++k) before = pair[k].part == contact.key ? &pair[k] : before;
      ContactState state = continued_contact(slot_a, slot_b, contact.key, contact.geometry, before);
      for (uint32_t k = 0; k < pair.count; ++k) {
        if (heir_of(pair[k], found) == i) take_impulses(pair[k], state);
      }
      add(key, contact.geometry, manifold[i], state);
    }
    if (count.dropped != dropped_before) forget_manifolds(key);
  }

  /// Recycles all contacts that the pair had in the last tick. Returns false if one of them cannot be recycled, or if
  /// there are none.
  bool recycle_parts(const PairBefore& pair, uint32_t slot_a, uint32_t slot_b, const PairLengths& lengths,
                     TerrainContacts& found, ManifoldState (&manifold)[k_terrain_manifolds_max]) const {
    found.count = found.dropped = 0;
    found.capped = false;
    const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
    for (uint32_t i = 0; recycles() && i < pair.count; ++i) {
      TerrainContact& contact = found.contact[found.count];
      contact.key = pair[i].part;
      if (!recycle_manifold(body_a, body_b, last.manifolds[pair.index[i]], pair[i].feature, pair[i].point_count,
                            lengths.recycle_distance, lengths.margin, contact.geometry, manifold[found.count++]))
        return false;
    }
    return found.count != 0;
  }

  /// Clears the manifolds of a pair with dropped contacts, so that the next tick computes all contacts of the pair
  /// anew.
  __attribute__((noinline)) void forget_manifolds(uint64_t key) {
    for (uint32_t i = 0; room.keeps_manifolds && i < count.contacts; ++i) {
      if (key_of(room.contacts()[i].state) == key) room.manifolds()[i] = {};
    }
  }

  /// Called when there is no room for a contact of this depth. Drops either this contact or the shallowest stored
  /// contact, whichever is shallower, and counts it as dropped. Returns true if the stored contact is dropped. The
  /// caller must then replace it; the first entry of room.by_depth() refers to it.
  __attribute__((noinline)) bool leave_out_shallowest(Real depth, uint64_t key) {
    if (count.dropped++ == 0) {
      for (uint32_t i = 0; i < room.by_depth().count; ++i) {
        room.by_depth()[i] = {};
        room.by_depth()[i].key = room.by_depth()[i].contact = i;
      }
      heap_make(room.by_depth(), DeeperContact{room.contacts()});
    }
    uint64_t lost = key;
    bool has_room = false;
    if (room.count != 0) {
      const ContactWork& shallowest = room.contacts()[room.by_depth()[0].contact];
      has_room = depth_of(shallowest) < depth;
      if (has_room) lost = key_of(shallowest.state);
    }
    overflow.add(CapacityEventType::contact, pair_low(lost), pair_high(lost));
    if (has_room && bodies.has_parts(pair_low(lost), pair_high(lost))) forget_manifolds(lost);
    return has_room;
  }

  void add(uint64_t key, const ContactGeometry& geometry, const ManifoldState& manifold, const ContactState& state) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    const uint32_t number = count.contacts + count.dropped;
    const bool is_full = count.contacts == room.count;
    if (is_full && !leave_out_shallowest(depth_of(geometry), key)) return;
    const uint32_t place = is_full ? room.by_depth()[0].contact : count.contacts++;
    if (recycles()) room.manifolds()[place] = manifold;
    ContactWork& work = room.contacts()[place];
    work.state = state;
    // Half a tick, because make_rows() computes the arms for the middle of the tick. If the bodies only now collide,
    // their velocities change at once. The arms are then those at the start of the tick.
    const Real ahead = is_pushed(work) ? scale_by_power(settings.tick_time, -1) : k_zero;
    make_rows(settings, bodies.at(slot_a), bodies.at(slot_b), geometry, ahead, work);
    if (work.static_pair == 0 && is_positive(work.restitution)) rebounds = 1;
    if (is_full) {
      ContactOrder made = {};
      made.key = number;
      made.contact = place;
      heap_sift_down(room.by_depth(), 0, made, DeeperContact{room.contacts()});
    }
  }
};

#if DETENT_TASKS

/// A range of consecutive pairs whose contacts one thread finds, and the room for these contacts.
struct ContactPart {
  uint32_t first_pair, pair_count;
  uint32_t first;  ///< index of the first contact of the part's room
  uint32_t count;  ///< before the search: number of contacts that the room holds; after it: number found
};

/// Chooses the pairs of the next part and starts their bodies. Sets the part's room to as many contacts as its pairs
/// can have. Returns false if the remaining room does not suffice, or if there are no more pairs.
bool start_part(Collider& collider, Span<const uint64_t> pairs, ContactPart& part) {
  uint32_t contacts = 0;
  part.pair_count = 0;
  while (part.pair_count < k_pairs_shared && part.first_pair + part.pair_count < pairs.count) {
    const uint64_t key = pairs[part.first_pair + part.pair_count];
    if (collider.takes(key)) {
      collider.start(pair_low(key));
      collider.start(pair_high(key));
      contacts += collider.bodies.has_parts(pair_low(key), pair_high(key)) ? k_terrain_manifolds_max : 1;
    }
    ++part.pair_count;
  }
  part.count = contacts;
  return part.pair_count != 0 && contacts <= collider.room.count - part.first;
}

void collide_part(Collider& all, Span<const uint64_t> pairs, ContactPart& part) {
  const ContactRoom room = {all.room.scratch, part.count, all.room.keeps_manifolds, part.first};
  Collider collider = {all.settings, all.bodies, all.last, room, all.overflow};
  collider.seek(pairs[part.first_pair]);
  for (const uint64_t key : Span<const uint64_t>{pairs.data + part.first_pair, part.pair_count}) {
    if (collider.takes(key)) collider.collide_started(key);
  }
  part.count = collider.count.contacts;
  Team::add(all.count.parts_dropped, collider.count.parts_dropped);
  Team::add(all.count.capped, collider.count.capped);
  Team::add(all.count.recycled, collider.count.recycled);
  Team::add(all.rebounds, collider.rebounds);
}

/// Collides pairs on several threads, as long as the room suffices for all contacts that the pairs can have. Returns
/// the number of pairs collided.
uint32_t collide_shared(Collider& collider, Span<const uint64_t> pairs) {
  constexpr uint32_t k_parts_max = 128;
  ContactPart parts[k_parts_max];
  uint32_t done = 0;
  for (bool has_room = true; has_room;) {
    uint32_t count = 0, first = collider.count.contacts;
    for (; count < k_parts_max; ++count) {
      ContactPart& part = parts[count];
      part = {done, 0, first, 0};
      has_room = start_part(collider, pairs, part);
      if (!has_room) break;
      done += part.pair_count;
      first += part.count;
    }
    share(collider.settings.team, count, 1, [&](uint32_t from, uint32_t to) {
      for (uint32_t i = from; i < to; ++i) collide_part(collider, pairs, parts[i]);
    });
    for (const ContactPart& part : Span<ContactPart>{parts, count}) {
      for (uint32_t i = 0; i < part.count; ++i) collider.move(part.first + i);
    }
  }
  return done;
}

#else
uint32_t collide_shared(Collider&, Span<const uint64_t>) { return 0; }
#endif

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
      woke += wake_all_with(wakes_low ? low : high, bodies.activities, cache.active);
    }
    if (woke == woken_before) return woke;
    cache.cache.contacts_known = 0;
    pool.go_on();
    PairFinder finder(pool);
    cache.active.for_each([&](uint32_t slot) {
      if (!cache.tree.has(slot)) return;
      cache.tree.remove(slot);
      find_resting_near(slot, cache.tree, finder);
    });
    pool.sort();
  }
}

ContactCount find_contacts(const StepSettings& settings, const StepBodies& bodies, const LastContacts& last,
                           const ContactRoom& room, Overflow& overflow, Span<const uint64_t> pairs) {
  Collider collider = {settings, bodies, last, room, overflow};
  const uint32_t shared = settings.team == nullptr ? 0 : collide_shared(collider, pairs);
  for (uint32_t i = shared; i < pairs.count; ++i) collider.visit(pairs[i]);
  if (collider.count.dropped != 0) collider.put_in_order();
  if (collider.rebounds != 0) collider.leave_rebounds_to_impacts();
  ContactCount& count = collider.count;
  for (const ContactWork& contact : room.contacts().first(count.contacts)) count.points += contact.state.point_count;
  return count;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
