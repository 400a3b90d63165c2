#pragma once
#include <stdint.h>

/// Of the 100 sequences from `first` on. Written by tests/sequences/regenerate.
struct SequencesDigest {
  const char* config;
  uint32_t first;
  uint64_t digest;
};
inline constexpr SequencesDigest k_sequences_digests[] = {
    {"none", 0, 0},
};
