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
    {"fx64", 1, 0x3c93f27ef2fc0aab},
    {"fx64", 101, 0x8082c1b72adca5e8},
    {"fx64", 201, 0xbfa8a56f3f7f59ef},
    {"fx64", 301, 0xb5cc194d5c7a7b6a},
    {"fx32", 1, 0xf558d5d0723c861f},
    {"fx32", 101, 0x76222a9efad61cfc},
    {"fx32", 201, 0x2709ed88dd5d1032},
    {"fx32", 301, 0xf08260a3ca99907a},
    {"f32", 1, 0x584f255b14b00590},
    {"f32", 101, 0x618b04c13b66f925},
    {"f32", 201, 0x572fce8c89d55324},
    {"f32", 301, 0x7c312c812b21d4f4},
    {"f64", 1, 0x95059eaf0ba9e519},
    {"f64", 101, 0x1bb1ad8634958b4b},
    {"f64", 201, 0x8f4256970a071bc3},
    {"f64", 301, 0xd0671d421b272308},
};
