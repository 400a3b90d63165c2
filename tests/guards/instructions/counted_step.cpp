#include "counted_step.h"

// All that the step includes comes first: only its own calls are to be counted.
#include "base/float_environment.h"
#include "broad_phase/broadphase.h"
#include "ccd/impact.h"
#include "contact/collide.h"
#include "contact/compound_ops.h"
#include "contact/contact_cache.h"
#include "contact/manifold_recycling.h"
#include "joint/joint.h"
#include "motion/activity.h"
#include "motion/angular_velocity.h"
#include "motion/finalise.h"
#include "motion/predict.h"
#include "shape/shape_properties.h"
#include "solver/contact_order.h"
#include "solver/contact_rows.h"
#include "solver/island.h"
#include "solver/solve.h"
#include "solver/substeps.h"
#include "state/step_cache.h"
#include "state/step_scratch.h"
#include "timer.h"
#include "world/events.h"
#include "world/joints.h"
#include "world/sensors.h"
#include "world/stage_ends.h"
#include "world/step_contacts.h"
#include "world/step_probe.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

StageTicks stage_ticks;

namespace {

/// From its making to its end.
class Counted {
 public:
  explicit Counted(Stage stage) : stage_(static_cast<uint32_t>(stage)), start_(timer_value()) {}
  ~Counted() {
    stage_ticks.ticks[stage_] += start_ - timer_value();
    ++stage_ticks.calls[stage_];
  }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  uint32_t stage_, start_;
};

ImpactReport counted_advance(const StepSettings& settings, const AssetTable& assets, const FeatureTable& features,
                             const ImpactPairs& pairs, const ImpactBodies& bodies, Span<ImpactPair> met,
                             Span<ImpactHit> hits, ImpactProbe* probe) {
  const Counted counted(Stage::impacts);
  return advance_to_impacts(settings, assets, features, pairs, bodies, met, hits, probe);
}
constexpr ContinuousOps k_counted_continuous_ops = {counted_advance};

constexpr FeatureTable counted_features() {
  FeatureTable table = feature_table<Features::box | Features::half_space | Features::continuous>;
  table.continuous = &k_counted_continuous_ops;
  return table;
}

}  // namespace

constexpr FeatureTable k_counted_features = counted_features();

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#define DETENT_COUNTED(stage, function, ...) \
  ([&] {                                     \
    const Counted counted_(Stage::stage);    \
    return (function)(__VA_ARGS__);          \
  }())
#define partition_bodies(...) DETENT_COUNTED(pairs, partition_bodies, __VA_ARGS__)
#define add_moving_pairs(...) DETENT_COUNTED(pairs, add_moving_pairs, __VA_ARGS__)
#define collide(...) DETENT_COUNTED(collide, collide, __VA_ARGS__)
#define make_rows(...) DETENT_COUNTED(rows, make_rows, __VA_ARGS__)
#define find_islands(...) DETENT_COUNTED(islands, find_islands, __VA_ARGS__)
#define order_contacts(...) DETENT_COUNTED(islands, order_contacts, __VA_ARGS__)
#define estimate_loads(...) DETENT_COUNTED(islands, estimate_loads, __VA_ARGS__)
#define choose_substeps(...) DETENT_COUNTED(islands, choose_substeps, __VA_ARGS__)
#define predict(...) DETENT_COUNTED(predict, predict, __VA_ARGS__)
#define solve(...) DETENT_COUNTED(solve, solve, __VA_ARGS__)
#define integrate_free(...) DETENT_COUNTED(solve, integrate_free, __VA_ARGS__)
#define make_sweeps(...) DETENT_COUNTED(finalise, make_sweeps, __VA_ARGS__)
#define finalise_body(...) DETENT_COUNTED(finalise, finalise_body, __VA_ARGS__)
#define wake_touched counted_wake_touched
#define find_contacts counted_find_contacts
#define step counted_step
#define step_probed counted_step_probed
#include "world/step_contacts.cpp"
// Which calls what stands before it.
#include "world/step.cpp"
