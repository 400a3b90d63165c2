#pragma once
#include <detent/world.h>

/// The library's step with its stages counted: the same source compiled a second time, so that the library carries
/// nothing for it.
namespace detent {
inline namespace DETENT_NAMESPACE {

enum class Stage : uint32_t {
  pairs,     ///< what moves, and which bounds overlap
  collide,   ///< contact points of pairs
  rows,      ///< of the contacts: arms, responses, effective masses
  islands,   ///< and the order of the solve, loads, numbers of substeps
  predict,   ///< what gravity and forces add in a substep
  solve,     ///< the substeps, which integrate positions too
  finalise,  ///< sweeps and new poses
  impacts,   ///< continuous collision
};
constexpr uint32_t k_stage_count = 8;
inline constexpr const char* k_stage_names[k_stage_count] = {"pairs",   "collide", "rows",     "islands",
                                                             "predict", "solve",   "finalise", "impacts"};

/// Ticks of the board's timer in each stage since the last reset, and how often each was entered.
struct StageTicks {
  uint64_t ticks[k_stage_count];
  uint32_t calls[k_stage_count];
};
extern StageTicks stage_ticks;

/// As step(). The world's features must be k_counted_features.
StepReport counted_step(World& world);
extern const FeatureTable k_counted_features;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
