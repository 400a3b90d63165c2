#include "world/sensors.h"

#include <detent/distance.h>
#include <detent/sensor.h>

#include "base/binary_search.h"
#include "ccd/impact_pair.h"
#include "contact/compound_ops.h"
#include "contact/terrain_distance.h"
#include "motion/angular_velocity.h"
#include "motion/finalise.h"
#include "shape/bounds.h"
#include "shape/shape_properties.h"
#include "world/events.h"
#include "world/query_bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The largest distance at which a body counts as within a sensor is 2^k_within_power times the smaller of the two
/// bodies' extents (shape_extent()). This distance exceeds the tolerance of a time of impact; therefore a body that
/// hits the sensor is within the sensor at the time of impact. The distance is less than the margin of sensed_bounds().
constexpr int k_within_power = -14;

/// Bounds that contain the body from the time `from` of its sweep to the end of the tick. Their margin covers the
/// distance that k_within_power gives, and the rounding of bounds.
Bounds sensed_bounds(const SensorStage& stage, uint32_t slot) {
  const BodyProperties& properties = stage.properties[slot];
  if (is_half_space(properties)) return k_everywhere;
  const Real ball = real_from_unit(properties.bounding_radius, properties.size_exponent);
  const Real room = ball + scale_by_power(ball, -8) + Real(0x1p-13);
  const BodySweep& sweep = stage.sweeps[slot];
  const Vec3<Real> displacement = rest_of(sweep, sweep.from).displacement;
  const Position& from = stage.poses[slot].position;
  const Vec3<Real> back = {min(displacement.x, k_zero), min(displacement.y, k_zero), min(displacement.z, k_zero)};
  const Vec3<Real> ahead = {max(displacement.x, k_zero), max(displacement.y, k_zero), max(displacement.z, k_zero)};
  return {moved(moved(from, back), {-room, -room, -room}), moved(moved(from, ahead), {room, room, room})};
}

/// The pose at the end of the body's sweep: the same pose as finalise_body() will compute.
BodyPose end_pose(const SensorStage& stage, uint32_t slot) {
  BodyPose pose = stage.poses[slot];
  const Sweep rest = rest_of_tick(stage.sweeps[slot]);
  pose.rotation = sweep_end_rotation(pose.rotation, rest);
  sweep_end_position(pose, rest);
  return pose;
}

/// If the body is a half-space, moves its position along its plane to the other body, into the range of the narrow
/// phase.
void bring_near(const BodyProperties& properties, const BodyPose& other, BodyPose& pose) {
  pose.position = pose_near(properties, pose, other.position).position;
}

/// Sets `farther` to true if the parts of one body are all farther than `distance_max`, m, from the parts of the other
/// body, else to false. Returns false if a part could not be tested.
bool find_farther(const SensorStage& stage, const BodyProperties& a, const Pose& pose_a, const BodyProperties& b,
                  const Pose& pose_b, Real distance_max, bool& farther) {
  const ConvexParts parts_a(a, stage.assets), parts_b(b, stage.assets);
  farther = true;
  for (uint32_t j = 0; j < parts_b.count() && farther; ++j) {
    Convex convex_b;
    if (!parts_b.convex(j, false, convex_b)) return false;
    if (is_terrain(a)) {
      if (!stage.features.terrain_distance->farther(stage.assets, a, pose_a, b, convex_b, pose_b, distance_max,
                                                    farther))
        return false;
      continue;
    }
    for (uint32_t i = 0; i < parts_a.count() && farther; ++i) {
      Convex convex_a;
      if (!parts_a.convex(i, false, convex_a) ||
          farther_than(convex_a, pose_a, convex_b, pose_b, distance_max, farther) != Status::ok)
        return false;
    }
  }
  return parts_a.count() != 0 && parts_b.count() != 0;
}

bool is_within(SensorStage& stage, uint32_t sensor, uint32_t body) {
  const BodyProperties &a = stage.properties[sensor], &b = stage.properties[body];
  BodyPose end_a = end_pose(stage, sensor), end_b = end_pose(stage, body);
  bring_near(a, end_b, end_a);
  bring_near(b, end_a, end_b);
  const Pose pose_a = {end_a.position, end_a.rotation}, pose_b = {end_b.position, end_b.rotation};
  const Real distance_max = scale_by_power(min(shape_extent(a), shape_extent(b)), k_within_power);
  bool farther = false;
  const bool asked = is_terrain(b) ? find_farther(stage, b, pose_b, a, pose_a, distance_max, farther)
                                   : find_farther(stage, a, pose_a, b, pose_b, distance_max, farther);
  if (!asked) ++stage.undecided;
  return !asked || !farther;
}

/// Whether the sensor and the body touch between the time `from` of the body's sweep and `until`.
bool meets(SensorStage& stage, uint32_t sensor, uint32_t body, Fraction until) {
  const BodyProperties &a = stage.properties[sensor], &b = stage.properties[body];
  BodyPose pose_a = stage.poses[sensor], pose_b = stage.poses[body];
  bring_near(a, pose_b, pose_a);
  bring_near(b, pose_a, pose_b);
  const BodySweep& sweep = stage.sweeps[body];
  const SweptBody swept_a = {a, pose_a, stage.sweeps[sensor]}, swept_b = {b, pose_b, sweep};
  PairSearch search(stage.assets, stage.features, swept_a, swept_b, sweep.from);
  Meeting meeting;
  if (!search.find({k_zero, k_zero, false, false}, {}, meeting)) {
    ++stage.undecided;
    return true;
  }
  const TimeOfImpact& impact = meeting.impact;
  if (impact.outcome == ToiOutcome::clear || impact.time > until) return false;
  stage.undecided += impact.outcome == ToiOutcome::undecided ? 1 : 0;
  return true;
}

bool may_sense(const SensorStage& stage, uint32_t sensor, uint32_t body) {
  const BodyProperties &a = stage.properties[sensor], &b = stage.properties[body];
  if (is_sensor(b) || (!is_dynamic(a) && type_of(b) == BodyType::fixed)) return false;
  if (is_ground(a) && is_ground(b)) return false;
  return stage.filter.lets_through(sensor, body);
}

uint64_t key_of(const SensedState& sensed) { return sensed_key(sensed.sensor, sensed.body, false); }

bool was_within(const SensorStage& stage, uint64_t key) {
  const uint32_t at = partition_point(stage.before.count, [&](uint32_t i) { return key_of(stage.before[i]) < key; });
  return at < stage.before.count && key_of(stage.before[at]) == key;
}

/// The index of a pair in `passed`, or passed.count if it is not there. The search is linear, because the list is
/// short: only impacts divide a sweep into segments.
uint32_t find_passed(const SensorStage& stage, uint64_t key) {
  uint32_t place = 0;
  while (place < stage.passed.count && stage.passed.storage[place] != key) ++place;
  return place;
}

void add(SensorStage& stage, SensedKeys& keys, uint64_t key) {
  uint64_t lost = 0;
  if (keys.add(key, lost)) stage.overflow.add(CapacityEventType::sensed, pair_low(lost), pair_high(lost) >> 1);
}

/// Adds the pair to `found` if the body is within the sensor at the end of the tick. Otherwise adds the pair, as passed
/// through, if the body touches the sensor on the last segment of its sweep, but did not on an earlier segment, and was
/// not within the sensor at the end of the last step.
void evaluate_pair(SensorStage& stage, uint32_t sensor, uint32_t body) {
  if (!may_sense(stage, sensor, body)) return;
  const uint64_t within = sensed_key(sensor, body, false), through = sensed_key(sensor, body, true);
  const uint32_t place = find_passed(stage, through);
  const bool has_passed = place < stage.passed.count;
  if (is_within(stage, sensor, body)) {
    if (has_passed) stage.passed.storage[place] = UINT64_MAX;
    add(stage, stage.found, within);
    return;
  }
  if (has_passed || was_within(stage, within)) return;
  if (is_at_rest(stage.sweeps[sensor]) && is_at_rest(stage.sweeps[body])) return;
  if (meets(stage, sensor, body, k_whole_step)) add(stage, stage.found, through);
}

/// Evaluates each pair of a sensor and a body once, if at least one of the two has changed. If both have changed, the
/// pair is evaluated when the loop visits the sensor.
void settle_changed(SensorStage& stage) {
  const StepCacheView& cache = stage.cache;
  for (uint32_t i = 0; i < stage.changed.words.count; ++i) stage.changed.words[i] |= cache.active.words[i];
  cache.active.for_each([&](uint32_t slot) {
    if (!cache.tree.has(slot)) cache.bounds[slot] = sensed_bounds(stage, slot);
  });
  stage.changed.for_each([&](uint32_t slot) {
    const BodyProperties& properties = stage.properties[slot];
    if (properties.type == 0) return;
    const Bounds bounds = sensed_bounds(stage, slot);
    if (!is_sensor(properties)) {
      cache.tree.for_each_near(bounds, [&](uint32_t other) {
        if (is_sensor(stage.properties[other]) && !stage.changed.has(other)) evaluate_pair(stage, other, slot);
      });
      return;
    }
    cache.tree.for_each_near(bounds, [&](uint32_t other) {
      if (!cache.active.has(other)) evaluate_pair(stage, slot, other);
    });
    cache.active.for_each([&](uint32_t other) {
      if (overlap(bounds, cache.bounds[other])) evaluate_pair(stage, slot, other);
    });
  });
}

/// Writes the sensor events of a step. Input of raise_all(): the pairs of the last step and the pairs found in this
/// step, both sorted by key.
struct SensorEvents {
  Span<const BodyProperties> properties;
  Span<SensorEvent> events;
  uint32_t kept = 0, dropped = 0;

  void raise(SensorEventType type, uint64_t key) {
    if (kept == events.count) {
      ++dropped;
      return;
    }
    const uint32_t sensor = pair_low(key), body = pair_high(key) >> 1;
    events[kept++] = {type, {sensor + 1, properties[sensor].generation}, {body + 1, properties[body].generation}};
  }
  void raise_all(Span<const SensedState> before, Span<const uint64_t> found) {
    uint32_t old = 0, now = 0;
    while (old < before.count || now < found.count) {
      const uint64_t key_before = old < before.count ? key_of(before[old]) : UINT64_MAX;
      const uint64_t key_found = now < found.count ? found[now] & ~uint64_t{1} : UINT64_MAX;
      const uint64_t key = key_before < key_found ? key_before : key_found;
      const bool was = key_before == key, is = key_found == key && found[now] == key;
      if (!was) raise(SensorEventType::enter, key);
      if (!is) raise(SensorEventType::leave, key);
      old += was ? 1 : 0;
      now += key_found == key ? 1 : 0;
    }
  }
};

}  // namespace

void note_changed(const StepCacheView& cache, uint32_t slots_used, BitSet changed) {
  const bool known = cache.cache.fresh != 0;  // if false, the active set belongs to another state
  for (uint32_t i = 0; i < changed.words.count; ++i) changed.words[i] = known ? cache.active.words[i] : 0;
  for (uint32_t slot = 0; !known && slot < slots_used; ++slot) changed.set(slot);
}

void sense_sweep(void* context, uint32_t slot, Fraction until) {
  SensorStage& stage = *static_cast<SensorStage*>(context);
  const Bounds bounds = sensed_bounds(stage, slot);
  const auto pass = [&](uint32_t sensor) {
    if (!may_sense(stage, sensor, slot) || was_within(stage, sensed_key(sensor, slot, false))) return;
    const uint64_t key = sensed_key(sensor, slot, true);
    if (find_passed(stage, key) == stage.passed.count && meets(stage, sensor, slot, until))
      add(stage, stage.passed, key);
  };
  stage.cache.tree.for_each_near(bounds, [&](uint32_t other) {
    if (is_sensor(stage.properties[other]) && !stage.cache.active.has(other)) pass(other);
  });
  stage.cache.active.for_each([&](uint32_t other) {
    if (is_sensor(stage.properties[other]) && overlap(bounds, sensed_bounds(stage, other))) pass(other);
  });
}

void sense(SensorStage& stage, const StateView<uint8_t>& state, SensorEventBuffer buffer, StepReport& report) {
  settle_changed(stage);
  for (const uint64_t key : stage.passed.storage.first(stage.passed.count)) {
    if (key != UINT64_MAX) add(stage, stage.found, key);
  }
  for (const SensedState& sensed : stage.before) {
    if (!stage.changed.has(sensed.sensor) && !stage.changed.has(sensed.body)) add(stage, stage.found, key_of(sensed));
  }
  const Span<uint64_t> found = stage.found.storage.first(stage.found.count);
  heap_sort(found, stage.found.less);

  const Span<SensorEvent> room = room_of(buffer);
  SensorEvents events = {stage.properties, room};
  events.raise_all(stage.before, found);
  report.events.sensor = events.kept;
  report.events.sensor_dropped = room.count == 0 ? 0 : events.dropped;
  report.lost.sensed = stage.passed.dropped + stage.found.dropped;
  report.lost.sensed_undecided = stage.undecided;
  // The body of a dropped pair may still be within its sensor, so the next step must test all pairs.
  if (stage.found.dropped != 0) stage.cache.cache.fresh = 0;

  uint32_t count = 0;
  for (const uint64_t key : found) {
    if ((key & 1) == 0) state.sensed[count++] = {pair_low(key), pair_high(key) >> 1};
  }
  for (uint32_t i = count; i < state.world.sensed_count; ++i) state.sensed[i] = SensedState{};
  state.world.sensed_count = count;
}

const SensorOps k_sensor_ops = {note_changed, sense_sweep, sense};

void forget_sensed(StateView<uint8_t>& state, uint32_t slot) {
  uint32_t kept = 0;
  for (const SensedState& sensed : state.sensed.first(state.world.sensed_count)) {
    if (sensed.sensor != slot && sensed.body != slot) state.sensed[kept++] = sensed;
  }
  for (uint32_t i = kept; i < state.world.sensed_count; ++i) state.sensed[i] = SensedState{};
  state.world.sensed_count = kept;
}

Status check_sensors(const World& world) {
  if (!contains(world.features->features, Features::sensors)) return Status::feature_missing;
  return view_of(world).sensed.count == 0 ? Status::pool_full : Status::ok;
}

Status get_sensed(const World& world, BodyId id, BodyId* bodies, uint32_t capacity, uint32_t& count) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0, found = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  if (!is_sensor(state.properties[slot])) return Status::bad_argument;
  for (const SensedState& sensed : state.sensed.first(state.world.sensed_count)) {
    if (sensed.sensor != slot) continue;
    if (bodies != nullptr && found < capacity)
      bodies[found] = {sensed.body + 1, state.properties[sensed.body].generation};
    ++found;
  }
  count = found;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
