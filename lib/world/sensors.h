#pragma once
#include <detent/features.h>

#include "base/heap.h"
#include "broad_phase/overflow.h"
#include "broad_phase/pair_filter.h"
#include "state/step_cache.h"

/// Finds the bodies that are inside a sensor at the end of a step, and those that only passed through it. It tests only
/// pairs with a body that moved or was changed by a call; the others keep their state. Whether a body is inside depends
/// on the poses alone. A machine that restored a state tests all pairs and finds the same result.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct KeyOrder {
  bool operator()(uint64_t a, uint64_t b) const { return a < b; }
};
/// Pairs of a sensor and a body, as sensed_key(). If there is no room for all, the smallest keys stay.
using SensedKeys = SmallestOf<uint64_t, KeyOrder>;

/// `through`: the body was inside the sensor during this step but is not at its end.
constexpr uint64_t sensed_key(uint32_t sensor, uint32_t body, bool through) {
  return pair_key(sensor, body << 1 | (through ? 1 : 0));
}

/// Inputs and results of the sensor stage. `poses` are those at the times `from` of the sweeps.
struct SensorStage {
  AssetTable assets;
  const FeatureTable& features;
  PairFilter filter;
  Span<const BodyProperties> properties;
  Span<const BodyPose> poses;
  Span<const BodySweep> sweeps;
  StepCacheView cache;
  BitSet changed;                  ///< bodies that moved in the last step or were changed since
  Span<const SensedState> before;  ///< pairs that were inside at the end of the last step
  SensedKeys passed, found;        ///< pairs found before the last segment of the body's sweep; all pairs found
  Overflow& overflow;
  uint32_t undecided = 0;
};

/// Sets `changed` to the bodies that have changed since the last step. Call it before the step partitions the bodies.
void note_changed(const StepCacheView& cache, uint32_t slots_used, BitSet changed);

/// Notes the sensors that the body `slot` touches on a segment of its sweep. An impact ends such a segment at `until`,
/// before the tick ends. `stage`: a SensorStage.
void sense_sweep(void* stage, uint32_t slot, Fraction until);

/// Finds the pairs that are inside and those that passed through, raises the events, and stores the pairs that are
/// inside. Call it once all sweeps are final.
void sense(SensorStage& stage, const StateView<uint8_t>& state, SensorEventBuffer events, StepReport& report);

/// The functions of the sensor feature, for a feature table.
struct SensorOps {
  decltype(&note_changed) start;
  decltype(&sense_sweep) sweep;
  decltype(&sense) end;
};

/// Removes all sensed pairs of a body that has changed, as a sensor and as a sensed body.
void forget_sensed(StateView<uint8_t>& state, uint32_t slot);
/// Checks that the world can have sensors. Errors: feature_missing, pool_full.
Status check_sensors(const World& world);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
