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
    {"fx64", 1, 0x549d87c3332fc4eb},
    {"fx64", 101, 0x7e74d4044bf1c506},
    {"fx64", 201, 0x72c4d057552efb85},
    {"fx64", 301, 0xf4d26d8bb6993b37},
    {"fx32", 1, 0xa1b8a2de73edbfa7},
    {"fx32", 101, 0x76a99cc5c16bdd23},
    {"fx32", 201, 0x9f9cfe092e30de6e},
    {"fx32", 301, 0x5c84a3abe2f9c7b5},
    {"f32", 1, 0x26c60d344682dab1},
    {"f32", 101, 0x2aad76ecc5586fee},
    {"f32", 201, 0x68150d7cc560a3de},
    {"f32", 301, 0xc78dcb76c3a31ef0},
    {"f64", 1, 0x999314c67c4c0168},
    {"f64", 101, 0x56de36a41c9d62e9},
    {"f64", 201, 0x5f34d10c54fdad40},
    {"f64", 301, 0x23b7d94fe7e935b7},
};
