#pragma once
#include <stdint.h>

/// Of the 100 sequences from `first` on. Written by tests/sequences/regenerate.
struct SequencesDigest {
  const char* config;
  uint32_t first;
  uint64_t digest;
};
// clang-format off
inline constexpr SequencesDigest k_sequences_digests[] = {
    {"fx64", 1, 0xe8b75932dadc736c},
    {"fx64", 101, 0x16b2f817babac7d7},
    {"fx64", 201, 0x7a3ca779f3a313e4},
    {"fx64", 301, 0x5b09528b013f6dcd},
    {"fx32", 1, 0xdc7a220b8c4064a9},
    {"fx32", 101, 0x107f67b98761d9a9},
    {"fx32", 201, 0x5c91005ff1703b70},
    {"fx32", 301, 0x77d58d81725107d5},
    {"f32", 1, 0x559416b0cfacf5a7},
    {"f32", 101, 0xebe9061404de4b01},
    {"f32", 201, 0xd9aff677313a0cfd},
    {"f32", 301, 0xc0bf3553a673ec00},
    {"f64", 1, 0x30a1876e599585f4},
    {"f64", 101, 0xdb4d30113d5a60ad},
    {"f64", 201, 0x5286d34dc84c274e},
    {"f64", 301, 0x5a4540d22b8680c9},
};
