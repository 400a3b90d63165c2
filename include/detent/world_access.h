#pragma once
#include <detent/world.h>

/// Reading and changing what the world's definition set.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The definition that would create this world, empty.
WorldDef get_settings(const World& world);
/// Changes all settings but the capacity, which is ignored, and wakes every body. Forces that were applied since the
/// last step add the speed that they would have added in the tick of then.
///
///     WorldDef def = get_settings(world);
///     def.substeps = 8;
///     Status status = set_settings(world, def);
///
/// Errors: as create_world.
Status set_settings(World& world, const WorldDef& def);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
