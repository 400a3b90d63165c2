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
    {"fx64", 1, 0x3647ebae2495b91f},
    {"fx64", 101, 0xd22fffdeb825fb73},
    {"fx64", 201, 0xf65bd8cf7fa02676},
    {"fx64", 301, 0x8f291f61365ffec0},
    {"fx32", 1, 0xb8debbe22c6efa98},
    {"fx32", 101, 0x51124b8ed3b6a89c},
    {"fx32", 201, 0x90f95d711b084a2c},
    {"fx32", 301, 0x9fe77f069ea0aadd},
    {"f32", 1, 0x116e1496690bea4e},
    {"f32", 101, 0x479c3329b496c3ec},
    {"f32", 201, 0x8239a204e0c9892f},
    {"f32", 301, 0x7cb27b764c170503},
    {"f64", 1, 0x8c4d6dcc5de145a3},
    {"f64", 101, 0x37ebd617068ac9f1},
    {"f64", 201, 0xa2f18cf0d827ad66},
    {"f64", 301, 0x871f9629b9984929},
};
