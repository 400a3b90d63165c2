#include "base/digest.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

uint64_t digest_bytes(const uint8_t* bytes, uint32_t byte_count, uint64_t seed) {
  uint64_t running = digest_step(seed, byte_count);
  for (; byte_count >= 8; byte_count -= 8, bytes += 8) running = digest_step(running, load_u64(bytes));
  if (byte_count != 0) {
    uint8_t tail[8] = {};
    memcpy(tail, bytes, byte_count);
    running = digest_step(running, load_u64(tail));
  }
  return digest_finish(running);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
