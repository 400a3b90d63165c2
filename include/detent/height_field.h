#pragma once
#include <detent/asset.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a cooked height field (docs/height_field.md) says of itself. The same in every configuration. The sample
/// (i, j) lies at origin + (i spacing_x, height(i, j) height_step, j spacing_z); y is up.
struct HeightFieldInfo {
  uint32_t columns = 0;     ///< cells along x, 1 to 4096
  uint32_t rows = 0;        ///< cells along z, 1 to 4096
  int32_t exponent = 0;     ///< of its unit of length, 2^exponent m; lengths are in 2^-30 of it
  bool one_sided = false;   ///< met from above alone
  int32_t origin[3] = {};   ///< of the sample (0, 0)
  int32_t spacing_x = 0;    ///< of samples along x
  int32_t spacing_z = 0;    ///< of samples along z
  int32_t height_step = 0;  ///< what a height counts
  int32_t low = 0;          ///< the least height, in height steps
  int32_t high = 0;         ///< the greatest
};

/// Describes a cooked height field, after every check. Errors: buffer_misaligned (8), not_detent, format_unknown,
/// truncated, corrupt, out_of_range (the exponent).
Status height_field_info(const Asset& asset, HeightFieldInfo& info);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
