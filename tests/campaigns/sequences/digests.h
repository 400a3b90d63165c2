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
    {"fx64", 1, 0xf526aabf4843f5d4},
    {"fx64", 101, 0xc30369bbf812c073},
    {"fx64", 201, 0x1d7284655077a74d},
    {"fx64", 301, 0xc5c56f320c7dce5a},
    {"fx32", 1, 0x9394c8dc4b2b6fe5},
    {"fx32", 101, 0xb5716c8d70158676},
    {"fx32", 201, 0x2f6f9e615346d329},
    {"fx32", 301, 0xfd82cdf1a9b9e1c6},
    {"f32", 1, 0x81fe5bd8c3538f44},
    {"f32", 101, 0x30f443addf9002ff},
    {"f32", 201, 0xfbd4519c417ff271},
    {"f32", 301, 0x270f7ef3c428af36},
    {"f64", 1, 0x4e9e38e7d7d9f697},
    {"f64", 101, 0xea13e4757fd8669e},
    {"f64", 201, 0x2ae7c48f7ad38c06},
    {"f64", 301, 0x0ec1753496fdb0a8},
};
