#pragma once
#include <detent/config.h>

#include "tests/fuzz/target.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Snapshots of one kind of world, for `load`.
extern const detent_fuzz::Target k_snapshot_target;
/// Recordings, for the player.
extern const detent_fuzz::Target k_recording_target;
/// Cooked hulls, compounds, meshes and height fields, for those who describe, bind and use them.
extern const detent_fuzz::Target k_assets_target;
/// Random calls, which the bytes decide (tests/sequences).
extern const detent_fuzz::Target k_calls_target;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
