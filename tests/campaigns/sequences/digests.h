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
    {"fx64", 1, 0x44e03b32dab80894},
    {"fx64", 101, 0x2b8d74fc8c14b2e6},
    {"fx64", 201, 0x5106f02b12ee1018},
    {"fx64", 301, 0x4ea93972a8d6f614},
    {"fx32", 1, 0x69a3c3492f64a212},
    {"fx32", 101, 0xccee7e0e6e15ce15},
    {"fx32", 201, 0x9f814d8d6899e021},
    {"fx32", 301, 0xd22da9c15d395ee5},
    {"f32", 1, 0x0668191ccf8a1226},
    {"f32", 101, 0xfd146c4cb4470f2e},
    {"f32", 201, 0x909e433cc38aa5eb},
    {"f32", 301, 0x55875f6f72489d7d},
    {"f64", 1, 0x761921cb0c20c148},
    {"f64", 101, 0x7be7b5203cfef84e},
    {"f64", 201, 0xb90b3321a9f89fcd},
    {"f64", 301, 0xe6354274a8e4c337},
};
