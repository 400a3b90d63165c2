#pragma once
#include <detent/world.h>

#include "tests/campaigns/joint_fuzz/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The library in the configuration of this compilation.
detent_joint_fuzz::Engine joint_fuzz_engine();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
