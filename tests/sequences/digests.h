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
    {"fx64", 1, 0xe89fe31678ca0452},
    {"fx64", 101, 0xb4071b5183a75b96},
    {"fx64", 201, 0x411e02a9b77a7e5d},
    {"fx64", 301, 0xc5c56f320c7dce5a},
    {"fx32", 1, 0xfeec794066cd91ae},
    {"fx32", 101, 0x96118432fec441f2},
    {"fx32", 201, 0x49a8206e6d6acf2e},
    {"fx32", 301, 0xfd82cdf1a9b9e1c6},
    {"f32", 1, 0x53821894d144ad86},
    {"f32", 101, 0x9f4756bbf6348e7d},
    {"f32", 201, 0x2f2a4fc0e35dee29},
    {"f32", 301, 0xee8275262dde322e},
    {"f64", 1, 0xbeb23da4c53c73bc},
    {"f64", 101, 0xc5cb321bdc02669a},
    {"f64", 201, 0xe9460ad4760cb5bd},
    {"f64", 301, 0x62db98ff1d10a189},
};
