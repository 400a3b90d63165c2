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
    {"fx64", 1, 0x8e2d5318db7377d5},
    {"fx64", 101, 0x338afa39fb33ad3f},
    {"fx64", 201, 0x42484a8294a249b5},
    {"fx64", 301, 0xd3e62698f11731f4},
    {"fx32", 1, 0xb8d7beda5a3cfbc6},
    {"fx32", 101, 0xec0ab5759edbbfdc},
    {"fx32", 201, 0x2227b5cde9e48de2},
    {"fx32", 301, 0xcbe3da26f5884149},
    {"f32", 1, 0x5bcf66b2db73d2c8},
    {"f32", 101, 0x5d99291c8dbc55fd},
    {"f32", 201, 0x974aa85cc0720d0f},
    {"f32", 301, 0x1175f023947dfc64},
    {"f64", 1, 0x9538ec727dbdc5b2},
    {"f64", 101, 0x79f6c7251ade7a8e},
    {"f64", 201, 0x8f57f4e1e504cbe9},
    {"f64", 301, 0xc4603e26a925671e},
};
