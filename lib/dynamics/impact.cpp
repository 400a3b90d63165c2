#include "dynamics/impact.h"

#include "collision/broadphase.h"
#include "collision/compound_code.h"
#include "collision/contact_arm.h"
#include "dynamics/activity.h"
#include "dynamics/gyration.h"
#include "dynamics/impact_pair.h"
#include "dynamics/impact_response.h"
#include "dynamics/spin.h"
#include "geometry/bounds.h"
#include "geometry/shape_traits.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_zero = 0.0;
constexpr Vec3<Real> k_none = {k_zero, k_zero, k_zero};

// What comes next of a pair.
constexpr uint8_t k_next_none = 0;
constexpr uint8_t k_next_impact = 1;
constexpr uint8_t k_next_undecided = 2;  ///< up to there it is clear
constexpr uint8_t k_next_look = 3;       ///< it is tested again, from farther out on the ladder if it has parted

/// Of a pair that touches after an impact: until it is looked at again, twice as long each time.
constexpr int k_look_power = -10;
constexpr uint32_t k_looks_max = 16;
constexpr int k_rounds_max = 64;  ///< of passing a blow on

// Marks of a body's sweep.
constexpr uint32_t k_mark_stopped = 1;  ///< it stays where it is
constexpr uint32_t k_mark_changed = 2;  ///< its new sweep is yet to be tested
constexpr uint32_t k_mark_struck = 8;   ///< its momentum goes with its sweep
constexpr uint32_t k_mark_slept = 16;   ///< it was asleep when the tick began
constexpr uint32_t k_mark_strayed = 4;  ///< its sweep leaves the bounds that the pairs were found by

bool is_half_space(const BodyTraits& traits) { return shape_of(traits) == ShapeType::half_space; }
bool is_at_rest(const BodySweep& sweep) { return sweep.displacement == k_none && sweep.turn == k_none; }

bool holds(const Bounds& outer, const Bounds& inner) {
  return outer.lower.x <= inner.lower.x && inner.upper.x <= outer.upper.x && outer.lower.y <= inner.lower.y &&
         inner.upper.y <= outer.upper.y && outer.lower.z <= inner.lower.z && inner.upper.z <= outer.upper.z;
}

/// Bounds of a body over a sweep, with a margin below that of the bounds that pairs are found by.
Bounds bounds_over(const BodyTraits& traits, const BodyPose& pose, const Sweep& sweep) {
  if (is_aloof(traits)) return k_nowhere;
  if (is_half_space(traits)) return k_everywhere;
  const Real margin = scale_by_power(bounds_extent(traits), -8);
  Vec3<Real> reach = half_bounds(traits, matrix_from(pose.rotation));
  if (!(sweep.turn == k_none)) {
    const Real ball = real_from_unit(traits.bounding_radius, traits.size_exponent);
    const Real swing = ball * min(length(sweep.turn), Real(4.0));
    reach = {min(reach.x + swing, ball), min(reach.y + swing, ball), min(reach.z + swing, ball)};
  }
  reach += {margin, margin, margin};
  const Vec3<Real>& way = sweep.displacement;
  bool beyond = false;  // clamped bounds still contain the body
  const Position& at = pose.position;
  return {{coord_advance(at.x, min(way.x, k_zero) - reach.x, beyond),
           coord_advance(at.y, min(way.y, k_zero) - reach.y, beyond),
           coord_advance(at.z, min(way.z, k_zero) - reach.z, beyond)},
          {coord_advance(at.x, max(way.x, k_zero) + reach.x, beyond),
           coord_advance(at.y, max(way.y, k_zero) + reach.y, beyond),
           coord_advance(at.z, max(way.z, k_zero) + reach.z, beyond)}};
}

uint64_t key_of(const ContactState& contact) { return pair_key(contact.body_a, contact.body_b); }

/// The contacts of a pair from the first one on.
Span<const ContactWork> pair_contacts(Span<const ContactWork> from, uint64_t key) {
  uint32_t count = 0;
  while (count < from.count && key_of(from[count].state) == key) ++count;
  return from.first(count);
}

/// The contacts of a pair.
Span<const ContactWork> find_contacts(Span<const ContactWork> contacts, uint64_t key) {
  uint32_t low = 0, high = contacts.count;
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    if (key_of(contacts[middle].state) < key)
      low = middle + 1;
    else
      high = middle;
  }
  return pair_contacts({contacts.data + low, contacts.count - low}, key);
}

struct Stage {
  const StepSettings& settings;
  const AssetTable& assets;
  const FeatureTable& features;
  const ImpactPairs& known;
  const ImpactBodies& bodies;
  Span<ImpactPair> met;
  Span<ImpactHit> hits;
  ImpactProbe* probe;
  Scaled tick_rate;
  bool filters;
  uint32_t met_count = 0;
  uint32_t changed_count = 0;
  Real first_approach = 0.0;  ///< of the impact that is being resolved, m/s
  ImpactReport report = {};

  SweptBody body(uint32_t slot) const { return {bodies.traits[slot], bodies.poses[slot], bodies.sweeps[slot]}; }
  bool dynamic(uint32_t slot) const { return is_dynamic(bodies.traits[slot]); }

  void write_down(uint32_t slot) {
    if (probe == nullptr) return;
    const uint32_t at = probe->segment_count++;
    if (at >= probe->segments.count) return;
    const BodySweep& sweep = bodies.sweeps[slot];
    const Sweep rest = rest_of(sweep, sweep.from);
    probe->segments[at] = {slot, 0, sweep.from, bodies.poses[slot], rest.displacement, rest.turn};
  }

  void set_bounds(uint32_t slot) {
    const BodySweep& sweep = bodies.sweeps[slot];
    bodies.bounds[slot] = bounds_over(bodies.traits[slot], bodies.poses[slot], rest_of(sweep, sweep.from));
  }

  /// The body no longer rests, or not where it did.
  void leave_rest(uint32_t slot) {
    bodies.visits.set(slot);
    if (bodies.resting.has(slot)) bodies.resting.remove(slot);
  }

  /// Makes candidates of all bodies whose bounds overlap those of `slot`.
  __attribute__((noinline)) void find_near(uint32_t slot) {
    const Bounds& box = bodies.bounds[slot];
    bodies.resting.for_each_near(box, [&](uint32_t other) { bodies.candidates.set(other); });
    bodies.visits.for_each([&](uint32_t other) {
      if (overlap(box, bodies.bounds[other])) bodies.candidates.set(other);
    });
  }

  /// Visits all other bodies that may touch `slot` and whose bounds overlap its, in the order of their slots.
  template <class Visit>
  void for_each_near(uint32_t slot, const Visit& visit) {
    find_near(slot);
    bodies.candidates.for_each([&](uint32_t other) {
      bodies.candidates.clear(other);
      // What went before may have stopped either.
      if (other != slot && overlap(bodies.bounds[slot], bodies.bounds[other]) && may_meet(slot, other)) visit(other);
    });
  }

  /// The body's sweep begins anew at `time`, as it was.
  void move_to(uint32_t slot, Fraction time) {
    leave_rest(slot);
    BodySweep& sweep = bodies.sweeps[slot];
    const bool struck = (sweep.marks & k_mark_struck) != 0;
    sweep.marks |= k_mark_struck;
    // The solver's momentum is that of the tick's end.
    const Quat from = struck ? bodies.poses[slot].rotation : end_rotation(slot);
    if (time > sweep.from) {
      if (bodies.listener.ended != nullptr) bodies.listener.ended(bodies.listener.context, slot, time);
      bodies.poses[slot] = pose_at(body(slot), time);
    }
    sweep.from = time;
    Vec3<Real>& momentum = bodies.motions[slot].momentum;
    momentum = carried_momentum(bodies.traits[slot], from, bodies.poses[slot].rotation, momentum);
  }

  Quat end_rotation(uint32_t slot) const {
    const BodySweep& sweep = bodies.sweeps[slot];
    return sweep_end_rotation(bodies.poses[slot].rotation, rest_of(sweep, sweep.from));
  }

  /// Brings the momentum of the bodies that were struck to the end of the tick.
  void carry_to_end() {
    bodies.visits.for_each([&](uint32_t slot) {
      if ((bodies.sweeps[slot].marks & k_mark_struck) == 0) return;
      Vec3<Real>& momentum = bodies.motions[slot].momentum;
      momentum = carried_momentum(bodies.traits[slot], bodies.poses[slot].rotation, end_rotation(slot), momentum);
    });
  }

  /// The body, which is at `time`, now moves in another way: what was found of it no longer holds.
  void change(uint32_t slot) {
    BodySweep& sweep = bodies.sweeps[slot];
    set_bounds(slot);
    write_down(slot);
    if ((sweep.marks & k_mark_changed) == 0) ++changed_count;
    sweep.marks |= k_mark_changed;
    for (uint32_t i = 0; i < met_count; ++i) {
      if (pair_low(met[i].key) == slot || pair_high(met[i].key) == slot) met[i].next = k_next_none;
    }
  }

  /// The body stays where it is until the tick ends.
  void stop(uint32_t slot, Fraction time) {
    BodySweep& sweep = bodies.sweeps[slot];
    if (!dynamic(slot) || (sweep.marks & k_mark_stopped) != 0) return;
    move_to(slot, time);
    sweep.displacement = sweep.turn = k_none;
    sweep.marks |= k_mark_stopped;
    ++report.bodies_stopped;
    report.lost_time += sweep_part({{Real(1.0), k_zero, k_zero}, k_none}, k_whole_step - time).displacement.x;
    change(slot);
  }

  bool jointed(uint32_t slot) const { return bodies.sweeps[slot].marks >= k_mark_jointed; }

  /// False for pairs that filters or joints keep apart, and for those of one tree of joints; and where joints hold one,
  /// for half-spaces, which contacts alone keep anything from passing: a body that stops alone tears at its joints.
  bool may_meet(uint32_t a, uint32_t b) const {
    if (!PairFilter{bodies.traits, bodies.filter_rules, known.apart}.allows(a, b)) return false;
    if (!jointed(a) && !jointed(b)) return true;
    if (is_half_space(bodies.traits[a]) || is_half_space(bodies.traits[b])) return false;
    return bodies.sweeps[a].marks / k_mark_jointed != bodies.sweeps[b].marks / k_mark_jointed;
  }

  ImpactPair* find_met(uint64_t key) {
    for (uint32_t i = 0; i < met_count; ++i) {
      if (met[i].key == key) return &met[i];
    }
    return nullptr;
  }

  /// True if the point of an impact that is found at once isn't about to come closer.
  bool parts(const SweptBody& a, const SweptBody& b, const TimeOfImpact& impact) const {
    const BodyPose pose_a = pose_at(a, impact.time), pose_b = pose_at(b, impact.time);
    const Vec3<Real> offset = offset_of(pose_a, pose_b);
    const Vec3<Real> way = b.sweep.displacement - a.sweep.displacement;
    const Vec3<Real> arm_b = impact.point - offset;
    const Real swing_a = dot(cross(impact.point, impact.normal), a.sweep.turn);
    const Real swing_b = dot(cross(arm_b, impact.normal), b.sweep.turn);
    // What is slower does not come through the next rung in this tick.
    const Real slow = scale_by_power(min(shape_extent(a.traits), shape_extent(b.traits)), -12);
    return dot(way, impact.normal) + (swing_b - swing_a) >= -slow;
  }

  /// Whether the solver has pushed a pair apart in this tick.
  bool is_pushed(uint64_t key) const {
    bool pushed = false;
    for (const ContactWork& contact : find_contacts(known.contacts, key)) {
      for (uint32_t i = 0; i < contact.state.point_count; ++i) pushed = pushed || contact.impulse_max[i] > k_zero;
    }
    return pushed;
  }

  Real extent_of(uint64_t key) const {
    return min(shape_extent(bodies.traits[pair_low(key)]), shape_extent(bodies.traits[pair_high(key)]));
  }

  bool is_ball(uint32_t slot) const { return bodies.traits[slot].shape == static_cast<uint32_t>(ShapeType::sphere); }

  /// On which rung of the ladder a pair with these contacts, or none, starts, and by how much at least its inset bodies
  /// are apart, m. Where joints hold one it is so far in that it meets only what it would have passed.
  Real first_inset(uint64_t key, Span<const ContactWork> contacts, Real& apart) const {
    const Real inset = free_inset(key, contacts, apart);
    if (!jointed(pair_low(key)) && !jointed(pair_high(key))) return inset;
    const Real held = max(inset, scale_by_power(extent_of(key), -2) + scale_by_power(extent_of(key), -3));
    apart += held - inset;
    return held;
  }
  Real free_inset(uint64_t key, Span<const ContactWork> contacts, Real& apart) const {
    const Real extent = extent_of(key);
    if (contacts.count == 0) {
      apart = known.complete ? scale_by_power(extent, -6) : k_zero;
      return k_zero;
    }
    Real least = contacts[0].separation[0];
    bool rebounds = false;
    for (const ContactWork& contact : contacts) {
      for (uint32_t i = 0; i < contact.state.point_count; ++i) least = min(least, contact.separation[i]);
      rebounds = rebounds || is_positive(contact.restitution);
    }
    if (least > scale_by_power(extent, -10)) {
      apart = scale_by_power(least, -1);
      // A ball that the solver has let bounce touches when the tick ends: within a query's tolerance that would be an
      // impact. Of other shapes another place may come first.
      const bool bounces = is_ball(pair_low(key)) || is_ball(pair_high(key));
      return bounces && rebounds && is_pushed(key) ? next_inset(extent, k_zero) : k_zero;
    }
    const Real inset = contact_inset(extent, -least);
    apart = least + inset;  // but one of the two insets: the points of a contact need not show all of its depth
    return inset;
  }

  /// The pair's entry, made if there is none; null if there is no room.
  ImpactPair* entry_of(uint64_t key, ImpactPair* entry) {
    if (entry != nullptr) return entry;
    if (met_count == met.count) return nullptr;
    entry = &met[met_count++];
    *entry = {};
    entry->key = key;
    return entry;
  }

  /// Finds when a pair meets next, and keeps it if it does. `inset`: the rung to begin at; `entry`: the pair's, or
  /// null.
  void test(uint64_t key, Fraction time, Real inset, ImpactPair* entry) {
    const SweptBody a = body(pair_low(key)), b = body(pair_high(key));
    const bool resolved = entry != nullptr && entry->impacts != 0 && entry->last == time;
    const Real first = inset, extent = extent_of(key);
    TimeOfImpact impact;
    if (entry != nullptr) entry->next = k_next_none;
    for (;; inset = next_inset(extent, inset)) {
      if (inset > last_inset(extent)) {
        ++report.overlaps_left;
        // What is this deep since it met within the tick, and does not part, would go through.
        if (!resolved || (is_direction(impact.normal) && parts(a, b, impact))) return;
        stop(pair_low(key), time);
        stop(pair_high(key), time);
        return;
      }
      ++report.tests;
      if (!pair_impact(assets, features, a, b, time, inset, impact)) {
        ++report.undecided;
        return;
      }
      if (impact.outcome == ToiOutcome::clear || impact.time > time) break;
      if (impact.outcome == ToiOutcome::undecided && !resolved) break;
      // They touch now. Cores that overlap have no normal.
      if (!resolved && is_direction(impact.normal) && !parts(a, b, impact)) break;
    }
    const Fraction look = look_after(time, inset == first ? 0 : 1 + (entry == nullptr ? 0 : entry->looks));
    const bool meets = impact.outcome != ToiOutcome::clear, looks = look < k_whole_step && first == k_zero;
    if (!meets && !looks) return;
    entry = entry_of(key, entry);
    if (entry == nullptr) {
      if (!meets) return;
      ++report.pairs_dropped;
      stop(pair_low(key), time);
      stop(pair_high(key), time);
      return;
    }
    if (looks && (!meets || look < impact.time)) {
      ++entry->looks;
      entry->next = k_next_look;
      entry->time = look;
      return;
    }
    entry->next = impact.outcome == ToiOutcome::undecided ? k_next_undecided : k_next_impact;
    entry->time = impact.time;
    entry->normal = impact.normal;
    entry->point = impact.point;
  }

  /// When to look again at a pair that was `looks` times found touching; 1 for never.
  static Fraction look_after(Fraction time, uint32_t looks) {
    if (looks == 0 || looks > k_looks_max) return k_whole_step;
    const uint32_t power = looks < 10 ? looks - 1 : 9;
    const int64_t after = (int64_t{1} << (Fraction::k_frac + k_look_power)) << power;
    return after < k_whole_step.raw - time.raw ? Fraction::from_raw(time.raw + after) : k_whole_step;
  }

  /// Tests a pair from the start of the tick, unless it is sure to be clear.
  void test_at_start(uint64_t key, Span<const ContactWork> contacts) {
    const uint32_t low = pair_low(key), high = pair_high(key);
    if (!dynamic(low) && !dynamic(high)) return;
    if (is_at_rest(bodies.sweeps[low]) && is_at_rest(bodies.sweeps[high])) return;
    if (!overlap(bodies.bounds[low], bodies.bounds[high]) || !may_meet(low, high)) return;
    Real apart = k_zero, closing = k_zero;
    const Real inset = first_inset(key, contacts, apart);
    const Fraction start = 0.0;
    // The sum of both motions is cheap, and mostly enough.
    const bool slow = bodies.sweeps[low].reach + bodies.sweeps[high].reach < apart;
    if (filters && (slow || (closing_bound(body(low), body(high), start, closing) && closing < apart))) {
      ++report.skipped;
      return;
    }
    test(key, start, inset, nullptr);
  }

  void find_first() {
    bodies.visits.for_each([&](uint32_t slot) {
      BodySweep& sweep = bodies.sweeps[slot];
      if (is_aloof(bodies.traits[slot])) {
        write_down(slot);
        return;
      }
      if (!is_at_rest(sweep)) {
        const Bounds found_by = bodies.bounds[slot];
        set_bounds(slot);
        write_down(slot);
        if (!holds(found_by, bodies.bounds[slot])) sweep.marks |= k_mark_strayed;
        if (!motion_bound(body(slot), sweep.from, sweep.reach)) sweep.reach = scale_by_power(k_real_max, -2);
      }
      if (!filters || !known.complete) sweep.marks |= k_mark_strayed;
    });
    Span<const ContactWork> rest = known.contacts;
    const auto go_on = [&rest](uint32_t count) { rest = {rest.data + count, rest.count - count}; };
    for (const uint64_t key : known.pairs) {
      while (rest.count != 0 && key_of(rest[0].state) < key) go_on(1);
      test_at_start(key, pair_contacts(rest, key));
    }
    bodies.visits.for_each([&](uint32_t a) {
      if ((bodies.sweeps[a].marks & k_mark_strayed) == 0) return;
      for_each_near(a, [&](uint32_t b) {
        if (b < a && (bodies.sweeps[b].marks & k_mark_strayed) != 0) return;
        const uint64_t key = key_of_pair(a, b);
        if (!has_pair(known.pairs, key)) test_at_start(key, find_contacts(known.contacts, key));
      });
    });
  }

  /// Tests the new sweep of a body against all others.
  void test_changed(uint32_t slot, Fraction time) {
    bodies.sweeps[slot].marks &= ~k_mark_changed;
    --changed_count;
    for_each_near(slot, [&](uint32_t other) {
      if (is_at_rest(bodies.sweeps[slot]) && is_at_rest(bodies.sweeps[other])) return;
      const uint64_t key = key_of_pair(slot, other);
      ImpactPair* entry = find_met(key);
      Real apart = k_zero;
      test(key, time, first_inset(key, find_contacts(known.contacts, key), apart), entry);
    });
  }

  void test_all_changed(Fraction time) {
    while (changed_count != 0) {
      bodies.visits.for_each([&](uint32_t slot) {
        if ((bodies.sweeps[slot].marks & k_mark_changed) != 0) test_changed(slot, time);
      });
    }
  }

  ImpactPair* next() {
    ImpactPair* best = nullptr;
    for (uint32_t i = 0; i < met_count; ++i) {
      ImpactPair& pair = met[i];
      if (pair.next == k_next_none) continue;
      if (best == nullptr || pair.time < best->time || (pair.time == best->time && pair.key < best->key)) best = &pair;
    }
    return best;
  }

  /// The contact points of the bodies themselves; none where they do not agree with the time of impact: deep within a
  /// thin body the least way out may lead through it.
  void find_points(const ImpactPair& pair, const BodyPose& pose_a, const BodyPose& pose_b, ContactGeometry& geometry) {
    const BodyTraits &a = bodies.traits[pair_low(pair.key)], &b = bodies.traits[pair_high(pair.key)];
    const Matrix3 rotation_a = matrix_from(pose_a.rotation), rotation_b = matrix_from(pose_b.rotation);
    const Real reach = scale_by_power(extent_of(pair.key), -10);
    const CollisionBody body_a = {pose_a, a, rotation_a}, body_b = {pose_b, b, rotation_b};
    if (has_parts(a, b))
      find_part_points(pair, body_a, body_b, reach, geometry);
    else
      collide(body_a, body_b, reach, geometry, assets, settings.reduction, features);
    if (has_normal(pair) && geometry.count != 0 && !(dot(geometry.normal, pair.normal) > Unit(0.0))) geometry.count = 0;
  }

  /// Of the part whose normal is nearest to that of the impact, or if that has none of the deepest.
  __attribute__((noinline)) void find_part_points(const ImpactPair& pair, const CollisionBody& a,
                                                  const CollisionBody& b, Real reach, ContactGeometry& geometry) {
    SurfaceContacts contacts;
    collide_parts(a, b, reach, assets, settings.reduction, features, contacts);
    const SurfaceContact* best = nullptr;
    Real most = k_zero;
    for (uint32_t i = 0; i < contacts.count; ++i) {
      const ContactGeometry& found = contacts.contact[i].geometry;
      Real rank = real_from_unit(dot(found.normal, pair.normal), 0);
      for (uint32_t k = 0; !has_normal(pair) && k < found.count; ++k) rank = max(rank, -found.point[k].separation);
      if (best != nullptr && !(rank > most)) continue;
      best = &contacts.contact[i];
      most = rank;
    }
    geometry.count = 0;
    if (best != nullptr) geometry = best->geometry;
  }

  /// The point that the time of impact was found by.
  void take_point(const ImpactPair& pair, const BodyPose& pose_a, const BodyPose& pose_b, ContactGeometry& geometry) {
    const BodyTraits &a = bodies.traits[pair_low(pair.key)], &b = bodies.traits[pair_high(pair.key)];
    const auto arm = [](const BodyTraits& traits, const Vec3<Real>& point) {
      const Unit zero = 0.0;
      if (is_half_space(traits)) return Vec3<Unit>{zero, zero, zero};
      return arm_of_way(point, traits.size_exponent);
    };
    geometry.count = 1;
    geometry.normal = pair.normal;
    geometry.point[0] = {arm(a, pair.point), arm(b, pair.point - offset_of(pose_a, pose_b)), k_zero, 1};
  }
  static bool is_direction(const Vec3<Unit>& normal) {
    return !(normal == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)});
  }
  static bool has_normal(const ImpactPair& pair) { return is_direction(pair.normal); }

  void wake(uint32_t slot) {
    if (bodies.activities[slot].asleep == 0) return;
    bodies.sweeps[slot].marks |= k_mark_slept;
    report.woke += wake_all_with(slot, bodies.activities, bodies.visits);
  }

  /// The velocity that gravity has yet to give a body after `time`.
  Vec3<Real> fall_after(uint32_t slot, Fraction time) const {
    const BodyTraits& traits = bodies.traits[slot];
    if (!is_dynamic(traits) || (bodies.sweeps[slot].marks & k_mark_slept) != 0) return k_none;
    const Vec3<Real> fall = settings.gravity * settings.tick_time;
    bool saturated = false;
    const Vec3<Real> own = {multiply(fall.x, traits.gravity_scale, saturated),
                            multiply(fall.y, traits.gravity_scale, saturated),
                            multiply(fall.z, traits.gravity_scale, saturated)};
    return sweep_part({own, k_none}, k_whole_step - time).displacement;
  }

  /// The speed, m/s, at which a pair parts on its sweeps at least. An overlap is made good; and what has met before in
  /// this tick, as what turns or rolls on an edge does again and again, hops, the farther the more often, so that a few
  /// impacts see it through the tick. The bodies' own velocities know nothing of it.
  Real parting_speed(const ImpactPair& pair, const ContactWork& contact, uint32_t count) const {
    bool saturated = false;
    Real depth = k_zero, approach = k_zero;
    for (uint32_t i = 0; i < count; ++i) {
      depth = max(depth, -contact.separation[i]);
      approach = max(approach, -contact.approach[i]);
    }
    const Real half_in_a_tick = scale_by_power(multiply(depth, tick_rate, saturated), -1);
    if (pair.impacts == 0)
      return max(half_in_a_tick, min(scale_by_power(half_in_a_tick, 6), scale_by_power(approach, -2)));
    const int power = pair.impacts < 2 ? -2 : pair.impacts < 5 ? -1 : 0;
    return max(max(half_in_a_tick, scale_by_power(approach, power)), bend_speed(pair));
  }

  /// What the turning of both bodies brings them together by in the rest of the tick, however they part, as a speed,
  /// m/s: a 16th of it where they have met twice, and up to all of it later on.
  Real bend_speed(const ImpactPair& pair) const {
    const uint32_t a = pair_low(pair.key), b = pair_high(pair.key);
    const auto radius = [&](uint32_t slot) {
      const BodyTraits& traits = bodies.traits[slot];
      return real_from_unit(traits.bounding_radius, traits.size_exponent);
    };
    const BodySweep &sweep_a = bodies.sweeps[a], &sweep_b = bodies.sweeps[b];
    constexpr Real k_turn = 2.0;  // beyond it they have turned away
    const Real turn_a = min(length(sweep_a.turn), k_turn), turn_b = min(length(sweep_b.turn), k_turn);
    const Real way = length(sweep_b.displacement - sweep_a.displacement);
    const Real bend = turn_a * turn_a * radius(a) + turn_b * turn_b * radius(b) + (turn_a + turn_b) * way;
    const Real part = sweep_part({{bend, k_zero, k_zero}, k_none}, k_whole_step - pair.time).displacement.x;
    const int power = (pair.impacts < 5 ? pair.impacts : 5) - 5;
    bool saturated = false;
    return multiply(scale_by_power(part, power), tick_rate, saturated);
  }

  /// Lets the bodies of a pair part.
  void resolve(ImpactPair& pair, bool undecided, const BodyPose& pose_a, const BodyPose& pose_b) {
    ContactGeometry geometry;
    find_points(pair, pose_a, pose_b, geometry);
    if (geometry.count != 0 && resolve_at(pair, geometry, pose_a, pose_b, false)) return;
    if (undecided || !has_normal(pair)) return;
    take_point(pair, pose_a, pose_b, geometry);
    resolve_at(pair, geometry, pose_a, pose_b, false);
  }

  /// Passes a blow on to what the bodies of a pair touch since an impact of this tick, and back, until all part: a body
  /// between two others would else be struck to and fro without end. Pairs are taken by their keys.
  void pass_on(const ImpactPair& first, Fraction time) {
    const uint64_t first_key = first.key;
    for (int round = 0; round < k_rounds_max; ++round) {
      bool again = false;
      uint64_t after = 0;
      while (ImpactPair* pair = next_touching(first_key, after)) {
        after = pair->key;
        if (round == 0 && after == first_key) continue;
        again = meet_again(*pair, time) || again;
      }
      if (!again) break;
    }
  }

  /// The pair of the least key above `after` that has met in this tick and shares a dynamic body with the first one.
  ImpactPair* next_touching(uint64_t first_key, uint64_t after) {
    ImpactPair* best = nullptr;
    for (uint32_t i = 0; i < met_count; ++i) {
      ImpactPair& pair = met[i];
      if (pair.impacts == 0 || pair.key <= after || (best != nullptr && pair.key > best->key)) continue;
      const uint32_t a = pair_low(pair.key), b = pair_high(pair.key);
      const auto shared = [&](uint32_t slot) {
        return dynamic(slot) && (slot == pair_low(first_key) || slot == pair_high(first_key));
      };
      if (shared(a) || shared(b)) best = &pair;
    }
    return best;
  }

  /// Resolves a pair that may still touch. False if it does not, or does not come together.
  bool meet_again(ImpactPair& pair, Fraction time) {
    const uint32_t slots[2] = {pair_low(pair.key), pair_high(pair.key)};
    const BodyPose pose_a = pose_at(body(slots[0]), time), pose_b = pose_at(body(slots[1]), time);
    ContactGeometry geometry;
    const Fraction next_time = pair.time;
    pair.time = time;
    find_points(pair, pose_a, pose_b, geometry);
    for (const uint32_t slot : slots) {
      if (geometry.count != 0 && dynamic(slot)) move_to(slot, time);
    }
    if (geometry.count == 0 || !resolve_at(pair, geometry, pose_a, pose_b, true)) {
      pair.time = next_time;
      return false;
    }
    pair.last = time;
    for (const uint32_t slot : slots) {
      if (dynamic(slot)) change(slot);
    }
    return true;
  }

  /// Likewise, at the given points. False, and nothing changed, if the bodies do not come together there. `again`: the
  /// blow has been counted.
  bool resolve_at(ImpactPair& pair, const ContactGeometry& geometry, const BodyPose& pose_a, const BodyPose& pose_b,
                  bool again) {
    const uint32_t a = pair_low(pair.key), b = pair_high(pair.key);
    const BodyTraits &traits_a = bodies.traits[a], &traits_b = bodies.traits[b];
    const BodyMotion before_a = motion_of_sweep(traits_a, pose_a.rotation, bodies.sweeps[a], tick_rate);
    const BodyMotion before_b = motion_of_sweep(traits_b, pose_b.rotation, bodies.sweeps[b], tick_rate);
    ContactWork contact;
    contact.state = {};
    contact.state.point_count = static_cast<uint8_t>(geometry.count);
    const WorldGyration gyration_a = world_gyration(traits_a, matrix_from(pose_a.rotation));
    const WorldGyration gyration_b = world_gyration(traits_b, matrix_from(pose_b.rotation));
    const Vec3<Real> spin_a = world_spin(traits_a, gyration_a, before_a.momentum, -k_spin_power);
    const Vec3<Real> spin_b = world_spin(traits_b, gyration_b, before_b.momentum, -k_spin_power);
    const Real extent_a = shape_extent(traits_a), extent_b = shape_extent(traits_b);
    make_rows(settings, {traits_a, pose_a, before_a, gyration_a, spin_a, extent_a, fall_speed(settings, extent_a)},
              {traits_b, pose_b, before_b, gyration_b, spin_b, extent_b, fall_speed(settings, extent_b)}, geometry,
              contact);
    BodyMotion after_a = before_a, after_b = before_b;
    Real approach = k_zero;
    const Real parting = again ? k_zero : parting_speed(pair, contact, geometry.count);
    const Real least = again ? scale_by_power(first_approach, -12) : k_zero;
    const auto resolves = [&](Real least_approach, Real leave, BodyMotion& motion_a, BodyMotion& motion_b,
                              Real& found) {
      return resolve_impact(contact, geometry.count, least_approach, leave, {traits_a, pose_a.rotation, motion_a},
                            {traits_b, pose_b.rotation, motion_b}, found);
    };
    if (!resolves(least, parting, after_a, after_b, approach)) return false;
    wake(a);
    wake(b);
    report.clamped += hold_spin(traits_a, pose_a.rotation, after_a) + hold_spin(traits_b, pose_b.rotation, after_b);
    const auto change_sweep = [&](uint32_t slot, const BodyPose& pose, const BodyMotion& before,
                                  const BodyMotion& after) {
      if (!dynamic(slot) || (bodies.sweeps[slot].marks & k_mark_stopped) != 0) return;
      report.clamped +=
          add_to_sweep(bodies.traits[slot], pose.rotation, before, after, settings.tick_time, bodies.sweeps[slot]);
    };
    change_sweep(a, pose_a, before_a, after_a);
    change_sweep(b, pose_b, before_b, after_b);

    const Vec3<Real> fall_a = fall_after(a, pair.time), fall_b = fall_after(b, pair.time);
    BodyMotion motion_a = bodies.motions[a], motion_b = bodies.motions[b];
    motion_a.velocity -= fall_a;
    motion_b.velocity -= fall_b;
    Real approach_of_state = k_zero;
    // A slow rest of what the solver has pushed is left to it: it goes on in the next tick.
    const Real least_of_state = is_pushed(pair.key) ? contact.rebound_min : k_zero;
    if (resolves(least_of_state, k_zero, motion_a, motion_b, approach_of_state)) {
      motion_a.velocity += fall_a;
      motion_b.velocity += fall_b;
      report.clamped += hold_spin(traits_a, pose_a.rotation, motion_a) + hold_spin(traits_b, pose_b.rotation, motion_b);
      if (dynamic(a)) bodies.motions[a] = motion_a;
      if (dynamic(b)) bodies.motions[b] = motion_b;
    }

    if (again) return true;
    first_approach = approach;
    ++report.impacts;
    if (pair.impacts < UINT8_MAX) ++pair.impacts;
    if (report.hits < hits.count)
      hits[report.hits++] = {pair.key, pair.time, point_of(geometry, pose_a, pose_b, traits_a, traits_b),
                             geometry.normal, approach};
    else
      ++report.hits_dropped;
    return true;
  }

  /// The middle of the points, world.
  static Position point_of(const ContactGeometry& geometry, const BodyPose& pose_a, const BodyPose& pose_b,
                           const BodyTraits& a, const BodyTraits& b) {
    static constexpr Unit k_share[k_manifold_points_max] = {1.0, 0.5, 1.0 / 3.0, 0.25};
    const bool by_b = is_ground(a);  // which may be large, or has no arms
    const int exponent = by_b ? b.size_exponent : a.size_exponent;
    Vec3<Real> sum = k_none;
    for (uint32_t i = 0; i < geometry.count; ++i) {
      const Vec3<Unit> arm = (by_b ? geometry.point[i].arm_b : geometry.point[i].arm_a) * k_share[geometry.count - 1];
      sum += {real_from_unit(arm.x, exponent), real_from_unit(arm.y, exponent), real_from_unit(arm.z, exponent)};
    }
    return moved((by_b ? pose_b : pose_a).position, sum);
  }
  static Vec3<Real> offset_of(const BodyPose& a, const BodyPose& b) { return real_difference(b.position, a.position); }

  void go_on(ImpactPair& pair) {
    const Fraction time = pair.time;
    const bool undecided = pair.next == k_next_undecided;
    if (pair.next == k_next_look) {
      test(pair.key, time, k_zero, &pair);
      test_all_changed(time);
      return;
    }
    const uint32_t slots[2] = {pair_low(pair.key), pair_high(pair.key)};
    pair.next = k_next_none;
    pair.last = time;
    report.undecided += undecided ? 1 : 0;
    for (const uint32_t slot : slots) {
      if (!dynamic(slot)) continue;
      move_to(slot, time);
      report.clamped += hold_turn(bodies.traits[slot], settings.tick_time, bodies.sweeps[slot]);
    }
    const BodyPose pose_a = pose_at(body(slots[0]), time), pose_b = pose_at(body(slots[1]), time);
    first_approach = k_zero;
    resolve(pair, undecided, pose_a, pose_b);
    if (first_approach > k_zero) pass_on(pair, time);
    if (pair.impacts == 0) pair.impacts = 1;
    for (const uint32_t slot : slots) {
      if (!dynamic(slot)) continue;
      BodySweep& sweep = bodies.sweeps[slot];
      if (++sweep.impacts >= k_impacts_max) stop(slot, time);
      if ((sweep.marks & k_mark_changed) == 0) change(slot);
    }
    test_all_changed(time);
  }
};

}  // namespace

ImpactReport advance_to_impacts(const StepSettings& settings, const AssetTable& assets, const FeatureTable& features,
                                const ImpactPairs& pairs, const ImpactBodies& bodies, Span<ImpactPair> met,
                                Span<ImpactHit> hits, ImpactProbe* probe) {
  Stage stage = {settings,
                 assets,
                 features,
                 pairs,
                 bodies,
                 met,
                 hits,
                 probe,
                 divide(Scaled(1.0), scaled_from(settings.tick_time)),
                 probe == nullptr || probe->filters};
  stage.find_first();
  stage.test_all_changed(Fraction(0.0));
  while (ImpactPair* pair = stage.next()) stage.go_on(*pair);
  stage.carry_to_end();
  return stage.report;
}

const ContinuousCode k_continuous_code = {advance_to_impacts};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
