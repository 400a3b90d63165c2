#pragma once
#include <detent/features.h>

#include "base/heap.h"
#include "broad_phase/overflow.h"
#include "broad_phase/pair_filter.h"
#include "state/step_cache.h"

/// The sensor stage. It finds the bodies that are within a sensor at the end of a step, and the bodies that only passed
/// through it. It tests only the pairs of which a body moved or was changed by a call; all other pairs keep their
/// result. Whether a body is within a sensor depends on the poses alone. Therefore a machine that has just restored a
/// state, and so tests all pairs, finds the same result.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct KeyOrder {
  bool operator()(uint64_t a, uint64_t b) const { return a < b; }
};
/// Pairs of a sensor and a body, by sensed_key(). If the storage has no room for all pairs, it keeps the smallest keys.
using SensedKeys = SmallestOf<uint64_t, KeyOrder>;

/// The key of a pair of a sensor and a body. `through`: the body was within the sensor during this step, but is not
/// within it at the end of the step.
constexpr uint64_t sensed_key(uint32_t sensor, uint32_t body, bool through) {
  return pair_key(sensor, body << 1 | (through ? 1 : 0));
}

/// Inputs and results of the sensor stage. `poses`: at the time `from` of each body's sweep.
struct SensorStage {
  AssetTable assets;
  const FeatureTable& features;
  PairFilter filter;
  Span<const BodyProperties> properties;
  Span<const BodyPose> poses;
  Span<const BodySweep> sweeps;
  StepCacheView cache;
  BitSet changed;                  ///< bodies that moved in the last step or were changed since
  Span<const SensedState> before;  ///< pairs whose body was within the sensor at the end of the last step
  /// `passed`: the pairs that touched on a segment of the body's sweep before its last segment (impacts divide a sweep
  /// into segments). `found`: all pairs of this step.
  SensedKeys passed, found;
  Overflow& overflow;
  uint32_t undecided = 0;
};

/// Sets `changed` to the bodies that have changed since the last step. Must be called before partition_bodies().
void note_changed(const StepCacheView& cache, uint32_t slots_used, BitSet changed);

/// Finds the sensors that the body `slot` touches on a segment of its sweep. Adds each pair to `passed` if the body was
/// not within the sensor after the last step. `until`: the end of the segment, which is the time of an impact before
/// the end of the tick. `stage`: points to a SensorStage.
void sense_sweep(void* stage, uint32_t slot, Fraction until);

/// Finds the pairs of a sensor and a body that is within it at the end of the tick, and stores them in the state. Also
/// finds the bodies that passed through a sensor. Raises the events. Must be called after all sweeps are final.
void sense(SensorStage& stage, const StateView<uint8_t>& state, SensorEventBuffer events, StepReport& report);

/// Entry of FeatureTable (detent/features.h): the functions for sensors.
struct SensorOps {
  decltype(&note_changed) start;
  decltype(&sense_sweep) sweep;
  decltype(&sense) end;
};

/// Removes all sensed pairs in which the body `slot`, which has changed, is the sensor or the sensed body.
void forget_sensed(StateView<uint8_t>& state, uint32_t slot);
/// Returns ok if the world can have sensors. Errors: feature_missing, pool_full.
Status check_sensors(const World& world);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
