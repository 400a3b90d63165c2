#include <string.h>

#include "base/bytes.h"
#include "broad_phase/pair_key.h"
#include "motion/predict.h"
#include "replay/sparse_rollback.h"
#include "shape/shape_properties.h"

#if DETENT_SPARSE

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Whether two worlds have the same settings and tick: compares all of WorldState except the counts, `free_word` and
/// `idle`.
bool has_same_settings(const WorldState& a, const WorldState& b) {
  WorldState other = b;
  other.body_count = a.body_count;
  other.slots_used = a.slots_used;
  other.free_word = a.free_word;
  other.slots_retired = a.slots_retired;
  other.contact_count = a.contact_count;
  other.joint_count = a.joint_count;
  other.joints_used = a.joints_used;
  other.sensor_count = a.sensor_count;
  other.sensed_count = a.sensed_count;
  other.idle = a.idle;
  return have_same_bytes(a, other);
}

/// Visits the elements of two sorted lists, in the order of their keys. For each key, calls visit(i, k) with the index
/// of its element in each list; if a list has no element with this key, its index is its count. `compare(i, k)`: the
/// order of two elements, as a negative number, 0 or a positive number.
template <class Before, class Visit>
void walk_both(uint32_t count_a, uint32_t count_b, const Before& compare, const Visit& visit) {
  for (uint32_t i = 0, k = 0; i < count_a || k < count_b;) {
    const int order = i == count_a ? 1 : k == count_b ? -1 : compare(i, k);
    visit(order <= 0 ? i : count_a, order >= 0 ? k : count_b);
    i += order <= 0 ? 1 : 0;
    k += order >= 0 ? 1 : 0;
  }
}

template <class T>
int order_of(T a, T b) {
  return a < b ? -1 : b < a ? 1 : 0;
}

}  // namespace

bool SparseTick::find_differing() {
  if (!has_same_settings(before.world, now.world)) return false;
  if (before.assets.count != 0 &&
      !have_same_bytes(before.assets.data, now.assets.data, before.assets.count * sizeof(AssetState)))
    return false;
  for (uint32_t slot = 0; slot < used; ++slot) {
    if (!have_same_bytes(before.poses[slot], now.poses[slot]) ||
        !have_same_bytes(before.motions[slot], now.motions[slot]) ||
        !have_same_bytes(before.properties[slot], now.properties[slot]) ||
        !have_same_bytes(before.activities[slot], now.activities[slot]))
      differs.set(slot);
  }
  const auto differ = [&](uint32_t slot) {
    if (is_dynamic(slot)) differs.set(slot);
  };
  const auto &old_contacts = before.contacts, &new_contacts = now.contacts;
  const uint32_t old_count = before.world.contact_count, new_count = now.world.contact_count;
  walk_both(
      old_count, new_count,
      [&](uint32_t i, uint32_t k) {
        const ContactState &a = old_contacts[i], &b = new_contacts[k];
        const int bodies = order_of(key_of(a), key_of(b));
        return bodies != 0 ? bodies : order_of(a.part, b.part);
      },
      [&](uint32_t i, uint32_t k) {
        const bool both = i < old_count && k < new_count;
        if (both && have_same_bytes(old_contacts[i], new_contacts[k]) &&
            (now.manifolds.count == 0 || have_same_bytes(before.manifolds[i], now.manifolds[k])))
          return;
        const ContactState& contact = i < old_count ? old_contacts[i] : new_contacts[k];
        differ(contact.body_a);
        differ(contact.body_b);
      });
  for (uint32_t slot = 0; slot < before.world.joints_used || slot < now.world.joints_used; ++slot) {
    if (have_same_bytes(before.joints[slot], now.joints[slot])) continue;
    joints.set(slot);
    const auto differ_ends = [&](const JointState& joint) {
      if (joint.type == 0) return;
      differ(joint.body_a);
      differ(joint.body_b);
    };
    differ_ends(before.joints[slot]);
    differ_ends(now.joints[slot]);
  }
  const uint32_t old_sensed = before.world.sensed_count, new_sensed = now.world.sensed_count;
  walk_both(
      old_sensed, new_sensed,
      [&](uint32_t i, uint32_t k) {
        const SensedState &a = before.sensed[i], &b = now.sensed[k];
        return a.sensor != b.sensor ? order_of(a.sensor, b.sensor) : order_of(a.body, b.body);
      },
      [&](uint32_t i, uint32_t k) {
        if (i < old_sensed && k < new_sensed) return;
        differs.set(i < old_sensed ? before.sensed[i].body : now.sensed[k].body);
      });
  return true;
}

void SparseTick::begin(const StepSettings& settings, Span<BodyWork> work) {
  differs.for_each([&](uint32_t slot) {
    boxes[slot] = record.reach[slot];
    if (now.properties[slot].type == 0) return;
    bound(settings, now.poses, now.properties, now.motions, {&slot, 1}, work, reach);
    include(reach[slot], boxes[slot]);
  });
  differs.for_each([&](uint32_t slot) { add(slot); });
}

void SparseTick::add(uint32_t slot) {
  if (inside.has(slot)) return;
  inside.set(slot);
  visible.set(slot);
  grew = true;
  const auto mark = [&](uint32_t group) {
    if (group == 0) return;
    groups.set(group - 1);
    has_groups = true;
  };
  mark(before.activities[slot].asleep);
  mark(now.activities[slot].asleep);
  const bool is_different = differs.has(slot);
  if (!is_different) boxes[slot] = record.reach[slot];
  if (is_different || record.movers.has(slot)) list[count++] = slot;
}

/// Whether one of the simulated bodies list[from], ..., list[end - 1] reaches the body `slot`.
bool SparseTick::meets(uint32_t slot, uint32_t from, uint32_t end) const {
  const bool acts = can_act(slot);
  for (uint32_t i = from; i < end; ++i) {
    if (overlap(record.reach[slot], boxes[list[i]]) && (acts || can_act(list[i]))) return true;
  }
  return false;
}

void SparseTick::add_jointed(Span<const JointState> all) {
  const auto take_jointed = [&](uint32_t slot) {
    if (is_dynamic(slot)) {
      add(slot);
    } else if (!visible.has(slot)) {
      visible.set(slot);
      grew = true;
    }
  };
  for (const JointState& joint : all) {
    if (joint.type == 0) continue;
    if (inside.has(joint.body_a)) take_jointed(joint.body_b);
    if (inside.has(joint.body_b)) take_jointed(joint.body_a);
  }
}

void SparseTick::add_sleeping() {
  const auto is_marked = [&](uint32_t group) { return group != 0 && groups.has(group - 1); };
  for (uint32_t slot = 0; has_groups && slot < used; ++slot) {
    if (is_marked(before.activities[slot].asleep) || is_marked(now.activities[slot].asleep)) add(slot);
  }
}

bool SparseTick::expand() {
  grew = false;
  for (uint32_t from = 0;;) {
    const uint32_t end = count;
    Bounds all = k_nowhere;
    for (uint32_t i = from; i < end; ++i) include(boxes[list[i]], all);
    for (uint32_t slot = 0; from < end && slot < used; ++slot) {
      if (inside.has(slot) || !overlap(record.reach[slot], all) || now.properties[slot].type == 0) continue;
      if (is_dynamic(slot)) {
        if (meets(slot, from, end)) add(slot);
      } else if (!visible.has(slot) && meets(slot, from, end)) {
        visible.set(slot);
        grew = true;
      }
    }
    from = end;
    for (bool grew_before = grew;; grew_before = true) {
      grew = false;
      if (now.world.joint_count != 0) add_jointed(now.joints.first(now.world.joints_used));
      if (before.world.joint_count != 0) add_jointed(before.joints.first(before.world.joints_used));
      add_sleeping();
      const bool grows = grew;
      grew = grew || grew_before;
      if (!grows) break;
    }
    if (count > most) return false;
    if (from == count) return true;
  }
}

void SparseTick::note_reach(BitSet active) {
  const uint32_t listed = count;
  for (uint32_t i = 0; i < listed; ++i) include(reach[list[i]], boxes[list[i]]);
  // Adds the bodies to `list` that rested in the recorded step but are active in this run.
  inside.for_each([&](uint32_t slot) {
    if (!active.has(slot) || differs.has(slot) || record.movers.has(slot)) return;
    for (uint32_t i = listed; i-- > 0;) {
      if (list[i] == slot) return;
    }
    include(reach[slot], boxes[slot]);
    list[count++] = slot;
  });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#endif
