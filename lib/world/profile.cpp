#include <detent/world.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

const char* stage_name(StepStage stage) {
  constexpr const char* k_names[k_step_stage_count] = {
      "find_pairs", "collide_pairs", "build_islands", "solve_islands", "raise_events", "advance", "finalise", "store"};
  const uint32_t index = static_cast<uint32_t>(stage);
  return index < k_step_stage_count ? k_names[index] : "";
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
