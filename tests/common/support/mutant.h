#pragma once
#include <string.h>

#include <algorithm>
#include <vector>

#include "tests/common/queries/random.h"

namespace detent_test {

using Bytes = std::vector<uint8_t>;

/// A word near the limits of a range.
inline uint32_t edge_word(detent_queries::Random& random) {
  constexpr uint32_t k_words[] = {0, 1, 2, 3, 4, 7, 16, 64, 0xff, 0x100, 0xffff, 0x10000, 0x3fffffff, 0x40000000};
  const uint32_t word = k_words[random.below(sizeof k_words / sizeof *k_words)];
  const uint32_t bits = random.chance(0.5) ? 0 : 0x80000000;
  return random.chance(0.3) ? ~(word | bits) : word | bits;
}

/// Makes one change, or up to four: of bits, bytes and words, copies from other places, seldom of the length. The same
/// on every machine.
inline Bytes mutated(Bytes bytes, detent_queries::Random& random) {
  const uint32_t changes = random.chance(0.6) ? 1 : 2 + random.below(3);
  for (uint32_t left = changes; left != 0 && bytes.size() >= 8; --left) {
    const uint32_t count = static_cast<uint32_t>(bytes.size());
    const uint32_t at = random.below(count), aligned = at & ~3u;
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const uint32_t room = std::min(count - aligned, 4u);
    switch (random.below(24)) {
      case 0:
        bytes.resize(at);
        break;
      case 1: {
        const uint32_t length = 1 + random.below(8), value = random.below(256);
        bytes.insert(place, length, static_cast<uint8_t>(value));
        break;
      }
      case 2:
        bytes.erase(place, place + std::min(static_cast<std::ptrdiff_t>(1 + random.below(8)), bytes.end() - place));
        break;
      case 3:
      case 4:
      case 5: {
        const uint32_t from = random.below(count), length = std::min(1 + random.below(16), count - std::max(from, at));
        memmove(bytes.data() + at, bytes.data() + from, length);
        break;
      }
      case 6:
      case 7:
      case 8:
      case 9: {
        const uint32_t word = edge_word(random);
        for (uint32_t k = 0; k < room; ++k) bytes[aligned + k] = static_cast<uint8_t>(word >> (8 * k));
        break;
      }
      case 10:
      case 11: {
        const uint32_t low = bytes[at], step = 1 + random.below(8);
        bytes[at] = static_cast<uint8_t>(random.chance(0.5) ? low + step : low - step);
        break;
      }
      case 12:
      case 13:
        bytes[at] = static_cast<uint8_t>(random.below(256));
        break;
      default:
        bytes[at] = static_cast<uint8_t>(bytes[at] ^ 1u << random.below(8));
        break;
    }
  }
  return bytes;
}

}  // namespace detent_test
