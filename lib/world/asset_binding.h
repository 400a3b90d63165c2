#pragma once
#include <detent/detail/state.h>
#include <detent/world.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What the state keeps of the table's asset `index`. Errors: asset_missing.
Status describe_asset(AssetTable table, uint32_t index, AssetState& description);

/// Compares every bound asset with the table. Errors: asset_missing, asset_mismatch.
Status check_assets(AssetTable table, Span<const AssetState> bound);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
