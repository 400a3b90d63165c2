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
    {"fx64", 1, 0x7caa9ea165fb21bc},
    {"fx64", 101, 0x9165b3ad18ce3664},
    {"fx64", 201, 0x668a64063f9fb549},
    {"fx64", 301, 0x28a427e94507aaf5},
    {"fx32", 1, 0x3b886d53b4b1615f},
    {"fx32", 101, 0xe7fd02dac251d7bb},
    {"fx32", 201, 0xc30d9fdf3802ca01},
    {"fx32", 301, 0xeee60a1ded47b010},
    {"f32", 1, 0xea2666eac2e3b025},
    {"f32", 101, 0x496fcc034687d5ee},
    {"f32", 201, 0x1571d018e95c00e7},
    {"f32", 301, 0x1a03c67faf0c4e5b},
    {"f64", 1, 0x5224869b6f0a5d0a},
    {"f64", 101, 0x5b863511e9e70e55},
    {"f64", 201, 0x38122452bcb973cd},
    {"f64", 301, 0x395b65a61cb34bff},
};
