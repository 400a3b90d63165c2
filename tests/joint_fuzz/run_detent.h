#pragma once
#include <detent/world.h>

#include "tests/joint_fuzz/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// This library in the configuration that the source is compiled for.
detent_joint_fuzz::Engine joint_fuzz_engine();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
