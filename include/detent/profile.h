#pragma once
#include <detent/config.h>

/// Where a step's time goes, by the caller's clock. Set World::profile; without it nothing is read or kept, and in
/// either case the state is the same.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// In the order in which a step goes through them.
enum class StepStage : uint32_t {
  find_pairs,  ///< what moves, its bounds, which of them overlap, and who wakes
  collide,     ///< contact points of pairs, and the rows of the solver
  islands,     ///< and the order of the solve, loads, numbers of substeps
  solve,       ///< the substeps
  events,      ///< contact events
  advance,     ///< sweeps, and continuous collision
  finalise,    ///< new poses
  store,       ///< who falls asleep; the contacts for the next tick
};
inline constexpr uint32_t k_step_stage_count = 8;  ///< how many stages there are
/// The enumerator's name. Never null.
const char* stage_name(StepStage stage);

/// Times of the stages, summed over steps.
struct Profile {
  uint64_t (*now)(void* user) = nullptr;    ///< never goes back; must not touch the world
  void* user = nullptr;                     ///< given to `now`
  uint64_t ticks[k_step_stage_count] = {};  ///< of the clock, in each stage, summed over steps; reset it as you like
  uint64_t steps = 0;                       ///< that were not idle
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
