#pragma once
#include <detent/detail/state.h>
#include <detent/world.h>

#include "base/span.h"
#include "geometry/hull.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

inline bool is_in(AssetTable table, uint32_t index) {
  return index < table.count && table.assets[index].bytes != nullptr;
}
inline bool is_hull_of(const BodyTraits& body, uint32_t asset) {
  return body.type != 0 && static_cast<ShapeType>(body.shape) == ShapeType::hull && body.asset == asset;
}

/// What the state keeps of the table's asset `index`. Errors: asset_missing.
Status describe_asset(AssetTable table, uint32_t index, const HullCode& hulls, AssetState& description);

/// Compares every bound asset with the table. Errors: asset_missing, asset_mismatch; feature_missing (hulls).
Status check_assets(AssetTable table, const FeatureTable& features, Span<const AssetState> bound);

/// A hull that the state vouches for and the table holds, for a body of this type.
/// Errors: out_of_range, asset_missing, bad_argument.
Status find_hull(const World& world, uint32_t asset, BodyType type);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
