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
    {"fx64", 1, 0x5b2e6c1900132b48},
    {"fx64", 101, 0x93cfce900ac343d6},
    {"fx64", 201, 0x32887f6be3382111},
    {"fx64", 301, 0x8f7cd34a5babae6e},
    {"fx32", 1, 0xee64a3280922de50},
    {"fx32", 101, 0x084ac3208127a59f},
    {"fx32", 201, 0x82108c81c2d8812a},
    {"fx32", 301, 0x6f5950d8d1605b72},
    {"f32", 1, 0x25ac9495184b1600},
    {"f32", 101, 0x3590bc74d08d2de6},
    {"f32", 201, 0x9af6b052d12e9a9d},
    {"f32", 301, 0x4d5c431de003d053},
    {"f64", 1, 0xdec561cc0ef3393b},
    {"f64", 101, 0x1e225dbf21dcdb6d},
    {"f64", 201, 0xe17522bbf7447656},
    {"f64", 301, 0x324653be81ce6566},
};
