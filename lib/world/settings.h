#pragma once
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Checks the settings. Errors: out_of_range, bad_argument, feature_missing.
Status check_settings(const WorldDef& def, const FeatureTable& features);
void store_settings(const WorldDef& def, WorldState& world, bool has_manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
