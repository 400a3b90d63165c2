#include "state/asset_binding.h"

#include "base/digest.h"
#include "contact/compound_ops.h"
#include "shape/hull.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {
constexpr uint64_t k_asset_seed = 0x6173736574u;
}

Status describe_asset(AssetTable table, uint32_t index, const FeatureTable& features, AssetState& description) {
  if (features.hull == nullptr && features.terrain == nullptr && features.compound == nullptr)
    return Status::feature_missing;
  if (!is_in(table, index)) return Status::asset_missing;
  const Asset& asset = table.assets[index];
  HullView hull;
  Terrain terrain;
  CompoundView compound;
  AssetKind kind = AssetKind::other;
  if (features.hull != nullptr && features.hull->read(asset, hull) == Status::ok) kind = AssetKind::hull;
  if (features.terrain != nullptr && features.terrain->read(asset, terrain) == Status::ok) kind = AssetKind::terrain;
  if (features.compound != nullptr && features.compound->read(asset, compound) == Status::ok)
    kind = AssetKind::compound;
  description = {digest_bytes(asset.bytes, asset.byte_count, k_asset_seed), asset.byte_count,
                 static_cast<uint32_t>(kind)};
  return Status::ok;
}

Status check_assets(AssetTable table, const FeatureTable& features, Span<const AssetState> bound) {
  for (uint32_t i = 0; i < bound.count; ++i) {
    if (bound[i].kind == static_cast<uint32_t>(AssetKind::none)) continue;
    AssetState found{};
    if (const Status status = describe_asset(table, i, features, found); status != Status::ok) return status;
    if (found.digest != bound[i].digest || found.byte_count != bound[i].byte_count || found.kind != bound[i].kind) {
      return Status::asset_mismatch;
    }
  }
  return Status::ok;
}

Status find_shape(const World& world, ShapeType shape, uint32_t asset, BodyType type) {
  const Span<const AssetState> bound = view_of(world).assets;
  if (asset >= bound.count) return Status::out_of_range;
  const AssetKind kind = static_cast<AssetKind>(bound[asset].kind);
  if (kind == AssetKind::none || !is_in(world.hooks.assets, asset)) return Status::asset_missing;
  if (kind != asset_kind_of(shape)) return Status::bad_argument;
  if (kind != AssetKind::hull) return Status::ok;
  const bool principal = hull_view(world.hooks.assets.assets[asset].bytes).frame() == HullFrame::principal;
  return type == BodyType::dynamic && !principal ? Status::bad_argument : Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
