#pragma once
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Errors: those of create_world that name settings.
Status check_settings(const WorldDef& def, const FeatureTable& features);
void store_settings(const WorldDef& def, WorldState& world, bool has_manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
