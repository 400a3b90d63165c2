#include "world/asset_binding.h"

#include "base/digest.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {
constexpr uint64_t k_asset_seed = 0x6173736574u;
}

Status describe_asset(AssetTable table, uint32_t index, AssetState& description) {
  if (index >= table.count || table.assets[index].bytes == nullptr) return Status::asset_missing;
  const Asset& asset = table.assets[index];
  description = {digest_bytes(asset.bytes, asset.byte_count, k_asset_seed), asset.byte_count, 1};
  return Status::ok;
}

Status check_assets(AssetTable table, Span<const AssetState> bound) {
  for (uint32_t i = 0; i < bound.count; ++i) {
    if (bound[i].bound == 0) continue;
    AssetState found{};
    if (const Status status = describe_asset(table, i, found); status != Status::ok) return status;
    if (found.digest != bound[i].digest || found.byte_count != bound[i].byte_count) return Status::asset_mismatch;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
