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
    {"fx64", 1, 0xa3ec7e7f0cdc3763},
    {"fx64", 101, 0xc99c13ff72670018},
    {"fx64", 201, 0x1e199b7943f1e3ca},
    {"fx64", 301, 0xe356de443b07bf24},
    {"fx32", 1, 0x87c3ac3d52a53980},
    {"fx32", 101, 0x3104c81e5f22892a},
    {"fx32", 201, 0x17c92993da4d63ed},
    {"fx32", 301, 0x7d2f4ab789f1c9b8},
    {"f32", 1, 0xb1048caffeaeca96},
    {"f32", 101, 0x95d4f3ee3e80f9d3},
    {"f32", 201, 0xbaedf0f03a33406a},
    {"f32", 301, 0x24f72476a6dc91ea},
    {"f64", 1, 0xe000e7db46a2277b},
    {"f64", 101, 0x9c289b233d0de755},
    {"f64", 201, 0x70b9a41ee9505168},
    {"f64", 301, 0xcbde1afb00d0caa7},
};
