#pragma once
#include <detent/features.h>

#include "base/heap.h"
#include "broad_phase/losses.h"
#include "broad_phase/pair_filter.h"
#include "state/step_cache.h"

/// Who is within a sensor, and who was on the way. Only pairs of which a body moved, or was changed by a call, are
/// asked about; the others are as they were. What is then within follows from the bodies' poses alone, so a machine
/// that was restored, and asks about all pairs, finds the same.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct KeyOrder {
  bool operator()(uint64_t a, uint64_t b) const { return a < b; }
};
/// Pairs of a sensor and a body by sensed_key(): the smallest that there is room for.
using SensedKeys = SmallestOf<uint64_t, KeyOrder>;

/// `through`: the body was within the sensor in this step, and is not at its end.
constexpr uint64_t sensed_key(uint32_t sensor, uint32_t body, bool through) {
  return pair_key(sensor, body << 1 | (through ? 1 : 0));
}

/// What the stage reads and finds. Poses are those of sweep.from, and follow it.
struct SensorStage {
  AssetTable assets;
  const FeatureTable& features;
  PairFilter filter;
  Span<const BodyTraits> traits;
  Span<const BodyPose> poses;
  Span<const BodySweep> sweeps;
  StepCacheView cache;
  BitSet changed;                  ///< the bodies that moved in the last step, or were changed since
  Span<const SensedState> before;  ///< who was within at the end of the last step
  SensedKeys passed, found;        ///< who was within before the last stretch of its sweep; who at all
  Losses& losses;
  uint32_t undecided = 0;
};

/// Notes who has changed since the last step, before it sorts them out.
void note_changed(const StepCacheView& cache, uint32_t slots_used, BitSet changed);

/// A stretch of the sweep of `slot` ends before the tick does: notes whose sensor it has met on it. `stage`: a
/// SensorStage.
void sense_stretch(void* stage, uint32_t slot, Fraction until);

/// Once all sweeps are final: finds who is within and who was on the way, raises the events, and stores who is within.
void sense(SensorStage& stage, const StateView<uint8_t>& state, SensorEventBuffer events, StepReport& report);

/// For a feature table.
struct SensorOps {
  decltype(&note_changed) start;
  decltype(&sense_stretch) stretch;
  decltype(&sense) end;
};

/// The body, as a sensor or within others, is not what it was: nobody is within.
void forget_sensed(StateView<uint8_t>& state, uint32_t slot);
/// Whether the world can have sensors. Errors: feature_missing, pool_full.
Status check_sensors(const World& world);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
