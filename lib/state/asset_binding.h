#pragma once
#include <detent/detail/state.h>
#include <detent/world.h>

#include "base/span.h"
#include "shape/cooked.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The kind of asset that a shape needs; AssetKind::none for shapes without an asset.
inline AssetKind asset_kind_of(ShapeType shape) {
  return shape == ShapeType::hull       ? AssetKind::hull
         : shape == ShapeType::terrain  ? AssetKind::terrain
         : shape == ShapeType::compound ? AssetKind::compound
                                        : AssetKind::none;
}
inline bool is_shape_of(const BodyProperties& body, uint32_t asset) {
  return body.type != 0 && asset_kind_of(static_cast<ShapeType>(body.shape)) != AssetKind::none && body.asset == asset;
}

/// Computes `description`, the entry that the state stores for asset `index` of the table. Errors: asset_missing;
/// feature_missing (the feature table has neither hulls, terrains nor compounds).
Status describe_asset(AssetTable table, uint32_t index, const FeatureTable& features, AssetState& description);

/// Checks that the asset table still has the bytes of every asset in `bound`. Errors: asset_missing, asset_mismatch,
/// feature_missing.
Status check_assets(AssetTable table, const FeatureTable& features, Span<const AssetState> bound);

/// Checks the asset of a shape for a body of this type. The asset must be bound in the state, must have the kind that
/// the shape needs, and must be in the table. Errors: out_of_range, asset_missing, bad_argument.
Status find_shape(const World& world, ShapeType shape, uint32_t asset, BodyType type);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
