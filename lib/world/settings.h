#pragma once
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Checks the settings. Errors: those of create_world() that concern settings.
Status check_settings(const WorldDef& def, const FeatureTable& features);
void store_settings(const WorldDef& def, WorldState& world, bool has_manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
