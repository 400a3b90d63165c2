#pragma once
#include <detent/config.h>

/// @file
/// Cooked data (hulls, compounds, meshes, height fields), which several worlds can share.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Cooked data outside the world's block. It may lie in flash, and several worlds may share it.
struct Asset {
  const uint8_t* bytes = nullptr;  ///< aligned to 8 bytes; must outlive every world bound to it
  uint32_t byte_count = 0;         ///< number of bytes at `bytes`
};

/// The assets of a world. The caller chooses the order, which must be the same on every machine.
/// The state stores the index, size and content digest of each bound asset; an asset with other content is refused
/// (asset_mismatch).
struct AssetTable {
  const Asset* assets = nullptr;  ///< `count` assets; they must outlive every world bound to them
  /// Number of assets. If it is below Capacity::assets, the remaining indices are missing (asset_missing).
  uint32_t count = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
