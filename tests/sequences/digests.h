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
    {"fx64", 1, 0xb320e9c2e41208b0},
    {"fx64", 101, 0x83ba40617155cbdd},
    {"fx64", 201, 0x4cf3bfc0f0793769},
    {"fx64", 301, 0xa71c7ed4344a0abc},
    {"fx32", 1, 0xd8be7c4c366b60a8},
    {"fx32", 101, 0x77b100c3c4b4e9d4},
    {"fx32", 201, 0xb9241f7f965a4a2e},
    {"fx32", 301, 0x9beae040d691ed99},
    {"f32", 1, 0x039e16a426f3983d},
    {"f32", 101, 0xf5b6b9c74613ca51},
    {"f32", 201, 0x55b268736cb5d7cb},
    {"f32", 301, 0x3733ed23466882ee},
    {"f64", 1, 0x87bc67acd3239ab9},
    {"f64", 101, 0x65566407c45b8d72},
    {"f64", 201, 0x8db299a2d38e47e7},
    {"f64", 301, 0xdb7693355a894d29},
};
