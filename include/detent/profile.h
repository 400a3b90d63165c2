#pragma once
#include <detent/config.h>

/// Times of a step's stages, by the caller's clock. Set WorldHooks::profile to measure them; it does not change the
/// state.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The stages of a step, in their order.
enum class StepStage : uint32_t {
  find_pairs,     ///< moving bodies, their bounds, pairs with overlapping bounds, and bodies that wake
  collide_pairs,  ///< contact points of pairs, and the rows of the solver
  build_islands,  ///< islands, solve order, loads, numbers of substeps
  solve_islands,  ///< the substeps
  raise_events,   ///< contact events
  advance,        ///< sweeps, continuous collision and sensors
  finalise,       ///< new poses
  store,          ///< bodies that fall asleep, contacts for the next tick, broken joints, body events
};
inline constexpr uint32_t k_step_stage_count = 8;  ///< how many stages there are
/// The name of the enumerator. Never null.
const char* stage_name(StepStage stage);

/// Times of the stages, summed over steps.
struct Profile {
  uint64_t (*now)(void* user) = nullptr;    ///< the clock; it must not run backwards, nor use the world
  void* user = nullptr;                     ///< passed to `now`
  uint64_t ticks[k_step_stage_count] = {};  ///< clock ticks in each stage, summed over steps; the caller may reset them
  uint64_t steps = 0;                       ///< number of steps that were not idle
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
