#pragma once
#include <detent/world.h>

/// Reading and changing the settings of a world after its creation.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The definition that creates an empty world with this world's settings and capacity.
WorldDef get_settings(const World& world);
/// Changes all settings and wakes every body; `def.capacity` is ignored. Forces that were applied since the last step
/// add the same change of velocity as with the old length of a tick.
///
///     WorldDef def = get_settings(world);
///     def.substeps = 8;
///     Status status = set_settings(world, def);
///
/// Errors: as create_world.
Status set_settings(World& world, const WorldDef& def);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
