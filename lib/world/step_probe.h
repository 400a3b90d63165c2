#pragma once
#include <detent/world.h>

#include "ccd/impact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// As step(), for tests. `probe` records the sweeps of the bodies, and can switch off the filters of continuous
/// collision.
StepReport step_probed(World& world, ImpactProbe& probe);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
