#pragma once
#include <detent/detail/state.h>
#include <detent/world.h>

#include "base/span.h"
#include "shape/cooked.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What of an asset a shape needs; none for shapes without.
inline AssetKind asset_kind_of(ShapeType shape) {
  return shape == ShapeType::hull       ? AssetKind::hull
         : shape == ShapeType::surface  ? AssetKind::surface
         : shape == ShapeType::compound ? AssetKind::compound
                                        : AssetKind::none;
}
inline bool is_shape_of(const BodyTraits& body, uint32_t asset) {
  return body.type != 0 && asset_kind_of(static_cast<ShapeType>(body.shape)) != AssetKind::none && body.asset == asset;
}

/// What the state keeps of the table's asset `index`. Errors: asset_missing; feature_missing (what reads none).
Status describe_asset(AssetTable table, uint32_t index, const FeatureTable& features, AssetState& description);

/// Compares every bound asset with the table. Errors: asset_missing, asset_mismatch, feature_missing.
Status check_assets(AssetTable table, const FeatureTable& features, Span<const AssetState> bound);

/// The asset of a shape that has one, which the state vouches for and the table holds, for a body of this type.
/// Errors: out_of_range, asset_missing, bad_argument.
Status find_shape(const World& world, ShapeType shape, uint32_t asset, BodyType type);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
