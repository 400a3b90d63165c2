#pragma once
#include <stdint.h>

/// Of the 100 sequences from `first` on. Written by tests/campaigns/sequences/regenerate.
struct SequencesDigest {
  const char* config;
  uint32_t first;
  uint64_t digest;
};
// clang-format off
inline constexpr SequencesDigest k_sequences_digests[] = {
    {"fx64", 1, 0x15736f741a72ac0c},
    {"fx64", 101, 0x7d078c71c5a655f1},
    {"fx64", 201, 0xf6ef5c18e16d787b},
    {"fx64", 301, 0x60a1f4ec82c6c995},
    {"fx32", 1, 0x631d4853346069ff},
    {"fx32", 101, 0x15086b8eda03148a},
    {"fx32", 201, 0xd8cc3968de0fa918},
    {"fx32", 301, 0x96417659c1e20c97},
    {"f32", 1, 0xc3ca6b33f952347b},
    {"f32", 101, 0x8bb2ef519ba02a11},
    {"f32", 201, 0xb715a6e3d740afcb},
    {"f32", 301, 0x36d9ea8b8e6ab8cf},
    {"f64", 1, 0xfab2519fd2bbbeb6},
    {"f64", 101, 0xbd4fbd6501fc2b29},
    {"f64", 201, 0xf1b72887eca8a0f1},
    {"f64", 301, 0xa7f317e66f14473d},
};
