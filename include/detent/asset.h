#pragma once
#include <detent/config.h>

/// @file
/// Cooked data that worlds share.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Cooked data that lives outside the world's block, possibly in flash and shared between worlds.
struct Asset {
  const uint8_t* bytes = nullptr;  ///< aligned to 8; must outlive every world bound to it
  uint32_t byte_count = 0;         ///< of `bytes`
};

/// The assets of a world, in an order of the caller's choice that is the same on every machine.
/// The state holds each bound asset's index, size and content digest; another content is refused.
struct AssetTable {
  const Asset* assets = nullptr;  ///< `count` of them; they must outlive every world bound to them
  uint32_t count = 0;             ///< at least Capacity::assets, or those beyond it are missing
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
