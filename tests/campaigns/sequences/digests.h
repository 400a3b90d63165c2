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
    {"fx64", 1, 0xf337142899c9d379},
    {"fx64", 101, 0x28a2f0f3b7a93f0b},
    {"fx64", 201, 0x69f178e60be71525},
    {"fx64", 301, 0x4c7a14f3995cb56f},
    {"fx32", 1, 0x89e67fd0ee4f718d},
    {"fx32", 101, 0x0af378a794142b36},
    {"fx32", 201, 0xd4ea06a80014b49e},
    {"fx32", 301, 0x4caa3b756bb6330d},
    {"f32", 1, 0xadf72382c5d2c965},
    {"f32", 101, 0xc31215a101822781},
    {"f32", 201, 0x59fe0e88901abc55},
    {"f32", 301, 0xf9cd9e8d56c380f6},
    {"f64", 1, 0x85c416d81469a924},
    {"f64", 101, 0x82258ef7789cc1a6},
    {"f64", 201, 0xa9a7b7020b9f3320},
    {"f64", 301, 0x37cb1345499027be},
};
