#pragma once
#include <detent/asset.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The properties of a cooked height field (docs/height_field.md). The same in every configuration. The sample (i, j)
/// lies at origin + (i spacing_x, height(i, j) height_step, j spacing_z), in the body's axes; y is up. Lengths are in
/// 2^(exponent - 30) m.
struct HeightFieldInfo {
  uint32_t columns = 0;     ///< cells along x, 1 to 4096
  uint32_t rows = 0;        ///< cells along z, 1 to 4096
  int32_t exponent = 0;     ///< the field's unit of length is 2^exponent m
  bool one_sided = false;   ///< whether bodies collide with it from above only
  int32_t origin[3] = {};   ///< position of the sample (0, 0)
  int32_t spacing_x = 0;    ///< distance of samples along x
  int32_t spacing_z = 0;    ///< distance of samples along z
  int32_t height_step = 0;  ///< length of one height step
  int32_t low = 0;          ///< least height, in height steps
  int32_t high = 0;         ///< greatest height, in height steps
};

/// Checks a cooked height field in full and describes it. Errors: buffer_misaligned (to 8 bytes), not_detent,
/// format_unknown, truncated, corrupt, out_of_range (the exponent).
Status height_field_info(const Asset& asset, HeightFieldInfo& info);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
