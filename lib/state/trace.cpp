#include "state/trace.h"

#include <string.h>

#include "base/digest.h"
#include "broad_phase/pair_filter.h"
#include "state/step_cache.h"
#include "state/step_scratch.h"
#include "state/used.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Field k_contact_work_fields[] = {
    DETENT_FIELD(TraceContact, state.body_a),
    DETENT_FIELD(TraceContact, state.body_b),
    DETENT_FIELD(TraceContact, state.part),
    DETENT_FIELD(TraceContact, state.age),
    DETENT_FIELD(TraceContact, state.touching),
    DETENT_FIELD(TraceContact, state.point_count),
    DETENT_FIELD(TraceContact, state.feature),
    DETENT_FIELD_IN(TraceContact, state.normal_impulse, "m/s"),
    DETENT_FIELD_IN(TraceContact, state.friction_impulse, "m/s"),
    DETENT_FIELD_IN(TraceContact, state.angular_impulse, "m/s"),
    DETENT_FIELD_IN(TraceContact, state.load, "m/s^2"),
    DETENT_FIELD_IN(TraceContact, separation, "m"),
    DETENT_FIELD_IN(TraceContact, approach, "m/s"),
    DETENT_FIELD(TraceContact, normal),
    DETENT_FIELD(TraceContact, middle_a),
    DETENT_FIELD(TraceContact, middle_b),
    DETENT_FIELD(TraceContact, normal_mass),
    DETENT_FIELD(TraceContact, response),
};
constexpr Field k_body_work_fields[] = {
    DETENT_FIELD_IN(TraceBody, displacement, "m"),
    DETENT_FIELD_IN(TraceBody, rotation_vector, "m"),
    DETENT_FIELD_IN(TraceBody, angular_velocity, "m/s"),
    DETENT_FIELD_IN(TraceBody, extent, "m"),
    DETENT_FIELD_IN(TraceBody, fall, "m/s"),
    DETENT_FIELD_IN(TraceBody, speed, "m/s"),
    DETENT_FIELD(TraceBody, rotation),
    make_field<Vec3<Unit>[3]>("axes", static_cast<uint32_t>(__builtin_offsetof(TraceBody, axes)), ""),
    DETENT_FIELD(TraceBody, inverse_inertia),
    DETENT_FIELD(TraceBody, inverse_inertia_exponent),
};
constexpr Field k_sweep_fields[] = {
    DETENT_FIELD(TraceSweep, from),
    DETENT_FIELD_IN(TraceSweep, displacement, "m"),
    DETENT_FIELD_IN(TraceSweep, rotation_vector, "rad"),
};
constexpr Field k_bounds_fields[] = {
    DETENT_FIELD_IN(Bounds, lower, "m"),
    DETENT_FIELD_IN(Bounds, upper, "m"),
};
static_assert(tiles(k_contact_work_fields, sizeof(TraceContact)) && tiles(k_body_work_fields, sizeof(TraceBody)));
static_assert(tiles(k_sweep_fields, sizeof(TraceSweep)) && tiles(k_bounds_fields, sizeof(Bounds)));

constexpr TracePart state_part(uint32_t section, TraceKind kind, uint32_t key_words, bool sorted) {
  const SectionFields& fields = k_section_fields[section];
  return {section, fields.name, fields.fields,           fields.field_count, k_sections[section].element_bytes,
          kind,    key_words,   sorted && key_words != 0};
}
template <uint32_t n>
constexpr TracePart work_part(uint32_t number, const char* name, const Field (&fields)[n], uint32_t bytes,
                              TraceKind kind, uint32_t key_words) {
  return {number, name, fields, n, bytes, kind, key_words, key_words != 0};
}

enum StatePlace : uint32_t { k_state_parts = 11, k_contact_work = k_state_parts, k_body_work, k_body_sweeps, k_bounds };
constexpr uint32_t k_first_work_number = 32;

/// Converts the copy of an element to canonical byte order and passes it to the visitor, unless it is zero.
void give(const TraceVisitor& visitor, const TracePart& part, uint32_t place, uint8_t* copy) {
  uint32_t any = 0;
  for (uint32_t i = 0; i < part.element_bytes; ++i) any |= copy[i];
  if (any == 0) return;
  if (k_big_endian) {
    for (uint32_t i = 0; i < part.field_count; ++i) {
      swap_words(copy + part.fields[i].offset, part.fields[i].width, part.fields[i].count);
    }
  }
  visitor.take(visitor.context, part, place, copy);
}
template <class T>
void give_value(const TraceVisitor& visitor, uint32_t index, uint32_t place, const T& value) {
  alignas(8) uint8_t copy[sizeof(T)];
  memcpy(copy, &value, sizeof value);
  give(visitor, k_trace_parts[index], place, copy);
}

void visit_state(const World& world, const StateView<const uint8_t>& state, const TraceVisitor& visitor) {
  const UsedCounts counts = used_counts(state);
  alignas(8) uint8_t copy[k_element_bytes_max];
  for (uint32_t i = 1; i < k_section_count; ++i) {
    const uint8_t* element = world.block + state.layout.*k_sections[i].offset;
    for (uint32_t place = 0; place < counts.of[i]; ++place, element += k_sections[i].element_bytes) {
      memcpy(copy, element, k_sections[i].element_bytes);
      give(visitor, k_trace_parts[i - 1], place, copy);
    }
  }
}

void visit_contact(const ContactWork& work, uint32_t place, const TraceVisitor& visitor) {
  TraceContact contact;
  memset(&contact, 0, sizeof contact);
  contact.state = work.state;
  for (uint32_t i = 0; i < work.state.point_count && i < k_manifold_points_max; ++i) {
    contact.separation[i] = work.separation[i];
    contact.approach[i] = work.approach[i];
  }
  contact.normal = work.normal;
  contact.middle_a = work.middle_a;
  contact.middle_b = work.middle_b;
  memcpy(contact.normal_mass, work.normal_mass, sizeof contact.normal_mass);
  memcpy(contact.response, work.response, sizeof contact.response);
  give_value(visitor, k_contact_work, place, contact);
}

void visit_body(const BodyWork& work, bool left_out, uint32_t slot, const TraceVisitor& visitor) {
  TraceBody body;
  memset(&body, 0, sizeof body);
  body.displacement = work.displacement;
  body.rotation_vector = work.rotation_vector;
  body.angular_velocity = work.angular_velocity;
  if (!left_out) {  // of a non-colliding body these members are not computed
    body.extent = work.extent;
    body.fall = work.fall;
    body.speed = work.speed;
  }
  body.rotation = work.rotation;
  body.axes = work.axes;
  for (int i = 0; i < 3; ++i) body.inverse_inertia[i] = work.inverse_inertia.row[i];
  body.inverse_inertia_exponent = work.inverse_inertia.exponent;
  give_value(visitor, k_body_work, slot, body);
}

}  // namespace

const TracePart k_trace_parts[k_trace_part_count] = {
    state_part(1, TraceKind::world, 0, false),
    state_part(2, TraceKind::body, 0, false),
    state_part(3, TraceKind::body, 0, false),
    state_part(4, TraceKind::body, 2, false),
    state_part(5, TraceKind::body, 0, false),
    state_part(6, TraceKind::slot_word, 0, false),
    state_part(7, TraceKind::contact, 3, true),
    state_part(8, TraceKind::asset, 0, false),
    state_part(9, TraceKind::contact, 0, false),
    state_part(10, TraceKind::joint, 4, false),
    state_part(11, TraceKind::sensed, 2, true),
    work_part(k_first_work_number, "contact work", k_contact_work_fields, sizeof(TraceContact), TraceKind::contact, 3),
    work_part(k_first_work_number + 1, "body work", k_body_work_fields, sizeof(TraceBody), TraceKind::body, 0),
    work_part(k_first_work_number + 2, "sweep", k_sweep_fields, sizeof(TraceSweep), TraceKind::body, 0),
    work_part(k_first_work_number + 3, "bounds", k_bounds_fields, sizeof(Bounds), TraceKind::body, 0),
};
static_assert(k_section_count == k_state_parts + 1 && k_bounds + 1 == k_trace_part_count);

const TracePart* find_trace_part(uint32_t number) {
  for (const TracePart& part : k_trace_parts) {
    if (part.number == number) return &part;
  }
  return nullptr;
}

uint64_t trace_digest(const TracePart& part, uint32_t place, const uint8_t* bytes) {
  return digest_finish(digest_bytes(bytes, part.element_bytes, digest_step(part.number, part.sorted ? 0 : place)));
}

/// Visits only the data that the work space holds at the end of the stage. step.cpp and layout.h determine which data
/// this is.
void visit_trace(const World& world, TraceStage stage, uint32_t contacts, const TraceVisitor& visitor) {
  const StateView<const uint8_t> state = view_of(world);
  visit_state(world, state, visitor);
  const uint32_t number = static_cast<uint32_t>(stage);
  const auto is = [number](StepStage step_stage) { return number == static_cast<uint32_t>(trace_stage(step_stage)); };
  const auto within = [number](StepStage first, StepStage last) {
    return number >= static_cast<uint32_t>(trace_stage(first)) && number <= static_cast<uint32_t>(trace_stage(last));
  };
  const Capacity capacity = capacity_of(state.header);
  const Scratch scratch = scratch_of(world.block, state.layout, capacity);
  if (within(StepStage::collide_pairs, StepStage::store)) {
    for (uint32_t i = 0; i < contacts; ++i) visit_contact(scratch.contacts[i], i, visitor);
  }
  const bool works = within(StepStage::find_pairs, StepStage::raise_events), sweeps = is(StepStage::advance);
  if (!works && !sweeps) return;
  const StepCacheView cache = cache_of(world.block, state.layout, capacity);
  cache.active.for_each([&](uint32_t slot) {
    if (works) visit_body(scratch.bodies[slot], is_non_colliding(state.properties[slot]), slot, visitor);
    if (is(StepStage::find_pairs)) give_value(visitor, k_bounds, slot, cache.bounds[slot]);
    if (!sweeps) return;
    const BodySweep& sweep = scratch.sweeps[slot];
    give_value(visitor, k_body_sweeps, slot, TraceSweep{sweep.from, sweep.displacement, sweep.rotation_vector});
  });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
