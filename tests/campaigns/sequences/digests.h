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
    {"fx64", 101, 0x69f81a884c53e3ba},
    {"fx64", 201, 0xd0d0c32e8fdcd650},
    {"fx64", 301, 0x4ea93972a8d6f614},
    {"fx32", 1, 0x69a3c3492f64a212},
    {"fx32", 101, 0xccee7e0e6e15ce15},
    {"fx32", 201, 0xe8849dea306bec9b},
    {"fx32", 301, 0xd22da9c15d395ee5},
    {"f32", 1, 0xb1048caffeaeca96},
    {"f32", 101, 0xd232e260f57770e0},
    {"f32", 201, 0x909e433cc38aa5eb},
    {"f32", 301, 0x55875f6f72489d7d},
    {"f64", 1, 0xe000e7db46a2277b},
    {"f64", 101, 0xeb2d6ed16986f1d0},
    {"f64", 201, 0xb90b3321a9f89fcd},
    {"f64", 301, 0xe6354274a8e4c337},
};
