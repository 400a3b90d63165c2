#pragma once
#include <detent/config.h>

#include "tests/campaigns/manifolds/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The library in the configuration of this compilation.
detent_manifolds::Engine manifolds_engine();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
