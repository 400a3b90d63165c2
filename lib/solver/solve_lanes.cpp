#include "solver/solve_lanes.h"

#if DETENT_QUADS
#include "solver/lane_passes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The passes for a group of `count` contacts.
const LanePasses& passes_for(uint32_t count) {
#if DETENT_WIDE_LANES
  if (lane_spaces(count) == 2) return k_wide_passes;
#elif defined(__x86_64__) && defined(DETENT_F32)
  if (lane_spaces(count) == 2) return k_group_passes<8>;
#endif
  static_cast<void>(count);
  return k_group_passes<4>;
}

}  // namespace

void put_in_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, Span<const ContactOrder> group,
                  LaneSpace* lanes) {
  passes_for(group.count).put(bodies, contacts, group, lanes);
}

void renew_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, LaneSpace* lanes, uint32_t count) {
  passes_for(count).renew(bodies, contacts, lanes);
}

void take_from_lanes(const LaneSpace* lanes, uint32_t count, Span<ContactWork> contacts) {
  passes_for(count).take(lanes, contacts);
}

void warm_start_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count) {
  passes_for(count).warm_start(settings, bodies, lanes);
}

void solve_normals_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count) {
  passes_for(count).solve_normals(settings, bodies, lanes);
}

void relax_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count) {
  passes_for(count).relax(settings, bodies, lanes);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
