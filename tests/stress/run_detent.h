#pragma once
#include <detent/config.h>

#include "tests/stress/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// This library in the configuration that the source is compiled for.
detent_stress::Engine stress_engine();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
