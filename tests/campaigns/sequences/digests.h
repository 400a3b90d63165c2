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
    {"fx64", 1, 0x38e94caa02f1a2e2},
    {"fx64", 101, 0x431a4757299f2f8c},
    {"fx64", 201, 0xa7d65468a4f81c1f},
    {"fx64", 301, 0x00331e945cb886e2},
    {"fx32", 1, 0x9939edf6fa9a0dae},
    {"fx32", 101, 0xbcad09dbb9e21246},
    {"fx32", 201, 0x47a0775259537aa4},
    {"fx32", 301, 0x96d3037a1588c3ed},
    {"f32", 1, 0x7e121deb3d84770c},
    {"f32", 101, 0x8f3346fd62cc2d09},
    {"f32", 201, 0xf524db3e243dcde7},
    {"f32", 301, 0x557dd5c02600877c},
    {"f64", 1, 0x8e9e429d61e10c9c},
    {"f64", 101, 0x1195b5114c946241},
    {"f64", 201, 0x7d2deab3b74edb43},
    {"f64", 301, 0x80eb0c04a2ea076a},
};
