#pragma once
#include <detent/world.h>

#include "tests/campaigns/fuzz/target.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Of the worlds whose snapshots are mutated: one of those that random calls are made on (tests/campaigns/sequences).
inline constexpr Capacity k_fuzzed_capacity = {10, 24, 6, true, 6, 6};

/// Snapshots of one kind of world, for `load`.
extern const detent_fuzz::Target k_snapshot_target;
/// Differences to one of them, for `apply_delta` and `load`.
extern const detent_fuzz::Target k_delta_target;
/// What a rollback session hears from others, and when it advances.
extern const detent_fuzz::Target k_session_target;
/// Recordings, for the player: played, sought in, passed over, recovered.
extern const detent_fuzz::Target k_recording_target;
/// Cooked hulls, compounds, meshes and height fields, for those who describe, bind and use them.
extern const detent_fuzz::Target k_assets_target;
/// Random calls, which the bytes decide (tests/campaigns/sequences).
extern const detent_fuzz::Target k_calls_target;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
