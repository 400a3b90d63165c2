#pragma once
#include <detent/config.h>

#include "tests/manifolds/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// This library in the configuration that the source is compiled for.
detent_manifolds::Engine manifolds_engine();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
