#pragma once
#include <detent/detail/shared.h>

#include "base/bytes.h"

/// The arithmetic of the digest. digest_step() adds a word to the running value. For a given word, its result is a
/// bijection of the running value; for a given running value, its result is a bijection of the word. Therefore a change
/// of a single word always changes the result (SPEC.md, "Digest").
namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_SHARED constexpr uint64_t digest_step(uint64_t running, uint64_t word) {
  running ^= word * 0x9e3779b97f4a7c15u;
  running = (running << 29) | (running >> 35);
  return running * 0xbf58476d1ce4e5b9u + 0x94d049bb133111ebu;
}

/// Mixes the bits: each bit of `running` affects all bits of the result.
DETENT_SHARED constexpr uint64_t digest_finish(uint64_t running) {
  running ^= running >> 32;
  running *= 0xd6e8feb86659fd93u;
  running ^= running >> 29;
  running *= 0xd6e8feb86659fd93u;
  return running ^ (running >> 32);
}

/// Returns the exclusive or of the two halves of the digest.
constexpr uint32_t digest_fold(uint64_t digest) { return static_cast<uint32_t>(digest ^ digest >> 32); }

/// Returns the digest of canonical bytes, in words of 8 bytes; the last word is padded with zeros. The byte count is
/// part of the digest. `seed`: the running value to start from.
uint64_t digest_bytes(const uint8_t* bytes, uint32_t byte_count, uint64_t seed);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
