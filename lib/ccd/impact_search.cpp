#include "base/binary_search.h"
#include "base/heap.h"
#include "broad_phase/pair_filter.h"
#include "ccd/impact_stage.h"
#include "math/root.h"
#include "motion/predict.h"
#include "shape/bounds.h"
#include "solver/contact_rows.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A pair that was found touching is tested again after 2^k_test_power of a tick. This time doubles at each test of the
/// pair, up to half a tick. A pair has at most k_tests_max such tests in a tick.
constexpr int k_test_power = -10;
constexpr uint32_t k_tests_max = 16;

/// The contacts of the pair `key` that stand at the start of the list `from`.
Span<const ContactWork> pair_contacts(Span<const ContactWork> from, uint64_t key) {
  uint32_t count = 0;
  while (count < from.count && key_of(from[count].state) == key) ++count;
  return from.first(count);
}

/// The part of a sorted list that starts at the contacts of a pair.
Span<const ContactWork> contacts_from(Span<const ContactWork> contacts, uint64_t key) {
  const uint32_t at = partition_point(contacts.count, [&](uint32_t i) { return key_of(contacts[i].state) < key; });
  return {contacts.data + at, contacts.count - at};
}

/// The contacts of a pair in a sorted list.
Span<const ContactWork> find_contacts(Span<const ContactWork> contacts, uint64_t key) {
  return pair_contacts(contacts_from(contacts, key), key);
}

bool jointed(const ImpactStage& stage, uint32_t slot) { return stage.sweep_of(slot).marks >= k_mark_jointed; }
bool is_ball(const ImpactStage& stage, uint32_t slot) {
  return shape_of(stage.bodies.properties[slot]) == ShapeType::sphere;
}

bool is_curved(const ImpactStage& stage, uint32_t slot) {
  return round_radius(stage.bodies.properties[slot]) > Unit(0.0);
}

/// False for pairs that are disabled by filters or joints, and for pairs within one island of joints. Also false for a
/// jointed body and a half-space. Only contacts keep a jointed body out of a half-space, because an impact would stop
/// that body alone and tear it from its joints.
bool may_collide(const ImpactStage& stage, uint32_t a, uint32_t b) {
  if (!PairFilter{stage.bodies.properties, stage.bodies.filter_rules, stage.known.disabled_pairs}.allows(a, b))
    return false;
  if (!jointed(stage, a) && !jointed(stage, b)) return true;
  if (is_half_space(stage.bodies.properties[a]) || is_half_space(stage.bodies.properties[b])) return false;
  return stage.sweep_of(a).marks / k_mark_jointed != stage.sweep_of(b).marks / k_mark_jointed;
}

/// Adds all bodies whose bounds overlap those of `slot` to the candidates.
__attribute__((noinline)) void find_near(ImpactStage& stage, uint32_t slot) {
  const Bounds& box = stage.bounds_of(slot);
  const auto add = [&](uint32_t other) { stage.candidates().set(other); };
  stage.bodies.resting.for_each_near(box, add);
#if DETENT_TASKS
  if (stage.warp == nullptr) stage.moving.prepare(stage.bodies.active, stage.bodies.bounds, stage.spare);
  if (stage.moving.is_made()) {
    stage.moving.tree(stage.bodies.bounds).for_each_near(box, add);
    if (stage.warp != nullptr) stage.changeable().for_each(add);
    return;
  }
#endif
  stage.bodies.active.for_each([&](uint32_t other) {
    if (overlap(box, stage.bounds_of(other))) add(other);
  });
}

/// Whether the bounds of two bodies overlap and may_collide() is true.
bool are_near(const ImpactStage& stage, uint32_t slot, uint32_t other) {
  return overlap(stage.bounds_of(slot), stage.bounds_of(other)) && may_collide(stage, slot, other);
}

/// Visits all other bodies for which are_near() is true, in the order of their slots.
template <class Visit>
void for_each_near(ImpactStage& stage, uint32_t slot, const Visit& visit) {
  find_near(stage, slot);
  stage.candidates().for_each([&](uint32_t other) {
    stage.candidates().clear(other);
    // An earlier visit may have stopped either body.
    if (other != slot && are_near(stage, slot, other)) visit(other);
  });
}

ImpactPair* find_impact(const ImpactStage& stage, uint64_t key) {
  ImpactPair* found = nullptr;
  const uint32_t low = pair_low(key);
  stage.for_each_impact(stage.dynamic(low) ? low : pair_high(key), [&](ImpactPair& pair) {
    if (pair.key == key) found = &pair;
  });
  return found;
}

/// A lower bound, m, of the distance that a pair without contact had at the start of the tick. The contact points of a
/// pair in `known.pairs` were searched up to its speculative distance. The bounds of any other pair were disjoint, and
/// bounds include the contact margin. If pairs or contacts were dropped, nothing is known, and the result is 0. The
/// result is also 0 if neither body has k_mark_moved without k_mark_near: each of the two was at rest, or may be near a
/// body with which it has no contact.
Real distance_without_contact(const ImpactStage& stage, uint64_t key) {
  const uint32_t low = pair_low(key), high = pair_high(key);
  const BodySweep &a = stage.sweep_of(low), &b = stage.sweep_of(high);
  const auto is_known = [](const BodySweep& sweep) {
    return (sweep.marks & (k_mark_moved | k_mark_near)) == k_mark_moved;
  };
  if (!stage.known.complete || (!is_known(a) && !is_known(b))) return k_zero;
  const bool searched = has_pair(stage.known.pairs, key);
  return speculative_distance(stage.settings, stage.extent_of(key), searched ? a.speed + b.speed : k_zero, false);
}

Real free_shrink_depth(const ImpactStage& stage, uint64_t key, Span<const ContactWork> contacts, Real& clearance) {
  if (contacts.count == 0) {
    clearance = distance_without_contact(stage, key);
    return k_zero;
  }
  const Real extent = stage.extent_of(key);
  Real least = contacts[0].separation[0];
  bool rebounds = false;
  for (const ContactWork& contact : contacts) {
    for (uint32_t i = 0; i < contact.state.point_count; ++i) least = min(least, contact.separation[i]);
    rebounds = rebounds || is_positive(contact.restitution);
  }
  if (is_left_to_impact(contacts[0])) {
    clearance = k_zero;
    return k_zero;
  }
  // A round body may be nearer than the separations of its contacts say. They include the distance that the bodies gain
  // in the tick because the normal rotates while they slide past each other.
  const bool round = is_curved(stage, pair_low(key)) || is_curved(stage, pair_high(key));
  if (least > scale_by_power(extent, -10)) {
    clearance = round ? k_zero : scale_by_power(least, -1);
    // If the solver has made a ball bounce, the ball touches at the end of the tick. The query would report an impact
    // within its tolerance, so the test starts one shrink depth deeper. Other shapes may collide at another point
    // first, so their test starts at the surfaces.
    const bool bounces = is_ball(stage, pair_low(key)) || is_ball(stage, pair_high(key));
    return bounces && rebounds && stage.is_pushed(key) ? next_shrink_depth(extent, k_zero) : k_zero;
  }
  const Real shrink_depth = contact_shrink_depth(extent, -least);
  // Adds the shrink depth of only one body, although both are shrunk, because the contact points need not show the
  // whole depth of the overlap.
  clearance = (round ? min(least, k_zero) : least) + shrink_depth;
  return shrink_depth;
}

/// Returns the first shrink depth, m, of a pair with these `contacts`, which may be empty. `clearance` becomes a lower
/// bound, m, of the distance of the cores at that depth. For a jointed body the depth is at least 3/8 of the extent:
/// only those collisions count in which the body would otherwise pass through.
Real first_shrink_depth(const ImpactStage& stage, uint64_t key, Span<const ContactWork> contacts, Real& clearance) {
  const Real shrink_depth = free_shrink_depth(stage, key, contacts, clearance);
  if (!jointed(stage, pair_low(key)) && !jointed(stage, pair_high(key))) return shrink_depth;
  const Real extent = stage.extent_of(key);
  const Real held = max(shrink_depth, scale_by_power(extent, -2) + scale_by_power(extent, -3));
  clearance += held - shrink_depth;
  return held;
}

/// The time of the next test of a pair that is found touching at `time`, after `tests` such tests in the tick. Returns
/// 1 if the pair is not tested again.
Fraction next_test_after(Fraction time, uint32_t tests) {
  if (tests >= k_tests_max) return k_whole_step;
  const uint32_t power = tests < 9 ? tests : 9;
  const int64_t after = (int64_t{1} << (Fraction::k_frac + k_test_power)) << power;
  return after < k_whole_step.raw - time.raw ? Fraction::from_raw(time.raw + after) : k_whole_step;
}

/// Whether a pair that was found touching is tested again later in the tick. It is if its cores were separate only at a
/// shrink depth of more than 1/32 of the extent, or if rotation may bring the bodies together again. A pair that is not
/// tested again can overlap by at most 1/16 of the extent at the end of the tick, mostly far less. `depth`:
/// Meeting::depth.
bool must_be_tested_again(const ImpactStage& stage, uint64_t key, Real depth) {
  if (depth == k_zero) return false;
  return max(scale_by_power(depth, -2), stage.bend_of(key)) > scale_by_power(stage.extent_of(key), -7);
}

/// A direction that may separate a pair: the normal of its first contact. Returns zero if the pair has no contact, or
/// if it has an entry in `impacts`, because a pair with an entry mostly touches.
Vec3<Unit> known_axis(const ImpactStage& stage, uint64_t key, const ImpactPair* entry) {
  if (entry != nullptr) return {};
  const Span<const ContactWork> contacts = find_contacts(stage.known.contacts, key);
  return contacts.count != 0 ? contacts[0].normal : Vec3<Unit>{};
}

/// The motion of a body from the start of the tick to its end: the motion so far, and the rest of its sweep.
struct TickMotion {
  Vec3<Real> until;            ///< displacement from the start of the tick to the present time, m
  Vec3<Real> displacement;     ///< displacement from the start of the tick to its end, m
  Vec3<Real> rotation_vector;  ///< rotation from the start of the tick to its end, times 2^size_exponent, m
  Real swing;                  ///< upper bound of the motion of surface points by rotation, m
};

DETENT_SHARED TickMotion motion_in_tick(const ImpactStage& stage, uint32_t slot, Fraction time) {
  const BodyProperties& properties = stage.bodies.properties[slot];
  const BodySweep& sweep = stage.sweep_of(slot);
  const Sweep rest = rest_of(sweep, sweep.from);
  TickMotion motion;
  motion.displacement = rest.displacement;
  motion.rotation_vector = rest.rotation_vector;
  motion.swing = swing_bound(properties, rest.rotation_vector);
  if ((sweep.marks & k_mark_hit) != 0) {
    const ImpactPath& path = stage.path_of(slot);
    motion.displacement += path.displacement;
    motion.rotation_vector += path.rotation_vector;
    motion.swing += path.bound;
  }
  motion.rotation_vector = scale_by_power(motion.rotation_vector, properties.size_exponent);
  motion.until = time.raw == 0 ? k_zero_vector : motion.displacement - rest_of(sweep, time).displacement;
  return motion;
}

/// Returns true if the solver's motion does not let the bodies of a pair in contact pass into each other in this tick;
/// such a pair need not be tested. Each contact point must meet a condition: if it is open at the start of the tick, it
/// becomes at most 1/1024 of the extent deep; if it overlaps at the start, it becomes at most that much deeper.
/// `closing`: upper bound of the relative motion in the tick, m. False if `closing` is large, because parts of the
/// shapes that are not in contact may then collide.
bool are_kept_apart(const ImpactStage& stage, uint64_t key, Span<const ContactWork> contacts, const TickMotion& a,
                    const TickMotion& b, Real closing) {
  if (contacts.count == 0 || is_left_to_impact(contacts[0])) return false;
  const Real extent = stage.extent_of(key);
  uint32_t least_points = k_manifold_points_max;
  for (const ContactWork& contact : contacts)
    least_points = contact.state.point_count < least_points ? contact.state.point_count : least_points;
  if (closing > scale_by_power(extent, least_points < 3 ? -3 : -2)) return false;
  // Parts without contact can collide only if the pair closes by the distance that they had at the start of the tick.
  if (has_parts(stage.bodies.properties[pair_low(key)], stage.bodies.properties[pair_high(key)]) &&
      !(closing < distance_without_contact(stage, key)))
    return false;
  for (const ContactWork& contact : contacts) {
    if (!keeps_apart(contact, a.displacement, a.rotation_vector, b.displacement, b.rotation_vector,
                     scale_by_power(extent, -10)))
      return false;
  }
  return true;
}

/// Whether a pair with these contacts need not be tested for the rest of the tick: it is too slow to collide, or its
/// contacts keep it apart. `clearance`: lower bound of the distance of the shapes, or of their shrunken cores, at the
/// start of the tick, m. `entry`: the pair's entry in `impacts`, or null.
bool is_safe(ImpactStage& stage, uint64_t key, Span<const ContactWork> contacts, Fraction time, Real clearance,
             const ImpactPair* entry) {
  const TickMotion a = motion_in_tick(stage, pair_low(key), time), b = motion_in_tick(stage, pair_high(key), time);
  // The relative displacement changes linearly from now to the end of the tick, so its length is greatest at one of
  // these two times.
  const Real closing = max(length(b.until - a.until), length(b.displacement - a.displacement)) + a.swing + b.swing;
  if (stage.filters() && closing < clearance) {
    ++stage.report.skipped;
    return true;
  }
  // A pair that has collided in this tick is tested although its contacts keep it apart, because the impulses of other
  // impacts are propagated only to pairs that are tested and collide.
  const bool has_collided = entry != nullptr && entry->impacts != 0;
  if (has_collided || !are_kept_apart(stage, key, contacts, a, b, closing)) return false;
  ++stage.report.kept_apart;
  return true;
}

/// Tests a pair from the start of the tick, unless it is safe.
void test_at_start(ImpactStage& stage, uint64_t key, Span<const ContactWork> contacts) {
  const uint32_t low = pair_low(key), high = pair_high(key);
  if (!stage.dynamic(low) && !stage.dynamic(high)) return;
  if (is_at_rest(stage.sweep_of(low)) && is_at_rest(stage.sweep_of(high))) return;
  if (!overlap(stage.bounds_of(low), stage.bounds_of(high)) || !may_collide(stage, low, high)) return;
  Real clearance = k_zero;
  const Real shrink_depth = first_shrink_depth(stage, key, contacts, clearance);
  const Fraction start = 0.0;
  // The sum of both bodies' motion bounds is cheap to compute, and mostly small enough to show that the pair cannot
  // collide. The bounds are valid because no body has been hit yet.
  const auto bound = [&](uint32_t slot) {
    return is_at_rest(stage.sweep_of(slot)) ? k_zero : stage.path_of(slot).bound;
  };
  if (stage.filters() && bound(low) + bound(high) < clearance) {
    ++stage.report.skipped;
    return;
  }
  if (!is_safe(stage, key, contacts, start, clearance, nullptr)) stage.test(key, start, shrink_depth, nullptr);
}

/// Tests pairs of a sorted list from the start of the tick.
void test_all_at_start(ImpactStage& stage, Span<const uint64_t> pairs) {
  Span<const ContactWork> rest = stage.known.contacts;
  if (stage.found != nullptr) rest = contacts_from(rest, pairs[0]);
  const auto go_on = [&rest](uint32_t count) { rest = {rest.data + count, rest.count - count}; };
  for (const uint64_t key : pairs) {
    while (rest.count != 0 && key_of(rest[0].state) < key) go_on(1);
    test_at_start(stage, key, pair_contacts(rest, key));
  }
}

/// Whether the bodies of a pair in contact approach so fast that they rebound. Returns false if the bodies overlap by
/// more than 1/1024 of the extent, if the solver has applied an impulse between them, or if one of them is jointed.
bool is_new_impact(const ImpactStage& stage, uint64_t key, Span<const ContactWork> contacts) {
  const uint32_t low = pair_low(key), high = pair_high(key);
  if (contacts.count == 0 || jointed(stage, low) || jointed(stage, high)) return false;
  const Vec3<Real> relative = stage.sweep_of(high).displacement - stage.sweep_of(low).displacement;
  const Real touching = -scale_by_power(stage.extent_of(key), -10);
  bool rebounds = false;
  for (const ContactWork& contact : contacts) {
    for (uint32_t i = 0; i < contact.state.point_count; ++i) {
      if (contact.separation[i] < touching || contact.impulse_max[i] > k_zero) return false;
    }
    rebounds = rebounds || (is_positive(contact.restitution) &&
                            dot(relative, contact.normal) <= -contact.rebound_min * stage.settings.tick_time);
  }
  return rebounds;
}

/// Tests the new sweep of a body against another body whose bounds overlap its bounds.
void test_near(ImpactStage& stage, uint32_t slot, uint32_t other, Fraction time) {
  if (is_at_rest(stage.sweep_of(slot)) && is_at_rest(stage.sweep_of(other))) return;
  const uint64_t key = key_of_pair(slot, other);
  const Span<const ContactWork> contacts = find_contacts(stage.known.contacts, key);
  ImpactPair* const entry = find_impact(stage, key);
  Real clearance = k_zero, shrink_depth = k_zero;
  if (!is_new_impact(stage, key, contacts)) {
    shrink_depth = first_shrink_depth(stage, key, contacts, clearance);
    if (is_safe(stage, key, contacts, time, clearance, entry)) return;
  }
  stage.test(key, time, shrink_depth, entry);
}

/// Tests the new sweep of a body against all other bodies.
void test_changed(ImpactStage& stage, uint32_t slot, Fraction time) {
  stage.sweep_of(slot).marks &= ~k_mark_changed;
  --stage.changed_count;
#if DETENT_TASKS
  if (stage.warp != nullptr) stage.warp->add_test(slot);
#endif
  for_each_near(stage, slot, [&](uint32_t other) { test_near(stage, slot, other, time); });
}

}  // namespace

#if DETENT_TASKS
void ImpactStage::test_if_near(uint32_t slot, uint32_t other, Fraction time) {
  if (are_near(*this, slot, other)) test_near(*this, slot, other, time);
}
#endif

void ImpactStage::link(ImpactPair& entry, uint32_t place) const {
  const uint32_t slots[2] = {pair_low(entry.key), pair_high(entry.key)};
  for (int i = 0; i < 2; ++i) {
    if (!dynamic(slots[i])) continue;
    entry.more[i] = first_impact_of(slots[i]);
    first_impact_of(slots[i]) = place;
  }
}

ImpactPair* ImpactStage::add_entry(uint64_t key) {
#if DETENT_TASKS
  if (found != nullptr) {
    ImpactPair* const entry = found->take();
    if (entry != nullptr) *entry = {};
    if (entry != nullptr) entry->key = key;
    return entry;
  }
  if (warp != nullptr) {
    if (!make_room_for(key)) return nullptr;
  } else
#endif
      if (impact_count == 0) {
    for (uint32_t& first : bodies.first_impact) first = 0;
  }
  if (impact_count == impacts.count) return nullptr;
  ImpactPair& entry = impacts[impact_count++];
  entry = {};
  entry.key = key;
  touch(entry);
  link(entry, impact_count);
  return &entry;
}

Real ImpactStage::bend_of(uint64_t key) const {
  const uint32_t slots[2] = {pair_low(key), pair_high(key)};
  Real bend = k_zero, angles = k_zero;
  for (const uint32_t slot : slots) {
    constexpr Real k_angle_max = 2.0;  // a larger rotation moves the points apart again
    const BodyProperties& properties = bodies.properties[slot];
    const Real angle = min(length(sweep_of(slot).rotation_vector), k_angle_max);
    bend += angle * angle * real_from_unit(properties.bounding_radius, properties.size_exponent);
    angles += angle;
  }
  return bend + angles * length(sweep_of(slots[1]).displacement - sweep_of(slots[0]).displacement);
}

bool ImpactStage::is_pushed(uint64_t key) const {
  bool pushed = false;
  for (const ContactWork& contact : find_contacts(known.contacts, key)) {
    for (uint32_t i = 0; i < contact.state.point_count; ++i) pushed = pushed || contact.impulse_max[i] > k_zero;
  }
  return pushed;
}

void ImpactStage::test(uint64_t key, Fraction time, Real shrink_depth, ImpactPair* entry) {
  const SweptBody a = body(pair_low(key)), b = body(pair_high(key));
  const bool resolved = entry != nullptr && entry->impacts != 0 && entry->last == time;
  if (is_spent()) shrink_depth = max(shrink_depth, contact_shrink_depth(extent_of(key), k_zero));
  PairSearch search(assets, features, a, b, time);
  Meeting meeting;
  const TimeOfImpact& impact = meeting.impact;
  const Vec3<Unit> axis = known_axis(*this, key, entry);
  if (entry != nullptr) {
    entry->next = k_next_none;
    touch(*entry);
  }
  const bool asked = search.find({shrink_depth, extent_of(key), true, resolved}, axis, meeting);
  report.tests += meeting.tests;
  take_work(meeting.tests);
  if (!asked) {
    ++report.undecided;
    return;
  }
  if (meeting.left) {
    ++report.overlaps_left;
    // The bodies have got this deep after an impact in this tick, and do not separate: they would pass through each
    // other.
    if (meeting.stuck) {
      stop(pair_low(key), time);
      stop(pair_high(key), time);
      return;
    }
    if (impact.outcome == ToiOutcome::clear) return;
  }
  const Fraction next_test = must_be_tested_again(*this, key, meeting.depth)
                                 ? next_test_after(time, entry == nullptr ? 0 : entry->tests)
                                 : k_whole_step;
  const bool meets = impact.outcome != ToiOutcome::clear,
             tests = next_test < k_whole_step && shrink_depth == k_zero && !is_spent();
  if (!meets && !tests) return;
  if (entry == nullptr) entry = add_entry(key);
  if (entry == nullptr) {
    if (!meets || found != nullptr || gives_up()) return;
    ++report.pairs_dropped;
    stop(pair_low(key), time);
    stop(pair_high(key), time);
    return;
  }
  if (tests && (!meets || next_test < impact.time)) {
    ++entry->tests;
    entry->next = k_next_test;
    entry->time = next_test;
    return;
  }
  entry->next = impact.outcome == ToiOutcome::undecided ? k_next_undecided : k_next_impact;
  entry->time = impact.time;
  entry->normal = impact.normal;
  entry->point = impact.point;
}

#if DETENT_TASKS
bool ImpactStage::find_first_shared() {
  FoundPairs all = {impacts};
  ImpactReport sum = {};
  share(settings.team, known.pairs, k_pairs_shared, [&](Span<const uint64_t> part) {
    ImpactStage stage = *this;
    stage.found = &all;
    test_all_at_start(stage, part);
    for (const auto number : k_impact_numbers) Team::add(sum.*number, stage.report.*number);
  });
  if (all.count > impacts.count) return false;
  report = sum;
  impact_count = all.count;
  if (impact_count == 0) return true;
  for (uint32_t& first : bodies.first_impact) first = 0;
  for (uint32_t i = 0; i < impact_count; ++i) link(impacts[i], i + 1);
  return true;
}
#else
bool ImpactStage::find_first_shared() { return false; }
#endif

void ImpactStage::find_first() {
  if (settings.team == nullptr || !find_first_shared()) test_all_at_start(*this, known.pairs);
  uint32_t moving_count = 0;
  bodies.active.for_each([&](uint32_t a) {
    ++moving_count;
    if ((sweep_of(a).marks & k_mark_left_bounds) == 0) return;
    for_each_near(*this, a, [&](uint32_t b) {
      if (b < a && (sweep_of(b).marks & k_mark_left_bounds) != 0) return;
      const uint64_t key = key_of_pair(a, b);
      if (!has_pair(known.pairs, key)) test_at_start(*this, key, find_contacts(known.contacts, key));
    });
  });
  work_left =
      k_impact_work_min + k_impact_work_times * (moving_count + report.tests + report.skipped + report.kept_apart);
#if DETENT_SPARSE
  if (probe != nullptr) probe->use.budget = work_left - k_impact_work_min;
#endif
}

void ImpactStage::test_all_changed(Fraction time) {
  while (changed_count != 0) {
    const uint32_t first = changed_first;
    changed_first = UINT32_MAX;
    changeable().while_each(first, [&](uint32_t slot) {
      if ((sweep_of(slot).marks & k_mark_changed) != 0) test_changed(*this, slot, time);
      return changed_count != 0;
    });
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
