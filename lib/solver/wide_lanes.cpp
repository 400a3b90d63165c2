#include "solver/solve_lanes.h"

// Compiled for processors with registers of 512 bits (AVX-512).
#if DETENT_WIDE_LANES
#include "solver/lane_passes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

const LanePasses k_wide_passes = k_group_passes<8>;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
