#include "shape/cooked.h"

#include "base/bytes.h"
#include "base/crc.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

bool cooked_is_zero(const uint8_t* bytes, uint32_t from, uint32_t to) {
  for (uint32_t i = from; i < to; ++i) {
    if (bytes[i] != 0) return false;
  }
  return true;
}

Status check_cooked(const Asset& asset, const uint8_t (&magic)[8], uint32_t version, uint32_t header_bytes) {
  if (asset.bytes == nullptr) return Status::truncated;
  if (reinterpret_cast<uintptr_t>(asset.bytes) % 8 != 0) return Status::buffer_misaligned;
  const uint8_t* const bytes = asset.bytes;
  const uint32_t magic_count = asset.byte_count < sizeof magic ? asset.byte_count : uint32_t{sizeof magic};
  if (!have_same_bytes(bytes, magic, magic_count)) return Status::not_detent;
  if (asset.byte_count < k_cooked_version_at + 4) return Status::truncated;
  if (cooked_u32(bytes + k_cooked_version_at) != version) return Status::format_unknown;
  if (asset.byte_count < header_bytes || asset.byte_count < cooked_u32(bytes + k_cooked_byte_count_at)) {
    return Status::truncated;
  }
  if (asset.byte_count > cooked_u32(bytes + k_cooked_byte_count_at)) return Status::corrupt;
  const uint32_t checksum = crc32(bytes + k_cooked_checksum_at + 4, asset.byte_count - k_cooked_checksum_at - 4,
                                  crc32(bytes, k_cooked_checksum_at));
  return cooked_u32(bytes + k_cooked_checksum_at) == checksum ? Status::ok : Status::corrupt;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
