#pragma once
#include <detent/world.h>

#include "ccd/impact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// As step(), for tests: the sweeps that bodies were given are written down, and filters can be switched off.
StepReport step_probed(World& world, ImpactProbe& probe);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
