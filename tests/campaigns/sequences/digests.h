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
    {"fx64", 1, 0x646dab56665851b7},
    {"fx64", 101, 0x64a1b24bd4119172},
    {"fx64", 201, 0xac2dcce74bfd88c8},
    {"fx64", 301, 0xb139d11befaacfe3},
    {"fx32", 1, 0x6fe79edd571aaf18},
    {"fx32", 101, 0x10f7a092451557af},
    {"fx32", 201, 0x0edc79f4cb961def},
    {"fx32", 301, 0x19f0a3e4b02a6988},
    {"f32", 1, 0xadf72382c5d2c965},
    {"f32", 101, 0xc31215a101822781},
    {"f32", 201, 0x59fe0e88901abc55},
    {"f32", 301, 0xf9cd9e8d56c380f6},
    {"f64", 1, 0x85c416d81469a924},
    {"f64", 101, 0x82258ef7789cc1a6},
    {"f64", 201, 0xa9a7b7020b9f3320},
    {"f64", 301, 0x37cb1345499027be},
};
