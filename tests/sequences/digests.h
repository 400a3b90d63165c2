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
    {"fx64", 1, 0x6e65550063ebb61d},
    {"fx64", 101, 0x9165b3ad18ce3664},
    {"fx64", 201, 0x668a64063f9fb549},
    {"fx64", 301, 0x28a427e94507aaf5},
    {"fx32", 1, 0xb1f95855225a3f3a},
    {"fx32", 101, 0xe7fd02dac251d7bb},
    {"fx32", 201, 0xc30d9fdf3802ca01},
    {"fx32", 301, 0xeee60a1ded47b010},
    {"f32", 1, 0xcf7d0627e6c5f5c5},
    {"f32", 101, 0xd98c00e72eee21f8},
    {"f32", 201, 0x16d2b0e7973f4ef5},
    {"f32", 301, 0x1a03c67faf0c4e5b},
    {"f64", 1, 0x475a443cf4045aec},
    {"f64", 101, 0x544add4132fac541},
    {"f64", 201, 0x1d425b558a11452c},
    {"f64", 301, 0x395b65a61cb34bff},
};
